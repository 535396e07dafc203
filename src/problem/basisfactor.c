/* basisfactor.c -- see the header. */
#include "problem/basisfactor.h"
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "multigrid/fewrows.h"

PetscErrorCode BasisFactorCreate(Mat E, IS places, BasisFactor *factor)
{
  PetscInt       *rows, *at, num = 0, begin, end, size;
  const PetscInt *place = NULL;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(E, &begin, &end));
  PetscCall(PetscMalloc1(end - begin, &rows));
  PetscCall(PetscMalloc1(end - begin, &at));
  if (places) PetscCall(ISGetIndices(places, &place));
  for (PetscInt row = begin; row < end; row++) {
    PetscCall(MatGetRow(E, row, &size, NULL, NULL));
    PetscCall(MatRestoreRow(E, row, NULL, NULL, NULL));
    if (!size) continue;
    rows[num] = row;
    at[num++] = place ? place[row - begin] : row - begin;
  }
  if (places) PetscCall(ISRestoreIndices(places, &place));
  PetscCall(FewRowsCreate(1, &(RowList){.from = E, .num = num, .row = rows}, &factor->few));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, at, PETSC_COPY_VALUES, &factor->rows));
  PetscCall(PetscFree(at));
  PetscCall(PetscFree(rows));
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
