/* cellsums.h -- sums of cell matrices before they enter a Mat. */
#ifndef MORTISE_CELLSUMS_H
#define MORTISE_CELLSUMS_H

#include "mesh/mesh.h"

/* What the cells of this rank make of the block rows of their nodes. */
typedef struct {
  const Level *level; /* borrowed */
  PetscInt    *start; /* [num_nodes+1] */
  PetscInt    *node;  /* neighbours, local, ascending [start[num_nodes]] */
  PetscReal   *value; /* a node's rows [dim][neighbours][dim], one node after the other */
} Gather;

/* Zeros. Not collective. [out] gather - to be destroyed by CellSumsFinish() */
PetscErrorCode CellSumsCreate(const Level *level, Gather *gather);
/* Adds the matrix of a cell to the sums. Not collective. [in] Ke - [dim * num_nodes][dim * num_nodes] */
void CellSumsAdd(Gather *gather, PetscInt cell, const PetscReal Ke[]);
/* Adds the sums to K, whose assembly is left to do, and frees them. Not collective. */
PetscErrorCode CellSumsFinish(Gather *gather, Mat K);

#endif
