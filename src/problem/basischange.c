/* basischange.c -- the change of basis u = T y.

   At a node with multipliers y_i = n_i . (u_s - sum_b P_ab u_b + sum_c (D_ac / D_aa) u_c), P = M / D; the
   other unknowns of the node are its tangential displacements (Hueber & Wohlmuth 2005, here for the normal
   component only). A tie treats all directions so. Held directions that are not axes turn their node's
   unknowns as well. All this is done to the hierarchical displacements u~ where there are any, and to those
   of eq. 3.5 on tri6 (couplings.h), and u = S u~ comes last. */
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "problem/pairarms.h"

/* A unit vector is along an axis, or two are parallel, to this. */
static const PetscReal PARALLEL = 1e-12;
/* Powers of E this small do not change T, whose entries are of order 1. */
static const PetscReal NEGLIGIBLE_POWER = 1e-17;
/* Powers beyond the longest chain of pairs: two pairs on one side may depend on each other through the row of
   a removed node. On straight facets this node belongs to a sliver, with a weight below 1/1000, and each
   power is smaller by that factor. On quadratic facets a partly covered far end weighs more; at the worst
   place of a seam between two pairs the factor is 0.7. */
enum { REMOVED_POWERS = 128 };

/* Adds R - 1, which is F^-1 - 1 at special nodes. [in,out] X - rows of these nodes */
static PetscErrorCode BasisChangeAddR_Private(VI vi, const NodeBases *bases, Mat X)
{
  const PetscInt dim = vi->level->dim;
  PetscInt       begin;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(X, &begin, NULL));
  for (PetscInt s = 0; s < bases->num; s++) {
    const PetscInt row = begin + dim * s, column = dim * (vi->level->node_begin + bases->node[s]);

    for (PetscInt e = 0; e < dim * dim; e++) {
      const PetscReal value = bases->Finv[s * dim * dim + e] - (e / dim == e % dim ? 1 : 0);

      if (value != 0) PetscCall(MatSetValue(X, row + e / dim, column + e % dim, value, ADD_VALUES));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds E of one row of the pairs: -(1/D) F^-1_(.,i) (x) F_i for every entry of its node, and arms.
   [in,out] E - rows of special nodes */
static PetscErrorCode BasisChangeAddCoupling_Private(VI vi, const NodeBases *bases, const Couplings *couplings,
                                                     PetscInt r, Mat E)
{
  const PetscInt     p    = vi->row_pair[r];
  const Pair         pair = vi->pairs[p];
  const PetscInt     dim = vi->level->dim, k = vi->row_node[r], i = vi->row_dof[r] % dim;
  const PetscInt     s = bases->of_node[pair->nodes[k]];
  const PetscReal   *F = &bases->F[s * dim * dim], *Finv = &bases->Finv[s * dim * dim];
  PetscInt           num, begin, block;
  const PetscInt    *columns;
  const PetscScalar *values;
  PetscScalar        Eb[9];

  PetscFunctionBeginUser;
  if (!couplings->basis[p]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatGetOwnershipRange(E, &begin, NULL));
  block = begin / dim + s;
  PetscCall(MatGetRow(couplings->basis[p], vi->level->node_begin + pair->nodes[k], &num, &columns, &values));
  for (PetscInt c = 0; c < num; c++) {
    const PetscReal coefficient = -PetscRealPart(values[c]) / pair->D[k];
    for (PetscInt j = 0; j < dim; j++) {
      for (PetscInt l = 0; l < dim; l++) Eb[j * dim + l] = coefficient * Finv[j * dim + i] * F[i * dim + l];
    }
    PetscCall(MatSetValuesBlocked(E, 1, &block, 1, &columns[c], Eb, ADD_VALUES));
  }
  PetscCall(MatRestoreRow(couplings->basis[p], vi->level->node_begin + pair->nodes[k], &num, &columns, &values));
  PetscCall(PairArmsAddToE(vi, bases, couplings->arm[p], r, dim * block, E));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Entries of a node's rows of E, over all its constraints.
   [in,out] nnz - blocks per special node [bases->num] */
static PetscErrorCode BasisChangeCountE_Private(VI vi, const NodeBases *bases, const Couplings *couplings,
                                                PetscInt nnz[])
{
  const PetscInt dim = vi->level->dim;
  PetscInt       num;

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    for (PetscInt k = 0; couplings->basis[p] && k < vi->pairs[p]->num; k++) {
      const PetscInt node = vi->pairs[p]->nodes[k], s = bases->of_node[node];
      PetscCall(MatGetRow(couplings->basis[p], vi->level->node_begin + node, &num, NULL, NULL));
      nnz[s] += num;
      PetscCall(MatRestoreRow(couplings->basis[p], vi->level->node_begin + node, &num, NULL, NULL));
      PetscCall(PairArmsCount(couplings->arm[p], dim, vi->level->node_begin + node, &num));
      nnz[s] += num;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A sum of R - 1 and E, what other displacements contribute to u~ at special nodes. Collective.
   [out] sum - rows of these nodes, also empty ones; to be released by BasisFactorDestroy() */
static PetscErrorCode BasisChangeCreateSum_Private(VI vi, const NodeBases *bases, const Couplings *couplings,
                                                   PetscBool with_R, PetscBool with_E, BasisFactor *sum)
{
  const PetscInt dim = vi->level->dim, n = vi->level->num_owned, num = bases->num;
  PetscInt      *nnz, *d_nnz, *o_nnz;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(num, &nnz, num * dim, &d_nnz, num * dim, &o_nnz));
  if (with_E) PetscCall(BasisChangeCountE_Private(vi, bases, couplings, nnz));
  for (PetscInt i = 0; i < num * dim; i++) {
    d_nnz[i] = dim * PetscMin(nnz[i / dim] + (with_R ? 1 : 0), n);
    o_nnz[i] = dim * PetscMin(nnz[i / dim], vi->level->num_global - n);
  }
  PetscCall(MatCreateAIJ(vi->level->comm, num * dim, n * dim, PETSC_DETERMINE, PETSC_DETERMINE, 0, d_nnz, 0, o_nnz,
                         &sum->few));
  PetscCall(MatSetBlockSize(sum->few, dim));
  PetscCall(PetscFree3(nnz, d_nnz, o_nnz));
  if (with_R) PetscCall(BasisChangeAddR_Private(vi, bases, sum->few));
  for (PetscInt r = 0; r < (with_E ? vi->num_rows : 0); r++)
    PetscCall(BasisChangeAddCoupling_Private(vi, bases, couplings, r, sum->few));
  PetscCall(MatAssemblyBegin(sum->few, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(sum->few, MAT_FINAL_ASSEMBLY));
  PetscCall(ISCreateBlock(PETSC_COMM_SELF, dim, num, bases->node, PETSC_COPY_VALUES, &sum->rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether E has columns of special nodes: if not, E E = 0 and E R = E. */
static PetscErrorCode BasisChangeIsChained_Private(VI vi, const NodeBases *bases, const Couplings *couplings,
                                                   PetscBool *chained)
{
  const PetscScalar *reached;
  Vec                marks;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(vi->level, 1, &marks));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const Mat       C    = couplings->basis[vi->row_pair[r]];
    const PetscInt  node = vi->level->node_begin + vi->pairs[vi->row_pair[r]]->nodes[vi->row_node[r]];
    PetscInt        num;
    const PetscInt *columns;

    if (!C) continue;
    PetscCall(MatGetRow(C, node, &num, &columns, NULL));
    for (PetscInt c = 0; c < num; c++) PetscCall(VecSetValue(marks, columns[c], 1, INSERT_VALUES));
    PetscCall(MatRestoreRow(C, node, &num, &columns, NULL));
    PetscCall(PairArmsMark(couplings->arm[vi->row_pair[r]], vi->level->dim, node, marks));
  }
  PetscCall(VecAssemblyBegin(marks));
  PetscCall(VecAssemblyEnd(marks));
  *chained = PETSC_FALSE;
  PetscCall(VecGetArrayRead(marks, &reached));
  for (PetscInt s = 0; s < bases->num; s++)
    if (reached[bases->node[s]] != 0) *chained = PETSC_TRUE;
  PetscCall(VecRestoreArrayRead(marks, &reached));
  PetscCall(VecDestroy(&marks));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, chained, 1, MPIU_BOOL, MPI_LOR, vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* V = E X. [in] E, X - rows of special nodes; [out] V - the same, owned by the caller */
static PetscErrorCode BasisChangeMultiply_Private(const BasisFactor *E, Mat X, Mat *V)
{
  Mat square;

  PetscFunctionBeginUser;
  PetscCall(BasisFactorCreateSquare(&(BasisFactor){.few = X, .rows = E->rows}, &square));
  PetscCall(MatMatMult(E->few, square, MAT_INITIAL_MATRIX, PETSC_DEFAULT, V));
  PetscCall(MatProductClear(*V)); // it would keep its factors
  PetscCall(MatDestroy(&square));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* 1 + X <- (1 + E + E E + ..) (1 + X). [in,out] X - rows of special nodes */
static PetscErrorCode BasisChangeAddPowers_Private(VI vi, const BasisFactor *E, Mat X)
{
  Mat       V, next;
  PetscReal norm;

  PetscFunctionBeginUser;
  PetscCall(BasisChangeMultiply_Private(E, X, &V));
  PetscCall(MatAXPY(V, 1.0, E->few, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatNorm(V, NORM_FROBENIUS, &norm));
  for (PetscInt power = 1; norm > NEGLIGIBLE_POWER; power++) {
    PetscCheck(power <= vi->num_pairs + REMOVED_POWERS, vi->level->comm, PETSC_ERR_PLIB,
               "The coupling of the pairs does not fade");
    PetscCall(MatAXPY(X, 1.0, V, DIFFERENT_NONZERO_PATTERN));
    PetscCall(BasisChangeMultiply_Private(E, V, &next));
    PetscCall(MatDestroy(&V));
    V = next;
    PetscCall(MatNorm(V, NORM_FROBENIUS, &norm));
  }
  PetscCall(MatDestroy(&V));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* 1 + X <- S (1 + X), which has rows of other nodes, too. Collective. */
static PetscErrorCode BasisChangeShift_Private(const Couplings *couplings, BasisFactor *X)
{
  Mat square, shifted;

  PetscFunctionBeginUser;
  if (!couplings->shift) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(BasisFactorCreateSquare(X, &square));
  PetscCall(BasisFactorDestroy(X));
  PetscCall(MatMatMult(couplings->shift, square, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &shifted));
  PetscCall(MatAXPY(square, 1.0, shifted, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatAXPY(square, 1.0, couplings->shift, DIFFERENT_NONZERO_PATTERN));
  PetscCall(BasisFactorCreate(square, NULL, X));
  PetscCall(MatDestroy(&shifted));
  PetscCall(MatDestroy(&square));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends a row of 1 + X without zeros. [in] x - of X, or -1; [in,out] num - entries so far */
static PetscErrorCode BasisChangeAppendRow_Private(Mat X, PetscInt x, PetscInt row, PetscInt *num, PetscInt column[],
                                                   PetscScalar value[])
{
  PetscScalar        own  = 1;
  PetscInt           size = 0;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  if (x >= 0) PetscCall(MatGetRow(X, x, &size, &columns, &values));
  for (PetscInt c = 0; c < size; c++) {
    if (columns[c] == row) {
      own += values[c];
    } else if (values[c] != 0) {
      column[*num]    = columns[c];
      value[(*num)++] = values[c];
    }
  }
  if (x >= 0) PetscCall(MatRestoreRow(X, x, &size, &columns, &values));
  column[*num]    = row;
  value[(*num)++] = own;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* T = 1 + X. Collective. [in] bs - block size; [out] T - owned by the caller */
static PetscErrorCode BasisChangeAddIdentity_Private(const BasisFactor *X, PetscInt bs, Mat *T)
{
  PetscInt        begin, n, x, few, at = 0, num = 0, most, *start, *column;
  const PetscInt *rows;
  PetscScalar    *value;
  MatInfo         info;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(X->few, NULL, &n));
  PetscCall(MatGetOwnershipRangeColumn(X->few, &begin, NULL));
  PetscCall(MatGetOwnershipRange(X->few, &x, NULL));
  PetscCall(MatGetInfo(X->few, MAT_LOCAL, &info));
  most = (PetscInt)info.nz_used + n;
  PetscCall(PetscMalloc3(n + 1, &start, most, &column, most, &value));
  PetscCall(ISGetLocalSize(X->rows, &few));
  PetscCall(ISGetIndices(X->rows, &rows));
  start[0] = 0;
  for (PetscInt i = 0; i < n; i++) {
    const PetscBool has = (PetscBool)(at < few && rows[at] == i);

    PetscCall(BasisChangeAppendRow_Private(X->few, has ? x + at : -1, begin + i, &num, column, value));
    at += has ? 1 : 0;
    start[i + 1] = num;
  }
  PetscCall(ISRestoreIndices(X->rows, &rows));
  PetscCall(CSRMatrixCreate(PetscObjectComm((PetscObject)X->few), &(CSRRows){bs, n, n, start, column, value}, T));
  PetscCall(PetscFree3(start, column, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Roundoff of F F^-1. */
static const PetscReal ROUNDOFF = 1e-14;

/* Appends row i of F (1 + X) - 1 of a special node s. [in] X - rows of special nodes */
static PetscErrorCode BasisChangeAppendC_Private(VI vi, const NodeBases *bases, Mat X, PetscInt s, PetscInt i,
                                                 CSRRows *C)
{
  const PetscInt     dim = vi->level->dim, first = dim * (vi->level->node_begin + bases->node[s]);
  const PetscReal   *F      = &bases->F[(s * dim + i) * dim];
  PetscReal          own[3] = {0, 0, 0};
  PetscInt           begin, size, at = C->start[C->m], num;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  num = at;
  PetscCall(MatGetOwnershipRange(X, &begin, NULL));
  own[i] = -1;
  for (PetscInt k = 0; k < dim; k++) {
    own[k] += F[k];
    PetscCall(MatGetRow(X, begin + dim * s + k, &size, &columns, &values));
    for (PetscInt c = 0; c < size; c++) {
      if (columns[c] >= first && columns[c] < first + dim) {
        own[columns[c] - first] += F[k] * PetscRealPart(values[c]);
      } else if (F[k] * values[c] != 0) {
        C->column[num]  = columns[c];
        C->value[num++] = F[k] * values[c];
      }
    }
    PetscCall(MatRestoreRow(X, begin + dim * s + k, &size, &columns, &values));
  }
  for (PetscInt k = 0; k < dim; k++) {
    if (PetscAbsReal(own[k]) <= ROUNDOFF) continue;
    C->column[num]  = first + k;
    C->value[num++] = own[k];
  }
  num -= at;
  PetscCall(CSRMatrixMergeRow(&num, &C->column[at], &C->value[at]));
  if (num) C->start[++C->m] = at + num;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* C of 1 + X = R (1 + C): F (1 + X) = 1 + C at each node. Collective.
   [in] X - rows of special nodes, without S; [out] factor - to be released by BasisFactorDestroy() */
static PetscErrorCode BasisChangeCreateC_Private(VI vi, const NodeBases *bases, Mat X, BasisFactor *factor)
{
  const PetscInt dim = vi->level->dim, all = dim * bases->num, first = dim * vi->level->node_begin;
  PetscInt      *place, most;
  PetscBool     *constrained;
  CSRRows        C = {.bs = 1, .m = 0, .n = dim * vi->level->num_owned};
  MatInfo        info;

  PetscFunctionBeginUser;
  PetscCall(MatGetInfo(X, MAT_LOCAL, &info));
  most = dim * (PetscInt)info.nz_used + dim * all; // a row of C has those of its node
  PetscCall(PetscMalloc3(all + 1, &C.start, most, &C.column, most, &C.value));
  PetscCall(PetscMalloc1(all, &place));
  PetscCall(PetscCalloc1(all, &constrained));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt row = vi->row_dof[r] - first;

    constrained[dim * bases->of_node[row / dim] + row % dim] = PETSC_TRUE;
  }
  C.start[0] = 0;
  for (PetscInt i = 0; i < all; i++) {
    const PetscInt before = C.m;

    if (!constrained[i]) continue;
    PetscCall(BasisChangeAppendC_Private(vi, bases, X, i / dim, i % dim, &C));
    if (C.m > before) place[before] = dim * bases->node[i / dim] + i % dim;
  }
  PetscCall(CSRMatrixCreate(vi->level->comm, &C, &factor->few));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, C.m, place, PETSC_COPY_VALUES, &factor->rows));
  PetscCall(PetscFree(constrained));
  PetscCall(PetscFree(place));
  PetscCall(PetscFree3(C.start, C.column, C.value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisChangeCreate(VI vi, const NodeBases *bases, const Couplings *couplings, BasisChange *change)
{
  BasisFactor E, X, local;
  PetscBool   chained;
  PetscInt    special = bases->num;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(change, 1));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &special, 1, MPIU_INT, MPI_SUM, vi->level->comm));
  if (special == 0 && !couplings->shift) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(BasisChangeIsChained_Private(vi, bases, couplings, &chained));
  PetscCall(BasisChangeCreateSum_Private(vi, bases, couplings, PETSC_TRUE, (PetscBool)!chained, &X));
  if (chained) {
    PetscCall(BasisChangeCreateSum_Private(vi, bases, couplings, PETSC_FALSE, PETSC_TRUE, &E));
    PetscCall(BasisChangeAddPowers_Private(vi, &E, X.few));
    PetscCall(BasisFactorDestroy(&E));
  }
  PetscCall(BasisChangeCreateC_Private(vi, bases, X.few, &change->factor[1]));
  PetscCall(BasisChangeShift_Private(couplings, &X));
  PetscCall(BasisChangeAddIdentity_Private(&X, vi->level->dim, &change->T));
  PetscCall(BasisFactorDestroy(&X));
  PetscCall(BasisChangeCreateSum_Private(vi, bases, couplings, PETSC_TRUE, PETSC_FALSE, &local));
  PetscCall(BasisChangeShift_Private(couplings, &local));
  PetscCall(BasisFactorCreate(local.few, local.rows, &change->factor[0]));
  PetscCall(BasisFactorDestroy(&local));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisChangeDestroy(BasisChange *change)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&change->T));
  for (int f = 0; f < BASIS_FACTORS; f++) PetscCall(BasisFactorDestroy(&change->factor[f]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The unknown (0..dim-1) of a node that is +-d . u, and the sign; -1 if none is. */
static PetscInt BasisChangeFindUnknown_Private(PetscInt dim, const PetscReal F[], const PetscReal d[], PetscReal *sign)
{
  for (PetscInt r = 0; r < dim; r++) {
    PetscReal dot = 0;
    for (PetscInt k = 0; k < dim; k++) dot += (F ? F[r * dim + k] : (PetscReal)(r == k)) * d[k];
    *sign = dot;
    if (PetscAbsReal(dot) > 1 - PARALLEL) return r;
  }
  return -1;
}

/* (S^-1 - I) p with p = sum_j value_j d_j: the difference of prescribed displacements in u~ and in u. Where
   the middle of a facet is fixed, so are its ends, at least in the same directions.
   [out] moved - NULL where S = I */
static PetscErrorCode BasisChangeTransformPrescribed_Private(VI vi, const Couplings *couplings, Vec *moved)
{
  const PetscInt dim = vi->level->dim;
  PetscScalar   *value;
  Vec            prescribed;

  PetscFunctionBeginUser;
  *moved = NULL;
  if (!couplings->unshift) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatCreateVecs(couplings->unshift, &prescribed, moved));
  PetscCall(VecGetArray(prescribed, &value));
  for (PetscInt i = 0; i < vi->level->num_owned; i++) {
    for (PetscInt j = 0; j < vi->support.count[i]; j++) {
      for (PetscInt k = 0; k < dim; k++)
        value[i * dim + k] += vi->support.values[i * dim + j] * vi->support.directions[(i * dim + j) * dim + k];
    }
  }
  PetscCall(VecRestoreArray(prescribed, &value));
  PetscCall(MatMult(couplings->unshift, prescribed, *moved));
  PetscCall(VecDestroy(&prescribed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisChangeGetFixed(VI vi, const NodeBases *bases, const Couplings *couplings, PetscInt *num,
                                   PetscInt **dofs, PetscReal **values)
{
  const PetscInt     dim   = vi->level->dim;
  const PetscScalar *moved = NULL;
  Vec                unshifted;

  PetscFunctionBeginUser;
  *num = 0;
  PetscCall(PetscMalloc1(vi->level->num_owned * dim, dofs));
  PetscCall(PetscMalloc1(vi->level->num_owned * dim, values));
  PetscCall(BasisChangeTransformPrescribed_Private(vi, couplings, &unshifted));
  if (unshifted) PetscCall(VecGetArrayRead(unshifted, &moved));
  for (PetscInt i = 0; i < vi->level->num_owned; i++) {
    const PetscInt   s = bases->of_node[i];
    const PetscReal *F = s >= 0 ? &bases->F[s * dim * dim] : NULL;
    for (PetscInt j = 0; j < vi->support.count[i]; j++) {
      const PetscReal *d     = &vi->support.directions[(i * dim + j) * dim];
      PetscReal        value = vi->support.values[i * dim + j], sign;
      const PetscInt   r     = BasisChangeFindUnknown_Private(dim, F, d, &sign);
      PetscCheck(r >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A held direction is not an unknown of its node");
      for (PetscInt k = 0; moved && k < dim; k++) value += d[k] * PetscRealPart(moved[i * dim + k]);
      (*dofs)[*num]       = dim * (vi->level->node_begin + i) + r;
      (*values)[(*num)++] = sign * value;
    }
  }
  if (unshifted) PetscCall(VecRestoreArrayRead(unshifted, &moved));
  PetscCall(VecDestroy(&unshifted));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (vi->pairs[vi->row_pair[r]]->spec->type != PAIR_TIED) continue;
    (*dofs)[*num]       = vi->row_dof[r];
    (*values)[(*num)++] = 0;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VIMarkCartesian(VI vi, PetscBool cartesian[])
{
  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < vi->level->num_owned; a++) cartesian[a] = (PetscBool)(vi->basis->bases.of_node[a] < 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}
