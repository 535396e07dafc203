/* condense.c -- T'KT, of which only what lies beside the contact differs from K.

   With T = I + E, T'KT = K + Z, Z = X + X' + X'E, X' = E'K: E has rows at the nodes of the nonmortar sides alone, and Z is as small. */
#include <mortise/compat.h>
#include "condense.h"

/* E = T - I without the zeros. */
static PetscErrorCode CreateDifference_Private(Mat T, Mat *E)
{
  PetscInt begin, end, N, bs, *d_nnz, *o_nnz;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(T, &begin, &end));
  PetscCall(MatGetSize(T, &N, NULL));
  PetscCall(MatGetBlockSize(T, &bs));
  PetscCall(PetscCalloc2(end - begin, &d_nnz, end - begin, &o_nnz));
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) {
      PetscCall(MatCreateAIJ(PetscObjectComm((PetscObject)T), end - begin, end - begin, N, N, 0, d_nnz, 0, o_nnz, E));
      PetscCall(MatSetBlockSize(*E, bs));
    }
    for (PetscInt row = begin; row < end; row++) {
      PetscInt           num;
      const PetscInt    *columns;
      const PetscScalar *values;

      PetscCall(MatGetRow(T, row, &num, &columns, &values));
      for (PetscInt c = 0; c < num; c++) {
        const PetscScalar value = values[c] - (columns[c] == row ? 1 : 0);
        if (value == 0) continue;
        if (pass) PetscCall(MatSetValue(*E, row, columns[c], value, INSERT_VALUES));
        if (!pass && columns[c] >= begin && columns[c] < end) d_nnz[row - begin]++;
        if (!pass && (columns[c] < begin || columns[c] >= end)) o_nnz[row - begin]++;
      }
      PetscCall(MatRestoreRow(T, row, &num, &columns, &values));
    }
  }
  PetscCall(PetscFree2(d_nnz, o_nnz));
  PetscCall(MatAssemblyBegin(*E, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*E, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CondenseCreate(Mat K, Mat T, Mat *Z)
{
  Mat E, transpose, X;

  PetscFunctionBeginUser;
  PetscCall(CreateDifference_Private(T, &E));
  PetscCall(MatTransposeMatMult(E, K, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &transpose)); // (K E)', of few rows
  PetscCall(MatTranspose(transpose, MAT_INITIAL_MATRIX, &X));
  PetscCall(MatMatMult(transpose, E, MAT_INITIAL_MATRIX, PETSC_DEFAULT, Z));
  PetscCall(MatProductClear(*Z)); // it would keep its factors
  PetscCall(MatAXPY(*Z, 1, X, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatAXPY(*Z, 1, transpose, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&transpose));
  PetscCall(MatDestroy(&X));
  PetscCall(MatDestroy(&E));
  PetscFunctionReturn(PETSC_SUCCESS);
}
