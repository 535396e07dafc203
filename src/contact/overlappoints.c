/* overlappoints.c -- the quadrature points of one nonmortar facet, from all mortar facets that cover it. */
#include "base/compat.h"
#include "kernel/frame.h"
#include "contact/obstacle.h"
#include "contact/overlap.h"
#include "kernel/vector.h"

/* The mortar side has two layers if the overlaps with a facet add to more than the facet by this share. */
static const PetscReal OVERLAP_TOLERANCE = 1e-8;

enum { START_POINTS = 64 }; /* first size of the list of points */

/* The operations for facets of a dimension. */
static const Overlap *OverlapPointsGetOverlap_Private(PetscInt dim)
{
  return dim == 2 ? &OVERLAP_LINES : &OVERLAP_POLYGONS;
}

PetscErrorCode OverlapPointsCreate(PetscInt dim, OverlapPoints *list)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(list, sizeof(*list)));
  PetscCall(PetscMalloc1(OverlapPointsGetOverlap_Private(dim)->max_points, &list->work));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OverlapPointsAdd(OverlapPoints *list, const ClipPoint *point, PetscInt facet)
{
  PetscFunctionBeginUser;
  if (list->num == list->max) {
    list->max = list->max ? 2 * list->max : START_POINTS;
    PetscCall(PetscRealloc(sizeof(*list->point) * list->max, &list->point));
    PetscCall(PetscRealloc(sizeof(*list->facet) * list->max, &list->facet));
  }
  list->point[list->num]   = *point;
  list->facet[list->num++] = facet;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OverlapPointsDestroy(OverlapPoints *list)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(list->point));
  PetscCall(PetscFree(list->facet));
  PetscCall(PetscFree(list->work));
  list->num = list->max = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

ClipFacet OverlapPointsMortarFacet(const FacetPartner *partner, PetscInt f)
{
  const MortarSurface *mortar = partner->mortar;

  return (ClipFacet){mortar->type[f], &mortar->coords[f * ELEMENT_MAX_FACET_NODES * partner->dim], NULL};
}

PetscBool OverlapPointsGapVaries(const FacetPartner *partner)
{
  const ScenePair *spec = partner->spec;

  if (partner->rises || (partner->mortar && partner->mortar->rises)) return PETSC_TRUE;
  if (spec->gap && !ExpressionIsConstant(spec->gap)) return PETSC_TRUE;
  return (PetscBool)(spec->gap_offset && !ExpressionIsConstant(spec->gap_offset));
}

PetscInt OverlapPointsCurvedDegree(ElementType type)
{
  return 3 + 4 * ElementOrder(type);
}

/* A vector along the mean outward normal of the polygon of a facet's vertices. It is (dy,-dx) of a line, the
   cross product of two edges of a triangle or of the diagonals of a quad. */
static void OverlapPointsOutward_Private(PetscInt dim, const ClipFacet *facet, PetscReal nu[])
{
  const PetscInt   num = ElementNumNodes(ElementLinear(facet->type));
  const PetscReal *X   = facet->X;
  PetscReal        a[3], b[3];

  if (dim == 2) {
    nu[0] = X[3] - X[1];
    nu[1] = X[0] - X[2];
    return;
  }
  for (PetscInt k = 0; k < 3; k++) {
    a[k] = X[3 * (num - 2) + k] - X[k];
    b[k] = X[3 * (num - 1) + k] - X[3 * (num - 3) + k];
  }
  VectorCross(a, b, nu);
}

/* Whether a mortar facet faces a nonmortar facet.
   [in] nu - outward normal of the nonmortar one, of any length */
static PetscBool OverlapPointsFaceEachOther_Private(PetscInt dim, const PetscReal nu[], const ClipFacet *mortar)
{
  PetscReal nu_m[3], dot = 0, square = 0, square_m = 0;

  OverlapPointsOutward_Private(dim, mortar, nu_m);
  for (PetscInt k = 0; k < dim; k++) {
    dot += nu[k] * nu_m[k];
    square += nu[k] * nu[k];
    square_m += nu_m[k] * nu_m[k];
  }
  return (PetscBool)(dot < FACING * PetscSqrtReal(square * square_m));
}

