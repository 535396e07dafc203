/* activesolver.c -- the common part of both solvers for an active set. */
#include "pdas/pdasimpl.h"

const char *ActiveSolverFailureOfFactor(MatFactorError error)
{
  switch (error) {
  case MAT_FACTOR_NOERROR: return NULL;
  case MAT_FACTOR_OUTMEMORY: return FAILURE_MEMORY;
  default: return FAILURE_SINGULAR;
  }
}

PetscErrorCode ActiveSolverCreate(const ActiveSet *set, Mat A, Vec b, PetscReal rtol, ActiveSolver *solver)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(solver));
  (*solver)->set  = set;
  (*solver)->A    = A;
  (*solver)->b    = b;
  (*solver)->rtol = (*solver)->target = rtol;
  PetscCall(VecDuplicate(b, &(*solver)->diag));
  PetscCall(MatGetDiagonal(A, (*solver)->diag));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSolverDestroy(ActiveSolver *solver)
{
  PetscFunctionBeginUser;
  if ((*solver)->destroy) PetscCall((*solver)->destroy(*solver));
  PetscCall(VecDestroy(&(*solver)->diag));
  PetscCall(PetscFree(*solver));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSolverResidual(ActiveSolver solver, const PetscBool fixed[], Vec y, Vec r, Vec f, PetscReal *size)
{
  const ActiveSet   *set = solver->set;
  const PetscScalar *diag;
  PetscScalar       *a;
  PetscInt           n;
  PetscReal          sum = 0;

  PetscFunctionBeginUser;
  PetscCall(CompensatedResidual(solver->A, solver->b, y, r));
  PetscCall(VecCopy(r, f));
  PetscCall(VecGetLocalSize(f, &n));
  PetscCall(VecGetArray(f, &a));
  PetscCall(VecGetArrayRead(solver->diag, &diag));
  for (PetscInt i = 0; i < set->n; i++) {
    if (fixed[i]) a[set->dof[i] - set->dof_begin] = 0;
  }
  for (PetscInt i = 0; i < n; i++) sum += PetscRealPart(a[i] * a[i] / diag[i]);
  PetscCall(VecRestoreArrayRead(solver->diag, &diag));
  PetscCall(VecRestoreArray(f, &a));
  PetscCallMPI(MPI_Allreduce(&sum, size, 1, MPIU_REAL, MPI_SUM, set->comm));
  *size = PetscSqrtReal(*size);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* With D = diag(A) and the roundoff |e_j| <= epsilon |y_j| / 2 of y,  |A e|_D^-1 <= m epsilon / 2 |y|_D, m
   the largest eigenvalue of D^-1 A. It is two to four for most cells, more in the basis of contact. Stiff
   bodies on soft ones move far at small stresses: there it may exceed rtol. */
PetscErrorCode ActiveSolverSuffices(ActiveSolver solver, Vec y, PetscReal size, PetscReal reference,
                                    PetscBool *suffices)
{
  static const PetscReal LAST_DIGIT   = 4 * PETSC_MACHINE_EPSILON;
  static const PetscReal MAX_ROUNDOFF = 1e-6; /* larger roundoff means a nearly singular matrix */
  Vec                    scaled;
  PetscScalar            square;

  PetscFunctionBeginUser;
  *suffices = (PetscBool)(size <= solver->rtol * reference);
  if (*suffices || !(size <= MAX_ROUNDOFF * reference)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDuplicate(y, &scaled));
  PetscCall(VecPointwiseMult(scaled, solver->diag, y));
  PetscCall(VecDot(scaled, y, &square));
  PetscCall(VecDestroy(&scaled));
  *suffices = (PetscBool)(size <= LAST_DIGIT * PetscSqrtReal(PetscRealPart(square)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSolverRestrict(ActiveSolver solver, Vec y, Vec r, Vec f, ActiveSolution *solution)
{
  const ActiveSet *set = solver->set;
  PetscReal       *free;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(set->n, &free));
  PetscCall(ActiveSetGather(set, y, free));
  PetscCall(ActiveSetGather(set, r, solution->r));
  for (PetscInt i = 0; i < set->n; i++) {
    if (solution->fixed[i]) continue;
    solution->y[i] = free[i];
    solution->r[i] = 0;
  }
  PetscCall(PetscFree(free));
  PetscCall(VecNorm(y, NORM_INFINITY, &solution->size));
  PetscCall(VecNorm(f, NORM_2, &solution->norm));
  PetscFunctionReturn(PETSC_SUCCESS);
}
