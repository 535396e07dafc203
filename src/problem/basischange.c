/* basischange.c -- the change of basis u = T y.

   At a node with multipliers y_i = n_i . (u_s - sum_b P_ab u_b + sum_c (D_ac / D_aa) u_c), P = M / D; the
   other unknowns of the node are its tangential displacements (Hueber & Wohlmuth 2005, here for the normal
   component only). A tie treats all directions so. Held directions that are not axes turn their node's
   unknowns as well. All this is done to the hierarchical displacements u~ where there are any, and to those
   of eq. 3.5 on tri6 (couplings.h), and u = S u~ comes last. */
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
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

/* F^-1 of a 2 x 2 or 3 x 3 matrix by cofactors. [in] F - [dim][dim]; [out] Finv - [dim][dim] */
static void BasisChangeInvertFrame_Private(PetscInt dim, const PetscReal F[], PetscReal Finv[])
{
  if (dim == 2) {
    const PetscReal det = F[0] * F[3] - F[1] * F[2];
    Finv[0]             = F[3] / det;
    Finv[1]             = -F[1] / det;
    Finv[2]             = -F[2] / det;
    Finv[3]             = F[0] / det;
    return;
  }
  for (PetscInt i = 0; i < 3; i++) {
    const PetscInt i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (PetscInt j = 0; j < 3; j++) {
      const PetscInt j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      Finv[j * 3 + i] = F[i1 * 3 + j1] * F[i2 * 3 + j2] - F[i1 * 3 + j2] * F[i2 * 3 + j1];
    }
  }
  const PetscReal det = F[0] * Finv[0] + F[1] * Finv[3] + F[2] * Finv[6];
  for (PetscInt i = 0; i < 9; i++) Finv[i] /= det;
}

/* The axis that a unit vector lies along, or -1. */
static PetscInt BasisChangeFindAxis_Private(PetscInt dim, const PetscReal d[])
{
  for (PetscInt k = 0; k < dim; k++) {
    if (PetscAbsReal(d[k]) > 1 - PARALLEL) return k;
  }
  return -1;
}

/* Whether some held direction of a node is not an axis. */
static PetscBool BasisChangeIsObliquelyFixed_Private(const Support *held, PetscInt node)
{
  const PetscInt dim = held->dim;

  for (PetscInt j = 0; j < held->count[node]; j++) {
    if (BasisChangeFindAxis_Private(dim, &held->directions[(node * dim + j) * dim]) < 0) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Marks special nodes in of_node (0 special, -1 ordinary) and lists them. */
static PetscErrorCode NodeBasesListNodes_Private(VI vi, NodeBases *bases)
{
  const Level *level = vi->level;
  PetscInt     num   = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_owned, &bases->of_node));
  for (PetscInt i = 0; i < level->num_owned; i++)
    bases->of_node[i] = BasisChangeIsObliquelyFixed_Private(&vi->support, i) ? 0 : -1;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    for (PetscInt k = 0; k < vi->pairs[p]->num; k++) bases->of_node[vi->pairs[p]->nodes[k]] = 0;
  }
  for (PetscInt i = 0; i < level->num_owned; i++) {
    if (bases->of_node[i] == 0) bases->of_node[i] = num++;
  }
  bases->num = num;
  PetscCall(PetscMalloc3(num, &bases->node, num * level->dim * level->dim, &bases->F, num * level->dim * level->dim,
                         &bases->Finv));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    if (bases->of_node[i] >= 0) bases->node[bases->of_node[i]] = i;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a support fixes a node along a tangent: the node cannot slide, or needs no tie there. The support
   takes the tangential force. */
