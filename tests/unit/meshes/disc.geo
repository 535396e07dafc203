// disc.geo -- the unit disc: triangles below, quadrangles and two triangles above, all of second order. From this folder:
//   gmsh -2 -order 2 -format msh22 disc.geo -o disc_22.msh
//   gmsh -2 -order 2 -format msh41 disc.geo -o disc_41.msh
//   gmsh -2 -order 2 -format msh22 -bin disc.geo -o disc_22_bin.msh
//   gmsh -2 -order 2 -format msh41 -bin disc.geo -o disc_41_bin.msh
//   gmsh -2 -order 2 -format msh41 -setnumber Mesh.SecondOrderIncomplete 1 disc.geo -o disc_quad8.msh
Point(1) = {0, 0, 0, 1};
Point(2) = {1, 0, 0, 1};
Point(3) = {0, 1, 0, 1};
Point(4) = {-1, 0, 0, 1};
Point(5) = {0, -1, 0, 1};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Line(5) = {4, 1};
Line(6) = {1, 2};
Curve Loop(1) = {1, 2, 5, 6};
Curve Loop(2) = {3, 4, -6, -5};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve{1 : 6} = 3; // two edges each
Recombine Surface{1};
Physical Surface("upper", 1) = {1};
Physical Surface("lower", 2) = {2};
Physical Curve("rim", 3) = {1 : 4};
Physical Curve("middle", 4) = {5, 6};
