/* pairpoints.c -- a list of points that grows facet by facet. */
#include "base/compat.h"
#include "contact/pairpoints.h"

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
    points->size[f] = ContactFacetSize(dim, surface->type[f], &surface->coords[f * F * dim]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairPointsDestroy(PairPoints *points)
{
  PetscFunctionBeginUser;
  if (!*points) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FacetsDestroy(&(*points)->facets));
  PetscCall(VecDestroy(&(*points)->normals));
  PetscCall(PetscFree((*points)->point));
  PetscCall(PetscFree5((*points)->type, (*points)->nodes, (*points)->cell, (*points)->material, (*points)->size));
  PetscCall(PetscFree(*points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairPointsFetch(PairPoints points, Vec v, PetscInt bs, PetscReal **values)
{
  PetscInt          *nodes, num = 0;
  IS                 from;
  Vec                here;
  VecScatter         scatter;
  const PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(points->num_mortar * F, &nodes));
  PetscCall(PetscCalloc1(points->num_mortar * F * bs, values));
  for (PetscInt f = 0; f < points->num_mortar; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(points->type[f]); i++) nodes[num++] = points->nodes[f * F + i];
  }
  PetscCall(ISCreateBlock(PETSC_COMM_SELF, bs, num, nodes, PETSC_OWN_POINTER, &from));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, num * bs, &here));
  PetscCall(VecScatterCreate(v, from, here, NULL, &scatter));
  PetscCall(VecScatterBegin(scatter, v, here, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, v, here, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(here, &value));
  for (PetscInt f = 0, k = 0; f < points->num_mortar; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(points->type[f]) * bs; i++)
      (*values)[f * F * bs + i] = PetscRealPart(value[k++]);
  }
  PetscCall(VecRestoreArrayRead(here, &value));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCall(VecDestroy(&here));
  PetscCall(ISDestroy(&from));
  PetscFunctionReturn(PETSC_SUCCESS);
}
