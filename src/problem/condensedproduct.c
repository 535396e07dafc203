/* condensedproduct.c -- see the header. */
#include "problem/condensedproduct.h"
#include "base/compat.h"
#include "problem/basischange.h"
#include "problem/stiffness.h"

typedef struct {
  Mat S;
  Mat few[BASIS_FACTORS];  /* rows of the factors */
  IS  rows[BASIS_FACTORS]; /* their numbers */
  Vec w[BASIS_FACTORS];    /* at these rows */
  Vec Tx;
} CondensedProduct;

/* x <- (1 + E) x */
static PetscErrorCode CondensedProductAdd_Private(const CondensedProduct *p, int factor, Vec x)
{
  const Vec          w = p->w[factor];
  const PetscInt    *row;
  const PetscScalar *add;
  PetscScalar       *a;
  PetscInt           num;

  PetscFunctionBeginUser;
  PetscCall(MatMult(p->few[factor], x, w));
  PetscCall(ISGetLocalSize(p->rows[factor], &num));
  PetscCall(ISGetIndices(p->rows[factor], &row));
  PetscCall(VecGetArrayRead(w, &add));
  PetscCall(VecGetArray(x, &a));
  for (PetscInt i = 0; i < num; i++) a[row[i]] += add[i];
  PetscCall(VecRestoreArray(x, &a));
  PetscCall(VecRestoreArrayRead(w, &add));
  PetscCall(ISRestoreIndices(p->rows[factor], &row));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y <- (1 + E)'y */
static PetscErrorCode CondensedProductAddTranspose_Private(const CondensedProduct *p, int factor, Vec y)
{
  const Vec          w = p->w[factor];
  const PetscInt    *row;
  const PetscScalar *a;
  PetscScalar       *from;
  PetscInt           num;

  PetscFunctionBeginUser;
  PetscCall(ISGetLocalSize(p->rows[factor], &num));
  PetscCall(ISGetIndices(p->rows[factor], &row));
  PetscCall(VecGetArrayRead(y, &a));
  PetscCall(VecGetArray(w, &from));
  for (PetscInt i = 0; i < num; i++) from[i] = a[row[i]];
  PetscCall(VecRestoreArray(w, &from));
  PetscCall(VecRestoreArrayRead(y, &a));
  PetscCall(ISRestoreIndices(p->rows[factor], &row));
  PetscCall(MatMultTransposeAdd(p->few[factor], w, y, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Mult_CondensedProduct(Mat P, Vec x, Vec y)
{
  CondensedProduct *p;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(P, &p));
  PetscCall(VecCopy(x, p->Tx));
  for (int f = BASIS_FACTORS - 1; f >= 0; f--) PetscCall(CondensedProductAdd_Private(p, f, p->Tx));
  PetscCall(MatMult(p->S, p->Tx, y));
  for (int f = 0; f < BASIS_FACTORS; f++) PetscCall(CondensedProductAddTranspose_Private(p, f, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_CondensedProduct(Mat P)
{
  CondensedProduct *p;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(P, &p));
  PetscCall(MatDestroy(&p->S));
  for (int f = 0; f < BASIS_FACTORS; f++) {
    PetscCall(MatDestroy(&p->few[f]));
    PetscCall(ISDestroy(&p->rows[f]));
    PetscCall(VecDestroy(&p->w[f]));
  }
  PetscCall(VecDestroy(&p->Tx));
  PetscCall(PetscFree(p));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CondensedProductCreate(Mat S, VI vi, Mat *P)
{
  CondensedProduct *p;
  PetscInt          n;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectReference((PetscObject)S));
  *P = S;
  if (!vi->T) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscNew(&p));
  p->S = S;
  for (int f = 0; f < BASIS_FACTORS; f++) {
    p->few[f]  = vi->basis->change.factor[f].few;
    p->rows[f] = vi->basis->change.factor[f].rows;
    PetscCall(PetscObjectReference((PetscObject)p->few[f]));
    PetscCall(PetscObjectReference((PetscObject)p->rows[f]));
    PetscCall(MatCreateVecs(p->few[f], NULL, &p->w[f]));
  }
  PetscCall(MatCreateVecs(vi->T, &p->Tx, NULL));
  PetscCall(VecGetLocalSize(p->Tx, &n));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)S), n, n, PETSC_DETERMINE, PETSC_DETERMINE, p, P));
  PetscCall(MatShellSetOperation(*P, MATOP_MULT, (void (*)(void))Mult_CondensedProduct));
  PetscCall(MatShellSetOperation(*P, MATOP_DESTROY, (void (*)(void))Destroy_CondensedProduct));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the entries of one process to their absolute values. */
static PetscErrorCode MatSetAbsolute_Private(Mat A)
{
  PetscScalar *a;
  PetscInt     num;
  MatInfo      info;

  PetscFunctionBeginUser;
  PetscCall(MatGetInfo(A, MAT_LOCAL, &info));
  num = (PetscInt)info.nz_used;
  PetscCall(MatSeqAIJGetArray(A, &a));
  for (PetscInt i = 0; i < num; i++) a[i] = PetscAbsScalar(a[i]);
  PetscCall(MatSeqAIJRestoreArray(A, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds to a region what the unknowns in it move by a factor. [in,out] region - not 0 at unknowns in it */
static PetscErrorCode CondensedProductReach_Private(const CondensedProduct *p, int factor, Vec region)
{
  CondensedProduct absolute = *p;
  Mat              own, others;
  PetscBool        alone;

  PetscFunctionBeginUser;
  PetscCall(MatDuplicate(p->few[factor], MAT_COPY_VALUES, &absolute.few[factor]));
  PetscCall(PetscObjectTypeCompare((PetscObject)absolute.few[factor], MATSEQAIJ, &alone));
  if (alone) {
    PetscCall(MatSetAbsolute_Private(absolute.few[factor]));
  } else {
    PetscCall(MatMPIAIJGetSeqAIJ(absolute.few[factor], &own, &others, NULL));
    PetscCall(MatSetAbsolute_Private(own));
    PetscCall(MatSetAbsolute_Private(others));
  }
  PetscCall(CondensedProductAdd_Private(&absolute, factor, region));
  PetscCall(MatDestroy(&absolute.few[factor]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Extends a region to whole nodes. */
static PetscErrorCode RegionFillNodes_Private(PetscInt bs, Vec region)
{
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(region, &n));
  PetscCall(VecGetArray(region, &a));
  for (PetscInt node = 0; node < n; node += bs) {
    PetscReal any = 0;

    for (PetscInt k = 0; k < bs; k++) any = PetscMax(any, PetscAbsScalar(a[node + k]));
    for (PetscInt k = 0; k < bs; k++) a[node + k] = any > 0 ? 1 : 0;
  }
  PetscCall(VecRestoreArray(region, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* S is needed where T takes the region, and T' takes from the same unknowns. */
PetscErrorCode CondensedProductRestrict(Mat P, Vec region, PetscReal *part)
{
  CondensedProduct *p;
  PetscInt          bs;
  Vec               reached;
  void (*mult)(void);

  PetscFunctionBeginUser;
  PetscCall(MatShellGetOperation(P, MATOP_MULT, &mult));
  if (mult != (void (*)(void))Mult_CondensedProduct) {
    PetscCall(StiffnessRestrict(P, region, part));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MatShellGetContext(P, &p));
  if (!region) {
    PetscCall(StiffnessRestrict(p->S, NULL, part));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MatGetBlockSize(p->S, &bs));
  PetscCall(VecDuplicate(region, &reached));
  PetscCall(VecCopy(region, reached));
  for (int f = BASIS_FACTORS - 1; f >= 0; f--) PetscCall(CondensedProductReach_Private(p, f, reached));
  PetscCall(RegionFillNodes_Private(bs, reached));
  PetscCall(StiffnessRestrict(p->S, reached, part));
  PetscCall(VecDestroy(&reached));
  PetscFunctionReturn(PETSC_SUCCESS);
}
