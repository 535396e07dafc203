/* regularization.c -- what makes the matrix definite where contact alone holds bodies (eq. 12.6).

   Weak springs at a few nodes of each piece of a body that floats, as far from each other as it allows: enough to resist every rigid
   motion, and so few that each piece keeps its own stiffness. They are not part of the problem: they rest where the last solution
   was, and the solution of the problem is where they have nothing left to do. */
#include "base/compat.h"
#include "problem/elasticity.h"
#include "rigid/rigidimpl.h"

/* Stiffness of a spring by that of bodies: each solution is nearer to the next by this factor, and the matrix has
   a condition number of its inverse at least. */
static const PetscReal WEAK = 1e-6;
/* Loads push bodies this many times farther than the largest gap before they are held: what then touches first, touches. */
static const PetscReal FAR = 1e3;
/* Gaps that are left then count as closed below this part of the largest one, or of the displacement to expect. */
static const PetscReal CLOSED = 1e-9;

/* Which of this rank's nodes may carry springs: not those whose unknowns mean something else, if there are others. */
static PetscErrorCode Candidates_Private(VI vi, PetscBool candidate[])
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

/* The candidate farthest from all that were taken before, in every piece of a body. [in,out] distance - of each node to these, -1 for
   others [num_owned]; [in,out] places - the last taken, [pieces->num][3]; [out] taken - local nodes, -1 where another rank has it
   [pieces->num] */
static PetscErrorCode Farthest_Private(const Level *level, const Components *pieces, const PetscReal distance[],
                                       PetscReal places[], PetscInt taken[])
{
  PetscMPIInt rank;
  struct {
    double distance;
    int    rank;
  } * best;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(level->comm, &rank));
  PetscCall(PetscMalloc1(pieces->num, &best));
  for (PetscInt b = 0; b < pieces->num; b++) {
    best[b].distance = -1;
    best[b].rank     = rank;
    taken[b]         = -1;
  }
  for (PetscInt a = 0; a < level->num_owned; a++) {
    const PetscInt b = pieces->of_node[a];

    if (distance[a] <= best[b].distance) continue;
    best[b].distance = (double)distance[a];
    taken[b]         = a;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, best, (PetscMPIInt)pieces->num, MPI_DOUBLE_INT, MPI_MAXLOC, level->comm));
  PetscCall(PetscArrayzero(places, 3 * pieces->num));
  for (PetscInt b = 0; b < pieces->num; b++) {
    if (best[b].rank != rank) taken[b] = -1;
    for (PetscInt k = 0; k < level->dim && taken[b] >= 0; k++)
      places[3 * b + k] = level->coords[taken[b] * level->dim + k];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, places, (PetscMPIInt)(3 * pieces->num), MPIU_REAL, MPI_SUM, level->comm));
  PetscCall(PetscFree(best));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* WEAK times the mean diagonal of A over each body, or over a softer one that pairs lead to: what lies on it, or on others that do, is
   held no firmer than that. Of a nearly incompressible body the diagonal tells the bulk modulus, but contact holds it by the shear
   modulus: without their ratio, at 0.4999, springs take three times as many sweeps. [out] weak - [num_bodies] */
static PetscErrorCode Stiffness_Private(VI vi, PetscReal weak[])
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

    weak[b] = WEAK * sums[2 * b] / sums[2 * b + 1];
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

