/* multigrid.h -- the PC type `truncatedmg`: multigrid that keeps away from active unknowns; internal (eq. 13.3). */
#ifndef MORTISE_MULTIGRID_H
#define MORTISE_MULTIGRID_H

#include <petscsnes.h>
#include "multigrid/hierarchy.h"

#define PCTRUNCATEDMG "truncatedmg"

/* Registers the type. Not collective. Options: those of PCMG behind the prefix of the PC, -mg_levels_ksp_max_it <3, more on coarse levels> ... */
PetscErrorCode MultigridRegister(void);
/* The levels that a PC of this type works on; nothing for other types. Collective.
   [in] hierarchy - borrowed; [in] finest - level that the PC's vectors belong to; [in] snes - borrowed: of the type `vinewtonrsls`
   where the PC is to be applied to the unknowns that this leaves, else NULL; its Jacobian becomes one whose parts are not copies */
PetscErrorCode MultigridSetHierarchy(PC pc, Hierarchy hierarchy, PetscInt finest, SNES snes);
/* Which unknowns are free (1) and which are held (0). Collective. */
PetscErrorCode MultigridSetFree(PC pc, Vec free);
/* Takes shorter steps in smoothing on all levels, for who has found a cycle indefinite: estimates of the largest eigenvalues come from inside, and may
   be too small. Collective. */
PetscErrorCode MultigridShortenSteps(PC pc);
/* A with the rows and columns of held unknowns emptied but for the diagonal, without a copy of it. Borrowed. Not collective. */
PetscErrorCode MultigridGetOperator(PC pc, Mat *A);

/* Counts a product with the finest matrix that the PC had no part in. Not collective. */
PetscErrorCode MultigridAddWork(PC pc);
/* What the PC works on. Borrowed. Not collective. */
PetscErrorCode MultigridGetHierarchy(PC pc, Hierarchy *hierarchy);
/* |T'K T y| in the norm of diag(A)^-1, supports' reactions and contact forces among them, and y'T'K T y. Collective. */
PetscErrorCode MultigridGetForces(PC pc, Vec y, PetscReal *size, PetscReal *energy);
/* What cycles tell of the iteration they precondition: forgets it, */
PetscErrorCode MultigridResetError(PC pc);
/* and e'A e of the last iterate's error e, to the order of magnitude: r'B r of the one before, by the part that the step before that left;
   PETSC_MAX_REAL where no cycle was watched. Not collective. */
PetscErrorCode MultigridGetError(PC pc, PetscReal *square);

#endif
