// Two regions that share the line "between": triangles below, quadrangles above. Written in four formats by
//   for f in 22 41; do gmsh -2 -format msh$f two_regions.geo -o two_regions_$f.msh; done   (and with -bin: *_bin.msh)
Point(1) = {0, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {2, 1, 0};
Point(4) = {0, 1, 0};
Point(5) = {2, 1.5, 0};
Point(6) = {0, 1.5, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {3, 5};
Line(6) = {5, 6};
Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {-3, 5, 6, 7};
Plane Surface(1) = {1};
Plane Surface(2) = {-2};                     // clockwise
Transfinite Curve {1, 3, 6} = 4;
Transfinite Curve {2, 4} = 3;
Transfinite Curve {5, 7} = 2;
Transfinite Surface {2} = {4, 3, 5, 6};
Recombine Surface {2};
Physical Curve("bottom", 11) = {1};
Physical Curve("between", 12) = {3};
Physical Curve("top side", 13) = {6};
Physical Curve(7) = {2, 5};                  // no name
Physical Curve("right of both", 14) = {2, 5}; // the same lines twice
Physical Curve("hidden", 15) = {4};
Physical Surface("soft", 11) = {1};          // numbers of curves and surfaces are apart
Physical Surface("stiff", 2) = {2};
