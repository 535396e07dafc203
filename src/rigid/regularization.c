/* regularization.c -- a diagonal that makes the matrix definite where only contact holds bodies (eq. 12.6).

   Small stiffnesses are added at a few nodes of each floating component, as far from each other as possible.
   They resist every rigid body mode, but hardly change the stiffness of the component. They are not part of
   the problem: the proximal point iteration of solve removes their effect. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "problem/elasticity.h"
#include "rigid/rigidimpl.h"

/* Added stiffness relative to that of bodies. The error of each proximal step falls by this factor; the
   condition number of the matrix is at least its inverse. */
static const PetscReal REGULARIZATION = 1e-6;
/* Loads move bodies towards a target this many times farther than the largest gap, as far as contact
   permits. */
static const PetscReal TARGET_DISTANCE = 1e3;
/* A motion below this part of the way to the target is none. */
static const PetscReal STANDS_STILL = 1e-9;
/* Motions until bodies stand still: the limits of friction are those of closed gaps, so that one may end
   before they are closed. */
enum { SETTLING_STEPS = 8 };
/* Remaining gaps below this part of the largest gap, or of the expected displacement, count as closed. */
static const PetscReal GAP_CLOSED = 1e-9;

/* Nodes are equally far if their squared distances differ by less: corners of a box, up to roundoff. */
static const PetscReal EQUALLY_FAR = 1e-9;

/* Nodes of this rank that may carry regularization: those with Cartesian unknowns, unless a component has too
   few of them. */
static PetscErrorCode RegularizationMarkCandidates_Private(VI vi, PetscBool candidate[])
{
  const Level   *level      = vi->level;
  const PetscInt num_pieces = vi->rigid_modes.components.num;
  PetscInt      *ordinary;

  PetscFunctionBeginUser;
  PetscCall(VIMarkCartesian(vi, candidate));
  PetscCall(PetscCalloc1(num_pieces, &ordinary));
  for (PetscInt a = 0; a < level->num_owned; a++)
    ordinary[vi->rigid_modes.components.of_node[a]] += candidate[a] ? 1 : 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, ordinary, (PetscMPIInt)num_pieces, MPIU_INT, MPI_SUM, level->comm));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    const PetscInt b = vi->rigid_modes.components.of_node[a];

    candidate[a] = (PetscBool)(vi->rigid_modes.loose[b] && (candidate[a] || ordinary[b] <= level->dim));
  }
  PetscCall(PetscFree(ordinary));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest distance of a candidate in each component, -1 where there is none. Collective.
   [out] farthest - [pieces->num] */
static PetscErrorCode RegularizationGetFarthest_Private(const Level *level, const Components *pieces,
                                                        const PetscReal distance[], PetscReal farthest[])
{
  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < pieces->num; b++) farthest[b] = -1;
  for (PetscInt a = 0; a < level->num_owned; a++) {
    const PetscInt b = pieces->of_node[a];

    farthest[b] = PetscMax(farthest[b], distance[a]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, farthest, (PetscMPIInt)pieces->num, MPIU_REAL, MPI_MAX, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The candidate farthest from all chosen nodes, in each component. Of several that are equally far it is the
   last one along a direction in which corners of boxes follow each other: the same for any order of nodes.
   [in] distance - of each candidate to them, -1 for other nodes [num_owned]; [out] places - of the new nodes
   [pieces->num][3]; [out] taken - local numbers of the new nodes, -1 on other ranks [pieces->num] */
static PetscErrorCode RegularizationFindFarthest_Private(const Level *level, const Components *pieces,
                                                         const PetscReal distance[], PetscReal places[],
                                                         PetscInt taken[])
{
  const PetscReal along[3] = {1, PetscSqrtReal(2), PetscSqrtReal(3)};
  PetscReal      *farthest;
  PetscMPIInt     rank;
  struct {
    double along;
    int    rank;
  } * best;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(level->comm, &rank));
  PetscCall(PetscMalloc2(pieces->num, &best, pieces->num, &farthest));
  PetscCall(RegularizationGetFarthest_Private(level, pieces, distance, farthest));
  for (PetscInt b = 0; b < pieces->num; b++) {
    best[b].along = PETSC_MIN_REAL;
    best[b].rank  = rank;
    taken[b]      = -1;
  }
  for (PetscInt a = 0; a < level->num_owned; a++) {
    const PetscInt  b     = pieces->of_node[a];
    const PetscReal place = VectorDot(level->dim, along, &level->coords[a * level->dim]);

    if (distance[a] < 0 || distance[a] < (1 - EQUALLY_FAR) * farthest[b] || place <= best[b].along) continue;
    best[b].along = (double)place;
    taken[b]      = a;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, best, (PetscMPIInt)pieces->num, MPI_DOUBLE_INT, MPI_MAXLOC, level->comm));
  PetscCall(PetscArrayzero(places, 3 * pieces->num));
  for (PetscInt b = 0; b < pieces->num; b++) {
    if (best[b].rank != rank) taken[b] = -1;
    for (PetscInt k = 0; k < level->dim && taken[b] >= 0; k++)
      places[3 * b + k] = level->coords[taken[b] * level->dim + k];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, places, (PetscMPIInt)(3 * pieces->num), MPIU_REAL, MPI_SUM, level->comm));
  PetscCall(PetscFree2(best, farthest));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* REGULARIZATION times the mean diagonal of A over each body, or over the softest body in a pair with it.
   Contact with that body is no stiffer. The diagonal of a nearly incompressible body has the bulk modulus,
   but contact resists by the shear modulus. Without their ratio, at Poisson's ratio 0.4999, the iteration
   takes three times as many steps. [out] weak - [num_bodies] */
