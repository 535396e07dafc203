/* transposedproduct.c -- see the header.

   MatTransposeMatMult() of several ranks takes twice the time: it merges rows entry by entry. Here each rank
   multiplies its own rows, with ghost columns last, and entries are added where they belong. */
#include "base/compat.h"
#include "multigrid/transposedproduct.h"

/* The sum over ranks of products with columns and rows counted from the first one of each rank.
   [in] number - their numbers on all ranks: rows, columns; [in,out] sum - with sizes */
static PetscErrorCode TransposedProductSum_Private(Mat own, const PetscInt *const number[2], Mat sum)
{
  PetscInt           n, *row, *column;
  PetscBool          done;
  const PetscInt    *start, *at;
  const PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(MatGetRowIJ(own, 0, PETSC_FALSE, PETSC_FALSE, &n, &start, &at, &done));
  PetscCall(MatSeqAIJGetArrayRead(own, &value));
  PetscCall(PetscMalloc2(start[n], &row, start[n], &column));
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt k = start[i]; k < start[i + 1]; k++) {
      row[k]    = number[0][i];
      column[k] = number[1][at[k]];
    }
  }
  PetscCall(MatSetPreallocationCOO(sum, start[n], row, column));
  PetscCall(MatSetValuesCOO(sum, value, INSERT_VALUES));
  PetscCall(PetscFree2(row, column));
  PetscCall(MatSeqAIJRestoreArrayRead(own, &value));
  PetscCall(MatRestoreRowIJ(own, 0, PETSC_FALSE, PETSC_FALSE, &n, &start, &at, &done));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* On several ranks. */
static PetscErrorCode TransposedProductCreateMPI_Private(Mat L, Mat R, Mat *product)
{
  const Mat       factor[2] = {L, R};
  const PetscInt *number[2];
  PetscInt        n[2];
  IS              global[2];
  Mat             own[2], local;

  PetscFunctionBeginUser;
  for (int k = 0; k < 2; k++) {
    PetscCall(MatGetLocalSize(factor[k], NULL, &n[k]));
    PetscCall(MatMPIAIJGetLocalMatMerge(factor[k], MAT_INITIAL_MATRIX, &global[k], &own[k]));
    PetscCall(ISGetIndices(global[k], &number[k]));
  }
  PetscCall(MatTransposeMatMult(own[0], own[1], MAT_INITIAL_MATRIX, PETSC_DEFAULT, &local));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)L), product));
  PetscCall(MatSetSizes(*product, n[0], n[1], PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*product, MATAIJ));
  PetscCall(TransposedProductSum_Private(local, number, *product));
  PetscCall(MatDestroy(&local));
  for (int k = 0; k < 2; k++) {
    PetscCall(ISRestoreIndices(global[k], &number[k]));
    PetscCall(ISDestroy(&global[k]));
    PetscCall(MatDestroy(&own[k]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TransposedProductCreate(Mat L, Mat R, Mat *product)
{
  PetscMPIInt size;
  PetscInt    bs[2];

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)L), &size));
  if (size == 1)
    PetscCall(MatTransposeMatMult(L, R, MAT_INITIAL_MATRIX, PETSC_DEFAULT, product));
  else
    PetscCall(TransposedProductCreateMPI_Private(L, R, product));
  PetscCall(MatProductClear(*product)); // else it keeps both factors
  PetscCall(MatGetBlockSizes(L, NULL, &bs[0]));
  PetscCall(MatGetBlockSizes(R, NULL, &bs[1]));
  PetscCall(MatSetBlockSizes(*product, bs[0], bs[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}
