/* goal.c -- right-hand sides of dual problems, and the error estimates of their solutions.

   A stress at a point has no dual solution of finite energy: marking would choose only the cell of the point.
   So Q' is that of a mean about the point, over a distance that does not shrink with the mesh. The reported
   number and its bar remain those of the point. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "problem/elasticity.h"
#include "result/cellstress.h"
#include "result/goal.h"
#include "result/pairsum.h"
#include "result/probes.h"

/* R as a part of the extent of the body, or of the contact. */
static const PetscReal PROBE_RADIUS = 0.05, PRESSURE_RADIUS = 0.1;
/* R is at least this many sizes of the cell that holds the place: means over fewer points say nothing. */
static const PetscReal CELL_SIZES = 1;

/* w at x */
static PetscReal GoalGetWeight_Private(const Goal *goal, const PetscReal x[])
{
  const PetscInt dim     = goal->fields->vi->level->dim;
  PetscReal      squared = 0;

  if (!(goal->radius < PETSC_INFINITY)) return 1;
  for (PetscInt k = 0; k < dim; k++) squared += PetscSqr((x[k] - goal->at[k]) / goal->radius);
  return squared < 1 ? PetscSqr(1 - squared) : 0;
}

/* How far z moves the active nodes at x along the normal. Not collective. [in] x - [dim] */
static PetscReal GoalGetMotion_Private(const Goal *goal, const PetscReal x[])
{
  return goal->scale * GoalGetWeight_Private(goal, x);
}

/* d von Mises / d stress; zero where there is no stress. [in] stress - [6]; [out] gradient - [6] */
static void GoalGetMisesGradient_Private(const PetscReal stress[], PetscReal gradient[])
{
  const PetscReal mises = MaterialVonMises(stress), mean = (stress[0] + stress[1] + stress[2]) / 3;

  for (PetscInt k = 0; k < CELL_STRESSES; k++)
    gradient[k] = mises > 0 ? (k < 3 ? 1.5 * (stress[k] - mean) : 3 * stress[k]) / mises : 0;
}

/* The sums that become Q' of a stress. */
typedef struct {
  const Goal  *goal;
  PetscReal    gradient[CELL_STRESSES]; /* of the number, by the stress */
  PetscScalar *zero;                    /* a displacement [num_nodes][dim] */
  PetscScalar *sums;                    /* int w gradient : sigma(phi_j) [num_nodes][dim] */
  PetscReal    measure;                 /* int w */
} StressSums;

/* Adds a cell. [in] rule - of the integrals */
static PetscErrorCode GoalAddCell_Private(StressSums *to, PetscInt c, const ElementRule *stiffness,
                                          const ElementRule *rule)
{
  const Level    *level = to->goal->fields->vi->level;
  const Scene     scene = level->scene;
  const PetscInt  n = ElementNumNodes(rule->type), dim = level->dim;
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];
  CellStress      cell;
  PetscReal       weight[ELEMENT_MAX_POINTS], stress[CELL_STRESSES], det, sum = 0;

  PetscFunctionBeginUser;
  for (PetscInt q = 0; q < rule->num; q++) {
    PetscReal x[CELL_MAX_DIM] = {0, 0, 0};

    for (PetscInt i = 0; i < n; i++)
      for (PetscInt k = 0; k < dim; k++) x[k] += rule->phi[q * n + i] * level->coords[nodes[i] * dim + k];
    weight[q] = GoalGetWeight_Private(to->goal, x) * rule->weight[q] * SceneMeasure(scene, x);
    sum += weight[q];
  }
  if (sum == 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(CellStressSet(scene, level, c, stiffness, to->zero, &cell));
  for (PetscInt j = 0; j < n * dim; j++) {
    cell.u[j] = 1;
    for (PetscInt q = 0; q < rule->num; q++) {
      PetscCall(CellStressAtPoint(scene, &cell, rule, q, stress, &det, NULL));
      to->sums[nodes[j / dim] * dim + j % dim] += weight[q] * det * VectorDot(CELL_STRESSES, to->gradient, stress);
      if (!j) to->measure += weight[q] * det;
    }
    cell.u[j] = 0;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the cells of the material at the probe. Collective. [in] material - of the cell that holds it */
static PetscErrorCode GoalAddCells_Private(StressSums *to, PetscInt material)
{
  const Level *level = to->goal->fields->vi->level;
  const Scene  scene = level->scene;
  ElementRule *stiffness, *rules;

  PetscFunctionBeginUser;
  PetscCall(ElasticityRulesCreate(scene, &stiffness));
  PetscCall(PetscCalloc1(ELEMENT_COUNT, &rules));
  PetscCall(PetscCalloc1(level->num_nodes * level->dim, &to->zero));
  scene->unstrained = PETSC_TRUE;
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType type = (ElementType)level->cell_type[c];

    if (level->cell_material[c] != material) continue;
    if (!rules[type].num) ElementRuleSet(type, 2 * ElementOrder(type) + 2, &rules[type]);
    PetscCall(GoalAddCell_Private(to, c, &stiffness[type], &rules[type]));
  }
  scene->unstrained = PETSC_FALSE;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &to->measure, 1, MPIU_REAL, MPI_SUM, level->comm));
  PetscCall(PetscFree(to->zero));
  PetscCall(PetscFree(rules));
  PetscCall(PetscFree(stiffness));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Q' of von Mises' stress, at the stress that the solution has. Collective. */
