/* couplings.c -- rows of the pairs in the displacements u and in u~ of the quadratic basis transformation. */
#include "base/compat.h"
#include "base/usererror.h"
#include "problem/couplings.h"

/* A := A + a B, where NULL stands for 0. */
static PetscErrorCode CouplingsAddMatrix_Private(Mat *A, PetscReal a, Mat B)
{
  PetscFunctionBeginUser;
  if (!B) PetscFunctionReturn(PETSC_SUCCESS);
  if (*A) {
    PetscCall(MatAXPY(*A, a, B, DIFFERENT_NONZERO_PATTERN));
  } else {
    PetscCall(MatDuplicate(B, MAT_COPY_VALUES, A));
    PetscCall(MatScale(*A, a));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A := A + B C, where NULL stands for 0. */
static PetscErrorCode CouplingsAddProduct_Private(Mat *A, Mat B, Mat C)
{
  Mat BC;

  PetscFunctionBeginUser;
  if (!B || !C) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatMatMult(B, C, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &BC));
  PetscCall(CouplingsAddMatrix_Private(A, 1.0, BC));
  PetscCall(MatDestroy(&BC));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Joins the quadratic basis transformations of all pairs; a facet in several pairs has the same one in each.
   [in] inverse - joins the inverse ones instead;
   [out] shift - owned by the caller, NULL where there is none */
static PetscErrorCode CouplingsUniteTransformations_Private(VI vi, PetscBool inverse, Mat *shift)
{
  const PetscInt n = vi->level->num_owned, begin = vi->level->node_begin;

  PetscFunctionBeginUser;
  *shift = NULL;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const Mat own = inverse ? vi->pairs[p]->from_nodal : vi->pairs[p]->to_nodal;
    if (!own) continue;
    if (!*shift)
      PetscCall(MatCreateAIJ(vi->level->comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, ELEMENT_MAX_FACET_NODES, NULL,
                             ELEMENT_MAX_FACET_NODES, NULL, shift));
    for (PetscInt row = begin; row < begin + n; row++) {
      PetscInt           num;
      const PetscInt    *columns;
      const PetscScalar *values;
      PetscCall(MatGetRow(own, row, &num, &columns, &values));
      if (num) PetscCall(MatSetValues(*shift, 1, &row, num, columns, values, INSERT_VALUES));
      PetscCall(MatRestoreRow(own, row, &num, &columns, &values));
    }
  }
  if (*shift) {
    PetscCall(MatAssemblyBegin(*shift, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(*shift, MAT_FINAL_ASSEMBLY));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The same for all components: entry times the identity. [in] shift - node x node */
static PetscErrorCode CouplingsExpand_Private(VI vi, Mat shift, Mat *expanded)
{
  const PetscInt dim = vi->level->dim, n = dim * vi->level->num_owned, begin = vi->level->node_begin;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(vi->level->comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, ELEMENT_MAX_FACET_NODES, NULL,
                         ELEMENT_MAX_FACET_NODES, NULL, expanded));
  PetscCall(MatSetBlockSize(*expanded, dim));
  for (PetscInt node = begin; node < begin + vi->level->num_owned; node++) {
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscCall(MatGetRow(shift, node, &num, &columns, &values));
    for (PetscInt c = 0; c < num; c++) {
      for (PetscInt k = 0; k < dim; k++)
        PetscCall(MatSetValue(*expanded, dim * node + k, dim * columns[c] + k, values[c], INSERT_VALUES));
    }
    PetscCall(MatRestoreRow(shift, node, &num, &columns, &values));
  }
  PetscCall(MatAssemblyBegin(*expanded, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*expanded, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* record = (D + D_other) S^-1 - D - M. */
static PetscErrorCode CouplingsCreateKKT_Private(const Pair pair, Mat *record)
{
  Mat          moved;
  Vec          D;
  PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(CouplingsAddMatrix_Private(record, -1.0, pair->M));
  PetscCall(CouplingsAddMatrix_Private(record, 1.0, pair->D_other));
  PetscCall(CouplingsAddProduct_Private(record, pair->D_other, pair->from_nodal));
  if (!pair->from_nodal) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatCreateVecs(pair->from_nodal, NULL, &D));
  PetscCall(VecGetArray(D, &value));
  for (PetscInt k = 0; k < pair->num; k++) value[pair->nodes[k]] = pair->D[k];
  PetscCall(VecRestoreArray(D, &value));
  PetscCall(MatDuplicate(pair->from_nodal, MAT_COPY_VALUES, &moved));
  PetscCall(MatDiagonalScale(moved, D, NULL));
  PetscCall(CouplingsAddMatrix_Private(record, 1.0, moved));
  PetscCall(VecDestroy(&D));
  PetscCall(MatDestroy(&moved));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* basis = (D + record) S - D. If the pair's own side is transformed, S^-1 S = I there, and D and D_other stay
   as they are. Else S is the identity at the nodes with multipliers, and D S = D. */
static PetscErrorCode CouplingsCreateBasis_Private(const Pair pair, Mat shift, Mat *basis)
{
  Mat other = NULL;

  PetscFunctionBeginUser;
  PetscCall(CouplingsAddMatrix_Private(&other, -1.0, pair->M));
  if (!pair->to_nodal) PetscCall(CouplingsAddMatrix_Private(&other, 1.0, pair->D_other));
  PetscCall(CouplingsAddMatrix_Private(basis, 1.0, other));
  PetscCall(CouplingsAddProduct_Private(basis, other, shift));
  if (pair->to_nodal) PetscCall(CouplingsAddMatrix_Private(basis, 1.0, pair->D_other));
  PetscCall(MatDestroy(&other));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Number of entries of a row of this rank; 0 where the matrix is NULL. [in] row - global */
static PetscErrorCode CouplingsCountRow_Private(Mat A, PetscInt row, PetscInt *num)
{
  PetscFunctionBeginUser;
  *num = 0;
  if (!A) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatGetRow(A, row, num, NULL, NULL));
  PetscCall(MatRestoreRow(A, row, NULL, NULL, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a node of this rank has a multiplier of one pair and a different transformation by another. The
   number of nodes in its row of the transformation tells these apart: none, the two ends, or the two ends and
   the node. [out] torn */
static PetscErrorCode CouplingsIsInconsistent_Private(const Pair pair, const Pair other, PetscBool *torn)
{
  PetscInt num, num_own;

  PetscFunctionBeginUser;
  *torn = PETSC_FALSE;
  if (!other->to_nodal) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt k = 0; k < pair->num; k++) {
    const PetscInt row = pair->level->node_begin + pair->nodes[k];
    PetscCall(CouplingsCountRow_Private(other->to_nodal, row, &num));
    PetscCall(CouplingsCountRow_Private(pair->to_nodal, row, &num_own));
    *torn = (PetscBool)(*torn || (num > 0 && num != num_own));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* User error: two pairs on one side need different unknowns at the middle of a facet. Collective. */
static PetscErrorCode CouplingsCheckConsistent_Private(VI vi)
{
  const PetscInt none  = vi->num_pairs * vi->num_pairs;
  PetscInt       first = none;

  PetscFunctionBeginUser;
  for (PetscInt i = none - 1; i >= 0; i--) {
    PetscBool torn;
    PetscCall(CouplingsIsInconsistent_Private(vi->pairs[i / vi->num_pairs], vi->pairs[i % vi->num_pairs], &torn));
    if (torn) first = i;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPIU_INT, MPI_MIN, vi->level->comm));
  if (first < none) {
    const char *nodes    = vi->pairs[first / vi->num_pairs]->spec->name,
               *vertices = vi->pairs[first % vi->num_pairs]->spec->name;
    PetscCall(UserErrorRaise(vi->level->comm,
                             "-%s_multipliers nodes and -%s_multipliers vertices are incompatible on the side that "
                             "both pairs share; use the same value",
                             nodes, vertices));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CouplingsCreate(VI vi, Couplings *couplings)
{
  Mat shift, unshift;

  PetscFunctionBeginUser;
  PetscCall(CouplingsCheckConsistent_Private(vi));
  couplings->num   = vi->num_pairs;
  couplings->shift = couplings->unshift = NULL;
  PetscCall(PetscCalloc3(vi->num_pairs, &couplings->record, vi->num_pairs, &couplings->basis, vi->num_pairs,
                         &couplings->arm));
  PetscCall(CouplingsUniteTransformations_Private(vi, PETSC_FALSE, &shift));
  PetscCall(CouplingsUniteTransformations_Private(vi, PETSC_TRUE, &unshift));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const Pair pair   = vi->pairs[p];
    Mat       *record = &couplings->record[p];
    PetscCall(CouplingsCreateKKT_Private(pair, record));
    if (shift) {
      PetscCall(CouplingsCreateBasis_Private(pair, shift, &couplings->basis[p]));
    } else {
      if (*record) PetscCall(PetscObjectReference((PetscObject)*record));
      couplings->basis[p] = *record;
    }
  }
  if (shift) PetscCall(CouplingsExpand_Private(vi, shift, &couplings->shift));
  if (unshift) PetscCall(CouplingsExpand_Private(vi, unshift, &couplings->unshift));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    PetscCall(CouplingsAddMatrix_Private(&couplings->arm[p], 1.0, vi->pairs[p]->arm));
    PetscCall(CouplingsAddProduct_Private(&couplings->arm[p], vi->pairs[p]->arm, couplings->shift));
  }
  PetscCall(MatDestroy(&shift));
  PetscCall(MatDestroy(&unshift));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CouplingsDestroy(Couplings *couplings)
{
  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < couplings->num; p++) {
    PetscCall(MatDestroy(&couplings->record[p]));
    PetscCall(MatDestroy(&couplings->basis[p]));
    PetscCall(MatDestroy(&couplings->arm[p]));
  }
  PetscCall(PetscFree3(couplings->record, couplings->basis, couplings->arm));
  PetscCall(MatDestroy(&couplings->shift));
  PetscCall(MatDestroy(&couplings->unshift));
  PetscFunctionReturn(PETSC_SUCCESS);
}
