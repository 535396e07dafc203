/* goals.c -- dual solutions, and marking for them [1].

   [1] Becker, Estecahandy, Trujillo, Weighted marking for goal-oriented adaptive finite element methods,
   2011. */
#include "study/goals.h"
#include "base/compat.h"
#include "base/json.h"
#include "result/goal.h"
#include "solve/dualsolve.h"
#include "study/marking.h"
#include <math.h>

/* Solves the dual problems of all goals together.
   [out] goal - GoalDestroy() [num]; [out] z - owned by the caller, VecDestroyVecs() [num]; [out] solved -
   whether all are */
static PetscErrorCode GoalsSolveDual_Private(Run run, Goal goal[], Vec **z, PetscBool *solved)
{
  const Scene    scene = run->scene;
  const PetscInt num   = scene->adapt.num_goals;
  Vec           *b;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicateVecs(run->y, num, &b));
  PetscCall(VecDuplicateVecs(run->y, num, z));
  for (PetscInt g = 0; g < num; g++) {
    PetscCall(GoalCreate(run->fields, &scene->adapt.goals[g], &goal[g]));
    PetscCall(GoalLoad(&goal[g], b[g]));
  }
  PetscCall(DualSolve(run->solver, &run->report, run->y, num, b, *z, solved));
  PetscCall(VecDestroyVecs(num, &b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GoalsSolve(Run run, GoalState states[], PetscReal **indicators, PetscBool *solved)
{
  const PetscInt num = run->scene->adapt.num_goals, cells = run->vi->level->num_cells;
  Estimate       primal, dual;
  Goal          *goal;
  Vec           *z;

  PetscFunctionBeginUser;
  PetscCall(EstimateGet(run->fields, &primal));
  PetscCall(PetscMalloc1(num, &goal));
  PetscCall(PetscMalloc1(num * cells, indicators));
  PetscCall(GoalsSolveDual_Private(run, goal, &z, solved));
  for (PetscInt g = 0; g < num; g++) {
    PetscReal *own = &(*indicators)[g * cells];

    PetscCall(GoalEstimate(&goal[g], z[g], &dual));
    states[g] = (GoalState){.bar = NAN, .value = NAN, .body = goal[g].body};
    PetscCall(PetscArraycpy(states[g].at, goal[g].at, 3));
    for (PetscInt c = 0; c < cells; c++) {
      states[g].product += PetscSqrtReal(primal->cell[c] * dual->cell[c]);
      own[c] = (primal->squared > 0 ? primal->cell[c] / primal->squared : 0) +
               (dual->squared > 0 ? dual->cell[c] / dual->squared : 0);
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &states[g].product, 1, MPIU_REAL, MPI_SUM, run->scene->comm));
    PetscCall(EstimateDestroy(&dual));
    PetscCall(GoalDestroy(&goal[g]));
  }
  PetscCall(VecDestroyVecs(num, &z));
  PetscCall(PetscFree(goal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The object of a block of the summary with the number of a goal, or NULL. [out] key - of the number */
static cJSON *GoalsFind_Private(const Scene scene, const SceneGoal *goal, const cJSON *block, const char **key)
{
  const PetscBool probe = (PetscBool)(goal->kind == GOAL_PROBE);
  const char     *name  = probe ? scene->probes[goal->owner].name : scene->pairs[goal->owner].name;

  *key = probe ? "von_mises" : goal->kind == GOAL_FORCE ? "normal_force" : "max_pressure";
  return cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(block, probe ? "probes" : "pairs"), name);
}

PetscErrorCode GoalsRaiseBars(Scene scene, const cJSON *row, cJSON *bars, GoalState states[])
{
  PetscFunctionBeginUser;
  for (PetscInt g = 0; g < scene->adapt.num_goals; g++) {
    const SceneGoal *goal = &scene->adapt.goals[g];
    const char      *key;
    cJSON           *object = GoalsFind_Private(scene, goal, bars, &key);
    const PetscReal  bar    = JSONGetReal(object, key);

    states[g].value = JSONGetReal(GoalsFind_Private(scene, goal, row, &key), key);
    states[g].bar   = PetscIsNanReal(bar) ? bar : PetscMax(bar, states[g].product);
    cJSON_DeleteItemFromObjectCaseSensitive(object, key);
    JSONAddReal(object, key, states[g].bar);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool GoalIsMet(Scene scene, const GoalState *state)
{
  return (PetscBool)(state->bar <= scene->adapt.goal_tolerance * PetscAbsReal(state->value));
}

PetscBool GoalsAreMet(Scene scene, const GoalState states[])
{
  for (PetscInt g = 0; g < scene->adapt.num_goals; g++) {
    if (!GoalIsMet(scene, &states[g])) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

PetscErrorCode GoalsMark(Run run, PetscBool energy, const GoalState states[], const PetscReal indicators[],
                         PetscInt **marked, PetscReal *growth)
{
  const Scene     scene = run->scene;
  const PetscInt  cells = run->vi->level->num_cells;
  const PetscBool all   = (PetscBool)(!energy && GoalsAreMet(scene, states));
  Estimate        primal;
  PetscReal      *sum;

  PetscFunctionBeginUser;
  PetscCall(EstimateGet(run->fields, &primal));
  PetscCall(PetscCalloc1(cells, &sum));
  for (PetscInt c = 0; c < cells; c++) {
    if (energy) sum[c] = primal->cell[c] / primal->squared;
    for (PetscInt g = 0; g < scene->adapt.num_goals; g++) {
      if (all || !GoalIsMet(scene, &states[g])) sum[c] += indicators[g * cells + c];
    }
  }
  PetscCall(
      MarkingCreate(run->vi->level, sum, primal->norm / primal->squared, scene->adapt.marking, all, marked, growth));
  PetscCall(PetscFree(sum));
  for (PetscInt g = 0; g < scene->adapt.num_goals; g++) {
    const GoalState *state = &states[g];
    const PetscReal  limit = scene->adapt.goal_tolerance * PetscAbsReal(state->value);
    PetscReal        size;

    if (state->body >= 0 && state->product <= limit && state->bar > limit)
      PetscCall(LevelLocateAll(run->vi->level, state->body, state->at, *marked, &size));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
