/* bodysmoother.c -- constrained smoother, body by body.

   In y, u = T y, an unknown of the mortar side moves the nonmortar side as well. Its entry of diag A is large
   if the nonmortar side is stiff, although hardly anything resists the motion while the sides may separate.
   So each body is smoothed in its displacements, by its own diagonal:

       S = T'D T,   D = diag K,   S^-1 = T^-1 D^-1 T^-T =: G.

   The eigenvalues of S and T'K T are those of D and K. For fixed unknowns h, active ones among them, G is
   corrected on free ones f:

       S_ff^-1 = G_ff - G_fh G_hh^-1 G_hf,   G_hh = X D^-1 X',

   with X the rows h of T^-1. G_hh is small and sparse, and is factored. Displacements that are fixed along
   axes are excluded: D^-1 is 0 there. */
#include "base/compat.h"
#include "multigrid/bodysmoother.h"
#include "multigrid/redundantsolve.h"

typedef struct {
  Mat        inverse;    /* T^-1 */
  Mat        E;          /* T^-1 - 1, without empty rows */
  Vec        w;          /* D^-1, 0 where `alone` */
  Vec        s, t;       /* displacements, forces */
  PetscBool *eliminated; /* fixed displacements [unknowns of this rank] */
  PetscInt   num;
  PetscInt  *fixed;  /* [num] */
  Mat        X;      /* NULL if all fixed unknowns are displacements */
  PC         factor; /* of G_hh */
  Vec        gap, force;
} BodySmoother;

static PetscErrorCode BodySmootherRelease_Private(BodySmoother *body)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(body->fixed));
  PetscCall(MatDestroy(&body->X));
  PetscCall(PCDestroy(&body->factor));
  PetscCall(VecDestroy(&body->gap));
  PetscCall(VecDestroy(&body->force));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_BodySmoother(Mat S)
{
  BodySmoother *body;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &body));
  PetscCall(BodySmootherRelease_Private(body));
  PetscCall(MatDestroy(&body->inverse));
  PetscCall(MatDestroy(&body->E));
  PetscCall(VecDestroy(&body->w));
  PetscCall(VecDestroy(&body->s));
  PetscCall(VecDestroy(&body->t));
  PetscCall(PetscFree(body->eliminated));
  PetscCall(PetscFree(body));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* z = S_ff^-1 r, for r that is 0 where fixed */
