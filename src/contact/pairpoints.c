/* pairpoints.c -- a list of points that grows facet by facet. */
#include "base/compat.h"
#include "contact/leverarm.h"
#include "contact/pairpoints.h"
#include "kernel/vector.h"

enum { F = ELEMENT_MAX_FACET_NODES, START_POINTS = 64 };

PetscErrorCode PairPointsCreate(PairPoints *points)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairPointsAdd(PairPoints points, PetscInt facet, const OverlapPoints *list)
{
  PetscFunctionBeginUser;
  if (points->num + list->num > points->max) {
    points->max = PetscMax(PetscMax(START_POINTS, 2 * points->max), points->num + list->num);
    PetscCall(PetscRealloc(sizeof(PairPoint) * (size_t)points->max, &points->point));
  }
  for (PetscInt p = 0; p < list->num; p++) {
    const ClipPoint *from = &list->point[p];

    points->point[points->num++] = (PairPoint){.facet  = facet,
                                               .mortar = list->facet[p],
                                               .xi     = {from->xi[0], from->xi[1]},
                                               .eta    = {from->eta[0], from->eta[1]},
                                               .weight = from->weight,
                                               .gap    = from->gap};
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairPointsSetMortar(PairPoints points, PetscInt dim, const MortarSurface *surface)
{
  PetscFunctionBeginUser;
  points->num_mortar = surface->num;
  PetscCall(PetscMalloc5(surface->num, &points->type, surface->num * F, &points->nodes, surface->num, &points->cell,
                         surface->num, &points->material, surface->num, &points->size));
  PetscCall(PetscArraycpy(points->type, surface->type, surface->num));
  PetscCall(PetscArraycpy(points->nodes, surface->nodes, surface->num * F));
  PetscCall(PetscArraycpy(points->cell, surface->cell, surface->num));
  PetscCall(PetscArraycpy(points->material, surface->material, surface->num));
  for (PetscInt f = 0; f < surface->num; f++)
    points->size[f] = ElementLongestEdge(surface->type[f], dim, &surface->coords[f * F * dim]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairPointsDestroy(PairPoints *points)
{
  PetscFunctionBeginUser;
  if (!*points) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FacetsDestroy(&(*points)->facets));
  PetscCall(PetscFree((*points)->rises));
  PetscCall(VecDestroy(&(*points)->normals));
  PetscCall(PetscFree((*points)->point));
  PetscCall(PetscFree5((*points)->type, (*points)->nodes, (*points)->cell, (*points)->material, (*points)->size));
  PetscCall(PetscFree(*points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairPointsFetch(PairPoints points, Vec v, PetscInt bs, PetscReal **values)
{
  PetscInt  *nodes, num = 0;
  PetscReal *fetched;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(points->num_mortar * F, &nodes, points->num_mortar * F * bs, &fetched));
  PetscCall(PetscCalloc1(points->num_mortar * F * bs, values));
  for (PetscInt f = 0; f < points->num_mortar; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(points->type[f]); i++) nodes[num++] = points->nodes[f * F + i];
  }
  PetscCall(MortarSurfaceFetch(v, bs, num, nodes, fetched));
  num = 0;
  for (PetscInt f = 0; f < points->num_mortar; f++) {
    const PetscInt n = ElementNumNodes(points->type[f]) * bs;

    PetscCall(PetscArraycpy(&(*values)[f * F * bs], &fetched[num], n));
    num += n;
  }
  PetscCall(PetscFree2(nodes, fetched));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void PairPointTakeArm(PairPoints points, const Level *level, const PairPoint *point, const PetscReal X[],
                      const PetscReal u[], PetscReal jump[])
{
  const PetscInt    dim  = level->dim;
  const ElementType type = points->facets.type[point->facet], other = points->type[point->mortar];
  const ClipPoint   at = {.xi = {point->xi[0], point->xi[1]}, .eta = {point->eta[0], point->eta[1]}};
  PetscReal         own[3 * F], blocks[3 * 3 * F];
  const ClipFacet   facet = {.type = type, .X = own}, mortar = {.type = other, .X = &X[point->mortar * F * dim]};

  ContactFacetCoordinates(level, &points->facets, point->facet, own);
  if (!LeverArmAtPoint(dim, &facet, &mortar, &at, ElementLongestEdge(type, dim, own), blocks)) return;
  for (PetscInt i = 0; i < ElementNumNodes(other); i++) {
    for (PetscInt k = 0; k < dim; k++)
      jump[k] -= VectorDot(dim, &blocks[(i * dim + k) * dim], &u[(point->mortar * F + i) * dim]);
  }
}
