/* fields.c -- fields in the user's units from the unknowns y of the inequality.

   Pressures at open nodes are left as computed (roundoff, not 0): the certificate has to judge the numbers
   that are given out. Whether a node is in contact is therefore a decision with a tolerance, taken here once
   for all outputs. */
#include "result/estimate.h"
#include "result/fields.h"
#include "result/frictionfields.h"
#include "base/compat.h"
#include "kernel/vector.h"
#include "problem/eigenstrain.h"

/* A bound counts as reached within this part of the largest unknown: pdas reaches it exactly, vinewtonrsls to
   its zero tolerance of 1e-12. */
static const PetscReal CLOSED_TOLERANCE = 1e-10;
/* A node presses if its pressure exceeds this part of the largest one. Below, touching without pressure (a
   tie) cannot be told from an open node. The same limit decides which contacts hold a floating body. */
static const PetscReal PRESSED_TOLERANCE = 1e-9;

/* A nonmortar side at rest may be the sum of two large motions, its own relative one and that of the mortar
   side. So bodies that a pair joins, directly or through others, share the largest displacement. */
static void FieldsShareLargest_Private(Scene scene, PetscReal body_max[])
{
  for (PetscInt round = 0; round < scene->num_pairs; round++) {
    for (PetscInt p = 0; p < scene->num_pairs; p++) {
      const PetscInt a = scene->pairs[p].nonmortar.body, b = scene->pairs[p].mortar.body;

      if (b >= 0) body_max[a] = body_max[b] = PetscMax(body_max[a], body_max[b]);
    }
  }
}

/* Stiffness of the owned nodes and the largest displacement of each body. Where slip counts from an earlier
   displacement, that is one, too: a body that was let go has the roundoff of both. */
static PetscErrorCode FieldsSetNodeScales_Private(Fields fields)
{
  const Level     *level = fields->vi->level;
  const PetscInt   dim = level->dim, num_bodies = fields->vi->scene->num_bodies;
  const Vec        from = fields->vi->slip_from ? fields->vi->slip_from : fields->u;
  const PetscReal *d, *u, *old;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(level->num_owned, &fields->stiffness, num_bodies, &fields->body_max));
  PetscCall(VecGetArrayRead(fields->vi->diagonal, &d));
  PetscCall(VecGetArrayRead(fields->u, &u));
  PetscCall(VecGetArrayRead(from, &old));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    PetscReal *largest = &fields->body_max[level->node_body[a]];

    for (PetscInt k = 0; k < dim; k++) {
      fields->stiffness[a] += d[a * dim + k] / dim;
      *largest = PetscMax(*largest, PetscMax(PetscAbsReal(u[a * dim + k]), PetscAbsReal(old[a * dim + k])));
    }
  }
  PetscCall(VecRestoreArrayRead(from, &old));
  PetscCall(VecRestoreArrayRead(fields->u, &u));
  PetscCall(VecRestoreArrayRead(fields->vi->diagonal, &d));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, fields->body_max, (PetscMPIInt)num_bodies, MPIU_REAL, MPI_MAX, level->comm));
  FieldsShareLargest_Private(fields->vi->scene, fields->body_max);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What the rows of a tie take over from held nodes in their own direction, F_i' sum_c w_ac Pi_c F_i s_c with
   s_c = D_cc v_c + (D_other v)_c. [in] values - v, one per node; [in] others - D_other v;
   [in,out] passed - increased [num_rows] */
