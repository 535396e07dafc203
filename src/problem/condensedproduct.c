/* condensedproduct.c -- see the header. */
#include "problem/condensedproduct.h"
#include "base/compat.h"
#include "problem/basisghosts.h"
#include "problem/stiffness.h"

typedef struct {
  Mat         S;
  BasisGhosts basis;
} CondensedProduct;

static PetscErrorCode Mult_CondensedProduct(Mat P, Vec x, Vec y)
{
  CondensedProduct  *p;
  const PetscScalar *own, *others;
  PetscScalar       *a;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(P, &p));
  PetscCall(BasisGhostsMult(p->basis, x, &own, &others));
  PetscCall(VecGetArrayWrite(y, &a));
  PetscCall(StiffnessMultLocal(p->S, own, others, a));
  PetscCall(VecRestoreArrayWrite(y, &a));
  PetscCall(BasisGhostsRestore(p->basis, x, &own));
  PetscCall(BasisGhostsMultTranspose(p->basis, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_CondensedProduct(Mat P)
{
  CondensedProduct *p;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(P, &p));
  PetscCall(MatDestroy(&p->S));
  PetscCall(BasisGhostsDestroy(&p->basis));
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
  p->S     = S;
  p->basis = vi->basis->ghosts;
  BasisGhostsReference(p->basis);
  PetscCall(MatGetLocalSize(S, &n, NULL));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)S), n, n, PETSC_DETERMINE, PETSC_DETERMINE, p, P));
  PetscCall(MatShellSetOperation(*P, MATOP_MULT, (void (*)(void))Mult_CondensedProduct));
  PetscCall(MatShellSetOperation(*P, MATOP_DESTROY, (void (*)(void))Destroy_CondensedProduct));
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
  PetscCall(BasisGhostsReach(p->basis, reached));
  PetscCall(RegionFillNodes_Private(bs, reached));
  PetscCall(StiffnessRestrict(p->S, reached, part));
  PetscCall(VecDestroy(&reached));
  PetscFunctionReturn(PETSC_SUCCESS);
}
