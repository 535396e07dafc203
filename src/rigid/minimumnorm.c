/* minimumnorm.c -- the solution of least mean square displacement (eq. 12.7).

   Strains and pressures of a solution are unique. Displacements are unique up to motions that keep pressed
   contacts closed and give no overlap elsewhere. Over these motions, the mean square displacement of floating
   bodies has one minimum. This is a quadratic problem with one unknown for each free motion and the remaining
   gaps as constraints. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "rigid/rigidimpl.h"

/* A contact is pressed if its pressure exceeds this part of the largest. */
static const PetscReal PRESSED = 1e-9;
/* Roundoff of a force, in parts of stiffness times displacement. */
static const PetscReal FORCE_ROUNDING = 64 * PETSC_MACHINE_EPSILON;

/* Loads do work on a motion if it exceeds this part of their sum times the motion: the certificate fails. */
static const PetscReal DRIVEN = 1e-6;

enum { MAX_DIM = 3 };

/* Data of the quadratic problem. */
typedef struct {
  PetscBool *pressed;     /* rows that are pressed, or ties [num_rows] */
  PetscReal *slack;       /* remaining gaps of the others [num_rows] */
  PetscReal *mass, *work; /* int z_k.z_l [m][m], int z_k.u [m] */
} MinimumNorm;

/* Finds rows that are pressed, or ties. [out] take - [num_rows] */
static PetscErrorCode MinimumNormFindPressed_Private(VI vi, Solvability s, Vec u, PetscBool take[])
{
  const PetscScalar *lambda;
  PetscReal          largest = 0, forces, weights = 0, u_max;
  Vec                l;

  PetscFunctionBeginUser;
  if (!vi->G) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDuplicate(vi->G, &l));
  PetscCall(VIRecoverMultiplier(vi, u, l));
  PetscCall(VecNorm(u, NORM_INFINITY, &u_max));
  PetscCall(VecNorm(vi->f, NORM_1, &forces));
  PetscCall(VecGetArrayRead(l, &lambda));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    largest = PetscMax(largest, PetscAbsReal(PetscRealPart(lambda[r])));
    weights += vi->row_D[r];
    if (vi->slip_origin) u_max = PetscMax(u_max, PetscAbsReal(vi->slip_origin[r])); // u went on from there
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &u_max, 1, MPIU_REAL, MPI_MAX, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPI_MAX, vi->level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &weights, 1, MPIU_REAL, MPI_SUM, vi->level->comm));
  if (weights > 0) largest = PetscMax(largest, forces / weights); // if all pressures are rounding
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscReal noise = FORCE_ROUNDING * vi->stiffness * u_max / vi->row_D[r];

    take[r] = (PetscBool)(s->nodal.equality[r] || PetscRealPart(lambda[r]) > PRESSED * largest + noise);
  }
  PetscCall(VecRestoreArrayRead(l, &lambda));
  PetscCall(VecDestroy(&l));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* int z_k.z_l and int z_k.u over one cell. [in,out] mass - [m][m]; [in,out] work - [m] */
static void MinimumNormAddCell_Private(VI vi, PetscInt c, const ElementRule *rule, const PetscScalar u[],
                                       PetscReal mass[], PetscReal work[])
{
  const Level    *level = vi->level;
  const PetscInt  dim = level->dim, n = level->cell_start[c + 1] - level->cell_start[c], m = vi->rigid_modes.num;
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]],
                 piece  = vi->rigid_modes.components.of_node[nodes[0]];
  PetscReal X[ELEMENT_MAX_NODES * MAX_DIM], x[MAX_DIM], value[MAX_DIM], z[RIGID_COMPONENTS * MAX_DIM];
  PetscInt  begin = 0, end;

  while (vi->rigid_modes.component[begin] < piece) begin++;
  for (end = begin; end < m && vi->rigid_modes.component[end] == piece;) end++;
  VectorGather(dim, n, nodes, level->coords, X);
  for (PetscInt q = 0; q < rule->num; q++) {
    const PetscReal weight = ElementRuleMap(rule, q, X, x, NULL) * rule->weight[q] * SceneMeasure(vi->scene, x);

    for (PetscInt k = 0; k < dim; k++) {
      value[k] = 0;
      for (PetscInt i = 0; i < n; i++) value[k] += rule->phi[q * n + i] * PetscRealPart(u[nodes[i] * dim + k]);
    }
    for (PetscInt k = begin; k < end; k++)
      RigidModesAt(dim, &vi->rigid_modes.frames[4 * piece], &vi->rigid_modes.mode[k * RIGID_COMPONENTS], x,
                   &z[(k - begin) * dim]);
    for (PetscInt k = begin; k < end; k++) {
      for (PetscInt i = 0; i < dim; i++) {
        work[k] += weight * z[(k - begin) * dim + i] * value[i];
        for (PetscInt l = begin; l < end; l++)
          mass[k * m + l] += weight * z[(k - begin) * dim + i] * z[(l - begin) * dim + i];
      }
    }
  }
}

