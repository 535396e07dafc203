/* frictionlimits.c -- whether friction can hold the bodies: round cones of Coulomb's law, and given bounds.

   Forces of a node with a coefficient are in the cone |f_t| <= mu f_n. Its generator with the largest work on
   a motion q is c_a(q) = n_a + mu s_a / |s_a|, s_a the slip of q. Forces of bounded friction are f with
   |f_a| <= G_a. Their work is sum f_a.s_a(q), at most h(q) = sum G_a |s_a(q)|. A motion with c.q <= 0 for all
   generators c, and phi.q > h(q), proves that there is no equilibrium. It is the residual of

       min | (phi, 1) - sum_j y_j (c_j, 0) - sum_k z_k (v_k, 1) |,   y, z >= 0,

   where c_j are generators of cones, and v_k works of forces at their bounds, along slips of the residuals
   before. This finds the point of a convex set nearest to a given point, from points of its boundary. A
   search that ends early finds no motion. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "problem/frictionlaw.h"
#include "rigid/rigidimpl.h"

/* Largest number of points of the boundary: few bodies need few. A search that needs more refuses nothing.
   Generators of a round cone that are kept at once. */
enum { MOST_POINTS = 64, ROUND_GENERATORS = 4 };

/* Least difference of the works of loads and of friction that refuses a scene, as a part of the largest
   work. */
static const PetscReal SURPLUS = 1e-9;
/* Roundoff of the residual along a column. */
static const PetscReal COLUMN_ROUNDING = 1e-13;
/* A motion may go into round cones by this part of the work of the loads: their forces take less of it. */
static const PetscReal INTO_CONE = 1e-2;

/* The search: columns of m + 1 entries, of edges of cones, of round cones, and of points. */
typedef struct {
  VI          vi;
  Solvability s;
  PetscInt    num, num_round, last; /* edges of cones; round cones; columns of all kinds on this rank */
  PetscInt   *round;                /* rows of the normals of round cones [num_round] */
  PetscReal  *columns, *weight;
  PetscBool  *equality;
} LimitSearch;

/* The unit with friction at a row, -1 for none. */
static PetscInt FrictionLimitsFind_Private(VI vi, Solvability s, PetscInt r)
{
  return s->tangent[r] ? -1 : FrictionLawFind(vi->friction, vi->row_dof[r]);
}

/* Whether a cone is round. In a plane, and on planes of symmetry, it has two edges. */
static PetscBool FrictionLimitsIsRound_Private(VI vi, PetscInt a)
{
  return (PetscBool)(a >= 0 && vi->friction->coefficient[a] > 0 &&
                     vi->friction->tangent[FRICTION_TANGENTS * a + 1] >= 0);
}

/* Whether the cones of solvability->friction leave something to be tested. */
static PetscBool FrictionLimitsAny_Private(VI vi)
{
  PetscBool any = PETSC_FALSE;

  for (PetscInt a = 0; vi->friction && a < vi->friction->n; a++)
    any = (PetscBool)(any || vi->friction->bound[a] > 0 || FrictionLimitsIsRound_Private(vi, a));
  return any;
}

/* The slip of a motion at the node of a row. [in] num - tangents; [out] slip - [num]; returns its size */
static PetscReal FrictionLimitsGetSlip_Private(const struct _n_Solvability *s, PetscInt r, PetscInt num,
                                               const PetscBool take[], const PetscReal q[], PetscReal slip[])
{
  for (PetscInt t = 0; t < num; t++) {
    slip[t] = 0;
    for (PetscInt k = 0; k < s->m; k++) slip[t] += take[k] ? s->slide[(r + 1 + t) * s->m + k] * q[k] : 0;
  }
  return VectorNorm(num, slip);
}

/* The work of friction at its bounds against a motion. Collective.
   [in] take - modes of the motion; [out] point - [m]; [out] h - the work */
