/* condensedmatrix.c -- the matrix A of the inequality, as a shell of products or as an AIJ matrix.

   Iterations need its products alone. K and the small Z give these without a second matrix of the size of
   K. */
#include "base/compat.h"
#include "problem/condensation.h"

typedef struct {
  Mat             Z, S; /* S is K / stiffness */
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
  if (c->Z) PetscCall(MatMultAdd(c->Z, c->work, y, y));
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

PetscErrorCode CondensedMatrixAssemble(Mat K, PetscReal stiffness, Mat Z, PetscInt num, const PetscInt fixed[], Mat *A)
{
  PetscFunctionBeginUser;
  PetscCall(MatConvert(K, MATAIJ, MAT_INITIAL_MATRIX, A));
  PetscCall(MatScale(*A, 1 / stiffness));
  if (Z) PetscCall(MatAXPY(*A, 1, Z, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatZeroRowsColumns(*A, num, fixed, 1, NULL, NULL));
  PetscCall(MatSetOption(*A, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}