static PetscErrorCode Mult_BodySmoother(Mat S, Vec r, Vec z)
{
  BodySmoother *body;
  PetscScalar  *a;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &body));
  PetscCall(MatMultTransposeAdd(body->E, r, r, body->t));
  PetscCall(VecPointwiseMult(body->s, body->w, body->t));
  if (body->X) {
    PetscCall(MatMult(body->X, body->s, body->gap));
    PetscCall(PCApply(body->factor, body->gap, body->force));
    PetscCall(VecScale(body->force, -1));
    PetscCall(MatMultTransposeAdd(body->X, body->force, body->t, body->t));
    PetscCall(VecPointwiseMult(body->s, body->w, body->t));
  }
  PetscCall(MatMultAdd(body->E, body->s, body->s, z));
  PetscCall(VecGetArray(z, &a));
  for (PetscInt i = 0; i < body->num; i++) a[body->fixed[i]] = 0;
  PetscCall(VecRestoreArray(z, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* D^-1, 0 where `alone`. */
static PetscErrorCode BodySmootherSetWeights_Private(const Operator *op, BodySmoother *body)
{
  PetscScalar *w;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(VecCopy(op->diagonal, body->w));
  PetscCall(VecReciprocal(body->w));
  PetscCall(VecScale(body->w, op->stiffness));
  PetscCall(VecGetLocalSize(body->w, &n));
  PetscCall(PetscCalloc1(n, &body->eliminated));
  PetscCall(OperatorMarkFixedDisplacements(op, body->eliminated));
  PetscCall(VecGetArray(body->w, &w));
  for (PetscInt i = 0; i < op->num_fixed; i++)
    if (body->eliminated[op->fixed[i]]) w[op->fixed[i]] = 0;
  PetscCall(VecRestoreArray(body->w, &w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* T^-1 - 1: rows of nodes on contact sides or with oblique supports only. */
static PetscErrorCode BodySmootherCreateE_Private(Mat inverse, Mat *E)
{
  PetscInt begin, end, n, *own, *others;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(inverse, &begin, &end));
  n = end - begin;
  PetscCall(PetscCalloc2(n, &own, n, &others));
  for (PetscInt pass = 0; pass < 2; pass++) { // sizes, then values
    if (pass)
      PetscCall(MatCreateAIJ(PetscObjectComm((PetscObject)inverse), n, n, PETSC_DETERMINE, PETSC_DETERMINE, 0, own, 0,
                             others, E));
    for (PetscInt row = begin; row < end; row++) {
      PetscInt           num;
      const PetscInt    *columns;
      const PetscScalar *values;

      PetscCall(MatGetRow(inverse, row, &num, &columns, &values));
      if (num == 1 && columns[0] == row && values[0] == 1) num = -1;
      for (PetscInt j = 0; j < num; j++) {
        if (pass)
          PetscCall(MatSetValue(*E, row, columns[j], values[j], ADD_VALUES));
        else
          ++(columns[j] >= begin && columns[j] < end ? own : others)[row - begin];
      }
      if (num >= 0 && pass) PetscCall(MatSetValue(*E, row, row, -1, ADD_VALUES));
      if (num >= 0 && !pass) own[row - begin] = PetscMin(own[row - begin] + 1, n);
      PetscCall(MatRestoreRow(inverse, row, NULL, &columns, &values));
    }
  }
  PetscCall(MatAssemblyBegin(*E, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*E, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree2(own, others));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodySmootherCreate(const Operator *op, Mat *inverse)
{
  PetscInt      n;
  BodySmoother *body;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&body));
  PetscCall(PetscObjectReference((PetscObject)op->inverse));
  body->inverse = op->inverse;
  PetscCall(BodySmootherCreateE_Private(body->inverse, &body->E));
  PetscCall(MatCreateVecs(op->K, &body->w, &body->s));
  PetscCall(VecDuplicate(body->w, &body->t));
  PetscCall(BodySmootherSetWeights_Private(op, body));
  PetscCall(VecGetLocalSize(body->w, &n));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)op->K), n, n, PETSC_DETERMINE, PETSC_DETERMINE, body, inverse));
  PetscCall(MatShellSetOperation(*inverse, MATOP_MULT, (void (*)(void))Mult_BodySmoother));
  PetscCall(MatShellSetOperation(*inverse, MATOP_DESTROY, (void (*)(void))Destroy_BodySmoother));
  PetscCall(BodySmootherSetFixed(*inverse, op->num_fixed, op->fixed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodySmootherIs(Mat S, PetscBool *body)
{
  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)S, MATSHELL, body));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* X D^-1 X' */
static PetscErrorCode BodySmootherCreateG_Private(Mat X, Vec w, Mat *G)
{
  Mat half, other;
  Vec root;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(w, &root));
  PetscCall(VecCopy(w, root));
  PetscCall(VecSqrtAbs(root));
  PetscCall(MatDuplicate(X, MAT_COPY_VALUES, &half));
  PetscCall(MatDiagonalScale(half, NULL, root));
  PetscCall(MatTranspose(half, MAT_INITIAL_MATRIX, &other));
  PetscCall(MatMatMult(half, other, MAT_INITIAL_MATRIX, PETSC_DEFAULT, G));
  PetscCall(MatProductClear(*G)); // it would keep its factors
  PetscCall(MatSetOption(*G, MAT_SPD, PETSC_TRUE));
  PetscCall(MatDestroy(&half));
  PetscCall(MatDestroy(&other));
  PetscCall(VecDestroy(&root));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* G_hh and its factorization. */
static PetscErrorCode BodySmootherFactor_Private(BodySmoother *body)
{
  Mat G;

  PetscFunctionBeginUser;
  PetscCall(BodySmootherCreateG_Private(body->X, body->w, &G));
  PetscCall(MatCreateVecs(G, &body->force, &body->gap));
  PetscCall(PCCreate(PetscObjectComm((PetscObject)G), &body->factor));
  PetscCall(PCSetOptionsPrefix(body->factor, "apart_"));
  PetscCall(PCSetOperators(body->factor, G, G));
  PetscCall(RedundantSolveSetPC(body->factor));
  PetscCall(PCSetUp(body->factor));
  PetscCall(MatDestroy(&G));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BodySmootherSetFixed(Mat inverse, PetscInt num, const PetscInt fixed[])
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)inverse);
  BodySmoother  *body;
  IS             rows, columns;
  PetscInt       begin, n, count = 0, total, *list;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(inverse, &body));
  PetscCall(BodySmootherRelease_Private(body));
  PetscCall(PetscMalloc1(num, &body->fixed));
  PetscCall(PetscArraycpy(body->fixed, fixed, num));
  body->num = num;
  PetscCall(MatGetOwnershipRange(body->inverse, &begin, NULL));
  PetscCall(MatGetLocalSize(body->inverse, &n, NULL));
  PetscCall(PetscMalloc1(num, &list));
  for (PetscInt i = 0; i < num; i++)
    if (!body->eliminated[fixed[i]]) list[count++] = begin + fixed[i];
  PetscCall(PetscSortRemoveDupsInt(&count, list));
  PetscCallMPI(MPI_Allreduce(&count, &total, 1, MPIU_INT, MPI_SUM, comm));
  PetscCall(ISCreateGeneral(comm, count, list, PETSC_OWN_POINTER, &rows));
  if (total > 0) {
    PetscCall(ISCreateStride(comm, n, begin, 1, &columns));
    PetscCall(MatCreateSubMatrix(body->inverse, rows, columns, MAT_INITIAL_MATRIX, &body->X));
    PetscCall(ISDestroy(&columns));
    PetscCall(BodySmootherFactor_Private(body));
  }
  PetscCall(ISDestroy(&rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}
