// A quarter of a hub with a bonded lining, millimetres: lining from radius 20 to 24, steel to 40. Cells of second order.
// gmsh -2 -order 2 -format msh41 lined_hub.geo
SetFactory("Built-in");

inner = 20;
bond = 24;
outer = 40;

Point(1) = {0, 0, 0};
Point(2) = {inner, 0, 0};
Point(3) = {0, inner, 0};
Point(4) = {bond, 0, 0};
Point(5) = {0, bond, 0};
Point(6) = {outer, 0, 0};
Point(7) = {0, outer, 0};
Circle(1) = {2, 1, 3};
Circle(2) = {4, 1, 5};
Circle(3) = {6, 1, 7};
Line(4) = {2, 4};
Line(5) = {3, 5};
Line(6) = {4, 6};
Line(7) = {5, 7};
Curve Loop(1) = {4, 2, -5, -1};
Plane Surface(1) = {1};
Curve Loop(2) = {6, 3, -7, -2};
Plane Surface(2) = {2};

// quadrilaterals in the lining, triangles in the steel, which share the nodes of the bond
Transfinite Curve {1, 2} = 25;
Transfinite Curve {4, 5} = 4;
Transfinite Curve {3} = 17;
Transfinite Curve {6, 7} = 8;
Transfinite Surface {1};
Recombine Surface {1};

Physical Surface("lining") = {1};
Physical Surface("steel") = {2};
Physical Curve("bore") = {1};
Physical Curve("rim") = {3};
Physical Curve("x axis") = {4, 6};
Physical Curve("y axis") = {5, 7};
