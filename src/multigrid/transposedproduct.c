/* transposedproduct.c -- see the header.

   Each rank multiplies its own rows. MatTransposeMatMult() first finds all nonzeros in lists, and on several
   ranks the place of each entry. Here the columns of a rank are counted from its first one, ghosts last. */
#include "base/compat.h"
#include "multigrid/transposedproduct.h"

/* A matrix by rows. */
typedef struct {
  PetscInt     n, columns;
  PetscInt    *start, *column; /* [n + 1], [start[n]] */
  PetscScalar *value;
} Rows;

static PetscErrorCode RowsDestroy_Private(Rows *rows)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(rows->start));
  PetscCall(PetscFree(rows->column));
  PetscCall(PetscFree(rows->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The transpose; its columns ascend. [out] to - owned by the caller */
static PetscErrorCode RowsTranspose_Private(PetscInt n, PetscInt columns, const PetscInt start[],
                                            const PetscInt column[], const PetscScalar value[], Rows *to)
{
  PetscInt *at;

  PetscFunctionBeginUser;
  *to = (Rows){.n = columns, .columns = n};
  PetscCall(PetscCalloc1(columns + 1, &to->start));
  PetscCall(PetscMalloc1(start[n], &to->column));
  PetscCall(PetscMalloc1(start[n], &to->value));
  PetscCall(PetscMalloc1(columns + 1, &at));
  for (PetscInt k = 0; k < start[n]; k++) to->start[column[k] + 1]++;
  for (PetscInt i = 0; i < columns; i++) to->start[i + 1] += to->start[i];
  PetscCall(PetscArraycpy(at, to->start, columns + 1));
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt k = start[i]; k < start[i + 1]; k++) {
      to->column[at[column[k]]]  = i;
      to->value[at[column[k]]++] = value[k];
    }
  }
  PetscCall(PetscFree(at));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A B; the columns of its rows do not ascend. [in] start, column, value - B by rows, with `columns` columns;
   [out] product - owned by the caller */
static PetscErrorCode RowsMultiply_Private(const Rows *A, PetscInt columns, const PetscInt start[],
                                           const PetscInt column[], const PetscScalar value[], Rows *product)
{
  PetscInt *place, num = 0, room = 0;

  PetscFunctionBeginUser;
  *product = (Rows){.n = A->n, .columns = columns};
  PetscCall(PetscMalloc1(A->n + 1, &product->start));
  PetscCall(PetscMalloc1(columns, &place));
  for (PetscInt j = 0; j < columns; j++) place[j] = -1;
  product->start[0] = 0;
  for (PetscInt i = 0; i < A->n; i++) {
    const PetscInt first = num;
    PetscInt       most  = 0;

    for (PetscInt k = A->start[i]; k < A->start[i + 1]; k++) most += start[A->column[k] + 1] - start[A->column[k]];
    most = PetscMin(most, columns);
    if (num + most > room) {
      room = 2 * (num + most);
      PetscCall(PetscRealloc((size_t)room * sizeof(PetscInt), &product->column));
      PetscCall(PetscRealloc((size_t)room * sizeof(PetscScalar), &product->value));
    }
    for (PetscInt k = A->start[i]; k < A->start[i + 1]; k++) {
      const PetscScalar a = A->value[k];

      for (PetscInt l = start[A->column[k]]; l < start[A->column[k] + 1]; l++) {
        const PetscInt j = column[l];

        if (place[j] < first) {
          place[j]              = num;
          product->column[num]  = j;
          product->value[num++] = a * value[l];
        } else {
          product->value[place[j]] += a * value[l];
        }
      }
    }
    product->start[i + 1] = num;
  }
  PetscCall(PetscFree(place));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* L'R of one process, columns ascending. [out] product - owned by the caller */
static PetscErrorCode TransposedProductMultiply_Private(Mat L, Mat R, Rows *product)
{
  PetscInt           n, columns[2];
  PetscBool          done;
  const PetscInt    *start, *column;
  const PetscScalar *value;
  Mat                matrix[2] = {R, L};
  Rows               transpose = {.n = 0}, unordered;

  PetscFunctionBeginUser;
  for (int k = 0; k < 2; k++) { // (R'L)', since transposition puts columns in order
    PetscCall(MatGetSize(matrix[k], NULL, &columns[k]));
    PetscCall(MatGetRowIJ(matrix[k], 0, PETSC_FALSE, PETSC_FALSE, &n, &start, &column, &done));
    PetscCall(MatSeqAIJGetArrayRead(matrix[k], &value));
    if (k == 0)
      PetscCall(RowsTranspose_Private(n, columns[k], start, column, value, &transpose));
    else
      PetscCall(RowsMultiply_Private(&transpose, columns[k], start, column, value, &unordered));
    PetscCall(MatSeqAIJRestoreArrayRead(matrix[k], &value));
    PetscCall(MatRestoreRowIJ(matrix[k], 0, PETSC_FALSE, PETSC_FALSE, &n, &start, &column, &done));
  }
  PetscCall(RowsDestroy_Private(&transpose));
  PetscCall(RowsTranspose_Private(unordered.n, unordered.columns, unordered.start, unordered.column, unordered.value,
                                  product));
  PetscCall(RowsDestroy_Private(&unordered));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Room for the sum over ranks. [in] n - columns of L and of R on this rank; [in] row - numbers of the rows of
   the product */
static PetscErrorCode TransposedProductAllocate_Private(MPI_Comm comm, const PetscInt n[2], const PetscInt row[],
                                                        const Rows *product, Mat *sum)
{
  PetscInt          *own, *others, all;
  const PetscScalar *more;
  Vec                theirs;

  PetscFunctionBeginUser;
  PetscCall(MatCreate(comm, sum));
  PetscCall(MatSetSizes(*sum, n[0], n[1], PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*sum, MATAIJ));
  PetscCall(PetscCalloc2(n[0], &own, n[0], &others));
  PetscCall(VecCreateMPI(comm, n[0], PETSC_DETERMINE, &theirs));
  for (PetscInt i = 0; i < product->n; i++) {
    if (i >= n[0] && product->start[i] < product->start[i + 1])
      PetscCall(VecSetValue(theirs, row[i], product->start[i + 1] - product->start[i], ADD_VALUES));
    for (PetscInt k = product->start[i]; i < n[0] && k < product->start[i + 1]; k++)
      (product->column[k] < n[1] ? own : others)[i]++;
  }
  PetscCall(VecAssemblyBegin(theirs));
  PetscCall(VecAssemblyEnd(theirs));
  PetscCall(MatSetUp(*sum));
  PetscCall(MatGetSize(*sum, NULL, &all));
  PetscCall(VecGetArrayRead(theirs, &more));
  for (PetscInt i = 0; i < n[0]; i++) {
    own[i]    = PetscMin(own[i] + (PetscInt)PetscRealPart(more[i]), n[1]);
    others[i] = PetscMin(others[i] + (PetscInt)PetscRealPart(more[i]), all - n[1]);
  }
  PetscCall(VecRestoreArrayRead(theirs, &more));
  PetscCall(MatMPIAIJSetPreallocation(*sum, 0, own, 0, others));
  PetscCall(PetscFree2(own, others));
  PetscCall(VecDestroy(&theirs));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The sum over ranks. [in] n - as above; [in] global - numbers of rows and of columns of the product */
static PetscErrorCode TransposedProductSum_Private(MPI_Comm comm, const PetscInt n[2], const IS global[2],
                                                   Rows *product, Mat *sum)
{
  const PetscInt *number[2];

  PetscFunctionBeginUser;
  for (int k = 0; k < 2; k++) PetscCall(ISGetIndices(global[k], &number[k]));
  PetscCall(TransposedProductAllocate_Private(comm, n, number[0], product, sum));
  for (PetscInt k = 0; k < product->start[product->n]; k++) product->column[k] = number[1][product->column[k]];
  for (PetscInt i = 0; i < product->n; i++) {
    const PetscInt first = product->start[i], num = product->start[i + 1] - first;

    if (num)
      PetscCall(MatSetValues(*sum, 1, &number[0][i], num, &product->column[first], &product->value[first], ADD_VALUES));
  }
  PetscCall(MatAssemblyBegin(*sum, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*sum, MAT_FINAL_ASSEMBLY));
  for (int k = 0; k < 2; k++) PetscCall(ISRestoreIndices(global[k], &number[k]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TransposedProductCreate(Mat L, Mat R, Mat *product)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)L);
  PetscMPIInt    size;
  PetscInt       n[2], bs[2];
  Rows           rows;
  Mat            own[2];
  IS             global[2];

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(MatGetLocalSize(L, NULL, &n[0]));
  PetscCall(MatGetLocalSize(R, NULL, &n[1]));
  if (size == 1) {
    PetscCall(TransposedProductMultiply_Private(L, R, &rows));
    PetscCall(MatCreate(comm, product));
    PetscCall(MatSetSizes(*product, n[0], n[1], n[0], n[1]));
    PetscCall(MatSetType(*product, MATAIJ));
    PetscCall(MatSeqAIJSetPreallocationCSR(*product, rows.start, rows.column, rows.value));
  } else {
    PetscCall(MatMPIAIJGetLocalMatMerge(L, MAT_INITIAL_MATRIX, &global[0], &own[0]));
    PetscCall(MatMPIAIJGetLocalMatMerge(R, MAT_INITIAL_MATRIX, &global[1], &own[1]));
    PetscCall(TransposedProductMultiply_Private(own[0], own[1], &rows));
    PetscCall(TransposedProductSum_Private(comm, n, global, &rows, product));
    for (int k = 0; k < 2; k++) {
      PetscCall(MatDestroy(&own[k]));
      PetscCall(ISDestroy(&global[k]));
    }
  }
  PetscCall(MatGetBlockSizes(L, NULL, &bs[0]));
  PetscCall(MatGetBlockSizes(R, NULL, &bs[1]));
  PetscCall(MatSetBlockSizes(*product, bs[0], bs[1]));
  PetscCall(RowsDestroy_Private(&rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}
