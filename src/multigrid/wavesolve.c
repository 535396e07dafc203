/* wavesolve.c -- the small system of waves.

   Its matrix does not change with the active set: waves are zero on unknowns of contact. */
#include "base/compat.h"
#include "multigrid/galerkin.h"
#include "multigrid/redundantsolve.h"
#include "multigrid/wavesolve.h"

/* Added to the diagonal, relative to it: waves may depend on each other beside contact. */
static const PetscReal DIAGONAL_SHIFT = 1e-10;

/* A matrix of the kind that knows rows and MatConvert(). [in,out] sum - NULL before the first */
static PetscErrorCode WaveSolveAdd_Private(Mat A, Mat Q, PetscReal factor, Mat *sum)
{
  Mat whole, product;

  PetscFunctionBeginUser;
  PetscCall(MatConvert(A, MATAIJ, MAT_INITIAL_MATRIX, &whole));
  PetscCall(GalerkinProduct(whole, Q, &product));
  PetscCall(MatDestroy(&whole));
  PetscCall(MatScale(product, factor));
  if (!*sum) {
    *sum = product;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MatAXPY(*sum, 1, product, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&product));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Unknowns of empty waves, as on supports, become zero. */
static PetscErrorCode WaveSolveShift_Private(Mat A)
{
  PetscInt     n;
  PetscScalar *a;
  Vec          diag;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(A, &diag, NULL));
  PetscCall(MatGetDiagonal(A, diag));
  PetscCall(VecGetLocalSize(diag, &n));
  PetscCall(VecGetArray(diag, &a));
  for (PetscInt i = 0; i < n; i++) a[i] = PetscRealPart(a[i]) > 0 ? DIAGONAL_SHIFT * a[i] : 1;
  PetscCall(VecRestoreArray(diag, &a));
  PetscCall(MatDiagonalSet(A, diag, ADD_VALUES));
  PetscCall(VecDestroy(&diag));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode WaveSolveCreate(const Operator *op, PC *solve)
{
  Mat A = NULL;

  PetscFunctionBeginUser;
  PetscCall(WaveSolveAdd_Private(op->K, op->waves, 1 / op->stiffness, &A));
  if (op->Z) PetscCall(WaveSolveAdd_Private(op->Z, op->waves, 1, &A));
  PetscCall(WaveSolveShift_Private(A));
  PetscCall(MatSetOption(A, MAT_SPD, PETSC_TRUE));
  PetscCall(PCCreate(PetscObjectComm((PetscObject)A), solve));
  PetscCall(PCSetOperators(*solve, A, A));
  PetscCall(RedundantSolveSetPC(*solve));
  PetscCall(RedundantSolveGather(*solve));
  PetscCall(PCSetUp(*solve));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(PETSC_SUCCESS);
}
