/* frictionfields.c -- tangential tractions and slips of pairs with friction.

   lambda of a tangential row is what the nonmortar side gives to its partner per area, and its slack is minus
   the slip. The rows of a node stand one behind the other, the normal one first; the nodes with tangents are
   those of vi->friction. */
#include "base/compat.h"
#include "contact/slidingnodes.h"
#include "kernel/vector.h"
#include "problem/frictionlaw.h"
#include "result/frictionfields.h"
#include "result/largest.h"

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

PetscErrorCode FrictionFieldsFindHeld(Fields fields, PetscInt p, PetscInt *num, PetscReal *share, PetscReal at[])
{
  const VI       vi       = fields->vi;
  const Pair     pair     = vi->pairs[p];
  const PetscInt dim      = vi->level->dim;
  PetscReal      areas[2] = {0, 0};
  Largest        first    = {.value = 0}; // of equal ones
  PetscBool     *slides;

  PetscFunctionBeginUser;
  *num = 0;
  if (!ScenePairHasFriction(pair->spec)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(pair->num, &slides));
  PetscCall(SlidingNodesOfPair(pair, &vi->support, slides));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (vi->row_pair[r] != p || vi->row_direction[r] || !StatusIsContact(fields->row_status[r])) continue;
    areas[1] += fields->row_weight[r];
    if (!slides[vi->row_node[r]]) continue;
    areas[0] += fields->row_weight[r];
    ++*num;
    LargestTake(&first, 1, dim, &vi->level->coords[pair->nodes[vi->row_node[r]] * dim], 0);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, num, 1, MPIU_INT, MPI_SUM, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, areas, 2, MPIU_REAL, MPI_SUM, vi->level->comm));
  PetscCall(LargestReduce(vi->level->comm, dim, 1, &first));
  *share = areas[1] > 0 ? areas[0] / areas[1] : 0;
  if (*num) PetscCall(PetscArraycpy(at, first.at, dim));
  PetscCall(PetscFree(slides));
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