/* The mean square displacement as a quadratic form of the modes. [out] mass - [m][m]; [out] work - [m] */
static PetscErrorCode MinimumNormGetMass_Private(VI vi, Vec u, PetscReal mass[], PetscReal work[])
{
  const Level       *level = vi->level;
  const PetscInt     m     = vi->rigid_modes.num;
  const PetscScalar *ul;
  ElementRule       *rule;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(mass, m * m));
  PetscCall(PetscArrayzero(work, m));
  PetscCall(PetscMalloc1(1, &rule));
  rule->num = 0;
  PetscCall(GhostedGetArrayRead(u, &ul));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type  = (ElementType)level->cell_type[c];
    const PetscInt    piece = vi->rigid_modes.components.of_node[level->cell_nodes[level->cell_start[c]]];

    if (!vi->rigid_modes.loose[piece]) continue;
    if (!rule->num || rule->type != type) ElementRuleSet(type, 2 * ElementOrder(type), rule);
    MinimumNormAddCell_Private(vi, c, rule, ul, mass, work);
  }
  PetscCall(GhostedRestoreArrayRead(u, &ul));
  PetscCall(PetscFree(rule));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, mass, (PetscMPIInt)(m * m), MPIU_REAL, MPI_SUM, level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, work, (PetscMPIInt)m, MPIU_REAL, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* b = L^-1 b, or b = L^-T b */
static void MinimumNormSubstitute_Private(PetscInt n, const PetscReal L[], PetscBool transposed, PetscReal b[])
{
  for (PetscInt j = 0; j < n; j++) {
    const PetscInt i = transposed ? n - 1 - j : j;

    for (PetscInt k = transposed ? i + 1 : 0; k < (transposed ? n : i); k++)
      b[i] -= (transposed ? L[k * n + i] : L[i * n + k]) * b[k];
    b[i] /= L[i * n + i];
  }
}

/* The free motion N's that brings u nearest to zero without penetration. In w = L's, with LL' = N M N' of the
   mass M, it is the projection of -L^-1 N work onto a polyhedron. [in] kernel - N [n][m]; [out] q - [m] */
static PetscErrorCode MinimumNormSolve_Private(const Cone *cone, const MinimumNorm *problem, PetscInt n,
                                               const PetscReal kernel[], PetscReal q[])
{
  const PetscInt m     = cone->m;
  Cone           small = {.comm = cone->comm, .m = n};
  PetscReal     *L, *target, *w, *rows, *bound;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc5(n * n, &L, n, &target, n, &w, cone->num * n, &rows, cone->num, &bound));
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt k = 0; k < m; k++) {
      target[i] -= kernel[i * m + k] * problem->work[k];
      for (PetscInt j = 0; j < n; j++)
        for (PetscInt l = 0; l < m; l++)
          L[i * n + j] += kernel[i * m + k] * problem->mass[k * m + l] * kernel[j * m + l];
    }
  }
  PetscCheck(DenseCholesky(n, L), cone->comm, PETSC_ERR_PLIB, "free motions are not independent");
  MinimumNormSubstitute_Private(n, L, PETSC_FALSE, target);
  for (PetscInt r = 0; r < cone->num; r++) {
    PetscReal *row = &rows[small.num * n];

    if (problem->pressed[r]) continue;
    for (PetscInt i = 0; i < n; i++) {
      row[i] = 0;
      for (PetscInt k = 0; k < m; k++) row[i] += cone->rows[r * m + k] * kernel[i * m + k];
    }
    MinimumNormSubstitute_Private(n, L, PETSC_FALSE, row); /* row.s = (L^-1 row).w */
    bound[small.num++] = PetscMax(problem->slack[r], 0);
  }
  small.rows = rows;
  PetscCall(ConeProject(&small, bound, target, w));
  MinimumNormSubstitute_Private(n, L, PETSC_TRUE, w);
  for (PetscInt k = 0; k < m; k++) {
    q[k] = 0;
    for (PetscInt i = 0; i < n; i++) q[k] += kernel[i * m + k] * w[i];
  }
  PetscCall(PetscFree5(L, target, w, rows, bound));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest change of a closed gap by a motion: roundoff, unless contact hardly resists the motion.
   [in] take - pressed rows [num]; [in] q - [m] */
