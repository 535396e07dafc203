/* conforming.c -- the stiffness where nodes hang.

   Unknowns, supports and pairs stay as they are. Hanging nodes keep their unknowns, and springs with the
   stiffness of their edge hold them. So K stays definite, and its condition stays that of the mesh. */
#include "problem/conforming.h"
#include "base/compat.h"
#include "problem/stiffness.h"

/* The stiffness of each node's edge: the weighted geometric mean over its nodes of their mean diagonals.
   Weights may be negative, and nodes may differ by orders of magnitude. [out] springs - [nodes] */
static PetscErrorCode ConformingGetSprings_Private(Level *level, Mat K, Vec *springs)
{
  const PetscInt     dim = level->dim;
  const PetscScalar *d;
  PetscScalar       *a;
  Vec                diagonal;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(K, &diagonal, NULL));
  PetscCall(MatGetDiagonal(K, diagonal));
  PetscCall(LevelCreateVec(level, 1, springs));
  PetscCall(VecGetArrayRead(diagonal, &d));
  PetscCall(VecGetArray(*springs, &a));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    PetscReal mean = 0;

    for (PetscInt k = 0; k < dim; k++) mean += PetscRealPart(d[i * dim + k]) / (PetscReal)dim;
    a[i] = mean > 0 ? PetscLogReal(mean) : 0; // zero at hanging nodes, on which no node hangs
  }
  PetscCall(VecRestoreArray(*springs, &a));
  PetscCall(VecRestoreArrayRead(diagonal, &d));
  PetscCall(LevelConform(level, 1, *springs));
  PetscCall(VecExp(*springs));
  PetscCall(VecDestroy(&diagonal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Blocks on the diagonal at hanging nodes. [in] S - Level.conforming; [out] D - owned by the caller */
static PetscErrorCode ConformingCreateDiagonal_Private(Level *level, Vec springs, Mat *D)
{
  const PetscInt     dim = level->dim, n = dim * level->num_owned;
  const PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(level->comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, dim, NULL, 0, NULL, D));
  PetscCall(MatSetBlockSize(*D, dim));
  PetscCall(VecGetArrayRead(springs, &a));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    const PetscInt  node     = level->node_begin + i;
    PetscScalar     block[9] = {0};
    PetscInt        num;
    const PetscInt *columns;

    PetscCall(MatGetRow(level->conforming, node, &num, &columns, NULL));
    for (PetscInt k = 0; k < dim; k++) block[k * dim + k] = a[i];
    if (num > 1 || columns[0] != node)
      PetscCall(MatSetValuesBlocked(*D, 1, &node, 1, &node, block, INSERT_VALUES)); // zeros keep blocks full
    PetscCall(MatRestoreRow(level->conforming, node, &num, &columns, NULL));
  }
  PetscCall(VecRestoreArrayRead(springs, &a));
  PetscCall(MatAssemblyBegin(*D, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*D, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The distance of hanging nodes from their edge, (1 - S) u. [out] N - owned by the caller */
static PetscErrorCode ConformingCreateDistance_Private(Level *level, Mat *N)
{
  const PetscInt n = level->num_owned;
  Mat            one;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(level->comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 0, NULL, &one));
  for (PetscInt i = level->node_begin; i < level->node_begin + n; i++)
    PetscCall(MatSetValue(one, i, i, 1, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(one, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(one, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAXPY(one, -1, level->conforming, DIFFERENT_NONZERO_PATTERN));
  PetscCall(LevelCreateBlocks(one, level->dim, N));
  PetscCall(MatDestroy(&one));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* K += (1 - S)' D (1 - S) */
PetscErrorCode ConformingHold(Level *level, Mat K)
{
  Mat N, D, springs;
  Vec stiffness;

  PetscFunctionBeginUser;
  if (!level->conforming) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ConformingGetSprings_Private(level, K, &stiffness));
  PetscCall(ConformingCreateDiagonal_Private(level, stiffness, &D));
  PetscCall(ConformingCreateDistance_Private(level, &N));
  PetscCall(MatPtAP(D, N, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &springs));
  PetscCall(MatAXPY(K, 1, springs, DIFFERENT_NONZERO_PATTERN));
  PetscCall(VecDestroy(&stiffness));
  PetscCall(MatDestroy(&springs));
  PetscCall(MatDestroy(&N));
  PetscCall(MatDestroy(&D));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ConformingCreate(Level *level, Mat *K)
{
  Mat S, cells, whole;

  PetscFunctionBeginUser;
  if (!level->conforming) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelCreateBlocks(level->conforming, level->dim, &S));
  PetscCall(MatConvert(*K, MATAIJ, MAT_INITIAL_MATRIX, &cells));
  PetscCall(MatDestroy(K));
  PetscCall(MatPtAP(cells, S, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &whole));
  PetscCall(MatProductClear(whole)); // it would keep its factors
  PetscCall(MatDestroy(&cells));
  PetscCall(MatDestroy(&S));
  PetscCall(ConformingHold(level, whole));
  PetscCall(StiffnessCreateOfMatrix(whole, K));
  PetscCall(MatDestroy(&whole));
  PetscFunctionReturn(PETSC_SUCCESS);
}
