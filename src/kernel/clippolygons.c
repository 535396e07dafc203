/* clippolygons.c -- which part of a nonmortar facet in space sees a mortar facet, as quadrature points.

   Both facets are projected onto the auxiliary plane of the nonmortar one [1], which is normal to the sum of its nodal
   normals. There they are taken for polygons: triangles and quads as they are, facets of second order and quads that are
   not convex in parts [2]. The common part of two such polygons is cut into triangles, each with a quadrature rule.

   A part is a piece of its facet's reference cell, mapped linearly or bilinearly. A point of the plane is pulled back to
   the reference cell of the nonmortar facet by the map of its part, so that parts cover the reference cell exactly once
   however the facet is curved; this xi, and no longer the point of the plane, is the quadrature point: it has a place x on
   the true facet, and the true measure |dx/dxi| as its weight. Where x lies before the mortar facet is found on the true
   mortar facet. Hence what is integrated is the facet's surface, and linear fields on flat interfaces pass from side to
   side without error, in whatever way the plane is cut.

   References:
     [1] M. A. Puso, T. A. Laursen, A mortar segment-to-segment contact method for large deformation solid mechanics,
         Comput. Methods Appl. Mech. Engng 193 (2004).
     [2] M. A. Puso, T. A. Laursen, J. Solberg, A segment-to-segment mortar contact method for quadratic elements and large
         deformations, Comput. Methods Appl. Mech. Engng 197 (2008). */
#include "kernel/clip.h"
#include "kernel/facetpolygon.h"

/* Shares of the nonmortar facet's size, and of its square: distances and areas of roundoff. */
static const PetscReal SAME_POINT = 1e-13, NO_AREA = 1e-14;

/* Share of the size by which a point lies inside of a polygon whatever roundoff says. */
static const PetscReal INSIDE = 1e-10;

/* How far beyond a curved mortar facet, in reference coordinates, a point may lie: curved sides are not where the straight
   ones are that polygons have. */
static const PetscReal CURVED_EXCESS = 0.25;

static const PetscReal NEWTON_STEP = 1e-12;

enum { NEWTON_MAX_STEPS = 20 };

/* Newton's method for the point of a plane cell that lies at p, from a start, which xi holds. The last step may be one of
   roundoff, which in needles is large: no bound is asked of it. Returns whether xi is a number.
   [in] P - [num_nodes][2]; [in,out] xi - [2] */
