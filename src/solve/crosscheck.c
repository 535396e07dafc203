/* crosscheck.c -- the same inequality solved by the other method.

   Sets and displacements are its own from the start. With a factorisation it shares A and b with the first one; where that used multigrid it
   does so as well, on the same levels, and begins on the coarsest one. Levels decide how fast the residual falls and not what it is that
   falls. */
#include <mortise/compat.h>
#include <mortise/pdas.h>
#include "active.h"
#include "room.h"

/* Two solutions agree to this part of the largest displacement; forces and bounds to the same part of theirs. */
static const PetscReal AGREE = 1e-9;
/* Where roundoff is all that they differ by, they may differ by as much as the certificate allows. */
static const PetscReal AGREE_ROUNDOFF = 1e-6;
/* Roundoff of a row of A y, as a part of its diagonal times the largest displacement. */
static const PetscReal ROUNDOFF = 64 * PETSC_MACHINE_EPSILON;
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

/* Whether both solve the same equations up to roundoff: A (first - second), in the rows of what neither holds at its bound.
   A stiff body on a soft one, or a motion that next to nothing resists, multiplies the roundoff of forces by the condition
   of A, and no method with numbers of this length finds more digits of the displacements. */
static PetscErrorCode Indistinct_Private(VI vi, Vec first, Vec second, PetscReal scale, PetscBool *indistinct)
{
  ActiveSet  set;
  Vec        d, r, diagonal;
  PetscReal *y[2], *held, worst;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(first, &d));
  PetscCall(VecDuplicate(first, &r));
  PetscCall(VecDuplicate(first, &diagonal));
  PetscCall(VecWAXPY(d, -1, second, first));
  PetscCall(MatMult(vi->A, d, r));
  PetscCall(MatGetDiagonal(vi->A, diagonal));
  PetscCall(VecPointwiseDivide(r, r, diagonal));
  PetscCall(ActiveSetCreate(vi->upper, vi->A, &set));
  PetscCall(PetscMalloc3(set.n, &y[0], set.n, &y[1], set.n, &held));
  PetscCall(ActiveSetGather(&set, first, y[0]));
  PetscCall(ActiveSetGather(&set, second, y[1]));
  PetscCall(ActiveSetGather(&set, r, held));
  for (PetscInt i = 0; i < set.n; i++) {
    if (PetscMax(y[0][i], y[1][i]) >= set.upper[i] - AGREE * scale) held[i] = 0;
  }
  PetscCall(ActiveSetScatter(&set, held, r));
  PetscCall(VecNorm(r, NORM_INFINITY, &worst));
  *indistinct = (PetscBool)(worst <= ROUNDOFF * scale);
  PetscCall(PetscInfo(vi->A, "forces on what is free differ by %g of the diagonal times the displacements\n",
                      (double)(worst / scale)));
  PetscCall(PetscFree3(y[0], y[1], held));
  PetscCall(ActiveSetDestroy(&set));
  PetscCall(VecDestroy(&diagonal));
  PetscCall(VecDestroy(&r));
  PetscCall(VecDestroy(&d));
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
  SolveChoice choice;
  Vec         second;
  PetscReal   difference, max;
  PetscBool   near, again;

  PetscFunctionBeginUser;
  PetscCall(SolveChooseSecond(vi, report, PREFIX, &choice));
  if (SolveFactors(choice.pc)) PetscCall(PetscContainerDestroy(&vi->levels));
  PetscCall(VecDuplicate(y, &second));
  PetscCall(SolveRun(vi, &choice, PETSC_FALSE, NULL, second, &check->other));
  PetscCall(SolveChooseAnother(vi->scene, &check->other, &choice, &again));
  if (again) PetscCall(SolveRun(vi, &choice, PETSC_FALSE, NULL, second, &check->other));
  PetscCall(PetscContainerDestroy(&vi->levels));
  PetscCall(Displacements_Private(vi, y, second, &difference, &max));
  PetscCall(CompareSets_Private(vi, y, second, max, &check->active_difference));
  check->done                    = PETSC_TRUE;
  check->displacement_difference = max > 0 ? difference / max : difference;
  near                           = (PetscBool)(check->displacement_difference <= AGREE);
  if (!near && check->displacement_difference <= AGREE_ROUNDOFF)
    PetscCall(Indistinct_Private(vi, y, second, max, &near));
  check->agree = (PetscBool)(check->other.converged && near && !check->active_difference);
  PetscCall(VecDestroy(&second));
  PetscFunctionReturn(PETSC_SUCCESS);
}
