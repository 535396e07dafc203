/* overlappolygon.c -- overlaps of facets in space: lines along the normal of the nonmortar facet's plane. */
#include "base/compat.h"
#include "contact/overlap.h"

/* Layers of the mortar side are farther apart than this share of the nonmortar facet. Gaps at points that two
   curved neighbours both have at their common edge are closer. */
static const PetscReal LAYER_DISTANCE = 1e-3;

/* A facet is straight if its middle nodes deviate by less than this share. */
static const PetscReal STRAIGHT_FACET = 1e-10;

/* Degree on curved facets, which are cut into parts; no rule is exact there. The error for products of two
   shape functions is less than that of the facet's shape. */
enum { CURVED_DEGREE = 5, GIVEN_GAP_DEGREE = 2 };

/* Whether x(xi) is that of a facet of first order with the same vertices. */
static PetscBool OverlapPolygonIsStraight_Private(const ClipFacet *facet)
{
  const ElementType linear = ElementLinear(facet->type);
  const PetscReal   size   = ElementLongestEdge(facet->type, 3, facet->X);

  for (PetscInt i = ElementNumNodes(linear); i < ElementNumNodes(facet->type); i++) {
    PetscReal phi[ELEMENT_MAX_NODES];

    ElementShape(linear, ElementNode(facet->type, i), phi, NULL);
    for (PetscInt k = 0; k < 3; k++) {
      PetscReal off = -facet->X[3 * i + k];

      for (PetscInt v = 0; v < ElementNumNodes(linear); v++) off += phi[v] * facet->X[3 * v + k];
      if (PetscAbsReal(off) > STRAIGHT_FACET * size) return PETSC_FALSE;
    }
  }
  return PETSC_TRUE;
}

/* Exact for products of two shape functions where the facets are parallelograms or triangles and the gap is
   linear. The degree is somewhat higher for gaps that are given. */
static PetscInt OverlapPolygonPoints_Private(const FacetPartner *partner, const ClipFacet *facet,
                                             const ClipFacet *mortar, ClipPoint points[])
{
  PetscInt degree = ClipDegree(facet->type, mortar->type);

  if (!OverlapPolygonIsStraight_Private(facet)) degree = PetscMin(degree, CURVED_DEGREE);
  return ClipPolygons(facet, mortar, OverlapPointsGapVaries(partner) ? degree + GIVEN_GAP_DEGREE : degree, points);
}

/* Whether one of the mortar facets of a list lies nearer to a point than the one that gave it. */
static PetscBool OverlapPolygonIsHidden_Private(const FacetPartner *partner, const ClipFacet *facet, PetscReal size,
                                                PetscInt num_facets, const PetscInt facets[], const ClipPoint *point,
                                                PetscInt own)
{
  for (PetscInt i = 0; i < num_facets; i++) {
    const ClipFacet mortar = OverlapPointsMortarFacet(partner, facets[i]);
    PetscReal       gap;

    if (facets[i] == own || !ClipSees(facet, &mortar, point->xi, &gap)) continue;
    if (PetscAbsReal(gap) < PetscAbsReal(point->gap) - LAYER_DISTANCE * size) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Removes every point for which another mortar facet is nearer. */
static PetscErrorCode OverlapPolygonKeepNearestPoints_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                              OverlapPoints *list)
{
  const PetscReal size = ElementLongestEdge(facet->type, 3, facet->X);
  PetscInt        kept = 0, num_facets = 0, *facets;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(list->num, &facets));
  for (PetscInt p = 0; p < list->num; p++) {
    if (p == 0 || list->facet[p] != list->facet[p - 1]) facets[num_facets++] = list->facet[p];
  }
  for (PetscInt p = 0; p < list->num; p++) {
    if (OverlapPolygonIsHidden_Private(partner, facet, size, num_facets, facets, &list->point[p], list->facet[p]))
      continue;
    list->point[kept]   = list->point[p];
    list->facet[kept++] = list->facet[p];
  }
  list->num = kept;
  PetscCall(PetscFree(facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

const Overlap OVERLAP_POLYGONS = {CLIP_MAX_POLYGON_POINTS, OverlapPolygonPoints_Private,
                                  OverlapPolygonKeepNearestPoints_Private};