static PetscErrorCode GoalSetProbe_Private(const SceneProbe *probe, Goal *goal)
{
  Level     *level = goal->fields->vi->level;
  PetscReal  u[3], stress[CELL_STRESSES], xi[3], lower[3], upper[3], size = 0;
  PetscBool  found;
  PetscInt   c, material = -1;
  StressSums to = {.goal = goal};

  PetscFunctionBeginUser;
  PetscCall(ProbesEvaluate(goal->fields, probe, u, stress));
  GoalGetMisesGradient_Private(stress, to.gradient);
  PetscCall(LevelLocate(level, probe->body, probe->at, &c, xi, &found));
  if (c >= 0) material = level->cell_material[c];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &material, 1, MPIU_INT, MPI_MAX, level->comm));
  PetscCall(LevelLocateAll(level, probe->body, probe->at, NULL, &size));
  PetscCall(LevelGetBox(level, probe->body, lower, upper));
  PetscCall(PetscArraycpy(goal->at, probe->at, 3));
  goal->body   = probe->body;
  goal->radius = PetscMax(PROBE_RADIUS * VectorDistance(level->dim, upper, lower), CELL_SIZES * size);
  PetscCall(LevelCreateVec(level, level->dim, &goal->q));
  PetscCall(GhostedGetArray(goal->q, &to.sums));
  PetscCall(GoalAddCells_Private(&to, material));
  PetscCall(GhostedRestoreArray(goal->q, &to.sums));
  PetscCall(LevelShareVec(goal->q, ADD_VALUES));
  PetscCall(LevelConformForces(level, level->dim, goal->q));
  if (to.measure > 0) PetscCall(VecScale(goal->q, 1 / to.measure));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a row is one along the normal that presses, or is tied. */
static PetscBool GoalTakesRow_Private(const Goal *goal, PetscInt r)
{
  const VI vi = goal->fields->vi;

  return (PetscBool)(vi->row_pair[r] == goal->pair && !vi->row_direction[r] &&
                     goal->fields->row_status[r] != STATUS_OPEN);
}

/* The force is sum_a W_a p_a, with W_a D_aa^-1 the motion of row a. Collective. */
static PetscErrorCode GoalSetForce_Private(PetscInt pair, Goal *goal)
{
  PetscFunctionBeginUser;
  goal->pair   = pair;
  goal->radius = PETSC_INFINITY;
  goal->scale  = 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The mean about the place of the largest pressure: sum_a w_a W_a p_a / sum_a w_a W_a. Collective. */
static PetscErrorCode GoalSetPressure_Private(PetscInt pair, Goal *goal)
{
  const VI       vi  = goal->fields->vi;
  const PetscInt dim = vi->level->dim;
  PetscReal      sum = 0;
  PairSum        of;

  PetscFunctionBeginUser;
  PetscCall(PairSumCompute(goal->fields, pair, &of));
  goal->pair = pair;
  goal->body = vi->scene->pairs[pair].nonmortar.body;
  if (!of.active) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscArraycpy(goal->at, of.max_pressure_at, dim));
  goal->radius = PetscMax(PRESSURE_RADIUS * VectorDistance(dim, of.upper, of.lower), PETSC_SMALL * vi->length);
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (GoalTakesRow_Private(goal, r))
      sum += goal->fields->row_weight[r] *
             GoalGetWeight_Private(goal, &vi->level->coords[vi->pairs[pair]->nodes[vi->row_node[r]] * dim]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPIU_REAL, MPI_SUM, vi->level->comm));
  goal->scale = sum > 0 ? 1 / sum : 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* z of the rows of the goal's pair. */
