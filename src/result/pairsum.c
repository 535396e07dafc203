/* pairsum.c -- force, area, extent and centre of pressure of one pair.

   With p_h = sum p_a psi_a: integral of p_h n = sum_a W_a p_a n_a, W_a = int psi_a = D_aa + sum_c D_ac. This
   is the sum of -B'lambda on the nonmortar body. By the row sums of D and M its negative acts on the mortar
   side. */
#include "kernel/vector.h"
#include "result/pairsum.h"
#include "result/largest.h"
#include "base/compat.h"

/* What is added over rows; what is maximised (minima by their negatives). */
enum { ADD_FORCE = 0, ADD_NORMAL = 3, ADD_AREA, ADD_CENTRE, ADD_ACTIVE = ADD_CENTRE + 3, ADD_COUNT };
enum { MAX_COVERED, MAX_CLOSED, MAX_LOWER, MAX_UPPER = MAX_LOWER + 3, MAX_COUNT = MAX_UPPER + 3 };

/* Where both sides end in the same place, their facets may cut corners of each other. At a round rim this is
   the sagitta of an edge, on coarse meshes a twelfth of a cell. Neither is then an edge that presses into the
   other. */
static const PetscReal RIM_SHARE = 0.1;

PetscBool PairSumEndsPartner(const Pair pair, PetscInt a)
{
  return (PetscBool)(pair->partly_covered[a] && pair->cover[a] < 1 - RIM_SHARE);
}

/* One row: tied tangential rows only have a force. [in,out] peak - the largest pressure, of the owner r */
static void PairSumAddRow_Private(Fields fields, PetscInt r, PetscReal lambda, PetscReal slack, PetscReal sums[],
                                  PetscReal largest[], Largest *peak)
{
  const VI         vi   = fields->vi;
  const Pair       pair = vi->pairs[vi->row_pair[r]];
  const PetscInt   dim = vi->level->dim, a = vi->row_node[r];
  const PetscReal *d      = &pair->frame[(a * dim + vi->row_direction[r]) * dim];
  const PetscReal *x      = &vi->level->coords[pair->nodes[a] * dim];
  const PetscReal  weight = fields->row_weight[r];

  for (PetscInt k = 0; k < dim; k++) sums[ADD_FORCE + k] -= lambda * weight * d[k];
  if (vi->row_direction[r] != 0) return;
  sums[ADD_NORMAL] += lambda * weight;
  for (PetscInt k = 0; k < dim; k++) sums[ADD_CENTRE + k] += lambda * fields->row_moment[r * dim + k];
  largest[MAX_CLOSED] = PetscMax(largest[MAX_CLOSED], -slack / pair->share[a]);
  if (fields->row_status[r] == STATUS_OPEN) return;
  if (lambda > 0) sums[ADD_AREA] += weight;
  sums[ADD_ACTIVE] += 1;
  LargestTake(peak, lambda, dim, x, (PetscReal)r);
  if (!PairSumEndsPartner(pair, a)) largest[MAX_COVERED] = PetscMax(largest[MAX_COVERED], lambda);
  for (PetscInt k = 0; k < dim; k++) {
    largest[MAX_LOWER + k] = PetscMax(largest[MAX_LOWER + k], -x[k]);
    largest[MAX_UPPER + k] = PetscMax(largest[MAX_UPPER + k], x[k]);
  }
}

/* Adds the weights |D_ac| of nodes c without a multiplier, separately for nodes a in contact and others.
   [in,out] weights - of closed and of open nodes a, at nodes c. Collective. */
