/* redundantsolve.h -- factors of a small matrix, on every rank. */
#ifndef MORTISE_REDUNDANTSOLVE_H
#define MORTISE_REDUNDANTSOLVE_H

#include <petscksp.h>

/* Makes pc, whose matrix is SPD, a factorisation that every rank has by itself; its controls are PETSc's, behind the prefix of pc. Collective. */
PetscErrorCode RedundantSolveSetPC(PC pc);

#endif
