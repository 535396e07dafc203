/* bodylist.c -- storage of a body's lists, and the names of its sides.

   A side that the user joins with '+' is a union of named sides. The mesh knows the parts only, so that a
   part that occurs in several unions is labelled once. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include <string.h>

PetscErrorCode BodyListAllocate(PetscInt dim, PetscInt num_cells, PetscInt num_nodes, PetscInt max_facets,
                                BodyList *list)
{
  PetscFunctionBeginUser;
  *list = (BodyList){.dim = dim, .num_cells = num_cells, .num_vertices = num_nodes, .num_nodes = num_nodes};
  PetscCall(PetscMalloc3(num_cells, &list->cell_type, num_cells * ELEMENT_MAX_NODES, &list->cell_nodes, num_nodes * dim,
                         &list->coords));
  PetscCall(PetscMalloc3(max_facets, &list->facet_cell, max_facets, &list->facet, max_facets, &list->facet_side));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyListDestroy(BodyList *list)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree3(list->cell_type, list->cell_nodes, list->coords));
  PetscCall(PetscFree(list->cell_material));
  PetscCall(PetscFree3(list->facet_cell, list->facet, list->facet_side));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideNamesOfBody(Scene scene, PetscInt body, SideNames *names)
{
  const SceneBody *b = &scene->bodies[body];

  PetscFunctionBeginUser;
  *names = (SideNames){0, NULL};
  // sides without use get no label, which would cost time in every refinement
  for (PetscInt i = 0; i < b->num_boundaries; i++) PetscCall(SideNamesAdd(names, b->boundaries[i].side));
  for (PetscInt i = 0; i < scene->num_pairs; i++) {
    const ScenePair *pair = &scene->pairs[i];

    // an obstacle has body -1 as mortar side
    if (pair->nonmortar.body == body) PetscCall(SideNamesAdd(names, pair->nonmortar.side));
    if (pair->mortar.body == body) PetscCall(SideNamesAdd(names, pair->mortar.side));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyListRaise(BodyList *list)
{
  const ElementType linear = list->num_cells ? (ElementType)list->cell_type[0] : ELEMENT_TRI3;
  const ElementType type   = ElementOfOrder(linear, 2);
  const PetscInt    dim = list->dim, corners = ElementNumNodes(linear), more = ElementNumNodes(type) - corners;
  PetscInt          node = list->num_vertices;
  BodyList          high;

  PetscFunctionBeginUser;
  PetscCall(BodyListAllocate(dim, list->num_cells, node + list->num_cells * more, list->num_facets, &high));
  high.num_vertices = list->num_vertices;
  high.num_facets   = list->num_facets;
  PetscCall(PetscArraycpy(high.coords, list->coords, list->num_vertices * dim));
  PetscCall(PetscArraycpy(high.facet_cell, list->facet_cell, list->num_facets));
  PetscCall(PetscArraycpy(high.facet, list->facet, list->num_facets));
  PetscCall(PetscArraycpy(high.facet_side, list->facet_side, list->num_facets));
  for (PetscInt c = 0; c < list->num_cells; c++) {
    PetscInt *nodes = &high.cell_nodes[c * ELEMENT_MAX_NODES];

    high.cell_type[c] = type;
    PetscCall(PetscArraycpy(nodes, &list->cell_nodes[c * ELEMENT_MAX_NODES], corners));
    for (PetscInt k = corners; k < corners + more; k++, node++) {
      PetscReal phi[ELEMENT_MAX_NODES];

      nodes[k] = node;
      ElementShape(linear, ElementNode(type, k), phi, NULL);
      for (PetscInt d = 0; d < dim; d++) {
        high.coords[node * dim + d] = 0;
        for (PetscInt i = 0; i < corners; i++) high.coords[node * dim + d] += phi[i] * list->coords[nodes[i] * dim + d];
      }
    }
  }
  high.num_nonmanifold = list->num_nonmanifold;
  PetscCall(PetscArraycpy(high.nonmanifold, list->nonmanifold, 3));
  PetscCall(BodyListDestroy(list));
  *list = high;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodyListMapVertices(const BodyList *list, const SceneBody *body, PetscReal coords[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(coords, list->coords, list->num_vertices * list->dim));
  for (PetscInt v = 0; v < list->num_vertices && body->map; v++) {
    PetscReal x[3];
    PetscBool finite;

    PetscCall(ExpressionTry(body->map, list->dim, &list->coords[v * list->dim], x, &finite));
    if (finite) PetscCall(PetscArraycpy(&coords[v * list->dim], x, list->dim));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