static PetscErrorCode PairSumWeighTaken_Private(Fields fields, PetscInt p, const Vec weights[2])
{
  const VI           vi   = fields->vi;
  const Pair         pair = vi->pairs[p];
  PetscInt           num;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const Vec to = weights[fields->row_status[r] == STATUS_OPEN ? 1 : 0];
    PetscInt  row;

    if (vi->row_pair[r] != p || vi->row_direction[r]) continue;
    row = vi->level->node_begin + pair->nodes[vi->row_node[r]];
    PetscCall(MatGetRow(pair->D_other, row, &num, &columns, &values));
    for (PetscInt c = 0; c < num; c++) PetscCall(VecSetValue(to, columns[c], PetscAbsScalar(values[c]), ADD_VALUES));
    PetscCall(MatRestoreRow(pair->D_other, row, &num, &columns, &values));
  }
  for (PetscInt i = 0; i < 2; i++) PetscCall(VecAssemblyBegin(weights[i]));
  for (PetscInt i = 0; i < 2; i++) PetscCall(VecAssemblyEnd(weights[i]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Extends the contact by nodes whose rows only nodes in contact took over. Nodes beyond the partner's end are
   not among them. [in,out] largest - of this rank. Collective. */
static PetscErrorCode PairSumExtend_Private(Fields fields, PetscInt p, PetscReal largest[])
{
  const Level       *level = fields->vi->level;
  const Pair         pair  = fields->vi->pairs[p];
  PetscScalar       *closed;
  const PetscScalar *open;
  Vec                weights[2];

  PetscFunctionBeginUser;
  if (!pair->D_other) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt i = 0; i < 2; i++) PetscCall(MatCreateVecs(pair->D_other, &weights[i], NULL));
  PetscCall(PairSumWeighTaken_Private(fields, p, weights));
  PetscCall(VecGetArray(weights[0], &closed));
  PetscCall(VecGetArrayRead(weights[1], &open));
  for (PetscInt i = 0; i < pair->num_beyond; i++) closed[pair->beyond[i]] = 0;
  for (PetscInt c = 0; c < level->num_owned; c++) {
    for (PetscInt k = 0; PetscRealPart(closed[c]) > 0 && open[c] == 0.0 && k < level->dim; k++) {
      largest[MAX_LOWER + k] = PetscMax(largest[MAX_LOWER + k], -level->coords[c * level->dim + k]);
      largest[MAX_UPPER + k] = PetscMax(largest[MAX_UPPER + k], level->coords[c * level->dim + k]);
    }
  }
  PetscCall(VecRestoreArrayRead(weights[1], &open));
  PetscCall(VecRestoreArray(weights[0], &closed));
  for (PetscInt i = 0; i < 2; i++) PetscCall(VecDestroy(&weights[i]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The mean of the nodes with the weights |F|: what the forces of a tie act around, whose centre of pressure
   may be anywhere. */
static PetscErrorCode PairSumGetMiddle_Private(const Level *level, const PetscReal F[], PetscReal middle[3])
{
  PetscReal sums[4] = {0, 0, 0, 0};

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < level->num_owned; a++) {
    const PetscReal size = VectorNorm(level->dim, &F[a * level->dim]);

    for (PetscInt k = 0; k < level->dim; k++) sums[k] += size * level->coords[a * level->dim + k];
    sums[3] += size;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPIU_REAL, MPI_SUM, level->comm));
  for (PetscInt k = 0; k < 3; k++) middle[k] = sums[3] > 0 ? sums[k] / sums[3] : 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* B'lambda of one pair alone: the forces at the nodes of both sides. [out] force - owned by the caller */
static PetscErrorCode PairSumCreateForces_Private(Fields fields, PetscInt p, Vec *force)
{
  const VI   vi = fields->vi;
  Vec        lambda;
  PetscReal *l;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(fields->lambda, &lambda));
  PetscCall(VecDuplicate(fields->u, force));
  PetscCall(VecCopy(fields->lambda, lambda));
  PetscCall(VecGetArray(lambda, &l));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (vi->row_pair[r] != p) l[r] = 0.0;
  }
  PetscCall(VecRestoreArray(lambda, &l));
  PetscCall(MatMultTranspose(vi->B, lambda, *force));
  PetscCall(VecDestroy(&lambda));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The force of a tie with rows that held nodes passed on: they act in other directions than the row's own. */
static PetscErrorCode PairSumSetTieForce_Private(Fields fields, PetscInt p, PairSum *sum)
{
  const Level     *level     = fields->vi->level;
  const PetscInt   dim       = level->dim;
  PetscReal        forces[3] = {0, 0, 0};
  const PetscReal *F;
  Vec              force;

  PetscFunctionBeginUser;
  if (!fields->vi->pairs[p]->passed) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PairSumCreateForces_Private(fields, p, &force));
  PetscCall(VecGetArrayRead(force, &F));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    if (level->node_body[a] != fields->vi->scene->pairs[p].nonmortar.body) continue;
    for (PetscInt k = 0; k < dim; k++) forces[k] -= F[a * dim + k];
  }
  PetscCall(VecRestoreArrayRead(force, &F));
  PetscCall(VecDestroy(&force));
  PetscCallMPI(MPI_Allreduce(forces, sum->force, 3, MPIU_REAL, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* |sum x cross F| / sum |x||F| over the nodes of both sides, F = B'lambda of this pair alone. x counts from
   the centre of pressure, or from the middle of a tie. The value is 0 for ties, and on flat or touching
   sides, where the points of both sides are the same. */
static PetscErrorCode PairSumGetMomentImbalance_Private(Fields fields, PetscInt p, PairSum *sum)
{
  const VI         vi      = fields->vi;
  const PetscInt   dim     = vi->level->dim;
  PetscReal        sums[4] = {0, 0, 0, 0}, centre[3];
  const PetscReal *F;
  Vec              force;

  PetscFunctionBeginUser;
  sum->moment_imbalance = NAN;
  if (vi->pairs[p]->spec->obstacle.kind != OBSTACLE_NONE || !sum->active) PetscFunctionReturn(PETSC_SUCCESS);
  if (vi->scene->model == MODEL_AXISYMMETRIC) PetscFunctionReturn(PETSC_SUCCESS); /* 0 by symmetry, nothing to judge */
  PetscCall(PairSumCreateForces_Private(fields, p, &force));
  PetscCall(VecGetArrayRead(force, &F));
  PetscCall(PetscArraycpy(centre, sum->centre, 3));
  if (vi->pairs[p]->spec->type == PAIR_TIED) PetscCall(PairSumGetMiddle_Private(vi->level, F, centre));
  for (PetscInt a = 0; a < vi->level->num_owned; a++) {
    PetscReal x[3] = {0, 0, 0}, f[3] = {0, 0, 0}, moment[3];

    for (PetscInt k = 0; k < dim; k++) {
      x[k] = vi->level->coords[a * dim + k] - centre[k];
      f[k] = F[a * dim + k];
    }
    VectorCross(x, f, moment);
    for (PetscInt k = 0; k < 3; k++) sums[k] += moment[k];
    sums[3] += VectorNorm(3, x) * VectorNorm(3, f);
  }
  PetscCall(VecRestoreArrayRead(force, &F));
  PetscCall(VecDestroy(&force));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPIU_REAL, MPI_SUM, vi->level->comm));
  sum->moment_imbalance = VectorNorm(3, sums) / sums[3];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairSumCompute(Fields fields, PetscInt p, PairSum *sum)
{
  const VI         vi              = fields->vi;
  PetscReal        sums[ADD_COUNT] = {0}, largest[MAX_COUNT];
  const PetscReal *lambda = NULL, *slack = NULL;
  Largest          peak  = {.value = -PETSC_MAX_REAL, .at = {NAN, NAN, NAN}, .owner = -1};
  PetscInt         begin = 0;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < MAX_COUNT; i++) largest[i] = PETSC_NINFINITY;
  if (fields->lambda) {
    PetscCall(VecGetOwnershipRange(fields->lambda, &begin, NULL));
    PetscCall(VecGetArrayRead(fields->lambda, &lambda));
    PetscCall(VecGetArrayRead(fields->slack, &slack));
  }
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (vi->row_pair[r] == p) PairSumAddRow_Private(fields, r, lambda[r], slack[r], sums, largest, &peak);
  }
  if (peak.owner >= 0) peak.owner += (PetscReal)begin;
  if (fields->lambda) PetscCall(PairSumExtend_Private(fields, p, largest));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, ADD_COUNT, MPIU_REAL, MPI_SUM, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, MAX_COUNT, MPIU_REAL, MPI_MAX, vi->level->comm));
  PetscCall(LargestReduce(vi->level->comm, vi->level->dim, 1, &peak));
  sum->normal_force = sums[ADD_NORMAL];
  sum->area         = sums[ADD_AREA];
  sum->active       = (PetscInt)sums[ADD_ACTIVE];
  sum->max_pressure = !sum->active ? 0.0 : peak.value > -PETSC_MAX_REAL ? peak.value : NAN; // no number, no largest one
  sum->max_pressure_row = (PetscInt)peak.owner;
  sum->max_covered      = PetscMax(largest[MAX_COVERED], 0);
  sum->min_gap          = largest[MAX_CLOSED] > PETSC_NINFINITY ? -largest[MAX_CLOSED] : NAN; // no node, no gap
  for (PetscInt k = 0; k < 3; k++) {
    sum->force[k]           = sums[ADD_FORCE + k];
    sum->lower[k]           = sum->active ? -largest[MAX_LOWER + k] : NAN;
    sum->upper[k]           = sum->active ? largest[MAX_UPPER + k] : NAN;
    sum->centre[k]          = sum->active ? sums[ADD_CENTRE + k] / sums[ADD_NORMAL] : NAN;
    sum->max_pressure_at[k] = peak.at[k];
  }
  PetscCall(PairSumSetTieForce_Private(fields, p, sum));
  if (vi->scene->model == MODEL_AXISYMMETRIC) { /* the resultant of a ring acts along its axis */
    sum->force[0] = 0;
    if (sum->active) sum->centre[0] = 0;
  }
  PetscCall(PairSumGetMomentImbalance_Private(fields, p, sum));
  if (fields->lambda) {
    PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
    PetscCall(VecRestoreArrayRead(fields->slack, &slack));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PairSum PairSumUnknown(void)
{
  PairSum sum = {.normal_force     = NAN,
                 .area             = NAN,
                 .max_pressure     = NAN,
                 .max_pressure_row = -1,
                 .max_covered      = NAN,
                 .min_gap          = NAN,
                 .moment_imbalance = NAN};

  for (PetscInt k = 0; k < 3; k++)
    sum.force[k] = sum.max_pressure_at[k] = sum.lower[k] = sum.upper[k] = sum.centre[k] = NAN;
  return sum;
}
