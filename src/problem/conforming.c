/* conforming.c -- the stiffness where nodes hang.

   Unknowns, supports and pairs stay as they are. Hanging nodes keep their unknowns, and springs with the
   stiffness of their edge hold them. So K stays definite, and its condition stays that of the mesh. */
#include "problem/conforming.h"
#include "base/compat.h"
#include "level/ghosted.h"

enum { MOST = 10 }; /* a hanging node, and those of the quad9 that it hangs on */

/* Mean diagonals of all nodes. Collective. [out] diagonal - ghosted, owned by the caller */
static PetscErrorCode ConformingSumDiagonal_Private(Level *level, const PetscInt global[], const SymmetricBlocks *sums,
                                                    Vec *diagonal)
{
  const PetscInt bs = sums->bs;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, diagonal));
  for (PetscInt i = 0; i < sums->num; i++) {
    const PetscScalar *block = SymmetricBlocksAt(sums, i, i);
    PetscScalar        mean  = 0;

    for (PetscInt k = 0; k < bs; k++) mean += block[k * bs + k] / (PetscReal)bs;
    PetscCall(VecSetValue(*diagonal, global[i], mean, ADD_VALUES));
  }
  PetscCall(VecAssemblyBegin(*diagonal));
  PetscCall(VecAssemblyEnd(*diagonal));
  PetscCall(LevelShareVec(*diagonal, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Holds one node. A spring has the stiffness of the node's edge: the weighted geometric mean of the mean
   diagonals there. Weights may be negative, and nodes may differ by orders of magnitude.
   [in] diagonal - at local nodes */
static void ConformingHoldNode_Private(const Level *level, PetscInt node, const PetscScalar diagonal[],
                                       SymmetricBlocks *sums)
{
  const PetscInt  bs = sums->bs, begin = level->hanging.start[node], num = level->hanging.start[node + 1] - begin + 1;
  const PetscInt *edge         = &level->hanging.node[begin];
  PetscReal       weight[MOST] = {1}, spring = 0, A[9 * MOST * MOST] = {0};
  PetscInt        nodes[MOST] = {node};

  for (PetscInt i = 1; i < num; i++) {
    nodes[i]  = edge[i - 1];
    weight[i] = -level->hanging.weight[begin + i - 1];
    spring -= weight[i] * PetscLogReal(PetscRealPart(diagonal[nodes[i]]));
  }
  for (PetscInt i = 0; i < num * num; i++)
    for (PetscInt k = 0; k < bs; k++)
      A[((i / num * bs + k) * num + i % num) * bs + k] = PetscExpReal(spring) * weight[i / num] * weight[i % num];
  CellSumsAddNodes(num, nodes, A, sums);
}

/* [in] diagonal - mean diagonals of nodes, ghosted */
static PetscErrorCode ConformingHoldNodes_Private(const Level *level, Vec diagonal, SymmetricBlocks *sums)
{
  const PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(diagonal, &a));
  for (PetscInt i = 0; i < level->num_owned; i++)
    if (LevelNodeHangs(level, i)) ConformingHoldNode_Private(level, i, a, sums);
  PetscCall(GhostedRestoreArrayRead(diagonal, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ConformingHold(Level *level, const PetscInt global[], SymmetricBlocks *sums)
{
  Vec diagonal;

  PetscFunctionBeginUser;
  if (!level->conforming) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ConformingSumDiagonal_Private(level, global, sums, &diagonal));
  PetscCall(ConformingHoldNodes_Private(level, diagonal, sums));
  PetscCall(VecDestroy(&diagonal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ConformingHoldMatrix(Level *level, Mat *K)
{
  SymmetricBlocks sums;
  Mat             shell, springs;
  PetscInt        bs;
  Vec             all, part, diagonal;

  PetscFunctionBeginUser;
  if (!level->conforming) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatGetBlockSize(*K, &bs));
  PetscCall(LevelCreateVec(level, bs, &all));
  PetscCall(LevelCreateVec(level, 1, &part));
  PetscCall(LevelCreateVec(level, 1, &diagonal));
  PetscCall(MatGetDiagonal(*K, all));
  for (PetscInt k = 0; k < bs; k++) {
    PetscCall(VecStrideGather(all, k, part, INSERT_VALUES));
    PetscCall(VecAXPY(diagonal, 1 / (PetscReal)bs, part));
  }
  PetscCall(LevelShareVec(diagonal, INSERT_VALUES));
  PetscCall(CellSumsCreate(level, &sums));
  PetscCall(ConformingHoldNodes_Private(level, diagonal, &sums));
  PetscCall(CellSumsFinish(level, level->node_global, &sums, &shell));
  PetscCall(MatConvert(shell, MATAIJ, MAT_INITIAL_MATRIX, &springs));
  PetscCall(MatAXPY(springs, 1, *K, SUBSET_NONZERO_PATTERN));
  PetscCall(MatDestroy(&shell));
  PetscCall(MatDestroy(K));
  *K = springs;
  PetscCall(VecDestroy(&all));
  PetscCall(VecDestroy(&part));
  PetscCall(VecDestroy(&diagonal));
  PetscFunctionReturn(PETSC_SUCCESS);
}
