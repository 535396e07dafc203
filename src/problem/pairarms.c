/* pairarms.c -- contributions of ties' arms to rows of B and E. */
#include "base/compat.h"
#include "problem/pairarms.h"

PetscErrorCode PairArmsMark(Mat arm, PetscInt dim, PetscInt node, Vec marks)
{
  PetscInt        num;
  const PetscInt *columns;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; arm && i < dim; i++) {
    PetscCall(MatGetRow(arm, dim * node + i, &num, &columns, NULL));
    for (PetscInt c = 0; c < num; c++) PetscCall(VecSetValue(marks, columns[c] / dim, 1, INSERT_VALUES));
    PetscCall(MatRestoreRow(arm, dim * node + i, &num, &columns, NULL));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairArmsCount(Mat arm, PetscInt dim, PetscInt node, PetscInt *num)
{
  PetscInt        n, *nodes = NULL;
  const PetscInt *columns;

  PetscFunctionBeginUser;
  *num = 0;
  for (PetscInt i = 0; arm && i < dim; i++) {
    PetscCall(MatGetRow(arm, dim * node + i, &n, &columns, NULL));
    PetscCall(PetscRealloc(sizeof(PetscInt) * (*num + n), &nodes));
    for (PetscInt k = 0; k < n; k++) nodes[*num + k] = columns[k] / dim;
    *num += n;
    PetscCall(MatRestoreRow(arm, dim * node + i, &n, &columns, NULL));
  }
  if (*num) PetscCall(PetscSortRemoveDupsInt(num, nodes));
  PetscCall(PetscFree(nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds combinations of a node's rows of an arm to rows of A.
   [in] weight - of the node's rows in row first + l [num][dim] */
static PetscErrorCode PairArmsAddRows_Private(PetscInt dim, Mat arm, PetscInt node, PetscInt num,
                                              const PetscReal weight[], PetscInt first, Mat A)
{
  PetscFunctionBeginUser;
  for (PetscInt j = 0; j < dim; j++) {
    PetscInt           num_columns;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(arm, dim * node + j, &num_columns, &columns, &values));
    for (PetscInt k = 0; k < num_columns; k++) {
      for (PetscInt l = 0; l < num; l++)
        PetscCall(MatSetValue(A, first + l, columns[k], weight[l * dim + j] * values[k], ADD_VALUES));
    }
    PetscCall(MatRestoreRow(arm, dim * node + j, &num_columns, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairArmsAddToB(VI vi, const NodeBases *bases, PetscInt r, PetscInt row)
{
  const Pair     pair = vi->pairs[vi->row_pair[r]];
  const PetscInt dim = vi->level->dim, i = vi->row_dof[r] % dim, node = pair->nodes[vi->row_node[r]];
  PetscReal      weight[3];

  PetscFunctionBeginUser;
  if (!pair->arm) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt j = 0; j < dim; j++)
    weight[j] = -vi->scene->thickness * bases->F[(bases->of_node[node] * dim + i) * dim + j];
  PetscCall(PairArmsAddRows_Private(dim, pair->arm, vi->level->node_begin + node, 1, weight, row, vi->B));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairArmsAddToE(VI vi, const NodeBases *bases, Mat arm, PetscInt r, PetscInt row, Mat E)
{
  const Pair     pair = vi->pairs[vi->row_pair[r]];
  const PetscInt dim = vi->level->dim, k = vi->row_node[r], i = vi->row_dof[r] % dim,
                 s = bases->of_node[pair->nodes[k]], node = vi->level->node_begin + pair->nodes[k];
  const PetscReal *F = &bases->F[s * dim * dim], *Finv = &bases->Finv[s * dim * dim];
  PetscReal        weight[9];

  PetscFunctionBeginUser;
  if (!arm) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt l = 0; l < dim; l++)
    for (PetscInt j = 0; j < dim; j++) weight[l * dim + j] = Finv[l * dim + i] * F[i * dim + j] / pair->D[k];
  PetscCall(PairArmsAddRows_Private(dim, arm, node, dim, weight, row, E));
  PetscFunctionReturn(PETSC_SUCCESS);
}
