// A unit square in three layers: soft below 0.3, stiff below 0.7, rest above. Quadrilaterals, but triangles in the middle layer.
// gmsh -2 -format msh41 layers.geo
SetFactory("Built-in");

Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {0, 0.3, 0};
Point(4) = {1, 0.3, 0};
Point(5) = {0, 0.7, 0};
Point(6) = {1, 0.7, 0};
Point(7) = {0, 1, 0};
Point(8) = {1, 1, 0};
Line(1) = {1, 2};
Line(2) = {3, 4};
Line(3) = {5, 6};
Line(4) = {7, 8};
Line(5) = {1, 3};
Line(6) = {3, 5};
Line(7) = {5, 7};
Line(8) = {2, 4};
Line(9) = {4, 6};
Line(10) = {6, 8};
Curve Loop(1) = {1, 8, -2, -5};
Plane Surface(1) = {1};
Curve Loop(2) = {2, 9, -3, -6};
Plane Surface(2) = {2};
Curve Loop(3) = {3, 10, -4, -7};
Plane Surface(3) = {3};
Transfinite Curve {1, 2, 3, 4} = 13;
Transfinite Curve {5, 7, 8, 10} = 4;
Transfinite Curve {6, 9} = 5;
Transfinite Surface {1, 2, 3};
Recombine Surface {1, 3};

Physical Surface("soft") = {1};
Physical Surface("stiff layer") = {2};
Physical Surface("rest") = {3};
Physical Surface("upper two") = {2, 3};
Physical Curve("bottom") = {1};
Physical Curve("top") = {4};
Physical Curve("left") = {5, 6, 7};
Physical Curve("right") = {8, 9, 10};
Physical Curve("between") = {2};
Physical Curve("above") = {3};
