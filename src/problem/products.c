/* products.c -- K for products alone: its upper triangle in blocks.

   Iterations read K from memory again and again. Half of it, without a column for every entry, is read in half the time. */
#include <mortise/compat.h>
#include "condense.h"

/* Block rows as SBAIJ wants them: the columns from the diagonal on. */
typedef struct {
  PetscInt    *start, *column; /* [num+1], [start[num]] */
  PetscScalar *value;          /* [start[num]][bs][bs], each block row by row */
} BlockRows;

/* The first entry of a row that is not left of its diagonal block. */
static PetscInt FindDiagonal_Private(PetscInt num, const PetscInt columns[], PetscInt first)
{
  PetscInt lower = 0, upper = num;

  while (lower < upper) {
    const PetscInt middle = (lower + upper) / 2;

    if (columns[middle] < first)
      lower = middle + 1;
    else
      upper = middle;
  }
  return lower;
}

/* How many blocks the upper triangle has. */
static PetscErrorCode CountBlocks_Private(Mat K, PetscInt bs, PetscInt start[])
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(K, &begin, &end));
  start[0] = 0;
  for (PetscInt row = begin; row < end; row += bs) {
    const PetscInt i = (row - begin) / bs, *columns;
    PetscInt       num;

    PetscCall(MatGetRow(K, row, &num, &columns, NULL));
    start[i + 1] = start[i] + (num - FindDiagonal_Private(num, columns, row)) / bs;
    PetscCall(MatRestoreRow(K, row, &num, &columns, NULL));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode FillBlocks_Private(Mat K, PetscInt bs, PetscReal factor, BlockRows *rows)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(K, &begin, &end));
  for (PetscInt row = begin; row < end; row++) {
    const PetscInt     i = (row - begin) / bs, k = (row - begin) % bs, *columns;
    PetscInt           num, first;
    const PetscScalar *values;

    PetscCall(MatGetRow(K, row, &num, &columns, &values));
    first = FindDiagonal_Private(num, columns, row - k);
    for (PetscInt j = first; j < num; j++) {
      const PetscInt block = rows->start[i] + (j - first) / bs, l = (j - first) % bs;

      rows->column[block]                    = columns[j] / bs;
      rows->value[(block * bs + k) * bs + l] = factor * values[j];
    }
    PetscCall(MatRestoreRow(K, row, &num, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProductsCreate(Mat K, PetscReal factor, Mat *S)
{
  PetscInt  n, bs;
  BlockRows rows;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(K, &n, NULL));
  PetscCall(MatGetBlockSize(K, &bs));
  PetscCall(PetscMalloc1(n / bs + 1, &rows.start));
  PetscCall(CountBlocks_Private(K, bs, rows.start));
  PetscCall(PetscMalloc2(rows.start[n / bs], &rows.column, rows.start[n / bs] * bs * bs, &rows.value));
  PetscCall(FillBlocks_Private(K, bs, factor, &rows));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)K), S));
  PetscCall(MatSetSizes(*S, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetBlockSize(*S, bs));
  PetscCall(MatSetType(*S, MATSBAIJ));
  PetscCall(MatSeqSBAIJSetPreallocationCSR(*S, bs, rows.start, rows.column, rows.value)); // one of the two does nothing
  PetscCall(MatMPISBAIJSetPreallocationCSR(*S, bs, rows.start, rows.column, rows.value));
  PetscCall(PetscFree(rows.start));
  PetscCall(PetscFree2(rows.column, rows.value));
  PetscFunctionReturn(PETSC_SUCCESS);
}
