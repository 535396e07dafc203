/* clip.c -- which part of a nonmortar facet sees a mortar facet along its normals (T14), as quadrature points.

   The side of a mortar end y on which the ray from x(xi) along n(xi) passes is the sign of
       f(xi) = cross(x(xi) - y, n(xi)),
   a quadratic in xi. A ray meets a mortar facet where the signs of its two ends differ, so the ends of a piece are
   roots of f or ends of the nonmortar facet. f depends on the nonmortar facet and one mortar node: neighbours in a
   chain of mortar facets share the roots of their common node to the last bit, and their pieces neither overlap nor
   leave a hole. Nothing is assumed about where a far end projects, or whether it does.

   Reference:
     [1] M. A. Puso, T. A. Laursen, A mortar segment-to-segment contact method for large deformation solid mechanics,
         Comput. Methods Appl. Mech. Engng 193 (2004). */
#include <mortise/clip.h>
#include <mortise/element.h>

/* Pieces below this share of the facet are skipped: their ends differ by little more than roundoff. */
static const PetscReal SHORTEST_PIECE = 1e-12;

/* Beyond this many facet lengths a root has lost the digits that the piece above asks for. */
static const PetscReal FARTHEST_ROOT = 1e8;

enum { MAX_CUTS = 6 }; /* two ends of the facet, two roots of each mortar end */

/* Positive if b points to the left of a. */
static PetscReal Cross_Private(const PetscReal a[], const PetscReal b[])
{
  return a[0] * b[1] - a[1] * b[0];
}

/* v(xi) = (1 - xi) V_0 + xi V_1 */
static void Interpolate_Private(const PetscReal V[], PetscReal xi, PetscReal v[])
{
  for (PetscInt k = 0; k < 2; k++) v[k] = (1. - xi) * V[k] + xi * V[2 + k];
}

/* f(xi) in the form that does not cancel near its roots. */
static PetscReal Side_Private(const PetscReal x[], const PetscReal n[], const PetscReal y[])
{
  const PetscReal r[2] = {x[0] - y[0], x[1] - y[1]};

  return Cross_Private(r, n);
}

/* root = a / b unless that is too far away to matter. */
static PetscBool Quotient_Private(PetscReal a, PetscReal b, PetscReal *root)
{
  if (!(PetscAbsReal(a) < FARTHEST_ROOT * PetscAbsReal(b))) return PETSC_FALSE;
  *root = a / b;
  return PETSC_TRUE;
}

/* Real roots of f = c0 + c1 xi + c2 xi^2, at most two. The first one, there if *regular is set, belongs to a ray that
   has not yet crossed its neighbours on its way to y: f' has the sign of cross(E, n) there, as it has for y on the
   facet. Neither formula subtracts like quantities, and parallel normals (c2 = 0) need no case of their own.
   [out] roots - [2]; returns their number */
static PetscInt Roots_Private(const PetscReal X[], const PetscReal N[], const PetscReal y[], PetscReal roots[],
                              PetscBool *regular)
{
  const PetscReal E[2] = {X[2] - X[0], X[3] - X[1]}, r[2] = {X[0] - y[0], X[1] - y[1]};
  const PetscReal dN[2] = {N[2] - N[0], N[3] - N[1]}, mean[2] = {N[0] + N[2], N[1] + N[3]};
  const PetscReal sense = Cross_Private(E, mean) > 0. ? 1. : -1.; /* makes f' > 0 at the regular root */
  const PetscReal c0 = sense * Cross_Private(r, N), c1 = sense * (Cross_Private(E, N) + Cross_Private(r, dN));
  const PetscReal c2 = sense * Cross_Private(E, dN), disc = c1 * c1 - 4. * c2 * c0;
  PetscReal       q;
  PetscInt        num = 0;

  *regular = PETSC_FALSE;
  if (!(disc >= 0.)) return 0; /* no ray passes through y */
  if (c1 > 0.) {               /* regular: (-c1 + sqrt(disc)) / (2 c2) = c0 / q */
    q        = -0.5 * (c1 + PetscSqrtReal(disc));
    *regular = Quotient_Private(c0, q, &roots[0]);
    num      = *regular ? 1 : 0;
    if (Quotient_Private(q, c2, &roots[num])) num++;
  } else {
    q        = -0.5 * (c1 - PetscSqrtReal(disc));
    *regular = Quotient_Private(q, c2, &roots[0]);
    num      = *regular ? 1 : 0;
    if (Quotient_Private(c0, q, &roots[num])) num++;
  }
  return num;
}

