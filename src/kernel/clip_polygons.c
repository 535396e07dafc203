/* clip_polygons.c -- which part of a nonmortar facet in space sees a mortar facet, as quadrature points.

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
#include <mortise/clip.h>
#include <mortise/frame.h>
#include "polygon.h"

/* Shares of the nonmortar facet's size, and of its square: distances and areas of roundoff. */
static const PetscReal SAME_POINT = 1e-13, NO_AREA = 1e-14;

/* A quad whose angles are closer to straight than this is not one for Newton's method: the smallest of the triangles at its
   corners as a share of the mean one. */
static const PetscReal CONVEX_SHARE = 1e-2;

/* How far beyond a curved mortar facet, in reference coordinates, a point may lie: curved sides are not where the straight
   ones are that polygons have. */
static const PetscReal CURVED_EXCESS = 0.25;

static const PetscReal NEWTON_STEP = 1e-12;

enum {
  MAX_PARTS        = CLIP_MAX_PARTS,
  MAX_FACET_NODES  = ELEMENT_MAX_FACET_NODES,
  NEWTON_MAX_STEPS = 20,
  SYMMETRIC_DEGREE = 5 /* of rules on triangles */
};

/* A part of a facet; its corners run anticlockwise in the plane. */
typedef struct {
  ElementType type;                               /* tri3 or quad4 */
  PetscBool   affine;                             /* a triangle or a parallelogram */
  PetscReal   reference[2 * POLYGON_MAX_CORNERS]; /* corners in the facet's reference cell */
  PetscReal   plane[2 * POLYGON_MAX_CORNERS];     /* and in the plane */
} Part;

/* A facet as the plane sees it. */
typedef struct {
  const ClipFacet *facet;
  PetscReal        plane[2 * MAX_FACET_NODES]; /* its nodes */
  PetscInt         num_parts;
  Part             parts[MAX_PARTS];
} Shadow;

typedef struct {
  PetscReal origin[3], Q[9]; /* normal and two tangents */
  PetscReal size;            /* of the nonmortar facet */
} Plane;

/* Places of nodes in the plane. [in] X - [n][3]; [out] P - [n][2] */
static void Project_Private(const Plane *plane, PetscInt n, const PetscReal X[], PetscReal P[])
{
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt t = 0; t < 2; t++) {
      const PetscReal *tangent = &plane->Q[3 * (1 + t)];

      P[2 * i + t] = 0.;
      for (PetscInt k = 0; k < 3; k++) P[2 * i + t] += tangent[k] * (X[3 * i + k] - plane->origin[k]);
    }
  }
}

static void PlaneSet_Private(const ClipFacet *nonmortar, Plane *plane)
{
  const PetscInt n         = ElementNumNodes(nonmortar->type);
  PetscReal      normal[3] = {0.}, P[2 * MAX_FACET_NODES];

  for (PetscInt k = 0; k < 3; k++) {
    plane->origin[k] = 0.;
    for (PetscInt i = 0; i < n; i++) {
      plane->origin[k] += nonmortar->X[3 * i + k] / n;
      normal[k] += nonmortar->N[3 * i + k];
    }
  }
  FrameNormalize(3, normal);
  FrameFromNormal(3, normal, plane->Q);
  Project_Private(plane, n, nonmortar->X, P);
  plane->size = 0.;
  for (PetscInt i = 0; i < 2 * n; i++) plane->size = PetscMax(plane->size, 2. * PetscAbsReal(P[i]));
}

