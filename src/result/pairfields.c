/* pairfields.c -- rows of the inequality as values at the nodes of a nonmortar side. */
#include "contact/pairpoints.h"
#include "level/ghosted.h"
#include "result/fields.h"
#include "result/sidenodes.h"
#include "base/compat.h"

/* Values at removed nodes. Their dual functions were added to those of neighbours a with weights w_ac, D_ac =
   w_ac D_cc. Hence the discrete multiplier is the weighted mean of the neighbours': p_c = sum_a D_ac p_a /
   sum_a D_ac. [in,out] nodal - [num_owned];
   [in,out] covered - [num_owned] */
static PetscErrorCode PairFieldsExtend_Private(const Pair pair, PetscReal nodal[], PetscBool covered[])
{
  Vec              rows, sums[2];
  PetscReal       *value;
  const PetscReal *sum[2];
  PetscInt         n;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(pair->D_other, &sums[0], &rows));
  PetscCall(VecDuplicate(sums[0], &sums[1]));
  for (PetscInt i = 0; i < 2; i++) {
    PetscCall(VecZeroEntries(rows));
    PetscCall(VecGetArray(rows, &value));
    for (PetscInt a = 0; a < pair->num; a++) value[pair->nodes[a]] = i == 0 ? nodal[pair->nodes[a]] : 1.0;
    PetscCall(VecRestoreArray(rows, &value));
    PetscCall(MatMultTranspose(pair->D_other, rows, sums[i]));
  }
  PetscCall(VecGetLocalSize(sums[0], &n));
  PetscCall(VecGetArrayRead(sums[0], &sum[0]));
  PetscCall(VecGetArrayRead(sums[1], &sum[1]));
  for (PetscInt c = 0; c < n; c++) {
    if (sum[1][c] == 0) continue; /* int phi_c may be negative on a part of a quadratic facet */
    nodal[c]   = sum[0][c] / sum[1][c];
    covered[c] = PETSC_TRUE;
  }
  PetscCall(VecRestoreArrayRead(sums[0], &sum[0]));
  PetscCall(VecRestoreArrayRead(sums[1], &sum[1]));
  PetscCall(VecDestroy(&rows));
  PetscCall(VecDestroy(&sums[0]));
  PetscCall(VecDestroy(&sums[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Where only vertices carry multipliers, what is given out is linear between them: in the middle of a facet
   the mean of its ends. [in,out] nodal, covered - [num_owned] */
static PetscErrorCode PairFieldsInterpolate_Private(const Pair pair, PetscReal nodal[], PetscBool covered[])
{
  const PetscInt   begin = pair->level->node_begin;
  Vec              ends, middles;
  PetscReal       *value;
  const PetscReal *mean;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(pair->to_nodal, &ends, &middles));
  for (PetscInt i = 0; i < 2; i++) { /* the value, and whether there is any */
    PetscCall(VecGetArray(ends, &value));
    for (PetscInt a = 0; a < pair->level->num_owned; a++) value[a] = i == 0 ? nodal[a] : covered[a];
    PetscCall(VecRestoreArray(ends, &value));
    PetscCall(MatMult(pair->to_nodal, ends, middles));
    PetscCall(VecGetArrayRead(middles, &mean));
    for (PetscInt a = 0; a < pair->level->num_owned; a++) {
      PetscInt num;

      PetscCall(MatGetRow(pair->to_nodal, begin + a, &num, NULL, NULL));
      if (num && i == 0) nodal[a] = mean[a];
      if (num && i == 1) covered[a] = (PetscBool)(mean[a] > 0);
      PetscCall(MatRestoreRow(pair->to_nodal, begin + a, &num, NULL, NULL));
    }
    PetscCall(VecRestoreArrayRead(middles, &mean));
  }
  PetscCall(VecDestroy(&ends));
  PetscCall(VecDestroy(&middles));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks the nodes of a nonmortar side that hang. Collective. [out] hangs - freed by the caller [num_owned];
   NULL where no node of the mesh hangs */
static PetscErrorCode PairMarkHanging_Private(const Pair pair, PetscBool **hangs)
{
  Level        *level  = pair->level;
  const Facets *facets = &pair->points->facets;
  PetscInt      num, *nodes;

  PetscFunctionBeginUser;
  *hangs = NULL;
  if (!level->conforming) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1(level->num_owned + 1, hangs)); // not NULL where a rank has no nodes
  PetscCall(SideNodesCreate(level, facets, &num, &nodes));
  for (PetscInt i = 0; i < num; i++) (*hangs)[nodes[i]] = LevelNodeHangs(level, nodes[i]);
  PetscCall(PetscFree(nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Values at nodes that hang: those of the nodes that they hang on, interpolated. Collective. [in] hangs - of
   PairMarkHanging_Private(); [in,out] nodal - [num_owned] */
static PetscErrorCode PairFieldsHang_Private(Level *level, const PetscBool hangs[], PetscReal nodal[])
{
  PetscScalar *a;
  Vec          v;

  PetscFunctionBeginUser;
  if (!hangs) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelCreateVec(level, 1, &v));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt i = 0; i < level->num_owned; i++) a[i] = nodal[i];
  PetscCall(VecRestoreArray(v, &a));
  PetscCall(LevelConform(level, 1, v));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt i = 0; i < level->num_owned; i++)
    if (hangs[i]) nodal[i] = PetscRealPart(a[i]);
  PetscCall(VecRestoreArray(v, &a));
  PetscCall(VecDestroy(&v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairFieldsSpread(const Pair pair, PetscReal nodal[], PetscBool covered[])
{
  PetscBool *hangs;

  PetscFunctionBeginUser;
  if (pair->D_other) PetscCall(PairFieldsExtend_Private(pair, nodal, covered));
  if (pair->to_nodal && pair->spec->multipliers == MULTIPLIERS_VERTICES)
    PetscCall(PairFieldsInterpolate_Private(pair, nodal, covered));
  PetscCall(PairMarkHanging_Private(pair, &hangs));
  PetscCall(PairFieldsHang_Private(pair->level, hangs, nodal));
  PetscCall(PetscFree(hangs));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A node that hangs has the least status of those that it hangs on: no constraint, then open. It is covered
   if one of them is. Collective. [in,out] nodal - status and covered */
static PetscErrorCode PairFieldsHangStatus_Private(Level *level, const PetscBool hangs[], PairFields *nodal)
{
  const Hanging *hanging = &level->hanging;
  PetscScalar   *a;
  Vec            v;

  PetscFunctionBeginUser;
  if (!hangs) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelCreateVec(level, 2, &v));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    a[2 * i]     = (PetscReal)nodal->status[i];
    a[2 * i + 1] = nodal->covered[i] ? 1 : 0;
  }
  PetscCall(VecRestoreArray(v, &a));
  PetscCall(LevelShareVec(v, INSERT_VALUES));
  PetscCall(GhostedGetArray(v, &a));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    PetscReal least = STATUS_STICK;

    for (PetscInt k = hanging->start[i]; k < hanging->start[i + 1] && hangs[i]; k++) {
      least             = PetscMin(least, PetscRealPart(a[2 * hanging->node[k]]));
      nodal->covered[i] = (PetscBool)(nodal->covered[i] || PetscRealPart(a[2 * hanging->node[k] + 1]) > 0);
    }
    if (hangs[i]) nodal->status[i] = (PetscInt)least;
  }
  PetscCall(GhostedRestoreArray(v, &a));
  PetscCall(VecDestroy(&v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairFieldsCreate(Fields fields, PetscInt p, PairFields *nodal)
{
  const VI         vi   = fields->vi;
  const Pair       pair = vi->pairs[p];
  const PetscInt   n    = vi->level->num_owned;
  const PetscReal *lambda, *slack;
  PetscBool       *hangs;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc5(n, &nodal->pressure, n, &nodal->gap, n, &nodal->force, n, &nodal->status, n, &nodal->covered));
  for (PetscInt a = 0; a < n; a++) {
    nodal->gap[a]    = NAN;
    nodal->status[a] = STATUS_NONE;
  }
  if (!fields->lambda) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  PetscCall(VecGetArrayRead(fields->slack, &slack));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    PetscInt node;

    if (vi->row_pair[r] != p || vi->row_direction[r] != 0) continue;
    node                  = pair->nodes[vi->row_node[r]];
    nodal->pressure[node] = lambda[r];
    nodal->gap[node]      = slack[r] / pair->share[vi->row_node[r]];
    nodal->force[node]    = lambda[r] * fields->row_weight[r];
    nodal->status[node]   = fields->row_status[r];
    nodal->covered[node]  = PETSC_TRUE;
  }
  PetscCall(VecRestoreArrayRead(fields->slack, &slack));
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscCall(PairFieldsSpread(pair, nodal->pressure, nodal->covered));
  PetscCall(PairMarkHanging_Private(pair, &hangs));
  PetscCall(PairFieldsHang_Private(vi->level, hangs, nodal->gap));
  PetscCall(PairFieldsHangStatus_Private(vi->level, hangs, nodal));
  PetscCall(PetscFree(hangs));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void PairFieldsOmitBeyond(const Pair pair, PairFields *nodal)
{
  for (PetscInt i = 0; i < pair->num_beyond; i++) {
    nodal->pressure[pair->beyond[i]] = 0;
    nodal->covered[pair->beyond[i]]  = PETSC_FALSE;
  }
}

PetscErrorCode PairFieldsDestroy(PairFields *nodal)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree5(nodal->pressure, nodal->gap, nodal->force, nodal->status, nodal->covered));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Components in held directions: at held nodes c the mean of the nodes a that took their rows over,
   t_c += sum_a w_ac Pi_c t_a. [in,out] t - at the nodes of this rank, dim per node */
static PetscErrorCode PairTractionExtend_Private(const Pair pair, Vec t)
{
  Vec from, to;

  PetscFunctionBeginUser;
  if (!pair->passed) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatCreateVecs(pair->passed, &to, &from));
  PetscCall(VecCopy(t, from));
  PetscCall(MatMultTranspose(pair->passed, from, to));
  PetscCall(VecAXPY(t, 1.0, to));
  PetscCall(VecDestroy(&from));
  PetscCall(VecDestroy(&to));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairTractionCreate(Fields fields, PetscInt p, const PetscInt row_status[], Vec *traction)
{
  const VI         vi   = fields->vi;
  const Pair       pair = vi->pairs[p];
  const PetscInt   n = vi->level->num_owned, dim = vi->level->dim;
  PetscBool       *covered;
  PetscReal       *component;
  PetscScalar     *t;
  const PetscReal *lambda;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(vi->level, dim, traction));
  if (!fields->lambda) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc2(n, &component, n, &covered));
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  PetscCall(VecGetArray(*traction, &t));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt   a = vi->row_node[r];
    const PetscReal *d = &pair->frame[(a * dim + vi->row_direction[r]) * dim];

    if (vi->row_pair[r] != p || row_status[r] == STATUS_OPEN) continue;
    for (PetscInt k = 0; k < dim; k++) t[pair->nodes[a] * dim + k] += lambda[r] * d[k];
  }
  PetscCall(VecRestoreArray(*traction, &t));
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscCall(PairTractionExtend_Private(pair, *traction));
  PetscCall(VecGetArray(*traction, &t));
  for (PetscInt k = 0; k < dim; k++) {
    PetscCall(PetscArrayzero(covered, n));
    for (PetscInt a = 0; a < n; a++) component[a] = t[a * dim + k];
    for (PetscInt a = 0; a < pair->num; a++) covered[pair->nodes[a]] = PETSC_TRUE;
    PetscCall(PairFieldsSpread(pair, component, covered));
    for (PetscInt a = 0; a < n; a++) t[a * dim + k] = component[a];
  }
  PetscCall(VecRestoreArray(*traction, &t));
  PetscCall(PetscFree2(component, covered));
  PetscCall(LevelShareVec(*traction, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}