/* Whether some point of an overlap is within reach, in front or behind. */
static PetscBool OverlapPointsWithinReach_Private(PetscInt num, const ClipPoint points[], PetscReal reach)
{
  for (PetscInt p = 0; p < num; p++) {
    if (PetscAbsReal(points[p].gap) <= reach) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Collects the quadrature points of a facet against the mortar side. */
static PetscErrorCode OverlapPointsCollectMortar_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                         OverlapPoints *list)
{
  const Overlap  *overlap = OverlapPointsGetOverlap_Private(partner->dim);
  PetscReal       nu[3], covered = 0;
  PetscInt        num_hits;
  const PetscInt *hits;

  PetscFunctionBeginUser;
  OverlapPointsOutward_Private(partner->dim, facet, nu);
  PetscCall(MortarSurfaceQuery(partner->mortar, partner->dim, facet, partner->reach, &num_hits, &hits));
  for (PetscInt h = 0; h < num_hits; h++) {
    const ClipFacet mortar = OverlapPointsMortarFacet(partner, hits[h]);
    PetscInt        num;
    if (!OverlapPointsFaceEachOther_Private(partner->dim, nu, &mortar)) continue;
    num = overlap->points(partner, facet, &mortar, list->work);
    if (!OverlapPointsWithinReach_Private(num, list->work, partner->reach)) continue;
    for (PetscInt p = 0; p < num; p++) {
      covered += list->work[p].share;
      PetscCall(OverlapPointsAdd(list, &list->work[p], hits[h]));
    }
  }
  if (covered > 1 + OVERLAP_TOLERANCE) PetscCall(overlap->keep_nearest(partner, facet, list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Collects the points of a facet against an obstacle: the whole facet, if any part is within reach along the
   facet's own normal. The normal of a node at a sharp edge might meet an obstacle behind the facet. */
static PetscErrorCode OverlapPointsCollectObstacle_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                           OverlapPoints *list)
{
  const PetscInt dim = partner->dim, dim_facet = ElementDim(facet->type);
  PetscReal      xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], x[3], nu[3], phi[ELEMENT_MAX_NODES], own;
  PetscBool      near = PETSC_FALSE, back = PETSC_FALSE;
  const PetscInt num_rule = QuadratureRule(facet->type, OverlapPointsCurvedDegree(facet->type), xi, w);

  PetscFunctionBeginUser;
  for (PetscInt q = 0; q < num_rule; q++) {
    ClipPoint point = {.xi = {0, 0}, .eta = {0, 0}};
    PetscReal n[3]  = {0, 0, 0};
    for (PetscInt k = 0; k < dim_facet; k++) point.xi[k] = xi[dim_facet * q + k];
    point.weight = w[q] * ElementSurface(facet->type, facet->X, point.xi, x, phi, nu);
    for (PetscInt i = 0; i < ElementNumNodes(facet->type); i++) {
      for (PetscInt k = 0; k < dim; k++) n[k] += phi[i] * facet->N[dim * i + k];
    }
    FrameNormalize(dim, n);
    PetscCall(ObstacleGap(&partner->spec->obstacle, dim, x, n, &point.gap));
    PetscCall(ObstacleGap(&partner->spec->obstacle, dim, x, nu, &own));
    if (own <= partner->reach) near = PETSC_TRUE;
    if (PetscMax(own, point.gap) >= PETSC_INFINITY) back = PETSC_TRUE; // part of the facet does not face the obstacle
    PetscCall(OverlapPointsAdd(list, &point, -1));
  }
  if (!near || back) list->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OverlapPointsCollect(const FacetPartner *partner, const ClipFacet *facet, OverlapPoints *list)
{
  PetscFunctionBeginUser;
  list->num = 0;
  if (partner->mortar)
    PetscCall(OverlapPointsCollectMortar_Private(partner, facet, list));
  else
    PetscCall(OverlapPointsCollectObstacle_Private(partner, facet, list));
  PetscFunctionReturn(PETSC_SUCCESS);
}