static PetscErrorCode LimitSearchGetPoint_Private(const LimitSearch *search, const PetscBool take[],
                                                  const PetscReal q[], PetscReal point[], PetscReal *h)
{
  const VI               vi  = search->vi;
  const FrictionLaw     *law = vi->friction;
  const PetscInt         m   = search->s->m;
  const PetscReal        sum = search->s->forces, force = vi->stiffness * vi->length / (sum > 0 ? sum : 1);
  const PetscReal *const slide = search->s->slide;
  PetscReal             *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(m + 1, &sums));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt a   = FrictionLimitsFind_Private(vi, search->s, r);
    const PetscInt num = a < 0 ? 0 : law->tangent[FRICTION_TANGENTS * a + 1] < 0 ? 1 : 2;
    PetscReal      slip[FRICTION_TANGENTS], size, limit;

    if (!num || !(law->bound[a] > 0)) continue;
    size  = FrictionLimitsGetSlip_Private(search->s, r, num, take, q, slip);
    limit = law->bound[a] * force;
    sums[m] += limit * size;
    for (PetscInt t = 0; t < num && size > 0; t++)
      for (PetscInt k = 0; k < m; k++) sums[k] += take[k] ? limit * slip[t] / size * slide[(r + 1 + t) * m + k] : 0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(m + 1), MPIU_REAL, MPI_SUM, vi->level->comm));
  PetscCall(PetscArraycpy(point, sums, m));
  *h = sums[m];
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The generator of a round cone along the slip of a motion. [out] column - [m]; returns the component of the
   motion along it */
static PetscReal LimitSearchGetGenerator_Private(const LimitSearch *search, PetscInt r, const PetscBool take[],
                                                 const PetscReal q[], PetscReal column[])
{
  const Solvability s  = search->s;
  const PetscReal   mu = s->part * search->vi->friction->coefficient[FrictionLimitsFind_Private(search->vi, s, r)];
  PetscReal         slip[FRICTION_TANGENTS], along = 0;
  const PetscReal   size = FrictionLimitsGetSlip_Private(s, r, FRICTION_TANGENTS, take, q, slip);

  for (PetscInt k = 0; k < s->m; k++) {
    column[k] = take[k] ? s->nodal.rows[r * s->m + k] : 0;
    for (PetscInt t = 0; t < FRICTION_TANGENTS && take[k] && size > 0; t++)
      column[k] += mu * slip[t] / size * s->slide[(r + 1 + t) * s->m + k];
    along += column[k] * q[k];
  }
  return along > 0 ? along / VectorNorm(s->m, column) : 0;
}

/* A generator of each round cone along the slip of a motion, in place of one without weight. Collective.
   [in] q - [m]; [out] into - the largest component of q along them, 0 for none */
