/* clip.c -- which part of a nonmortar facet sees a mortar facet along its normals, as quadrature points.

   The side of a mortar end y on which the ray from x(xi) along n(xi) passes is the sign of
       f(xi) = cross(x(xi) - y, n(xi)),
   a quadratic in xi. The ray meets a mortar facet where the signs of its two ends differ, so the ends of a piece are roots
   of f in [0,1]. f knows nothing but the nonmortar facet and one end: neighbours in a chain of mortar facets share the roots
   of their common end to the last bit, and their pieces neither overlap nor leave a hole. Nothing is assumed about where the
   far end projects, or whether it does.

   Reference:
     [1] M. A. Puso, T. A. Laursen, A mortar segment-to-segment contact method for large deformation solid mechanics (2004). */
#include <mortise/clip.h>
#include <mortise/element.h>

/* Shorter pieces are skipped, in shares of the facet (numerics.md 3.3): their integrals are roundoff. */
static const PetscReal SHORTEST_PIECE = 1e-12;

/* An end that projects farther away than this many facet lengths has no projection near the facet. */
static const PetscReal FARTHEST_ROOT = 1e8;

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

/* Real roots of f(xi) = c0 + c1 xi + c2 xi^2, at most two. The first one, found where *regular is set, belongs to a ray that
   has not yet crossed its neighbours on the way to y: there the sign of f' is that of cross(E, n), as it is for y on the facet.
   The formulas never subtract like quantities, and parallel normals (c2 = 0) need no case of their own. */
static PetscInt Roots_Private(const PetscReal X[], const PetscReal N[], const PetscReal y[], PetscReal roots[],
                              PetscBool *regular)
{
  const PetscReal E[2] = {X[2] - X[0], X[3] - X[1]}, dN[2] = {N[2] - N[0], N[3] - N[1]},
                  r[2]    = {X[0] - y[0], X[1] - y[1]};
  const PetscReal mean[2] = {N[0] + N[2], N[1] + N[3]}, sense = Cross_Private(E, mean) > 0. ? 1. : -1.;
  const PetscReal c0 = sense * Cross_Private(r, N), c2 = sense * Cross_Private(E, dN);
  const PetscReal c1   = sense * (Cross_Private(E, N) + Cross_Private(r, dN));
  const PetscReal disc = c1 * c1 - 4. * c2 * c0;
  PetscInt        num  = 0;
  PetscReal       q;

  *regular = PETSC_FALSE;
  if (!(disc >= 0.)) return 0; /* no ray passes through y */
  /* sense makes f' > 0 at the regular root, which is (-c1 + sqrt(disc)) / (2 c2) */
  if (c1 > 0.) {
    q        = -0.5 * (c1 + PetscSqrtReal(disc));
    *regular = Quotient_Private(c0, q, &roots[num]);
    num += *regular ? 1 : 0;
    num += Quotient_Private(q, c2, &roots[num]) ? 1 : 0;
  } else {
    q        = 0.5 * (-c1 + PetscSqrtReal(disc));
    *regular = Quotient_Private(q, c2, &roots[num]);
    num += *regular ? 1 : 0;
    num += Quotient_Private(c0, q, &roots[num]) ? 1 : 0;
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

/* The rays between begin and end that meet the mortar facet, as Gauss points. Returns their number. */
static PetscInt AddPiece_Private(const PetscReal X[], const PetscReal N[], const PetscReal Y[], const PetscReal ends[2],
                                 PetscInt num_gauss, ClipPoint points[])
{
  const PetscReal length = PetscSqrtReal(PetscSqr(X[2] - X[0]) + PetscSqr(X[3] - X[1]));
  PetscReal       s[CLIP_MAX_POINTS], w[CLIP_MAX_POINTS];

  GaussLine(num_gauss, s, w);
  for (PetscInt q = 0; q < num_gauss; q++) {
    const PetscReal xi = (1. - s[q]) * ends[0] + s[q] * ends[1];
    PetscReal       x[2], y[2], n[2], f[2], eta;

    Interpolate_Private(X, xi, x);
    Interpolate_Private(N, xi, n);
    for (PetscInt i = 0; i < 2; i++) f[i] = Side_Private(x, n, &Y[2 * i]);
    eta = f[0] == f[1] ? 0.5 : f[0] / (f[0] - f[1]); /* f is linear along the mortar facet; equal only by roundoff */
    eta = PetscMin(PetscMax(eta, 0.), 1.);
    Interpolate_Private(Y, eta, y);
    points[q]     = (ClipPoint){.xi = {xi, 0.}, .eta = {eta, 0.}, .weight = w[q] * (ends[1] - ends[0]) * length};
    points[q].gap = ((y[0] - x[0]) * n[0] + (y[1] - x[1]) * n[1]) / PetscSqrtReal(n[0] * n[0] + n[1] * n[1]);
  }
  return num_gauss;
}

PetscInt ClipLines(const PetscReal X[], const PetscReal N[], const PetscReal Y[], PetscInt num_gauss,
                   ClipPoint points[])
{
  PetscReal cuts[6]  = {0., 1.};
  PetscInt  num_cuts = 2, num_points = 0;

  for (PetscInt i = 0; i < 2; i++) {
    PetscReal roots[2];
    PetscBool regular;
    PetscInt  num_roots = Roots_Private(X, N, &Y[2 * i], roots, &regular);

    for (PetscInt k = 0; k < num_roots; k++) {
      PetscInt place = num_cuts;

      if (!(roots[k] > 0. && roots[k] < 1.)) continue;
      for (; cuts[place - 1] > roots[k]; place--) cuts[place] = cuts[place - 1];
      cuts[place] = roots[k];
      num_cuts++;
    }
  }
  for (PetscInt i = 0; i + 1 < num_cuts; i++) {
    PetscReal x[2], n[2];

    if (cuts[i + 1] - cuts[i] < SHORTEST_PIECE) continue;
    Interpolate_Private(X, 0.5 * (cuts[i] + cuts[i + 1]), x);
    Interpolate_Private(N, 0.5 * (cuts[i] + cuts[i + 1]), n);
    if (Side_Private(x, n, &Y[0]) * Side_Private(x, n, &Y[2]) >= 0.) continue; /* both ends on one side of the ray */
    num_points += AddPiece_Private(X, N, Y, &cuts[i], num_gauss, &points[num_points]);
  }
  return num_points;
}
