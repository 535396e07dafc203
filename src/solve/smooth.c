/* smooth.c -- the smoother of one level at work: with unknowns held, and as a PC. */
#include <mortise/compat.h>
#include "apart.h"
#include "smoother.h"

PetscErrorCode SmootherHold(Mat from, Mat change, PetscInt num, const PetscInt held[], Mat *S)
{
  PetscInt  begin, *rows;
  PetscBool apart;

  PetscFunctionBeginUser;
  PetscCall(MatDestroy(S));
  if (!from) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ApartIs(from, &apart));
  if (apart) {
    PetscCall(ApartHold(from, num, held));
    PetscCall(PetscObjectReference((PetscObject)from));
    *S = from;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MatDuplicate(from, MAT_COPY_VALUES, S));
  if (change) PetscCall(MatAXPY(*S, 1, change, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatGetOwnershipRange(*S, &begin, NULL));
  PetscCall(PetscMalloc1(num, &rows));
  for (PetscInt i = 0; i < num; i++) rows[i] = begin + held[i];
  PetscCall(MatZeroRowsColumns(*S, num, rows, 1, NULL, NULL));
  PetscCall(PetscFree(rows));
  PetscCall(MatSetOption(*S, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherScale(Mat S, PetscReal factor)
{
  PetscBool apart;

  PetscFunctionBeginUser;
  PetscCall(ApartIs(S, &apart));
  PetscCall(MatScale(S, apart ? 1 / factor : factor));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherSetPC(PC pc, Mat S)
{
  PetscBool apart = PETSC_FALSE;
  KSP      *own;
  PC        inner;

  PetscFunctionBeginUser;
  if (S) PetscCall(ApartIs(S, &apart));
  if (!S || apart) {
    PetscCall(PCSetType(pc, apart ? PCMAT : PCJACOBI));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PCSetType(pc, PCBJACOBI));
  PetscCall(PCSetUp(pc));
  PetscCall(PCBJacobiGetSubKSP(pc, NULL, NULL, &own));
  PetscCall(KSPSetType(own[0], KSPPREONLY));
  PetscCall(KSPGetPC(own[0], &inner));
  PetscCall(PCSetType(inner, PCCHOLESKY));
  PetscCall(PCFactorSetMatOrderingType(inner, MATORDERINGND));
  PetscFunctionReturn(PETSC_SUCCESS);
}
