/* nestediteration.c -- nested iteration: each level starts from the solution of the coarser one.

   The coarser mesh has the solution up to its discretization error, and the ends of contact up to one of its
   facets. The finer level needs few steps, and coarse levels are cheap. No system there needs more accuracy
   than the discretization error. The ends of contact on the finer mesh are then predicted
   (activeprediction.c). */
#include <string.h>
#include "base/compat.h"
#include "pdas/pdas.h"
#include "rigid/solvability.h"
#include "pdas/pdasimpl.h"
#include "solve/nestediteration.h"
#include "multigrid/activeprediction.h"
#include "multigrid/multigrid.h"
#include "solve/solverimpl.h"
#include "solve/discretizationstop.h"

/* Tolerance on the coarsest level, without an estimate of the discretization error. */
static const PetscReal COARSEST_RTOL = 1e-4;
/* Tolerances of SNES types without error estimate: relative to the initial residual of a level, and of each
   system. */
static const PetscReal NESTED_OTHER_RTOL = 1e-3, NESTED_OTHER_KSP_RTOL = 1e-2;
/* An unknown is initially active if this part of its prolongation is active. */
static const PetscReal ACTIVE_SHARE = 0.5;
/* The same of contact with friction. A node between an open and a closed one is open: its gap may be large,
   and the first step keeps the decisions. */
static const PetscReal CLOSED_SHARE = 0.51;
/* An unknown that is prolonged counts as on its bound within this part of the largest one: rounding. */
static const PetscReal ON_BOUND = 1e-9;
/* Largest number of sets on a level that is only a start for the next one. */
enum { NESTED_MAX_SETS = 12 };
/* Prefix of the options on coarser levels. */
static const char PREFIX[] = "nested_";

/* The state of a level before or after its solve. */
typedef struct {
  Vec            y;
  Vec            active;          /* its set: 1 or 0 */
  FrictionReport friction;        /* of the last level that was solved, no nodes if it did not converge */
  PetscBool      prolonged;       /* whether y and active come from a coarser level */
  PetscReal      energy_decrease; /* twice the energy that y has less than the displacement of that level */
} State;

/* The way from the first level that is solved to the finest one. */
typedef struct {
  MeshLevels   levels;
  SNESType     type;
  PC           pc;          /* for cycles before the first system of the finest level, or NULL */
  Solvability *solvability; /* of each level but the finest [levels->num] */
  Proximal    *proximal;    /* of the finest level */
  Proximal     own[2];      /* of a coarser level and the next one, alternating: they must not be moved */
} Ascent;

