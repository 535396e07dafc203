/* bodysmoother.c -- a smoother that does not feel across contact.

   In y, u = T y, an unknown of the mortar side takes the nonmortar side along, and its entry of diag A is large where that one is stiff, although
   next to nothing resists it as long as the sides may part. So bodies are smoothed in their displacements, by their own diagonals:
       S = T'D T,   D = diag K,   S^-1 = T^-1 D^-1 T^-T =: G,
   has with T'K T the eigenvalues that D has with K. Where unknowns h are held, those in contact among them, there is a correction of G on free ones f:
       S_ff^-1 = G_ff - G_fh G_hh^-1 G_hf,   G_hh = X D^-1 X',
   X the rows h of T^-1, so that G_hh is small and sparse and is factored. Displacements held along axes are no part of all this: D^-1
   is 0 there. */
#include "base/compat.h"
#include "multigrid/bodysmoother.h"
#include "multigrid/redundantsolve.h"

typedef struct {
  Mat        inverse; /* T^-1 */
  Mat        E;       /* T^-1 - 1, without rows that are empty */
  Vec        w;       /* D^-1, 0 where `alone` */
  Vec        s, t;    /* displacements, forces */
  PetscBool *alone;   /* eliminated, and a displacement [unknowns of this rank] */
  PetscInt   num;
  PetscInt  *held;   /* [num] */
  Mat        X;      /* NULL where all that is held is alone */
  PC         factor; /* of G_hh */
  Vec        gap, force;
} Apart;

static PetscErrorCode Release_Private(Apart *apart)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(apart->held));
  PetscCall(MatDestroy(&apart->X));
  PetscCall(PCDestroy(&apart->factor));
  PetscCall(VecDestroy(&apart->gap));
  PetscCall(VecDestroy(&apart->force));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Apart(Mat S)
{
  Apart *apart;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &apart));
  PetscCall(Release_Private(apart));
  PetscCall(MatDestroy(&apart->inverse));
  PetscCall(MatDestroy(&apart->E));
  PetscCall(VecDestroy(&apart->w));
  PetscCall(VecDestroy(&apart->s));
  PetscCall(VecDestroy(&apart->t));
  PetscCall(PetscFree(apart->alone));
  PetscCall(PetscFree(apart));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* z = S_ff^-1 r, for r that is 0 where held */
