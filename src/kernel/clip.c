/* clip.c -- which part of a nonmortar facet sees a mortar facet along its normals (eq. 4.4), as quadrature
   points.

   In the plane. The side of a mortar node y on which the ray from x(xi) along n(xi) passes is the sign of
       f(xi) = cross(x(xi) - y, n(xi)), a polynomial of twice the facet's order. A ray meets a mortar facet
   where the signs of its two ends differ. So the ends of a piece are roots of f or ends of the nonmortar
   facet. f depends on the nonmortar facet and one mortar node. Neighbours in a chain of mortar facets share
   the roots of their common node to the last bit. Their pieces neither overlap nor leave a hole. The
   projection of a far end may exist or not.

   In space. Both facets are projected onto the auxiliary plane of the nonmortar one [1], which is normal to
   the sum of its nodal normals. There they are polygons: triangles and quads as they are, facets of second
   order and quads that are not convex in parts [2]. The common part of two such polygons is cut into
   triangles, each with a quadrature rule.

   A part is a piece of its facet's reference cell, mapped linearly or bilinearly. A point of the plane is
   pulled back to the reference cell of the nonmortar facet by the map of its part. Parts cover the reference
   cell exactly once, however the facet is curved. This xi, not the point of the plane, is the quadrature
   point. Its position is x on the true facet, its weight has the true measure |dx/dxi|. The point opposite to
   x is found on the true mortar facet. Hence the integrals are those of the facet's surface, and linear
   fields on flat interfaces pass from side to side without error.

   References:
     [1] M. A. Puso, T. A. Laursen, A mortar segment-to-segment contact method for large deformation solid
     mechanics,
         Comput. Methods Appl. Mech. Engng 193 (2004).
     [2] M. A. Puso, T. A. Laursen, J. Solberg, A segment-to-segment mortar contact method for quadratic
     elements and large
         deformations, Comput. Methods Appl. Mech. Engng 197 (2008). */
#include "kernel/clip.h"
#include "kernel/facetpolygon.h"
#include "kernel/polygon.h"
#include "kernel/roots.h"
#include "kernel/vector.h"

/* Pieces below this share of the facet are skipped: their ends differ by little more than roundoff. */
static const PetscReal SHORTEST_PIECE = 1e-12;

enum { MAX_ORDER = 2, MAX_CUTS = 2 + 2 * 2 * MAX_ORDER }; /* two ends of the facet, the roots of two mortar ends */

/* A point counts as inside only this share of the size away from the edges, so that roundoff cannot put it
   outside. */
static const PetscReal INSIDE = 1e-10;

/* Permitted excess of a point beyond a curved mortar facet, in reference coordinates: polygons have straight
   edges, the facet curved ones. */
static const PetscReal CURVED_EXCESS = 0.25;

static const PetscReal CLIP_NEWTON_STEP = 1e-12;

enum { NEWTON_MAX_STEPS = 20 };

/* A facet relative to an origin. If the origin is a node of the facet, points in a plane across an axis stay
   in it exactly, however far it is. Gaps then have the accuracy of differences of coordinates.
   [in] origin - [dim]; [out] X - nodes of the result [num_nodes][dim] */
static ClipFacet ClipFacetFrom_Private(PetscInt dim, const PetscReal origin[], const ClipFacet *facet, PetscReal X[])
{
  for (PetscInt i = 0; i < dim * ElementNumNodes(facet->type); i++) X[i] = facet->X[i] - origin[i % dim];
  return (ClipFacet){facet->type, X, facet->N};
}

/* f in the form without cancellation near its roots. */
static PetscReal ClipRaySide_Private(const PetscReal x[], const PetscReal n[], const PetscReal y[])
{
  const PetscReal r[2] = {x[0] - y[0], x[1] - y[1]};

  return VectorCrossPlane(r, n);
}