/* Zero, without contact. [out] state - to be destroyed by NestedIterationStateDestroy_Private() */
static PetscErrorCode NestedIterationStateCreate_Private(const HierarchyLevel *level, State *state)
{
  PetscFunctionBeginUser;
  *state = (State){.prolonged = PETSC_FALSE};
  PetscCall(VecDuplicate(level->op.b, &state->y));
  PetscCall(VecDuplicate(state->y, &state->active));
  PetscCall(VecZeroEntries(state->y));
  PetscCall(VecZeroEntries(state->active));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode NestedIterationStateDestroy_Private(State *state)
{
  PetscFunctionBeginUser;
  PetscCall(VecDestroy(&state->y));
  PetscCall(VecDestroy(&state->active));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets fixed unknowns to their values. */
static PetscErrorCode NestedIterationSetFixed_Private(const Operator *op, Vec y)
{
  const PetscScalar *b;
  PetscScalar       *a;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(op->b, &b));
  PetscCall(VecGetArray(y, &a));
  for (PetscInt i = 0; i < op->num_fixed; i++) a[op->fixed[i]] = b[op->fixed[i]];
  PetscCall(VecRestoreArray(y, &a));
  PetscCall(VecRestoreArrayRead(op->b, &b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rounds a prolonged set to 1 or 0. It has unknowns with bounds, and with friction tangents that stick.
   [in,out] active */
static PetscErrorCode NestedIterationRound_Private(const Operator *op, PetscBool friction, Vec active)
{
  const PetscScalar *upper;
  PetscScalar       *a;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(active, &n));
  PetscCall(VecGetArrayRead(op->upper, &upper));
  PetscCall(VecGetArray(active, &a));
  for (PetscInt i = 0; i < n; i++) {
    const PetscBool bounded = (PetscBool)(PetscRealPart(upper[i]) < PETSC_INFINITY);

    a[i] = (friction || bounded) && PetscRealPart(a[i]) >= (friction && bounded ? CLOSED_SHARE : ACTIVE_SHARE) ? 1 : 0;
  }
  PetscCall(VecRestoreArray(active, &a));
  PetscCall(VecRestoreArrayRead(op->upper, &upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the accuracy of a level. [in] pdas - whether the SNES is of that type;
   [in] state - before the solve */
static PetscErrorCode NestedIterationSetTolerances_Private(SNES snes, PetscBool pdas, VI vi, const State *state)
{
  const PetscReal rtol = pdas || !state->prolonged ? COARSEST_RTOL : NESTED_OTHER_RTOL;
  KSP             ksp;

  PetscFunctionBeginUser;
  if (pdas && state->prolonged && !vi->friction) {
    PetscCall(SNESSetTolerances(snes, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, NESTED_MAX_SETS, PETSC_DEFAULT));
    PetscCall(PDASSetErrorReduction(snes, DiscretizationStopPart(vi->scene), state->energy_decrease));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(SNESSetTolerances(snes, PETSC_DEFAULT, rtol, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(
      KSPSetTolerances(ksp, pdas ? 0.5 * rtol : NESTED_OTHER_KSP_RTOL, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gets the state for the next level: unchanged if a system failed, the last set if sets did not settle. [in]
   y - before the solve; [in,out] state */
static PetscErrorCode NestedIterationGetState_Private(Hierarchy hierarchy, const HierarchyLevel *level, SNES snes,
                                                      Vec y, State *state)
{
  SNESConvergedReason reason;
  PetscBool           pdas;
  Vec                 last;

  PetscFunctionBeginUser;
  PetscCall(SNESGetConvergedReason(snes, &reason));
  state->friction = (FrictionReport){.rho = 0};
  if (reason < 0) PetscCall(PetscInfo(snes, "a coarser level ends with %s\n", SNESConvergedReasons[reason]));
  if (reason < 0 && reason != SNES_DIVERGED_MAX_IT) {
    PetscCall(VecCopy(y, state->y));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscObjectTypeCompare((PetscObject)snes, SNESPDAS, &pdas));
  if (pdas) {
    PetscCall(PDASGetActive(snes, &last));
    PetscCall(VecCopy(last, state->active));
    if (reason > 0) PetscCall(PDASGetFriction(snes, &state->friction));
  } else {
    PetscCall(ActivePredictionGetActive(hierarchy, level, state->y, state->active));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The difference of the level's solution from that of the next coarser one. */
static PetscErrorCode NestedIterationChange_Private(VI vi, SNES snes, PetscReal *change)
{
  ActiveSolver solver;

  PetscFunctionBeginUser;
  PetscCall(PDASGetSolver(snes, &solver));
  *change = solver ? solver->first * vi->stiffness * PetscSqr(vi->length) : 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the tangents of contacts to the set: they stick. */
static PetscErrorCode NestedIterationStick_Private(const FrictionLaw *law, Vec active)
{
  PetscScalar *a;
  PetscInt     begin;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(active, &begin, NULL));
  PetscCall(VecGetArray(active, &a));
  for (PetscInt i = 0; i < FRICTION_TANGENTS * law->n; i++)
    if (law->tangent[i] >= 0) a[law->tangent[i] - begin] = a[law->normal[i / FRICTION_TANGENTS] - begin];
  PetscCall(VecRestoreArray(active, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Predicts contact on the first level that is solved, from the contacts that balance the loads or from none.
   [in] m - level; [in] pc - or NULL; [out] found - false where there is nothing to predict */
static PetscErrorCode NestedIterationPredict_Private(MeshLevels levels, PetscInt m, PC pc, Proximal *proximal, Vec y,
                                                     Vec active, PetscBool *found)
{
  const Hierarchy       hierarchy = levels->hierarchy;
  const HierarchyLevel *level     = &hierarchy->level[hierarchy->first + m];
  PetscReal             least;

  PetscFunctionBeginUser;
  PetscCall(VecMin(level->op.upper, NULL, &least));
  *found = (PetscBool)(pc && least < PETSC_INFINITY);
  if (!*found) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecZeroEntries(active));
  if (proximal->solvability) PetscCall(VecCopy(proximal->solvability->start, active));
  PetscCall(ActivePredictionStart(hierarchy, level, pc, (PetscBool)(proximal->solvability != NULL), y, active));
  if (levels->vi[m]->friction) {
    PetscCall(NestedIterationStick_Private(levels->vi[m]->friction, active));
    if (proximal->solvability) PetscCall(VecZeroEntries(y)); // without friction bodies may have slid far
  }
  if (!proximal->solvability) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ProximalFinish(proximal, y)); // y of the scene
  PetscCall(ProximalSetCenter(proximal, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The start on the first level that is solved. [in] pc - multigrid, or NULL; [in,out] state; [out] set -
   whether it has a set */
static PetscErrorCode NestedIterationBegin_Private(MeshLevels levels, PetscInt m, PC pc, Proximal *proximal,
                                                   State *state, PetscBool *set)
{
  const Solvability solvability = proximal->solvability;

  PetscFunctionBeginUser;
  if (pc)
    PetscCall(NestedIterationSetFixed_Private(&levels->hierarchy->level[levels->hierarchy->first + m].op, state->y));
  if (solvability) PetscCall(VecCopy(solvability->start, state->active));
  PetscCall(NestedIterationPredict_Private(levels, m, pc, proximal, state->y, state->active, set));
  *set = (PetscBool)(*set || solvability);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves on level m of the mesh. [in] proximal - of it; [in] type - of the SNES; [in,out] state */
static PetscErrorCode NestedIterationSolveLevel_Private(MeshLevels levels, PetscInt m, Proximal *proximal,
                                                        const char type[], State *state)
{
  const Inequality *solved    = &proximal->solved;
  const Hierarchy   hierarchy = levels->hierarchy;
  const PetscInt    l         = hierarchy->first + m;
  const PetscBool   pdas      = (PetscBool)!strcmp(type, SNESPDAS);
  SolverChoice      choice    = l ? (SolverChoice){.ksp = KSPCG, .pc = PCTRUNCATEDMG, .prefix = PREFIX}
                                  : (SolverChoice){.ksp = KSPPREONLY, .pc = PCCHOLESKY, .prefix = PREFIX};
  PetscBool         set       = state->prolonged;
  PetscReal         norm;
  SNES              snes;
  KSP               ksp;
  PC                pc;
  Vec               scratch, before;

  PetscFunctionBeginUser;
  PetscCall(PetscStrncpy(choice.snes, type, sizeof(choice.snes)));
  PetscCall(VecDuplicate(solved->b, &scratch));
  PetscCall(SNESSetupCreate(solved, &choice, scratch, &norm, &snes));
  PetscCall(NestedIterationSetTolerances_Private(snes, pdas, solved->vi, state));
  if (solved->vi->friction) {
    PetscCall(PDASSetFriction(snes, solved->vi->friction));
    PetscCall(PDASSetFrictionRho(snes, (PetscBool)(m + 2 == levels->num), NULL));
  }
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  if (l) PetscCall(MultigridSetHierarchy(pc, hierarchy, l, pdas ? NULL : snes));
  if (!state->prolonged)
    PetscCall(NestedIterationBegin_Private(levels, m, pdas && l ? pc : NULL, proximal, state, &set));
  if (pdas && set) PetscCall(PDASSetStart(snes, state->active));
  PetscCall(VecDuplicate(state->y, &before));
  PetscCall(VecCopy(state->y, before));
  if (pdas) PetscCall(PDASSetKeep(snes, PETSC_TRUE));
  PetscCall(SNESSolve(snes, NULL, state->y));
  levels->change = 0;
  if (pdas && state->prolonged && !solved->vi->friction)
    PetscCall(NestedIterationChange_Private(solved->vi, snes, &levels->change));
  PetscCall(NestedIterationGetState_Private(hierarchy, &hierarchy->level[l], snes, before, state));
  PetscCall(VecDestroy(&before));
  PetscCall(SNESDestroy(&snes));
  PetscCall(VecDestroy(&scratch));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Prepares the system of a level, with a proximal term where only contact holds bodies. */
static PetscErrorCode NestedIterationBeginLevel_Private(MeshLevels levels, PetscInt m, Solvability solvability,
                                                        Proximal *proximal)
{
  PetscFunctionBeginUser;
  PetscCall(ProximalBegin(levels->vi[m], solvability, proximal));
  PetscCall(MeshLevelsSetInequality(levels, m, &proximal->solved, solvability ? solvability->regularization : NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Resets the level to its own inequality, for multigrid on finer levels. [in,out] y - of ProximalEnd() */
static PetscErrorCode NestedIterationEndLevel_Private(MeshLevels levels, PetscInt m, Proximal *proximal, Vec y)
{
  const VI         vi  = levels->vi[m];
  const Inequality own = {.vi = vi, .A = vi->A, .b = vi->b, .upper = vi->upper};

  PetscFunctionBeginUser;
  PetscCall(MeshLevelsSetInequality(levels, m, &own, NULL));
  PetscCall(ProximalEnd(proximal, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Finds the coarsest level from which on all levels are solvable. [out] solvability - of each level but the
   finest, owned by the caller [levels->num] */
static PetscErrorCode NestedIterationFindFirst_Private(MeshLevels levels, Solvability solvability[], PetscInt *first)
{
  PetscFunctionBeginUser;
  *first = 0;
  for (PetscInt m = 0; m + 1 < levels->num; m++) {
    PetscCall(SolvabilityCreate(levels->vi[m], &solvability[m]));
    if (solvability[m] && solvability[m]->status == SOLVABLE_NOT) *first = m + 1;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moves y to the bounds of the initial set: types other than pdas see contact only at reached bounds. */
static PetscErrorCode NestedIterationMoveToBounds_Private(const Operator *op, Vec active, Vec y)
{
  const PetscScalar *upper, *a;
  PetscScalar       *values;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecPointwiseMin(y, y, op->upper));
  PetscCall(VecGetLocalSize(y, &n));
  PetscCall(VecGetArrayRead(op->upper, &upper));
  PetscCall(VecGetArrayRead(active, &a));
  PetscCall(VecGetArray(y, &values));
  for (PetscInt i = 0; i < n; i++)
    if (PetscRealPart(a[i]) > 0) values[i] = upper[i];
  PetscCall(VecRestoreArray(y, &values));
  PetscCall(VecRestoreArrayRead(active, &a));
  PetscCall(VecRestoreArrayRead(op->upper, &upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Predicts the set of a level. Blocks or other smoothers of their own have cycles alone. [in] pc - of
   ActivePredictionApply(); [in] kept - of NestedIterationPredict(); [in,out] y, active */
static PetscErrorCode NestedIterationAhead_Private(Hierarchy hierarchy, const HierarchyLevel *level, PC pc,
                                                   PetscBool kept, Vec y, Vec active, PetscReal *energy_decrease)
{
  PetscFunctionBeginUser;
  if (level->S && pc) {
    *energy_decrease = 0;
    PetscCall(NestedIterationMoveToBounds_Private(&level->op, active, y));
    PetscCall(ActivePredictionBeyond(hierarchy, level, pc, kept, y, active));
  } else {
    PetscCall(ActivePredictionApply(hierarchy, level, pc, y, active, energy_decrease));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether cycles improve the set of the coarser level. In the plane contact has few ends, and that set mostly
   stays. Over nearly incompressible bodies, and for stiff sides without blocks, cycles leave more to change
   than before. */
static PetscErrorCode NestedIterationNeedsCycles_Private(const HierarchyLevel *level, PC pc, PetscBool *cycles)
{
  PetscBool blocks;

  PetscFunctionBeginUser;
  *cycles = PETSC_TRUE;
  if (!level->S) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MultigridSmoothsMore(pc, &blocks));
  *cycles = (PetscBool)(level->op.dim == 3 && !level->op.tight && blocks);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The initial state of level m. [in] pc - of ActivePredictionApply(); [in] from - of the coarser level;
   [in,out] proximal - of level m; [out] to */
static PetscErrorCode NestedIterationProlong_Private(MeshLevels levels, PetscInt m, PC pc, const State *from,
                                                     Proximal *proximal, State *to)
{
  const HierarchyLevel *level = &levels->hierarchy->level[levels->hierarchy->first + m];
  const PetscBool friction    = (PetscBool)(levels->vi[m]->friction != NULL); // whose cycles would let everything slide
  PetscBool       cycles      = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(NestedIterationStateCreate_Private(level, to));
  PetscCall(MatMult(level->P, from->y, to->y));
  if (levels->lift[m]) PetscCall(VecAXPY(to->y, 1, levels->lift[m]));
  PetscCall(NestedIterationSetFixed_Private(&level->op, to->y));
  PetscCall(ProximalSetCenter(proximal, to->y));
  to->friction  = from->friction;
  to->prolonged = PETSC_TRUE;
  PetscCall(MatMult(level->P, from->active, to->active));
  PetscCall(NestedIterationRound_Private(&level->op, friction, to->active));
  if (friction) PetscFunctionReturn(PETSC_SUCCESS);
  if (pc) PetscCall(NestedIterationNeedsCycles_Private(level, pc, &cycles));
  PetscCall(NestedIterationAhead_Private(levels->hierarchy, level, cycles ? pc : NULL, PETSC_FALSE, to->y, to->active,
                                         &to->energy_decrease));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The preconditioner for cycles before the first system of the finest level. None for types that pass it
   parts of vectors. None when stopping at the discretization error: there one more cycle is a large part of
   the cost. [out] pc - borrowed, or NULL */
static PetscErrorCode NestedIterationGetCycles_Private(SNES snes, VI vi, PC *pc)
{
  PetscBool pdas;
  KSP       ksp;

  PetscFunctionBeginUser;
  *pc = NULL;
  PetscCall(PetscObjectTypeCompare((PetscObject)snes, SNESPDAS, &pdas));
  if (!pdas || vi->scene->stop == STOP_DISCRETISATION) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, pc));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static Proximal *AscentGetProximal_Private(Ascent *ascent, PetscInt m)
{
  return m + 1 < ascent->levels->num ? &ascent->own[m % 2] : ascent->proximal;
}

/* Solves level m and prolongs to the next one, which it begins. [in,out] state - of level m, then of m + 1 */
static PetscErrorCode NestedIterationAscend_Private(Ascent *ascent, PetscInt m, State *state)
{
  const MeshLevels      levels = ascent->levels;
  const HierarchyLevel *above  = &levels->hierarchy->level[levels->hierarchy->first + m + 1];
  const PetscBool       last   = (PetscBool)(m + 2 == levels->num);
  Proximal             *own = AscentGetProximal_Private(ascent, m), *next = AscentGetProximal_Private(ascent, m + 1);
  State                 prolonged;

  PetscFunctionBeginUser;
  PetscCall(NestedIterationSolveLevel_Private(levels, m, own, ascent->type, state));
  PetscCall(NestedIterationEndLevel_Private(levels, m, own, state->y));
  if (!last) PetscCall(NestedIterationBeginLevel_Private(levels, m + 1, ascent->solvability[m + 1], next));
  PetscCall(NestedIterationProlong_Private(levels, m + 1, last ? ascent->pc : NULL, state, next, &prolonged));
  if (strcmp(ascent->type, SNESPDAS))
    PetscCall(NestedIterationMoveToBounds_Private(&above->op, prolonged.active, prolonged.y));
  PetscCall(NestedIterationStateDestroy_Private(state));
  *state = prolonged;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NestedIterationStart(MeshLevels levels, SNES snes, Proximal *proximal, Vec y, Vec active,
                                    PetscReal *energy_decrease, PetscBool *found)
{
  const PetscInt finest = levels->num - 1;
  Ascent         ascent = {.levels = levels, .proximal = proximal};
  PetscInt       first;
  State          state;

  PetscFunctionBeginUser;
  *energy_decrease = 0;
  PetscCall(PetscCalloc1(levels->num, &ascent.solvability));
  PetscCall(SNESGetType(snes, &ascent.type));
  PetscCall(NestedIterationGetCycles_Private(snes, proximal->solved.vi, &ascent.pc));
  PetscCall(NestedIterationFindFirst_Private(levels, ascent.solvability, &first));
  *found = (PetscBool)(first < finest);
  if (*found) {
    PetscCall(NestedIterationBeginLevel_Private(levels, first, ascent.solvability[first], &ascent.own[first % 2]));
    PetscCall(NestedIterationStateCreate_Private(&levels->hierarchy->level[levels->hierarchy->first + first], &state));
    for (PetscInt m = first; m < finest; m++) PetscCall(NestedIterationAscend_Private(&ascent, m, &state));
    PetscCall(VecCopy(state.y, y));
    PetscCall(VecCopy(state.active, active));
    *energy_decrease = state.energy_decrease;
    if (!strcmp(ascent.type, SNESPDAS)) PetscCall(PDASSetFrictionRho(snes, PETSC_TRUE, &state.friction));
    PetscCall(NestedIterationStateDestroy_Private(&state));
  } else {
    PetscCall(NestedIterationPredict_Private(levels, finest, ascent.pc, proximal, y, active, found));
  }
  for (PetscInt m = 0; m < finest; m++) PetscCall(SolvabilityDestroy(&ascent.solvability[m]));
  PetscCall(PetscFree(ascent.solvability));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks unknowns on their bounds or beyond. [out] active - 1 or 0 */
static PetscErrorCode NestedIterationMarkBounds_Private(const Operator *op, Vec y, Vec active)
{
  const PetscScalar *upper, *values;
  PetscScalar       *a;
  PetscReal          size;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecNorm(y, NORM_INFINITY, &size));
  PetscCall(VecGetLocalSize(y, &n));
  PetscCall(VecGetArrayRead(op->upper, &upper));
  PetscCall(VecGetArrayRead(y, &values));
  PetscCall(VecGetArray(active, &a));
  for (PetscInt i = 0; i < n; i++) a[i] = PetscRealPart(values[i]) >= PetscRealPart(upper[i]) - ON_BOUND * size ? 1 : 0;
  PetscCall(VecRestoreArray(active, &a));
  PetscCall(VecRestoreArrayRead(y, &values));
  PetscCall(VecRestoreArrayRead(op->upper, &upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NestedIterationPredict(MeshLevels levels, SNES snes, VI vi, PetscBool kept, Vec y, Vec active,
                                      PetscBool *found)
{
  const Hierarchy       hierarchy = levels->hierarchy;
  const HierarchyLevel *finest    = &hierarchy->level[hierarchy->num - 1];
  PetscReal             energy_decrease;
  PC                    pc;

  PetscFunctionBeginUser;
  PetscCall(NestedIterationGetCycles_Private(snes, vi, &pc));
  *found = (PetscBool)(pc || !finest->S);
  if (!*found) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(NestedIterationMarkBounds_Private(&finest->op, y, active));
  PetscCall(NestedIterationMoveToBounds_Private(&finest->op, active, y));
  PetscCall(NestedIterationAhead_Private(hierarchy, finest, pc, kept, y, active, &energy_decrease));
  PetscFunctionReturn(PETSC_SUCCESS);
}
