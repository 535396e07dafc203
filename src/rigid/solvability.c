/* solvability.c -- do the loads do work on a rigid motion that nothing resists?

   Existence is decided by the work of the loads on rigid motions [1, 2], here for the discrete problem, whose energy is quadratic:
   a minimum exists exactly if the energy is bounded below [3], which it is if phi.q <= 0 wherever C q <= 0. Gaps play no part: they shift
   the admissible motions, and do not change in which directions one may go for ever. The residual of the least squares problem
   C'y = phi, y >= 0, is either zero, then y are contact forces that balance the loads, or the very motion that is asked for (nnls.h).

   References: [1] Lions, Stampacchia, Variational inequalities, 1967. [2] Fichera, Boundary value problems of elasticity with
               unilateral constraints, 1972. [3] Frank, Wolfe, An algorithm for quadratic programming, 1956. */
#include "base/compat.h"
#include "base/log.h"
#include "kernel/dense.h"
#include "rigid/rigidimpl.h"

/* Loads are in balance if what is left is below this part of the sum of their sizes. */
static const PetscReal BALANCED = 1e-10;
/* The same where two curved surfaces meet: meshes know their common normal to some digits only. Half of what the certificate allows. */
static const PetscReal BALANCED_ROUND = 5e-7;
/* Normals that differ by more are those of a curved surface. */
static const PetscReal CURVED = 1e-6;
/* A motion is told with free ones added as long as these cost nothing beside its own work. */
static const PetscReal COSTS = 1e-3;
/* What rounding leaves of a residual along a row that is in use. */
static const PetscReal PRICE = 1e-13;
/* The loads are moved away from the cone's inside by this part of them: they leave it if they are that near to its rim, ... */
static const PetscReal NUDGE = 1e-6;
/* ... by at least so much. */
static const PetscReal LEFT = 1e-11;

/* u of one of vi->rigid_modes. [out] u - ghosted, ghosts not set. Not collective. */
static PetscErrorCode SetMotion_Private(VI vi, PetscInt k, Vec u)
{
  const Level     *level = vi->level;
  const PetscInt   dim = level->dim, piece = vi->rigid_modes.component[k];
  const PetscReal *motion = &vi->rigid_modes.mode[k * RIGID_COMPONENTS];
  PetscScalar     *ua;

  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(u));
  PetscCall(VecGetArray(u, &ua));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    if (vi->rigid_modes.components.of_node[i] == piece)
      RigidModesAt(dim, &vi->rigid_modes.frames[4 * piece], motion, &level->coords[i * dim], &ua[i * dim]);
  }
  PetscCall(VecRestoreArray(u, &ua));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Modes, C, phi, and the size of the forces. */
static PetscErrorCode Matrices_Private(VI vi, Solvability s)
{
  const Level       *level = vi->level;
  const PetscInt     dim = level->dim, first = dim * level->node_begin;
  Vec                u;
  const PetscScalar *f, *y;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(vi->f, &u));
  for (PetscInt k = 0; k < s->m; k++) {
    PetscCall(SetMotion_Private(vi, k, u));
    PetscCall(VecDot(vi->f, u, &s->phi[k]));
    PetscCall(VecDuplicate(vi->upper, &s->modes[k]));
    PetscCall(VIApplyInverseBasis(vi, u, s->modes[k]));
    PetscCall(VecGetArrayRead(s->modes[k], &y));
    for (PetscInt r = 0; r < vi->num_rows; r++) s->C[r * s->m + k] = PetscRealPart(y[vi->row_dof[r] - first]);
    PetscCall(VecRestoreArrayRead(s->modes[k], &y));
  }
  PetscCall(VecDestroy(&u));
  PetscCall(VecGetArrayRead(vi->f, &f));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    if (!vi->rigid_modes.loose[vi->rigid_modes.components.of_node[a]]) continue;
    for (PetscInt k = 0; k < dim; k++) s->forces += PetscAbsReal(PetscRealPart(f[a * dim + k]));
  }
  PetscCall(VecRestoreArrayRead(vi->f, &f));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &s->forces, 1, MPIU_REAL, MPI_SUM, level->comm));
  for (PetscInt r = 0; r < vi->num_rows; r++)
    s->both[r] = (PetscBool)(vi->pairs[vi->row_pair[r]]->spec->type == PAIR_TIED);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Where rows act: at their nodes, against the mortar facet that weighs most. */
