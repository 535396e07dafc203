/* inversebasis.c -- the rows of T^-1, for the prolongation of displacements between the unknowns y of two
   levels.

   y = T^-1 u needs no series. With u~ = S^-1 u (eq. 6.1), unknowns of multipliers are (B u)_row / D_row, the
   others of special nodes F u~, all others u~. */
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "problem/basischange.h"

/* The data of the rows of T^-1, and the entries that they have so far. */
typedef struct {
  VI           vi;
  Mat          unshift; /* S^-1 - I or NULL */
  PetscInt    *row;     /* of B, for every unknown of this rank, global; -1 where there is none */
  PetscInt     num, max;
  PetscInt    *column; /* [num; max] */
  PetscScalar *value;  /* [num; max] */
} InverseRows;

/* Appends entries, scaled. */
static PetscErrorCode InverseRowsAppend_Private(InverseRows *rows, PetscInt num, const PetscInt columns[],
                                                const PetscScalar values[], PetscScalar scale)
{
  PetscFunctionBeginUser;
  if (rows->num + num > rows->max) {
    rows->max = 2 * (rows->num + num);
    PetscCall(PetscRealloc(sizeof(*rows->column) * rows->max, &rows->column));
    PetscCall(PetscRealloc(sizeof(*rows->value) * rows->max, &rows->value));
  }
  for (PetscInt c = 0; c < num; c++) {
    rows->column[rows->num]  = columns[c];
    rows->value[rows->num++] = scale * values[c];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends F_r (I + unshift) at one node. [in] F - NULL: 1 */
static PetscErrorCode InverseRowsAddFrame_Private(InverseRows *rows, PetscInt node, PetscInt r, const PetscReal F[])
{
  const PetscInt    dim = rows->vi->level->dim, first = dim * (rows->vi->level->node_begin + node);
  const PetscScalar one = 1;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < dim; k++) {
    const PetscScalar  f       = F ? F[r * dim + k] : (PetscReal)(r == k);
    const PetscInt     unknown = first + k;
    PetscInt           num     = 0;
    const PetscInt    *columns;
    const PetscScalar *values;

    if (f == 0) continue;
    PetscCall(InverseRowsAppend_Private(rows, 1, &unknown, &one, f));
    if (!rows->unshift) continue;
    PetscCall(MatGetRow(rows->unshift, unknown, &num, &columns, &values));
    PetscCall(InverseRowsAppend_Private(rows, num, columns, values, f));
    PetscCall(MatRestoreRow(rows->unshift, unknown, &num, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends one row of T^-1. */
static PetscErrorCode InverseRowsAdd_Private(InverseRows *rows, PetscInt node, PetscInt r)
{
  const VI           vi    = rows->vi;
  const NodeBases   *bases = &vi->basis->bases;
  const PetscInt     dim = vi->level->dim, s = bases->of_node[node], row = rows->row[dim * node + r], at = rows->num;
  PetscInt           num, begin;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  if (row < 0) {
    PetscCall(InverseRowsAddFrame_Private(rows, node, r, s < 0 ? NULL : &bases->F[s * dim * dim]));
    num = rows->num - at;
    PetscCall(CSRMatrixMergeRow(&num, &rows->column[at], &rows->value[at]));
    rows->num = at + num;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MatGetOwnershipRange(vi->B, &begin, NULL));
  PetscCall(MatGetRow(vi->B, row, &num, &columns, &values));
  PetscCall(InverseRowsAppend_Private(rows, num, columns, values, 1));
  PetscCall(MatRestoreRow(vi->B, row, &num, &columns, &values));
  for (PetscInt k = at; k < rows->num; k++) rows->value[k] /= vi->row_D[row - begin];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a row of T^-1 is not that of 1. */
static PetscErrorCode InverseRowsNeed_Private(const InverseRows *rows, PetscInt i, PetscBool *need)
{
  const PetscInt dim = rows->vi->level->dim;
  PetscInt       num;

  PetscFunctionBeginUser;
  *need = (PetscBool)(rows->row[i] >= 0 || rows->vi->basis->bases.of_node[i / dim] >= 0);
  if (*need || !rows->unshift) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatGetRow(rows->unshift, dim * rows->vi->level->node_begin + i, &num, NULL, NULL));
  *need = (PetscBool)(num > 0);
  PetscCall(MatRestoreRow(rows->unshift, dim * rows->vi->level->node_begin + i, &num, NULL, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VICreateInverseBasis(VI vi, BasisRows *inverse)
{
  const PetscInt dim = vi->level->dim, n = dim * vi->level->num_owned;
  InverseRows    rows  = {.vi = vi, .unshift = vi->basis->couplings.unshift};
  PetscInt       begin = 0, num = 0, *start, *place;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(inverse, 1));
  if (!vi->T) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc3(n, &rows.row, n + 1, &start, n, &place));
  for (PetscInt i = 0; i < n; i++) rows.row[i] = -1;
  if (vi->B) PetscCall(MatGetOwnershipRange(vi->B, &begin, NULL));
  for (PetscInt r = 0; r < vi->num_rows; r++) rows.row[vi->row_dof[r] - dim * vi->level->node_begin] = begin + r;
  start[0] = 0;
  for (PetscInt i = 0; i < n; i++) {
    PetscBool need;

    PetscCall(InverseRowsNeed_Private(&rows, i, &need));
    if (!need) continue;
    PetscCall(InverseRowsAdd_Private(&rows, i / dim, i % dim));
    place[num++] = i;
    start[num]   = rows.num;
  }
  PetscCall(CSRMatrixCreate(vi->level->comm, &(CSRRows){1, num, n, start, rows.column, rows.value}, &inverse->few));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, place, PETSC_COPY_VALUES, &inverse->rows));
  PetscCall(PetscFree3(rows.row, start, place));
  PetscCall(PetscFree(rows.column));
  PetscCall(PetscFree(rows.value));
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
