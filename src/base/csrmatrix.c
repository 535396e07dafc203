/* csrmatrix.c -- see the header. */
#include "base/csrmatrix.h"
#include "base/compat.h"

static PetscErrorCode CSRMatrixSort_Private(CSRRows *rows)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < rows->m; i++) {
    const PetscInt begin = rows->start[i], num = rows->start[i + 1] - begin;
    PetscBool      sorted;

    PetscCall(PetscSortedInt(num, &rows->column[begin], &sorted));
    if (!sorted) PetscCall(PetscSortIntWithScalarArray(num, &rows->column[begin], &rows->value[begin]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* MatSeqAIJSetPreallocationCSR() searches the place of each row again, as MatSetValues() does. */
static PetscErrorCode CSRMatrixFill_Private(const CSRRows *rows, Mat A)
{
  PetscInt    *length;
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(rows->m, &length));
  for (PetscInt i = 0; i < rows->m; i++) length[i] = rows->start[i + 1] - rows->start[i];
  PetscCall(MatSeqAIJSetPreallocation(A, 0, length));
  PetscCall(PetscFree(length));
  PetscCall(MatSeqAIJGetArrayWrite(A, &a));
  PetscCall(PetscArraycpy(a, rows->value, rows->start[rows->m]));
  PetscCall(MatSeqAIJRestoreArrayWrite(A, &a));
  PetscCall(MatSeqAIJSetColumnIndices(A, rows->column));
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CSRMatrixCreate(MPI_Comm comm, CSRRows *rows, Mat *A)
{
  CSRRows     filled = *rows;
  PetscMPIInt size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  if (!rows->value) PetscCall(PetscMalloc1(rows->start[rows->m], &filled.value));
  for (PetscInt k = 0; k < rows->start[rows->m] && !rows->value; k++) filled.value[k] = 1;
  PetscCall(CSRMatrixSort_Private(&filled));
  PetscCall(MatCreate(comm, A));
  PetscCall(MatSetSizes(*A, rows->m, rows->n, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetBlockSize(*A, rows->bs));
  PetscCall(MatSetType(*A, MATAIJ));
  if (size == 1)
    PetscCall(CSRMatrixFill_Private(&filled, *A));
  else
    PetscCall(MatMPIAIJSetPreallocationCSR(*A, filled.start, filled.column, filled.value));
  if (!rows->value) PetscCall(PetscFree(filled.value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CSRMatrixMergeRow(PetscInt *num, PetscInt column[], PetscScalar value[])
{
  PetscInt last = 0;

  PetscFunctionBeginUser;
  if (*num <= 1) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscSortIntWithScalarArray(*num, column, value));
  for (PetscInt k = 1; k < *num; k++) {
    if (column[k] == column[last]) {
      value[last] += value[k];
    } else {
      column[++last] = column[k];
      value[last]    = value[k];
    }
  }
  *num = last + 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}
