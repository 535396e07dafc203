/* integrate.c -- the integrals of one nonmortar facet against everything it may touch.

   All quadrature points of a facet, from all mortar facets that cover it, are collected first. The dual basis is built
   from these very points (Cichosz & Bischoff 2011 on cut facets), then D, M and the weighted gap are summed over them:
   biorthogonality, row sums and linear reproduction then hold to roundoff for any rule. */
#include <mortise/compat.h>
#include <mortise/clip.h>
#include <mortise/dual.h>
#include <mortise/obstacle.h>
#include "integrate.h"

/* Sides face each other when the cosine of their normals is below this. */
static const PetscReal FACING = -0.3;
/* Two layers of the mortar side are seen when the pieces sum to more than the facet by this share. */
static const PetscReal OVERLAP_TOLERANCE = 1e-8;
/* Ends of pieces closer than this share of the facet are one. */
static const PetscReal SAME_END = 1e-10;
/* Normals that differ by less do not turn. */
static const PetscReal TURN_TOLERANCE = 1e-12;

enum {
  FLAT_POINTS  = 2, /* exact for the product of two linear functions */
  TURN_POINTS  = 4, /* turning normals, and gaps given as expressions, are not polynomials */
  START_POINTS = 64 /* first size of the list of points */
};

/* The quadrature points of one facet; point p lies on mortar facet facet[p] (-1: obstacle). */
typedef struct {
  PetscInt   num, max;
  ClipPoint *point;
  PetscInt  *facet;
} PointList;

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

/* Gauss points per piece: the fewest that are exact on flat facets whose gap is linear. */
static PetscInt PointsPerPiece_Private(const ScenePair *spec, PetscInt dim, const PetscReal N[])
{
  PetscReal turn = 0;

  for (PetscInt k = 0; k < dim; k++) turn = PetscMax(turn, PetscAbsReal(N[k] - N[dim + k]));
  if (turn > TURN_TOLERANCE || spec->obstacle.kind != OBSTACLE_NONE) return TURN_POINTS;
  if (spec->gap && !ExpressionIsConstant(spec->gap)) return TURN_POINTS;
  if (spec->gap_offset && !ExpressionIsConstant(spec->gap_offset)) return TURN_POINTS;
  return FLAT_POINTS;
}

/* Whether a mortar facet faces a nonmortar facet: cosine of the outward normals (dy,-dx). */
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

/* Box around a facet, widened by the reach. [out] box - [2][dim] */
static void QueryBox_Private(PetscInt dim, PetscInt n, const PetscReal X[], PetscReal reach, PetscReal box[])
{
  for (PetscInt k = 0; k < dim; k++) {
    box[k] = box[dim + k] = X[k];
    for (PetscInt i = 1; i < n; i++) {
      box[k]       = PetscMin(box[k], X[i * dim + k]);
      box[dim + k] = PetscMax(box[dim + k], X[i * dim + k]);
    }
    box[k] -= reach;
    box[dim + k] += reach;
  }
}

/* Points of the part [from, to] of a facet against one mortar facet, on the facet's own reference cell. */
static PetscInt ClipPart_Private(const PetscReal X[], const PetscReal N[], PetscReal from, PetscReal to,
                                 const PetscReal Y[], PetscInt num_gauss, ClipPoint points[])
{
  const PetscReal ends[2] = {from, to};
  PetscReal       Xp[4], Np[4];
  PetscInt        num;

  for (PetscInt e = 0; e < 2; e++) {
    for (PetscInt k = 0; k < 2; k++) {
      Xp[2 * e + k] = (1 - ends[e]) * X[k] + ends[e] * X[2 + k];
      Np[2 * e + k] = (1 - ends[e]) * N[k] + ends[e] * N[2 + k]; // not normalised: the same rays as on the whole facet
    }
  }
  num = ClipLines(Xp, Np, Y, num_gauss, points);
  for (PetscInt p = 0; p < num; p++) points[p].xi[0] = from + (to - from) * points[p].xi[0];
  return num;
}

/* The part of the facet that a list of Gauss points of one piece stands for: its ends from the outermost points. */
static void PieceEnds_Private(PetscInt num, const ClipPoint points[], PetscReal length, PetscReal *from, PetscReal *to)
{
  PetscReal sum = 0, mean = 0;

  for (PetscInt p = 0; p < num; p++) {
    sum += points[p].weight;
    mean += points[p].weight * points[p].xi[0];
  }
  mean /= sum;
  *from = mean - 0.5 * sum / length;
  *to   = mean + 0.5 * sum / length;
}

/* The parts of a facet that mortar facets cover. */
typedef struct {
  PetscInt   num;
  PetscInt  *facet; /* [num] */
  PetscReal *ends;  /* on the facet's reference cell [num][2] */
} PieceList;

