/* boundedfriction.c -- whether friction with given bounds holds the bodies.

   Forces of bounded friction are f with |f_a| <= G_a. Their work on a motion q is sum f_a.s_a(q), at most
   h(q) = sum G_a |s_a(q)|. A motion with C q <= 0 and phi.q > h(q) proves that there is no equilibrium. It is
   the residual of

       min | (phi, 1) - sum_j y_j (c_j, 0) - sum_k z_k (v_k, 1) |,   y, z >= 0,

   where v_k are the works of forces at their bounds, along the slips of the residual before. This finds the
   point of a convex set nearest to a given point, from points of its boundary. A search that ends early finds
   no motion. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "problem/frictionlaw.h"
#include "rigid/rigidimpl.h"

/* Largest number of points of the boundary: few bodies need few. A search that needs more refuses nothing. */
enum { MOST_POINTS = 64 };

/* Least difference of the works of loads and of friction that refuses a scene, as a part of the largest
   work. */
static const PetscReal SURPLUS = 1e-9;
/* Roundoff of the residual along a column. */
static const PetscReal COLUMN_ROUNDING = 1e-13;

/* The search: columns of m + 1 entries. */
typedef struct {
  VI          vi;
  Solvability s;
  PetscInt    num, last; /* columns of cones; of all on this rank */
  PetscReal  *columns;
  PetscBool  *equality;
} BoundedSearch;

static PetscBool BoundedFrictionIsAny_Private(VI vi)
{
  PetscBool any = PETSC_FALSE;

  for (PetscInt a = 0; vi->friction && a < vi->friction->n; a++)
    if (vi->friction->bound[a] > 0) any = PETSC_TRUE;
  return any;
}

/* The work of friction at its bounds against a motion. Collective.
   [in] take - modes of the motion; [out] point - [m]; [out] h - the work */
static PetscErrorCode BoundedFrictionGetPoint_Private(const BoundedSearch *search, const PetscBool take[],
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
    const PetscInt a                    = search->s->tangent[r] ? -1 : FrictionLawFind(law, vi->row_dof[r]);
    const PetscInt num                  = a < 0 ? 0 : law->tangent[FRICTION_TANGENTS * a + 1] < 0 ? 1 : 2;
    PetscReal      s[FRICTION_TANGENTS] = {0}, size, limit;

    if (!num || !(law->bound[a] > 0)) continue;
    for (PetscInt t = 0; t < num; t++)
      for (PetscInt k = 0; k < m; k++) s[t] += take[k] ? slide[(r + 1 + t) * m + k] * q[k] : 0;
    size  = VectorNorm(num, s);
    limit = law->bound[a] * force;
    sums[m] += limit * size;
    for (PetscInt t = 0; t < num && size > 0; t++)
      for (PetscInt k = 0; k < m; k++) sums[k] += take[k] ? limit * s[t] / size * slide[(r + 1 + t) * m + k] : 0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(m + 1), MPIU_REAL, MPI_SUM, vi->level->comm));
  PetscCall(PetscArraycpy(point, sums, m));
  *h = sums[m];
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Columns of all cones, in chosen modes, without tangents with a bound.
   [out] search - columns owned by the caller */
static PetscErrorCode BoundedSearchCreate_Private(VI vi, Solvability s, const PetscBool take[], BoundedSearch *search)
{
  const PetscInt m = s->m, n = m + 1;

  PetscFunctionBeginUser;
  *search = (BoundedSearch){.vi = vi, .s = s};
  PetscCall(PetscCalloc2((s->friction.num + MOST_POINTS + 1) * n, &search->columns, s->friction.num + MOST_POINTS + 1,
                         &search->equality));
  for (PetscInt i = 0; i < s->friction.num; i++) {
    const PetscBool tie = s->nodal.equality[s->friction_row[i]];

    if (s->friction.equality[i] && !tie) continue;
    search->equality[search->num] = tie;
    for (PetscInt k = 0; k < m; k++) search->columns[search->num * n + k] = take[k] ? s->friction.rows[i * m + k] : 0;
    search->num++;
  }
  search->last = search->num;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A column (point, 1) of the first rank. [in] point - [m], or NULL for forces of zero */
static PetscErrorCode BoundedSearchAddPoint_Private(BoundedSearch *search, const PetscReal point[])
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

/* The residual of the least squares problem with the present points.
   [in] target - [m + 1]; [out] residual - [m + 1], norm - of it */
static PetscErrorCode BoundedSearchSolve_Private(const BoundedSearch *search, const PetscReal target[],
                                                 PetscReal residual[], PetscReal *norm)
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
  PetscCall(ConeSolve(&cone, COLUMN_ROUNDING, &nnls, NULL));
  PetscCall(PetscArraycpy(residual, nnls.residual, n));
  PetscCall(NNLSDestroy(&nnls));
  *norm = VectorNorm(n, residual);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BoundedFrictionFindMotion(VI vi, Solvability s, const PetscReal phi[], PetscReal balanced,
                                         const PetscBool take[], PetscReal q[], PetscBool *found)
{
  const PetscInt m   = s->m;
  PetscBool      any = BoundedFrictionIsAny_Private(vi);
  BoundedSearch  search;
  PetscReal     *target, *residual, *point, norm = 0;

  PetscFunctionBeginUser;
  *found = PETSC_FALSE;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, vi->level->comm));
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc3(m + 1, &target, m + 1, &residual, m, &point));
  for (PetscInt k = 0; k < m; k++) target[k] = take[k] ? phi[k] : 0;
  target[m] = 1;
  PetscCall(BoundedSearchCreate_Private(vi, s, take, &search));
  PetscCall(BoundedSearchAddPoint_Private(&search, NULL));
  for (PetscInt i = 0; i < MOST_POINTS && !*found; i++) {
    PetscReal work = 0, h = 0;

    PetscCall(BoundedSearchSolve_Private(&search, target, residual, &norm));
    if (!(norm > balanced)) break;
    PetscCall(BoundedFrictionGetPoint_Private(&search, take, residual, point, &h));
    for (PetscInt k = 0; k < m; k++) work += target[k] * residual[k];
    *found = (PetscBool)(work - h > PetscMax(SURPLUS * h, balanced * VectorNorm(m, residual)));
    PetscCall(BoundedSearchAddPoint_Private(&search, point));
  }
  PetscCall(PetscArraycpy(q, residual, m));
  PetscCall(PetscFree2(search.columns, search.equality));
  PetscCall(PetscFree3(target, residual, point));
  PetscFunctionReturn(PETSC_SUCCESS);
}
