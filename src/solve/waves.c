/* waves.c -- see the header.

   Between quadrilaterals or hexahedra, u_i = (-1)^i w(x_i) has no mean change of volume in a cell if w is
   constant: sums over opposite facets vanish one by one. With w that varies slowly there is little of it, but
   within a few cells u cannot end without much. So patches cannot reduce such errors. Here w are shape
   functions of a mesh of cells eight times as wide.

   Displacements normal to contact, and all to tied sides, stay zero. They move the other side, whose nodes
   are not those of this one: the sign would not alternate there. Zero on a single layer of nodes they change
   volumes little, unlike those along the side. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "solve/waves.h"

/* Levels from w to u. */
enum { WAVE_LEVELS = 3 };
/* A direction in which a node moves other sides, against the strongest one. */
static const PetscReal MOVES_FROM = 0.1;

/* The sign of a node is that of its place in a coarser cell: 1 at a vertex, -1 in the middle of an edge, 1 of
   a face, -1 of a cell. These are interpolated from 1, 2, 4, 8 nodes. [out] sign - 0 at nodes that are not
   tight */
static PetscErrorCode WavesSetSigns_Private(const Operator *op, Level *level, Mat P, Vec sign)
{
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayWrite(sign, &a));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    PetscInt  num;
    PetscReal own;

    PetscCall(MatGetRow(P, level->node_begin + i, &num, NULL, NULL));
    own = num == 2 || num == 8 ? -1 : 1;
    PetscCall(MatRestoreRow(P, level->node_begin + i, &num, NULL, NULL));
    for (PetscInt k = 0; k < op->dim; k++) a[op->dim * i + k] = op->tight[i] ? own : 0;
  }
  PetscCall(VecRestoreArrayWrite(sign, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums of V'V over the blocks V of T in columns of a node and rows of others: the sum of squares of n n'
   where it moves other sides along n. [out] moves - [dim][dim] at each node, owned by the caller */
static PetscErrorCode WavesSumMoves_Private(Mat T, Level *level, Vec *moves)
{
  const PetscInt dim = level->dim;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, dim * dim, moves));
  PetscCall(VecZeroEntries(*moves));
  for (PetscInt i = 0; i < dim * level->num_owned; i++) {
    const PetscInt     row = dim * level->node_begin + i;
    PetscInt           num;
    const PetscInt    *column;
    const PetscScalar *value;

    PetscCall(MatGetRow(T, row, &num, &column, &value));
    for (PetscInt j = 0; j < num; j++) {
      if (column[j] / dim == row / dim) continue;
      for (PetscInt k = 0; k < num; k++)
        if (column[k] / dim == column[j] / dim)
          PetscCall(VecSetValue(*moves, dim * column[j] + column[k] % dim, value[j] * value[k], ADD_VALUES));
    }
    PetscCall(MatRestoreRow(T, row, &num, &column, &value));
  }
  PetscCall(VecAssemblyBegin(*moves));
  PetscCall(VecAssemblyEnd(*moves));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The matrix that takes from displacements their part along which nodes move other sides. [out] still - AIJ,
   owned by the caller */
static PetscErrorCode WavesCreateStill_Private(const Operator *op, Level *level, Mat *still)
{
  const PetscInt     dim = op->dim, n = dim * level->num_owned;
  const PetscScalar *a;
  Vec                moves;

  PetscFunctionBeginUser;
  PetscCall(WavesSumMoves_Private(op->T, level, &moves));
  PetscCall(VecGetArrayRead(moves, &a));
  PetscCall(MatCreateAIJ(level->comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, dim, NULL, 0, NULL, still));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    PetscReal A[3 * 3], V[3 * 3], values[3];
    PetscInt  row[3];

    for (PetscInt k = 0; k < dim * dim; k++) A[k] = PetscRealPart(a[dim * dim * i + k]);
    DenseEigen(dim, A, values, V);
    for (PetscInt k = 0; k < dim; k++) row[k] = dim * (level->node_begin + i) + k;
    for (PetscInt k = 0; k < dim * dim; k++) A[k] = k % (dim + 1) ? 0 : 1;
    for (PetscInt d = 0; d < dim; d++) {
      if (values[d] <= PetscSqr(MOVES_FROM) * PetscMax(values[0], values[dim - 1])) continue;
      for (PetscInt k = 0; k < dim * dim; k++) A[k] -= V[k / dim * dim + d] * V[k % dim * dim + d];
    }
    PetscCall(MatSetValues(*still, dim, row, dim, row, A, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*still, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*still, MAT_FINAL_ASSEMBLY));
  PetscCall(VecRestoreArrayRead(moves, &a));
  PetscCall(VecDestroy(&moves));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* B := A B */
static PetscErrorCode WavesMultiply_Private(Mat A, Mat *B)
{
  Mat product;

  PetscFunctionBeginUser;
  PetscCall(MatMatMult(A, *B, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
  PetscCall(MatProductClear(product)); // it would keep its factors
  PetscCall(MatDestroy(B));
  *B = product;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y of displacements, without unknowns of contact and fixed ones. [in,out] waves */
static PetscErrorCode WavesFinish_Private(const Operator *op, Level *level, Mat *waves)
{
  PetscScalar *a;
  Mat          still;
  Vec          free;

  PetscFunctionBeginUser;
  if (op->T) {
    PetscCall(WavesCreateStill_Private(op, level, &still));
    PetscCall(WavesMultiply_Private(still, waves));
    PetscCall(BasisRowsMultiply(&op->inverse, NULL, waves));
    PetscCall(MatDestroy(&still));
  }
  PetscCall(OperatorCreateFree(op, &free));
  PetscCall(VecGetArray(free, &a));
  for (PetscInt i = 0; i < op->num_constrained; i++) a[op->constrained[i]] = 0;
  PetscCall(VecRestoreArray(free, &a));
  PetscCall(MatDiagonalScale(*waves, free, NULL));
  PetscCall(VecDestroy(&free));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode WavesCreate(const Operator *op, Level *level, const Mat P[], PetscInt l, Mat *waves)
{
  Mat hats = P[PetscMax(l - WAVE_LEVELS, 0) + 1];
  Vec sign;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectReference((PetscObject)hats));
  for (PetscInt k = PetscMax(l - WAVE_LEVELS, 0) + 2; k <= l; k++) PetscCall(WavesMultiply_Private(P[k], &hats));
  PetscCall(LevelCreateBlocks(hats, op->dim, waves));
  PetscCall(MatCreateVecs(*waves, NULL, &sign));
  PetscCall(WavesSetSigns_Private(op, level, P[l], sign));
  PetscCall(MatDiagonalScale(*waves, sign, NULL));
  PetscCall(WavesFinish_Private(op, level, waves));
  PetscCall(VecDestroy(&sign));
  PetscCall(MatDestroy(&hats));
  PetscFunctionReturn(PETSC_SUCCESS);
}