/* x, and n not normalized, at xi; returns |dx/dxi|. */
static PetscReal ClipRayAt_Private(const ClipFacet *facet, PetscReal xi, PetscReal x[], PetscReal n[])
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
static void ClipMonomials_Private(ElementType type, const PetscReal V[], PetscReal C[][2])
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
static PetscInt ClipFindRoots_Private(const ClipFacet *facet, const PetscReal y[], PetscReal roots[])
{
  const PetscInt order = ElementOrder(facet->type);
  PetscReal      R[MAX_ORDER + 1][2], N[MAX_ORDER + 1][2], c[2 * MAX_ORDER + 1] = {0.};

  ClipMonomials_Private(facet->type, facet->X, R);
  ClipMonomials_Private(facet->type, facet->N, N);
  for (PetscInt k = 0; k < 2; k++) R[0][k] -= y[k];
  for (PetscInt i = 0; i <= order; i++) {
    for (PetscInt j = 0; j <= order; j++) c[i + j] += VectorCrossPlane(R[i], N[j]);
  }
  return RootsInside(2 * order, c, roots);
}

/* The intersection of a ray with a mortar facet whose ends lie on different sides of it. This is the root of
   f_0 + b eta + c eta^2 = 0 between 0 and 1, by the formula without cancellation.
   [in] f - of its nodes [num_nodes] */
static PetscReal ClipMeetLine_Private(ElementType type, const PetscReal f[])
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
static void ClipAddPiece_Private(const ClipFacet *nonmortar, const ClipFacet *mortar, const PetscReal cuts[],
                                 PetscInt num_gauss, ClipPoint points[])
{
  const PetscInt num_nodes = ElementNumNodes(mortar->type);
  PetscReal      s[CLIP_MAX_GAUSS], w[CLIP_MAX_GAUSS];

  QuadratureLine(num_gauss, s, w);
  for (PetscInt q = 0; q < num_gauss; q++) {
    const PetscReal xi = (1. - s[q]) * cuts[0] + s[q] * cuts[1];
    PetscReal       x[2], y[2], n[2], f[ELEMENT_MAX_FACET_NODES], phi[ELEMENT_MAX_NODES];
    const PetscReal measure = ClipRayAt_Private(nonmortar, xi, x, n);
    PetscReal       eta;

    for (PetscInt i = 0; i < num_nodes; i++) f[i] = ClipRaySide_Private(x, n, &mortar->X[2 * i]);
    eta = ClipMeetLine_Private(mortar->type, f);
    ElementSurface(mortar->type, mortar->X, &eta, y, phi, NULL);
    points[q]        = (ClipPoint){.xi = {xi, 0.}, .eta = {eta, 0.}, .share = w[q] * (cuts[1] - cuts[0])};
    points[q].weight = points[q].share * measure;
    points[q].gap    = ((y[0] - x[0]) * n[0] + (y[1] - x[1]) * n[1]) / VectorNorm(2, n);
  }
}

/* 0, the roots of both mortar ends inside (0,1), and 1, in ascending order. Returns their number.
   [out] cuts - [MAX_CUTS] */
