/* solvability.c -- whether the loads do work on a rigid motion that nothing resists.

   The work of the loads on rigid motions decides existence [1, 2]. The energy of the discrete problem is
   quadratic, so a minimum exists exactly if the energy is bounded below [3]. That means phi.q <= 0 wherever C
   q <= 0. Gaps do not matter: they shift the admissible motions, but do not change their recession
   directions. Let rho be the residual of the least squares problem C'y = phi, y >= 0. If rho is zero, y are
   contact forces that balance the loads; otherwise rho is a motion that nothing resists (nnls.h).

   References: [1] Lions, Stampacchia, Variational inequalities, 1967. [2] Fichera, Boundary value problems of
   elasticity with
               unilateral constraints, 1972. [3] Frank, Wolfe, An algorithm for quadratic programming,
   1956. */
#include "base/compat.h"
#include "base/log.h"
#include "kernel/dense.h"
#include "rigid/rigidimpl.h"

/* Loads are in balance if the residual is below this part of the sum of forces. */
static const PetscReal BALANCED = 1e-10;
/* The same where two curved surfaces meet: a mesh gives their common normal to a few digits only. Half of the
   certificate's limit. */
static const PetscReal BALANCED_CURVED = 5e-7;
/* Surfaces whose normals differ by more are curved. */
static const PetscReal CURVED = 1e-6;
/* Free motions are added to a reported motion if they change its work by less than this part. */
static const PetscReal WORK_CHANGE = 1e-3;
/* Rounding of the residual along a row in use. */
static const PetscReal RESIDUAL_ROUNDING = 1e-13;
/* Marginal loads leave the cone if they are moved away from its middle by this part of themselves ... */
static const PetscReal PERTURBATION = 1e-6;
/* ... by at least this distance. */
static const PetscReal OUTSIDE = 1e-11;
/* A motion that opens no contact by more than this part of its size is a free motion. On curved sides, rows
   that have taken over those of removed nodes are not more accurate. */
static const PetscReal OPENING = 1e-3;
/* Loads that this part of the coefficients does not hold are hardly held. */
static const PetscReal LESS_FRICTION = 0.98;

/* u of mode k. Not collective. [out] u - ghosted, ghosts not set */
static PetscErrorCode SolvabilityGetModeDisplacement_Private(VI vi, PetscInt k, Vec u)
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

/* Sets work and forces. */
static PetscErrorCode SolvabilitySetLoads_Private(VI vi, Solvability s)
{
  const Level       *level = vi->level;
  const PetscInt     dim   = level->dim;
  Vec                u;
  const PetscScalar *f;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(vi->f, &u));
  for (PetscInt k = 0; k < s->m; k++) {
    PetscCall(SolvabilityGetModeDisplacement_Private(vi, k, u));
    PetscCall(VecDot(vi->f, u, &s->work[k]));
  }
  PetscCall(VecDestroy(&u));
  s->forces = 0;
  PetscCall(VecGetArrayRead(vi->f, &f));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    if (!vi->rigid_modes.loose[vi->rigid_modes.components.of_node[a]]) continue;
    for (PetscInt k = 0; k < dim; k++) s->forces += PetscAbsReal(PetscRealPart(f[a * dim + k]));
  }
  PetscCall(VecRestoreArrayRead(vi->f, &f));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &s->forces, 1, MPIU_REAL, MPI_SUM, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets modes and rows of C. */
