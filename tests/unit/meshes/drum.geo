// drum.geo -- a drum of radius 1 between z = 0 and z = 1, of second order, its halves y > 0 and y < 0 two regions: 12
// hexahedra, or 72 tetrahedra where "tets" is 1. From this folder:
//   gmsh -3 -order 2 -format msh22 drum.geo -o drum_22.msh
//   gmsh -3 -order 2 -format msh41 -bin -setnumber Mesh.SecondOrderIncomplete 1 drum.geo -o drum_41_bin.msh
//   gmsh -3 -order 2 -format msh41 -setnumber tets 1 drum.geo -o drum_tets_41.msh
//   gmsh -3 -order 2 -format msh22 -bin -setnumber tets 1 drum.geo -o drum_tets_22_bin.msh
DefineConstant[ tets = 0 ];
Point(1) = {0, 0, 0};
For i In {0 : 7} // on the circle, and on the square in its middle
  c = Cos(i * Pi / 4);
  s = Sin(i * Pi / 4);
  Point(10 + i) = {c, s, 0};
  Point(20 + i) = {0.5 * Round(c), 0.5 * Round(s), 0};
EndFor
For i In {0 : 7}
  Circle(10 + i) = {10 + i, 1, 10 + (i + 1) % 8};
  Line(20 + i) = {20 + i, 20 + (i + 1) % 8};
  Line(30 + i) = {20 + i, 10 + i};
  If (i % 2 == 0)
    Line(40 + i) = {1, 20 + i};
  EndIf
EndFor
For i In {0 : 7}
  Curve Loop(10 + i) = {30 + i, 10 + i, -(30 + (i + 1) % 8), -(20 + i)};
  Plane Surface(10 + i) = {10 + i};
  If (i % 2 == 0)
    Curve Loop(20 + i) = {40 + i, 20 + i, 21 + i, -(40 + (i + 2) % 8)};
    Plane Surface(20 + i) = {20 + i};
  EndIf
EndFor
Transfinite Curve{:} = 2;
Transfinite Surface{:};
If (!tets)
  Recombine Surface{:};
EndIf
sectors[] = {10 : 17, 20, 22, 24, 26};
For k In {0 : 11}
  If (tets)
    all[] = Extrude {0, 0, 1} { Surface{sectors[k]}; Layers{1}; };
  Else
    all[] = Extrude {0, 0, 1} { Surface{sectors[k]}; Layers{1}; Recombine; };
  EndIf
  top[] += all[0];
  body[] += all[1];
  If (k < 8)
    rim[] += all[3];
  EndIf
  If (k == 0)
    middle[] += all[2];
  EndIf
  If (k == 4)
    middle[] += all[2];
  EndIf
  If (k == 8)
    middle[] += all[2];
  EndIf
  If (k == 10)
    middle[] += all[2];
  EndIf
EndFor
Physical Volume("upper", 1) = {body[{0 : 3, 8, 9}]};
Physical Volume("lower", 2) = {body[{4 : 7, 10, 11}]};
Physical Surface("rim", 1) = {rim[]}; // numbers of surfaces and volumes are apart
Physical Surface("middle", 3) = {middle[]};
Physical Surface("bottom", 4) = {sectors[]};
Physical Surface("top", 5) = {top[]};
