/* basisrows.c -- see the header. */
#include "multigrid/basisrows.h"
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "base/gather.h"
#include "multigrid/fewrows.h"

PetscErrorCode BasisRowsReference(const BasisRows *from, BasisRows *to)
{
  PetscFunctionBeginUser;
  *to = *from;
  PetscCall(PetscObjectReference((PetscObject)to->few));
  PetscCall(PetscObjectReference((PetscObject)to->rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisRowsDestroy(BasisRows *basis)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&basis->few));
  PetscCall(ISDestroy(&basis->rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends one row of a matrix. [in] row - global; [in,out] to - with room for it */
static PetscErrorCode BasisRowsAppend_Private(Mat from, PetscInt row, CSRRows *to)
{
  const PetscInt     at = to->start[to->m];
  PetscInt           num;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  PetscCall(MatGetRow(from, row, &num, &columns, &values));
  PetscCall(PetscArraycpy(&to->column[at], columns, num));
  PetscCall(PetscArraycpy(&to->value[at], values, num));
  to->start[++to->m] = at + num;
  PetscCall(MatRestoreRow(from, row, &num, &columns, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Room for the rows of matrices. [in] m - rows at most, [in] more - entries beside those of the matrices */
static PetscErrorCode BasisRowsBegin_Private(PetscInt m, Mat A, Mat B, PetscInt more, CSRRows *rows)
{
  MatInfo  info;
  PetscInt room = more;

  PetscFunctionBeginUser;
  PetscCall(MatGetInfo(A, MAT_LOCAL, &info));
  room += (PetscInt)info.nz_used;
  if (B) PetscCall(MatGetInfo(B, MAT_LOCAL, &info));
  if (B) room += (PetscInt)info.nz_used;
  PetscCall(PetscMalloc3(m + 1, &rows->start, room, &rows->column, room, &rows->value));
  rows->start[0] = 0;
  rows->m        = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Collective. [in] comm - of the matrix; [out] A - owned by the caller */
static PetscErrorCode BasisRowsEnd_Private(MPI_Comm comm, CSRRows *rows, Mat *A)
{
  PetscFunctionBeginUser;
  PetscCall(CSRMatrixCreate(comm, rows, A));
  PetscCall(PetscFree3(rows->start, rows->column, rows->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisRowsCreateSome(const BasisRows *basis, PetscInt num, const PetscInt row[], Mat *some)
{
  CSRRows         rows = {.bs = 1};
  PetscInt        few, first, begin, at = 0;
  const PetscInt *own;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(basis->few, NULL, &rows.n));
  PetscCall(MatGetOwnershipRangeColumn(basis->few, &begin, NULL));
  PetscCall(MatGetOwnershipRange(basis->few, &first, NULL));
  PetscCall(BasisRowsBegin_Private(num, basis->few, NULL, num, &rows));
  PetscCall(ISGetLocalSize(basis->rows, &few));
  PetscCall(ISGetIndices(basis->rows, &own));
  for (PetscInt i = 0; i < num; i++) {
    while (at < few && own[at] < row[i]) at++;
    if (at < few && own[at] == row[i]) {
      PetscCall(BasisRowsAppend_Private(basis->few, first + at, &rows));
    } else {
      rows.column[rows.start[i]] = begin + row[i];
      rows.value[rows.start[i]]  = 1;
      rows.start[++rows.m]       = rows.start[i] + 1;
    }
  }
  PetscCall(ISRestoreIndices(basis->rows, &own));
  PetscCall(BasisRowsEnd_Private(PetscObjectComm((PetscObject)basis->few), &rows, some));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisRowsCreateDifference(const BasisRows *basis, Mat *E)
{
  CSRRows         rows = {.bs = 1};
  PetscInt        few, first, begin, at = 0;
  const PetscInt *own;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(basis->few, &few, &rows.n));
  PetscCall(MatGetOwnershipRangeColumn(basis->few, &begin, NULL));
  PetscCall(MatGetOwnershipRange(basis->few, &first, NULL));
  PetscCall(BasisRowsBegin_Private(rows.n, basis->few, NULL, few, &rows));
  PetscCall(ISGetIndices(basis->rows, &own));
  for (PetscInt i = 0; i < rows.n; i++) {
    PetscInt num, start = rows.start[i];

    if (at == few || own[at] != i) {
      rows.start[++rows.m] = start;
      continue;
    }
    PetscCall(BasisRowsAppend_Private(basis->few, first + at++, &rows));
    num                       = rows.start[i + 1] - start;
    rows.column[start + num]  = begin + i;
    rows.value[start + num++] = -1;
    PetscCall(CSRMatrixMergeRow(&num, &rows.column[start], &rows.value[start]));
    rows.start[i + 1] = start + num;
  }
  PetscCall(ISRestoreIndices(basis->rows, &own));
  PetscCall(BasisRowsEnd_Private(PetscObjectComm((PetscObject)basis->few), &rows, E));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks the rows of T that are not those of 1. Collective. [out] marks - 1 there, owned by the caller */
static PetscErrorCode BasisRowsMark_Private(Mat T, Vec *marks)
{
  PetscInt     begin, end;
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(T, marks, NULL));
  PetscCall(MatGetOwnershipRange(T, &begin, &end));
  PetscCall(VecGetArrayWrite(*marks, &a));
  for (PetscInt row = begin; row < end; row++) {
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(T, row, &num, &columns, &values));
    a[row - begin] = num == 1 && columns[0] == row && values[0] == 1 ? 0 : 1;
    PetscCall(MatRestoreRow(T, row, &num, &columns, &values));
  }
  PetscCall(VecRestoreArrayWrite(*marks, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks the rows of P that P T changes. Collective. [in,out] changed - of rows of this rank */
static PetscErrorCode BasisRowsMarkChanged_Private(Mat P, Mat T, PetscBool changed[])
{
  PetscInt           rows, row_end, begin, end, num_ghosts;
  PetscMPIInt        size;
  const PetscInt    *ghost = NULL;
  const PetscScalar *own, *others = NULL;
  Vec                marks, there;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)P), &size));
  PetscCall(BasisRowsMark_Private(T, &marks));
  if (size > 1) PetscCall(MatGetGhosts(P, &num_ghosts, &ghost));
  if (size > 1) PetscCall(GatherEntries(marks, num_ghosts, ghost, &there));
  if (size > 1) PetscCall(VecGetArrayRead(there, &others));
  PetscCall(VecGetArrayRead(marks, &own));
  PetscCall(MatGetOwnershipRange(P, &rows, &row_end));
  PetscCall(MatGetOwnershipRangeColumn(P, &begin, &end));
  for (PetscInt row = rows; row < row_end; row++) {
    PetscInt        num, at;
    const PetscInt *columns;

    PetscCall(MatGetRow(P, row, &num, &columns, NULL));
    for (PetscInt j = 0; j < num && !changed[row - rows]; j++) {
      if (columns[j] >= begin && columns[j] < end) {
        changed[row - rows] = (PetscBool)(own[columns[j] - begin] != 0);
      } else {
        PetscCall(PetscFindInt(columns[j], num_ghosts, ghost, &at));
        changed[row - rows] = (PetscBool)(others[at] != 0);
      }
    }
    PetscCall(MatRestoreRow(P, row, &num, &columns, NULL));
  }
  PetscCall(VecRestoreArrayRead(marks, &own));
  if (size > 1) PetscCall(VecRestoreArrayRead(there, &others));
  if (size > 1) PetscCall(VecDestroy(&there));
  PetscCall(VecDestroy(&marks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows of a product. Collective. [in,out] rows - of its left factor, then its own */
static PetscErrorCode BasisRowsTimes_Private(Mat right, Mat *rows)
{
  Mat product;

  PetscFunctionBeginUser;
  PetscCall(MatMatMult(*rows, right, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
  PetscCall(MatProductClear(product)); // it would keep its factors
  PetscCall(MatDestroy(rows));
  *rows = product;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* P with other rows in some places. Collective.
   [in] row - of those of few, counted from this rank's first; [in,out] P */
static PetscErrorCode BasisRowsReplace_Private(Mat few, const PetscInt row[], Mat *P)
{
  CSRRows  rows;
  PetscInt m, num, begin, first, at = 0;
  Mat      from = *P;

  PetscFunctionBeginUser;
  PetscCall(MatGetBlockSize(from, &rows.bs));
  PetscCall(MatGetLocalSize(from, &m, &rows.n));
  PetscCall(MatGetLocalSize(few, &num, NULL));
  PetscCall(MatGetOwnershipRange(from, &begin, NULL));
  PetscCall(MatGetOwnershipRange(few, &first, NULL));
  PetscCall(BasisRowsBegin_Private(m, from, few, 0, &rows));
  for (PetscInt i = 0; i < m; i++) {
    const PetscBool other = (PetscBool)(at < num && row[at] == i);

    PetscCall(BasisRowsAppend_Private(other ? few : from, other ? first + at : begin + i, &rows));
    at += other ? 1 : 0;
  }
  PetscCall(BasisRowsEnd_Private(PetscObjectComm((PetscObject)from), &rows, P));
  PetscCall(MatDestroy(&from));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rows of P that basis P T changes. Collective.
   [out] row - counted from this rank's first, ascending; owned by the caller [num] */
static PetscErrorCode BasisRowsListChanged_Private(const BasisRows *basis, Mat P, Mat T, PetscInt *num, PetscInt **row)
{
  PetscInt        m, few;
  const PetscInt *own;
  PetscBool      *changed;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(P, &m, NULL));
  PetscCall(PetscCalloc1(m, &changed));
  if (T) PetscCall(BasisRowsMarkChanged_Private(P, T, changed));
  if (basis->few) {
    PetscCall(ISGetLocalSize(basis->rows, &few));
    PetscCall(ISGetIndices(basis->rows, &own));
    for (PetscInt i = 0; i < few; i++) changed[own[i]] = PETSC_TRUE;
    PetscCall(ISRestoreIndices(basis->rows, &own));
  }
  *num = 0;
  for (PetscInt i = 0; i < m; i++) *num += changed[i] ? 1 : 0;
  PetscCall(PetscMalloc1(*num, row));
  *num = 0;
  for (PetscInt i = 0; i < m; i++)
    if (changed[i]) (*row)[(*num)++] = i;
  PetscCall(PetscFree(changed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Some rows of basis P. Collective.
   [in] row - counted from this rank's first [num]; [out] rows - owned by the caller */
static PetscErrorCode BasisRowsTimesSome_Private(const BasisRows *basis, Mat P, PetscInt num, const PetscInt row[],
                                                 Mat *rows)
{
  PetscInt begin, *global;

  PetscFunctionBeginUser;
  if (basis->few) {
    PetscCall(BasisRowsCreateSome(basis, num, row, rows));
    PetscCall(BasisRowsTimes_Private(P, rows));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MatGetOwnershipRange(P, &begin, NULL));
  PetscCall(PetscMalloc1(num, &global));
  for (PetscInt i = 0; i < num; i++) global[i] = begin + row[i];
  PetscCall(FewRowsCreate(1, &(RowList){.from = P, .num = num, .row = global}, rows));
  PetscCall(PetscFree(global));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisRowsMultiply(const BasisRows *basis, Mat T, Mat *P)
{
  PetscInt num, *row;
  Mat      rows;

  PetscFunctionBeginUser;
  if (!basis->few && !T) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(BasisRowsListChanged_Private(basis, *P, T, &num, &row));
  PetscCall(BasisRowsTimesSome_Private(basis, *P, num, row, &rows));
  if (T) PetscCall(BasisRowsTimes_Private(T, &rows));
  PetscCall(BasisRowsReplace_Private(rows, row, P));
  PetscCall(MatDestroy(&rows));
  PetscCall(PetscFree(row));
  PetscFunctionReturn(PETSC_SUCCESS);
}
