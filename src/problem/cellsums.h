/* cellsums.h -- K as a sum of cell matrices. */
#ifndef MORTISE_CELLSUMS_H
#define MORTISE_CELLSUMS_H

#include "level/level.h"
#include "problem/stiffness.h"

/* Zeros, with places for ConformingHold(). Not collective.
   [out] sums - blocks between nodes of this rank, ghosts included; to be destroyed by CellSumsFinish() */
PetscErrorCode CellSumsCreate(const Level *level, SymmetricBlocks *sums);
/* Adds the matrix of a cell to the sums. Hanging nodes give their rows and columns to nodes they hang on.
   Not collective. [in] Ke - [dim * num_nodes][dim * num_nodes] */
void CellSumsAdd(const Level *level, PetscInt cell, const PetscReal Ke[], SymmetricBlocks *sums);
/* Adds the matrix of some nodes that cells couple. Not collective. [in] A - [bs * num][bs * num] */
void CellSumsAddNodes(PetscInt num, const PetscInt nodes[], const PetscReal A[], SymmetricBlocks *sums);
/* The sums over all ranks. Collective.
   [in] global - numbers of the nodes of sums: those of the level, and more ghosts [sums->num];
   [out] K - StiffnessCreate(), owned by the caller */
PetscErrorCode CellSumsFinish(const Level *level, const PetscInt global[], SymmetricBlocks *sums, Mat *K);

#endif