static PetscBool BasisChangeIsHeld_Private(const Support *held, PetscInt node, const PetscReal tangent[])
{
  const PetscInt dim = held->dim;

  for (PetscInt j = 0; j < held->count[node]; j++) {
    PetscReal dot = 0;

    for (PetscInt k = 0; k < dim; k++) dot += held->directions[(node * dim + j) * dim + k] * tangent[k];
    if (PetscAbsReal(dot) > 1 - PARALLEL) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Enters one node of a pair: a row of B and of F per constrained direction.
   [in,out] used - rows of F already taken by constraints [bases->num] */
static void NodeBasesAddNode_Private(VI vi, NodeBases *bases, PetscInt p, PetscInt k, PetscInt used[], PetscInt *row)
{
  const Pair      pair = vi->pairs[p];
  const PetscInt  dim = vi->level->dim, node = pair->nodes[k], s = bases->of_node[node];
  const PetscInt  num    = pair->spec->type == PAIR_TIED || ScenePairHasFriction(pair->spec) ? dim : 1;
  PetscReal      *F      = &bases->F[s * dim * dim];
  const PetscReal weight = pair->D[k] * vi->scene->thickness;

  if (used[s] == 0) {
    for (PetscInt i = 0; i < dim * dim; i++) F[i] = pair->frame[k * dim * dim + i];
  } else { // a second constraint takes the place of the first tangent
    for (PetscInt i = 0; i < dim; i++) F[used[s] * dim + i] = pair->normal[k * dim + i];
  }
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt unknown = used[s]++;

    if (i && BasisChangeIsHeld_Private(&vi->support, node, &F[unknown * dim])) continue;
    vi->row_pair[*row]      = p;
    vi->row_node[*row]      = k;
    vi->row_direction[*row] = i;
    vi->row_dof[*row]       = dim * (vi->level->node_begin + node) + unknown;
    vi->row_D[(*row)++]     = weight;
  }
}

/* The last direction of a node in 3D with two constraints: across both normals. */
static void NodeBasesCompleteFrame_Private(PetscInt dim, PetscInt used, PetscReal F[])
{
  if (dim < 3 || used != 2) return;
  VectorCross(F, &F[3], &F[6]);
  FrameNormalize(3, &F[6]);
}

PetscErrorCode NodeBasesCreate(VI vi, NodeBases *bases)
{
  const PetscInt dim = vi->level->dim;
  PetscInt      *used, row = 0, most = 0;

  PetscFunctionBeginUser;
  PetscCall(NodeBasesListNodes_Private(vi, bases));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const ScenePair *spec = vi->pairs[p]->spec;

    most += vi->pairs[p]->num * (spec->type == PAIR_TIED || ScenePairHasFriction(spec) ? dim : 1);
  }
  PetscCall(PetscMalloc5(most, &vi->row_pair, most, &vi->row_node, most, &vi->row_direction, most, &vi->row_dof, most,
                         &vi->row_D));
  PetscCall(PetscCalloc1(bases->num, &used));
  for (PetscInt s = 0; s < bases->num; s++) { // oblique supports; pairs overwrite theirs
    PetscCall(PetscArraycpy(&bases->F[s * dim * dim], &vi->support.directions[bases->node[s] * dim * dim], dim * dim));
  }
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    for (PetscInt k = 0; k < vi->pairs[p]->num; k++) NodeBasesAddNode_Private(vi, bases, p, k, used, &row);
  }
  vi->num_rows = row;
  for (PetscInt s = 0; s < bases->num; s++) {
    NodeBasesCompleteFrame_Private(dim, used[s], &bases->F[s * dim * dim]);
    BasisChangeInvertFrame_Private(dim, &bases->F[s * dim * dim], &bases->Finv[s * dim * dim]);
  }
  PetscCall(PetscFree(used));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodeBasesDestroy(NodeBases *bases)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(bases->of_node));
  PetscCall(PetscFree3(bases->node, bases->F, bases->Finv));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds R - 1, which is F^-1 - 1 at special nodes. */
