/* multigrid.h -- the PC type `truncatedmg`: truncated multigrid; internal (eq. 13.3). */
#ifndef MORTISE_MULTIGRID_H
#define MORTISE_MULTIGRID_H

#include <petscsnes.h>
#include "multigrid/hierarchy.h"

#define PCTRUNCATEDMG "truncatedmg"

/* Registers the type. Not collective. Options: those of PCMG with the prefix of the PC; -mg_levels_ksp_max_it
   <3, more on coarse levels> */
PetscErrorCode MultigridRegister(void);
/* Sets the levels of a PC of this type; does nothing for other types. Collective.
   [in] hierarchy - borrowed; [in] finest - level of the PC's vectors; [in] snes - borrowed: of type
   `vinewtonrsls`, where the PC acts on its inactive unknowns, else NULL. Its Jacobian is replaced by one
   whose submatrices are not copies */
PetscErrorCode MultigridSetHierarchy(PC pc, Hierarchy hierarchy, PetscInt finest, SNES snes);
/* Sets which unknowns are free (1) and which are fixed (0). Collective.
   [in] more - what is added to the finest matrix, few entries, or NULL */
PetscErrorCode MultigridSetFree(PC pc, Vec free, Mat more);
/* Whether the smoother of the finest level contains the matrix that is added there. Not collective. */
PetscErrorCode MultigridSmoothsMore(PC pc, PetscBool *smooths);
/* Shortens the smoothing steps on all levels: for a cycle that is indefinite, since estimates of largest
   eigenvalues may be too small. Collective. */
PetscErrorCode MultigridShortenSteps(PC pc);
/* A with rows and columns of fixed unknowns emptied but for the diagonal; not a copy. Borrowed. Not
   collective. */
PetscErrorCode MultigridGetOperator(PC pc, Mat *A);

/* Counts a product with the finest matrix outside of the PC. Not collective. */
PetscErrorCode MultigridAddWork(PC pc);
/* The levels of the PC. Borrowed. Not collective. */
PetscErrorCode MultigridGetHierarchy(PC pc, Hierarchy *hierarchy);
/* size = |T'K T y| in the norm of diag(A)^-1, with reactions of supports and contact forces; energy = y'T'K T
   y. Collective. */
PetscErrorCode MultigridGetForces(PC pc, Vec y, PetscReal *size, PetscReal *energy);
/* Starts a new estimate of the error. Not collective. */
PetscErrorCode MultigridResetError(PC pc);
/* Estimates the order of magnitude of e'A e for the error e of the last iterate. It is r'B r of the iterate
   before, times the last reduction of r'B r. PETSC_MAX_REAL before the first cycle. Not collective. */
PetscErrorCode MultigridGetError(PC pc, PetscReal *square);

#endif