static PetscErrorCode Places_Private(VI vi, Solvability s)
{
  Level         *level = vi->level;
  const PetscInt dim   = level->dim;
  PetscInt      *node, *piece;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(vi->num_rows, &node, vi->num_rows, &piece));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const Pair         pair = vi->pairs[vi->row_pair[r]];
    const PetscInt     a    = pair->nodes[vi->row_node[r]];
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscReal          largest = 0;

    s->place[r].piece[0] = vi->rigid_modes.components.of_node[a];
    for (PetscInt k = 0; k < dim; k++) s->place[r].x[k] = level->coords[a * dim + k];
    node[r] = -1;
    if (!pair->M) continue;
    PetscCall(MatGetRow(pair->M, level->node_begin + a, &num, &columns, &values));
    for (PetscInt j = 0; j < num; j++) {
      if (PetscAbsReal(PetscRealPart(values[j])) <= largest) continue;
      largest = PetscAbsReal(PetscRealPart(values[j]));
      node[r] = columns[j];
    }
    PetscCall(MatRestoreRow(pair->M, level->node_begin + a, &num, &columns, &values));
  }
  PetscCall(ComponentsOfGlobalNodes(level, &vi->rigid_modes.components, vi->num_rows, node, piece));
  for (PetscInt r = 0; r < vi->num_rows; r++) s->place[r].piece[1] = piece[r];
  PetscCall(PetscFree2(node, piece));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The residual of phi in the cone of the rows, in parts of the size of the forces; restricted to motions that are taken.
   [in] take - NULL for all [m]; [out] rho - [m]; [out] weight - of the rows, or NULL; [out] norm - of rho */
static PetscErrorCode Leaves_Private(const Cone *cone, const PetscReal phi[], const PetscBool take[], PetscReal rho[],
                                     PetscReal weight[], PetscReal *norm)
{
  Cone       part = *cone;
  PetscReal *rows, *target;
  NNLS       nnls;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(cone->num * cone->m, &rows, cone->m, &target));
  for (PetscInt r = 0; r < cone->num; r++)
    for (PetscInt k = 0; k < cone->m; k++) rows[r * cone->m + k] = !take || take[k] ? cone->rows[r * cone->m + k] : 0;
  for (PetscInt k = 0; k < cone->m; k++) target[k] = !take || take[k] ? phi[k] : 0;
  part.rows = rows;
  PetscCall(NNLSCreate(cone->m, target, &nnls));
  PetscCall(ConeSolve(&part, PRICE, &nnls, weight));
  *norm = 0;
  for (PetscInt k = 0; k < cone->m; k++) {
    rho[k] = nnls.residual[k];
    *norm += PetscSqr(rho[k]);
  }
  *norm = PetscSqrtReal(*norm);
  PetscCall(NNLSDestroy(&nnls));
  PetscCall(PetscFree2(rows, target));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Of all motions that differ from q by free ones, which cost nothing, the one that slides least where contacts stay closed: a body that
   tips turns about its edge. The sum of squares of the slips is a quadratic form in the free part. [in,out] q - [m] */