static PetscErrorCode BasisChangeAddR_Private(VI vi, const NodeBases *bases, Mat X)
{
  const PetscInt dim = vi->level->dim;

  PetscFunctionBeginUser;
  for (PetscInt s = 0; s < bases->num; s++) {
    const PetscInt first = dim * (vi->level->node_begin + bases->node[s]);

    for (PetscInt e = 0; e < dim * dim; e++) {
      const PetscReal value = bases->Finv[s * dim * dim + e] - (e / dim == e % dim ? 1 : 0);

      if (value != 0) PetscCall(MatSetValue(X, first + e / dim, first + e % dim, value, ADD_VALUES));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds -(1/D) F^-1_(.,i) (x) F_i for every entry of row `node` of a node x node matrix. */
static PetscErrorCode BasisChangeAddCoupling_Private(VI vi, const NodeBases *bases, Mat C, PetscInt row, Mat E)
{
  const Pair         pair = vi->pairs[vi->row_pair[row]];
  const PetscInt     dim = vi->level->dim, k = vi->row_node[row], i = vi->row_dof[row] % dim;
  const PetscInt     s = bases->of_node[pair->nodes[k]], block = vi->level->node_begin + pair->nodes[k];
  const PetscReal   *F = &bases->F[s * dim * dim], *Finv = &bases->Finv[s * dim * dim];
  PetscInt           num;
  const PetscInt    *columns;
  const PetscScalar *values;
  PetscScalar        Eb[9];

  PetscFunctionBeginUser;
  PetscCall(MatGetRow(C, block, &num, &columns, &values));
  for (PetscInt c = 0; c < num; c++) {
    const PetscReal coefficient = -PetscRealPart(values[c]) / pair->D[k];
    for (PetscInt j = 0; j < dim; j++) {
      for (PetscInt l = 0; l < dim; l++) Eb[j * dim + l] = coefficient * Finv[j * dim + i] * F[i * dim + l];
    }
    PetscCall(MatSetValuesBlocked(E, 1, &block, 1, &columns[c], Eb, ADD_VALUES));
  }
  PetscCall(MatRestoreRow(C, block, &num, &columns, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Entries of a node's rows of E, over all its constraints. [out] nnz - blocks per owned node [num_owned] */
static PetscErrorCode BasisChangeCountE_Private(VI vi, const Couplings *couplings, PetscInt nnz[])
{
  const PetscInt dim = vi->level->dim;
  PetscInt       num;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(nnz, vi->level->num_owned));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    for (PetscInt k = 0; couplings->basis[p] && k < vi->pairs[p]->num; k++) {
      const PetscInt node = vi->pairs[p]->nodes[k];
      PetscCall(MatGetRow(couplings->basis[p], vi->level->node_begin + node, &num, NULL, NULL));
      nnz[node] += num;
      PetscCall(MatRestoreRow(couplings->basis[p], vi->level->node_begin + node, &num, NULL, NULL));
      PetscCall(PairArmsCount(couplings->arm[p], dim, vi->level->node_begin + node, &num));
      nnz[node] += num;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A sum of R - 1 and E, what other displacements contribute to u~ at special nodes. Other rows are empty. */
static PetscErrorCode BasisChangeCreateSum_Private(VI vi, const NodeBases *bases, const Couplings *couplings,
                                                   PetscBool with_R, PetscBool with_E, Mat *sum)
{
  const PetscInt dim = vi->level->dim, n = vi->level->num_owned, rest = vi->level->num_global - n;
  PetscInt      *nnz, *d_nnz, *o_nnz;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(n, &nnz, n * dim, &d_nnz, n * dim, &o_nnz));
  if (with_E) PetscCall(BasisChangeCountE_Private(vi, couplings, nnz));
  for (PetscInt i = 0; i < n * dim; i++) {
    d_nnz[i] = dim * PetscMin(nnz[i / dim] + (with_R && bases->of_node[i / dim] >= 0 ? 1 : 0), n);
    o_nnz[i] = dim * PetscMin(nnz[i / dim], rest);
  }
  PetscCall(MatCreateAIJ(vi->level->comm, n * dim, n * dim, PETSC_DETERMINE, PETSC_DETERMINE, 0, d_nnz, 0, o_nnz, sum));
  PetscCall(MatSetBlockSize(*sum, dim));
  PetscCall(PetscFree3(nnz, d_nnz, o_nnz));
  if (with_R) PetscCall(BasisChangeAddR_Private(vi, bases, *sum));
  for (PetscInt r = 0; r < (with_E ? vi->num_rows : 0); r++) {
    const Mat C = couplings->basis[vi->row_pair[r]];
    if (C) PetscCall(BasisChangeAddCoupling_Private(vi, bases, C, r, *sum));
    PetscCall(PairArmsAddToE(vi, bases, couplings->arm[vi->row_pair[r]], r, *sum));
  }
  PetscCall(MatAssemblyBegin(*sum, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*sum, MAT_FINAL_ASSEMBLY));
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

/* 1 + X <- (1 + E + E E + ..) (1 + X) */
static PetscErrorCode BasisChangeAddPowers_Private(VI vi, Mat E, Mat X)
{
  Mat       V, next;
  PetscReal norm;

  PetscFunctionBeginUser;
  PetscCall(MatMatMult(E, X, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &V));
  PetscCall(MatAXPY(V, 1.0, E, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatNorm(V, NORM_FROBENIUS, &norm));
  for (PetscInt power = 1; norm > NEGLIGIBLE_POWER; power++) {
    PetscCheck(power <= vi->num_pairs + REMOVED_POWERS, vi->level->comm, PETSC_ERR_PLIB,
               "The coupling of the pairs does not fade");
    PetscCall(MatAXPY(X, 1.0, V, DIFFERENT_NONZERO_PATTERN));
    PetscCall(MatMatMult(E, V, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &next));
    PetscCall(MatDestroy(&V));
    V = next;
    PetscCall(MatNorm(V, NORM_FROBENIUS, &norm));
  }
  PetscCall(MatDestroy(&V));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* 1 + X <- S (1 + X) */
static PetscErrorCode BasisChangeShift_Private(const Couplings *couplings, Mat X)
{
  Mat shifted;

  PetscFunctionBeginUser;
  if (!couplings->shift) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatMatMult(couplings->shift, X, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &shifted));
  PetscCall(MatAXPY(X, 1.0, shifted, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatAXPY(X, 1.0, couplings->shift, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&shifted));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* T = 1 + X without zeros. [out] T - owned by the caller */
static PetscErrorCode BasisChangeAddIdentity_Private(Mat X, Mat *T)
{
  PetscInt     begin, end, bs, num = 0, *start, *column;
  PetscScalar *value;
  MatInfo      info;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(X, &begin, &end));
  PetscCall(MatGetBlockSize(X, &bs));
  PetscCall(MatGetInfo(X, MAT_LOCAL, &info));
  PetscCall(PetscMalloc1(end - begin + 1, &start));
  PetscCall(PetscMalloc2((PetscInt)info.nz_used + end - begin, &column, (PetscInt)info.nz_used + end - begin, &value));
  start[0] = 0;
  for (PetscInt row = begin; row < end; row++) {
    PetscScalar        own = 1;
    PetscInt           size;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(X, row, &size, &columns, &values));
    for (PetscInt c = 0; c < size; c++) {
      if (columns[c] == row) {
        own += values[c];
      } else if (values[c] != 0) {
        column[num]  = columns[c];
        value[num++] = values[c];
      }
    }
    PetscCall(MatRestoreRow(X, row, &size, &columns, &values));
    column[num]            = row;
    value[num++]           = own;
    start[row - begin + 1] = num;
  }
  PetscCall(CSRMatrixCreate(PetscObjectComm((PetscObject)X),
                            &(CSRRows){bs, end - begin, end - begin, start, column, value}, T));
  PetscCall(PetscFree(start));
  PetscCall(PetscFree2(column, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Roundoff of F F^-1. */
static const PetscReal ROUNDOFF = 1e-14;

/* C of 1 + X = R (1 + C): F (1 + X) = 1 + C at each node.
   [in] X - without S; [out] C - owned by the caller */
static PetscErrorCode BasisChangeCreateC_Private(VI vi, const NodeBases *bases, Mat X, Mat *C)
{
  const PetscInt     dim = vi->level->dim, first = dim * vi->level->node_begin;
  PetscInt          *nnz, num, n, N;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(X, &n, NULL));
  PetscCall(MatGetSize(X, &N, NULL));
  PetscCall(PetscCalloc1(n, &nnz));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    for (PetscInt k = 0, row = vi->row_dof[r] - vi->row_dof[r] % dim; k < dim; k++) {
      PetscCall(MatGetRow(X, row + k, &num, NULL, NULL));
      nnz[vi->row_dof[r] - first] += num;
      PetscCall(MatRestoreRow(X, row + k, &num, NULL, NULL));
    }
  }
  PetscCall(MatCreate(vi->level->comm, C));
  PetscCall(MatSetSizes(*C, n, n, N, N));
  PetscCall(MatSetType(*C, MATAIJ));
  PetscCall(MatXAIJSetPreallocation(*C, 1, nnz, nnz, NULL, NULL));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt   row = vi->row_dof[r], begin = row - row % dim;
    const PetscReal *F = &bases->F[(bases->of_node[(begin - first) / dim] * dim + row % dim) * dim];

    PetscReal own[3] = {0, 0, 0};

    own[row % dim] = -1;
    for (PetscInt k = 0; k < dim; k++) {
      own[k] += F[k];
      PetscCall(MatGetRow(X, begin + k, &num, &columns, &values));
      for (PetscInt c = 0; c < num; c++) {
        if (columns[c] >= begin && columns[c] < begin + dim)
          own[columns[c] - begin] += F[k] * PetscRealPart(values[c]);
        else if (F[k] * values[c] != 0)
          PetscCall(MatSetValue(*C, row, columns[c], F[k] * values[c], ADD_VALUES));
      }
      PetscCall(MatRestoreRow(X, begin + k, &num, &columns, &values));
    }
    for (PetscInt k = 0; k < dim; k++)
      if (PetscAbsReal(own[k]) > ROUNDOFF) PetscCall(MatSetValue(*C, row, begin + k, own[k], ADD_VALUES));
  }
  PetscCall(PetscFree(nnz));
  PetscCall(MatAssemblyBegin(*C, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*C, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisChangeCreate(VI vi, const NodeBases *bases, const Couplings *couplings, BasisChange *change)
{
  Mat       E, C, X, local;
  PetscBool chained;
  PetscInt  special = bases->num;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(change, 1));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &special, 1, MPIU_INT, MPI_SUM, vi->level->comm));
  if (special == 0 && !couplings->shift) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(BasisChangeIsChained_Private(vi, bases, couplings, &chained));
  PetscCall(BasisChangeCreateSum_Private(vi, bases, couplings, PETSC_TRUE, (PetscBool)!chained, &X));
  if (chained) {
    PetscCall(BasisChangeCreateSum_Private(vi, bases, couplings, PETSC_FALSE, PETSC_TRUE, &E));
    PetscCall(BasisChangeAddPowers_Private(vi, E, X));
    PetscCall(MatDestroy(&E));
  }
  PetscCall(BasisChangeCreateC_Private(vi, bases, X, &C));
  PetscCall(BasisFactorCreate(C, &change->factor[1]));
  PetscCall(MatDestroy(&C));
  PetscCall(BasisChangeShift_Private(couplings, X));
  PetscCall(BasisChangeAddIdentity_Private(X, &change->T));
  PetscCall(MatDestroy(&X));
  PetscCall(BasisChangeCreateSum_Private(vi, bases, couplings, PETSC_TRUE, PETSC_FALSE, &local));
  PetscCall(BasisChangeShift_Private(couplings, local));
  PetscCall(BasisFactorCreate(local, &change->factor[0]));
  PetscCall(MatDestroy(&local));
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
