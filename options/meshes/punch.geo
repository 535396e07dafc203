// Block [-2,2] x [-2,0]; the middle of its top, |x| <= 1/2, is a side of its own: only there a punch can touch.
// Triangles are small at the two edges of the punch, where the pressure is infinite, and fine under the punch.
// gmsh -2 -format msh2 punch.geo
SetFactory("Built-in");

edge = 0.002;   // size of a triangle at the edges of the punch
growth = 0.10;  // size of a triangle per distance from the nearer edge

Point(1) = {-2, -2, 0};
Point(2) = {2, -2, 0};
Point(3) = {2, 0, 0};
Point(4) = {0.5, 0, 0};
Point(5) = {-0.5, 0, 0};
Point(6) = {-2, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};

Physical Surface("block") = {1};
Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("under_punch") = {4};
Physical Curve("top") = {3, 5};
Physical Curve("left") = {6};

Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * Sqrt((Fabs(x)-0.5)*(Fabs(x)-0.5) + y*y)", edge, growth);
Background Field = 1;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.Algorithm = 6;