static PetscInt ClipFindCuts_Private(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscReal cuts[])
{
  PetscInt num_cuts = 2;

  cuts[0] = 0.;
  cuts[1] = 1.;
  for (PetscInt i = 0; i < 2; i++) {
    PetscReal      roots[2 * MAX_ORDER];
    const PetscInt num_roots = ClipFindRoots_Private(nonmortar, &mortar->X[2 * i], roots);

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
static PetscBool ClipIsPiece_Private(const ClipFacet *nonmortar, const ClipFacet *mortar, const PetscReal cuts[])
{
  PetscReal x[2], n[2];

  if (cuts[1] - cuts[0] < SHORTEST_PIECE) return PETSC_FALSE;
  ClipRayAt_Private(nonmortar, 0.5 * (cuts[0] + cuts[1]), x, n);
  return (PetscBool)(ClipRaySide_Private(x, n, &mortar->X[0]) * ClipRaySide_Private(x, n, &mortar->X[2]) <
                     0.); /* ends on both sides */
}

PetscInt ClipLines(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscInt num_gauss, ClipPoint points[])
{
  PetscReal       cuts[MAX_CUTS], X[2 * ELEMENT_MAX_FACET_NODES], Y[2 * ELEMENT_MAX_FACET_NODES];
  const ClipFacet own        = ClipFacetFrom_Private(2, nonmortar->X, nonmortar, X);
  const ClipFacet other      = ClipFacetFrom_Private(2, nonmortar->X, mortar, Y);
  const PetscInt  num_cuts   = ClipFindCuts_Private(&own, &other, cuts);
  PetscInt        num_points = 0;

  for (PetscInt i = 0; i + 1 < num_cuts && num_points + num_gauss <= CLIP_MAX_POINTS; i++) {
    if (!ClipIsPiece_Private(&own, &other, &cuts[i])) continue;
    ClipAddPiece_Private(&own, &other, &cuts[i], num_gauss, &points[num_points]);
    num_points += num_gauss;
  }
  return num_points;
}

/* The ends of all pieces. */
static PetscInt ClipLineCorners_Private(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscReal xi[])
{
  PetscReal       cuts[MAX_CUTS], X[2 * ELEMENT_MAX_FACET_NODES], Y[2 * ELEMENT_MAX_FACET_NODES];
  const ClipFacet own      = ClipFacetFrom_Private(2, nonmortar->X, nonmortar, X);
  const ClipFacet other    = ClipFacetFrom_Private(2, nonmortar->X, mortar, Y);
  const PetscInt  num_cuts = ClipFindCuts_Private(&own, &other, cuts);
  PetscInt        num      = 0;

  for (PetscInt i = 0; i + 1 < num_cuts; i++) {
    if (!ClipIsPiece_Private(&own, &other, &cuts[i])) continue;
    for (PetscInt end = 0; end < 2; end++, num++) {
      xi[2 * num]     = cuts[i + end];
      xi[2 * num + 1] = 0.;
    }
  }
  return num;
}

/* --- in space ------------------------------------------------------------------------------------------- */

/* Newton's method for the point of a plane cell at p, from the start xi. The last step has no bound: it may
   be roundoff, which is large in needles. Returns whether xi is a number.
   [in] P - [num_nodes][2]; [in,out] xi - [2] */
static PetscBool ClipPullBack_Private(ElementType type, const PetscReal P[], const PetscReal p[], PetscReal xi[])
{
  PetscReal step = PETSC_MAX_REAL;

  for (PetscInt it = 0; it < NEWTON_MAX_STEPS && step > CLIP_NEWTON_STEP; it++) {
    PetscReal x[2], phi[ELEMENT_MAX_NODES], grad[2 * ELEMENT_MAX_NODES];

    if (ElementMap(type, P, xi, x, phi, grad) == 0.) return PETSC_FALSE;
    step = 0.;
    for (PetscInt l = 0; l < 2; l++) {
      PetscReal change = 0.; /* d xi_l / d x = sum_i (node i)_l d phi_i / d x */

      for (PetscInt i = 0; i < ElementNumNodes(type); i++)
        change += ElementNode(type, i)[l] * (grad[2 * i] * (p[0] - x[0]) + grad[2 * i + 1] * (p[1] - x[1]));
      xi[l] += change;
      step = PetscMax(step, PetscAbsReal(change));
    }
  }
  return PetscIsInfOrNanReal(xi[0]) || PetscIsInfOrNanReal(xi[1]) ? PETSC_FALSE : PETSC_TRUE;
}

/* The place of (s, t) under a bilinear map and its derivatives along s and t; returns their cross product.
   [out] x - [2]; [out] d - [2][2] */
static PetscReal ClipMapBilinear_Private(const PetscReal map[], const PetscReal s[], PetscReal x[], PetscReal d[])
{
  for (PetscInt k = 0; k < 2; k++) {
    d[k]     = map[2 + k] + map[6 + k] * s[1];
    d[2 + k] = map[4 + k] + map[6 + k] * s[0];
    x[k]     = map[k] + map[2 + k] * s[0] + d[2 + k] * s[1];
  }
  return d[0] * d[3] - d[1] * d[2];
}

/* Pulls p back to the facet's reference cell by the map of a part with Newton's method; one step where the
   map is affine. Returns the ratio of areas there and in the plane, 0 where it fails. [out] xi - [2] */
static PetscReal ClipPullBackPart_Private(const FacetPart *part, const PetscReal p[], PetscReal xi[])
{
  const PetscInt max_steps = part->affine ? 1 : NEWTON_MAX_STEPS;
  PetscReal      s[2] = {0.5, 0.5}, x[2], d[4], step = PETSC_MAX_REAL, area;

  for (PetscInt it = 0; it < max_steps && step > CLIP_NEWTON_STEP; it++) {
    PetscReal change[2], r[2];

    area = ClipMapBilinear_Private(part->to_plane, s, x, d);
    if (area == 0.) return 0.;
    for (PetscInt k = 0; k < 2; k++) r[k] = p[k] - x[k];
    change[0] = (r[0] * d[3] - r[1] * d[2]) / area;
    change[1] = (d[0] * r[1] - d[1] * r[0]) / area;
    for (PetscInt k = 0; k < 2; k++) s[k] += change[k];
    step = PetscMax(PetscAbsReal(change[0]), PetscAbsReal(change[1]));
  }
  area = ClipMapBilinear_Private(part->to_plane, s, x, d);
  return area > 0. ? PetscAbsReal(ClipMapBilinear_Private(part->to_reference, s, xi, d)) / area : 0.;
}

/* The point of the mortar facet at p, by the map of its part. Where that is not the facet's own map, the
   point is then found on the true facet. The map of the part counts where the true facet gives a point far
   away. [out] eta - [2] */
static PetscBool ClipPullBackMortar_Private(const FacetPolygon *mortar, const FacetPart *part, const PetscReal p[],
                                            PetscReal eta[])
{
  PetscReal true_eta[2];

  if (ClipPullBackPart_Private(part, p, eta) == 0.) return PETSC_FALSE;
  if (mortar->num_parts == 1) return PETSC_TRUE;
  for (PetscInt k = 0; k < 2; k++) true_eta[k] = eta[k];
  if (ClipPullBack_Private(mortar->facet->type, mortar->plane, p, true_eta) &&
      PetscAbsReal(true_eta[0] - eta[0]) < CURVED_EXCESS && PetscAbsReal(true_eta[1] - eta[1]) < CURVED_EXCESS) {
    for (PetscInt k = 0; k < 2; k++) eta[k] = true_eta[k];
  }
  return PETSC_TRUE;
}

/* The quadrature point at p, of the given area in the plane. Returns whether there is one. */
static PetscBool ClipSetPoint_Private(const FacetPlane *plane, const FacetPolygon *nonmortar, const FacetPart *own,
                                      const FacetPolygon *mortar, const FacetPart *other, const PetscReal p[],
                                      ClipPoint *point)
{
  PetscReal       x[3], y[3], at[2], phi[ELEMENT_MAX_NODES];
  const PetscReal ratio = ClipPullBackPart_Private(own, p, point->xi);

  if (ratio == 0.) return PETSC_FALSE;
  point->weight = ratio * ElementSurface(nonmortar->facet->type, nonmortar->facet->X, point->xi, x, phi, NULL);
  FacetPolygonProjectPoints(plane, 1, x, at);
  if (!ClipPullBackMortar_Private(mortar, other, at, point->eta)) return PETSC_FALSE;
  ElementSurface(mortar->facet->type, mortar->facet->X, point->eta, y, phi, NULL);
  point->gap = 0.;
  for (PetscInt k = 0; k < 3; k++) point->gap += plane->Q[k] * (y[k] - x[k]);
  return PETSC_TRUE;
}

/* The triangles of a convex polygon. If the rule is exact they are between its sides and its last vertex.
   Else they are between its sides and the mean of its vertices, two more: the result does not depend on the
   first vertex. In the exact case one triangle may be the whole covered part of a facet. Returns their
   number. [in] P - [n][2]; [out] triangles - [n][3][2] */
static PetscInt ClipTriangulate_Private(PetscInt n, const PetscReal P[], PetscBool exact, PetscReal triangles[])
{
  const PetscInt num     = exact ? n - 2 : n;
  PetscReal      mean[2] = {0., 0.};

  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt k = 0; k < 2; k++) mean[k] += P[2 * i + k] / n;
  }
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = 0; k < 2; k++) {
      triangles[6 * i + k]     = exact ? P[2 * (n - 1) + k] : mean[k];
      triangles[6 * i + 2 + k] = P[2 * i + k];
      triangles[6 * i + 4 + k] = P[2 * ((i + 1) % n) + k];
    }
  }
  return num;
}

