/* kktsystem.c -- the uncondensed KKT system [K B'; B 0], by which the certificate judges. */
#include "base/compat.h"
#include "problem/pairarms.h"
#include "problem/kktsystem.h"

/* Adds coefficient * (row of a node x node matrix) (x) F_i to row of B. */
static PetscErrorCode KKTSystemAddRow_Private(VI vi, Mat C, PetscInt node, PetscReal coefficient, const PetscReal Fi[],
                                              PetscInt row)
{
  const PetscInt     dim = vi->level->dim;
  PetscInt           num;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  PetscCall(MatGetRow(C, node, &num, &columns, &values));
  for (PetscInt c = 0; c < num; c++) {
    for (PetscInt k = 0; k < dim; k++)
      PetscCall(MatSetValue(vi->B, row, dim * columns[c] + k, coefficient * values[c] * Fi[k], ADD_VALUES));
  }
  PetscCall(MatRestoreRow(C, node, &num, &columns, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Number of entries of one row of B. */
static PetscErrorCode KKTSystemCountRow_Private(VI vi, const Couplings *couplings, PetscInt row, PetscInt *nnz)
{
  const Pair     pair = vi->pairs[vi->row_pair[row]];
  const Mat      C    = couplings->record[vi->row_pair[row]];
  const PetscInt node = vi->level->node_begin + pair->nodes[vi->row_node[row]];
  PetscInt       num  = 0;

  PetscFunctionBeginUser;
  if (C) {
    PetscCall(MatGetRow(C, node, &num, NULL, NULL));
    *nnz = vi->level->dim * (1 + num);
    PetscCall(MatRestoreRow(C, node, &num, NULL, NULL));
  } else {
    *nnz = vi->level->dim;
  }
  PetscCall(PairArmsCount(pair->arm, vi->level->dim, node, &num));
  *nnz += vi->level->dim * num;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* An empty B with room for its rows. */
static PetscErrorCode KKTSystemAllocateB_Private(VI vi, const Couplings *couplings)
{
  const PetscInt columns = vi->level->num_owned * vi->level->dim,
                 rest    = vi->level->num_global * vi->level->dim - columns;
  PetscInt *d_nnz, *o_nnz;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(vi->num_rows, &d_nnz, vi->num_rows, &o_nnz));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    PetscInt nnz;
    PetscCall(KKTSystemCountRow_Private(vi, couplings, r, &nnz));
    d_nnz[r] = PetscMin(nnz, columns);
    o_nnz[r] = PetscMin(nnz, rest);
  }
  PetscCall(MatCreateAIJ(vi->level->comm, vi->num_rows, columns, PETSC_DETERMINE, PETSC_DETERMINE, 0, d_nnz, 0, o_nnz,
                         &vi->B));
  PetscCall(PetscFree2(d_nnz, o_nnz));
  PetscCall(MatCreateVecs(vi->B, NULL, &vi->G));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode KKTSystemSetGaps(VI vi)
{
  PetscInt first;

  PetscFunctionBeginUser;
  if (!vi->G) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecGetOwnershipRange(vi->G, &first, NULL));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const Pair pair = vi->pairs[vi->row_pair[r]];
    PetscReal  gap  = 0; // of ties, and of tangents without a slip origin

    if (pair->spec->type != PAIR_TIED) {
      if (!vi->row_direction[r]) gap = pair->gap[vi->row_node[r]];
      if (vi->row_direction[r] && vi->slip_origin) gap = vi->slip_origin[r];
    }
    PetscCall(VecSetValue(vi->G, first + r, vi->row_D[r] * gap, INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(vi->G));
  PetscCall(VecAssemblyEnd(vi->G));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode KKTSystemCreate(VI vi, const NodeBases *bases, const Couplings *couplings)
{
  const PetscInt dim  = vi->level->dim;
  PetscInt       rows = vi->num_rows, first;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &rows, 1, MPIU_INT, MPI_SUM, vi->level->comm));
  if (rows == 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(KKTSystemAllocateB_Private(vi, couplings));
  PetscCall(MatGetOwnershipRange(vi->B, &first, NULL));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const Pair     pair = vi->pairs[vi->row_pair[r]];
    const Mat      C    = couplings->record[vi->row_pair[r]];
    const PetscInt k = vi->row_node[r], node = vi->level->node_begin + pair->nodes[k],
                   s    = bases->of_node[pair->nodes[k]];
    const PetscReal *Fi = &bases->F[(s * dim + vi->row_dof[r] % dim) * dim], thickness = vi->scene->thickness;
    for (PetscInt j = 0; j < dim; j++)
      PetscCall(MatSetValue(vi->B, first + r, dim * node + j, vi->row_D[r] * Fi[j], ADD_VALUES));
    if (C) PetscCall(KKTSystemAddRow_Private(vi, C, node, thickness, Fi, first + r));
    PetscCall(PairArmsAddToB(vi, bases, r, first + r));
  }
  PetscCall(MatAssemblyBegin(vi->B, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(vi->B, MAT_FINAL_ASSEMBLY));
  PetscCall(KKTSystemSetGaps(vi));
  PetscFunctionReturn(PETSC_SUCCESS);
}