static PetscErrorCode SolvabilitySetMatrices_Private(VI vi, Solvability s)
{
  const Level       *level = vi->level;
  const PetscInt     dim = level->dim, first = dim * level->node_begin;
  Vec                u;
  const PetscScalar *y;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(vi->f, &u));
  for (PetscInt k = 0; k < s->m; k++) {
    PetscCall(SolvabilityGetModeDisplacement_Private(vi, k, u));
    PetscCall(VecDuplicate(vi->upper, &s->modes[k]));
    PetscCall(VIApplyInverseBasis(vi, u, s->modes[k]));
    PetscCall(VecGetArrayRead(s->modes[k], &y));
    for (PetscInt r = 0; r < vi->num_rows; r++) s->nodal.rows[r * s->m + k] = PetscRealPart(y[vi->row_dof[r] - first]);
    PetscCall(VecRestoreArrayRead(s->modes[k], &y));
  }
  PetscCall(VecDestroy(&u));
  for (PetscInt r = 0; r < vi->num_rows; r++)
    s->nodal.equality[r] = (PetscBool)(vi->pairs[vi->row_pair[r]]->spec->type == PAIR_TIED);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the points of rows: their nodes, and the component of the mortar node with the largest entry of M. */
static PetscErrorCode SolvabilitySetPlaces_Private(VI vi, Solvability s)
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

    s->nodal.place[r].piece[0] = vi->rigid_modes.components.of_node[a];
    for (PetscInt k = 0; k < dim; k++) s->nodal.place[r].x[k] = level->coords[a * dim + k];
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
  for (PetscInt r = 0; r < vi->num_rows; r++) s->nodal.place[r].piece[1] = piece[r];
  PetscCall(PetscFree2(node, piece));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The residual of phi in the cone of the rows, restricted to chosen modes.
   [in] phi - work / forces; [in] take - chosen modes, NULL for all [m]; [out] rho - [m]; [out] weight - of
   the rows, or NULL; [out] norm - of rho */
static PetscErrorCode SolvabilityProjectLoads_Private(const Cone *cone, const PetscReal phi[], const PetscBool take[],
                                                      PetscReal rho[], PetscReal weight[], PetscReal *norm)
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
  PetscCall(ConeSolve(&part, RESIDUAL_ROUNDING, &nnls, weight));
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

/* Adds free motions to q so that closed contacts slide least: then a body that tips rotates about its edge.
   The sum of squares of the slips is a quadratic form of the free part. [in,out] q - [m] */
