/* frictionother.c -- whether there is a solution beside the one that was found: the state without contact
   beside one with contact, and one that jams beside the state without contact (eq. 16.6b).

   Another solution with the forces r differs from the state without contact, y, by -F r with F = S^-1. Forces
   of contact do work on F r:

       0 < r.F r = sum r_n (y_n - upper) + r_t.s - G |s'|  <=  sum r_n (coefficient |s| - (upper - y_n)),

   with the slip s of that state and s' of the other one. So there is no other one unless some unit has moved
   aside so far that its motion lies in the cone of friction. There the units stick that have, and Newton's
   steps go on from this. */
#include "pdas/frictionimpl.h"

/* Largest number of steps to a state that jams. */
enum { JAM_STEPS = 20 };

/* Gaps that are open have this part of the largest value: less may be roundoff. */
static const PetscReal GAP_OPEN = 1e-6;

PetscErrorCode FrictionUnitsAreOpen(const FrictionUnits *units, const PetscReal y[], PetscBool *open)
{
  PetscReal largest = 0;

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < units->num; a++) largest = PetscMax(largest, PetscAbsReal(y[units->unit[a].normal]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPI_MAX, units->comm));
  *open = PETSC_TRUE;
  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit = &units->unit[a];

    *open = (PetscBool)(*open && y[unit->normal] < unit->upper - GAP_OPEN * largest);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, open, 1, MPIU_BOOL, MPI_LAND, units->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a closed unit with this motion could jam. */
static PetscBool FrictionOtherJams_Private(const FrictionUnits *units, const FrictionUnit *unit)
{
  PetscReal slip = 0;

  for (PetscInt i = 0; i < unit->num; i++) slip += PetscSqr(units->y[unit->tangent[i]] - unit->origin[i]);
  return (PetscBool)(unit->coefficient * PetscSqrtReal(slip) > unit->upper - units->y[unit->normal]);
}

/* Closes the units that could jam. Collective. [out] num - of all ranks */
static PetscErrorCode FrictionOtherClose_Private(FrictionMethod method, PetscInt *num)
{
  FrictionUnits *units = &method->units;

  PetscFunctionBeginUser;
  *num = 0;
  for (PetscInt a = 0; a < units->num; a++) {
    FrictionUnit *unit = &units->unit[a];

    if (!FrictionOtherJams_Private(units, unit)) continue;
    unit->closed = PETSC_TRUE;
    unit->status = UNIT_STICK;
    ++*num;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, num, 1, MPIU_INT, MPI_SUM, method->pdas->set.comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Newton's steps from the state without contact, in which units are closed now. [out] found - a state with
   contact */
static PetscErrorCode FrictionOtherSolve_Private(SNES snes, FrictionMethod method, Vec start, PetscBool *found)
{
  PDAS          *pdas   = method->pdas;
  const PetscInt max_it = pdas->max_it;

  PetscFunctionBeginUser;
  pdas->max_it    = PetscMin(max_it, pdas->iterations + JAM_STEPS);
  method->decided = method->grows = PETSC_TRUE;
  PetscCall(FrictionIterationNewton(snes, method, start, PETSC_FALSE));
  *found = (PetscBool)(pdas->converged && pdas->num_active);
  PetscCall(PetscInfo(snes, "friction: units could jam, and %s\n", *found ? "such a state is found" : "none is found"));
  method->grows = PETSC_FALSE;
  pdas->max_it  = max_it;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Looks for a state that jams beside that without contact, which is left as it was. */
static PetscErrorCode FrictionOtherJam_Private(SNES snes, FrictionMethod method, PetscBool *found)
{
  PDAS          *pdas  = method->pdas;
  const PDAS     kept  = *pdas;
  FrictionUnits *units = &method->units;
  FrictionUnit  *unit;
  PetscInt       num, work;
  Vec            y;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(units->num, &unit));
  PetscCall(PetscArraycpy(unit, units->unit, units->num));
  PetscCall(FrictionOtherClose_Private(method, &num));
  if (num) {
    PetscCall(VecDuplicate(method->solver->b, &y));
    PetscCall((*method->get)(method, y));
    PetscCall(FrictionOtherSolve_Private(snes, method, y, found));
    PetscCall(PetscArraycpy(units->unit, unit, units->num));
    PetscCall((*method->set)(method, y));
    PetscCall(VecDestroy(&y));
    work                    = pdas->linear_iterations;
    *pdas                   = kept;
    pdas->linear_iterations = work;
    PetscCall(SNESSetIterationNumber(snes, pdas->iterations));
  }
  PetscCall(PetscFree(unit));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionFindOther(SNES snes, FrictionMethod method, PetscBool *found)
{
  PDAS           *pdas    = method->pdas;
  const PetscBool coarser = (PetscBool)(pdas->coarser.slipping + pdas->coarser.sticking > 0);
  PetscBool       coulomb = PETSC_TRUE;

  PetscFunctionBeginUser;
  *found = PETSC_FALSE;
  for (PetscInt a = 0; a < method->units.num; a++) coulomb = (PetscBool)(coulomb && method->units.unit[a].bound == 0);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &coulomb, 1, MPIU_BOOL, MPI_LAND, pdas->set.comm));
  if (!coulomb || !pdas->law->held || pdas->rho_skipped || pdas->fixed_point) PetscFunctionReturn(PETSC_SUCCESS);
  if (!pdas->num_active)
    PetscCall(FrictionOtherJam_Private(snes, method, found));
  else if (coarser)
    *found = pdas->coarser.beside;
  else
    PetscCall((*method->opens)(method, found));
  PetscFunctionReturn(PETSC_SUCCESS);
}
