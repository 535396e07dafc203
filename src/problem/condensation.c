/* condensation.c -- T'KT, which differs from K next to the contact only.

   With T = I + E, T'KT = K + Z, Z = E'K + K E + E'K E = E'W + W'E, W = K (I + E / 2). E has rows at the nodes
   of the nonmortar sides alone. Of W no other rows are needed, and Z is as small. Every rank works on its own
   of these rows. */
#include "base/compat.h"
#include "multigrid/transposedproduct.h"
#include "problem/condensation.h"

/* E = T - I without the zeros. [out] rows - of this rank, that are not empty; owned by the caller [num] */
static PetscErrorCode CondensationCreateDifference_Private(Mat T, PetscInt *num, PetscInt **rows, Mat *E)
{
  PetscInt begin, end, N, bs, *d_nnz, *o_nnz;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(T, &begin, &end));
  PetscCall(MatGetSize(T, &N, NULL));
  PetscCall(MatGetBlockSize(T, &bs));
  PetscCall(PetscMalloc1(end - begin, rows));
  PetscCall(PetscCalloc2(end - begin, &d_nnz, end - begin, &o_nnz));
  *num = 0;
  for (PetscInt pass = 0; pass < 2; pass++) {
    const PetscInt listed = *num;

    if (pass) {
      PetscCall(MatCreateAIJ(PetscObjectComm((PetscObject)T), end - begin, end - begin, N, N, 0, d_nnz, 0, o_nnz, E));
      PetscCall(MatSetBlockSize(*E, bs));
    }
    for (PetscInt i = 0; i < (pass ? listed : end - begin);
         i++) { // most rows of T are the identity's: they are read once
      const PetscInt     row = pass ? (*rows)[i] : begin + i;
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
      if (!pass && d_nnz[i] + o_nnz[i]) (*rows)[(*num)++] = row;
    }
  }
  PetscCall(PetscFree2(d_nnz, o_nnz));
  PetscCall(MatAssemblyBegin(*E, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*E, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Some rows of one matrix, or of two in turn: a matrix with as many columns.
   [in] other - NULL; rows - of this rank [num] */
static PetscErrorCode CondensationCreateRows_Private(PetscInt num, const PetscInt rows[], Mat one, Mat other, Mat *few)
{
  const Mat    from[2] = {one, other};
  const int    parts   = other ? 2 : 1;
  PetscInt    *start, *column, n, N, count = 0;
  PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(one, NULL, &n));
  PetscCall(MatGetSize(one, NULL, &N));
  PetscCall(PetscMalloc1(parts * num + 1, &start));
  start[0] = 0;
  for (int pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(PetscMalloc2(count, &column, count, &value));
    count = 0;
    for (PetscInt i = 0; i < parts * num; i++) {
      PetscInt           size;
      const PetscInt    *c;
      const PetscScalar *v;

      PetscCall(MatGetRow(from[i % parts], rows[i / parts], &size, &c, &v));
      if (pass) PetscCall(PetscArraycpy(&column[count], c, size));
      if (pass) PetscCall(PetscArraycpy(&value[count], v, size));
      count += size;
      start[i + 1] = count;
      PetscCall(MatRestoreRow(from[i % parts], rows[i / parts], &size, &c, &v));
    }
  }
  PetscCall(MatCreate(PetscObjectComm((PetscObject)one), few));
  PetscCall(MatSetSizes(*few, parts * num, n, PETSC_DETERMINE, N));
  PetscCall(MatSetType(*few, MATAIJ));
  PetscCall(MatSeqAIJSetPreallocationCSR(*few, start, column, value)); // one of the two does nothing
  PetscCall(MatMPIAIJSetPreallocationCSR(*few, start, column, value));
  PetscCall(PetscFree(start));
  PetscCall(PetscFree2(column, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CondensationCreate(Mat K, Mat T, Mat *Z)
{
  PetscInt *rows, num = 0, begin;
  Mat       E, few, W, KE, left, right;

  PetscFunctionBeginUser;
  PetscCall(CondensationCreateDifference_Private(T, &num, &rows, &E));
  PetscCall(CondensationCreateRows_Private(num, rows, E, NULL, &few));
  PetscCall(CondensationCreateRows_Private(num, rows, K, NULL, &W));
  PetscCall(MatMatMult(W, E, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &KE));
  PetscCall(MatAXPY(W, 0.5, KE, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&KE));
  PetscCall(MatDestroy(&E));
  PetscCall(MatGetOwnershipRange(few, &begin, NULL));
  for (PetscInt i = 0; i < num; i++) rows[i] = begin + i;
  PetscCall(CondensationCreateRows_Private(num, rows, few, W, &left));
  PetscCall(CondensationCreateRows_Private(num, rows, W, few, &right));
  PetscCall(TransposedProductCreate(left, right, Z)); // both terms at once
  PetscCall(MatDestroy(&left));
  PetscCall(MatDestroy(&right));
  PetscCall(MatDestroy(&W));
  PetscCall(MatDestroy(&few));
  PetscCall(PetscFree(rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}
