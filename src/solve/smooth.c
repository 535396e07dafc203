/* smooth.c -- the smoother of one level at work: with unknowns held, and as a PC. */
#include <mortise/compat.h>
#include "smoother.h"

PetscErrorCode SmootherHold(Mat from, Mat change, PetscInt num, const PetscInt held[], Mat *S)
{
  PetscInt begin, *rows;

  PetscFunctionBeginUser;
  PetscCall(MatDestroy(S));
  if (!from) PetscFunctionReturn(PETSC_SUCCESS);
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

PetscErrorCode SmootherSetPC(PC pc, Mat S)
{
  KSP *own;
  PC   inner;

  PetscFunctionBeginUser;
  if (!S) {
    PetscCall(PCSetType(pc, PCJACOBI));
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
