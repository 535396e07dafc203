/* clip.c -- which part of a nonmortar facet sees a mortar facet along its normals (eq. 4.4), as quadrature points.

   The side of a mortar node y on which the ray from x(xi) along n(xi) passes is the sign of
       f(xi) = cross(x(xi) - y, n(xi)),
   a polynomial of twice the facet's order. A ray meets a mortar facet where the signs of its two ends differ, so the
   ends of a piece are roots of f or ends of the nonmortar facet. f depends on the nonmortar facet and one mortar node:
   neighbours in a chain of mortar facets share the roots of their common node to the last bit, and their pieces neither
   overlap nor leave a hole. Nothing is assumed about where a far end projects, or whether it does.

   Reference:
     [1] M. A. Puso, T. A. Laursen, A mortar segment-to-segment contact method for large deformation solid mechanics,
         Comput. Methods Appl. Mech. Engng 193 (2004). */
#include "kernel/clip.h"
#include "kernel/roots.h"
#include "kernel/facetpolygon.h"

/* Pieces below this share of the facet are skipped: their ends differ by little more than roundoff. */
static const PetscReal SHORTEST_PIECE = 1e-12;

enum { MAX_ORDER = 2, MAX_CUTS = 2 + 2 * 2 * MAX_ORDER }; /* two ends of the facet, the roots of two mortar ends */

ClipFacet ClipFacetFrom(PetscInt dim, const PetscReal origin[], const ClipFacet *facet, PetscReal X[])
{
  for (PetscInt i = 0; i < dim * ElementNumNodes(facet->type); i++) X[i] = facet->X[i] - origin[i % dim];
  return (ClipFacet){facet->type, X, facet->N};
}

/* Positive if b points to the left of a. */
static PetscReal Cross_Private(const PetscReal a[], const PetscReal b[])
{
  return a[0] * b[1] - a[1] * b[0];
}

/* f in the form that does not cancel near its roots. */
static PetscReal Side_Private(const PetscReal x[], const PetscReal n[], const PetscReal y[])
{
  const PetscReal r[2] = {x[0] - y[0], x[1] - y[1]};

  return Cross_Private(r, n);
}

/* x, and n not normalised, at xi; returns |dx/dxi|. */
static PetscReal RayAt_Private(const ClipFacet *facet, PetscReal xi, PetscReal x[], PetscReal n[])
{
  PetscReal       phi[ELEMENT_MAX_NODES];
  const PetscReal measure = ElementSurface(facet->type, facet->X, &xi, x, phi, NULL);

  n[0] = n[1] = 0.;
  for (PetscInt i = 0; i < ElementNumNodes(facet->type); i++) {
    for (PetscInt k = 0; k < 2; k++) n[k] += phi[i] * facet->N[2 * i + k];
  }
  return measure;
}

/* sum phi_i V_i = C_0 + C_1 xi + C_2 xi^2. [in] V - [num_nodes][2]; [out] C - [MAX_ORDER + 1][2] */
static void Monomials_Private(ElementType type, const PetscReal V[], PetscReal C[][2])
{
  for (PetscInt k = 0; k < 2; k++) {
    const PetscReal first = V[k], rise = V[2 + k] - first;
    const PetscReal bulge = ElementOrder(type) == 2 ? 4. * V[4 + k] - 2. * (first + V[2 + k]) : 0.;

    C[0][k] = first;
    C[1][k] = rise + bulge;
    C[2][k] = -bulge;
  }
}

/* Roots of f between the facet's ends, ascending. Returns their number. [out] roots - [2 * MAX_ORDER] */
static PetscInt Project_Private(const ClipFacet *facet, const PetscReal y[], PetscReal roots[])
{
  const PetscInt order = ElementOrder(facet->type);
  PetscReal      R[MAX_ORDER + 1][2], N[MAX_ORDER + 1][2], c[2 * MAX_ORDER + 1] = {0.};

  Monomials_Private(facet->type, facet->X, R);
  Monomials_Private(facet->type, facet->N, N);
  for (PetscInt k = 0; k < 2; k++) R[0][k] -= y[k];
  for (PetscInt i = 0; i <= order; i++) {
    for (PetscInt j = 0; j <= order; j++) c[i + j] += Cross_Private(R[i], N[j]);
  }
  return RootsInside(2 * order, c, roots);
}

/* Where a ray meets a mortar facet whose ends lie on different sides of it: the root of
   f_0 + b eta + c eta^2 = 0 between 0 and 1, by the formula that does not cancel. [in] f - of its nodes [num_nodes] */
static PetscReal Meet_Private(ElementType type, const PetscReal f[])
{
  const PetscReal sense = f[1] > f[0] ? 1. : -1., rise = sense * (f[1] - f[0]); /* made to rise from below zero */
  const PetscReal bulge = ElementOrder(type) == 2 ? sense * (4. * f[2] - 2. * (f[0] + f[1])) : 0.;
  const PetscReal b = rise + bulge, c = -bulge, root = PetscSqrtReal(PetscMax(b * b - 4. * c * sense * f[0], 0.));
  const PetscReal eta = b > 0. ? -2. * sense * f[0] / (b + root) : 0.5 * (root - b) / c;

  if (!(rise > 0.)) return 0.5; /* equal only by roundoff */
  return PetscMin(PetscMax(eta, 0.), 1.);
}

