/* frictionsweep.c -- sweeps over the units of the reduced problem (nonlinear Gauss-Seidel). Each unit in turn
   satisfies its law, with the others as they are.

   Decisions of a Newton step compare forces and positions at each unit alone. At the ends of contact and
   of stick they change at one or two units per step. Sweeps before the decisions settle these ends. A sweep
   costs as much as a product with S; a step costs a factorization. */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* Sweeps before each step. None before a first step without displacements: sweeps carry loads only a few
   units far. None after SWEEP_PATIENCE steps in a row that do not descend: then the steps alone must. Sweeps
   go on while they descend, up to one for every SWEEP_COST unknowns: half the cost of a factorization. */
enum { SWEEPS = 20, SWEEP_PATIENCE = 3, SWEEP_COST = 6 };

/* y_i += by. The forces follow. */
static PetscErrorCode FrictionSweepMove_Private(FrictionProblem *problem, PetscInt i, PetscReal by)
{
  const PetscScalar minus = -by;
  PetscBLASInt      N, step = 1;

  PetscFunctionBeginUser;
  if (by == 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscBLASIntCast(problem->units->n, &N));
  problem->units->y[i] += by;
  PetscCallBLAS("BLASaxpy", BLASaxpy_(&N, &minus, &problem->S[problem->units->n * i], &step, problem->units->r, &step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The law of one unit. */
static PetscErrorCode FrictionSweepUnit_Private(FrictionProblem *problem, const FrictionUnit *unit)
{
  const PetscInt   N = problem->units->n, n = unit->normal;
  const PetscReal *y = problem->units->y, *r  = problem->units->r;
  PetscReal        z[FRICTION_TANGENTS], size = 0, stiffness = 0, limit, left;

  PetscFunctionBeginUser;
  PetscCall(FrictionSweepMove_Private(problem, n,
                                      PetscMin(r[n] / PetscRealPart(problem->S[(N + 1) * n]), unit->upper - y[n])));
  if (!unit->num) PetscFunctionReturn(PETSC_SUCCESS);
  limit = FrictionUnitLimit(unit, r[n]);
  for (PetscInt i = 0; i < unit->num; i++)
    stiffness = PetscMax(stiffness, PetscRealPart(problem->S[(N + 1) * unit->tangent[i]]));
  for (PetscInt i = 0; i < unit->num; i++) {
    z[i] = r[unit->tangent[i]] + stiffness * (y[unit->tangent[i]] - unit->origin[i]);
    size += z[i] * z[i];
  }
  size = PetscSqrtReal(size);
  left = size > limit ? (1 - limit / size) / stiffness : 0; // part of z that is slip
  for (PetscInt i = 0; i < unit->num; i++)
    PetscCall(
        FrictionSweepMove_Private(problem, unit->tangent[i], unit->origin[i] + left * z[i] - y[unit->tangent[i]]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* SWEEPS sweeps. [in] kept - memory [n]; [out] descends - else they lead away, as from one of several
   solutions, and are taken back */
static PetscErrorCode FrictionSweepSome_Private(FrictionProblem *problem, PetscReal kept[], PetscBool *descends)
{
  FrictionUnits *units = problem->units;
  const PetscInt last  = units->num - 1;
  PetscReal      before, after, size;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(kept, units->y, units->n));
  PetscCall(FrictionUnitsResidual(units, 1, &before, &size));
  for (PetscInt k = 0; k < SWEEPS; k++)
    for (PetscInt a = 0; a <= last; a++)
      PetscCall(FrictionSweepUnit_Private(problem, &units->unit[k % 2 ? last - a : a]));
  PetscCall(FrictionUnitsResidual(units, 1, &after, &size));
  *descends = (PetscBool)(after < before);
  if (*descends) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscArraycpy(units->y, kept, units->n));
  PetscCall(FrictionProblemSetForces(problem));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionProblemSweep(FrictionProblem *problem)
{
  const FrictionUnits *units = problem->units;
  PetscBool            moved = PETSC_FALSE, descends = PETSC_TRUE;
  PetscReal           *kept;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < units->n; i++) moved = (PetscBool)(moved || units->y[i] != 0);
  if (!moved || units->waiting >= SWEEP_PATIENCE) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(units->n, &kept));
  for (PetscInt k = 0; descends && k < PetscMax(1, units->n / (SWEEPS * SWEEP_COST)); k++)
    PetscCall(FrictionSweepSome_Private(problem, kept, &descends));
  PetscCall(PetscFree(kept));
  PetscFunctionReturn(PETSC_SUCCESS);
}
