/* condensedmatrix.c -- the matrix A of the inequality, as a shell of products or as an AIJ matrix.

   Iterations need its products alone. K and the factors of T give these without a second matrix of the size
   of K. */
#include "base/compat.h"
#include "problem/condensation.h"

typedef struct {
  Mat             Z, S; /* S is T'KT / stiffness, for products */
  PetscReal       stiffness;
  PetscInt        num;
  const PetscInt *fixed;
  Vec             diagonal, regularization, work; /* diag K */
} Condensed;

static PetscErrorCode MatMult_Condensed(Mat A, Vec x, Vec y)
{
  Condensed         *c;
  const PetscScalar *xa;
  PetscScalar       *a;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &c));
  PetscCall(VecCopy(x, c->work));
  PetscCall(VecGetArray(c->work, &a));
  for (PetscInt i = 0; i < c->num; i++) a[c->fixed[i]] = 0;
  PetscCall(VecRestoreArray(c->work, &a));
  PetscCall(MatMult(c->S, c->work, y));
  if (c->regularization) {
    PetscCall(VecPointwiseMult(c->work, c->regularization, c->work));
    PetscCall(VecAXPY(y, 1, c->work));
  }
  PetscCall(VecGetArray(y, &a));
  PetscCall(VecGetArrayRead(x, &xa));
  for (PetscInt i = 0; i < c->num; i++) a[c->fixed[i]] = xa[c->fixed[i]];
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCall(VecRestoreArray(y, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MatGetDiagonal_Condensed(Mat A, Vec diagonal)
{
  Condensed   *c;
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &c));
  PetscCall(VecCopy(c->diagonal, diagonal));
  PetscCall(VecScale(diagonal, 1 / c->stiffness));
  if (c->Z) PetscCall(MatGetDiagonal(c->Z, c->work));
  if (c->Z) PetscCall(VecAXPY(diagonal, 1, c->work));
  if (c->regularization) PetscCall(VecAXPY(diagonal, 1, c->regularization));
  PetscCall(VecGetArray(diagonal, &a));
  for (PetscInt i = 0; i < c->num; i++) a[c->fixed[i]] = 1;
  PetscCall(VecRestoreArray(diagonal, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MatDestroy_Condensed(Mat A)
{
  Condensed *c;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &c));
  PetscCall(VecDestroy(&c->work));
  PetscCall(PetscFree(c));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CondensedMatrixCreateShell(VI vi, Vec regularization, Mat *A)
{
  const Mat  K = vi->K;
  Condensed *c;
  PetscInt   n, bs;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&c));
  *c = (Condensed){.Z              = vi->Z,
                   .S              = vi->S,
                   .stiffness      = vi->stiffness,
                   .num            = vi->num_fixed,
                   .fixed          = vi->fixed_local,
                   .diagonal       = vi->diagonal,
                   .regularization = regularization};
  PetscCall(MatCreateVecs(K, &c->work, NULL));
  PetscCall(MatGetLocalSize(K, &n, NULL));
  PetscCall(MatGetBlockSize(K, &bs));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)K), n, n, PETSC_DETERMINE, PETSC_DETERMINE, c, A));
  PetscCall(MatSetBlockSize(*A, bs));
  PetscCall(MatShellSetOperation(*A, MATOP_MULT, (void (*)(void))MatMult_Condensed));
  PetscCall(MatShellSetOperation(*A, MATOP_MULT_TRANSPOSE, (void (*)(void))MatMult_Condensed));
  PetscCall(MatShellSetOperation(*A, MATOP_GET_DIAGONAL, (void (*)(void))MatGetDiagonal_Condensed));
  PetscCall(MatShellSetOperation(*A, MATOP_DESTROY, (void (*)(void))MatDestroy_Condensed));
  PetscCall(MatSetOption(*A, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A row of factor K + Z. [out] columns - ascending; columns, values - optional, may be NULL [*num] */
static PetscErrorCode CondensedMatrixGetRow_Private(Mat K, PetscReal factor, Mat Z, PetscInt row, PetscInt *num,
                                                    PetscInt columns[], PetscScalar values[])
{
  const Mat          matrix[2] = {K, Z};
  PetscInt           length[2] = {0, 0}, at[2] = {0, 0};
  const PetscInt    *c[2];
  const PetscScalar *v[2];

  PetscFunctionBeginUser;
  for (PetscInt m = 0; m < 2 && matrix[m]; m++)
    PetscCall(MatGetRow(matrix[m], row, &length[m], &c[m], values ? &v[m] : NULL));
  for (*num = 0; at[0] < length[0] || at[1] < length[1]; ++*num) {
    const PetscInt  first = at[0] < length[0] ? c[0][at[0]] : PETSC_MAX_INT;
    const PetscInt  other = at[1] < length[1] ? c[1][at[1]] : PETSC_MAX_INT;
    const PetscBool mine = (PetscBool)(first <= other), its = (PetscBool)(other <= first);

    if (columns) columns[*num] = PetscMin(first, other);
    if (values) values[*num] = (mine ? factor * v[0][at[0]] : 0) + (its ? v[1][at[1]] : 0);
    at[0] += mine;
    at[1] += its;
  }
  for (PetscInt m = 0; m < 2 && matrix[m]; m++)
    PetscCall(MatRestoreRow(matrix[m], row, &length[m], &c[m], values ? &v[m] : NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* factor K + Z on one process. MatConvert() and MatAXPY() look up each entry: 15 % of a run of `cam`, against
   6 % here. */
static PetscErrorCode CondensedMatrixSum_Private(Mat K, PetscReal factor, Mat Z, Mat *A)
{
  PetscInt     n, bs, num, all = 0, *room, *columns;
  PetscScalar *values;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(K, &n, NULL));
  PetscCall(MatGetBlockSize(K, &bs));
  PetscCall(PetscMalloc1(n, &room));
  for (PetscInt row = 0; row < n; row++) {
    PetscCall(CondensedMatrixGetRow_Private(K, factor, Z, row, &room[row], NULL, NULL));
    all += room[row];
  }
  PetscCall(MatCreate(PetscObjectComm((PetscObject)K), A));
  PetscCall(MatSetSizes(*A, n, n, n, n));
  PetscCall(MatSetBlockSize(*A, bs));
  PetscCall(MatSetType(*A, MATSEQAIJ));
  PetscCall(MatSeqAIJSetPreallocation(*A, 0, room));
  PetscCall(PetscMalloc1(all, &columns));
  PetscCall(MatSeqAIJGetArrayWrite(*A, &values));
  all = 0;
  for (PetscInt row = 0; row < n; row++, all += num)
    PetscCall(CondensedMatrixGetRow_Private(K, factor, Z, row, &num, &columns[all], &values[all]));
  PetscCall(MatSeqAIJRestoreArrayWrite(*A, &values));
  PetscCall(MatSeqAIJSetColumnIndices(*A, columns));
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree(columns));
  PetscCall(PetscFree(room));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CondensedMatrixAssemble(Mat K, PetscReal stiffness, Mat Z, PetscInt num, const PetscInt fixed[], Mat *A)
{
  PetscMPIInt size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)K), &size));
  if (size == 1) {
    PetscCall(CondensedMatrixSum_Private(K, 1 / stiffness, Z, A));
  } else {
    PetscCall(MatConvert(K, MATAIJ, MAT_INITIAL_MATRIX, A));
    PetscCall(MatScale(*A, 1 / stiffness));
    if (Z) PetscCall(MatAXPY(*A, 1, Z, DIFFERENT_NONZERO_PATTERN));
  }
  PetscCall(MatZeroRowsColumns(*A, num, fixed, 1, NULL, NULL));
  PetscCall(MatSetOption(*A, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}