/* The Gauss points of the piece between two cuts, where every ray meets the mortar facet (eq. 4.4).
   [in] cuts - [2]; [out] points - [num_gauss] */
static void AddPiece_Private(const ClipFacet *nonmortar, const ClipFacet *mortar, const PetscReal cuts[],
                             PetscInt num_gauss, ClipPoint points[])
{
  const PetscInt num_nodes = ElementNumNodes(mortar->type);
  PetscReal      s[CLIP_MAX_GAUSS], w[CLIP_MAX_GAUSS];

  GaussLine(num_gauss, s, w);
  for (PetscInt q = 0; q < num_gauss; q++) {
    const PetscReal xi = (1. - s[q]) * cuts[0] + s[q] * cuts[1];
    PetscReal       x[2], y[2], n[2], f[ELEMENT_MAX_FACET_NODES], phi[ELEMENT_MAX_NODES];
    const PetscReal measure = RayAt_Private(nonmortar, xi, x, n);
    PetscReal       eta;

    for (PetscInt i = 0; i < num_nodes; i++) f[i] = Side_Private(x, n, &mortar->X[2 * i]);
    eta = Meet_Private(mortar->type, f);
    ElementSurface(mortar->type, mortar->X, &eta, y, phi, NULL);
    points[q]        = (ClipPoint){.xi = {xi, 0.}, .eta = {eta, 0.}, .share = w[q] * (cuts[1] - cuts[0])};
    points[q].weight = points[q].share * measure;
    points[q].gap    = ((y[0] - x[0]) * n[0] + (y[1] - x[1]) * n[1]) / PetscSqrtReal(n[0] * n[0] + n[1] * n[1]);
  }
}

/* 0, the roots of both mortar ends inside (0,1), and 1, in ascending order. Returns their number.
   [out] cuts - [MAX_CUTS] */
static PetscInt Cuts_Private(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscReal cuts[])
{
  PetscInt num_cuts = 2;

  cuts[0] = 0.;
  cuts[1] = 1.;
  for (PetscInt i = 0; i < 2; i++) {
    PetscReal      roots[2 * MAX_ORDER];
    const PetscInt num_roots = Project_Private(nonmortar, &mortar->X[2 * i], roots);

    for (PetscInt k = 0; k < num_roots; k++) {
      PetscInt place = num_cuts;

      for (; cuts[place - 1] > roots[k]; place--) cuts[place] = cuts[place - 1];
      cuts[place] = roots[k];
      num_cuts++;
    }
  }
  return num_cuts;
}

/* Whether the rays between two cuts meet the mortar facet. */
static PetscBool IsPiece_Private(const ClipFacet *nonmortar, const ClipFacet *mortar, const PetscReal cuts[])
{
  PetscReal x[2], n[2];

  if (cuts[1] - cuts[0] < SHORTEST_PIECE) return PETSC_FALSE;
  RayAt_Private(nonmortar, 0.5 * (cuts[0] + cuts[1]), x, n);
  return (PetscBool)(Side_Private(x, n, &mortar->X[0]) * Side_Private(x, n, &mortar->X[2]) <
                     0.); /* ends on both sides */
}

PetscInt ClipLines(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscInt num_gauss, ClipPoint points[])
{
  PetscReal       cuts[MAX_CUTS], X[2 * ELEMENT_MAX_FACET_NODES], Y[2 * ELEMENT_MAX_FACET_NODES];
  const ClipFacet own        = ClipFacetFrom(2, nonmortar->X, nonmortar, X);
  const ClipFacet other      = ClipFacetFrom(2, nonmortar->X, mortar, Y);
  const PetscInt  num_cuts   = Cuts_Private(&own, &other, cuts);
  PetscInt        num_points = 0;

  for (PetscInt i = 0; i + 1 < num_cuts && num_points + num_gauss <= CLIP_MAX_POINTS; i++) {
    if (!IsPiece_Private(&own, &other, &cuts[i])) continue;
    AddPiece_Private(&own, &other, &cuts[i], num_gauss, &points[num_points]);
    num_points += num_gauss;
  }
  return num_points;
}

/* The ends of all pieces. */
static PetscInt LineEnds_Private(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscReal xi[])
{
  PetscReal       cuts[MAX_CUTS], X[2 * ELEMENT_MAX_FACET_NODES], Y[2 * ELEMENT_MAX_FACET_NODES];
  const ClipFacet own      = ClipFacetFrom(2, nonmortar->X, nonmortar, X);
  const ClipFacet other    = ClipFacetFrom(2, nonmortar->X, mortar, Y);
  const PetscInt  num_cuts = Cuts_Private(&own, &other, cuts);
  PetscInt        num      = 0;

  for (PetscInt i = 0; i + 1 < num_cuts; i++) {
    if (!IsPiece_Private(&own, &other, &cuts[i])) continue;
    for (PetscInt end = 0; end < 2; end++, num++) {
      xi[2 * num]     = cuts[i + end];
      xi[2 * num + 1] = 0.;
    }
  }
  return num;
}

PetscInt ClipCorners(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscReal xi[])
{
  return ElementDim(nonmortar->type) == 1 ? LineEnds_Private(nonmortar, mortar, xi)
                                          : ClipPolygonCorners(nonmortar, mortar, xi);
}
