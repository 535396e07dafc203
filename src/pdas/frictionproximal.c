/* frictionproximal.c -- accelerated proximal steps at full size [1], before the decisions of a Newton step.

   Decisions compare forces and positions at each unit alone. At the ends of contact and of stick, they
   change at one or two units per step. A proximal step moves all unknowns along their forces, and those of
   units onto the law for the limits of their own pressure. Steps settle these ends as far as they reach, one
   cell each; acceleration makes them few. A step costs one product; a Newton step costs several cycles.

   References: [1] Beck, Teboulle, A fast iterative shrinkage-thresholding algorithm for linear inverse
   problems, 2009. */
#include "multigrid/eigenvalue.h"
#include "multigrid/multigrid.h"
#include "pdas/frictionlinear.h"
#include "pdas/fullsolver.h"

/* Steps before each Newton step come by PROXIMAL_STEPS, at most PROXIMAL_ROUNDS times. They go on while more
   and more decisions change: there an end of stick moves along the contact. Momentum is kept. Without it the
   end would move as the root of the number of steps. */
enum { PROXIMAL_STEPS = 24, PROXIMAL_ROUNDS = 8 };

/* The proximal step of one unit. [in] size - of the step, part of diag(A)^-1; [out] to - of the vector */
static void FrictionProximalUnit_Private(const FrictionLinear *linear, const FrictionUnit *unit, PetscReal size,
                                         PetscScalar to[])
{
  const PetscReal *y = linear->units->y, *r = linear->units->r;
  const PetscReal  moved = y[unit->normal] + size * r[unit->normal] / unit->stiffness;
  const PetscReal  limit = FrictionUnitLimit(unit, unit->stiffness / size * (moved - unit->upper));
  PetscReal        s[FRICTION_TANGENTS], way = 0, left;

  to[FrictionLinearAt(linear, unit->normal)] = PetscMin(moved, unit->upper);
  for (PetscInt i = 0; i < unit->num; i++) {
    s[i] = y[unit->tangent[i]] - unit->origin[i] + size * r[unit->tangent[i]] / unit->resistance;
    way += s[i] * s[i];
  }
  way  = PetscSqrtReal(way) * unit->resistance / size; // as a force
  left = way > limit ? 1 - limit / way : 0;
  for (PetscInt i = 0; i < unit->num; i++)
    to[FrictionLinearAt(linear, unit->tangent[i])] = unit->origin[i] + left * s[i];
}

/* to = proximal step from y. */
static PetscErrorCode FrictionProximalStep_Private(const FrictionLinear *linear, PetscReal size, Vec y, Vec r, Vec to)
{
  PetscScalar *values;

  PetscFunctionBeginUser;
  PetscCall(VecPointwiseDivide(to, r, linear->solver->diag));
  PetscCall(VecAYPX(to, size, y));
  PetscCall(VecGetArray(to, &values));
  for (PetscInt a = 0; a < linear->units->num; a++)
    FrictionProximalUnit_Private(linear, &linear->units->unit[a], size, values);
  PetscCall(VecRestoreArray(to, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One step, and the forces of its end. [in,out] y - with momentum; [in,out] before - without */
static PetscErrorCode FrictionProximalAdvance_Private(FrictionLinear *linear, FrictionUnits *units, PetscReal momentum,
                                                      Vec y, Vec r, Vec before, Vec work)
{
  const ActiveSolver solver = linear->solver;
  const FullSolver  *full   = solver->data;

  PetscFunctionBeginUser;
  PetscCall(FrictionProximalStep_Private(linear, 1 / linear->largest, y, r, work));
  PetscCall(VecAXPBYPCZ(y, 1 + momentum, -momentum, 0, work, before));
  PetscCall(VecCopy(work, before));
  PetscCall(MatMult(solver->A, y, r));
  PetscCall(VecAYPX(r, -1, solver->b));
  PetscCall(MultigridAddWork(full->pc));
  PetscCall(ActiveSetGather(solver->set, y, units->y));
  PetscCall(ActiveSetGather(solver->set, r, units->r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionProximalApply(FrictionLinear *linear, FrictionUnits *units, Vec y, Vec r, Vec before, Vec work)
{
  PetscInt last, changed, k = 0;

  PetscFunctionBeginUser;
  if (!(linear->largest > 0)) PetscCall(EigenvalueLargest(linear->solver->A, NULL, NULL, &linear->largest));
  if (!(linear->largest > 0)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecCopy(y, before));
  PetscCall(FrictionUnitsCompare(units, &changed));
  do {
    last = changed;
    for (PetscInt end = k + PROXIMAL_STEPS - 1; k < end; k++)
      PetscCall(FrictionProximalAdvance_Private(linear, units, (PetscReal)k / (PetscReal)(k + 3), y, r, before, work));
    PetscCall(FrictionUnitsCompare(units, &changed));
  } while (changed > last && k < (PROXIMAL_STEPS - 1) * PROXIMAL_ROUNDS);
  PetscCall(FrictionProximalAdvance_Private(linear, units, 0, y, r, before, work));
  PetscFunctionReturn(PETSC_SUCCESS);
}
