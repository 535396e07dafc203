// Two spur gears in mesh, four teeth of each (a sector of the wheel). Millimetres.
//
// Module 2, 20 teeth, pressure angle 20 degrees: pitch radius 20, base radius 18.794, tip radius 22, root radius 17.5.
// The driver's centre is (-20,0), the driven wheel's (20,0), the pitch point is the origin. The line of action passes
// through it along (sin 20, cos 20). The wheels stand so that two pairs of teeth touch, half a base pitch before and
// behind the pitch point: at -A and A with A = base pitch / 2 * (sin 20, cos 20). A half turn about the origin takes one
// wheel onto the other.
//
// A flank is an involute of the base circle: with e(w) = (cos w, sin w),
//    X(t) = centre + rb ( e(s-t) + t e(s-t+90deg) ),   |X - centre| = rb sqrt(1+t^2),   radius of curvature rb t,
// where s is the angle at which it leaves the base circle. Below the base circle a flank goes on along the radius to a
// fillet on the root circle.
// gmsh -2 -order 2 -format msh41 gears.geo
// Cells of second order keep the fillets round. Straight ones make the teeth 1.5 % too stiff.
SetFactory("Built-in");

module = 2; teeth = 20; alpha = 20 * Pi / 180;
rp = module * teeth / 2;
rb = rp * Cos(alpha);
ra = rp + module;
rf = rp - 1.25 * module;
rh = 12;            // bore: the hub is held here and on both cuts of the sector
rho = 0.6;          // radius of the fillet at the root
play = 0.15 * Pi / 180; // a tooth is thinner than its space by twice this angle: backs of teeth stay apart
pitch = 2 * Pi / teeth;
involute = Tan(alpha) - alpha;
half_base_pitch = Pi * module * Cos(alpha) / 2;

fine = 0.008;       // size of a triangle at the two points of contact
near = 0.07;        // radius of the two fine zones
growth = 0.20;      // size of a triangle per distance from them
coarse = 1;
samples = 80;       // points per flank; the spline through 10 of them has largest pressures that are 2.2 % too small

// The flank that touches at -A on the driver leaves the base circle at this angle.
start = -alpha + (rp * Sin(alpha) - half_base_pitch) / rb;
half_tooth = pitch / 4 - play;
tip = Sqrt(ra * ra / (rb * rb) - 1); // parameter t at the tip
below = Sqrt((rf + rho) * (rf + rho) - rho * rho); // radius at which the fillet meets the radial flank
turn = Asin(rho / (rf + rho));                      // angle between that radius and the fillet's end on the root circle

Macro Wheel
  // In: cx (centre), phase (0 or Pi turns the wheel), Out: curves[] anticlockwise, working[], hub[], surface
  curves[] = {};
  working[] = {};
  centre = newp; Point(centre) = {cx, 0, 0};
  first_centre = start - involute - half_tooth - pitch + phase; // centre line of the lowest tooth
  from = first_centre - pitch / 2;
  to = first_centre + 3.5 * pitch;
  p0 = newp; Point(p0) = {cx + rh * Cos(from), rh * Sin(from), 0};
  p1 = newp; Point(p1) = {cx + rf * Cos(from), rf * Sin(from), 0};
  c = newl; Line(c) = {p0, p1}; hub[] = {c};
  curves[] += c;
  previous = p1;
  For k In {0 : 3}
    w = first_centre + k * pitch;
    // Lower flank, mirrored: leaves the base circle at w - (half_tooth + involute).
    s = w - half_tooth - involute;
    q0 = newp; Point(q0) = {cx + rf * Cos(s - turn), rf * Sin(s - turn), 0};
    q1 = newp; Point(q1) = {cx + (rf + rho) * Cos(s - turn), (rf + rho) * Sin(s - turn), 0};
    q2 = newp; Point(q2) = {cx + below * Cos(s), below * Sin(s), 0};
    c = newl; Circle(c) = {previous, centre, q0}; curves[] += c;
    c = newl; Circle(c) = {q0, q1, q2}; curves[] += c;
    list[] = {};
    For i In {0 : samples}
      t = tip * i / samples;
      q = newp; Point(q) = {cx + rb * (Cos(s + t) + t * Sin(s + t)), rb * (Sin(s + t) - t * Cos(s + t)), 0};
      list[] += q;
    EndFor
    c = newl; Line(c) = {q2, list[0]}; curves[] += c;
    c = newl; Spline(c) = list[]; curves[] += c;
    last = list[samples];
    // Upper flank, the one that drives or is driven.
    s = w + half_tooth + involute;
    list[] = {};
    For i In {0 : samples}
      t = tip * (1 - i / samples);
      q = newp; Point(q) = {cx + rb * (Cos(s - t) - t * Sin(s - t)), rb * (Sin(s - t) + t * Cos(s - t)), 0};
      list[] += q;
    EndFor
    c = newl; Circle(c) = {last, centre, list[0]}; curves[] += c;
    c = newl; Spline(c) = list[]; curves[] += c; working[] += c;
    q2 = newp; Point(q2) = {cx + below * Cos(s), below * Sin(s), 0};
    q1 = newp; Point(q1) = {cx + (rf + rho) * Cos(s + turn), (rf + rho) * Sin(s + turn), 0};
    q0 = newp; Point(q0) = {cx + rf * Cos(s + turn), rf * Sin(s + turn), 0};
    c = newl; Line(c) = {list[samples], q2}; curves[] += c;
    c = newl; Circle(c) = {q2, q1, q0}; curves[] += c;
    previous = q0;
  EndFor
  p2 = newp; Point(p2) = {cx + rf * Cos(to), rf * Sin(to), 0};
  p3 = newp; Point(p3) = {cx + rh * Cos(to), rh * Sin(to), 0};
  c = newl; Circle(c) = {previous, centre, p2}; curves[] += c;
  c = newl; Line(c) = {p2, p3}; curves[] += c; hub[] += c;
  c = newl; Circle(c) = {p3, centre, p0}; curves[] += c; hub[] += c;
  loop = newll; Curve Loop(loop) = curves[];
  surface = news; Plane Surface(surface) = {loop};
Return

cx = -rp; phase = 0; Call Wheel;
Physical Surface("driver") = {surface};
Physical Curve("driver_hub") = hub[];
Physical Curve("driver_first") = {working[1]};
Physical Curve("driver_second") = {working[2]};

// After the half turn the driven wheel's tooth k touches where the driver's touched mirrored at the origin: the flank at
// -A is the image of the one at A.
cx = rp; phase = Pi; Call Wheel;
Physical Surface("driven") = {surface};
Physical Curve("driven_hub") = hub[];
Physical Curve("driven_first") = {working[2]};
Physical Curve("driven_second") = {working[1]};

ax = half_base_pitch * Sin(alpha);
ay = half_base_pitch * Cos(alpha);
ramp = "%g + %g * 0.5 * (Sqrt((x-(%g))*(x-(%g)) + (y-(%g))*(y-(%g))) - %g + Fabs(Sqrt((x-(%g))*(x-(%g)) + (y-(%g))*(y-(%g))) - %g))";
Field[1] = MathEval;
Field[1].F = Sprintf(ramp, fine, growth, ax, ax, ay, ay, near, ax, ax, ay, ay, near);
Field[2] = MathEval;
Field[2].F = Sprintf(ramp, fine, growth, -ax, -ax, -ay, -ay, near, -ax, -ax, -ay, -ay, near);
Field[3] = MathEval;
Field[3].F = Sprintf("%g", coarse);
Field[4] = Min;
Field[4].FieldsList = {1, 2, 3};
Background Field = 4;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.Algorithm = 6;
