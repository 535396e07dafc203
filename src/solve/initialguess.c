/* initialguess.c -- the initial guess of an iteration: zero, closed contacts, or a given displacement.

   A good displacement saves steps: its active set by eq. 10.1 is nearly correct, and iterative linear solvers
   start near their end. A bad one costs steps and changes nothing else, since the solution is unique. If
   contact alone holds a body and nothing is known, the iteration starts with contacts that balance the
   loads. */
#include <string.h>
#include "base/compat.h"
#include "pdas/pdas.h"
#include "pdas/pdasimpl.h"
#include "multigrid/multigrid.h"
#include "solve/solverimpl.h"

/* Tolerance of T y = u: enough to tell which bounds are reached. */
static const PetscReal GUESS_RTOL = 1e-12;
/* Tolerance of a system for the initial guess. */
static const PetscReal START_RTOL = 1e-4;
/* Distance from a bound relative to the largest unknown within which a guess counts as on it: above the zero
   tolerance of PETSc's types. */
static const PetscReal ON_BOUND = 1e-9;

/* y = min(0, upper): feasible. */
static PetscErrorCode InitialGuessStartFeasible_Private(const Inequality *solved, Vec y)
{
  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(y));
  PetscCall(VecPointwiseMin(y, y, solved->upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The solution with those bounds active that balance the loads: without contact bodies would move far away.
   By one factorization, or by multigrid if that solves the system. */
static PetscErrorCode InitialGuessStartTouching_Private(const Inequality *solved, Vec start, const SolverChoice *choice,
                                                        SNES snes, Vec y)
{
  ActiveSet      set;
  ActiveSolver   solver;
  ActiveSolution solution;
  const char    *failure;
  PetscReal     *touching;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetCreate(solved->upper, solved->A, &set));
  if (strcmp(choice->pc, PCTRUNCATEDMG))
    PetscCall(SchurSolverCreate(&set, solved->A, solved->b, choice->prefix, 0, &solver, &failure));
  else
    PetscCall(PDASCreateSolver(snes, &set, solved->A, solved->b, START_RTOL, &solver, &failure));
  if (!failure) {
    PetscCall(ActiveSolutionCreate(&set, &solution));
    PetscCall(PetscMalloc1(set.n, &touching));
    PetscCall(ActiveSetGather(&set, start, touching));
    for (PetscInt i = 0; i < set.n; i++) set.active[i] = (PetscBool)(touching[i] > 0);
    PetscCall(PetscFree(touching));
    PetscCall((*solver->solve)(solver, set.active, set.upper, &solution));
    if (!solution.failure) PetscCall((*solver->finish)(solver, &solution, y));
    PetscCall(ActiveSolutionDestroy(&solution));
  }
  PetscCall(ActiveSolverDestroy(&solver));
  PetscCall(ActiveSetDestroy(&set));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y of a displacement: T y = u / length. T is block diagonal (frames of nodes) except for couplings of
   nonmortar nodes with others, in chains of finite length. GMRES preconditioned by the blocks needs as many
   steps as the longest chain. */
static PetscErrorCode InitialGuessStartFrom_Private(VI vi, Vec guess, Vec y)
{
  KSP ksp;
  PC  pc;
  Vec scaled;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(vi->b, &scaled));
  PetscCall(VecCopy(guess, scaled));
  PetscCall(VecScale(scaled, 1 / vi->length));
  if (vi->T) {
    PetscCall(KSPCreate(PetscObjectComm((PetscObject)vi->T), &ksp));
    PetscCall(KSPSetOperators(ksp, vi->T, vi->T));
    PetscCall(KSPSetType(ksp, KSPGMRES));
    PetscCall(KSPGetPC(ksp, &pc));
    PetscCall(PCSetType(pc, PCPBJACOBI));
    PetscCall(KSPSetTolerances(ksp, GUESS_RTOL, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
    PetscCall(KSPSolve(ksp, scaled, y));
    PetscCall(KSPDestroy(&ksp));
  } else {
    PetscCall(VecCopy(scaled, y));
  }
  PetscCall(VecDestroy(&scaled));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moves y into its bounds, and onto them if it is close. PETSc's types leave an unknown within their zero
   tolerance of its bound, and it would not count as touching. */
static PetscErrorCode InitialGuessMoveToBounds_Private(const Inequality *solved, Vec y)
{
  const PetscScalar *upper;
  PetscScalar       *values;
  PetscReal          size;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecPointwiseMin(y, y, solved->upper));
  PetscCall(VecNorm(y, NORM_INFINITY, &size));
  PetscCall(VecGetLocalSize(y, &n));
  PetscCall(VecGetArrayRead(solved->upper, &upper));
  PetscCall(VecGetArray(y, &values));
  for (PetscInt i = 0; i < n; i++) {
    if (PetscRealPart(values[i]) > PetscRealPart(upper[i]) - ON_BOUND * size) values[i] = upper[i];
  }
  PetscCall(VecRestoreArray(y, &values));
  PetscCall(VecRestoreArrayRead(solved->upper, &upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode InitialGuessSet(const Inequality *solved, Solvability solvability, const SolverChoice *choice, SNES snes,
                               Vec guess, Vec y)
{
  const PetscBool pdas = (PetscBool)!strcmp(choice->snes, SNESPDAS);

  PetscFunctionBeginUser;
  if (guess) {
    PetscCall(InitialGuessStartFrom_Private(solved->vi, guess, y));
    if (solvability) PetscCall(VecAXPY(y, -1, solvability->approach)); // y is counted from the approach (proximal.h)
    if (!pdas)
      PetscCall(InitialGuessMoveToBounds_Private(solved, y)); // pdas accepts an infeasible guess, others do not
  } else {
    PetscCall(InitialGuessStartFeasible_Private(solved, y));
    if (!pdas && solvability) {
      PetscCall(InitialGuessStartTouching_Private(solved, solvability->start, choice, snes, y));
      PetscCall(InitialGuessMoveToBounds_Private(solved, y));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