static PetscErrorCode Mult_Apart(Mat S, Vec r, Vec z)
{
  Apart       *apart;
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &apart));
  PetscCall(MatMultTransposeAdd(apart->E, r, r, apart->t));
  PetscCall(VecPointwiseMult(apart->s, apart->w, apart->t));
  if (apart->X) {
    PetscCall(MatMult(apart->X, apart->s, apart->gap));
    PetscCall(PCApply(apart->factor, apart->gap, apart->force));
    PetscCall(VecScale(apart->force, -1));
    PetscCall(MatMultTransposeAdd(apart->X, apart->force, apart->t, apart->t));
    PetscCall(VecPointwiseMult(apart->s, apart->w, apart->t));
  }
  PetscCall(MatMultAdd(apart->E, apart->s, apart->s, z));
  PetscCall(VecGetArray(z, &a));
  for (PetscInt i = 0; i < apart->num; i++) a[apart->held[i]] = 0;
  PetscCall(VecRestoreArray(z, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* D^-1, 0 where `alone`. */
static PetscErrorCode SetWeights_Private(const Operator *op, Apart *apart)
{
  PetscScalar *w;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(VecCopy(op->diagonal, apart->w));
  PetscCall(VecReciprocal(apart->w));
  PetscCall(VecScale(apart->w, op->stiffness));
  PetscCall(VecGetLocalSize(apart->w, &n));
  PetscCall(PetscCalloc1(n, &apart->alone));
  PetscCall(OperatorMarkFixedDisplacements(op, apart->alone));
  PetscCall(VecGetArray(apart->w, &w));
  for (PetscInt i = 0; i < op->num_fixed; i++)
    if (apart->alone[op->fixed[i]]) w[op->fixed[i]] = 0;
  PetscCall(VecRestoreArray(apart->w, &w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* T^-1 - 1: rows of nodes that face another body or lie obliquely, and nothing else. */
static PetscErrorCode CreateE_Private(Mat inverse, Mat *E)
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

PetscErrorCode ApartCreate(const Operator *op, Mat *inverse)
{
  PetscInt n;
  Apart   *apart;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&apart));
  PetscCall(PetscObjectReference((PetscObject)op->inverse));
  apart->inverse = op->inverse;
  PetscCall(CreateE_Private(apart->inverse, &apart->E));
  PetscCall(MatCreateVecs(op->K, &apart->w, &apart->s));
  PetscCall(VecDuplicate(apart->w, &apart->t));
  PetscCall(SetWeights_Private(op, apart));
  PetscCall(VecGetLocalSize(apart->w, &n));
  PetscCall(
      MatCreateShell(PetscObjectComm((PetscObject)op->K), n, n, PETSC_DETERMINE, PETSC_DETERMINE, apart, inverse));
  PetscCall(MatShellSetOperation(*inverse, MATOP_MULT, (void (*)(void))Mult_Apart));
  PetscCall(MatShellSetOperation(*inverse, MATOP_DESTROY, (void (*)(void))Destroy_Apart));
  PetscCall(ApartHold(*inverse, op->num_fixed, op->fixed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ApartIs(Mat S, PetscBool *apart)
{
  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)S, MATSHELL, apart));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* X D^-1 X' */
static PetscErrorCode CreateG_Private(Mat X, Vec w, Mat *G)
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

/* G_hh and its factors. */
static PetscErrorCode Factor_Private(Apart *apart)
{
  Mat G;

  PetscFunctionBeginUser;
  PetscCall(CreateG_Private(apart->X, apart->w, &G));
  PetscCall(MatCreateVecs(G, &apart->force, &apart->gap));
  PetscCall(PCCreate(PetscObjectComm((PetscObject)G), &apart->factor));
  PetscCall(PCSetOptionsPrefix(apart->factor, "apart_"));
  PetscCall(PCSetOperators(apart->factor, G, G));
  PetscCall(EverywhereSetPC(apart->factor));
  PetscCall(PCSetUp(apart->factor));
  PetscCall(MatDestroy(&G));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ApartHold(Mat inverse, PetscInt num, const PetscInt held[])
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)inverse);
  Apart         *apart;
  IS             rows, columns;
  PetscInt       begin, n, count = 0, total, *list;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(inverse, &apart));
  PetscCall(Release_Private(apart));
  PetscCall(PetscMalloc1(num, &apart->held));
  PetscCall(PetscArraycpy(apart->held, held, num));
  apart->num = num;
  PetscCall(MatGetOwnershipRange(apart->inverse, &begin, NULL));
  PetscCall(MatGetLocalSize(apart->inverse, &n, NULL));
  PetscCall(PetscMalloc1(num, &list));
  for (PetscInt i = 0; i < num; i++)
    if (!apart->alone[held[i]]) list[count++] = begin + held[i];
  PetscCall(PetscSortRemoveDupsInt(&count, list));
  PetscCallMPI(MPI_Allreduce(&count, &total, 1, MPIU_INT, MPI_SUM, comm));
  PetscCall(ISCreateGeneral(comm, count, list, PETSC_OWN_POINTER, &rows));
  if (total > 0) {
    PetscCall(ISCreateStride(comm, n, begin, 1, &columns));
    PetscCall(MatCreateSubMatrix(apart->inverse, rows, columns, MAT_INITIAL_MATRIX, &apart->X));
    PetscCall(ISDestroy(&columns));
    PetscCall(Factor_Private(apart));
  }
  PetscCall(ISDestroy(&rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}