static PetscErrorCode Pin_Private(VI vi, const Cone *cone, const ContactPlace place[], PetscReal q[])
{
  const PetscInt m = cone->m;
  PetscReal     *kernel, *gram, *sums, *values, *V, *one, largest = 0, size = 0;
  PetscInt       n;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc6(m * m, &kernel, m * m + m, &gram, m, &values, m * m, &V, 3 * m, &one, m, &sums));
  PetscCall(ConeKernel(cone, NULL, &n, kernel));
  for (PetscInt k = 0; k < m; k++) size = PetscMax(size, PetscAbsReal(q[k]));
  for (PetscInt r = 0; r < cone->num; r++) {
    PetscReal opening = 0, slip[3] = {0, 0, 0};

    for (PetscInt k = 0; k < m; k++) opening -= cone->rows[r * m + k] * q[k];
    if (opening > NUDGE * size) continue;
    SceneMotionAddSlip(vi, &place[r], q, slip);
    PetscCall(PetscArrayzero(one, 3 * n));
    for (PetscInt i = 0; i < n; i++) SceneMotionAddSlip(vi, &place[r], &kernel[i * m], &one[3 * i]);
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt d = 0; d < 3; d++) {
        gram[n * n + i] -= one[3 * i + d] * slip[d];
        for (PetscInt j = 0; j < n; j++) gram[i * n + j] += one[3 * i + d] * one[3 * j + d];
      }
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, gram, (PetscMPIInt)(n * n + n), MPIU_REAL, MPI_SUM, cone->comm));
  for (PetscInt i = 0; i < n; i++) sums[i] = gram[n * n + i];
  DenseEigen(n, gram, values, V);
  for (PetscInt i = 0; i < n; i++) largest = PetscMax(largest, values[i]);
  for (PetscInt i = 0; i < n; i++) { // along each axis of the form that it knows of
    PetscReal part = 0;

    if (!(values[i] > BALANCED * largest)) continue;
    for (PetscInt j = 0; j < n; j++) part += V[j * n + i] * sums[j] / values[i];
    for (PetscInt j = 0; j < n; j++)
      for (PetscInt k = 0; k < m; k++) q[k] += part * V[j * n + i] * kernel[j * m + k];
  }
  PetscCall(PetscFree6(kernel, gram, values, V, one, sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A motion that shows that there is no solution, the simplest one: without rotations if there is one. */
static PetscErrorCode Refuse_Private(VI vi, const Cone *cone, const ContactPlace place[], const PetscReal phi[],
                                     const PetscReal rho[], PetscReal balanced, Solvability s)
{
  PetscBool *straight;
  PetscReal *q, norm;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(s->m, &straight, s->m, &q));
  for (PetscInt k = 0; k < s->m; k++) {
    const PetscReal *r = &vi->rigid_modes.mode[k * RIGID_COMPONENTS + 3];

    straight[k] = (PetscBool)(PetscSqr(r[0]) + PetscSqr(r[1]) + PetscSqr(r[2]) < PetscSqr(BALANCED));
  }
  PetscCall(Leaves_Private(cone, phi, straight, q, NULL, &norm));
  s->verdict = SOLVABLE_NOT;
  if (!(norm > balanced)) {
    PetscReal work = 0, pinned = 0;

    PetscCall(PetscArraycpy(q, rho, s->m));
    PetscCall(Pin_Private(vi, cone, place, q));
    for (PetscInt k = 0; k < s->m; k++) {
      work += phi[k] * rho[k];
      pinned += phi[k] * q[k];
    }
    if (PetscAbsReal(pinned - work) > COSTS * work) PetscCall(PetscArraycpy(q, rho, s->m));
  }
  PetscCall(SceneMotionCreate(vi, s, q, &s->motion));
  PetscCall(PetscFree2(straight, q));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a motion moves a piece that carries loads; others open contacts that nobody presses. [out] opens - rows that it opens */
static PetscErrorCode MovesLoads_Private(VI vi, const Cone *cone, const PetscReal phi[], const PetscReal q[],
                                         PetscBool opens[], PetscBool *loads)
{
  PetscReal size = 0;

  PetscFunctionBeginUser;
  *loads = PETSC_FALSE;
  for (PetscInt k = 0; k < cone->m; k++) size = PetscMax(size, PetscAbsReal(q[k]));
  for (PetscInt k = 0; k < cone->m; k++) {
    if (PetscAbsReal(q[k]) <= NUDGE * size) continue;
    for (PetscInt l = 0; l < cone->m; l++)
      if (vi->rigid_modes.component[l] == vi->rigid_modes.component[k] && PetscAbsReal(phi[l]) > BALANCED)
        *loads = PETSC_TRUE;
  }
  for (PetscInt r = 0; r < cone->num; r++) {
    PetscReal opening = 0;

    for (PetscInt k = 0; k < cone->m; k++) opening -= cone->rows[r * cone->m + k] * q[k];
    if (opening > NUDGE * size) opens[r] = PETSC_TRUE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether loads that are in balance are so on the rim of the cone only: pushed a little away from its middle they leave it, along a
   motion that opens contacts and costs nothing. Bodies without loads may always be moved away, and are looked past. */
static PetscErrorCode Marginal_Private(VI vi, const Cone *cone, const PetscReal phi[], Solvability s)
{
  PetscBool *opens, loads = PETSC_FALSE;
  PetscReal *middle, *q, norm, size;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(s->m + 1, &middle, s->m, &q)); // the last is a sum of sizes
  PetscCall(PetscCalloc1(cone->num, &opens));
  for (PetscInt round = 0; round <= vi->scene->num_bodies; round++) {
    PetscCall(PetscArrayzero(middle, s->m + 1));
    for (PetscInt r = 0; r < cone->num; r++) {
      for (PetscInt k = 0; k < s->m && !opens[r] && !cone->both[r]; k++) {
        middle[k] += cone->rows[r * s->m + k];
        middle[s->m] += PetscAbsReal(cone->rows[r * s->m + k]);
      }
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, middle, (PetscMPIInt)(s->m + 1), MPIU_REAL, MPI_SUM, cone->comm));
    size = norm = 0;
    for (PetscInt k = 0; k < s->m; k++) {
      size = PetscMax(size, PetscAbsReal(middle[k]));
      norm = PetscMax(norm, PetscAbsReal(phi[k]));
    }
    /* rows that cancel, as around a pin in a hole, have no rim, and rounding for a sum */
    if (!(size > BALANCED * middle[s->m]) || !(norm > BALANCED)) break;
    for (PetscInt k = 0; k < s->m; k++) middle[k] = phi[k] / norm - NUDGE * middle[k] / size;
    PetscCall(Leaves_Private(cone, middle, NULL, q, NULL, &norm));
    if (!(norm > LEFT)) break;
    PetscCall(MovesLoads_Private(vi, cone, phi, q, opens, &loads));
    if (loads) {
      s->verdict = SOLVABLE_MARGINAL;
      PetscCall(Pin_Private(vi, cone, s->cover.place, q));
      PetscCall(SceneMotionCreate(vi, s, q, &s->motion));
      break;
    }
  }
  PetscCall(PetscFree(opens));
  PetscCall(PetscFree2(middle, q));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Below which loads count as balanced: where both surfaces of a pair are curved, normals between them are not known to the last digit, and what
   they leave of the loads along a motion that they hardly resist is not known either. Collective. */
static PetscErrorCode ChooseBalanced_Private(VI vi, PetscReal *balanced)
{
  const PetscInt dim = vi->level->dim;

  PetscFunctionBeginUser;
  *balanced = BALANCED;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const Pair pair = vi->pairs[p];
    PetscReal  most[6]; // of n and of -n

    if (pair->spec->obstacle.kind == OBSTACLE_PLANE) continue;
    for (PetscInt k = 0; k < 6; k++) most[k] = -1;
    for (PetscInt a = 0; a < pair->num; a++) {
      for (PetscInt k = 0; k < dim; k++) {
        most[k]     = PetscMax(most[k], pair->normal[a * dim + k]);
        most[3 + k] = PetscMax(most[3 + k], -pair->normal[a * dim + k]);
      }
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 6, MPIU_REAL, MPIU_MAX, vi->level->comm));
    for (PetscInt k = 0; k < dim; k++)
      if (most[k] + most[3 + k] > CURVED) *balanced = BALANCED_ROUND;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes from the loads what they leave of the cone, which is nothing to rounding but where surfaces are round: no solution could carry it, and
   springs would pull at it for ever. It stays in the book of record, where the certificate finds it. [in] rho - of the loads [m] */
static PetscErrorCode TakeUndecided_Private(VI vi, Solvability s, const PetscReal rho[])
{
  const PetscInt m = s->m;
  PetscReal     *gram, *values, *V, *part, largest = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc4(m * m, &gram, m, &values, m * m, &V, m, &part));
  for (PetscInt i = 0; i < m; i++) PetscCall(VecMDot(s->modes[i], m, s->modes, &gram[i * m]));
  DenseEigen(m, gram, values, V);
  for (PetscInt i = 0; i < m; i++) largest = PetscMax(largest, values[i]);
  for (PetscInt i = 0; i < m; i++) {
    PetscReal along = 0;

    for (PetscInt k = 0; k < m; k++) along += V[k * m + i] * rho[k];
    for (PetscInt k = 0; k < m && values[i] > BALANCED * largest; k++) part[k] += V[k * m + i] * along / values[i];
  }
  for (PetscInt k = 0; k < m; k++) {
    PetscCall(VecAXPY(vi->b, -part[k] / (vi->stiffness * vi->length), s->modes[k]));
    s->phi[k] -= rho[k];
  }
  PetscCall(PetscFree4(gram, values, V, part));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The verdict, as far as it can be known before anything is solved, and forces that balance the loads: in the bodies, up to where they
   end, and at the nodes. */
static PetscErrorCode Judge_Private(VI vi, Solvability s)
{
  const Cone cone  = {.comm = vi->level->comm, .num = vi->num_rows, .m = s->m, .rows = s->C, .both = s->both};
  const Cone cover = {cone.comm, s->cover.num, s->m, s->cover.rows, s->cover.both};
  PetscReal  scale = s->forces > 0 ? s->forces : 1, *phi, *rho, *rho_cover, *kernel, norm, norm_cover = 0, balanced;
  PetscInt   dim;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc4(s->m, &phi, s->m, &rho, s->m, &rho_cover, s->m * s->m, &kernel));
  PetscCall(ChooseBalanced_Private(vi, &balanced));
  s->undecided = balanced > BALANCED ? balanced : 0;
  for (PetscInt k = 0; k < s->m; k++) phi[k] = s->phi[k] / scale;
  PetscCall(Leaves_Private(&cone, phi, NULL, rho, s->y, &norm));
  for (PetscInt r = 0; r < vi->num_rows; r++) s->y[r] *= scale;
  if (s->cut) {
    PetscCall(Leaves_Private(&cover, phi, NULL, rho_cover, NULL, &norm_cover));
    s->coarse = (PetscBool)(norm > balanced && !(norm_cover > balanced));
  }
  if (s->coarse) {
    PetscCall(Refuse_Private(vi, &cone, s->place, phi, rho, balanced, s));
  } else if (norm > balanced || norm_cover > balanced) {
    PetscCall(Refuse_Private(vi, &cover, s->cover.place, phi, s->cut ? rho_cover : rho, balanced, s));
  } else {
    for (PetscInt k = 0; k < s->m; k++) rho[k] *= scale;
    if (norm > BALANCED) PetscCall(TakeUndecided_Private(vi, s, rho));
    PetscCall(ConeKernel(&cone, NULL, &dim, kernel));
    s->verdict = dim ? SOLVABLE_FREE : SOLVABLE;
    PetscCall(Marginal_Private(vi, &cover, phi, s));
  }
  PetscCall(PetscFree4(phi, rho, rho_cover, kernel));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolvabilityCreate(VI vi, Solvability *solvability)
{
  Solvability s;

  PetscFunctionBeginUser;
  *solvability = NULL;
  if (!vi->rigid_modes.num) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LogStageBegin(STAGE_CONDENSE));
  PetscCall(PetscNew(&s));
  s->m = vi->rigid_modes.num;
  PetscCall(PetscCalloc6(s->m, &s->modes, vi->num_rows * s->m, &s->C, vi->num_rows, &s->both, s->m, &s->phi,
                         vi->num_rows, &s->y, vi->num_rows, &s->place));
  PetscCall(Places_Private(vi, s));
  PetscCall(Matrices_Private(vi, s));
  PetscCall(ContactRowsCreate(vi, s));
  PetscCall(Judge_Private(vi, s));
  if (s->verdict != SOLVABLE_NOT) PetscCall(RegularizationCreate(vi, s));
  PetscCall(LogStageEnd(STAGE_CONDENSE));
  *solvability = s;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolvabilityDestroy(Solvability *solvability)
{
  Solvability s = *solvability;

  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt k = 0; k < s->m; k++) PetscCall(VecDestroy(&s->modes[k]));
  PetscCall(ContactRowsDestroy(s));
  PetscCall(PetscFree6(s->modes, s->C, s->both, s->phi, s->y, s->place));
  PetscCall(SceneMotionDestroy(&s->motion));
  for (PetscInt i = 0; i < s->num_free; i++) PetscCall(SceneMotionDestroy(&s->free[i]));
  PetscCall(PetscFree(s->free));
  PetscCall(VecDestroy(&s->start));
  PetscCall(VecDestroy(&s->springs));
  PetscCall(VecDestroy(&s->rest));
  PetscCall(PetscFree(*solvability));
  PetscFunctionReturn(PETSC_SUCCESS);
}
