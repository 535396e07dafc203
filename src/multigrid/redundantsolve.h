/* redundantsolve.h -- redundant factorization of a small matrix, on every rank or on one of each group. */
#ifndef MORTISE_REDUNDANTSOLVE_H
#define MORTISE_REDUNDANTSOLVE_H

#include <petscksp.h>

/* Makes pc, whose matrix is SPD, a factorization that every rank, or one of each group of ranks, computes by
   itself. Options are those of PETSc, with the prefix of pc. Collective. */
PetscErrorCode RedundantSolveSetPC(PC pc);
/* Sends the matrix of pc to the ranks that factor it in PCSetUp(). Nothing is to be sent then, so other ranks
   can do work of their own. Collective. [in] pc - of any type; nothing is done for one made otherwise */
PetscErrorCode RedundantSolveGather(PC pc);

#endif
