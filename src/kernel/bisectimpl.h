/* bisectimpl.h -- what bisection and splitting share. Private to this module. */
#ifndef MORTISE_BISECTIMPL_H
#define MORTISE_BISECTIMPL_H

#include "kernel/bisect.h"
#include "kernel/edgetable.h"

/* The arrays of a first mesh, in the order that is given.
   [in] corners - of a cell; cells, facets - [num_cells][corners] */
PetscErrorCode BisectionBegin(PetscInt dim, PetscInt corners, PetscInt num_vertices, PetscInt num_cells,
                              const PetscInt cells[], const PetscInt facets[], Bisection *mesh);
/* Cells become their own parents. */
void BisectionSetParents(Bisection *mesh);
/* Room for one more vertex and one more cell. */
PetscErrorCode BisectionGrow(Bisection *mesh);
/* The vertex in the middle of an edge, made if it is new. [in,out] middles - of edges */
PetscErrorCode BisectionGetMiddle(Bisection *mesh, EdgeTable *middles, PetscInt a, PetscInt b, PetscInt *middle);
/* Cells in the order of their parents: neighbours stay near each other in memory. */
PetscErrorCode BisectionSort(Bisection *mesh);

#endif
