// The rectangle [0,2] x [0,1], quadrangles and triangles, whose left half and left foot are in two physical groups each.
// gmsh -2 -format msh22 two_groups.geo -o two_groups_22.msh     (and with -bin, and msh41)
Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5}; Point(3) = {2, 0, 0, 0.5};
Point(4) = {2, 1, 0, 0.5}; Point(5) = {1, 1, 0, 0.5}; Point(6) = {0, 1, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1}; Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, -7}; Plane Surface(2) = {2};
Transfinite Surface{1}; Recombine Surface{1};
Physical Surface("all") = {1, 2}; Physical Surface("left half") = {1};
Physical Curve("foot") = {1, 2}; Physical Curve("left foot") = {1};
