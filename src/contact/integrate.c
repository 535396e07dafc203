/* integrate.c -- the integrals of one nonmortar facet against everything it may touch.

   All quadrature points of a facet, from all mortar facets that cover it, are collected first. The dual basis is built
   from these very points (Cichosz & Bischoff 2011 on cut facets), then D, M and the weighted gap are summed over them:
   biorthogonality, row sums and linear reproduction then hold to roundoff for any rule. */
#include <mortise/compat.h>
#include <mortise/dual.h>
#include "integrate.h"

enum { START_COLUMNS = 16 }; /* first size of the list of mortar nodes */

ElementType CarrierType(const ScenePair *spec, ElementType facet)
{
  return spec->multipliers == MULTIPLIERS_VERTICES ? ElementLinear(facet) : facet;
}

/* Position of a global node among the columns, added if it is new. */
static PetscErrorCode FindColumn_Private(FacetIntegral *integral, PetscInt node, PetscInt *column)
{
  PetscFunctionBeginUser;
  for (*column = 0; *column < integral->num_columns; (*column)++) {
    if (integral->columns[*column] == node) PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (integral->num_columns == integral->max_columns) {
    integral->max_columns = integral->max_columns ? 2 * integral->max_columns : START_COLUMNS;
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

/* What the weights of a facet's points become in this scene: those of the ring that a point stands for. */
static void WeighPoints_Private(const FacetPartner *partner, const ClipFacet *facet, PointList *list)
{
  PetscReal phi[ELEMENT_MAX_NODES], x[3];

  for (PetscInt p = 0; p < list->num; p++) {
    ElementSurface(facet->type, facet->X, list->point[p].xi, x, phi, NULL);
    list->point[p].weight *= SceneRing(partner->scene, x);
  }
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

/* D, M, G and what couples with nodes that carry no multiplier, from the collected points. */
static PetscErrorCode SumPoints_Private(const FacetPartner *partner, const ClipFacet *facet, const PointList *list,
                                        FacetIntegral *integral)
{
  const PetscInt num_nodes = ElementNumNodes(facet->type);
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
  regular = DualBasisCreate(CarrierType(partner->spec, facet->type), list->num, xi, w, &dual);
  for (PetscInt p = 0; regular && p < list->num; p++) { // a sliver without measure is not covered
    PetscReal phi[ELEMENT_MAX_NODES], psi[ELEMENT_MAX_NODES], gap = list->point[p].gap;
    ElementShape(facet->type, &xi[2 * p], phi, NULL);
    DualBasisEvaluate(&dual, &xi[2 * p], psi);
    PetscCall(GapAt_Private(partner, num_nodes, facet->X, phi, &gap));
    PetscCall(AddPoint_Private(partner, &list->point[p], list->facet[p], psi, gap, integral));
    for (PetscInt i = 0; i < integral->n; i++) {
      for (PetscInt j = integral->n; j < num_nodes; j++) integral->chain[i][j] += w[p] * psi[i] * phi[j];
    }
  }
  if (regular) PetscCall(PetscArraycpy(integral->covered, dual.D, integral->n));
  PetscCall(PetscFree2(xi, w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FacetIntegrate(const FacetPartner *partner, const ClipFacet *facet, FacetIntegral *integral)
{
  const ElementType carrier   = CarrierType(partner->spec, facet->type);
  const PetscInt    num_gauss = PointsCurved(facet->type);
  PetscReal         xi[CLIP_MAX_GAUSS], w[CLIP_MAX_GAUSS], phi[ELEMENT_MAX_NODES], x[3];
  PointList         list;

  PetscFunctionBeginUser;
  integral->n           = ElementNumNodes(carrier);
  integral->num_columns = 0;
  integral->measure = integral->cover = 0;
  for (PetscInt i = 0; i < integral->n; i++) {
    integral->covered[i] = integral->full[i] = integral->gap[i] = 0;
    PetscCall(PetscArrayzero(integral->chain[i], ELEMENT_MAX_FACET_NODES));
  }
  GaussLine(num_gauss, xi, w);
  for (PetscInt q = 0; q < num_gauss; q++) {
    PetscReal weight = w[q] * ElementSurface(facet->type, facet->X, &xi[q], x, phi, NULL);
    weight *= SceneRing(partner->scene, x);
    integral->measure += weight;
    ElementShape(carrier, &xi[q], phi, NULL);
    for (PetscInt i = 0; i < integral->n; i++) integral->full[i] += weight * phi[i];
  }
  PetscCall(PointListCreate(partner, facet, &list));
  WeighPoints_Private(partner, facet, &list);
  PetscCall(SumPoints_Private(partner, facet, &list, integral));
  PetscCall(PointListDestroy(&list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FacetIntegralDestroy(FacetIntegral *integral)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(integral->columns));
  PetscCall(PetscFree(integral->M));
  PetscFunctionReturn(PETSC_SUCCESS);
}