static PetscErrorCode FieldsAddPassed_Private(VI vi, PetscInt p, Vec values, Vec others, PetscReal passed[])
{
  const Pair       pair = vi->pairs[p];
  const PetscInt   dim  = vi->level->dim;
  const PetscReal *v, *other, *got;
  PetscReal       *given;
  Vec              from, to;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(pair->passed, &from, &to));
  PetscCall(VecGetArrayRead(values, &v));
  PetscCall(VecGetArrayRead(others, &other));
  for (PetscInt l = 0; l < dim; l++) {
    PetscCall(VecZeroEntries(from));
    PetscCall(VecGetArray(from, &given));
    for (PetscInt a = 0; a < pair->num; a++)
      given[dim * pair->nodes[a] + l] = pair->D[a] * v[pair->nodes[a]] + other[pair->nodes[a]];
    PetscCall(VecRestoreArray(from, &given));
    PetscCall(MatMult(pair->passed, from, to));
    PetscCall(VecGetArrayRead(to, &got));
    for (PetscInt r = 0; r < vi->num_rows; r++) {
      const PetscInt   a = vi->row_node[r];
      const PetscReal *F = &pair->frame[(a * dim + vi->row_direction[r]) * dim];

      if (vi->row_pair[r] == p) passed[r] += VectorDot(dim, F, &got[dim * pair->nodes[a]]) * F[l];
    }
    PetscCall(VecRestoreArrayRead(to, &got));
  }
  PetscCall(VecRestoreArrayRead(others, &other));
  PetscCall(VecRestoreArrayRead(values, &v));
  PetscCall(VecDestroy(&from));
  PetscCall(VecDestroy(&to));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Of all rows of one pair, by the ratio to D_aa, so that a thickness in row_D is kept. [in] moment - which
   moment: 0 for 1, k + 1 for x_k */
