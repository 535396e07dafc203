/* linearreference.c -- one linear system with the final active set, to compare with the cost of finding the
   set.

   The set is read from the solution, so it does not depend on the method. The system is solved from zero with
   nothing kept: no factors, no levels, no initial guess. */
#include "base/compat.h"
#include "pdas/pdasimpl.h"
#include "solve/linearreference.h"

/* Relative residual of the system. */
static const PetscReal REFERENCE_RTOL = 1e-8;
/* Slip below this part of the largest value is none. */
static const PetscReal NO_SLIP = 1e-10;

/* Tangents that stick, if they are in the set: friction has a limit, and there is no slip. [in] y, r -
   solution and its forces; [in,out] next - [set->n] */
static PetscErrorCode LinearReferenceStick_Private(const FrictionLaw *law, Vec y, Vec r, const ActiveSet *set,
                                                   PetscBool next[])
{
  const PetscInt     begin = set->dof_begin;
  const PetscScalar *values, *forces;
  PetscReal          largest;

  PetscFunctionBeginUser;
  PetscCall(VecNorm(y, NORM_INFINITY, &largest));
  PetscCall(VecGetArrayRead(y, &values));
  PetscCall(VecGetArrayRead(r, &forces));
  for (PetscInt a = 0; a < law->n; a++) {
    const PetscReal limit = law->bound[a] + law->coefficient[a] * PetscRealPart(forces[law->normal[a] - begin]);
    PetscReal       slip  = 0;

    for (PetscInt i = FRICTION_TANGENTS * a; i < FRICTION_TANGENTS * (a + 1); i++)
      if (law->tangent[i] >= 0) slip += PetscSqr(PetscRealPart(values[law->tangent[i] - begin]) - law->origin[i]);
    for (PetscInt i = FRICTION_TANGENTS * a; i < FRICTION_TANGENTS * (a + 1); i++) {
      PetscInt place = -1;

      if (law->tangent[i] >= 0) PetscCall(PetscFindInt(law->tangent[i], set->n, set->dof, &place));
      if (place >= 0) next[place] = (PetscBool)(limit > 0 && slip <= PetscSqr(NO_SLIP * largest));
    }
  }
  PetscCall(VecRestoreArrayRead(r, &forces));
  PetscCall(VecRestoreArrayRead(y, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

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
  if (vi->friction) PetscCall(LinearReferenceStick_Private(vi->friction, y, r, set, next));
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
