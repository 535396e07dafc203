/* submatrix.c -- the free part of A, which `vinewtonrsls` extracts in each step, without a copy.

   PETSc's MATSUBMATRIX keeps the block size, but the free unknowns do not come in blocks. */
#include "base/compat.h"
#include "multigrid/submatrix.h"

typedef struct {
  Mat        A;
  PetscReal  share, *work;
  Vec        x, y;    /* on all unknowns */
  VecScatter scatter; /* from there to the submatrix; NULL for the whole */
} Submatrix;

static PetscErrorCode Mult_Submatrix(Mat M, Vec x, Vec y)
{
  Submatrix *sub;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(M, &sub));
  *sub->work += sub->share;
  if (!sub->scatter) {
    PetscCall(MatMult(sub->A, x, y));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(VecZeroEntries(sub->x));
  PetscCall(VecScatterBegin(sub->scatter, x, sub->x, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(sub->scatter, x, sub->x, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(MatMult(sub->A, sub->x, sub->y));
  PetscCall(VecScatterBegin(sub->scatter, sub->y, y, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(sub->scatter, sub->y, y, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Submatrix(Mat M)
{
  Submatrix *sub;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(M, &sub));
  PetscCall(MatDestroy(&sub->A));
  PetscCall(VecDestroy(&sub->x));
  PetscCall(VecDestroy(&sub->y));
  PetscCall(VecScatterDestroy(&sub->scatter));
  PetscCall(PetscFree(sub));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Creates the shell. [in] n - rows of this rank; [out] M - with a context of A, share and work */
static PetscErrorCode SubmatrixCreateShell_Private(Mat A, PetscReal share, PetscReal *work, PetscInt n, Submatrix **sub,
                                                   Mat *M)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(sub));
  PetscCall(PetscObjectReference((PetscObject)A));
  (*sub)->A     = A;
  (*sub)->share = share;
  (*sub)->work  = work;
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)A), n, n, PETSC_DETERMINE, PETSC_DETERMINE, *sub, M));
  PetscCall(MatShellSetOperation(*M, MATOP_MULT, (void (*)(void))Mult_Submatrix));
  PetscCall(MatShellSetOperation(*M, MATOP_MULT_TRANSPOSE, (void (*)(void))Mult_Submatrix));
  PetscCall(MatShellSetOperation(*M, MATOP_DESTROY, (void (*)(void))Destroy_Submatrix));
  PetscCall(MatSetOption(*M, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Implements MatCreateSubMatrix(). */
static PetscErrorCode CreateSubMatrix_Submatrix(Mat whole, IS rows, IS columns, MatReuse reuse, Mat *part)
{
  Submatrix *all, *sub;
  PetscBool  same;
  PetscInt   n;
  Vec        x;

  PetscFunctionBeginUser;
  PetscCall(ISEqual(rows, columns, &same));
  PetscCheck(same && reuse == MAT_INITIAL_MATRIX, PetscObjectComm((PetscObject)whole), PETSC_ERR_SUP,
             "Only new submatrices with the same rows as columns");
  PetscCall(MatShellGetContext(whole, &all));
  PetscCall(ISGetLocalSize(rows, &n));
  PetscCall(SubmatrixCreateShell_Private(all->A, all->share, all->work, n, &sub, part));
  PetscCall(MatCreateVecs(all->A, &sub->x, &sub->y));
  PetscCall(MatCreateVecs(*part, &x, NULL));
  PetscCall(VecScatterCreate(sub->x, rows, x, NULL, &sub->scatter));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SubmatrixCreateWhole(Mat A, PetscReal share, PetscReal *work, Mat *whole)
{
  Submatrix *sub;
  PetscInt   n;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(A, &n, NULL));
  PetscCall(SubmatrixCreateShell_Private(A, share, work, n, &sub, whole));
  PetscCall(MatShellSetOperation(*whole, MATOP_CREATE_SUBMATRIX, (void (*)(void))CreateSubMatrix_Submatrix));
  PetscFunctionReturn(PETSC_SUCCESS);
}
