/* enough.c -- iterating until the error, not the residual, is small enough (T37).

   Cycles of multigrid see the error e of an iterate in the norm of energy, |e|_A^2 ~ r'B r with the residual r; CG computes that number
   anyway. The first one is that of what a coarser mesh knows. */
#include <mortise/compat.h>
#include "active.h"
#include "multigrid.h"

/* A KSP's test. [in] ctx - ActiveSolver */
static PetscErrorCode Enough_Private(KSP ksp, PetscInt it, PetscReal norm, KSPConvergedReason *reason, void *ctx)
{
  ActiveSolver solver = ctx;
  PetscBool    first;
  PetscInt     max_it;
  PetscReal    square;
  PC           pc;

  PetscFunctionBeginUser;
  *reason = KSP_CONVERGED_ITERATING;
  if (PetscIsInfOrNanReal(norm)) *reason = KSP_DIVERGED_NANORINF;
  if (norm == 0) *reason = KSP_CONVERGED_ATOL;
  if (it == 0 || *reason) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(KSPGetTolerances(ksp, NULL, NULL, NULL, &max_it));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(MultigridGetError(pc, &square));
  first = (PetscBool)(solver->first == 0);
  if (first) solver->first = solver->gained + square; // all that a first cycle tells is what it began with
  if (!first && square <= solver->enough * solver->first)
    *reason = KSP_CONVERGED_ATOL;
  else if (it >= max_it)
    *reason = KSP_DIVERGED_ITS;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnoughSet(ActiveSolver solver, KSP ksp, PetscReal enough, PetscReal gained)
{
  PetscFunctionBeginUser;
  solver->enough = enough;
  solver->gained = gained;
  solver->rtol   = 1;
  PetscCall(KSPSetConvergenceTest(ksp, Enough_Private, solver, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}