static PetscErrorCode GoalSetLift_Private(Goal *goal)
{
  const VI     vi = goal->fields->vi;
  PetscScalar *lift;
  PetscInt     begin;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(vi->upper, &goal->lift));
  PetscCall(VecZeroEntries(goal->lift));
  PetscCall(VecGetOwnershipRange(goal->lift, &begin, NULL));
  PetscCall(VecGetArray(goal->lift, &lift));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (goal->pair < 0 || !GoalTakesRow_Private(goal, r)) continue;
    lift[vi->row_dof[r] - begin] =
        goal->fields->row_weight[r] / vi->row_D[r] *
        GoalGetMotion_Private(goal, &vi->level->coords[vi->pairs[goal->pair]->nodes[vi->row_node[r]] * vi->level->dim]);
  }
  PetscCall(VecRestoreArray(goal->lift, &lift));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GoalCreate(Fields fields, const SceneGoal *spec, Goal *goal)
{
  const Scene scene = fields->vi->scene;

  PetscFunctionBeginUser;
  *goal = (Goal){.fields = fields, .pair = -1, .body = -1, .radius = PETSC_INFINITY};
  switch (spec->kind) {
  case GOAL_FORCE: PetscCall(GoalSetForce_Private(spec->owner, goal)); break;
  case GOAL_PRESSURE: PetscCall(GoalSetPressure_Private(spec->owner, goal)); break;
  default: PetscCall(GoalSetProbe_Private(&scene->probes[spec->owner], goal));
  }
  PetscCall(GoalSetLift_Private(goal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GoalDestroy(Goal *goal)
{
  PetscFunctionBeginUser;
  PetscCall(VecDestroy(&goal->q));
  PetscCall(VecDestroy(&goal->lift));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* T'(q - K T y). [out] r - layout of vi->b */
static PetscErrorCode GoalGetResidual_Private(const Goal *goal, Vec y, Vec r)
{
  const VI vi = goal->fields->vi;
  Vec      u, residual;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(vi->level, vi->level->dim, &u));
  PetscCall(VecDuplicate(vi->upper, &residual));
  PetscCall(VIRecoverDisplacement(vi, y, u));
  PetscCall(MatMult(vi->K, u, residual));
  PetscCall(VecScale(residual, -1 / vi->length)); // u = length T y
  if (goal->q) PetscCall(VecAXPY(residual, 1, goal->q));
  if (vi->T)
    PetscCall(MatMultTranspose(vi->T, residual, r));
  else
    PetscCall(VecCopy(residual, r));
  PetscCall(VecDestroy(&residual));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GoalLoad(const Goal *goal, Vec b)
{
  const VI     vi = goal->fields->vi;
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(GoalGetResidual_Private(goal, goal->lift, b));
  PetscCall(VecScale(b, 1 / vi->stiffness));
  PetscCall(VecGetArray(b, &a));
  for (PetscInt i = 0; i < vi->num_fixed; i++) a[vi->fixed_local[i]] = 0;
  PetscCall(VecRestoreArray(b, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The dual solution as fields: displacement, stress, multiplier. Collective. [in] y - with the lift */
static PetscErrorCode GoalCreateFields_Private(const Goal *goal, Vec y, Fields *dual)
{
  const VI           vi = goal->fields->vi;
  const PetscScalar *a;
  PetscScalar       *lambda;
  PetscInt           begin;
  Vec                r;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(dual));
  (*dual)->vi = vi;
  PetscCall(LevelCreateVec(vi->level, vi->level->dim, &(*dual)->u));
  PetscCall(VecDuplicate(y, &r));
  PetscCall(VecCopy(y, r));
  PetscCall(VecScale(r, 1 / vi->length));
  PetscCall(VIRecoverDisplacement(vi, r, (*dual)->u));
  PetscCall(StressCreate(vi->scene, vi->level, (*dual)->u, &(*dual)->stress));
  if (vi->B) {
    PetscCall(VecDuplicate(vi->G, &(*dual)->lambda));
    PetscCall(GoalGetResidual_Private(goal, y, r));
    PetscCall(VecGetOwnershipRange(r, &begin, NULL));
    PetscCall(VecGetArrayRead(r, &a));
    PetscCall(VecGetArray((*dual)->lambda, &lambda));
    for (PetscInt i = 0; i < vi->num_rows; i++) lambda[i] = a[vi->row_dof[i] - begin] / vi->row_D[i];
    PetscCall(VecRestoreArray((*dual)->lambda, &lambda));
    PetscCall(VecRestoreArrayRead(r, &a));
  }
  PetscCall(VecDestroy(&r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscReal GoalMotionFn(void *ctx, PetscInt p, const PetscReal x[])
{
  const Goal *goal = ctx;

  return p == goal->pair ? GoalGetMotion_Private(goal, x) : 0;
}

PetscErrorCode GoalEstimate(Goal *goal, Vec z, Estimate *estimate)
{
  const Scene          scene  = goal->fields->vi->scene;
  const EstimateFrozen frozen = {.solution = goal->fields, .motion = GoalMotionFn, .ctx = goal};
  Fields               dual;
  Vec                  y;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(z, &y));
  PetscCall(VecWAXPY(y, 1, goal->lift, z));
  scene->unstrained = PETSC_TRUE;
  PetscCall(GoalCreateFields_Private(goal, y, &dual));
  PetscCall(EstimateCreateFrozen(dual, &frozen, estimate));
  scene->unstrained = PETSC_FALSE;
  PetscCall(FieldsDestroy(&dual));
  PetscCall(VecDestroy(&y));
  PetscFunctionReturn(PETSC_SUCCESS);
}