/* The planes' parts of both facets; returns whether they may meet. */
static PetscBool ClipProjectFacets_Private(const ClipFacet *nonmortar, const ClipFacet *mortar, FacetPlane *plane,
                                           FacetPolygon *own, FacetPolygon *other)
{
  FacetPolygonSetPlane(nonmortar, plane);
  FacetPolygonProject(plane, nonmortar, own);
  FacetPolygonProject(plane, mortar, other);
  if (!FacetPolygonsMeet(own, other)) return PETSC_FALSE;
  FacetPolygonSplit(plane, own);
  FacetPolygonSplit(plane, other);
  return PETSC_TRUE;
}

/* The common part of two parts; returns the number of its vertices, 0 where it has no area.
   [out] P - [POLYGON_MAX_VERTICES][2] */
static PetscInt ClipIntersectParts_Private(const FacetPart *a, const FacetPart *b, PetscReal size, PetscReal P[])
{
  const PetscInt n = PolygonIntersect(ElementNumNodes(a->type), a->plane, ElementNumNodes(b->type), b->plane,
                                      POLYGON_SAME_POINT * size, P);

  return !n || PolygonArea(n, P) < POLYGON_NO_AREA * size * size ? 0 : n;
}

static PetscInt ClipPolygonCorners_Private(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscReal xi[])
{
  PetscReal       P[2 * POLYGON_MAX_VERTICES], X[3 * ELEMENT_MAX_FACET_NODES], Y[3 * ELEMENT_MAX_FACET_NODES];
  PetscInt        num  = 0;
  const ClipFacet near = ClipFacetFrom_Private(3, nonmortar->X, nonmortar, X),
                  far  = ClipFacetFrom_Private(3, nonmortar->X, mortar, Y);
  FacetPlane   plane;
  FacetPolygon own, other;

  if (!ClipProjectFacets_Private(&near, &far, &plane, &own, &other)) return 0;
  for (PetscInt pair = 0; pair < own.num_parts * other.num_parts; pair++) {
    const FacetPart *a = &own.parts[pair / other.num_parts];
    const PetscInt   n = ClipIntersectParts_Private(a, &other.parts[pair % other.num_parts], plane.size, P);

    for (PetscInt i = 0; i < n; i++) num += ClipPullBackPart_Private(a, &P[2 * i], &xi[2 * num]) > 0. ? 1 : 0;
  }
  return num;
}

