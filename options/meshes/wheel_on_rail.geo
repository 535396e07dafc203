// The rim of a railway wheel on a rail, the half x > 0 of both. Millimetres; they touch at the origin.
//
// The rail lies along x: a head 74 wide, 172 high, its crown an arc of radius 300 across the track. The wheel rolls about
// an axle along y at z = 460: tread, throat and flange are one section turned about it. The hub side of the rim is the
// cylinder of radius 400.
// gmsh -3 -order 2 -format msh22 -bin wheel_on_rail.geo
SetFactory("OpenCASCADE");
General.NumThreads = 1;

crown = 300;        // radius across the rail
tread = 460;        // radius of the wheel
hub = 400;
half = 25;          // of the crown's breadth
length = 120;       // of the half rail
sweep = 12 * Pi / 180; // of the half rim

fine = 2.0;         // size of a cell where they touch
near = 7;           // distance over which it stays so
growth = 0.62;      // size per distance from there
coarse = 45;

// the rail: its section at x = 0, all round from the middle of the crown
z = crown * (Sqrt(1 - (half / crown)^2) - 1); // of the crown's edge
Point(1) = {0, 0, 0};
Point(2) = {0, 0, -crown};
For side In {0 : 1}
  s = 1 - 2 * side;
  p = 10 + 20 * side;
  Point(p) = {0, s * half, z};
  Point(p + 1) = {0, s * 33, -5};
  Point(p + 2) = {0, s * 37, -14};
  Point(p + 3) = {0, s * 37, -36};
  Point(p + 4) = {0, s * 14, -44};
  Point(p + 5) = {0, s * 8, -54};
  Point(p + 6) = {0, s * 8, -132};
  Point(p + 7) = {0, s * 18, -148};
  Point(p + 8) = {0, s * 75, -160};
  Point(p + 9) = {0, s * 75, -172};
  Circle(p) = {1, 2, p};
  For i In {1 : 9}
    Line(p + i) = {p + i - 1, p + i};
  EndFor
EndFor
Line(40) = {19, 39};
Curve Loop(1) = {10 : 19, 40, -39, -38, -37, -36, -35, -34, -33, -32, -31, -30};
Plane Surface(1) = {1};
rail[] = Extrude {length, 0, 0} { Surface{1}; };

// the wheel: its section at x = 0, from the middle of the tread to the field side, the hub, the flange and back
Point(101) = {0, 0, 0};
Point(102) = {0, 60, 0};
Point(103) = {0, 62, 2};
Point(104) = {0, 62, tread - hub};
Point(105) = {0, -68, tread - hub};
Point(106) = {0, -68, -16};
Point(107) = {0, -62, -27};
Point(108) = {0, -53, -28};
Point(109) = {0, -46, -19};
Point(110) = {0, -40, -6};
Point(111) = {0, -28, 0};
For i In {101 : 111}
  Line(i) = {i, 101 + (i - 100) % 11};
EndFor
Curve Loop(101) = {101 : 111};
Plane Surface(101) = {101};
wheel[] = Extrude { {0, 1, 0}, {0, 0, tread}, -sweep } { Surface{101}; };

Physical Volume("rail", 1) = {rail[1]};
Physical Volume("wheel", 2) = {wheel[1]};
Physical Surface("middle", 1) = {1, 101};  // x = 0, of both
Physical Surface("crown", 2) = {rail[2], rail[22]};
Physical Surface("foot", 3) = {rail[12]};
Physical Surface("tread", 4) = {wheel[2], wheel[12]};
Physical Surface("hub", 5) = {wheel[5]};

Field[1] = MathEval;
Field[1].F = Sprintf("Min(%g, %g + %g * Max(0, Sqrt(x*x + y*y + z*z) - %g))", coarse, fine, growth, near);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