static PetscBool PullBack_Private(ElementType type, const PetscReal P[], const PetscReal p[], PetscReal xi[])
{
  PetscReal step = PETSC_MAX_REAL;

  for (PetscInt it = 0; it < NEWTON_MAX_STEPS && step > NEWTON_STEP; it++) {
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
static PetscReal Bilinear_Private(const PetscReal map[], const PetscReal s[], PetscReal x[], PetscReal d[])
{
  for (PetscInt k = 0; k < 2; k++) {
    d[k]     = map[2 + k] + map[6 + k] * s[1];
    d[2 + k] = map[4 + k] + map[6 + k] * s[0];
    x[k]     = map[k] + map[2 + k] * s[0] + d[2 + k] * s[1];
  }
  return d[0] * d[3] - d[1] * d[2];
}

/* Pulls p back to the facet's reference cell by the map of a part, by Newton's method, which ends after one step where the map is
   affine; returns how much larger areas are there than in the plane, 0 where it fails. [out] xi - [2] */
static PetscReal PartPullBack_Private(const ShadowPart *part, const PetscReal p[], PetscReal xi[])
{
  const PetscInt max_steps = part->affine ? 1 : NEWTON_MAX_STEPS;
  PetscReal      s[2] = {0.5, 0.5}, x[2], d[4], step = PETSC_MAX_REAL, area;

  for (PetscInt it = 0; it < max_steps && step > NEWTON_STEP; it++) {
    PetscReal change[2], r[2];

    area = Bilinear_Private(part->to_plane, s, x, d);
    if (area == 0.) return 0.;
    for (PetscInt k = 0; k < 2; k++) r[k] = p[k] - x[k];
    change[0] = (r[0] * d[3] - r[1] * d[2]) / area;
    change[1] = (d[0] * r[1] - d[1] * r[0]) / area;
    for (PetscInt k = 0; k < 2; k++) s[k] += change[k];
    step = PetscMax(PetscAbsReal(change[0]), PetscAbsReal(change[1]));
  }
  area = Bilinear_Private(part->to_plane, s, x, d);
  return area > 0. ? PetscAbsReal(Bilinear_Private(part->to_reference, s, xi, d)) / area : 0.;
}

/* Where the mortar facet lies before p: by the map of its part, then, where that is not the facet's own, on the true facet.
   Should this lead far away the part has the word. [out] eta - [2] */
static PetscBool MortarPullBack_Private(const Shadow *mortar, const ShadowPart *part, const PetscReal p[],
                                        PetscReal eta[])
{
  PetscReal true_eta[2];

  if (PartPullBack_Private(part, p, eta) == 0.) return PETSC_FALSE;
  if (mortar->num_parts == 1) return PETSC_TRUE;
  for (PetscInt k = 0; k < 2; k++) true_eta[k] = eta[k];
  if (PullBack_Private(mortar->facet->type, mortar->plane, p, true_eta) &&
      PetscAbsReal(true_eta[0] - eta[0]) < CURVED_EXCESS && PetscAbsReal(true_eta[1] - eta[1]) < CURVED_EXCESS) {
    for (PetscInt k = 0; k < 2; k++) eta[k] = true_eta[k];
  }
  return PETSC_TRUE;
}

/* The quadrature point at p, of the given area in the plane. Returns whether there is one. */
static PetscBool PointSet_Private(const ShadowPlane *plane, const Shadow *nonmortar, const ShadowPart *own,
                                  const Shadow *mortar, const ShadowPart *other, const PetscReal p[], ClipPoint *point)
{
  PetscReal       x[3], y[3], at[2], phi[ELEMENT_MAX_NODES];
  const PetscReal ratio = PartPullBack_Private(own, p, point->xi);

  if (ratio == 0.) return PETSC_FALSE;
  point->weight = ratio * ElementSurface(nonmortar->facet->type, nonmortar->facet->X, point->xi, x, phi, NULL);
  ShadowPlaneProject(plane, 1, x, at);
  if (!MortarPullBack_Private(mortar, other, at, point->eta)) return PETSC_FALSE;
  ElementSurface(mortar->facet->type, mortar->facet->X, point->eta, y, phi, NULL);
  point->gap = 0.;
  for (PetscInt k = 0; k < 3; k++) point->gap += plane->Q[k] * (y[k] - x[k]);
  return PETSC_TRUE;
}

/* The triangles of a convex polygon: between its sides and the mean of its vertices, so that it does not matter which one is
   the first; or, where the rule is exact and this does not matter either, between its sides and its last vertex, two less. One
   triangle may then be all that is covered of a facet.
   Returns their number. [in] P - [n][2]; [out] triangles - [n][3][2] */
static PetscInt Fan_Private(PetscInt n, const PetscReal P[], PetscBool exact, PetscReal triangles[])
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
static PetscBool Shadows_Private(const ClipFacet *nonmortar, const ClipFacet *mortar, ShadowPlane *plane, Shadow *own,
                                 Shadow *other)
{
  ShadowPlaneSet(nonmortar, plane);
  ShadowProject(plane, nonmortar, own);
  ShadowProject(plane, mortar, other);
  if (!ShadowsMeet(own, other)) return PETSC_FALSE;
  ShadowCut(plane, own);
  ShadowCut(plane, other);
  return PETSC_TRUE;
}

/* The common part of two parts; returns the number of its vertices, 0 where it has no area. [out] P - [POLYGON_MAX_VERTICES][2] */
static PetscInt Common_Private(const ShadowPart *a, const ShadowPart *b, PetscReal size, PetscReal P[])
{
  const PetscInt n =
      PolygonIntersect(ElementNumNodes(a->type), a->plane, ElementNumNodes(b->type), b->plane, SAME_POINT * size, P);

  return !n || PolygonArea(n, P) < NO_AREA * size * size ? 0 : n;
}

PetscInt ClipPolygonCorners(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscReal xi[])
{
  PetscReal       P[2 * POLYGON_MAX_VERTICES], X[3 * ELEMENT_MAX_FACET_NODES], Y[3 * ELEMENT_MAX_FACET_NODES];
  PetscInt        num  = 0;
  const ClipFacet near = ClipFacetFrom(3, nonmortar->X, nonmortar, X), far = ClipFacetFrom(3, nonmortar->X, mortar, Y);
  ShadowPlane     plane;
  Shadow          own, other;

  if (!Shadows_Private(&near, &far, &plane, &own, &other)) return 0;
  for (PetscInt pair = 0; pair < own.num_parts * other.num_parts; pair++) {
    const ShadowPart *a = &own.parts[pair / other.num_parts];
    const PetscInt    n = Common_Private(a, &other.parts[pair % other.num_parts], plane.size, P);

    for (PetscInt i = 0; i < n; i++) num += PartPullBack_Private(a, &P[2 * i], &xi[2 * num]) > 0. ? 1 : 0;
  }
  return num;
}

PetscInt ClipPolygons(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscInt degree, ClipPoint points[])
{
  PetscReal       xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], P[2 * POLYGON_MAX_VERTICES];
  PetscReal       X[3 * ELEMENT_MAX_FACET_NODES], Y[3 * ELEMENT_MAX_FACET_NODES];
  PetscInt        num_rule, num = 0;
  PetscBool       enough;
  ShadowPlane     plane;
  Shadow          own, other;
  const ClipFacet near = ClipFacetFrom(3, nonmortar->X, nonmortar, X), far = ClipFacetFrom(3, nonmortar->X, mortar, Y);

  if (!Shadows_Private(&near, &far, &plane, &own, &other)) return 0;
  num_rule = ElementQuadrature(ELEMENT_TRI3, degree, xi, w);
  enough = num_rule >= ElementNumNodes(nonmortar->type) ? PETSC_TRUE : PETSC_FALSE; /* to tell shape functions apart */
  for (PetscInt pair = 0; pair < own.num_parts * other.num_parts; pair++) {
    const ShadowPart *a = &own.parts[pair / other.num_parts], *b = &other.parts[pair % other.num_parts];
    const PetscInt    n = Common_Private(a, b, plane.size, P);
    PetscReal         triangles[6 * POLYGON_MAX_VERTICES];
    PetscInt          num_triangles;
    PetscBool         exact;

    if (!n) continue;
    exact         = a->affine && b->affine && enough ? PETSC_TRUE : PETSC_FALSE;
    num_triangles = Fan_Private(n, P, exact, triangles);
    for (PetscInt q = 0; q < num_triangles * num_rule && num < CLIP_MAX_POLYGON_POINTS; q++) {
      const PetscReal *triangle = &triangles[6 * (q / num_rule)];
      PetscReal        p[2], phi[ELEMENT_MAX_NODES];
      const PetscReal  area = ElementMap(ELEMENT_TRI3, triangle, &xi[2 * (q % num_rule)], p, phi, NULL);

      if (!PointSet_Private(&plane, &own, a, &other, b, p, &points[num])) continue;
      points[num].weight *= w[q % num_rule] * area;
      points[num++].share = w[q % num_rule] * area / own.area;
    }
  }
  return num;
}

/* Whether p lies inside of a part. */
static PetscBool IsInside_Private(const ShadowPart *part, const PetscReal p[], PetscReal size)
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
  ShadowPlane     plane;
  Shadow          other;
  const ClipFacet near = ClipFacetFrom(3, nonmortar->X, nonmortar, X), far = ClipFacetFrom(3, nonmortar->X, mortar, Y);

  ShadowPlaneSet(&near, &plane);
  ShadowProject(&plane, &far, &other);
  ShadowCut(&plane, &other);
  ElementSurface(near.type, near.X, xi, x, phi, NULL);
  ShadowPlaneProject(&plane, 1, x, at);
  for (PetscInt i = 0; i < other.num_parts; i++) {
    if (!IsInside_Private(&other.parts[i], at, plane.size)) continue;
    if (!MortarPullBack_Private(&other, &other.parts[i], at, eta)) continue;
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
