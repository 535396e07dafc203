/* cellmeasure.c -- see the header. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/cellmeasure.h"
#include "kernel/vector.h"

PetscReal CellGetMeasure(ElementType type, PetscInt dim, const PetscReal X[])
{
  const PetscInt degree = dim * ElementOrder(type) - 1; // of det J in each direction, at most
  PetscReal      xi[ELEMENT_MAX_POINTS * 3], weight[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], measure = 0;
  const PetscInt num = QuadratureRule(type, degree, xi, weight);

  for (PetscInt q = 0; q < num; q++) measure += weight[q] * ElementMap(type, X, &xi[q * dim], NULL, phi, NULL);
  return measure;
}

PetscReal BodyListGetMeasure(const BodyList *list, PetscInt cell, PetscInt order)
{
  const ElementType of_file = (ElementType)list->cell_type[cell], type = order > 1 ? of_file : ElementLinear(of_file);
  const PetscInt   *nodes = &list->cell_nodes[cell * ELEMENT_MAX_NODES];
  PetscReal         X[ELEMENT_MAX_NODES * 3];

  VectorGather(list->dim, ElementNumNodes(type), nodes, list->coords, X);
  return CellGetMeasure(type, list->dim, X);
}
