/* frictionfields.c -- tangential tractions and slips of pairs with friction.

   lambda of a tangential row is what the nonmortar side gives to its partner per area, and its slack is minus
   the slip. The rows of a node stand one behind the other, the normal one first; the nodes with tangents are
   those of vi->friction. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "problem/frictionlaw.h"
#include "result/frictionfields.h"
#include "result/pairsum.h"

/* Slips below this part of the largest one are roundoff. */
static const PetscReal STUCK = 1e-9;

/* A node with friction. */
typedef struct {
  PetscInt         row, num, pair, node; /* its normal row; tangents behind it; its pair, and its position there */
  const PetscReal *q, *slack;            /* lambda and slack of the tangents [num] */
  PetscReal        pressure, weight, limit;
} FrictionNode;

/* The next node with friction behind a row. [in] a - how many there were before; [out] next - the row behind
   it, or num_rows */
static PetscBool FrictionFieldsNext_Private(Fields fields, const PetscReal lambda[], const PetscReal slack[],
                                            PetscInt a, PetscInt *next, FrictionNode *node)
{
  const VI        vi    = fields->vi;
  const PetscReal force = vi->stiffness * vi->length;
  PetscInt        r     = *next, at;

  if (!vi->friction || a == vi->friction->n) return PETSC_FALSE;
  while (r + 1 == vi->num_rows || vi->row_direction[r] || !vi->row_direction[r + 1] ||
         !ScenePairHasFriction(vi->pairs[vi->row_pair[r]]->spec))
    r++;
  *node = (FrictionNode){.row      = r,
                         .pair     = vi->row_pair[r],
                         .node     = vi->row_node[r],
                         .q        = &lambda[r + 1],
                         .slack    = &slack[r + 1],
                         .pressure = lambda[r],
                         .weight   = vi->row_D[r]};
  while (r + node->num + 1 < vi->num_rows && vi->row_direction[r + node->num + 1]) node->num++;
  at          = FrictionLawFind(vi->friction, vi->row_dof[r]);
  node->limit = vi->friction->bound[at] * force / node->weight + vi->friction->coefficient[at] * PetscMax(lambda[r], 0);
  *next       = r + node->num + 1;
  return PETSC_TRUE;
}

