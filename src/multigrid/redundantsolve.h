/* redundantsolve.h -- redundant factorization of a small matrix, on every rank or on one of each group. */
#ifndef MORTISE_REDUNDANTSOLVE_H
#define MORTISE_REDUNDANTSOLVE_H

#include <petscksp.h>

/* Makes pc, whose matrix is SPD, a factorization that every rank, or one of each group of ranks, computes by
   itself. Options are those of PETSc, with the prefix of pc. Collective. */
PetscErrorCode RedundantSolveSetPC(PC pc);

#endif