PetscInt ClipPolygons(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscInt degree, ClipPoint points[])
{
  PetscReal       xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], P[2 * POLYGON_MAX_VERTICES];
  PetscReal       X[3 * ELEMENT_MAX_FACET_NODES], Y[3 * ELEMENT_MAX_FACET_NODES];
  PetscInt        num_rule, num = 0;
  PetscBool       enough;
  FacetPlane      plane;
  FacetPolygon    own, other;
  const ClipFacet near = ClipFacetFrom_Private(3, nonmortar->X, nonmortar, X),
                  far  = ClipFacetFrom_Private(3, nonmortar->X, mortar, Y);

  if (!ClipProjectFacets_Private(&near, &far, &plane, &own, &other)) return 0;
  num_rule = QuadratureRule(ELEMENT_TRI3, degree, xi, w);
  enough   = num_rule >= ElementNumNodes(nonmortar->type) ? PETSC_TRUE
                                                          : PETSC_FALSE; /* for linearly independent shape functions */
  for (PetscInt pair = 0; pair < own.num_parts * other.num_parts; pair++) {
    const FacetPart *a = &own.parts[pair / other.num_parts], *b = &other.parts[pair % other.num_parts];
    const PetscInt   n = ClipIntersectParts_Private(a, b, plane.size, P);
    PetscReal        triangles[6 * POLYGON_MAX_VERTICES];
    PetscInt         num_triangles;
    PetscBool        exact;

    if (!n) continue;
    exact         = a->affine && b->affine && enough ? PETSC_TRUE : PETSC_FALSE;
    num_triangles = ClipTriangulate_Private(n, P, exact, triangles);
    for (PetscInt q = 0; q < num_triangles * num_rule && num < CLIP_MAX_POLYGON_POINTS; q++) {
      const PetscReal *triangle = &triangles[6 * (q / num_rule)];
      PetscReal        p[2], phi[ELEMENT_MAX_NODES];
      const PetscReal  area = ElementMap(ELEMENT_TRI3, triangle, &xi[2 * (q % num_rule)], p, phi, NULL);

      if (!ClipSetPoint_Private(&plane, &own, a, &other, b, p, &points[num])) continue;
      points[num].weight *= w[q % num_rule] * area;
      points[num++].share = w[q % num_rule] * area / own.area;
    }
  }
  return num;
}

