/* crosscheck.c -- the same inequality solved by the other method, with a direct solver whatever the first one used. */
#include <mortise/compat.h>
#include <mortise/pdas.h>
#include "active.h"
#include "room.h"

/* Two solutions agree to this part of the largest displacement; forces and bounds to the same part of theirs. */
static const PetscReal AGREE = 1e-9;
/* Options of the second SNES, should anybody want to steer it. */
static const char PREFIX[] = "cross_check_";

/* Values and forces b - A y of all bounded unknowns. [out] y, r - [set->n] */
static PetscErrorCode Take_Private(VI vi, const ActiveSet *set, Vec y, PetscReal values[], PetscReal forces[])
{
  Vec r;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(vi->b, &r));
  PetscCall(MatMult(vi->A, y, r));
  PetscCall(VecAYPX(r, -1, vi->b));
  PetscCall(ActiveSetGather(set, y, values));
  PetscCall(ActiveSetGather(set, r, forces));
  PetscCall(VecDestroy(&r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Counts unknowns that one solution holds at the bound with a force and the other clearly not. A bound that is just
   touched, with no force, belongs to either set. */
static PetscErrorCode CompareSets_Private(VI vi, Vec first, Vec second, PetscReal scale, PetscInt *difference)
{
  ActiveSet  set;
  PetscReal *y[2], *r[2], max = 0;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetCreate(vi->upper, vi->A, &set));
  PetscCall(PetscMalloc4(set.n, &y[0], set.n, &y[1], set.n, &r[0], set.n, &r[1]));
  PetscCall(Take_Private(vi, &set, first, y[0], r[0]));
  PetscCall(Take_Private(vi, &set, second, y[1], r[1]));
  for (PetscInt i = 0; i < set.n; i++) max = PetscMax(max, PetscMax(PetscAbsReal(r[0][i]), PetscAbsReal(r[1][i])));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &max, 1, MPIU_REAL, MPI_MAX, set.comm));
  *difference = 0;
  for (PetscInt i = 0; i < set.n; i++) {
    PetscBool touching[2], open[2];

    for (int s = 0; s < 2; s++) {
      open[s]     = (PetscBool)(y[s][i] < set.upper[i] - AGREE * scale);
      touching[s] = (PetscBool)(!open[s] && r[s][i] > AGREE * max);
    }
    *difference += (touching[0] && open[1]) || (touching[1] && open[0]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, difference, 1, MPIU_INT, MPI_SUM, set.comm));
  PetscCall(PetscFree4(y[0], y[1], r[0], r[1]));
  PetscCall(ActiveSetDestroy(&set));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* max |T (first - second)| and max |T first|: displacements, up to the same scale. */
static PetscErrorCode Displacements_Private(VI vi, Vec first, Vec second, PetscReal *difference, PetscReal *max)
{
  Vec u, d;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(first, &u));
  PetscCall(VecDuplicate(first, &d));
  PetscCall(VecWAXPY(d, -1, second, first));
  if (vi->T) PetscCall(MatMult(vi->T, d, u));
  PetscCall(VecNorm(vi->T ? u : d, NORM_INFINITY, difference));
  if (vi->T) PetscCall(MatMult(vi->T, first, u));
  PetscCall(VecNorm(vi->T ? u : first, NORM_INFINITY, max));
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&d));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VICrossCheck(VI vi, Vec y, const SolveReport *report, CrossCheck *check)
{
  SolveChoice choice = {.ksp = KSPPREONLY, .pc = PCCHOLESKY};
  Vec         second;
  PetscBool   pdas;
  PetscReal   difference, max;

  PetscFunctionBeginUser;
  PetscCall(PetscStrcmp(report->type, SNESPDAS, &pdas));
  PetscCall(PetscStrncpy(choice.snes, pdas ? SNESVINEWTONRSLS : SNESPDAS, sizeof(choice.snes)));
  PetscCall(VecDuplicate(y, &second));
  PetscCall(SolveRun(vi, &choice, PREFIX, PETSC_FALSE, NULL, second, &check->other));
  PetscCall(Displacements_Private(vi, y, second, &difference, &max));
  PetscCall(CompareSets_Private(vi, y, second, max, &check->active_difference));
  check->done                    = PETSC_TRUE;
  check->displacement_difference = max > 0 ? difference / max : difference;
  check->agree =
      (PetscBool)(check->other.converged && check->displacement_difference <= AGREE && !check->active_difference);
  PetscCall(VecDestroy(&second));
  PetscFunctionReturn(PETSC_SUCCESS);
}