static PetscErrorCode SolvabilityMinimizeSlip_Private(VI vi, const Cone *cone, const ContactPlace place[],
                                                      PetscReal q[])
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
    if (opening > PERTURBATION * size) continue;
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
  for (PetscInt i = 0; i < n; i++) { // along each eigenvector that the form determines
    PetscReal part = 0;

    if (!(values[i] > BALANCED * largest)) continue;
    for (PetscInt j = 0; j < n; j++) part += V[j * n + i] * sums[j] / values[i];
    for (PetscInt j = 0; j < n; j++)
      for (PetscInt k = 0; k < m; k++) q[k] += part * V[j * n + i] * kernel[j * m + k];
  }
  PetscCall(PetscFree6(kernel, gram, values, V, one, sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void SolvabilityMarkStraight(VI vi, PetscBool straight[])
{
  for (PetscInt k = 0; k < vi->rigid_modes.num; k++) {
    const PetscReal *r = &vi->rigid_modes.mode[k * RIGID_COMPONENTS + 3];

    straight[k] = (PetscBool)(PetscSqr(r[0]) + PetscSqr(r[1]) + PetscSqr(r[2]) < PetscSqr(BALANCED));
  }
}

/* Sets the motion that shows SOLVABLE_NOT: the simplest one, without rotations if possible. */
static PetscErrorCode SolvabilitySetUnresistedMotion_Private(VI vi, const Cone *cone, const ContactPlace place[],
                                                             const PetscReal phi[], const PetscReal rho[],
                                                             PetscReal balanced, Solvability s)
{
  PetscBool *straight;
  PetscReal *q, norm;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(s->m, &straight, s->m, &q));
  SolvabilityMarkStraight(vi, straight);
  PetscCall(SolvabilityProjectLoads_Private(cone, phi, straight, q, NULL, &norm));
  s->status = SOLVABLE_NOT;
  if (!(norm > balanced)) {
    PetscReal work = 0, changed = 0;

    PetscCall(PetscArraycpy(q, rho, s->m));
    PetscCall(SolvabilityMinimizeSlip_Private(vi, cone, place, q));
    for (PetscInt k = 0; k < s->m; k++) {
      work += phi[k] * rho[k];
      changed += phi[k] * q[k];
    }
    if (PetscAbsReal(changed - work) > WORK_CHANGE * work) PetscCall(PetscArraycpy(q, rho, s->m));
  }
  PetscCall(SceneMotionCreate(vi, s, q, &s->motion));
  PetscCall(PetscFree2(straight, q));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a motion opens contacts and moves a loaded component. Collective.
   [in,out] opens - set for rows that it opens [cone->num] */
static PetscErrorCode SolvabilityMovesLoads_Private(VI vi, const Cone *cone, const PetscReal phi[], const PetscReal q[],
                                                    PetscBool opens[], PetscBool *loads)
{
  PetscReal size = 0, widest = 0;

  PetscFunctionBeginUser;
  *loads = PETSC_FALSE;
  for (PetscInt k = 0; k < cone->m; k++) size = PetscMax(size, PetscAbsReal(q[k]));
  for (PetscInt k = 0; k < cone->m; k++) {
    if (PetscAbsReal(q[k]) <= PERTURBATION * size) continue;
    for (PetscInt l = 0; l < cone->m; l++)
      if (vi->rigid_modes.component[l] == vi->rigid_modes.component[k] && PetscAbsReal(phi[l]) > BALANCED)
        *loads = PETSC_TRUE;
  }
  for (PetscInt r = 0; r < cone->num; r++) {
    PetscReal opening = 0;

    for (PetscInt k = 0; k < cone->m; k++) opening -= cone->rows[r * cone->m + k] * q[k];
    if (opening > PERTURBATION * size) opens[r] = PETSC_TRUE;
    widest = PetscMax(widest, opening);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &widest, 1, MPIU_REAL, MPIU_MAX, cone->comm));
  if (!(widest > OPENING * size)) *loads = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets SOLVABLE_MARGINAL if balanced loads lie on the boundary of the cone. Then a small step away from the
   middle of the cone leaves it, along a motion that opens contacts at no cost. Motions of bodies without
   loads do not count. */
static PetscErrorCode SolvabilityFindMarginalMotion_Private(VI vi, const Cone *cone, const PetscReal phi[],
                                                            Solvability s)
{
  PetscBool *opens, loads = PETSC_FALSE;
  PetscReal *middle, *q, norm, size;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(s->m + 1, &middle, s->m, &q)); // the last entry is a sum of absolute values
  PetscCall(PetscCalloc1(cone->num, &opens));
  for (PetscInt round = 0; round <= vi->scene->num_bodies; round++) {
    PetscCall(PetscArrayzero(middle, s->m + 1));
    for (PetscInt r = 0; r < cone->num; r++) {
      for (PetscInt k = 0; k < s->m && !opens[r] && !cone->equality[r]; k++) {
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
    /* rows that cancel, as around a pin in a hole: the cone has no boundary, and the sum is rounding */
    if (!(size > BALANCED * middle[s->m]) || !(norm > BALANCED)) break;
    for (PetscInt k = 0; k < s->m; k++) middle[k] = phi[k] / norm - PERTURBATION * middle[k] / size;
    PetscCall(SolvabilityProjectLoads_Private(cone, middle, NULL, q, NULL, &norm));
    if (!(norm > OUTSIDE)) break;
    PetscCall(SolvabilityMovesLoads_Private(vi, cone, phi, q, opens, &loads));
    if (loads) {
      s->status = SOLVABLE_MARGINAL;
      PetscCall(SolvabilityMinimizeSlip_Private(vi, cone, s->forces_at.place, q));
      PetscCall(SceneMotionCreate(vi, s, q, &s->motion));
      break;
    }
  }
  PetscCall(PetscFree(opens));
  PetscCall(PetscFree2(middle, q));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Residual below which loads count as balanced. Between two curved surfaces normals have a few digits only,
   and so has the residual along a motion that they hardly resist. Collective. */
static PetscErrorCode SolvabilityChooseTolerance_Private(VI vi, PetscReal *balanced)
{
  const PetscInt dim = vi->level->dim;

  PetscFunctionBeginUser;
  *balanced = BALANCED;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const Pair pair = vi->pairs[p];
    PetscReal  most[6]; // maxima of n and of -n

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
      if (most[k] + most[3 + k] > CURVED) *balanced = BALANCED_CURVED;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Subtracts from the loads their residual outside the cone, which is more than rounding only between curved
   surfaces. No solution could carry it, and the proximal point iteration would not converge. It stays in the
   uncondensed KKT system, and so in the certificate.
   [in] rho - residual of the loads [m] */
static PetscErrorCode SolvabilitySubtractResidual_Private(VI vi, Solvability s, const PetscReal rho[])
{
  PetscReal *part;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->m, &part));
  PetscCall(SolvabilityFindModes(s, rho, part));
  for (PetscInt k = 0; k < s->m; k++) {
    PetscCall(VecAXPY(vi->b, -part[k] / (vi->stiffness * vi->length), s->modes[k]));
    s->work[k] -= rho[k];
  }
  PetscCall(PetscFree(part));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Modes of the bodies that the motion moves. Collective.
   [out] take - [m]; [out] rubs - whether they slide with friction */
static PetscErrorCode SolvabilityTakeMoved_Private(VI vi, const struct _n_Solvability *s, PetscBool take[],
                                                   PetscBool *rubs)
{
  PetscReal largest = 0;

  PetscFunctionBeginUser;
  *rubs = PETSC_FALSE;
  for (PetscInt k = 0; k < s->m; k++) {
    take[k] = PETSC_FALSE;
    for (PetscInt b = 0; b < s->motion.num; b++)
      if (s->motion.bodies[b].piece == vi->rigid_modes.component[k]) take[k] = PETSC_TRUE;
  }
  for (PetscInt i = 0; i < vi->num_rows * s->m; i++) largest = PetscMax(largest, PetscAbsReal(s->slide[i]));
  for (PetscInt i = 0; i < vi->num_rows * s->m; i++)
    if (take[i % s->m] && PetscAbsReal(s->slide[i]) > PERTURBATION * largest) *rubs = PETSC_TRUE;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, rubs, 1, MPIU_BOOL, MPI_LOR, vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* With friction: replaces the motion by that of the same bodies without friction, which friction is too small
   to resist, or just large enough. A motion against which no force of the cones does work would open all
   contacts. The motion stays if friction resists all translations: a tall body tips, but would slide without
   friction. [in] phi - work / forces; [in] balanced - as of SolvabilityChooseTolerance_Private() */
static PetscErrorCode SolvabilitySetSlidingMotion_Private(VI vi, const PetscReal phi[], PetscReal balanced,
                                                          Solvability s)
{
  const Cone              cone   = ContactRowsCone(vi, s, &s->overlap);
  const SolvabilityStatus status = s->status;
  PetscReal              *moved, *rho, norm;
  PetscBool              *take;

  PetscFunctionBeginUser;
  s->slides = PETSC_FALSE;
  if (!vi->friction || (status != SOLVABLE_NOT && status != SOLVABLE_MARGINAL)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc3(s->m, &moved, s->m, &rho, s->m, &take));
  PetscCall(SolvabilityTakeMoved_Private(vi, s, take, &s->slides));
  for (PetscInt k = 0; k < s->m; k++) moved[k] = take[k] ? phi[k] : 0;
  PetscCall(SolvabilityProjectLoads_Private(&cone, moved, take, rho, NULL, &norm));
  s->slides = (PetscBool)(s->slides && norm > balanced);
  if (s->slides) {
    SceneMotion with = s->motion; // friction

    PetscCall(SolvabilitySetUnresistedMotion_Private(vi, &cone, s->overlap.place, moved, rho, balanced, s));
    if (with.turns && !s->motion.turns) {
      PetscCall(SceneMotionDestroy(&s->motion));
      s->motion = with;
      s->slides = PETSC_FALSE;
    } else {
      PetscCall(SceneMotionDestroy(&with));
      s->slides = s->motion.slides; // friction resists none that opens all contacts
    }
  }
  s->status = status;
  PetscCall(PetscFree3(moved, rho, take));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets SOLVABLE_NOT where friction cannot hold the loads although the rows do: in space these are pyramids
   around cones, and tangents with a bound count as ties. [in] phi - work / forces */
static PetscErrorCode SolvabilityTryLimits_Private(VI vi, const PetscReal phi[], PetscReal balanced, Solvability s)
{
  PetscBool *take, found = PETSC_FALSE;
  PetscReal *q;

  PetscFunctionBeginUser;
  if (!vi->friction) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc2(s->m, &take, s->m, &q));
  for (PetscInt all = 0; all < 2 && !found; all++) { // without rotations if possible
    SolvabilityMarkStraight(vi, take);
    for (PetscInt k = 0; k < s->m && all; k++) take[k] = PETSC_TRUE;
    PetscCall(FrictionLimitsFindMotion(vi, s, phi, balanced, take, q, &found));
  }
  if (found) {
    PetscCall(SceneMotionDestroy(&s->motion));
    s->status = SOLVABLE_NOT;
    PetscCall(SceneMotionCreate(vi, s, q, &s->motion));
  }
  PetscCall(PetscFree2(take, q));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the status as far as it is known before the solve, and the forces that balance the loads. Balance is
   needed at the nodes and at the overlap boundary. */
static PetscErrorCode SolvabilityDecide_Private(VI vi, Solvability s)
{
  const ContactRows *rows = vi->friction ? &s->friction : &s->nodal;
  const Cone         cone = ContactRowsCone(vi, s, rows), overlap = ContactRowsCone(vi, s, &s->forces_at);
  PetscReal scale = s->forces > 0 ? s->forces : 1, *phi, *rho, *rho_overlap, *kernel, *weight, norm, norm_overlap = 0,
            balanced;
  PetscInt dim;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc4(s->m, &phi, s->m, &rho, s->m, &rho_overlap, s->m * s->m, &kernel));
  PetscCall(SolvabilityChooseTolerance_Private(vi, &balanced));
  s->undecided = balanced > BALANCED ? balanced : 0;
  for (PetscInt k = 0; k < s->m; k++) phi[k] = s->work[k] / scale;
  PetscCall(PetscCalloc1(cone.num, &weight));
  PetscCall(SolvabilityProjectLoads_Private(&cone, phi, NULL, rho, weight, &norm));
  for (PetscInt i = 0; i < cone.num; i++) {
    if (!vi->friction || !cone.equality[i]) s->balance[vi->friction ? s->friction_row[i] : i] += scale * weight[i];
  }
  PetscCall(PetscFree(weight));
  if (s->cut) {
    PetscCall(SolvabilityProjectLoads_Private(&overlap, phi, NULL, rho_overlap, NULL, &norm_overlap));
    s->coarse = (PetscBool)(norm > balanced && !(norm_overlap > balanced));
  }
  if (s->coarse) {
    PetscCall(SolvabilitySetUnresistedMotion_Private(vi, &cone, rows->place, phi, rho, balanced, s));
  } else if (norm > balanced || norm_overlap > balanced) {
    PetscCall(SolvabilitySetUnresistedMotion_Private(vi, &overlap, s->forces_at.place, phi, s->cut ? rho_overlap : rho,
                                                     balanced, s));
  } else {
    for (PetscInt k = 0; k < s->m; k++) rho[k] *= scale;
    if (norm > BALANCED) PetscCall(SolvabilitySubtractResidual_Private(vi, s, rho));
    PetscCall(ConeKernel(&cone, NULL, &dim, kernel));
    s->status = dim ? SOLVABLE_FREE : SOLVABLE;
    PetscCall(SolvabilityFindMarginalMotion_Private(vi, &overlap, phi, s));
  }
  if (s->status != SOLVABLE_NOT) PetscCall(SolvabilityTryLimits_Private(vi, phi, balanced, s));
  PetscCall(SolvabilitySetSlidingMotion_Private(vi, phi, balanced, s));
  PetscCall(PetscFree4(phi, rho, rho_overlap, kernel));
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
  s->m         = vi->rigid_modes.num;
  s->nodal.num = vi->num_rows;
  PetscCall(PetscCalloc6(s->m, &s->modes, vi->num_rows * s->m, &s->nodal.rows, vi->num_rows, &s->nodal.equality, s->m,
                         &s->work, vi->num_rows, &s->balance, vi->num_rows, &s->nodal.place));
  PetscCall(SolvabilitySetPlaces_Private(vi, s));
  PetscCall(SolvabilitySetMatrices_Private(vi, s));
  PetscCall(SolvabilitySetLoads_Private(vi, s));
  PetscCall(FrictionRowsCreate(vi, s));
  PetscCall(ContactRowsCreate(vi, s));
  PetscCall(SolvabilityDecide_Private(vi, s));
  if (s->status != SOLVABLE_NOT) PetscCall(RegularizationCreate(vi, s));
  PetscCall(LogStageEnd(STAGE_CONDENSE));
  *solvability = s;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Deletes the motions. */
static PetscErrorCode SolvabilityDestroyMotions_Private(Solvability s)
{
  PetscFunctionBeginUser;
  PetscCall(SceneMotionDestroy(&s->motion));
  PetscCall(SceneMotionDestroy(&s->driven));
  for (PetscInt i = 0; i < s->num_free; i++) PetscCall(SceneMotionDestroy(&s->free[i]));
  PetscCall(PetscFree(s->free));
  s->num_free = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolvabilityUpdate(VI vi, Solvability s)
{
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LogStageBegin(STAGE_CONDENSE));
  PetscCall(SolvabilityDestroyMotions_Private(s));
  s->coarse = PETSC_FALSE;
  s->slip   = 0;
  PetscCall(PetscArrayzero(s->balance, vi->num_rows));
  PetscCall(SolvabilitySetLoads_Private(vi, s));
  PetscCall(ContactRowsUpdate(vi, s, 1)); // coefficients may have changed
  PetscCall(SolvabilityDecide_Private(vi, s));
  if (s->status != SOLVABLE_NOT)
    PetscCall(s->regularization ? RegularizationUpdate(vi, s) : RegularizationCreate(vi, s));
  PetscCall(LogStageEnd(STAGE_CONDENSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolvabilityFindHardlyHeld(VI vi, Solvability s)
{
  struct _n_Solvability before;
  SceneMotion           motion;

  PetscFunctionBeginUser;
  if (!s || !vi->friction || s->driven.num) PetscFunctionReturn(PETSC_SUCCESS);
  before        = *s;
  s->motion.num = 0;
  PetscCall(ContactRowsUpdate(vi, s, LESS_FRICTION));
  PetscCall(SolvabilityDecide_Private(vi, s));
  motion = s->motion;
  if (s->status != SOLVABLE_NOT && motion.num) PetscCall(SceneMotionDestroy(&motion));
  *s        = before;
  s->driven = motion;
  PetscCall(ContactRowsUpdate(vi, s, 1));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolvabilityDestroy(Solvability *solvability)
{
  Solvability s = *solvability;

  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt k = 0; k < s->m; k++) PetscCall(VecDestroy(&s->modes[k]));
  PetscCall(ContactRowsDestroy(s));
  PetscCall(FrictionRowsDestroy(s));
  PetscCall(PetscFree6(s->modes, s->nodal.rows, s->nodal.equality, s->work, s->balance, s->nodal.place));
  PetscCall(SolvabilityDestroyMotions_Private(s));
  PetscCall(VecDestroy(&s->start));
  PetscCall(VecDestroy(&s->regularization));
  PetscCall(VecDestroy(&s->approach));
  PetscCall(PetscFree(*solvability));
  PetscFunctionReturn(PETSC_SUCCESS);
}
