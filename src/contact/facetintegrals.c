/* facetintegrals.c -- integrals of one nonmortar facet with all its partners.

   All quadrature points of a facet, from all mortar facets that cover it, are collected first. The dual basis
   is built from these points (Cichosz & Bischoff 2011 on cut facets), then D, M and the weighted gap are
   summed over them. So biorthogonality, row sums and linear reproduction hold to roundoff for any rule. */
#include "base/compat.h"
#include "kernel/rise.h"
#include "kernel/frame.h"
#include "contact/leverarm.h"
#include "contact/facetintegrals.h"
#include "contact/leastgap.h"
#include "contact/smoothgap.h"

/* Covered shares of a facet below it count as zero, those above one less it as one. */
static const PetscReal NOTHING = 1e-9;
/* Nor is this share, where gaps are raised at an edge: polygons of two round sides end a little apart. */
static const PetscReal LITTLE = 0.1;

enum { START_COLUMNS = 16 }; /* first size of the list of mortar nodes */

ElementType FacetIntegralCarrier(const ScenePair *spec, ElementType facet)
{
  return spec->multipliers == MULTIPLIERS_VERTICES ? ElementLinear(facet) : facet;
}

/* Position of a global node among the columns, added if it is new. */
static PetscErrorCode FacetIntegralFindColumn_Private(const FacetPartner *partner, FacetIntegral *integral,
                                                      PetscInt node, PetscInt *column)
{
  const PetscInt arms = partner->spec->type == PAIR_TIED ? ELEMENT_MAX_FACET_NODES * partner->dim * partner->dim : 0;

  PetscFunctionBeginUser;
  for (*column = 0; *column < integral->num_columns; (*column)++) {
    if (integral->columns[*column] == node) PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (integral->num_columns == integral->max_columns) {
    integral->max_columns = integral->max_columns ? 2 * integral->max_columns : START_COLUMNS;
    PetscCall(PetscRealloc(sizeof(PetscInt) * integral->max_columns, &integral->columns));
    PetscCall(PetscRealloc(sizeof(PetscReal) * ELEMENT_MAX_FACET_NODES * integral->max_columns, &integral->M));
    if (arms) PetscCall(PetscRealloc(sizeof(PetscReal) * arms * integral->max_columns, &integral->arm));
  }
  integral->columns[integral->num_columns++] = node;
  for (PetscInt i = 0; i < ELEMENT_MAX_FACET_NODES; i++) integral->M[*column * ELEMENT_MAX_FACET_NODES + i] = 0;
  for (PetscInt i = 0; i < arms; i++) integral->arm[*column * arms + i] = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the offset to the gap at a point: that of the curve, where the facet has one.
   [in] rises - of the facet, or NULL */
static PetscErrorCode FacetIntegralAddOffset_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                     const PetscReal rises[], const PetscReal xi[], PetscReal *gap)
{
  PetscReal x[3], rise[3] = {0, 0, 0}, phi[ELEMENT_MAX_NODES], offset;

  PetscFunctionBeginUser;
  if (!partner->spec->gap_offset) PetscFunctionReturn(PETSC_SUCCESS);
  ElementSurface(facet->type, facet->X, xi, x, phi, NULL);
  if (rises) RiseAt(facet->type, rises, xi, rise);
  for (PetscInt k = 0; k < partner->dim; k++) x[k] += rise[k];
  PetscCall(ExpressionEvaluate(partner->spec->gap_offset, partner->dim, x, &offset));
  *gap += offset;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Multiplies the weights of a facet's points by the length of their rings, in axisymmetric scenes. */
static void FacetIntegralWeighPoints_Private(const FacetPartner *partner, const ClipFacet *facet, OverlapPoints *list)
{
  PetscReal phi[ELEMENT_MAX_NODES], x[3];

  for (PetscInt p = 0; p < list->num && partner->scene->model == MODEL_AXISYMMETRIC; p++) {
    ElementSurface(facet->type, facet->X, list->point[p].xi, x, phi, NULL);
    list->point[p].weight *= SceneRing(partner->scene, x);
  }
}

/* Columns of the nodes of a mortar facet; none of an obstacle. [out] columns - [nodes of the facet] */
static PetscErrorCode FacetIntegralFindColumns_Private(const FacetPartner *partner, PetscInt facet,
                                                       FacetIntegral *integral, PetscInt columns[])
{
  PetscFunctionBeginUser;
  if (facet < 0) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt j = 0; j < ElementNumNodes(partner->mortar->type[facet]); j++)
    PetscCall(FacetIntegralFindColumn_Private(
        partner, integral, partner->mortar->nodes[facet * ELEMENT_MAX_FACET_NODES + j], &columns[j]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds one quadrature point to M. [in] columns - of the mortar facet's nodes; psi - [n] */
static void FacetIntegralAddPoint_Private(const FacetPartner *partner, const ClipFacet *facet, PetscInt mortar,
                                          const ClipPoint *point, const PetscInt columns[], const PetscReal psi[],
                                          FacetIntegral *integral)
{
  const ClipFacet other = OverlapPointsMortarFacet(partner, mortar);
  const PetscInt  num   = ElementNumNodes(other.type);
  PetscReal       phi_m[ELEMENT_MAX_NODES], extra[ELEMENT_MAX_FACET_NODES * ELEMENT_MAX_FACET_NODES];
  PetscBool       turns = integral->turns;

  ElementShape(other.type, point->eta, phi_m, NULL);
  if (turns) turns = LeverArmAlongRows(partner->dim, integral->n, integral->rows->N, facet, &other, point, extra);
  for (PetscInt j = 0; j < num; j++) {
    PetscReal *M = &integral->M[columns[j] * ELEMENT_MAX_FACET_NODES];
    for (PetscInt i = 0; i < integral->n; i++)
      M[i] += point->weight * psi[i] * (turns ? phi_m[j] + extra[i * num + j] : phi_m[j]);
  }
}

/* Adds one quadrature point to the arm. [in] columns - of the mortar facet's nodes; psi - [n] */
static void FacetIntegralAddArm_Private(const FacetPartner *partner, const ClipFacet *facet, PetscInt mortar,
                                        const ClipPoint *point, const PetscInt columns[], const PetscReal psi[],
                                        FacetIntegral *integral)
{
  const PetscInt  squares = partner->dim * partner->dim;
  const ClipFacet other   = OverlapPointsMortarFacet(partner, mortar);
  PetscReal       blocks[9 * ELEMENT_MAX_FACET_NODES];

  if (!LeverArmAtPoint(partner->dim, facet, &other, point, integral->size, blocks)) return;
  integral->has_arm = PETSC_TRUE;
  for (PetscInt j = 0; j < ElementNumNodes(other.type); j++) {
    for (PetscInt i = 0; i < integral->n; i++) {
      PetscReal *arm = &integral->arm[(columns[j] * ELEMENT_MAX_FACET_NODES + i) * squares];

      for (PetscInt k = 0; k < squares; k++) arm[k] += point->weight * psi[i] * blocks[j * squares + k];
    }
  }
}

/* Integrates D, M, G and D_other from the collected points. [in] rises - of the facet, or NULL */
static PetscErrorCode FacetIntegralSumPoints_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                     const PetscReal rises[], OverlapPoints *list,
                                                     FacetIntegral *integral)
{
  const PetscInt num_nodes = ElementNumNodes(facet->type);
  PetscInt       columns[ELEMENT_MAX_FACET_NODES];
  PetscReal     *xi, *w;
  DualBasis      dual;
  PetscBool      regular;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(2 * list->num, &xi, list->num, &w));
  for (PetscInt p = 0; p < list->num; p++) {
    PetscCall(PetscArraycpy(&xi[2 * p], list->point[p].xi, 2));
    w[p] = list->point[p].weight;
    integral->cover += w[p];
  }
  regular =
      DualBasisCreate(FacetIntegralCarrier(partner->spec, facet->type), list->num, xi, w, integral->rows->nodes, &dual);
  for (PetscInt p = 0; regular && p < list->num; p++) { // a sliver without measure is not covered
    const PetscInt f = list->facet[p];
    PetscReal      phi[ELEMENT_MAX_NODES], psi[ELEMENT_MAX_NODES], gap = list->point[p].gap;
    ElementShape(facet->type, &xi[2 * p], phi, NULL);
    DualBasisEvaluate(&dual, &xi[2 * p], psi);
    PetscCall(FacetIntegralAddOffset_Private(partner, facet, rises, &xi[2 * p], &gap));
    list->point[p].gap = gap;
    if (!partner->gap_only && (p == 0 || f != list->facet[p - 1]))
      PetscCall(FacetIntegralFindColumns_Private(partner, f, integral, columns));
    if (!partner->gap_only && f >= 0)
      FacetIntegralAddPoint_Private(partner, facet, f, &list->point[p], columns, psi, integral);
    if (!partner->gap_only && f >= 0 && partner->spec->type == PAIR_TIED)
      FacetIntegralAddArm_Private(partner, facet, f, &list->point[p], columns, psi, integral);
    integral->least_gap = PetscMin(integral->least_gap, gap);
    for (PetscInt i = 0; i < integral->n; i++) {
      integral->gap[i] += w[p] * psi[i] * gap;
      for (PetscInt j = integral->n; j < num_nodes; j++) integral->D_other[i][j] += w[p] * psi[i] * phi[j];
    }
  }
  if (regular) PetscCall(PetscArraycpy(integral->covered, dual.D, integral->n));
  PetscCall(PetscFree2(xi, w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* At an edge the mean gap of a node may be below every gap of the facet, since psi is negative in part; it is
   raised to the least of them. */
static PetscErrorCode FacetIntegralRaiseGap_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                    const OverlapPoints *list, FacetIntegral *integral)
{
  PetscReal least;

  PetscFunctionBeginUser;
  PetscCall(LeastGapAtEdge(partner, facet, list, &least));
  for (PetscInt i = 0; i < integral->n && least > PETSC_MIN_REAL; i++) {
    if (integral->covered[i] > 0) integral->gap[i] = PetscMax(integral->gap[i], integral->covered[i] * least);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* int phi~ over the whole facet, and its measure. */
static void FacetIntegralSumFull_Private(const FacetPartner *partner, const ClipFacet *facet, ElementType carrier,
                                         FacetIntegral *integral)
{
  const PetscInt dim = ElementDim(facet->type);
  PetscReal      xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], x[3];
  const PetscInt num = QuadratureRule(facet->type, OverlapPointsCurvedDegree(facet->type), xi, w);

  for (PetscInt q = 0; q < num; q++) {
    PetscReal weight = w[q] * ElementSurface(facet->type, facet->X, &xi[dim * q], x, phi, NULL);
    weight *= SceneRing(partner->scene, x);
    integral->measure += weight;
    ElementShape(carrier, &xi[dim * q], phi, NULL);
    DualShape(carrier, phi);
    for (PetscInt i = 0; i < integral->n; i++) integral->full[i] += weight * phi[i];
  }
  if (integral->rows->nodes) DualNodesApply(integral->n, integral->rows->nodes, integral->full);
}

/* The overlap boundary within a facet that is covered in part. */
static PetscErrorCode FacetIntegralFindEnds_Private(const FacetPartner *partner, const ClipFacet *facet,
                                                    const OverlapPoints *list, FacetIntegral *integral)
{
  const PetscInt dim = partner->dim;
  PetscReal     *xi;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * CLIP_MAX_CORNERS, &xi));
  for (PetscInt p = 0; p < list->num; p++) {
    const PetscInt f = list->facet[p];
    ClipFacet      mortar;
    PetscInt       num;

    if (p > 0 && f == list->facet[p - 1]) continue;
    mortar = OverlapPointsMortarFacet(partner, f);
    num    = ClipCorners(facet, &mortar, xi);
    PetscCall(PetscRealloc(sizeof(OverlapBoundary) * (integral->num_boundary + num), &integral->boundary));
    for (PetscInt i = 0; i < num; i++) {
      OverlapBoundary *end = &integral->boundary[integral->num_boundary++];
      PetscReal        phi[ELEMENT_MAX_NODES];

      *end = (OverlapBoundary){.mortar = partner->mortar->nodes[f * ELEMENT_MAX_FACET_NODES]};
      ElementSurface(facet->type, facet->X, &xi[2 * i], end->x, phi, NULL);
      for (PetscInt j = 0; j < ElementNumNodes(facet->type); j++)
        for (PetscInt k = 0; k < dim; k++) end->normal[k] += phi[j] * facet->N[j * dim + k];
      FrameNormalize(dim, end->normal);
    }
  }
  PetscCall(PetscFree(xi));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FacetIntegralCompute(const FacetPartner *partner, const ClipFacet *facet, const FacetRows *rows,
                                    const PetscReal rises[], OverlapPoints *list, FacetIntegral *integral)
{
  const ElementType carrier = FacetIntegralCarrier(partner->spec, facet->type);
  PetscReal         curve;

  PetscFunctionBeginUser;
  integral->rows        = rows;
  integral->n           = ElementNumNodes(carrier);
  integral->num_columns = 0;
  integral->has_arm     = PETSC_FALSE;
  integral->turns   = (PetscBool)(partner->spec->type != PAIR_TIED && LeverArmDirectionsDiffer(partner->dim, facet));
  integral->size    = ElementLongestEdge(facet->type, partner->dim, facet->X);
  integral->measure = integral->cover = 0;
  integral->least_gap                 = PETSC_MAX_REAL;
  for (PetscInt i = 0; i < integral->n; i++) {
    integral->covered[i] = integral->full[i] = integral->gap[i] = 0;
    PetscCall(PetscArrayzero(integral->D_other[i], ELEMENT_MAX_FACET_NODES));
  }
  FacetIntegralSumFull_Private(partner, facet, carrier, integral);
  PetscCall(OverlapPointsCollect(partner, facet, list));
  PetscCall(SmoothGapApply(partner, facet, rises, list, &curve));
  FacetIntegralWeighPoints_Private(partner, facet, list);
  PetscCall(FacetIntegralSumPoints_Private(partner, facet, rises, list, integral));
  if (integral->cover >= (1 - LITTLE) * integral->measure)
    integral->least_gap = PetscMin(integral->least_gap, LeastGapAtVertices(facet, list));
  integral->least_gap -= curve;
  integral->fully_covered = (PetscBool)(integral->cover >= (1 - NOTHING) * integral->measure);
  integral->partly_covered =
      (PetscBool)(partner->mortar && !integral->fully_covered && integral->cover > NOTHING * integral->measure);
  if (integral->cover >= (1 - LITTLE) * integral->measure)
    PetscCall(FacetIntegralRaiseGap_Private(partner, facet, list, integral));
  if (integral->partly_covered && !partner->gap_only)
    PetscCall(FacetIntegralFindEnds_Private(partner, facet, list, integral));
  integral->rows = NULL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FacetIntegralDestroy(FacetIntegral *integral)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(integral->columns));
  PetscCall(PetscFree(integral->boundary));
  PetscCall(PetscFree(integral->M));
  PetscCall(PetscFree(integral->arm));
  PetscFunctionReturn(PETSC_SUCCESS);
}