/* Springs at dim + 1 nodes of each piece of a body that floats, at all unknowns of these that are not fixed. */
static PetscErrorCode Place_Private(VI vi, Vec springs)
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
  PetscCall(Candidates_Private(vi, candidate));
  PetscCall(Stiffness_Private(vi, weak));
  for (PetscInt b = 0; b < num; b++)
    for (PetscInt k = 0; k < 3; k++) places[3 * b + k] = vi->rigid_modes.frames[4 * b + k];
  PetscCall(VecZeroEntries(springs));
  PetscCall(VecGetArray(springs, &w));
  for (PetscInt round = 0; round <= dim; round++) {
    for (PetscInt a = 0; a < level->num_owned; a++) {
      const PetscInt b      = pieces->of_node[a];
      PetscReal      square = 0;

      for (PetscInt k = 0; k < dim; k++) square += PetscSqr(level->coords[a * dim + k] - places[3 * b + k]);
      /* the first is far from the centre, which is no node and is forgotten */
      if (round < 2 || square < distance[a]) distance[a] = candidate[a] ? square : -1;
    }
    PetscCall(Farthest_Private(level, pieces, distance, places, taken));
    for (PetscInt b = 0; b < num; b++)
      for (PetscInt k = 0; k < dim && taken[b] >= 0; k++) w[taken[b] * dim + k] = weak[pieces->body[b]];
  }
  for (PetscInt i = 0; i < vi->num_fixed; i++) w[vi->fixed_local[i]] = 0;
  PetscCall(VecRestoreArray(springs, &w));
  PetscCall(PetscFree5(candidate, distance, places, weak, taken));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Bodies with gaps to cross are taken there rigidly, as far as loads push them: springs this weak would cross them slowly.
   [out] left - gap that is left in each row, overlaps as they were [num_rows]; [out] largest - gap there was */
static PetscErrorCode Rest_Private(VI vi, Solvability s, PetscReal left[], PetscReal *largest)
{
  const Cone cone = {.comm = vi->level->comm, .num = vi->num_rows, .m = s->m, .rows = s->C, .both = s->both};
  PetscReal *bound, *q, size = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(vi->num_rows, &bound, s->m, &q));
  *largest = 0;
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    left[r]  = s->both[r] ? 0 : vi->pairs[vi->row_pair[r]]->gap[vi->row_node[r]];
    bound[r] = PetscMax(left[r], 0);
    *largest = PetscMax(*largest, bound[r]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPIU_REAL, MPI_MAX, cone.comm));
  for (PetscInt k = 0; k < s->m; k++) size = PetscMax(size, PetscAbsReal(s->phi[k]));
  PetscCall(VecZeroEntries(s->rest));
  if (*largest > 0 && size > 0) {
    PetscReal *target;

    PetscCall(PetscMalloc1(s->m, &target));
    for (PetscInt k = 0; k < s->m; k++) target[k] = FAR * *largest * s->phi[k] / size;
    PetscCall(ConeProject(&cone, bound, target, q));
    PetscCall(PetscFree(target));
    for (PetscInt k = 0; k < s->m; k++) PetscCall(VecAXPY(s->rest, q[k] / vi->length, s->modes[k]));
    for (PetscInt r = 0; r < vi->num_rows; r++)
      for (PetscInt k = 0; k < s->m; k++) left[r] -= s->C[r * s->m + k] * q[k];
  }
  PetscCall(PetscFree2(bound, q));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RegularizationCreate(VI vi, Solvability s)
{
  const PetscInt first = vi->level->dim * vi->level->node_begin;
  PetscReal     *left, largest, closed;
  PetscScalar   *start;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(vi->upper, &s->springs));
  PetscCall(VecDuplicate(vi->upper, &s->rest));
  PetscCall(VecDuplicate(vi->upper, &s->start));
  PetscCall(Place_Private(vi, s->springs));
  PetscCall(PetscMalloc1(vi->num_rows, &left));
  PetscCall(Rest_Private(vi, s, left, &largest));
  closed = CLOSED * PetscMax(largest, vi->length);
  PetscCall(VecZeroEntries(s->start));
  PetscCall(VecGetArray(s->start, &start));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (!s->both[r] && left[r] <= closed) start[vi->row_dof[r] - first] = 1;
  }
  PetscCall(VecRestoreArray(s->start, &start));
  PetscCall(PetscFree(left));
  PetscFunctionReturn(PETSC_SUCCESS);
}
