/* congruentcells.h -- matrices of cells that are translations of each other. Private to this module. */
#ifndef MORTISE_CONGRUENTCELLS_H
#define MORTISE_CONGRUENTCELLS_H

#include "kernel/element.h"

typedef struct _n_CongruentCells *CongruentCells;

/* Creates an empty store. Not collective. */
PetscErrorCode CongruentCellsCreate(PetscInt dim, CongruentCells *cells);
/* The matrix of a stored cell of the same type and material whose nodes are, up to their rounding, those at X
   moved along; NULL if there is none. Not collective. Borrowed until the next CongruentCellsAdd().
   [in] X - [num_nodes][dim] */
const PetscReal *CongruentCellsFind(CongruentCells cells, ElementType type, PetscInt material, const PetscReal X[]);
/* Stores the matrix of a cell that was not found. Not collective. [in] Ke - [num_nodes*dim][num_nodes*dim] */
void           CongruentCellsAdd(CongruentCells cells, ElementType type, PetscInt material, const PetscReal X[],
                                 const PetscReal Ke[]);
PetscErrorCode CongruentCellsDestroy(CongruentCells *cells);

#endif
