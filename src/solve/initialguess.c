/* initialguess.c -- where an iteration begins: at rest, with every contact closed, or at a displacement that somebody knows.

   A good displacement saves steps: its active set, by eq. 10.1, is nearly the right one, and a step of an iterative linear
   solver begins near its end. A bad one costs steps and changes nothing else, since the solution of the inequality is unique.
   Where contact alone holds a body and nothing is known, the iteration begins with contacts that can balance the loads. */
#include <string.h>
#include "base/compat.h"
#include "pdas/pdas.h"
#include "pdas/pdasimpl.h"
#include "multigrid/multigrid.h"
#include "solve/solverimpl.h"

/* Of T y = u: good enough to tell which bounds are reached. */
static const PetscReal GUESS_RTOL = 1e-12;
/* Of a system that is only to be begun with. */
static const PetscReal START_RTOL = 1e-4;
/* Distance from a bound, relative to the largest unknown, that a guess cannot mean: above the zero tolerance of PETSc's types. */
static const PetscReal ON_BOUND = 1e-9;

/* y = min(0, upper): feasible, and zero where it may be. */
static PetscErrorCode InitialGuessStartFeasible_Private(const Inequality *solved, Vec y)
{
  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(y));
  PetscCall(VecPointwiseMin(y, y, solved->upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The solution with those bounds reached that can balance the loads: a start without contact leads bodies far away. By one
   factorisation, or by multigrid where that solves what follows. */
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

/* y of a displacement: T y = u / length. T is block diagonal (each node's frame) but for what nonmortar nodes take from others
   and these from yet others, a chain with an end: preconditioned by its blocks, GMRES needs as many steps as chains are long. */
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

/* y within its bounds, and on them where it nearly is: PETSc's types leave an unknown that lies within their zero tolerance of its
   bound where it is, and it would not count as touching. */
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
    if (solvability) PetscCall(VecAXPY(y, -1, solvability->approach)); // from where bodies touch (springs.h)
    if (!pdas)
      PetscCall(InitialGuessMoveToBounds_Private(solved, y)); // pdas takes an overlap for contact, others ask for none
  } else {
    PetscCall(InitialGuessStartFeasible_Private(solved, y));
    if (!pdas && solvability) {
      PetscCall(InitialGuessStartTouching_Private(solved, solvability->start, choice, snes, y));
      PetscCall(InitialGuessMoveToBounds_Private(solved, y));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