/* Keeps, wherever two layers of the mortar side lie over a part of the facet, the one of smallest |gap|. */
static PetscErrorCode KeepNearestLayer_Private(const MortarSurface *mortar, const PetscReal X[], const PetscReal N[],
                                               PetscInt num_gauss, PieceList *pieces, PointList *list)
{
  ClipPoint points[CLIP_MAX_POINTS], best[CLIP_MAX_POINTS];

  PetscFunctionBeginUser;
  PetscCall(PetscSortReal(2 * pieces->num, pieces->ends));
  list->num = 0;
  for (PetscInt e = 0; e + 1 < 2 * pieces->num; e++) {
    const PetscReal from = pieces->ends[e], to = pieces->ends[e + 1];
    PetscReal       nearest  = PETSC_MAX_REAL;
    PetscInt        num_best = 0, facet = -1;
    if (to - from <= SAME_END) continue;
    for (PetscInt i = 0; i < pieces->num; i++) {
      const PetscReal *Y   = &mortar->coords[pieces->facet[i] * ELEMENT_MAX_FACET_NODES * 2];
      const PetscInt   num = ClipPart_Private(X, N, from, to, Y, num_gauss, points);
      PetscReal        gap = 0;
      for (PetscInt p = 0; p < num; p++) gap += PetscAbsReal(points[p].gap) / num;
      if (num == 0 || gap >= nearest) continue;
      nearest  = gap;
      num_best = num;
      facet    = pieces->facet[i];
      PetscCall(PetscArraycpy(best, points, num));
    }
    for (PetscInt p = 0; p < num_best; p++) PetscCall(PointListAdd_Private(list, &best[p], facet));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Collects the quadrature points of a line facet against the mortar side. */
static PetscErrorCode CollectMortarPoints_Private(const FacetPartner *partner, const PetscReal X[], const PetscReal N[],
                                                  PointList *list)
{
  const PetscInt  num_gauss = PointsPerPiece_Private(partner->spec, 2, N);
  const PetscReal length    = FacetSize(2, 2, X);
  PetscReal       box[4], covered = 0;
  PieceList       pieces = {0, NULL, NULL};
  PetscInt        num_hits;
  const PetscInt *hits;
  ClipPoint       points[CLIP_MAX_POINTS];

  PetscFunctionBeginUser;
  QueryBox_Private(2, 2, X, partner->reach, box);
  PetscCall(BoxTreeQuery(partner->mortar->tree, box, &num_hits, &hits));
  PetscCall(PetscMalloc2(2 * num_hits, &pieces.ends, num_hits, &pieces.facet));
  for (PetscInt h = 0; h < num_hits; h++) {
    const PetscReal *Y    = &partner->mortar->coords[hits[h] * ELEMENT_MAX_FACET_NODES * 2];
    PetscReal       *ends = &pieces.ends[2 * pieces.num];
    PetscInt         num;
    if (!FacesEachOther_Private(X, Y)) continue;
    num = ClipLines(X, N, Y, num_gauss, points);
    if (num == 0 || !WithinReach_Private(num, points, partner->reach)) continue;
    for (PetscInt p = 0; p < num; p++) {
      covered += points[p].weight;
      PetscCall(PointListAdd_Private(list, &points[p], hits[h]));
    }
    PieceEnds_Private(num, points, length, &ends[0], &ends[1]);
    pieces.facet[pieces.num++] = hits[h];
  }
  if (covered > (1 + OVERLAP_TOLERANCE) * length) {
    PetscCall(KeepNearestLayer_Private(partner->mortar, X, N, num_gauss, &pieces, list));
  }
  PetscCall(PetscFree2(pieces.ends, pieces.facet));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Collects the points of a line facet against an obstacle: the whole facet, if any of it is within reach along the
   facet's own normal. That of a node at a sharp edge may see what the facet turns its back on. */
static PetscErrorCode CollectObstaclePoints_Private(const FacetPartner *partner, const PetscReal X[],
                                                    const PetscReal N[], PointList *list)
{
  const PetscReal length = FacetSize(2, 2, X);
  const PetscReal nu[2]  = {(X[3] - X[1]) / length, (X[0] - X[2]) / length};
  PetscReal       xi[TURN_POINTS], w[TURN_POINTS], x[2], n[2], own;
  PetscBool       near = PETSC_FALSE;

  PetscFunctionBeginUser;
  GaussLine(TURN_POINTS, xi, w);
  for (PetscInt q = 0; q < TURN_POINTS; q++) {
    ClipPoint point = {.xi = {xi[q], 0}, .eta = {0, 0}, .weight = w[q] * length};
    PetscReal norm  = 0;
    for (PetscInt k = 0; k < 2; k++) {
      x[k] = (1 - xi[q]) * X[k] + xi[q] * X[2 + k];
      n[k] = (1 - xi[q]) * N[k] + xi[q] * N[2 + k];
      norm += n[k] * n[k];
    }
    for (PetscInt k = 0; k < 2; k++) n[k] /= PetscSqrtReal(norm);
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

/* Position of a global node among the columns, added if it is new. */
static PetscErrorCode FindColumn_Private(FacetIntegral *integral, PetscInt node, PetscInt *column)
{
  PetscFunctionBeginUser;
  for (*column = 0; *column < integral->num_columns; (*column)++) {
    if (integral->columns[*column] == node) PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (integral->num_columns == integral->max_columns) {
    integral->max_columns = integral->max_columns ? 2 * integral->max_columns : START_POINTS;
    PetscCall(PetscRealloc(sizeof(PetscInt) * integral->max_columns, &integral->columns));
    PetscCall(PetscRealloc(sizeof(PetscReal) * ELEMENT_MAX_FACET_NODES * integral->max_columns, &integral->M));
  }
  integral->columns[integral->num_columns++] = node;
  for (PetscInt i = 0; i < ELEMENT_MAX_FACET_NODES; i++) integral->M[*column * ELEMENT_MAX_FACET_NODES + i] = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The gap at a point: measured, or given, plus the offset. */
static PetscErrorCode GapAt_Private(const FacetPartner *partner, PetscInt n, const PetscReal X[], const PetscReal phi[],
                                    PetscReal *gap)
{
  PetscReal x[3] = {0, 0, 0}, offset;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt k = 0; k < partner->dim; k++) x[k] += phi[i] * X[i * partner->dim + k];
  }
  if (partner->spec->gap) PetscCall(ExpressionEvaluate(partner->spec->gap, partner->dim, x, gap));
  if (partner->spec->gap_offset) {
    PetscCall(ExpressionEvaluate(partner->spec->gap_offset, partner->dim, x, &offset));
    *gap += offset;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds one quadrature point to M and the weighted gap. [in] psi - [n] */
static PetscErrorCode AddPoint_Private(const FacetPartner *partner, const ClipPoint *point, PetscInt facet,
                                       const PetscReal psi[], PetscReal gap, FacetIntegral *integral)
{
  PetscReal phi_m[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < integral->n; i++) integral->gap[i] += point->weight * psi[i] * gap;
  if (facet < 0) PetscFunctionReturn(PETSC_SUCCESS);
  ElementShape(partner->mortar->type[facet], point->eta, phi_m, NULL);
  for (PetscInt j = 0; j < ElementNumNodes(partner->mortar->type[facet]); j++) {
    PetscInt column;
    PetscCall(FindColumn_Private(integral, partner->mortar->nodes[facet * ELEMENT_MAX_FACET_NODES + j], &column));
    for (PetscInt i = 0; i < integral->n; i++)
      integral->M[column * ELEMENT_MAX_FACET_NODES + i] += point->weight * psi[i] * phi_m[j];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* D, M and G of the collected points. */
static PetscErrorCode SumPoints_Private(const FacetPartner *partner, ElementType type, const PetscReal X[],
                                        const PointList *list, FacetIntegral *integral)
{
  const PetscInt n = integral->n;
  PetscReal     *phi, *w, A[ELEMENT_MAX_FACET_NODES * ELEMENT_MAX_FACET_NODES], psi[ELEMENT_MAX_FACET_NODES];
  PetscBool      regular;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(list->num * n, &phi, list->num, &w));
  for (PetscInt p = 0; p < list->num; p++) {
    ElementShape(type, list->point[p].xi, &phi[p * n], NULL);
    w[p] = list->point[p].weight;
  }
  regular = list->num > 0 ? DualBasis(n, list->num, phi, w, A, integral->covered) : PETSC_FALSE;
  if (!regular) PetscCall(PetscArrayzero(integral->covered, n)); // a sliver without measure: not covered
  for (PetscInt p = 0; regular && p < list->num; p++) {
    PetscReal gap = list->point[p].gap;
    DualEvaluate(n, A, &phi[p * n], psi);
    PetscCall(GapAt_Private(partner, n, X, &phi[p * n], &gap));
    PetscCall(AddPoint_Private(partner, &list->point[p], list->facet[p], psi, gap, integral));
  }
  PetscCall(PetscFree2(phi, w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FacetIntegrate(const FacetPartner *partner, ElementType type, const PetscReal X[], const PetscReal N[],
                              FacetIntegral *integral)
{
  PointList list = {0, 0, NULL, NULL};
  PetscReal xi[FLAT_POINTS], w[FLAT_POINTS], phi[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  integral->n           = ElementNumNodes(type);
  integral->num_columns = 0;
  for (PetscInt i = 0; i < integral->n; i++) integral->covered[i] = integral->full[i] = integral->gap[i] = 0;
  GaussLine(FLAT_POINTS, xi, w);
  for (PetscInt q = 0; q < FLAT_POINTS; q++) {
    ElementShape(type, &xi[q], phi, NULL);
    for (PetscInt i = 0; i < integral->n; i++) integral->full[i] += w[q] * FacetSize(2, 2, X) * phi[i];
  }
  if (partner->mortar)
    PetscCall(CollectMortarPoints_Private(partner, X, N, &list));
  else
    PetscCall(CollectObstaclePoints_Private(partner, X, N, &list));
  PetscCall(SumPoints_Private(partner, type, X, &list, integral));
  PetscCall(PetscFree(list.point));
  PetscCall(PetscFree(list.facet));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FacetIntegralDestroy(FacetIntegral *integral)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(integral->columns));
  PetscCall(PetscFree(integral->M));
  PetscFunctionReturn(PETSC_SUCCESS);
}
