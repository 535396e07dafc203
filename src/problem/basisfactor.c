/* basisfactor.c -- see the header. */
#include "problem/basisfactor.h"
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "multigrid/fewrows.h"

/* E = T - I without the zeros. */
static PetscErrorCode BasisFactorCreateDifference_Private(Mat T, Mat *E)
{
  PetscInt begin, end, N, bs, num = 0, *rows, *d_nnz, *o_nnz;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(T, &begin, &end));
  PetscCall(MatGetSize(T, &N, NULL));
  PetscCall(MatGetBlockSize(T, &bs));
  PetscCall(PetscMalloc1(end - begin, &rows));
  PetscCall(PetscCalloc2(end - begin, &d_nnz, end - begin, &o_nnz));
  for (int pass = 0; pass < 2; pass++) {
    if (pass) {
      PetscCall(MatCreateAIJ(PetscObjectComm((PetscObject)T), end - begin, end - begin, N, N, 0, d_nnz, 0, o_nnz, E));
      PetscCall(MatSetBlockSize(*E, bs));
    }
    // most rows of T are the identity's: they are read once
    for (PetscInt i = 0; i < (pass ? num : end - begin); i++) {
      const PetscInt     row = pass ? rows[i] : begin + i;
      PetscInt           size;
      const PetscInt    *columns;
      const PetscScalar *values;

      PetscCall(MatGetRow(T, row, &size, &columns, &values));
      for (PetscInt c = 0; c < size; c++) {
        const PetscScalar value = values[c] - (columns[c] == row ? 1 : 0);

        if (value == 0) continue;
        if (pass)
          PetscCall(MatSetValue(*E, row, columns[c], value, INSERT_VALUES));
        else
          (columns[c] >= begin && columns[c] < end ? d_nnz : o_nnz)[i]++;
      }
      PetscCall(MatRestoreRow(T, row, &size, &columns, &values));
      if (!pass && d_nnz[i] + o_nnz[i]) rows[num++] = row;
    }
  }
  PetscCall(PetscFree(rows));
  PetscCall(PetscFree2(d_nnz, o_nnz));
  PetscCall(MatAssemblyBegin(*E, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*E, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rows of this rank that are not empty. [out] rows - owned by the caller [num] */
static PetscErrorCode BasisFactorListRows_Private(Mat E, PetscInt *num, PetscInt **rows)
{
  PetscInt begin, end, size;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(E, &begin, &end));
  PetscCall(PetscMalloc1(end - begin, rows));
  *num = 0;
  for (PetscInt row = begin; row < end; row++) {
    PetscCall(MatGetRow(E, row, &size, NULL, NULL));
    if (size) (*rows)[(*num)++] = row;
    PetscCall(MatRestoreRow(E, row, &size, NULL, NULL));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisFactorCreate(Mat E, BasisFactor *factor)
{
  PetscInt *rows, num, begin;

  PetscFunctionBeginUser;
  PetscCall(BasisFactorListRows_Private(E, &num, &rows));
  PetscCall(FewRowsCreate(1, &(RowList){.from = E, .num = num, .row = rows}, &factor->few));
  PetscCall(MatGetOwnershipRange(E, &begin, NULL));
  for (PetscInt i = 0; i < num; i++) rows[i] -= begin;
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, rows, PETSC_OWN_POINTER, &factor->rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisFactorCreateOf(Mat T, BasisFactor *factor)
{
  Mat E;

  PetscFunctionBeginUser;
  PetscCall(BasisFactorCreateDifference_Private(T, &E));
  PetscCall(BasisFactorCreate(E, factor));
  PetscCall(MatDestroy(&E));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisFactorCreateSquare(const BasisFactor *factor, Mat *E)
{
  PetscInt           n, num, begin, size, *start, *column, row = 0;
  const PetscInt    *rows, *columns;
  PetscScalar       *value;
  const PetscScalar *values;
  MatInfo            info;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(factor->few, NULL, &n));
  PetscCall(MatGetOwnershipRange(factor->few, &begin, NULL));
  PetscCall(MatGetInfo(factor->few, MAT_LOCAL, &info));
  PetscCall(PetscMalloc3(n + 1, &start, (PetscInt)info.nz_used, &column, (PetscInt)info.nz_used, &value));
  PetscCall(ISGetLocalSize(factor->rows, &num));
  PetscCall(ISGetIndices(factor->rows, &rows));
  start[0] = 0;
  for (PetscInt i = 0; i < num; i++) {
    for (; row < rows[i]; row++) start[row + 1] = start[row];
    PetscCall(MatGetRow(factor->few, begin + i, &size, &columns, &values));
    PetscCall(PetscArraycpy(&column[start[row]], columns, size));
    PetscCall(PetscArraycpy(&value[start[row]], values, size));
    start[row + 1] = start[row] + size;
    row++;
    PetscCall(MatRestoreRow(factor->few, begin + i, &size, &columns, &values));
  }
  for (; row < n; row++) start[row + 1] = start[row];
  PetscCall(ISRestoreIndices(factor->rows, &rows));
  PetscCall(CSRMatrixCreate(PetscObjectComm((PetscObject)factor->few), &(CSRRows){1, n, n, start, column, value}, E));
  PetscCall(PetscFree3(start, column, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisFactorDestroy(BasisFactor *factor)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&factor->few));
  PetscCall(ISDestroy(&factor->rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}
