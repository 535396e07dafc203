/* inversebasis.c -- T^-1 as a matrix, for the prolongation of displacements between the unknowns y of two
   levels.

   y = T^-1 u needs no series. With u~ = S^-1 u (eq. 6.1), unknowns of multipliers are (B u)_row / D_row, the
   others of special nodes F u~, all others u~. */
#include "base/compat.h"
#include "problem/basischange.h"

/* The data of the rows of T^-1. */
typedef struct {
  VI        vi;
  Mat       unshift; /* S^-1 - I or NULL */
  PetscInt *row;     /* of B, for every unknown of this rank, global; -1 where there is none */
} Source;

/* Adds F_r (I + unshift) at one node, or sums up how many entries that has. [in] W - NULL to count */
static PetscErrorCode InverseBasisAddFrame_Private(const Source *source, PetscInt node, PetscInt r, const PetscReal F[],
                                                   Mat W, PetscInt *count)
{
  const PetscInt dim = source->vi->level->dim, first = dim * (source->vi->level->node_begin + node), row = first + r;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < dim; k++) {
    const PetscScalar  f   = F ? F[r * dim + k] : (PetscReal)(r == k);
    PetscInt           num = 0;
    const PetscInt    *columns;
    const PetscScalar *values;

    if (f == 0) continue;
    *count += 1;
    if (W) PetscCall(MatSetValue(W, row, first + k, f, ADD_VALUES));
    if (!source->unshift) continue;
    PetscCall(MatGetRow(source->unshift, first + k, &num, &columns, &values));
    *count += num;
    for (PetscInt c = 0; W && c < num; c++) PetscCall(MatSetValue(W, row, columns[c], f * values[c], ADD_VALUES));
    PetscCall(MatRestoreRow(source->unshift, first + k, &num, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds one row of T^-1, or counts its entries. */
static PetscErrorCode InverseBasisAddRow_Private(const Source *source, PetscInt node, PetscInt r, Mat W,
                                                 PetscInt *count)
{
  const VI         vi    = source->vi;
  const NodeBases *bases = &vi->basis->bases;
  const PetscInt dim = vi->level->dim, s = bases->of_node[node], unknown = dim * vi->level->node_begin + dim * node + r,
                 row = source->row[dim * node + r];
  PetscInt           num, begin;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  if (row < 0) {
    PetscCall(InverseBasisAddFrame_Private(source, node, r, s < 0 ? NULL : &bases->F[s * dim * dim], W, count));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MatGetOwnershipRange(vi->B, &begin, NULL));
  PetscCall(MatGetRow(vi->B, row, &num, &columns, &values));
  *count += num;
  for (PetscInt c = 0; W && c < num; c++)
    PetscCall(MatSetValue(W, unknown, columns[c], values[c] / vi->row_D[row - begin], ADD_VALUES));
  PetscCall(MatRestoreRow(vi->B, row, &num, &columns, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VICreateInverseBasis(VI vi, Mat *inverse)
{
  const PetscInt dim = vi->level->dim, n = dim * vi->level->num_owned, N = dim * vi->level->num_global;
  Source         source = {.vi = vi, .unshift = vi->basis->couplings.unshift};
  PetscInt      *d_nnz, *o_nnz, begin = 0;

  PetscFunctionBeginUser;
  *inverse = NULL;
  if (!vi->T) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc3(n, &source.row, n, &d_nnz, n, &o_nnz));
  for (PetscInt i = 0; i < n; i++) source.row[i] = -1;
  if (vi->B) PetscCall(MatGetOwnershipRange(vi->B, &begin, NULL));
  for (PetscInt r = 0; r < vi->num_rows; r++) source.row[vi->row_dof[r] - dim * vi->level->node_begin] = begin + r;
  for (PetscInt i = 0; i < n; i++) {
    PetscInt count = 0;

    PetscCall(InverseBasisAddRow_Private(&source, i / dim, i % dim, NULL, &count));
    d_nnz[i] = PetscMin(count, n);
    o_nnz[i] = PetscMin(count, N - n);
  }
  PetscCall(MatCreateAIJ(vi->level->comm, n, n, N, N, 0, d_nnz, 0, o_nnz, inverse));
  for (PetscInt i = 0; i < n; i++) {
    PetscInt count = 0;

    PetscCall(InverseBasisAddRow_Private(&source, i / dim, i % dim, *inverse, &count));
  }
  PetscCall(MatAssemblyBegin(*inverse, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*inverse, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree3(source.row, d_nnz, o_nnz));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VIApplyInverseBasis(VI vi, Vec u, Vec y)
{
  const PetscInt     dim     = vi->level->dim;
  const NodeBases   *bases   = &vi->basis->bases;
  const Mat          unshift = vi->basis->couplings.unshift;
  const PetscScalar *ba;
  PetscScalar       *ya;
  Vec                Bu;

  PetscFunctionBeginUser;
  if (unshift) {
    PetscCall(MatMultAdd(unshift, u, u, y));
  } else {
    PetscCall(VecCopy(u, y));
  }
  PetscCall(VecGetArray(y, &ya));
  for (PetscInt s = 0; s < bases->num; s++) {
    PetscScalar *yi = &ya[bases->node[s] * dim], ui[3];
    for (PetscInt k = 0; k < dim; k++) ui[k] = yi[k];
    for (PetscInt r = 0; r < dim; r++) {
      yi[r] = 0;
      for (PetscInt k = 0; k < dim; k++) yi[r] += bases->F[(s * dim + r) * dim + k] * ui[k];
    }
  }
  if (vi->B) {
    PetscCall(VecDuplicate(vi->G, &Bu));
    PetscCall(MatMult(vi->B, u, Bu));
    PetscCall(VecGetArrayRead(Bu, &ba));
    for (PetscInt r = 0; r < vi->num_rows; r++) ya[vi->row_dof[r] - dim * vi->level->node_begin] = ba[r] / vi->row_D[r];
    PetscCall(VecRestoreArrayRead(Bu, &ba));
    PetscCall(VecDestroy(&Bu));
  }
  PetscCall(VecRestoreArray(y, &ya));
  PetscFunctionReturn(PETSC_SUCCESS);
}