PetscBool ClipProject(const PetscReal X[], const PetscReal N[], const PetscReal y[], PetscReal *xi)
{
  PetscReal roots[2];
  PetscBool regular;

  Roots_Private(X, N, y, roots, &regular);
  if (regular) *xi = roots[0];
  return regular;
}

/* The Gauss points of the piece between two cuts, where every ray meets the mortar facet (T14).
   [in] cuts - [2]; [out] points - [num_gauss] */
static void AddPiece_Private(const PetscReal X[], const PetscReal N[], const PetscReal Y[], const PetscReal cuts[],
                             PetscInt num_gauss, ClipPoint points[])
{
  const PetscReal length = PetscSqrtReal(PetscSqr(X[2] - X[0]) + PetscSqr(X[3] - X[1]));
  PetscReal       s[CLIP_MAX_GAUSS], w[CLIP_MAX_GAUSS];

  GaussLine(num_gauss, s, w);
  for (PetscInt q = 0; q < num_gauss; q++) {
    const PetscReal xi = (1. - s[q]) * cuts[0] + s[q] * cuts[1];
    PetscReal       x[2], y[2], n[2], f[2], eta;

    Interpolate_Private(X, xi, x);
    Interpolate_Private(N, xi, n);
    for (PetscInt i = 0; i < 2; i++) f[i] = Side_Private(x, n, &Y[2 * i]);
    eta = f[0] == f[1] ? 0.5 : f[0] / (f[0] - f[1]); /* f is linear along the mortar facet; equal only by roundoff */
    eta = PetscMin(PetscMax(eta, 0.), 1.);
    Interpolate_Private(Y, eta, y);
    points[q]     = (ClipPoint){.xi = {xi, 0.}, .eta = {eta, 0.}, .weight = w[q] * (cuts[1] - cuts[0]) * length};
    points[q].gap = ((y[0] - x[0]) * n[0] + (y[1] - x[1]) * n[1]) / PetscSqrtReal(n[0] * n[0] + n[1] * n[1]);
  }
}

/* 0, the roots of both mortar ends inside (0,1), and 1, in ascending order. Returns their number.
   [out] cuts - [MAX_CUTS] */
static PetscInt Cuts_Private(const PetscReal X[], const PetscReal N[], const PetscReal Y[], PetscReal cuts[])
{
  PetscInt num_cuts = 2;

  cuts[0] = 0.;
  cuts[1] = 1.;
  for (PetscInt i = 0; i < 2; i++) {
    PetscReal      roots[2];
    PetscBool      regular;
    const PetscInt num_roots = Roots_Private(X, N, &Y[2 * i], roots, &regular);

    for (PetscInt k = 0; k < num_roots; k++) {
      PetscInt place = num_cuts;

      if (!(roots[k] > 0. && roots[k] < 1.)) continue;
      for (; cuts[place - 1] > roots[k]; place--) cuts[place] = cuts[place - 1];
      cuts[place] = roots[k];
      num_cuts++;
    }
  }
  return num_cuts;
}

PetscInt ClipLines(const PetscReal X[], const PetscReal N[], const PetscReal Y[], PetscInt num_gauss,
                   ClipPoint points[])
{
  PetscReal      cuts[MAX_CUTS];
  const PetscInt num_cuts   = Cuts_Private(X, N, Y, cuts);
  PetscInt       num_points = 0;

  for (PetscInt i = 0; i + 1 < num_cuts; i++) {
    const PetscReal middle = 0.5 * (cuts[i] + cuts[i + 1]);
    PetscReal       x[2], n[2];

    if (cuts[i + 1] - cuts[i] < SHORTEST_PIECE) continue;
    Interpolate_Private(X, middle, x);
    Interpolate_Private(N, middle, n);
    if (Side_Private(x, n, &Y[0]) * Side_Private(x, n, &Y[2]) >= 0.) continue; /* both ends on one side of the ray */
    AddPiece_Private(X, N, Y, &cuts[i], num_gauss, &points[num_points]);
    num_points += num_gauss;
  }
  return num_points;
}
