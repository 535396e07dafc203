/* frictionproblem.c -- the reduced problem with friction: its matrix and its forces, on the first rank. */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

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
  PetscBLASInt N, info, one = 1;

  PetscFunctionBeginUser;
  *opens = PETSC_FALSE;
  PetscCall(PetscBLASIntCast(problem->units->n, &N));
  PetscCall(PetscArraycpy(problem->M, problem->S, problem->units->n * problem->units->n));
  PetscCall(PetscArraycpy(problem->x, problem->g, problem->units->n));
  PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &N, problem->M, &N, &info));
  if (info) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCallBLAS("LAPACKpotrs", LAPACKpotrs_("L", &N, &one, problem->M, &N, problem->x, &N, &info));
  if (!info) PetscCall(FrictionUnitsAreOpen(problem->units, problem->x, opens));
  PetscFunctionReturn(PETSC_SUCCESS);
}