/* The largest slip of all ranks. */
static PetscErrorCode FrictionFieldsLargest_Private(Fields fields, const PetscReal lambda[], const PetscReal slack[],
                                                    PetscReal *largest)
{
  FrictionNode node;

  PetscFunctionBeginUser;
  *largest = 0;
  for (PetscInt a = 0, next = 0; FrictionFieldsNext_Private(fields, lambda, slack, a, &next, &node); a++)
    *largest = PetscMax(*largest, VectorNorm(node.num, node.slack));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPIU_REAL, MPI_MAX, fields->vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionFieldsSetStatus(Fields fields)
{
  const PetscReal *lambda, *slack;
  PetscReal        largest;
  FrictionNode     node;

  PetscFunctionBeginUser;
  if (!fields->vi->friction) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  PetscCall(VecGetArrayRead(fields->slack, &slack));
  PetscCall(FrictionFieldsLargest_Private(fields, lambda, slack, &largest));
  for (PetscInt a = 0, next = 0; FrictionFieldsNext_Private(fields, lambda, slack, a, &next, &node); a++) {
    const PetscBool slips =
        (PetscBool)(VectorNorm(node.num, node.slack) > PetscMax(STUCK * largest, FIELDS_ROUNDOFF * fields->u_ref));

    if (fields->row_status[node.row] == STATUS_CONTACT)
      fields->row_status[node.row] = slips ? STATUS_SLIP : STATUS_STICK;
    for (PetscInt i = 0; i < node.num; i++) fields->row_status[node.row + 1 + i] = fields->row_status[node.row];
  }
  PetscCall(VecRestoreArrayRead(fields->slack, &slack));
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Where there is a multiplier, the vectors of a pair. [in,out] traction, slip - [num_owned][dim] */
static PetscErrorCode FrictionFieldsSet_Private(Fields fields, PetscInt p, PetscReal traction[], PetscReal slip[])
{
  const VI         vi   = fields->vi;
  const Pair       pair = vi->pairs[p];
  const PetscInt   dim  = vi->level->dim;
  const PetscReal *lambda, *slack;
  FrictionNode     node;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  PetscCall(VecGetArrayRead(fields->slack, &slack));
  for (PetscInt r = 0; r < vi->num_rows; r++)
    for (PetscInt k = 0; k < dim && vi->row_pair[r] == p; k++) slip[pair->nodes[vi->row_node[r]] * dim + k] = 0;
  for (PetscInt a = 0, next = 0; FrictionFieldsNext_Private(fields, lambda, slack, a, &next, &node); a++) {
    if (node.pair != p) continue;
    for (PetscInt i = 0; i < node.num; i++) {
      const PetscReal *t = &pair->frame[(node.node * dim + vi->row_direction[node.row + 1 + i]) * dim];

      for (PetscInt k = 0; k < dim; k++) {
        traction[pair->nodes[node.node] * dim + k] -= node.q[i] * t[k];
        slip[pair->nodes[node.node] * dim + k] -= node.slack[i] / pair->share[node.node] * t[k];
      }
    }
  }
  PetscCall(VecRestoreArrayRead(fields->slack, &slack));
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* From the nodes with multipliers to all of the side, but nodes beyond the partner's end.
   [in,out] traction - [num_owned][dim] */
static PetscErrorCode FrictionFieldsSpread_Private(Fields fields, PetscInt p, PetscReal traction[])
{
  const VI       vi   = fields->vi;
  const Pair     pair = vi->pairs[p];
  const PetscInt dim = vi->level->dim, n = vi->level->num_owned;
  PetscReal     *component;
  PetscBool     *covered;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n, &component, n, &covered));
  for (PetscInt k = 0; k < dim; k++) {
    PetscCall(PetscArrayzero(covered, n));
    for (PetscInt r = 0; r < vi->num_rows; r++)
      if (vi->row_pair[r] == p) covered[pair->nodes[vi->row_node[r]]] = PETSC_TRUE;
    for (PetscInt a = 0; a < n; a++) component[a] = traction[a * dim + k];
    PetscCall(PairFieldsSpread(pair, component, covered));
    for (PetscInt i = 0; i < pair->num_beyond; i++) component[pair->beyond[i]] = 0;
    for (PetscInt a = 0; a < n; a++) traction[a * dim + k] = component[a];
  }
  PetscCall(PetscFree2(component, covered));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionFieldsGet(Fields fields, PetscInt p, PetscReal traction[], PetscReal slip[])
{
  const Level *level = fields->vi->level;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(traction, level->num_owned * level->dim));
  for (PetscInt i = 0; i < level->num_owned * level->dim; i++) slip[i] = NAN;
  if (!fields->lambda) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FrictionFieldsSet_Private(fields, p, traction, slip));
  PetscCall(FrictionFieldsSpread_Private(fields, p, traction));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Component k, l of sum d d' over the held directions d of each node. [out] held - node by node, owned by the
   caller */
static PetscErrorCode FrictionFieldsCreateHeld_Private(VI vi, PetscInt k, PetscInt l, Vec *held)
{
  const Support *support = &vi->support;
  PetscScalar   *value;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(vi->level, 1, held));
  PetscCall(VecGetArray(*held, &value));
  for (PetscInt i = 0; i < vi->level->num_owned; i++) {
    value[i] = 0;
    for (PetscInt j = 0; j < support->count[i]; j++) {
      const PetscReal *d = &support->directions[(i * support->dim + j) * support->dim];

      value[i] += d[k] * d[l];
    }
  }
  PetscCall(VecRestoreArray(*held, &value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* M times these components: how far supports hold the mortar side at nodes of pair p. Collective.
   [out] share - symmetric matrices, owned by the caller [num_owned][dim][dim] */
static PetscErrorCode FrictionFieldsShareHeld_Private(VI vi, PetscInt p, PetscReal **share)
{
  const PetscInt dim = vi->level->dim, num = vi->level->num_owned;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num * dim * dim, share));
  for (PetscInt k = 0; k < dim; k++)
    for (PetscInt l = 0; l <= k; l++) {
      Vec                held, sum;
      const PetscScalar *value;

      PetscCall(FrictionFieldsCreateHeld_Private(vi, k, l, &held));
      PetscCall(VecDuplicate(held, &sum));
      PetscCall(MatMult(vi->pairs[p]->M, held, sum));
      PetscCall(VecGetArrayRead(sum, &value));
      for (PetscInt i = 0; i < num; i++)
        (*share)[(i * dim + k) * dim + l] = (*share)[(i * dim + l) * dim + k] = PetscRealPart(value[i]);
      PetscCall(VecRestoreArrayRead(sum, &value));
      PetscCall(VecDestroy(&sum));
      PetscCall(VecDestroy(&held));
    }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* M times the prescribed displacements of the mortar side, at nodes of pair p. Collective.
   [out] moved - owned by the caller [num_owned][dim] */
static PetscErrorCode FrictionFieldsMoveMortar_Private(VI vi, PetscInt p, PetscReal **moved)
{
  const Support   *support = &vi->support;
  const PetscInt   dim = vi->level->dim, num = vi->level->num_owned;
  Vec              given, sum;
  PetscReal       *value;
  const PetscReal *result;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num * dim, moved));
  PetscCall(LevelCreateVec(vi->level, 1, &given));
  PetscCall(VecDuplicate(given, &sum));
  for (PetscInt k = 0; k < dim; k++) {
    PetscCall(VecZeroEntries(given));
    PetscCall(VecGetArray(given, &value));
    for (PetscInt i = 0; i < num; i++)
      for (PetscInt j = 0; j < support->count[i]; j++)
        value[i] += support->values[i * dim + j] * support->directions[(i * dim + j) * dim + k];
    PetscCall(VecRestoreArray(given, &value));
    PetscCall(MatMult(vi->pairs[p]->M, given, sum));
    PetscCall(VecGetArrayRead(sum, &result));
    for (PetscInt i = 0; i < num; i++) (*moved)[i * dim + k] = result[i];
    PetscCall(VecRestoreArrayRead(sum, &result));
  }
  PetscCall(VecDestroy(&sum));
  PetscCall(VecDestroy(&given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether friction is lost along the held direction j of node a of a pair. Its mortar nodes are free then, or
   supports move the two sides along each other. On a plane of symmetry both are held, with the same value.
   [in] share, moved - of the functions above, or NULL for an obstacle */
static PetscBool FrictionFieldsIsLost_Private(const Support *support, const Pair pair, PetscInt a, PetscInt j,
                                              const PetscReal share[], const PetscReal moved[])
{
  const PetscInt   dim = support->dim, i = pair->nodes[a];
  const PetscReal *d     = &support->directions[(i * dim + j) * dim];
  PetscReal        given = 0, held = 0;

  for (PetscInt k = 0; share && k < dim; k++) held += d[k] * VectorDot(dim, &share[(i * dim + k) * dim], d);
  if (share && PetscAbsReal(held) <= STUCK * pair->D[a]) return PETSC_TRUE;
  if (share) given = VectorDot(dim, &moved[i * dim], d) / held;
  return (PetscBool)(PetscAbsReal(support->values[i * dim + j] - given) > STUCK * support->max_value);
}

/* Marks normal rows of pair p in contact whose node loses friction.
   [in] share, moved - or NULL for an obstacle; [in,out] chosen - [num_rows] */
static void FrictionFieldsMarkHeld_Private(Fields fields, PetscInt p, const PetscReal share[], const PetscReal moved[],
                                           PetscBool chosen[])
{
  const VI   vi   = fields->vi;
  const Pair pair = vi->pairs[p];

  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt a = vi->row_node[r];

    if (vi->row_pair[r] != p || vi->row_direction[r] || !StatusIsContact(fields->row_status[r])) continue;
    for (PetscInt j = 0; j < vi->support.count[pair->nodes[a]]; j++)
      if (FrictionFieldsIsLost_Private(&vi->support, pair, a, j, share, moved)) chosen[r] = PETSC_TRUE;
  }
}

PetscErrorCode FrictionFieldsFindHeld(Fields fields, PetscInt p, PetscInt *num, PetscReal *share, PetscReal at[])
{
  const VI   vi    = fields->vi;
  const Pair pair  = vi->pairs[p];
  PetscReal *fixed = NULL, *moved = NULL, areas[2] = {0, 0};
  PetscBool *chosen;

  PetscFunctionBeginUser;
  *num = 0;
  if (!ScenePairHasFriction(pair->spec)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1(vi->num_rows, &chosen));
  if (pair->M) {
    PetscCall(FrictionFieldsShareHeld_Private(vi, p, &fixed));
    PetscCall(FrictionFieldsMoveMortar_Private(vi, p, &moved));
  }
  FrictionFieldsMarkHeld_Private(fields, p, fixed, moved, chosen);
  PetscCall(PetscFree(fixed));
  PetscCall(PetscFree(moved));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (vi->row_pair[r] != p || vi->row_direction[r] || !StatusIsContact(fields->row_status[r])) continue;
    areas[1] += fields->row_weight[r];
    if (!chosen[r]) continue;
    areas[0] += fields->row_weight[r];
    ++*num;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, num, 1, MPIU_INT, MPI_SUM, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, areas, 2, MPIU_REAL, MPI_SUM, vi->level->comm));
  *share = areas[1] > 0 ? areas[0] / areas[1] : 0;
  if (*num) PetscCall(PairSumFindFirstPlace(vi, chosen, at));
  PetscCall(PetscFree(chosen));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What is added over nodes. */
enum { ADD_FORCE, ADD_AREA = ADD_FORCE + 3, ADD_SLIPPING, ADD_DISSIPATION, ADD_COUNT };

/* Area in contact of a pair on this rank, with nodes that supports hold along the sides. On a plane of
   symmetry they do not slip. */
static PetscReal FrictionSumArea_Private(Fields fields, PetscInt p, const PetscReal lambda[])
{
  const VI  vi   = fields->vi;
  PetscReal area = 0;

  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (vi->row_pair[r] != p || vi->row_direction[r]) continue;
    if (StatusIsContact(fields->row_status[r]) && lambda[r] > 0) area += fields->row_weight[r];
  }
  return area;
}

