/* facets.c -- lists of facets. */
#include "level/facets.h"
#include "base/compat.h"
#include "kernel/vector.h"
#include "level/leveltables.h"

enum { F = ELEMENT_MAX_FACET_NODES };

PetscErrorCode FacetsAllocate(PetscInt num, Facets *facets)
{
  PetscFunctionBeginUser;
  facets->num = num;
  PetscCall(PetscMalloc3(num, &facets->type, num, &facets->cell, num * F, &facets->nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FacetsAppend(Facets *more, Facets *facets)
{
  Facets both;

  PetscFunctionBeginUser;
  PetscCall(FacetsAllocate(facets->num + more->num, &both));
  PetscCall(PetscArraycpy(both.type, facets->type, facets->num));
  PetscCall(PetscArraycpy(both.cell, facets->cell, facets->num));
  PetscCall(PetscArraycpy(both.nodes, facets->nodes, facets->num * F));
  PetscCall(PetscArraycpy(&both.type[facets->num], more->type, more->num));
  PetscCall(PetscArraycpy(&both.cell[facets->num], more->cell, more->num));
  PetscCall(PetscArraycpy(&both.nodes[facets->num * F], more->nodes, more->num * F));
  PetscCall(FacetsDestroy(facets));
  PetscCall(FacetsDestroy(more));
  *facets = both;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FacetsDestroy(Facets *facets)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree3(facets->type, facets->cell, facets->nodes));
  facets->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal FacetGetMeasure(const Level *level, const Facets *facets, PetscInt f, PetscReal normal[])
{
  const ElementType type = ElementLinear(facets->type[f]);
  PetscReal         X[F * 3], xi[3], weight[1], phi[ELEMENT_MAX_NODES];

  VectorGather(level->dim, ElementNumNodes(type), &facets->nodes[f * F], level->coords, X);
  (void)QuadratureRule(type, 1, xi, weight); // the point in the middle
  return weight[0] * ElementSurface(type, X, xi, NULL, phi, normal);
}

/* Orders the nodes of a facet of first order for an outward normal, for any orientation of its cell. */
static void FacetTurnOut_Private(const Level *mapped, Facets *facets, PetscInt f)
{
  const Level     before = LevelBeforeMap(mapped), *level = &before; // positions after the map may not exist yet
  const PetscInt *cell = &level->cell_nodes[level->cell_start[facets->cell[f]]];
  const PetscInt  dim = level->dim, n = LevelNumVertices(level, facets->cell[f]);
  const PetscInt  last = ElementNumNodes(facets->type[f]) - 1,
                 first = dim == 3 ? 1 : 0; // of the nodes that are exchanged
  PetscInt *nodes      = &facets->nodes[f * F], node;
  PetscReal normal[3], inward = 0;

  (void)FacetGetMeasure(level, facets, f, normal);
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt k = 0; k < dim; k++)
      inward += normal[k] * (level->coords[cell[i] * dim + k] - level->coords[nodes[0] * dim + k]);
  }
  if (inward <= 0) return;
  node         = nodes[first];
  nodes[first] = nodes[last];
  nodes[last]  = node;
}

void FacetsTurnOut(const Level *level, Facets *facets)
{
  for (PetscInt f = 0; f < facets->num; f++) FacetTurnOut_Private(level, facets, f);
}

/* Compares sets of vertices: the first vertex of a facet, and its orientation, may differ. */
PetscInt CellFindFacet(ElementType type, const PetscInt cell[], const PetscInt facet[])
{
  const PetscInt num_nodes = ElementNumNodes(ElementLinear(ElementFacetType(type)));

  for (PetscInt f = 0; f < ElementNumFacets(type); f++) {
    const PetscInt *nodes = ElementFacetNodes(type, f);
    PetscInt        found = 0;

    for (PetscInt i = 0; i < num_nodes; i++) {
      for (PetscInt j = 0; j < num_nodes; j++) found += cell[nodes[i]] == facet[j];
    }
    if (found == num_nodes) return f;
  }
  return -1;
}
