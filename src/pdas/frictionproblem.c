/* frictionproblem.c -- the reduced problem with friction: its matrix and its forces, on the first rank. */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* Gaps that are open have this part of the largest value: less may be roundoff. */
static const PetscReal GAP_OPEN = 1e-6;

PetscErrorCode FrictionProblemCreate(FrictionUnits *units, PetscScalar S[], FrictionProblem *problem)
{
  const PetscInt n = units->n;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(problem, sizeof(*problem)));
  problem->units = units;
  problem->S     = S;
  PetscCall(PetscMalloc2(n, &problem->g, n, &problem->place));
  PetscCall(PetscMalloc3(n * n, &problem->M, n, &problem->pivot, n, &problem->x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionProblemDestroy(FrictionProblem *problem)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(problem->g, problem->place));
  PetscCall(PetscFree3(problem->M, problem->pivot, problem->x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionProblemSetForces(FrictionProblem *problem)
{
  const PetscScalar one = 1, minus = -1;
  PetscBLASInt      N, step        = 1;

  PetscFunctionBeginUser;
  PetscCall(PetscBLASIntCast(problem->units->n, &N));
  PetscCall(PetscArraycpy(problem->units->r, problem->g, problem->units->n));
  PetscCallBLAS("BLASgemv", BLASgemv_("N", &N, &N, &minus, problem->S, &N, problem->units->y, &step, &one,
                                      problem->units->r, &step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionProblemAddProduct(FrictionProblem *problem)
{
  const PetscScalar plus = 1;
  PetscBLASInt      N, step = 1;

  PetscFunctionBeginUser;
  PetscCall(PetscBLASIntCast(problem->units->n, &N));
  PetscCallBLAS("BLASgemv",
                BLASgemv_("N", &N, &N, &plus, problem->S, &N, problem->units->y, &step, &plus, problem->g, &step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionProblemOpens(FrictionProblem *problem, PetscBool *opens)
{
  const FrictionUnits *units   = problem->units;
  PetscReal            largest = 0;
  PetscBLASInt         N, info, one = 1;

  PetscFunctionBeginUser;
  *opens = PETSC_FALSE;
  PetscCall(PetscBLASIntCast(units->n, &N));
  PetscCall(PetscArraycpy(problem->M, problem->S, units->n * units->n));
  PetscCall(PetscArraycpy(problem->x, problem->g, units->n));
  PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &N, problem->M, &N, &info));
  if (info) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCallBLAS("LAPACKpotrs", LAPACKpotrs_("L", &N, &one, problem->M, &N, problem->x, &N, &info));
  *opens = (PetscBool)!info;
  for (PetscInt a = 0; a < units->num; a++)
    largest = PetscMax(largest, PetscAbsReal(problem->x[units->unit[a].normal]));
  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit = &units->unit[a];

    *opens = (PetscBool)(*opens && unit->bound == 0 && problem->x[unit->normal] < unit->upper - GAP_OPEN * largest);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