static PetscErrorCode MinimumNormGetSlip_Private(const Cone *cone, const PetscBool take[], const PetscReal q[],
                                                 PetscReal *slip)
{
  PetscFunctionBeginUser;
  *slip = 0;
  for (PetscInt r = 0; r < cone->num; r++) {
    PetscReal closing = 0;

    for (PetscInt k = 0; k < cone->m && take[r]; k++) closing += cone->rows[r * cone->m + k] * q[k];
    *slip = PetscMax(*slip, PetscAbsReal(closing));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, slip, 1, MPIU_REAL, MPI_MAX, cone->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A free motion on which the loads do work, where that is no roundoff. Then the state is
   no solution: contacts with friction have let go of a body, and the loads carry it away.
   [in] n, kernel - the free motions [n][m]; [out] q - [m] */
static PetscBool MinimumNormIsDriven_Private(Solvability s, PetscInt n, const PetscReal kernel[], PetscReal q[])
{
  PetscReal square = 0;

  PetscArrayzero(q, s->m);
  for (PetscInt i = 0; i < n; i++) {
    PetscReal work = 0;

    for (PetscInt k = 0; k < s->m; k++) work += s->work[k] * kernel[i * s->m + k];
    for (PetscInt k = 0; k < s->m; k++) q[k] += work * kernel[i * s->m + k];
    square += PetscSqr(work);
  }
  return (PetscBool)(PetscSqrtReal(square) > DRIVEN * s->forces);
}

/* Sets the free motions, which depend on the pressures, or the driven one. */
static PetscErrorCode MinimumNormSetFreeMotions_Private(VI vi, Solvability s, PetscInt n, const PetscReal kernel[])
{
  PetscBool  driven;
  PetscReal *q;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < s->num_free; i++) PetscCall(SceneMotionDestroy(&s->free[i]));
  PetscCall(PetscFree(s->free));
  PetscCall(SceneMotionDestroy(&s->driven));
  s->num_free = 0;
  PetscCall(PetscMalloc1(s->m, &q));
  driven = MinimumNormIsDriven_Private(s, n, kernel, q);
  if (driven) PetscCall(SceneMotionCreate(vi, s, q, &s->driven));
  PetscCall(PetscFree(q));
  if (driven) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1(n, &s->free));
  s->num_free = n;
  for (PetscInt i = 0; i < n; i++) PetscCall(SceneMotionCreate(vi, s, &kernel[i * s->m], &s->free[i]));
  if (s->status == SOLVABLE || s->status == SOLVABLE_FREE) s->status = n ? SOLVABLE_FREE : SOLVABLE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How far contacts are from closing. [in,out] slack - of rows of contact, others unchanged [vi->num_rows] */
static PetscErrorCode MinimumNormGetSlack_Private(VI vi, Solvability s, Vec y, PetscReal slack[])
{
  const PetscInt     first = vi->level->dim * vi->level->node_begin;
  const PetscScalar *ya, *upper;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(y, &ya));
  PetscCall(VecGetArrayRead(vi->upper, &upper));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const PetscInt i = vi->row_dof[r] - first;

    if ((s->tangent && s->tangent[r]) || s->nodal.equality[r]) continue;
    slack[r] = vi->length * PetscRealPart(upper[i] - ya[i]);
  }
  PetscCall(VecRestoreArrayRead(vi->upper, &upper));
  PetscCall(VecRestoreArrayRead(y, &ya));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MinimumNormApply(VI vi, Solvability s, Vec y)
{
  Cone        cone;
  Vec         u;
  MinimumNorm problem;
  PetscReal  *kernel, *q, *rows = NULL;
  PetscInt    n;

  PetscFunctionBeginUser;
  if (!s || s->status == SOLVABLE_NOT) PetscFunctionReturn(PETSC_SUCCESS);
  cone = ContactRowsCone(vi, s, &s->nodal);
  PetscCall(PetscCalloc6(vi->num_rows, &problem.pressed, vi->num_rows, &problem.slack, s->m * s->m, &kernel,
                         s->m * s->m, &problem.mass, s->m, &problem.work, s->m, &q));
  PetscCall(LevelCreateVec(vi->level, vi->level->dim, &u));
  PetscCall(VIRecoverDisplacement(vi, y, u));
  PetscCall(MinimumNormFindPressed_Private(vi, s, u, problem.pressed));
  if (vi->friction) {
    PetscCall(PetscMalloc1(vi->num_rows * s->m, &rows));
    PetscCall(FrictionRowsTakePressed(vi, s, problem.pressed, rows));
    cone.rows = rows;
  }
  PetscCall(ConeKernel(&cone, problem.pressed, &n, kernel));
  PetscCall(MinimumNormSetFreeMotions_Private(vi, s, n, kernel));
  if (n) {
    PetscCall(MinimumNormGetSlack_Private(vi, s, y, problem.slack));
    PetscCall(MinimumNormGetMass_Private(vi, u, problem.mass, problem.work));
    PetscCall(MinimumNormSolve_Private(&cone, &problem, n, kernel, q));
    PetscCall(MinimumNormGetSlip_Private(&cone, problem.pressed, q, &s->slip));
    for (PetscInt k = 0; k < s->m; k++) PetscCall(VecAXPY(y, q[k] / vi->length, s->modes[k]));
  }
  PetscCall(VecDestroy(&u));
  PetscCall(PetscFree(rows));
  PetscCall(PetscFree6(problem.pressed, problem.slack, kernel, problem.mass, problem.work, q));
  PetscFunctionReturn(PETSC_SUCCESS);
}
