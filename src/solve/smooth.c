/* smooth.c -- the smoother of one level at work: with unknowns held, and as a PC. */
#include <mortise/compat.h>
#include "smoother.h"

PetscErrorCode SmootherDestroy(Smoother *smoother)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&smoother->S));
  PetscCall(PetscFree(smoother->strip));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What a change of A makes of the strip. [out] X - like S */
static PetscErrorCode CreateChange_Private(const Smoother *smoother, Mat change, Mat *X)
{
  PetscInt begin, end, N, *count;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(change, &begin, &end));
  PetscCall(MatGetSize(change, &N, NULL));
  PetscCall(PetscCalloc1(end - begin, &count));
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) {
      PetscCall(
          MatCreateAIJ(PetscObjectComm((PetscObject)change), end - begin, end - begin, N, N, 0, count, 0, NULL, X));
    }
    for (PetscInt row = begin; row < end; row++) {
      PetscInt           num;
      const PetscInt    *columns;
      const PetscScalar *values;

      if (!smoother->strip[row - begin]) continue;
      PetscCall(MatGetRow(change, row, &num, &columns, &values));
      for (PetscInt c = 0; c < num; c++) {
        if (columns[c] < begin || columns[c] >= end || !smoother->strip[columns[c] - begin]) continue;
        count[row - begin]++;
        if (pass) PetscCall(MatSetValue(*X, row, columns[c], values[c], INSERT_VALUES));
      }
      PetscCall(MatRestoreRow(change, row, &num, &columns, &values));
    }
  }
  PetscCall(MatAssemblyBegin(*X, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*X, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree(count));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherHold(const Smoother *smoother, Vec more, Mat change, PetscInt num, const PetscInt held[], Mat *S)
{
  PetscInt     n, begin, *rows;
  PetscScalar *a;
  Vec          positive;
  Mat          X;

  PetscFunctionBeginUser;
  PetscCall(MatDestroy(S));
  if (!smoother->S) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatDuplicate(smoother->S, MAT_COPY_VALUES, S));
  PetscCall(VecDuplicate(more, &positive)); // a smaller diagonal might leave S indefinite
  PetscCall(VecCopy(more, positive));
  PetscCall(VecGetLocalSize(more, &n));
  PetscCall(VecGetArray(positive, &a));
  for (PetscInt i = 0; i < n; i++) a[i] = smoother->strip[i] ? 0 : PetscMax(0, PetscRealPart(a[i]));
  PetscCall(VecRestoreArray(positive, &a));
  PetscCall(MatDiagonalSet(*S, positive, ADD_VALUES));
  PetscCall(VecDestroy(&positive));
  if (change) {
    PetscCall(CreateChange_Private(smoother, change, &X));
    PetscCall(MatAXPY(*S, 1, X, DIFFERENT_NONZERO_PATTERN));
    PetscCall(MatDestroy(&X));
  }
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