static PetscErrorCode FieldsAddPairMoment_Private(Fields fields, PetscInt p, PetscInt moment)
{
  const VI         vi     = fields->vi;
  const Pair       pair   = vi->pairs[p];
  const PetscInt   dim    = vi->level->dim;
  const PetscReal *coords = vi->level->coords, *taken = NULL, *own;
  PetscReal       *value, *passed                     = NULL;
  Vec              values, sums, moved;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(vi->level, 1, &values));
  PetscCall(VecDuplicate(values, &sums));
  PetscCall(VecZeroEntries(sums));
  PetscCall(VecGetArray(values, &value));
  for (PetscInt c = 0; c < vi->level->num_owned; c++) value[c] = moment ? coords[c * dim + moment - 1] : 1.0;
  PetscCall(VecRestoreArray(values, &value));
  if (pair->from_nodal) { /* D and the chain are written for u~ = u + from_nodal u */
    PetscCall(VecDuplicate(values, &moved));
    PetscCall(MatMult(pair->from_nodal, values, moved));
    PetscCall(VecAXPY(values, 1.0, moved));
    PetscCall(VecDestroy(&moved));
  }
  if (pair->D_other) PetscCall(MatMult(pair->D_other, values, sums));
  if (pair->passed) {
    PetscCall(PetscCalloc1(vi->num_rows, &passed));
    PetscCall(FieldsAddPassed_Private(vi, p, values, sums, passed));
  }
  if (pair->D_other) PetscCall(VecGetArrayRead(sums, &taken));
  PetscCall(VecGetArrayRead(values, &own));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt a = vi->row_node[r];
    PetscReal      sum;

    if (vi->row_pair[r] != p) continue;
    sum = own[pair->nodes[a]];
    if (taken) sum += taken[pair->nodes[a]] / pair->D[a];
    if (passed) sum += passed[r] / pair->D[a];
    *(moment ? &fields->row_moment[r * dim + moment - 1] : &fields->row_weight[r]) = vi->row_D[r] * sum;
  }
  PetscCall(VecRestoreArrayRead(values, &own));
  if (taken) PetscCall(VecRestoreArrayRead(sums, &taken));
  PetscCall(PetscFree(passed));
  PetscCall(VecDestroy(&values));
  PetscCall(VecDestroy(&sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* int psi_a (1, x) = D_aa (1, x_a) + sum_c D_ac (1, x_c): the dual functions of removed nodes c were given to
   their neighbours. With them went their share of the side. */
static PetscErrorCode FieldsSetRowMoments_Private(Fields fields)
{
  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < fields->vi->num_pairs; p++) {
    for (PetscInt moment = 0; moment <= fields->vi->level->dim; moment++) {
      PetscCall(FieldsAddPairMoment_Private(fields, p, moment));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* u_ref = max(|u|, |B u / D|, |gap|): with absolute displacements, since relative ones vanish in full contact
   and leave roundoff to be compared with roundoff. p_ref = max(|p|, sum |f| / sum D): with the loads, since
   all p may be roundoff. */
static PetscErrorCode FieldsSetReferenceSizes_Private(Fields fields)
{
  const VI         vi      = fields->vi;
  PetscReal        sums[2] = {0, 0}, sizes[2] = {0, 0};
  const PetscReal *f;
  PetscInt         n;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < vi->scene->num_bodies; b++) sizes[0] = PetscMax(sizes[0], fields->body_max[b]);
  PetscCall(VecGetLocalSize(vi->f, &n));
  PetscCall(VecGetArrayRead(vi->f, &f));
  for (PetscInt i = 0; i < n; i++) sums[0] += PetscAbsReal(f[i]);
  PetscCall(VecRestoreArrayRead(vi->f, &f));
  if (fields->lambda) {
    const PetscReal *lambda, *slack, *G;

    PetscCall(VecGetArrayRead(fields->lambda, &lambda));
    PetscCall(VecGetArrayRead(fields->slack, &slack));
    PetscCall(VecGetArrayRead(vi->G, &G));
    for (PetscInt r = 0; r < vi->num_rows; r++) {
      const PetscReal gap = G[r] / vi->row_D[r];

      sums[1] += vi->row_D[r];
      sizes[0] = PetscMax(sizes[0], PetscMax(PetscAbsReal(gap), PetscAbsReal(gap - slack[r])));
      sizes[1] = PetscMax(sizes[1], PetscAbsReal(lambda[r]));
    }
    PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
    PetscCall(VecRestoreArrayRead(fields->slack, &slack));
    PetscCall(VecRestoreArrayRead(vi->G, &G));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_REAL, MPI_SUM, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sizes, 2, MPIU_REAL, MPI_MAX, vi->level->comm));
  fields->u_ref = sizes[0];
  fields->p_ref = sums[1] > 0 ? PetscMax(sizes[1], sums[0] / sums[1]) : sizes[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Amplification of rounding by the arm of a tie: the sum of the terms of a node's displacement over its own
   size (eq. 5.4). */
static PetscErrorCode FieldsGetArmSize_Private(const Pair pair, PetscInt k, PetscReal *size)
{
  const PetscInt     dim = pair->level->dim, first = dim * (pair->level->node_begin + pair->nodes[k]);
  PetscInt           num;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  *size = 0;
  for (PetscInt i = 0; pair->arm && i < dim; i++) {
    PetscCall(MatGetRow(pair->arm, first + i, &num, NULL, &values));
    for (PetscInt c = 0; c < num; c++) *size += PetscAbsScalar(values[c]) / pair->D[k];
    PetscCall(MatRestoreRow(pair->arm, first + i, &num, NULL, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A node is in contact if it lies on its bound and presses by more than roundoff. Rigid motions of free
   bodies after the solve do not count. */
static PetscErrorCode FieldsSetRowStatus_Private(Fields fields, PetscReal slip, Vec y)
{
  const VI         vi = fields->vi;
  const PetscReal *lambda, *values, *upper;
  PetscReal        tolerance, arm;
  PetscInt         begin;

  PetscFunctionBeginUser;
  PetscCall(VecNorm(y, NORM_INFINITY, &tolerance));
  tolerance = CLOSED_TOLERANCE * tolerance + slip / vi->length;
  PetscCall(VecGetOwnershipRange(y, &begin, NULL));
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  PetscCall(VecGetArrayRead(y, &values));
  PetscCall(VecGetArrayRead(vi->upper, &upper));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const Pair      pair = vi->pairs[vi->row_pair[r]];
    const PetscInt  node = pair->nodes[vi->row_node[r]], i = vi->row_dof[r] - begin;
    const PetscReal force = fields->stiffness[node] * fields->body_max[vi->level->node_body[node]];

    PetscCall(FieldsGetArmSize_Private(pair, vi->row_node[r], &arm));
    fields->row_noise[r] = FIELDS_ROUNDOFF * (1 + arm) * force / vi->row_D[r];
    if (pair->spec->type == PAIR_TIED) {
      fields->row_status[r] = STATUS_TIED;
    } else {
      const PetscBool closed  = (PetscBool)(values[i] >= upper[i] - tolerance);
      const PetscBool pressed = (PetscBool)(lambda[r] > PRESSED_TOLERANCE * fields->p_ref + fields->row_noise[r]);

      fields->row_status[r] = closed && pressed ? STATUS_CONTACT : STATUS_OPEN;
    }
  }
  PetscCall(VecRestoreArrayRead(vi->upper, &upper));
  PetscCall(VecRestoreArrayRead(y, &values));
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldsCreate(VI vi, Solvability solvability, Vec y, Fields *fields)
{
  Fields f;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&f));
  f->vi = vi;
  PetscCall(LevelCreateVec(vi->level, vi->level->dim, &f->u));
  PetscCall(VIRecoverDisplacement(vi, y, f->u));
  PetscCall(StressCreate(vi->scene, vi->level, f->u, &f->stress));
  PetscCall(FieldsSetNodeScales_Private(f));
  if (vi->B) {
    PetscReal *slack;

    PetscCall(VecDuplicate(vi->G, &f->lambda));
    PetscCall(VecDuplicate(vi->G, &f->slack));
    PetscCall(VIRecoverMultiplier(vi, f->u, f->lambda));
    PetscCall(MatMult(vi->B, f->u, f->slack));
    PetscCall(VecAYPX(f->slack, -1.0, vi->G));
    PetscCall(VecGetArray(f->slack, &slack));
    for (PetscInt r = 0; r < vi->num_rows; r++) slack[r] /= vi->row_D[r];
    PetscCall(VecRestoreArray(f->slack, &slack));
    PetscCall(PetscCalloc4(vi->num_rows, &f->row_weight, vi->num_rows * vi->level->dim, &f->row_moment, vi->num_rows,
                           &f->row_noise, vi->num_rows, &f->row_status));
    PetscCall(FieldsSetRowMoments_Private(f));
  }
  PetscCall(FieldsSetReferenceSizes_Private(f));
  if (vi->B) PetscCall(FieldsSetRowStatus_Private(f, solvability ? solvability->slip : 0, y));
  PetscCall(FrictionFieldsSetStatus(f));
  *fields = f;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldsDestroy(Fields *fields)
{
  PetscFunctionBeginUser;
  if (!*fields) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDestroy(&(*fields)->u));
  PetscCall(VecDestroy(&(*fields)->lambda));
  PetscCall(VecDestroy(&(*fields)->slack));
  PetscCall(NodalStressDestroy(&(*fields)->stress));
  PetscCall(PetscFree2((*fields)->stiffness, (*fields)->body_max));
  PetscCall(PetscFree((*fields)->validity));
  PetscCall(EstimateDestroy(&(*fields)->estimate));
  PetscCall(PetscFree((*fields)->side_errors));
  PetscCall(PetscFree4((*fields)->row_weight, (*fields)->row_moment, (*fields)->row_noise, (*fields)->row_status));
  PetscCall(PetscFree(*fields));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FieldsEnergy(Fields fields, PetscReal strain[], PetscReal *potential)
{
  const VI    vi = fields->vi;
  PetscScalar work;
  PetscReal   constant;

  PetscFunctionBeginUser;
  PetscCall(ElasticityBodyEnergy(vi->scene, vi->level, vi->K, fields->u, strain));
  PetscCall(VecDot(vi->f, fields->u, &work));
  *potential = -PetscRealPart(work);
  for (PetscInt b = 0; b < vi->scene->num_bodies; b++) *potential += strain[b];
  PetscCall(EigenstrainEnergy(vi->scene, vi->level, fields->u, strain, &constant)); // f has the work of eps_0
  *potential += constant;
  PetscFunctionReturn(PETSC_SUCCESS);
}