static PetscErrorCode RegularizationGetStiffness_Private(VI vi, PetscReal weak[])
{
  const Level       *level = vi->level;
  const PetscInt     dim = level->dim, num_bodies = vi->rigid_modes.num_bodies;
  const PetscScalar *d;
  DilatationCount   *counts;
  PetscReal         *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(2 * num_bodies, &sums));
  PetscCall(VecGetArrayRead(vi->diagonal, &d));
  for (PetscInt i = 0; i < dim * level->num_owned; i++) {
    sums[2 * level->node_body[i / dim]] += PetscRealPart(d[i]) / vi->stiffness;
    sums[2 * level->node_body[i / dim] + 1] += 1;
  }
  PetscCall(VecRestoreArrayRead(vi->diagonal, &d));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(2 * num_bodies), MPIU_REAL, MPI_SUM, level->comm));
  PetscCall(PetscMalloc1(num_bodies, &counts));
  PetscCall(ElasticityDilatationCount(vi->scene, level, counts));
  for (PetscInt b = 0; b < num_bodies; b++) {
    const PetscReal nu = counts[b].poisson; // 0 unless nearly incompressible

    weak[b] = REGULARIZATION * sums[2 * b] / sums[2 * b + 1];
    if (nu > 0) weak[b] *= 1.5 * (1 - 2 * nu) / (1 + nu);
  }
  PetscCall(PetscFree(counts));
  for (PetscInt round = 0; round < vi->num_pairs; round++) {
    for (PetscInt p = 0; p < vi->num_pairs; p++) {
      const PetscInt a = vi->pairs[p]->spec->nonmortar.body, b = vi->pairs[p]->spec->mortar.body;

      if (b >= 0) weak[a] = weak[b] = PetscMin(weak[a], weak[b]);
    }
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Regularization at dim + 1 nodes of each component that floats, at all their free unknowns. */
static PetscErrorCode RegularizationSetDiagonal_Private(VI vi, Vec diagonal)
{
  const Level      *level  = vi->level;
  const Components *pieces = &vi->rigid_modes.components;
  const PetscInt    dim = level->dim, num = pieces->num;
  PetscBool        *candidate;
  PetscReal        *distance, *places, *weak;
  PetscInt         *taken;
  PetscScalar      *w;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc5(level->num_owned, &candidate, level->num_owned, &distance, 3 * num, &places,
                         vi->rigid_modes.num_bodies, &weak, num, &taken));
  PetscCall(RegularizationMarkCandidates_Private(vi, candidate));
  PetscCall(RegularizationGetStiffness_Private(vi, weak));
  for (PetscInt b = 0; b < num; b++)
    for (PetscInt k = 0; k < 3; k++) places[3 * b + k] = vi->rigid_modes.frames[4 * b + k];
  PetscCall(VecZeroEntries(diagonal));
  PetscCall(VecGetArray(diagonal, &w));
  for (PetscInt round = 0; round <= dim; round++) {
    for (PetscInt a = 0; a < level->num_owned; a++) {
      const PetscInt b      = pieces->of_node[a];
      PetscReal      square = 0;

      for (PetscInt k = 0; k < dim; k++) square += PetscSqr(level->coords[a * dim + k] - places[3 * b + k]);
      /* the first node is the farthest from the centre, which then no longer counts */
      if (round < 2 || square < distance[a]) distance[a] = candidate[a] ? square : -1;
    }
    PetscCall(RegularizationFindFarthest_Private(level, pieces, distance, places, taken));
    for (PetscInt b = 0; b < num; b++)
      for (PetscInt k = 0; k < dim && taken[b] >= 0; k++) w[taken[b] * dim + k] = weak[pieces->body[b]];
  }
  for (PetscInt i = 0; i < vi->num_fixed; i++) w[vi->fixed_local[i]] = 0;
  PetscCall(VecRestoreArray(diagonal, &w));
  PetscCall(PetscFree5(candidate, distance, places, weak, taken));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moves bodies rigidly until they touch and friction holds all of them there, if it does. If they slid along
   each other to other contacts, their positions would lie in the last digits of that way. Collective.
   [in] bound - gap of each row [num_rows]; [in] target - [m];
   [out] q - motion, 0 if friction does not hold [m] */
static PetscErrorCode RegularizationSettle_Private(VI vi, Solvability s, const PetscReal bound[],
                                                   const PetscReal target[], PetscReal q[], PetscBool *holds)
{
  const Cone cone = ContactRowsCone(vi, s, &s->friction);
  PetscReal *left, *wide, *step;

  PetscFunctionBeginUser;
  *holds = PETSC_FALSE;
  if (!vi->friction) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc3(vi->num_rows, &left, s->friction.num, &wide, s->m, &step));
  PetscCall(PetscArraycpy(left, bound, vi->num_rows));
  for (PetscInt n = 0; n < SETTLING_STEPS && !*holds; n++) {
    PetscReal way = 0, all = 0;

    for (PetscInt i = 0; i < s->friction.num; i++) wide[i] = s->friction.equality[i] ? 0 : left[s->friction_row[i]];
    PetscCall(ConeProject(&cone, wide, target, step));
    for (PetscInt k = 0; k < s->m; k++) {
      way += step[k] * step[k];
      all += target[k] * target[k];
    }
    *holds = (PetscBool)(way <= PetscSqr(STANDS_STILL) * all);
    for (PetscInt k = 0; k < s->m && !*holds; k++) q[k] += step[k];
    for (PetscInt r = 0; r < vi->num_rows && !*holds; r++) {
      for (PetscInt k = 0; k < s->m; k++) left[r] -= s->nodal.rows[r * s->m + k] * step[k];
      left[r] = PetscMax(left[r], 0);
    }
  }
  if (!*holds) PetscCall(PetscArrayzero(q, s->m));
  PetscCall(PetscFree3(left, wide, step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moves bodies rigidly until they touch, as far as the loads drive them: the iteration would close wide gaps
   slowly.
   [out] left - remaining gap of each row, overlaps unchanged [num_rows]; [out] largest - initial gap */
static PetscErrorCode RegularizationSetApproach_Private(VI vi, Solvability s, PetscReal left[], PetscReal *largest)
{
  const Cone cone = ContactRowsCone(vi, s, &s->nodal);
  PetscReal *bound, *q, size = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(vi->num_rows, &bound, s->m, &q));
  *largest = 0;
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    left[r] =
        s->nodal.equality[r] || (s->tangent && s->tangent[r]) ? 0 : vi->pairs[vi->row_pair[r]]->gap[vi->row_node[r]];
    bound[r] = PetscMax(left[r], 0);
    *largest = PetscMax(*largest, bound[r]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPIU_REAL, MPI_MAX, cone.comm));
  for (PetscInt k = 0; k < s->m; k++) size = PetscMax(size, PetscAbsReal(s->work[k]));
  PetscCall(VecZeroEntries(s->approach));
  if (*largest > 0 && size > 0) {
    PetscReal *target;
    PetscBool  holds;

    PetscCall(PetscMalloc1(s->m, &target));
    for (PetscInt k = 0; k < s->m; k++) target[k] = TARGET_DISTANCE * *largest * s->work[k] / size;
    PetscCall(RegularizationSettle_Private(vi, s, bound, target, q, &holds));
    if (!holds) PetscCall(ConeProject(&cone, bound, target, q));
    PetscCall(PetscFree(target));
    for (PetscInt k = 0; k < s->m; k++) PetscCall(VecAXPY(s->approach, q[k] / vi->length, s->modes[k]));
    for (PetscInt r = 0; r < vi->num_rows; r++)
      for (PetscInt k = 0; k < s->m; k++) left[r] -= s->nodal.rows[r * s->m + k] * q[k];
  }
  PetscCall(PetscFree2(bound, q));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RegularizationCreate(VI vi, Solvability s)
{
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(vi->upper, &s->regularization));
  PetscCall(VecDuplicate(vi->upper, &s->approach));
  PetscCall(VecDuplicate(vi->upper, &s->start));
  PetscCall(RegularizationSetDiagonal_Private(vi, s->regularization));
  PetscCall(RegularizationUpdate(vi, s));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RegularizationUpdate(VI vi, Solvability s)
{
  const PetscInt first = vi->level->dim * vi->level->node_begin;
  PetscReal     *left, largest, closed;
  PetscScalar   *start;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(vi->num_rows, &left));
  PetscCall(RegularizationSetApproach_Private(vi, s, left, &largest));
  closed = GAP_CLOSED * PetscMax(largest, vi->length);
  PetscCall(VecZeroEntries(s->start));
  PetscCall(VecGetArray(s->start, &start));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (!s->nodal.equality[r] && !(s->tangent && s->tangent[r]) && left[r] <= closed) start[vi->row_dof[r] - first] = 1;
  }
  PetscCall(VecRestoreArray(s->start, &start));
  PetscCall(PetscFree(left));
  PetscFunctionReturn(PETSC_SUCCESS);
}