/* Whether p lies inside of a part. */
static PetscBool ClipPartHolds_Private(const FacetPart *part, const PetscReal p[], PetscReal size)
{
  const PetscInt n = ElementNumNodes(part->type);

  for (PetscInt i = 0; i < n; i++) {
    const PetscReal *a = &part->plane[2 * i], *b = &part->plane[2 * ((i + 1) % n)];
    const PetscReal  corner[6] = {a[0], a[1], b[0], b[1], p[0], p[1]};

    if (PolygonArea(3, corner) <= INSIDE * size * size) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

PetscBool ClipSees(const ClipFacet *nonmortar, const ClipFacet *mortar, const PetscReal xi[], PetscReal *gap)
{
  PetscReal       x[3], y[3], at[2], eta[2], phi[ELEMENT_MAX_NODES];
  PetscReal       X[3 * ELEMENT_MAX_FACET_NODES], Y[3 * ELEMENT_MAX_FACET_NODES];
  FacetPlane      plane;
  FacetPolygon    other;
  const ClipFacet near = ClipFacetFrom_Private(3, nonmortar->X, nonmortar, X),
                  far  = ClipFacetFrom_Private(3, nonmortar->X, mortar, Y);

  FacetPolygonSetPlane(&near, &plane);
  FacetPolygonProject(&plane, &far, &other);
  FacetPolygonSplit(&plane, &other);
  ElementSurface(near.type, near.X, xi, x, phi, NULL);
  FacetPolygonProjectPoints(&plane, 1, x, at);
  for (PetscInt i = 0; i < other.num_parts; i++) {
    if (!ClipPartHolds_Private(&other.parts[i], at, plane.size)) continue;
    if (!ClipPullBackMortar_Private(&other, &other.parts[i], at, eta)) continue;
    ElementSurface(far.type, far.X, eta, y, phi, NULL);
    *gap = 0.;
    for (PetscInt k = 0; k < 3; k++) *gap += plane.Q[k] * (y[k] - x[k]);
    return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

PetscInt ClipDegree(ElementType nonmortar, ElementType mortar)
{
  const PetscInt own   = ElementOrder(nonmortar) * (ElementLinear(nonmortar) == ELEMENT_QUAD4 ? 2 : 1);
  const PetscInt other = ElementOrder(mortar) * (ElementLinear(mortar) == ELEMENT_QUAD4 ? 2 : 1);

  return own + PetscMax(own, other);
}

PetscInt ClipCorners(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscReal xi[])
{
  return ElementDim(nonmortar->type) == 1 ? ClipLineCorners_Private(nonmortar, mortar, xi)
                                          : ClipPolygonCorners_Private(nonmortar, mortar, xi);
}