static PetscErrorCode LimitSearchTurnCones_Private(LimitSearch *search, const PetscBool take[], const PetscReal q[],
                                                   PetscReal *into)
{
  const PetscInt n = search->s->m + 1;

  PetscFunctionBeginUser;
  *into = 0;
  for (PetscInt i = 0; i < search->num_round; i++) {
    PetscInt       place = search->num + i * ROUND_GENERATORS;
    const PetscInt end   = place + ROUND_GENERATORS - 1;

    while (place < end && search->weight[place] > 0) place++; // the last one is overwritten where all have weight
    *into = PetscMax(*into,
                     LimitSearchGetGenerator_Private(search, search->round[i], take, q, &search->columns[place * n]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, into, 1, MPIU_REAL, MPI_MAX, search->vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Columns of the cones with edges, in chosen modes, without tangents with a bound, and room for all others.
   [out] search - to be destroyed by LimitSearchDestroy_Private() */
static PetscErrorCode LimitSearchCreate_Private(VI vi, Solvability s, const PetscBool take[], LimitSearch *search)
{
  const PetscInt m = s->m, n = m + 1;
  PetscInt       most;

  PetscFunctionBeginUser;
  *search = (LimitSearch){.vi = vi, .s = s};
  PetscCall(PetscMalloc1(vi->num_rows, &search->round));
  for (PetscInt r = 0; r < vi->num_rows; r++)
    if (FrictionLimitsIsRound_Private(vi, FrictionLimitsFind_Private(vi, s, r))) search->round[search->num_round++] = r;
  most = s->friction.num + ROUND_GENERATORS * search->num_round + MOST_POINTS + 1;
  PetscCall(PetscCalloc3(most * n, &search->columns, most, &search->weight, most, &search->equality));
  for (PetscInt i = 0; i < s->friction.num; i++) {
    const PetscInt  r   = s->friction_row[i];
    const PetscBool tie = s->nodal.equality[r];

    if ((s->friction.equality[i] && !tie) || FrictionLimitsIsRound_Private(vi, FrictionLimitsFind_Private(vi, s, r)))
      continue;
    search->equality[search->num] = tie;
    for (PetscInt k = 0; k < m; k++) search->columns[search->num * n + k] = take[k] ? s->friction.rows[i * m + k] : 0;
    search->num++;
  }
  search->last = search->num + ROUND_GENERATORS * search->num_round;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode LimitSearchDestroy_Private(LimitSearch *search)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(search->round));
  PetscCall(PetscFree3(search->columns, search->weight, search->equality));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A column (point, 1) of the first rank. [in] point - [m], or NULL for forces of zero */
static PetscErrorCode LimitSearchAddPoint_Private(LimitSearch *search, const PetscReal point[])
{
  const PetscInt m = search->s->m;
  PetscReal     *column;
  PetscMPIInt    rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(search->vi->level->comm, &rank));
  if (rank) PetscFunctionReturn(PETSC_SUCCESS);
  column = &search->columns[search->last++ * (m + 1)];
  if (point) PetscCall(PetscArraycpy(column, point, m));
  column[m] = 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The residual of the least squares problem with the present columns, and their weights.
   [in] target - [m + 1]; [out] residual - [m + 1], norm - of it */
static PetscErrorCode LimitSearchSolve_Private(LimitSearch *search, const PetscReal target[], PetscReal residual[],
                                               PetscReal *norm)
{
  const PetscInt n    = search->s->m + 1;
  const Cone     cone = {.comm     = search->vi->level->comm,
                         .num      = search->last,
                         .m        = n,
                         .rows     = search->columns,
                         .equality = search->equality};
  NNLS           nnls;

  PetscFunctionBeginUser;
  PetscCall(NNLSCreate(n, target, &nnls));
  PetscCall(ConeSolve(&cone, COLUMN_ROUNDING, &nnls, search->weight));
  PetscCall(PetscArraycpy(residual, nnls.residual, n));
  PetscCall(NNLSDestroy(&nnls));
  *norm = VectorNorm(n, residual);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionLimitsFindMotion(VI vi, Solvability s, const PetscReal phi[], PetscReal balanced,
                                        const PetscBool take[], PetscReal q[], PetscBool *found)
{
  const PetscInt m   = s->m;
  PetscBool      any = FrictionLimitsAny_Private(vi);
  LimitSearch    search;
  PetscReal     *target, *residual, *point, norm = 0, into;

  PetscFunctionBeginUser;
  *found = PETSC_FALSE;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, vi->level->comm));
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc3(m + 1, &target, m + 1, &residual, m, &point));
  for (PetscInt k = 0; k < m; k++) target[k] = take[k] ? phi[k] : 0;
  target[m] = 1;
  PetscCall(LimitSearchCreate_Private(vi, s, take, &search));
  PetscCall(LimitSearchAddPoint_Private(&search, NULL));
  PetscCall(LimitSearchTurnCones_Private(&search, take, target, &into));
  for (PetscInt i = 0; i < MOST_POINTS && !*found; i++) {
    PetscReal work = 0, h = 0;

    PetscCall(LimitSearchSolve_Private(&search, target, residual, &norm));
    if (!(norm > balanced)) break;
    PetscCall(LimitSearchGetPoint_Private(&search, take, residual, point, &h));
    PetscCall(LimitSearchTurnCones_Private(&search, take, residual, &into));
    for (PetscInt k = 0; k < m; k++) work += target[k] * residual[k];
    *found =
        (PetscBool)(work - h > PetscMax(SURPLUS * h, balanced * VectorNorm(m, residual)) && into <= INTO_CONE * work);
    PetscCall(LimitSearchAddPoint_Private(&search, point));
  }
  PetscCall(PetscArraycpy(q, residual, m));
  PetscCall(LimitSearchDestroy_Private(&search));
  PetscCall(PetscFree3(target, residual, point));
  PetscFunctionReturn(PETSC_SUCCESS);
}
