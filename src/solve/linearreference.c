/* linearreference.c -- one linear system with the final active set, to compare with the cost of finding the
   set.

   The set is read from the solution, so it does not depend on the method. The system is solved from zero with
   nothing kept: no factors, no levels, no initial guess. */
#include "base/compat.h"
#include "pdas/pdasimpl.h"
#include "solve/linearreference.h"

/* Relative residual of the system. */
static const PetscReal REFERENCE_RTOL = 1e-8;

PetscErrorCode LinearReferenceSetActive(VI vi, Vec y, ActiveSet *set)
{
  PetscBool *next;
  PetscReal *values, *forces;
  PetscInt   changed;
  Vec        r;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(set->n, &next, set->n, &values, set->n, &forces));
  PetscCall(VecDuplicate(y, &r));
  PetscCall(MatMult(vi->A, y, r));
  PetscCall(VecAYPX(r, -1, vi->b));
  PetscCall(ActiveSetGather(set, y, values));
  PetscCall(ActiveSetGather(set, r, forces));
  for (PetscInt i = 0; i < set->n; i++)
    next[i] = (PetscBool)(forces[i] + set->diag[i] * (values[i] - set->upper[i]) > 0);
  PetscCall(ActiveSetReplace(set, next, &changed));
  PetscCall(VecDestroy(&r));
  PetscCall(PetscFree3(next, values, forces));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LinearReferenceSolve(const Proximal *proximal, SNES snes, Vec y, PetscInt *iterations, PetscBool *solved)
{
  const Inequality *inequality = &proximal->solved;
  ActiveSolver      solver;
  ActiveSolution    solution;
  ActiveSet         set;
  const char       *failure;

  PetscFunctionBeginUser;
  *iterations = 0;
  *solved     = PETSC_FALSE;
  PetscCall(ActiveSetCreate(inequality->upper, inequality->A, &set));
  PetscCall(LinearReferenceSetActive(inequality->vi, y, &set));
  PetscCall(PDASCreateSolver(snes, &set, inequality->A, inequality->b, REFERENCE_RTOL, &solver, &failure));
  if (!failure) {
    solver->rtol = 0; // only the residual counts here, unlike at the end of an inequality
    PetscCall(ActiveSolutionCreate(&set, &solution));
    PetscCall((*solver->solve)(solver, set.active, set.upper, &solution));
    *iterations = solution.iterations;
    *solved     = (PetscBool)!solution.failure;
    PetscCall(ActiveSolutionDestroy(&solution));
  }
  PetscCall(ActiveSolverDestroy(&solver));
  PetscCall(ActiveSetDestroy(&set));
  PetscFunctionReturn(PETSC_SUCCESS);
}
