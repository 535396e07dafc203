/* overlapline.c -- overlaps of lines: rays along the interpolated nodal normals. */
#include "base/compat.h"
#include "contact/overlap.h"

/* Ends of pieces closer than this share of the facet are one. */
static const PetscReal SAME_END = 1e-10;
/* Normals that differ by less are parallel; a facet is straight if its middle node deviates by less than this
   share. */
static const PetscReal TURN_TOLERANCE = 1e-12;

/* Whether x(xi) is linear. */
static PetscBool OverlapLineIsStraight_Private(const ClipFacet *facet)
{
  const PetscReal size = ElementLongestEdge(facet->type, 2, facet->X);

  for (PetscInt k = 0; k < 2 && facet->type == ELEMENT_LINE3; k++) {
    if (PetscAbsReal(facet->X[4 + k] - 0.5 * (facet->X[k] + facet->X[2 + k])) > TURN_TOLERANCE * size)
      return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Whether the normals at the nodes differ. */
static PetscBool OverlapLineTurns_Private(const ClipFacet *facet)
{
  for (PetscInt i = 1; i < ElementNumNodes(facet->type); i++) {
    for (PetscInt k = 0; k < 2; k++) {
      if (PetscAbsReal(facet->N[2 * i + k] - facet->N[k]) > TURN_TOLERANCE) return PETSC_TRUE;
    }
  }
  return PETSC_FALSE;
}

/* Gauss points per piece. On straight facets with a linear gap order + 1 are exact for the product of two
   shape functions; elsewhere more are taken. */
static PetscInt OverlapLinePointsPerPiece_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                  const ClipFacet *mortar)
{
  const ElementType type = ElementOrder(mortar->type) > ElementOrder(facet->type) ? mortar->type : facet->type;

  if (OverlapLineTurns_Private(facet) || !OverlapLineIsStraight_Private(facet) ||
      !OverlapLineIsStraight_Private(mortar) || OverlapPointsGapVaries(partner))
    return (OverlapPointsCurvedDegree(type) + 1) / 2;
  return ElementOrder(type) + 1;
}

static PetscInt OverlapLinePoints_Private(const FacetPartner *partner, const ClipFacet *facet, const ClipFacet *mortar,
                                          ClipPoint points[])
{
  return ClipLines(facet, mortar, OverlapLinePointsPerPiece_Private(partner, facet, mortar), points);
}

/* Points of the part [from, to] of a facet against one mortar facet, on the facet's own reference cell. The
   part is a facet of the same type; its normals are those of the whole facet, not normalized, and send the
   same rays. */
static PetscInt OverlapLineClipPart_Private(const ClipFacet *facet, const PetscReal ends[], const ClipFacet *mortar,
                                            PetscInt num_gauss, ClipPoint points[])
{
  const PetscInt  n                              = ElementNumNodes(facet->type);
  PetscReal       X[2 * ELEMENT_MAX_FACET_NODES] = {0.}, N[2 * ELEMENT_MAX_FACET_NODES] = {0.};
  const ClipFacet part = {facet->type, X, N};
  PetscInt        num;

  for (PetscInt i = 0; i < n; i++) {
    const PetscReal xi = ends[0] + (ends[1] - ends[0]) * ElementNode(facet->type, i)[0];
    PetscReal       phi[ELEMENT_MAX_NODES];

    ElementShape(facet->type, &xi, phi, NULL);
    for (PetscInt j = 0; j < n; j++) {
      for (PetscInt k = 0; k < 2; k++) {
        X[2 * i + k] += phi[j] * facet->X[2 * j + k];
        N[2 * i + k] += phi[j] * facet->N[2 * j + k];
      }
    }
  }
  num = ClipLines(&part, mortar, num_gauss, points);
  for (PetscInt p = 0; p < num; p++) points[p].xi[0] = ends[0] + (ends[1] - ends[0]) * points[p].xi[0];
  return num;
}

/* The part of the facet of one piece, from its first and last Gauss point. num > 1 */
static void OverlapLinePieceEnds_Private(PetscInt num, const ClipPoint points[], PetscReal ends[])
{
  PetscReal s[CLIP_MAX_GAUSS], w[CLIP_MAX_GAUSS], length;

  QuadratureLine(num, s, w);
  length  = (points[num - 1].xi[0] - points[0].xi[0]) / (s[num - 1] - s[0]);
  ends[0] = points[0].xi[0] - s[0] * length;
  ends[1] = ends[0] + length;
}

/* The parts of a facet that mortar facets cover. */
typedef struct {
  PetscInt   num;
  PetscInt  *facet; /* [num] */
  PetscReal *ends;  /* on the facet's reference cell [num][2] */
} PieceList;

/* The pieces of a list of points. */
static PetscErrorCode OverlapLinePieceListCreate_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                         const OverlapPoints *list, PieceList *pieces)
{
  PetscInt num_gauss;

  PetscFunctionBeginUser;
  pieces->num = 0;
  PetscCall(PetscMalloc2(list->num, &pieces->facet, 2 * list->num, &pieces->ends));
  for (PetscInt p = 0; p < list->num; p += num_gauss) {
    const ClipFacet mortar = OverlapPointsMortarFacet(partner, list->facet[p]);
    num_gauss              = OverlapLinePointsPerPiece_Private(partner, facet, &mortar);
    OverlapLinePieceEnds_Private(num_gauss, &list->point[p], &pieces->ends[2 * pieces->num]);
    pieces->facet[pieces->num++] = list->facet[p];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cuts the facet at the ends of all pieces, and assigns each part to the nearest mortar facet there. */
static PetscErrorCode OverlapLineKeepNearestPieces_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                           OverlapPoints *list)
{
  ClipPoint points[CLIP_MAX_POINTS], best[CLIP_MAX_POINTS];
  PieceList pieces;

  PetscFunctionBeginUser;
  PetscCall(OverlapLinePieceListCreate_Private(partner, facet, list, &pieces));
  PetscCall(PetscSortReal(2 * pieces.num, pieces.ends));
  list->num = 0;
  for (PetscInt e = 0; e + 1 < 2 * pieces.num; e++) {
    PetscReal nearest  = PETSC_MAX_REAL;
    PetscInt  num_best = 0, best_facet = -1;
    if (pieces.ends[e + 1] - pieces.ends[e] <= SAME_END) continue;
    for (PetscInt i = 0; i < pieces.num; i++) {
      const ClipFacet mortar    = OverlapPointsMortarFacet(partner, pieces.facet[i]);
      const PetscInt  num_gauss = OverlapLinePointsPerPiece_Private(partner, facet, &mortar);
      const PetscInt  num       = OverlapLineClipPart_Private(facet, &pieces.ends[e], &mortar, num_gauss, points);
      PetscReal       gap       = 0;
      for (PetscInt p = 0; p < num; p++) gap += PetscAbsReal(points[p].gap) / num;
      if (num == 0 || gap >= nearest) continue;
      nearest    = gap;
      num_best   = num;
      best_facet = pieces.facet[i];
      PetscCall(PetscArraycpy(best, points, num));
    }
    for (PetscInt p = 0; p < num_best; p++) PetscCall(OverlapPointsAdd(list, &best[p], best_facet));
  }
  PetscCall(PetscFree2(pieces.facet, pieces.ends));
  PetscFunctionReturn(PETSC_SUCCESS);
}

const Overlap OVERLAP_LINES = {CLIP_MAX_POINTS, OverlapLinePoints_Private, OverlapLineKeepNearestPieces_Private};
