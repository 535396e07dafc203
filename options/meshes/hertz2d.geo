// Half disc of radius 10 that rests on its lowest point, the origin; flat side "top" at y = 10.
// Triangles are small around the origin and grow with the distance from it.
// gmsh -2 -format msh41 hertz2d.geo
SetFactory("Built-in");

R = 10;
fine = 0.035;   // size of a triangle at the contact
near = 0.65;    // half width of the fine zone
growth = 0.18;  // size of a triangle per distance from the fine zone
coarse = 0.8;   // largest size

Point(1) = {0, 0, 0};
Point(2) = {0, R, 0};
Point(3) = {-R, R, 0};
Point(4) = {R, R, 0};
Circle(1) = {3, 2, 1};
Circle(2) = {1, 2, 4};
Line(3) = {4, 3};
Curve Loop(1) = {1, 2, 3};
Plane Surface(1) = {1};

Physical Surface("disc") = {1};
Physical Curve("arc") = {1, 2};
Physical Curve("top") = {3};

Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * 0.5 * (Sqrt(x*x+y*y) - %g + Fabs(Sqrt(x*x+y*y) - %g))", fine, growth, near, near);
Field[2] = MathEval;
Field[2].F = Sprintf("%g", coarse);
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Background Field = 3;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.Algorithm = 6;