/* Whether the corners 0 and 2 have the same middle as 1 and 3. [in] P - [4][2] */
static PetscBool IsParallelogram_Private(const PetscReal P[], PetscReal size)
{
  for (PetscInt k = 0; k < 2; k++) {
    if (PetscAbsReal(P[k] - P[2 + k] + P[4 + k] - P[6 + k]) > SAME_POINT * size) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Appends the part with the given nodes of the facet, turned anticlockwise; none where it has no area. */
static void AddPart_Private(PetscInt num, const PetscInt nodes[], PetscReal size, Shadow *shadow)
{
  Part     *part = &shadow->parts[shadow->num_parts];
  PetscReal P[2 * POLYGON_MAX_CORNERS], area;

  for (PetscInt i = 0; i < 2 * num; i++) P[i] = shadow->plane[2 * nodes[i / 2] + i % 2];
  area = PolygonArea(num, P);
  if (PetscAbsReal(area) <= NO_AREA * size * size) return;
  part->type   = num == 3 ? ELEMENT_TRI3 : ELEMENT_QUAD4;
  part->affine = num == 3 ? PETSC_TRUE : IsParallelogram_Private(P, size);
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt node = nodes[area > 0. ? i : num - 1 - i];

    for (PetscInt k = 0; k < 2; k++) {
      part->reference[2 * i + k] = ElementNode(shadow->facet->type, node)[k];
      part->plane[2 * i + k]     = shadow->plane[2 * node + k];
    }
  }
  shadow->num_parts++;
}

/* Appends a quad, or two triangles that meet at its flattest corner, where it is not convex. [in] nodes - [4] */
static void AddQuad_Private(const PetscInt nodes[], PetscReal size, Shadow *shadow)
{
  PetscReal corner[4], sum = 0., sense;
  PetscInt  flattest = 0;

  for (PetscInt i = 0; i < 4; i++) {
    PetscReal P[6];

    for (PetscInt j = 0; j < 3; j++) {
      for (PetscInt k = 0; k < 2; k++) P[2 * j + k] = shadow->plane[2 * nodes[(i + 3 + j) % 4] + k];
    }
    corner[i] = PolygonArea(3, P);
    sum += corner[i];
  }
  sense = sum > 0. ? 1. : -1.;
  for (PetscInt i = 1; i < 4; i++) {
    if (sense * corner[i] < sense * corner[flattest]) flattest = i;
  }
  if (sense * corner[flattest] > CONVEX_SHARE * 0.25 * PetscAbsReal(sum)) {
    AddPart_Private(4, nodes, size, shadow);
  } else {
    for (PetscInt half = 0; half < 2; half++) {
      const PetscInt triangle[3] = {nodes[flattest], nodes[(flattest + 1 + half) % 4],
                                    nodes[(flattest + 2 + half) % 4]};

      AddPart_Private(3, triangle, size, shadow);
    }
  }
}

static void ShadowSet_Private(const Plane *plane, const ClipFacet *facet, Shadow *shadow)
{
  static const PetscInt tri6[4][3]  = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  static const PetscInt quad9[4][4] = {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}};
  static const PetscInt whole[4]    = {0, 1, 2, 3};
  const PetscReal       size        = plane->size;

  shadow->facet     = facet;
  shadow->num_parts = 0;
  Project_Private(plane, ElementNumNodes(facet->type), facet->X, shadow->plane);
  switch (facet->type) {
  case ELEMENT_TRI3: AddPart_Private(3, whole, size, shadow); break;
  case ELEMENT_QUAD4: AddQuad_Private(whole, size, shadow); break;
  case ELEMENT_TRI6:
    for (PetscInt i = 0; i < 4; i++) AddPart_Private(3, tri6[i], size, shadow);
    break;
  default:
    for (PetscInt i = 0; i < 4; i++) AddQuad_Private(quad9[i], size, shadow);
  }
}

/* Newton's method for the point of a plane cell that lies at p, from a start, which xi holds. The last step may be one of
   roundoff, which in needles is large: no bound is asked of it. Returns whether xi is a number.
   [in] P - [num_nodes][2]; max_steps - 1 is enough where the map is affine; [in,out] xi - [2] */
