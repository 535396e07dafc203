/* points.c -- the quadrature points of one nonmortar facet, from all mortar facets that cover it. */
#include <mortise/compat.h>
#include <mortise/obstacle.h>
#include "points.h"

/* Sides face each other when the cosine of their normals is below this. */
static const PetscReal FACING = -0.3;
/* Two layers of the mortar side are seen when the pieces sum to more than the facet by this share. */
static const PetscReal OVERLAP_TOLERANCE = 1e-8;
/* Ends of pieces closer than this share of the facet are one. */
static const PetscReal SAME_END = 1e-10;
/* Normals that differ by less do not turn; a facet is straight whose middle node is off by less than this share. */
static const PetscReal TURN_TOLERANCE = 1e-12;

enum { START_POINTS = 64 }; /* first size of the list of points */

static PetscErrorCode PointListAdd_Private(PointList *list, const ClipPoint *point, PetscInt facet)
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

PetscErrorCode PointListDestroy(PointList *list)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(list->point));
  PetscCall(PetscFree(list->facet));
  list->num = list->max = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether x(xi) is linear. */
static PetscBool IsStraight_Private(const ClipFacet *facet)
{
  const PetscReal size = FacetSize(2, facet->type, facet->X);

  for (PetscInt k = 0; k < 2 && facet->type == ELEMENT_LINE3; k++) {
    if (PetscAbsReal(facet->X[4 + k] - 0.5 * (facet->X[k] + facet->X[2 + k])) > TURN_TOLERANCE * size)
      return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Whether the normals at the nodes differ. */
static PetscBool Turns_Private(const ClipFacet *facet)
{
  for (PetscInt i = 1; i < ElementNumNodes(facet->type); i++) {
    for (PetscInt k = 0; k < 2; k++) {
      if (PetscAbsReal(facet->N[2 * i + k] - facet->N[k]) > TURN_TOLERANCE) return PETSC_TRUE;
    }
  }
  return PETSC_FALSE;
}

PetscInt PointsCurved(ElementType type)
{
  return 2 + 2 * ElementOrder(type);
}

/* Gauss points per piece: order + 1 are exact for the product of two shape functions where the facets are straight and
   the gap is linear, and more are taken elsewhere. [in] mortar - NULL for an obstacle */
static PetscInt PointsPerPiece_Private(const ScenePair *spec, const ClipFacet *facet, const ClipFacet *mortar)
{
  const ElementType type =
      mortar && ElementOrder(mortar->type) > ElementOrder(facet->type) ? mortar->type : facet->type;

  if (!mortar || Turns_Private(facet) || !IsStraight_Private(facet) || !IsStraight_Private(mortar))
    return PointsCurved(type);
  if (spec->gap && !ExpressionIsConstant(spec->gap)) return PointsCurved(type);
  if (spec->gap_offset && !ExpressionIsConstant(spec->gap_offset)) return PointsCurved(type);
  return ElementOrder(type) + 1;
}

/* Whether a mortar facet faces a nonmortar facet: cosine of the outward normals (dy,-dx) of the chords. */
static PetscBool FacesEachOther_Private(const PetscReal X[], const PetscReal Y[])
{
  const PetscReal ax = X[2] - X[0], ay = X[3] - X[1], bx = Y[2] - Y[0], by = Y[3] - Y[1];

  return (PetscBool)(ax * bx + ay * by < FACING * PetscSqrtReal((ax * ax + ay * ay) * (bx * bx + by * by)));
}

/* Whether some point of a piece is within reach, in front or behind. */
static PetscBool WithinReach_Private(PetscInt num, const ClipPoint points[], PetscReal reach)
{
  for (PetscInt p = 0; p < num; p++) {
    if (PetscAbsReal(points[p].gap) <= reach) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

static ClipFacet MortarFacet_Private(const MortarSurface *mortar, PetscInt f)
{
  return (ClipFacet){mortar->type[f], &mortar->coords[f * ELEMENT_MAX_FACET_NODES * 2], NULL};
}

/* Points of the part [from, to] of a facet against one mortar facet, on the facet's own reference cell. The part is a
   facet of the same type; its normals are those of the whole facet, not normalised, and send the same rays. */
static PetscInt ClipPart_Private(const ClipFacet *facet, const PetscReal ends[], const ClipFacet *mortar,
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

/* The part of the facet that the Gauss points of one piece stand for, from its first and last one. num > 1 */
static void PieceEnds_Private(PetscInt num, const ClipPoint points[], PetscReal ends[])
{
  PetscReal s[CLIP_MAX_GAUSS], w[CLIP_MAX_GAUSS], length;

  GaussLine(num, s, w);
  length  = (points[num - 1].xi[0] - points[0].xi[0]) / (s[num - 1] - s[0]);
  ends[0] = points[0].xi[0] - s[0] * length;
  ends[1] = ends[0] + length;
}

/* The parts of a facet that mortar facets cover. */
typedef struct {
  PetscInt   num;
  PetscInt  *facet;   /* [num] */
  PetscReal *ends;    /* on the facet's reference cell [num][2] */
  PetscReal  covered; /* sum of the parts: 1 for the whole facet */
} PieceList;

/* Keeps, wherever two layers of the mortar side lie over a part of the facet, the one of smallest |gap|. */
static PetscErrorCode KeepNearestLayer_Private(const FacetPartner *partner, const ClipFacet *facet, PieceList *pieces,
                                               PointList *list)
{
  ClipPoint points[CLIP_MAX_POINTS], best[CLIP_MAX_POINTS];

  PetscFunctionBeginUser;
  PetscCall(PetscSortReal(2 * pieces->num, pieces->ends));
  list->num = 0;
  for (PetscInt e = 0; e + 1 < 2 * pieces->num; e++) {
    PetscReal nearest  = PETSC_MAX_REAL;
    PetscInt  num_best = 0, best_facet = -1;
    if (pieces->ends[e + 1] - pieces->ends[e] <= SAME_END) continue;
    for (PetscInt i = 0; i < pieces->num; i++) {
      const ClipFacet mortar    = MortarFacet_Private(partner->mortar, pieces->facet[i]);
      const PetscInt  num_gauss = PointsPerPiece_Private(partner->spec, facet, &mortar);
      const PetscInt  num       = ClipPart_Private(facet, &pieces->ends[e], &mortar, num_gauss, points);
      PetscReal       gap       = 0;
      for (PetscInt p = 0; p < num; p++) gap += PetscAbsReal(points[p].gap) / num;
      if (num == 0 || gap >= nearest) continue;
      nearest    = gap;
      num_best   = num;
      best_facet = pieces->facet[i];
      PetscCall(PetscArraycpy(best, points, num));
    }
    for (PetscInt p = 0; p < num_best; p++) PetscCall(PointListAdd_Private(list, &best[p], best_facet));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Collects the quadrature points of a line facet against the mortar side. */
static PetscErrorCode CollectMortarPoints_Private(const FacetPartner *partner, const ClipFacet *facet, PointList *list)
{
  PieceList       pieces = {0, NULL, NULL, 0};
  PetscInt        num_hits;
  const PetscInt *hits;
  ClipPoint       points[CLIP_MAX_POINTS];

  PetscFunctionBeginUser;
  PetscCall(MortarSurfaceQuery(partner->mortar, 2, facet, partner->reach, &num_hits, &hits));
  PetscCall(PetscMalloc2(2 * CLIP_MAX_PIECES * num_hits, &pieces.ends, CLIP_MAX_PIECES * num_hits, &pieces.facet));
  for (PetscInt h = 0; h < num_hits; h++) {
    const ClipFacet mortar    = MortarFacet_Private(partner->mortar, hits[h]);
    const PetscInt  num_gauss = PointsPerPiece_Private(partner->spec, facet, &mortar);
    PetscInt        num;
    if (!FacesEachOther_Private(facet->X, mortar.X)) continue;
    num = ClipLines(facet, &mortar, num_gauss, points);
    if (num == 0 || !WithinReach_Private(num, points, partner->reach)) continue;
    for (PetscInt p = 0; p < num; p++) PetscCall(PointListAdd_Private(list, &points[p], hits[h]));
    for (PetscInt p = 0; p < num; p += num_gauss) {
      PetscReal *ends = &pieces.ends[2 * pieces.num];
      PieceEnds_Private(num_gauss, &points[p], ends);
      pieces.covered += ends[1] - ends[0];
      pieces.facet[pieces.num++] = hits[h];
    }
  }
  if (pieces.covered > 1 + OVERLAP_TOLERANCE) PetscCall(KeepNearestLayer_Private(partner, facet, &pieces, list));
  PetscCall(PetscFree2(pieces.ends, pieces.facet));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Collects the points of a line facet against an obstacle: the whole facet, if any of it is within reach along the
   facet's own normal. That of a node at a sharp edge may see what the facet turns its back on. */
static PetscErrorCode CollectObstaclePoints_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                    PointList *list)
{
  const PetscInt num_gauss = PointsPerPiece_Private(partner->spec, facet, NULL);
  PetscReal      xi[CLIP_MAX_GAUSS], w[CLIP_MAX_GAUSS], x[2], nu[2], phi[ELEMENT_MAX_NODES], own;
  PetscBool      near = PETSC_FALSE;

  PetscFunctionBeginUser;
  GaussLine(num_gauss, xi, w);
  for (PetscInt q = 0; q < num_gauss; q++) {
    ClipPoint point = {.xi = {xi[q], 0}, .eta = {0, 0}};
    PetscReal n[2]  = {0, 0}, norm;
    point.weight    = w[q] * ElementSurface(facet->type, facet->X, &xi[q], x, phi, nu);
    for (PetscInt i = 0; i < ElementNumNodes(facet->type); i++) {
      for (PetscInt k = 0; k < 2; k++) n[k] += phi[i] * facet->N[2 * i + k];
    }
    norm = PetscSqrtReal(n[0] * n[0] + n[1] * n[1]);
    for (PetscInt k = 0; k < 2; k++) n[k] /= norm;
    PetscCall(ObstacleGap(&partner->spec->obstacle, 2, x, n, &point.gap));
    PetscCall(ObstacleGap(&partner->spec->obstacle, 2, x, nu, &own));
    if (own <= partner->reach) near = PETSC_TRUE;
    PetscCall(PointListAdd_Private(list, &point, -1));
  }
  if (!near) list->num = 0;
  for (PetscInt p = 0; p < list->num; p++) {
    if (list->point[p].gap >= PETSC_INFINITY) list->num = 0; // part of the facet turns its back on the obstacle
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PointListCreate(const FacetPartner *partner, const ClipFacet *facet, PointList *list)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(list, sizeof(*list)));
  if (partner->mortar)
    PetscCall(CollectMortarPoints_Private(partner, facet, list));
  else
    PetscCall(CollectObstaclePoints_Private(partner, facet, list));
  PetscFunctionReturn(PETSC_SUCCESS);
}