PetscErrorCode FrictionSumCompute(Fields fields, PetscInt p, FrictionSum *sum)
{
  const VI         vi              = fields->vi;
  const Pair       pair            = vi->pairs[p];
  const PetscInt   dim             = vi->level->dim;
  PetscReal        sums[ADD_COUNT] = {0}, largest = 0;
  const PetscReal *lambda, *slack;
  FrictionNode     node;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  PetscCall(VecGetArrayRead(fields->slack, &slack));
  sums[ADD_AREA] = FrictionSumArea_Private(fields, p, lambda);
  for (PetscInt a = 0, next = 0; FrictionFieldsNext_Private(fields, lambda, slack, a, &next, &node); a++) {
    const PetscReal weight = fields->row_weight[node.row];
    const PetscInt  status = fields->row_status[node.row];

    if (node.pair != p) continue;
    if (StatusIsContact(status)) largest = PetscMax(largest, VectorNorm(node.num, node.slack) / pair->share[node.node]);
    if (status == STATUS_SLIP && node.pressure > 0) sums[ADD_SLIPPING] += weight;
    for (PetscInt i = 0; i < node.num; i++) {
      const PetscReal *t = &pair->frame[(node.node * dim + vi->row_direction[node.row + 1 + i]) * dim];

      sums[ADD_DISSIPATION] -= node.weight * node.q[i] * node.slack[i];
      for (PetscInt k = 0; k < dim; k++) sums[ADD_FORCE + k] -= weight * node.q[i] * t[k];
    }
  }
  PetscCall(VecRestoreArrayRead(fields->slack, &slack));
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, ADD_COUNT, MPIU_REAL, MPI_SUM, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPI_MAX, vi->level->comm));
  PetscCall(PetscArraycpy(sum->force, &sums[ADD_FORCE], 3));
  if (vi->scene->model == MODEL_AXISYMMETRIC) sum->force[0] = 0; // the resultant of a ring acts along its axis
  sum->slip_share  = sums[ADD_AREA] > 0 ? sums[ADD_SLIPPING] / sums[ADD_AREA] : NAN;
  sum->max_slip    = largest;
  sum->dissipation = sums[ADD_DISSIPATION];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionResidualCompute(Fields fields, PetscReal tolerance, FrictionResidual *residual)
{
  PetscReal        worst[3] = {0, 0, 0}, largest;
  const PetscReal *lambda, *slack;
  FrictionNode     node;

  PetscFunctionBeginUser;
  *residual = (FrictionResidual){0, 0, 0};
  if (!fields->vi->friction) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  PetscCall(VecGetArrayRead(fields->slack, &slack));
  PetscCall(FrictionFieldsLargest_Private(fields, lambda, slack, &largest));
  for (PetscInt a = 0, next = 0; FrictionFieldsNext_Private(fields, lambda, slack, a, &next, &node); a++) {
    const PetscReal s = VectorNorm(node.num, node.slack), q = VectorNorm(node.num, node.q);
    const PetscReal p     = fields->p_ref + (fields->row_noise[node.row] + fields->row_noise[node.row + 1]) / tolerance;
    const PetscReal noise = FIELDS_ROUNDOFF / tolerance * fields->u_ref; // of slips; the law multiplies it by G
    const PetscReal size  = p * (largest + noise);
    PetscReal       off = 0, work = 0;

    for (PetscInt i = 0; i < node.num; i++) {
      off += PetscSqr(s * node.q[i] + node.limit * node.slack[i]);
      work -= node.q[i] * node.slack[i];
    }
    if (!(p > 0 && size > 0)) continue;
    worst[0] = PetscMax(worst[0], (q - node.limit) / p);
    worst[1] = PetscMax(worst[1], PetscSqrtReal(off) / (size + node.limit * noise));
    worst[2] = PetscMax(worst[2], -work / size);
  }
  PetscCall(VecRestoreArrayRead(fields->slack, &slack));
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, worst, 3, MPIU_REAL, MPI_MAX, fields->vi->level->comm));
  *residual = (FrictionResidual){.cone = worst[0], .slip = worst[1], .dissipation = worst[2]};
  PetscFunctionReturn(PETSC_SUCCESS);
}