static PetscBool PullBack_Private(ElementType type, const PetscReal P[], const PetscReal p[], PetscInt max_steps,
                                  PetscReal xi[])
{
  PetscReal step = PETSC_MAX_REAL;

  for (PetscInt it = 0; it < max_steps && step > NEWTON_STEP; it++) {
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

/* Pulls p back to the facet's reference cell by the map of a part; returns how much larger areas are there than in the
   plane, 0 where it fails. [out] xi - [2] */
static PetscReal PartPullBack_Private(const Part *part, const PetscReal p[], PetscReal xi[])
{
  const PetscReal centre   = part->type == ELEMENT_TRI3 ? 1. / 3. : 0.5;
  PetscReal       local[2] = {centre, centre}, phi[ELEMENT_MAX_NODES], area;

  if (!PullBack_Private(part->type, part->plane, p, part->affine ? 1 : NEWTON_MAX_STEPS, local)) return 0.;
  area = ElementMap(part->type, part->plane, local, NULL, phi, NULL);
  return area > 0. ? PetscAbsReal(ElementMap(part->type, part->reference, local, xi, phi, NULL)) / area : 0.;
}

/* Where the mortar facet lies before p: by the map of its part, then, where that is not the facet's own, on the true facet.
   Should this lead far away the part has the word. [out] eta - [2] */
static PetscBool MortarPullBack_Private(const Shadow *mortar, const Part *part, const PetscReal p[], PetscReal eta[])
{
  PetscReal true_eta[2];

  if (PartPullBack_Private(part, p, eta) == 0.) return PETSC_FALSE;
  if (mortar->num_parts == 1) return PETSC_TRUE;
  for (PetscInt k = 0; k < 2; k++) true_eta[k] = eta[k];
  if (PullBack_Private(mortar->facet->type, mortar->plane, p, NEWTON_MAX_STEPS, true_eta) &&
      PetscAbsReal(true_eta[0] - eta[0]) < CURVED_EXCESS && PetscAbsReal(true_eta[1] - eta[1]) < CURVED_EXCESS) {
    for (PetscInt k = 0; k < 2; k++) eta[k] = true_eta[k];
  }
  return PETSC_TRUE;
}

/* The quadrature point at p, of the given area in the plane. Returns whether there is one. */
static PetscBool PointSet_Private(const Plane *plane, const Shadow *nonmortar, const Part *own, const Shadow *mortar,
                                  const Part *other, const PetscReal p[], ClipPoint *point)
{
  PetscReal       x[3], y[3], at[2], phi[ELEMENT_MAX_NODES];
  const PetscReal ratio = PartPullBack_Private(own, p, point->xi);

  if (ratio == 0.) return PETSC_FALSE;
  point->weight = ratio * ElementSurface(nonmortar->facet->type, nonmortar->facet->X, point->xi, x, phi, NULL);
  Project_Private(plane, 1, x, at);
  if (!MortarPullBack_Private(mortar, other, at, point->eta)) return PETSC_FALSE;
  ElementSurface(mortar->facet->type, mortar->facet->X, point->eta, y, phi, NULL);
  point->gap = 0.;
  for (PetscInt k = 0; k < 3; k++) point->gap += plane->Q[k] * (y[k] - x[k]);
  return PETSC_TRUE;
}

/* The triangles of a convex polygon: between its sides and the mean of its vertices, so that it does not matter which one is
   the first; or, where the rule is exact and this does not matter either, between its sides and its last vertex, two less.
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

PetscInt ClipPolygons(const ClipFacet *nonmortar, const ClipFacet *mortar, PetscInt degree, ClipPoint points[])
{
  PetscReal xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], P[2 * POLYGON_MAX_VERTICES];
  PetscInt  num_rule, num = 0;
  Plane     plane;
  Shadow    own, other;

  num_rule = ElementQuadrature(ELEMENT_TRI3, degree, xi, w);
  PlaneSet_Private(nonmortar, &plane);
  ShadowSet_Private(&plane, nonmortar, &own);
  ShadowSet_Private(&plane, mortar, &other);
  for (PetscInt pair = 0; pair < own.num_parts * other.num_parts; pair++) {
    const Part    *a = &own.parts[pair / other.num_parts], *b = &other.parts[pair % other.num_parts];
    const PetscInt n = PolygonIntersect(ElementNumNodes(a->type), a->plane, ElementNumNodes(b->type), b->plane,
                                        SAME_POINT * plane.size, P);
    PetscReal      triangles[6 * POLYGON_MAX_VERTICES];
    PetscInt       num_triangles;

    if (!n || PolygonArea(n, P) < NO_AREA * plane.size * plane.size) continue;
    num_triangles = Fan_Private(n, P, a->affine && b->affine ? PETSC_TRUE : PETSC_FALSE, triangles);
    for (PetscInt q = 0; q < num_triangles * num_rule && num < CLIP_MAX_POLYGON_POINTS; q++) {
      const PetscReal *triangle = &triangles[6 * (q / num_rule)];
      PetscReal        p[2], phi[ELEMENT_MAX_NODES];
      const PetscReal  area = ElementMap(ELEMENT_TRI3, triangle, &xi[2 * (q % num_rule)], p, phi, NULL);

      if (!PointSet_Private(&plane, &own, a, &other, b, p, &points[num])) continue;
      points[num++].weight *= w[q % num_rule] * area;
    }
  }
  return num;
}

PetscInt ClipDegree(ElementType nonmortar, ElementType mortar)
{
  const PetscInt own   = ElementOrder(nonmortar) * (ElementLinear(nonmortar) == ELEMENT_QUAD4 ? 2 : 1);
  const PetscInt other = ElementOrder(mortar) * (ElementLinear(mortar) == ELEMENT_QUAD4 ? 2 : 1);

  return own + PetscMax(own, other);
}
