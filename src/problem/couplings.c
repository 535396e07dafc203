/* couplings.c -- rows of the pairs in the displacements u and in the hierarchical ones u~. */
#include <mortise/compat.h>
#include <mortise/fault.h>
#include "couplings.h"

/* A := A + a B, where NULL stands for 0. */
static PetscErrorCode Add_Private(Mat *A, PetscReal a, Mat B)
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

/* A := A + a B C, where NULL stands for 0. */
static PetscErrorCode AddProduct_Private(Mat *A, PetscReal a, Mat B, Mat C)
{
  Mat BC;

  PetscFunctionBeginUser;
  if (!B || !C) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatMatMult(B, C, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &BC));
  PetscCall(Add_Private(A, a, BC));
  PetscCall(MatDestroy(&BC));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The shifts of all pairs at once: a facet in several of them has the same in each. NULL where there is none. */
static PetscErrorCode UniteShifts_Private(VI vi, Mat *shift)
{
  const PetscInt n = vi->level->num_owned, begin = vi->level->node_begin;

  PetscFunctionBeginUser;
  *shift = NULL;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    if (!vi->pairs[p]->shift) continue;
    if (!*shift)
      PetscCall(MatCreateAIJ(vi->level->comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, ELEMENT_MAX_FACET_NODES, NULL,
                             ELEMENT_MAX_FACET_NODES, NULL, shift));
    for (PetscInt row = begin; row < begin + n; row++) {
      PetscInt           num;
      const PetscInt    *columns;
      const PetscScalar *values;
      PetscCall(MatGetRow(vi->pairs[p]->shift, row, &num, &columns, &values));
      if (num) PetscCall(MatSetValues(*shift, 1, &row, num, columns, values, INSERT_VALUES));
      PetscCall(MatRestoreRow(vi->pairs[p]->shift, row, &num, &columns, &values));
    }
  }
  if (*shift) {
    PetscCall(MatAssemblyBegin(*shift, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(*shift, MAT_FINAL_ASSEMBLY));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The same for all components: entry times the identity. [in] shift - node x node */
static PetscErrorCode Expand_Private(VI vi, Mat shift, Mat *expanded)
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

/* basis = (D + record) S - D. Multiplier nodes are not shifted, so that D S = D. On the pair's own side, if that is shifted,
   (I - shift) S = I: there the chain stays what it is. */
static PetscErrorCode CreateBasis_Private(const Pair pair, Mat shift, Mat *basis)
{
  Mat other = NULL;

  PetscFunctionBeginUser;
  PetscCall(Add_Private(&other, -1.0, pair->M));
  if (!pair->shift) PetscCall(Add_Private(&other, 1.0, pair->chain));
  PetscCall(Add_Private(basis, 1.0, other));
  PetscCall(AddProduct_Private(basis, 1.0, other, shift));
  if (pair->shift) PetscCall(Add_Private(basis, 1.0, pair->chain));
  PetscCall(MatDestroy(&other));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a node that this rank owns carries a multiplier of one pair and is shifted by another. */
static PetscErrorCode IsTorn_Private(const Pair pair, const Pair other, PetscBool *torn)
{
  PetscInt num;

  PetscFunctionBeginUser;
  *torn = PETSC_FALSE;
  if (!other->shift) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt k = 0; k < pair->num; k++) {
    const PetscInt row = pair->level->node_begin + pair->nodes[k];
    PetscCall(MatGetRow(other->shift, row, &num, NULL, NULL));
    *torn = (PetscBool)(*torn || num > 0);
    PetscCall(MatRestoreRow(other->shift, row, &num, NULL, NULL));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Faults if two pairs on one side want the displacement in the middle of a facet to be an unknown in different ways. */
static PetscErrorCode CheckTorn_Private(VI vi)
{
  const PetscInt none  = vi->num_pairs * vi->num_pairs;
  PetscInt       first = none;

  PetscFunctionBeginUser;
  for (PetscInt i = none - 1; i >= 0; i--) {
    PetscBool torn;
    PetscCall(IsTorn_Private(vi->pairs[i / vi->num_pairs], vi->pairs[i % vi->num_pairs], &torn));
    if (torn) first = i;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPIU_INT, MPI_MIN, vi->level->comm));
  if (first < none) {
    const char *nodes    = vi->pairs[first / vi->num_pairs]->spec->name,
               *vertices = vi->pairs[first % vi->num_pairs]->spec->name;
    PetscCall(FaultRaise(vi->level->comm,
                         "-%s_multipliers nodes and -%s_multipliers vertices do not go together on the side that both "
                         "pairs share; give them the same",
                         nodes, vertices));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CouplingsCreate(VI vi, Couplings *couplings)
{
  Mat shift;

  PetscFunctionBeginUser;
  PetscCall(CheckTorn_Private(vi));
  couplings->num   = vi->num_pairs;
  couplings->shift = NULL;
  PetscCall(PetscCalloc2(vi->num_pairs, &couplings->record, vi->num_pairs, &couplings->basis));
  PetscCall(UniteShifts_Private(vi, &shift));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const Pair pair   = vi->pairs[p];
    Mat       *record = &couplings->record[p];
    PetscCall(Add_Private(record, -1.0, pair->M));
    PetscCall(Add_Private(record, 1.0, pair->chain));
    PetscCall(AddProduct_Private(record, -1.0, pair->chain, pair->shift));
    if (shift) {
      PetscCall(CreateBasis_Private(pair, shift, &couplings->basis[p]));
    } else {
      if (*record) PetscCall(PetscObjectReference((PetscObject)*record));
      couplings->basis[p] = *record;
    }
  }
  if (shift) PetscCall(Expand_Private(vi, shift, &couplings->shift));
  PetscCall(MatDestroy(&shift));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CouplingsDestroy(Couplings *couplings)
{
  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < couplings->num; p++) {
    PetscCall(MatDestroy(&couplings->record[p]));
    PetscCall(MatDestroy(&couplings->basis[p]));
  }
  PetscCall(PetscFree2(couplings->record, couplings->basis));
  PetscCall(MatDestroy(&couplings->shift));
  PetscFunctionReturn(PETSC_SUCCESS);
}
