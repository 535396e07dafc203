/* nodelevels.c -- levels of nodes, where there is no coarser mesh.

   They are made from the stiffness K of the bodies alone, in displacements u, where bodies do not couple. So
   they do not depend on the active set. With P_0 from displacements of coarse nodes to u,

       P = T^-1 P_0,   P'A P = P_0'K P_0,

   as on levels of a mesh. Unknowns fixed by supports, ties or contact are truncated afterwards (mglevel.c),
   except for displacements that are fixed along axes from the start. */
#include "base/compat.h"
#include "multigrid/nodelevels.h"
#include "multigrid/truncationupdate.h"

PetscErrorCode NodeLevelsBegin(const Operator *op, NodeTable *table, NodeSet *nodes)
{
  PetscInt n;

  PetscFunctionBeginUser;
  *nodes = (NodeSet){.dim = op->dim, .count = table->count, .from = table->from, .weight = table->weight};
  *table = (NodeTable){.count = NULL};
  PetscCall(MatConvert(op->K, MATAIJ, MAT_INITIAL_MATRIX, &nodes->A));
  PetscCall(MatGetLocalSize(op->K, &n, NULL));
  PetscCall(PetscMalloc1(n, &nodes->x));
  PetscCall(PetscArraycpy(nodes->x, op->coords, n));
  PetscCall(PetscCalloc1(n, &nodes->fixed));
  PetscCall(OperatorMarkFixedDisplacements(op, nodes->fixed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* sum := sum + own. [in] own - of this rank's entries */
static PetscErrorCode NodeLevelsAddOwn_Private(Vec sum, const PetscScalar own[])
{
  PetscScalar *s;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(sum, &n));
  PetscCall(VecGetArray(sum, &s));
  for (PetscInt i = 0; i < n; i++) s[i] += own[i];
  PetscCall(VecRestoreArray(sum, &s));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodeLevelsSumSquares(Mat P, Vec open, Vec *weight)
{
  const PetscScalar *o = NULL;
  PetscInt           begin, end, first, last;
  PetscScalar       *own;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(P, weight, NULL));
  PetscCall(MatGetOwnershipRange(P, &begin, &end));
  PetscCall(MatGetOwnershipRangeColumn(P, &first, &last));
  PetscCall(PetscCalloc1(last - first, &own));
  if (open) PetscCall(VecGetArrayRead(open, &o));
  for (PetscInt row = begin; row < end; row++) {
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;

    if (o && o[row - begin] == 0) continue;
    PetscCall(MatGetRow(P, row, &num, &columns, &values));
    for (PetscInt j = 0; j < num; j++) {
      const PetscScalar square = values[j] * values[j];

      if (columns[j] >= first && columns[j] < last)
        own[columns[j] - first] += square;
      else
        PetscCall(VecSetValue(*weight, columns[j], square, ADD_VALUES));
    }
    PetscCall(MatRestoreRow(P, row, &num, &columns, &values));
  }
  if (open) PetscCall(VecRestoreArrayRead(open, &o));
  PetscCall(VecAssemblyBegin(*weight));
  PetscCall(VecAssemblyEnd(*weight));
  PetscCall(NodeLevelsAddOwn_Private(*weight, own));
  PetscCall(PetscFree(own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Drops coarse unknowns whose prolongation is zero or mostly fixed. [in] P - before truncation; [in] open - 0
   where fixed; [in,out] fixed; [out] keep - 1 for the others */
static PetscErrorCode NodeLevelsDrop_Private(Mat P, Vec open, PetscBool fixed[], Vec *keep)
{
  const PetscScalar *w, *left;
  PetscScalar       *k;
  PetscInt           n;
  Vec                weight[2];

  PetscFunctionBeginUser;
  PetscCall(NodeLevelsSumSquares(P, NULL, &weight[0]));
  PetscCall(NodeLevelsSumSquares(P, open, &weight[1]));
  PetscCall(VecDuplicate(weight[0], keep));
  PetscCall(VecGetLocalSize(*keep, &n));
  PetscCall(VecGetArrayRead(weight[0], &w));
  PetscCall(VecGetArrayRead(weight[1], &left));
  PetscCall(VecGetArrayWrite(*keep, &k));
  for (PetscInt i = 0; i < n; i++) {
    fixed[i] = (PetscBool)(fixed[i] || PetscRealPart(left[i]) <= OPERATOR_MIN_FREE * PetscRealPart(w[i]));
    k[i]     = fixed[i] ? 0 : 1;
  }
  PetscCall(VecRestoreArrayWrite(*keep, &k));
  PetscCall(VecRestoreArrayRead(weight[1], &left));
  PetscCall(VecRestoreArrayRead(weight[0], &w));
  PetscCall(VecDestroy(&weight[0]));
  PetscCall(VecDestroy(&weight[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* P := T^-1 P, emptied where unknowns are fixed, and the change of P'A P. [in] was_held - displacements that
   P was empty for; [in,out] fixed - coarse unknowns; [in,out] P, Ac */
static PetscErrorCode NodeLevelsTruncate_Private(const Operator *op, const PetscBool was_held[], PetscBool fixed[],
                                                 Mat *P, Mat Ac)
{
  Mat          product;
  Vec          was, is, keep;
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(BasisRowsMultiply(&op->inverse, NULL, P));
  PetscCall(OperatorCreateFree(op, &is));
  PetscCall(NodeLevelsDrop_Private(*P, is, fixed, &keep));
  PetscCall(MatDiagonalScale(*P, NULL, keep));
  PetscCall(MatDiagonalScale(Ac, keep, keep));
  PetscCall(VecDuplicate(is, &was));
  PetscCall(VecGetLocalSize(was, &n));
  PetscCall(VecGetArrayWrite(was, &a));
  for (PetscInt i = 0; i < n; i++) a[i] = was_held[i] ? 0 : 1;
  PetscCall(VecRestoreArrayWrite(was, &a));
  PetscCall(TruncationUpdateRestrict(op, &(TruncationChange){.was = was, .is = is}, *P, &product));
  PetscCall(MatAXPY(Ac, 1, product, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDiagonalScale(*P, is, NULL));
  PetscCall(MatDestroy(&product));
  PetscCall(VecDestroy(&was));
  PetscCall(VecDestroy(&is));
  PetscCall(VecDestroy(&keep));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the diagonal of dropped unknowns to 1. */
static PetscErrorCode NodeLevelsSetIdle_Private(Mat A, PetscInt num, const PetscInt idle[])
{
  PetscInt begin;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(A, &begin, NULL));
  for (PetscInt i = 0; i < num; i++) PetscCall(MatSetValue(A, begin + idle[i], begin + idle[i], 1, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodeLevelsCoarsen(const Operator *fine, NodeSet *nodes, Mat *P, Operator *coarse)
{
  NodeSet  next;
  Mat      Ac;
  PetscInt n, num = 0, *idle;

  PetscFunctionBeginUser;
  PetscCall(NodeCoarseningApply(nodes, P, &next));
  PetscCall(MatPtAP(nodes->A, *P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &Ac));
  PetscCall(MatProductClear(Ac)); // it would keep its factors
  PetscCall(MatScale(Ac, 1 / fine->stiffness));
  if (fine->coords) PetscCall(NodeLevelsTruncate_Private(fine, nodes->fixed, next.fixed, P, Ac));
  PetscCall(MatGetLocalSize(Ac, &n, NULL));
  PetscCall(PetscMalloc1(n, &idle));
  for (PetscInt i = 0; i < n; i++)
    if (next.fixed[i]) idle[num++] = i;
  PetscCall(NodeLevelsSetIdle_Private(Ac, num, idle));
  PetscCall(OperatorCreateOfMatrix(Ac, num, idle, coarse));
  PetscCall(MatDestroy(&Ac));
  PetscCall(NodeCoarseningDestroy(nodes));
  *nodes   = next;
  nodes->A = coarse->K;
  PetscCall(PetscObjectReference((PetscObject)nodes->A));
  PetscFunctionReturn(PETSC_SUCCESS);
}
