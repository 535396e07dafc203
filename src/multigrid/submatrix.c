/* submatrix.c -- the free part of A, which `vinewtonrsls` takes out in each of its steps, without a copy.

   PETSc's own virtual submatrix keeps the block size, and the unknowns that are left do not come in blocks. */
#include "base/compat.h"
#include "multigrid/submatrix.h"

typedef struct {
  Mat        A;
  PetscReal  share, *work;
  Vec        x, y;    /* on all unknowns */
  VecScatter scatter; /* from there to those of the part; NULL of the whole */
} Excerpt;

static PetscErrorCode Mult_Excerpt(Mat M, Vec x, Vec y)
{
  Excerpt *excerpt;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(M, &excerpt));
  *excerpt->work += excerpt->share;
  if (!excerpt->scatter) {
    PetscCall(MatMult(excerpt->A, x, y));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(VecZeroEntries(excerpt->x));
  PetscCall(VecScatterBegin(excerpt->scatter, x, excerpt->x, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(excerpt->scatter, x, excerpt->x, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(MatMult(excerpt->A, excerpt->x, excerpt->y));
  PetscCall(VecScatterBegin(excerpt->scatter, excerpt->y, y, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(excerpt->scatter, excerpt->y, y, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Excerpt(Mat M)
{
  Excerpt *excerpt;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(M, &excerpt));
  PetscCall(MatDestroy(&excerpt->A));
  PetscCall(VecDestroy(&excerpt->x));
  PetscCall(VecDestroy(&excerpt->y));
  PetscCall(VecScatterDestroy(&excerpt->scatter));
  PetscCall(PetscFree(excerpt));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in] n - rows of this rank; [out] M - with a context of A, share and work */
static PetscErrorCode Create_Private(Mat A, PetscReal share, PetscReal *work, PetscInt n, Excerpt **excerpt, Mat *M)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(excerpt));
  PetscCall(PetscObjectReference((PetscObject)A));
  (*excerpt)->A     = A;
  (*excerpt)->share = share;
  (*excerpt)->work  = work;
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)A), n, n, PETSC_DETERMINE, PETSC_DETERMINE, *excerpt, M));
  PetscCall(MatShellSetOperation(*M, MATOP_MULT, (void (*)(void))Mult_Excerpt));
  PetscCall(MatShellSetOperation(*M, MATOP_MULT_TRANSPOSE, (void (*)(void))Mult_Excerpt));
  PetscCall(MatShellSetOperation(*M, MATOP_DESTROY, (void (*)(void))Destroy_Excerpt));
  PetscCall(MatSetOption(*M, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Answers MatCreateSubMatrix(). */
static PetscErrorCode CreateSubMatrix_Excerpt(Mat whole, IS rows, IS columns, MatReuse reuse, Mat *part)
{
  Excerpt  *all, *excerpt;
  PetscBool same;
  PetscInt  n;
  Vec       x;

  PetscFunctionBeginUser;
  PetscCall(ISEqual(rows, columns, &same));
  PetscCheck(same && reuse == MAT_INITIAL_MATRIX, PetscObjectComm((PetscObject)whole), PETSC_ERR_SUP,
             "Only new parts with the same rows as columns");
  PetscCall(MatShellGetContext(whole, &all));
  PetscCall(ISGetLocalSize(rows, &n));
  PetscCall(Create_Private(all->A, all->share, all->work, n, &excerpt, part));
  PetscCall(MatCreateVecs(all->A, &excerpt->x, &excerpt->y));
  PetscCall(MatCreateVecs(*part, &x, NULL));
  PetscCall(VecScatterCreate(excerpt->x, rows, x, NULL, &excerpt->scatter));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExcerptCreateWhole(Mat A, PetscReal share, PetscReal *work, Mat *whole)
{
  Excerpt *excerpt;
  PetscInt n;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(A, &n, NULL));
  PetscCall(Create_Private(A, share, work, n, &excerpt, whole));
  PetscCall(MatShellSetOperation(*whole, MATOP_CREATE_SUBMATRIX, (void (*)(void))CreateSubMatrix_Excerpt));
  PetscFunctionReturn(PETSC_SUCCESS);
}
