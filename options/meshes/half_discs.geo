// Two half discs touching at the origin: "upper" has radius 1 and its flat side at y = 1, "lower" has radius 2 and its
// flat side at y = -2. Triangles are small around the origin and grow with the distance from it.
// gmsh -2 -format msh2 half_discs.geo
SetFactory("Built-in");

near = 0.08;    // half width of the fine zone: wider than the contact at a displacement of 0.01
growth = 0.22;  // size of a triangle per distance from the fine zone

Point(1) = {0, 0, 0};
Point(2) = {0, 1, 0};
Point(3) = {-1, 1, 0};
Point(4) = {1, 1, 0};
Circle(1) = {3, 2, 1};
Circle(2) = {1, 2, 4};
Line(3) = {4, 3};
Curve Loop(1) = {1, 2, 3};
Plane Surface(1) = {1};

Point(11) = {0, 0, 0};
Point(12) = {0, -2, 0};
Point(13) = {2, -2, 0};
Point(14) = {-2, -2, 0};
Circle(11) = {13, 12, 11};
Circle(12) = {11, 12, 14};
Line(13) = {14, 13};
Curve Loop(11) = {11, 12, 13};
Plane Surface(11) = {11};

Physical Surface("upper") = {1};
Physical Surface("lower") = {11};
Physical Curve("upper_arc") = {1, 2};
Physical Curve("upper_top") = {3};
Physical Curve("lower_arc") = {11, 12};
Physical Curve("lower_bottom") = {13};

// Sizes do not match across the contact on purpose: 0.005 above, 0.0065 below.
ramp = Sprintf("%g * 0.5 * (Sqrt(x*x+y*y) - %g + Fabs(Sqrt(x*x+y*y) - %g))", growth, near, near);
Field[1] = MathEval;
Field[1].F = StrCat("0.005 + ", ramp);
Field[2] = MathEval;
Field[2].F = "0.10";
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Field[4] = Restrict;
Field[4].IField = 3;
Field[4].FacesList = {1};
Field[4].EdgesList = {1, 2, 3};
Field[5] = MathEval;
Field[5].F = StrCat("0.0065 + ", ramp);
Field[6] = MathEval;
Field[6].F = "0.15";
Field[7] = Min;
Field[7].FieldsList = {5, 6};
Field[8] = Restrict;
Field[8].IField = 7;
Field[8].FacesList = {11};
Field[8].EdgesList = {11, 12, 13};
Field[9] = Min;
Field[9].FieldsList = {4, 8};
Background Field = 9;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.Algorithm = 6;
