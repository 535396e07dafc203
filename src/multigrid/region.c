/* region.c -- see the header.

   Bisection leaves most cells of a mesh as they are. A node whose cells all stay keeps its shape function:
   its row of P has a single entry 1, and so has the column. An error of such functions alone is smoothed on
   coarser levels [1].

   References: [1] Wu, Chen, Uniform convergence of multigrid V-cycle on adaptively refined finite element
   meshes for second order elliptic problems, 2006. */
#include "base/compat.h"
#include "multigrid/region.h"

/* A region with more than this part of the unknowns is no region: it saves less than it costs. */
static const PetscReal NEARLY_ALL = 0.9;

/* Whether a row of P has a single entry 1. */
static PetscErrorCode RegionIsUnit_Private(Mat P, PetscInt row, PetscBool *unit)
{
  PetscInt           num, found = 0;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  *unit = PETSC_TRUE;
  PetscCall(MatGetRow(P, row, &num, NULL, &values));
  for (PetscInt j = 0; j < num; j++) {
    if (values[j] == 0) continue;
    found++;
    if (values[j] != 1) *unit = PETSC_FALSE;
  }
  *unit = (PetscBool)(*unit && found <= 1); // fixed unknowns have none
  PetscCall(MatRestoreRow(P, row, &num, NULL, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks rows of P that are no unit rows, or in a column that is no unit column. [out] region - of unknowns */
static PetscErrorCode RegionMark_Private(Mat P, Vec weight, Vec region)
{
  const PetscScalar *w;
  PetscScalar       *mark;
  PetscInt           begin, n;
  Vec                changed;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(weight, &changed));
  PetscCall(VecGetLocalSize(changed, &n));
  PetscCall(VecGetArrayRead(weight, &w));
  PetscCall(VecGetArrayWrite(changed, &mark));
  for (PetscInt j = 0; j < n; j++) mark[j] = w[j] == 0 || w[j] == 1 ? 0 : 1; // of fixed unknowns it is 0
  PetscCall(VecRestoreArrayWrite(changed, &mark));
  PetscCall(VecRestoreArrayRead(weight, &w));
  PetscCall(MatMult(P, changed, region));
  PetscCall(VecDestroy(&changed));
  PetscCall(MatGetOwnershipRange(P, &begin, NULL));
  PetscCall(VecGetLocalSize(region, &n));
  PetscCall(VecGetArray(region, &mark));
  for (PetscInt i = 0; i < n; i++) {
    PetscBool unit;

    PetscCall(RegionIsUnit_Private(P, begin + i, &unit));
    if (!unit) mark[i] = 1;
  }
  PetscCall(VecRestoreArray(region, &mark));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RegionCreate(Mat P, Vec weight, PetscInt bs, Vec *region)
{
  PetscScalar *mark, sum;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(P, NULL, region));
  PetscCall(RegionMark_Private(P, weight, *region));
  PetscCall(VecGetLocalSize(*region, &n));
  PetscCall(VecGetArray(*region, &mark));
  for (PetscInt i = 0; i < n; i += bs) {
    PetscBool in = PETSC_FALSE;

    for (PetscInt k = 0; k < bs; k++) in = (PetscBool)(in || mark[i + k] != 0);
    for (PetscInt k = 0; k < bs; k++) mark[i + k] = in ? 1 : 0;
  }
  PetscCall(VecRestoreArray(*region, &mark));
  PetscCall(VecSum(*region, &sum));
  PetscCall(VecGetSize(*region, &n));
  if (PetscRealPart(sum) > NEARLY_ALL * n) PetscCall(VecDestroy(region));
  PetscFunctionReturn(PETSC_SUCCESS);
}
