// A quarter of a ball of radius 1 above the origin, cut off at a height of 0.7, and a quarter of a block under it, tetrahedra that grow
// with the distance from where they touch, in a file for each body.
//   gmsh -3 -order 1 -setnumber body 1 -setnumber size 1 ball.geo -o ball.msh        body 1: the ball, 2: the block; size: of all cells
SetFactory("OpenCASCADE");
If (body == 1)
  Sphere(1) = {0, 0, 1, 1};
  Box(2) = {0, 0, 0, 1, 1, 0.7};
  BooleanIntersection(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Else
  Box(3) = {0, 0, -0.8, 1, 1, 0.8};
EndIf
e = 1e-4;
left() = Surface In BoundingBox {-e, -e, -2, e, 2, 2};
front() = Surface In BoundingBox {-e, -e, -2, 2, e, 2};
Physical Volume("body") = {3};
Physical Surface("left") = {left()};
Physical Surface("front") = {front()};
If (body == 1)
  top() = Surface In BoundingBox {-e, -e, 0.7 - e, 2, 2, 0.7 + e};
  cap() = Abs(Boundary{ Volume{3}; });
  cap() -= {left(), front(), top()};
  Physical Surface("cap") = {cap()};
Else
  top() = Surface In BoundingBox {-e, -e, -e, 2, 2, e};
  bottom() = Surface In BoundingBox {-e, -e, -0.8 - e, 2, 2, -0.8 + e};
  Physical Surface("bottom") = {bottom()};
EndIf
Physical Surface("top") = {top()};
Field[1] = MathEval;
Field[1].F = Sprintf("%g * (0.02 + 0.12 * Sqrt(x*x + y*y + z*z))", size * (0.85 + 0.15 * body));
Background Field = 1;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
