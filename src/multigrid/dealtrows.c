/* dealtrows.c -- see the header.

   MatCreateSubMatrices() searches all columns of all rows in a table. Here it is called for rows of other
   ranks alone, of which there are few; own rows find the columns of this rank in an array. */
#include "base/compat.h"
#include "multigrid/dealtrows.h"

/* Name under which the arrays of a matrix are composed with it. */
static const char ARRAYS[] = "MortiseDealtRows";

enum { CACHE = 4096 }; /* columns of other ranks whose places are remembered: neighbouring rows have the same ones */

/* Places of columns in the new matrix, -1 if omitted. */
typedef struct {
  PetscInt        begin, end, *own; /* columns of this rank [end - begin] */
  PetscInt        num;
  const PetscInt *chosen; /* NULL for all [num] */
  PetscInt        found[CACHE], place[CACHE];
} Columns;

/* The new matrix, row by row. */
typedef struct {
  PetscInt     num, max; /* entries, and room for them */
  PetscInt    *start, *column;
  PetscScalar *value;
} Arrays;

static PetscErrorCode ArraysDestroy_Private(ContainerArgument argument)
{
  Arrays *arrays = ContainerArgumentGet(argument);

  PetscFunctionBeginUser;
  PetscCall(PetscFree(arrays->start));
  PetscCall(PetscFree(arrays->column));
  PetscCall(PetscFree(arrays->value));
  PetscCall(PetscFree(arrays));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ColumnsFind_Private(Columns *columns, PetscInt column, PetscInt *at)
{
  const PetscInt slot = column % CACHE;

  PetscFunctionBeginUser;
  if (column >= columns->begin && column < columns->end) {
    *at = columns->own[column - columns->begin];
  } else if (!columns->chosen) {
    *at = column;
  } else {
    if (columns->found[slot] != column)
      PetscCall(PetscFindInt(column, columns->num, columns->chosen, &columns->place[slot]));
    columns->found[slot] = column;
    *at                  = columns->place[slot];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends the columns that are not omitted. [in] part - its columns have the numbers of all */
static PetscErrorCode ArraysAppend_Private(Mat part, PetscInt row, Columns *columns, Arrays *arrays)
{
  PetscInt           length, at = -1;
  const PetscInt    *column;
  const PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(MatGetRow(part, row, &length, &column, &value));
  if (arrays->num + length > arrays->max) {
    arrays->max = 2 * (arrays->num + length);
    PetscCall(PetscRealloc((size_t)arrays->max * sizeof(PetscInt), &arrays->column));
    PetscCall(PetscRealloc((size_t)arrays->max * sizeof(PetscScalar), &arrays->value));
  }
  for (PetscInt j = 0; j < length; j++) {
    PetscCall(ColumnsFind_Private(columns, column[j], &at));
    if (at < 0) continue;
    arrays->column[arrays->num]  = at;
    arrays->value[arrays->num++] = value[j];
  }
  PetscCall(MatRestoreRow(part, row, &length, &column, &value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows of other ranks, with all columns. [out] theirs - [1] */
static PetscErrorCode DealtRowsGetOthers_Private(Mat A, PetscInt num, const PetscInt row[], Mat **theirs)
{
  PetscInt begin, end, N, count = 0, *others;
  IS       which, all;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(A, &begin, &end));
  PetscCall(MatGetSize(A, NULL, &N));
  PetscCall(PetscMalloc1(num, &others));
  for (PetscInt i = 0; i < num; i++)
    if (row[i] < begin || row[i] >= end) others[count++] = row[i];
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, count, others, PETSC_OWN_POINTER, &which));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, N, 0, 1, &all));
  PetscCall(MatCreateSubMatrices(A, 1, &which, &all, MAT_INITIAL_MATRIX, theirs));
  PetscCall(ISDestroy(&which));
  PetscCall(ISDestroy(&all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in] row - [num] */
static PetscErrorCode ArraysCreate_Private(Mat A, PetscInt num, const PetscInt row[], Columns *columns, Arrays *arrays)
{
  PetscInt begin, end, count = 0;
  MatInfo  info;
  Mat     *theirs;

  PetscFunctionBeginUser;
  PetscCall(DealtRowsGetOthers_Private(A, num, row, &theirs));
  PetscCall(MatGetOwnershipRange(A, &begin, &end));
  PetscCall(MatGetInfo(A, MAT_LOCAL, &info));
  arrays->max = (PetscInt)info.nz_used; // untouched pages take no memory
  PetscCall(MatGetInfo(theirs[0], MAT_LOCAL, &info));
  arrays->max += (PetscInt)info.nz_used;
  PetscCall(PetscMalloc1(num + 1, &arrays->start));
  PetscCall(PetscMalloc1(arrays->max, &arrays->column));
  PetscCall(PetscMalloc1(arrays->max, &arrays->value));
  arrays->start[0] = 0;
  for (PetscInt i = 0; i < num; i++) {
    const PetscBool own = (PetscBool)(row[i] >= begin && row[i] < end);

    PetscCall(ArraysAppend_Private(own ? A : theirs[0], own ? row[i] : count++, columns, arrays));
    arrays->start[i + 1] = arrays->num;
  }
  PetscCall(MatDestroySubMatrices(1, &theirs));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ColumnsCreate_Private(Mat A, IS chosen, Columns *columns)
{
  PetscFunctionBeginUser;
  columns->chosen = NULL;
  for (PetscInt k = 0; k < CACHE; k++) columns->found[k] = -1;
  PetscCall(MatGetSize(A, NULL, &columns->num));
  if (chosen) PetscCall(ISGetLocalSize(chosen, &columns->num));
  if (chosen) PetscCall(ISGetIndices(chosen, &columns->chosen));
  PetscCall(MatGetOwnershipRangeColumn(A, &columns->begin, &columns->end));
  PetscCall(PetscMalloc1(columns->end - columns->begin, &columns->own));
  for (PetscInt j = columns->begin; j < columns->end; j++) columns->own[j - columns->begin] = chosen ? -1 : j;
  for (PetscInt k = 0; chosen && k < columns->num; k++) {
    const PetscInt j = columns->chosen[k];

    if (j >= columns->begin && j < columns->end) columns->own[j - columns->begin] = k;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode DealtRowsCreate(Mat A, IS rows, IS chosen, Mat *own)
{
  PetscInt        num;
  const PetscInt *row;
  Columns         columns;
  Arrays         *arrays;
  PetscContainer  container;

  PetscFunctionBeginUser;
  PetscCall(ISGetLocalSize(rows, &num));
  PetscCall(ISGetIndices(rows, &row));
  PetscCall(ColumnsCreate_Private(A, chosen, &columns));
  PetscCall(PetscNew(&arrays));
  PetscCall(ArraysCreate_Private(A, num, row, &columns, arrays));
  PetscCall(ISRestoreIndices(rows, &row));
  if (chosen) PetscCall(ISRestoreIndices(chosen, &columns.chosen));
  PetscCall(PetscFree(columns.own));
  PetscCall(
      MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, num, columns.num, arrays->start, arrays->column, arrays->value, own));
  PetscCall(PetscContainerCreate(PETSC_COMM_SELF, &container));
  PetscCall(PetscContainerSetPointer(container, arrays));
  PetscCall(PetscContainerSetCtxDestroy(container, ArraysDestroy_Private));
  PetscCall(PetscObjectCompose((PetscObject)*own, ARRAYS, (PetscObject)container));
  PetscCall(PetscContainerDestroy(&container));
  PetscFunctionReturn(PETSC_SUCCESS);
}
