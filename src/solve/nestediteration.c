/* nestediteration.c -- nested iteration: each level begins where the coarser one ended.

   The coarser mesh knows the solution up to its own discretisation error, and where contact ends up to one of its facets. What is left
   to do on the finer level is little, and on coarse levels everything is cheap; for the same reason no system there needs more digits
   than that error has. Where contact ends on the finer mesh is a matter of the finer mesh (forecast.c). */
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

/* Linear residual that is enough where there is no coarser mesh that tells the discretisation error. */
static const PetscReal COARSEST_RTOL = 1e-4;
/* Of a type that does not tell errors: part of the residual that a level begins with, and of that of each of its systems. */
static const PetscReal OTHER_RTOL = 1e-3, OTHER_LINEAR_RTOL = 1e-2;
/* An unknown begins as active where so much of what it comes from is active. */
static const PetscReal ACTIVE_SHARE = 0.5;
/* Sets that a level is solved for at most where it is but a start for the next one, and a coarser one was its own. */
enum { MAX_SETS = 12 };
/* Options of the solvers on coarser levels. */
static const char PREFIX[] = "nested_";

/* Where a level begins or ends. */
typedef struct {
  Vec y;
  Vec active; /* its set: 1 or 0 */
} State;

/* At rest, without contact. [out] state - to be destroyed by StateDestroy_Private() */
static PetscErrorCode StateCreate_Private(const Grid *grid, State *state)
{
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(grid->vi->b, &state->y));
  PetscCall(VecDuplicate(state->y, &state->active));
  PetscCall(VecZeroEntries(state->y));
  PetscCall(VecZeroEntries(state->active));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode StateDestroy_Private(State *state)
{
  PetscFunctionBeginUser;
  PetscCall(VecDestroy(&state->y));
  PetscCall(VecDestroy(&state->active));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Eliminated unknowns have their values. */
static PetscErrorCode Eliminate_Private(VI vi, Vec y)
{
  const PetscInt     first = vi->level->dim * vi->level->node_begin;
  const PetscScalar *b;
  PetscScalar       *a;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(vi->b, &b));
  PetscCall(VecGetArray(y, &a));
  for (PetscInt i = 0; i < vi->num_fixed; i++) a[vi->fixed[i] - first] = b[vi->fixed[i] - first];
  PetscCall(VecRestoreArray(y, &a));
  PetscCall(VecRestoreArrayRead(vi->b, &b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* 1 where an unknown with a bound comes from active ones for the most part. [in,out] active */
static PetscErrorCode Round_Private(VI vi, Vec active)
{
  const PetscScalar *upper;
  PetscScalar       *a;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(active, &n));
  PetscCall(VecGetArrayRead(vi->upper, &upper));
  PetscCall(VecGetArray(active, &a));
  for (PetscInt i = 0; i < n; i++)
    a[i] = PetscRealPart(upper[i]) < PETSC_INFINITY && PetscRealPart(a[i]) >= ACTIVE_SHARE ? 1 : 0;
  PetscCall(VecRestoreArray(active, &a));
  PetscCall(VecRestoreArrayRead(vi->upper, &upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How exact a level's solution is to be. [in] gained, begun - of SolveLevel_Private() */
static PetscErrorCode SetTolerances_Private(SNES snes, PetscBool pdas, PetscReal part, PetscReal gained,
                                            PetscBool begun)
{
  const PetscReal rtol = pdas || !begun ? COARSEST_RTOL : OTHER_RTOL;
  KSP             ksp;

  PetscFunctionBeginUser;
  if (pdas && begun) {
    PetscCall(SNESSetTolerances(snes, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, MAX_SETS, PETSC_DEFAULT));
    PetscCall(PDASSetEnough(snes, part, gained));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(SNESSetTolerances(snes, PETSC_DEFAULT, rtol, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPSetTolerances(ksp, pdas ? 0.5 * rtol : OTHER_LINEAR_RTOL, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What a level has found, for the next one: nothing where a system could not be solved, the last set where they go on and on.
   [in] y - as it was before; [in,out] state */
static PetscErrorCode Find_Private(Hierarchy hierarchy, const Grid *grid, SNES snes, Vec y, State *state)
{
  SNESConvergedReason reason;
  PetscBool           pdas;
  Vec                 last;

  PetscFunctionBeginUser;
  PetscCall(SNESGetConvergedReason(snes, &reason));
  if (reason < 0) PetscCall(PetscInfo(snes, "a coarser level ends with %s\n", SNESConvergedReasons[reason]));
  if (reason < 0 && reason != SNES_DIVERGED_MAX_IT) {
    PetscCall(VecCopy(y, state->y));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscObjectTypeCompare((PetscObject)snes, SNESPDAS, &pdas));
  if (pdas) {
    PetscCall(PDASGetActive(snes, &last));
    PetscCall(VecCopy(last, state->active));
  } else {
    PetscCall(ForecastPressed(hierarchy, grid, state->y, state->active));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How far the level's solution is from the next coarser one's, for whoever asks how fast that falls. */
static PetscErrorCode Change_Private(const Grid *grid, SNES snes, PetscReal *change)
{
  ActiveSolver solver;

  PetscFunctionBeginUser;
  PetscCall(PDASGetSolver(snes, &solver));
  *change = solver ? solver->first * grid->vi->stiffness * PetscSqr(grid->vi->length) : 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves on one level. [in] type - of the SNES; [in] gained - as of PDASSetEnough(); [in] begun - whether a coarser level says what to begin
   with; [in,out] state */
static PetscErrorCode SolveLevel_Private(Hierarchy hierarchy, PetscInt l, Solvability solvability, const char type[],
                                         PetscReal gained, PetscBool begun, State *state)
{
  const VI        vi     = hierarchy->grid[l].vi;
  const PetscBool pdas   = (PetscBool)!strcmp(type, SNESPDAS);
  SolveChoice     choice = l ? (SolveChoice){.ksp = KSPCG, .pc = PCTRUNCATEDMG, .prefix = PREFIX}
                             : (SolveChoice){.ksp = KSPPREONLY, .pc = PCCHOLESKY, .prefix = PREFIX};
  PetscReal       norm;
  SNES            snes;
  KSP             ksp;
  PC              pc;
  Vec             scratch, before;

  PetscFunctionBeginUser;
  PetscCall(PetscStrncpy(choice.snes, type, sizeof(choice.snes)));
  PetscCall(VecDuplicate(vi->b, &scratch));
  PetscCall(SolveConfigure(vi, &choice, scratch, &norm, &snes));
  PetscCall(SetTolerances_Private(snes, pdas, StopPart(vi->scene), gained, begun));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  if (l) PetscCall(MultigridSetHierarchy(pc, hierarchy, l, pdas ? NULL : snes));
  if (!begun && solvability) PetscCall(VecCopy(solvability->start, state->active));
  if (pdas && (begun || solvability)) PetscCall(PDASSetStart(snes, state->active));
  PetscCall(VecDuplicate(state->y, &before));
  PetscCall(VecCopy(state->y, before));
  if (pdas) PetscCall(PDASSetKeep(snes, PETSC_TRUE));
  PetscCall(SNESSolve(snes, NULL, state->y));
  hierarchy->change = 0;
  if (pdas && begun) PetscCall(Change_Private(&hierarchy->grid[l], snes, &hierarchy->change));
  PetscCall(Find_Private(hierarchy, &hierarchy->grid[l], snes, before, state));
  PetscCall(VecDestroy(&before));
  PetscCall(SNESDestroy(&snes));
  PetscCall(VecDestroy(&scratch));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y where it is to begin: types other than pdas see contact only at bounds that are reached. */
static PetscErrorCode Touch_Private(VI vi, Vec active, Vec y)
{
  const PetscScalar *upper, *a;
  PetscScalar       *values;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecPointwiseMin(y, y, vi->upper));
  PetscCall(VecGetLocalSize(y, &n));
  PetscCall(VecGetArrayRead(vi->upper, &upper));
  PetscCall(VecGetArrayRead(active, &a));
  PetscCall(VecGetArray(y, &values));
  for (PetscInt i = 0; i < n; i++)
    if (PetscRealPart(a[i]) > 0) values[i] = upper[i];
  PetscCall(VecRestoreArray(y, &values));
  PetscCall(VecRestoreArrayRead(active, &a));
  PetscCall(VecRestoreArrayRead(vi->upper, &upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The level as it is solved: with springs where contact alone holds bodies, which are in its A from now on. */
static PetscErrorCode Begin_Private(Grid *grid, Solvability solvability, Springs *springs)
{
  PetscFunctionBeginUser;
  PetscCall(SpringsBegin(grid->vi, solvability, springs));
  grid->vi = springs->vi;
  grid->A  = springs->vi->A;
  if (solvability) grid->springs = solvability->springs;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The level as it was, for what is solved on finer ones. [in,out] y - as of SpringsEnd() */
static PetscErrorCode End_Private(Grid *grid, Springs *springs, Vec y)
{
  PetscFunctionBeginUser;
  grid->vi      = springs->original;
  grid->A       = springs->original->A;
  grid->springs = NULL;
  PetscCall(SpringsEnd(springs, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The coarsest level from which on contact can hold what has to be held on every level. [out] solvability - of each level with a mesh but the
   finest, owned by the caller [hierarchy->num] */
static PetscErrorCode FindFirst_Private(Hierarchy hierarchy, Solvability solvability[], PetscInt *first)
{
  PetscFunctionBeginUser;
  *first = hierarchy->first;
  for (PetscInt l = hierarchy->first; l + 1 < hierarchy->num; l++) {
    PetscCall(SolvabilityCreate(hierarchy->grid[l].vi, &solvability[l]));
    if (solvability[l] && solvability[l]->verdict == SOLVABLE_NOT) *first = l + 1;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What the finer level begins with. [in] pc - of Forecast(); [in] from - of the coarser one; [in,out] springs - of the finer one;
   [out] to; [out] gained - as of CascadeStart() */
static PetscErrorCode GoUp_Private(Hierarchy hierarchy, const Grid *finer, PC pc, const State *from, Springs *springs,
                                   State *to, PetscReal *gained)
{
  PetscFunctionBeginUser;
  PetscCall(StateCreate_Private(finer, to));
  PetscCall(MatMult(finer->P, from->y, to->y));
  if (finer->lift) PetscCall(VecAXPY(to->y, 1, finer->lift));
  PetscCall(Eliminate_Private(finer->vi, to->y));
  PetscCall(SpringsFollow(springs, to->y));
  PetscCall(MatMult(finer->P, from->active, to->active));
  PetscCall(Round_Private(finer->vi, to->active));
  PetscCall(Forecast(hierarchy, finer, pc, to->y, to->active, gained));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The preconditioner that cycles before the finest level's first system: not that of another type, which leaves it parts of vectors, nor where
   the mesh ends iterations so early that a cycle more is much of all. [out] pc - borrowed, or NULL */
static PetscErrorCode GetCycles_Private(SNES snes, VI vi, PC *pc)
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

PetscErrorCode CascadeStart(Hierarchy hierarchy, SNES snes, Springs *springs, Vec y, Vec active, PetscReal *gained,
                            PetscBool *found)
{
  const PetscInt finest = hierarchy->num - 1;
  SNESType       type;
  PC             pc;
  PetscInt       first;
  Springs        own[2]; // of this level and the next one, in turns: they are not to be moved
  Solvability   *solvability;
  State          state = {NULL, NULL}, next;

  PetscFunctionBeginUser;
  *gained = 0;
  PetscCall(PetscCalloc1(hierarchy->num, &solvability));
  PetscCall(SNESGetType(snes, &type));
  PetscCall(GetCycles_Private(snes, springs->vi, &pc));
  PetscCall(FindFirst_Private(hierarchy, solvability, &first));
  *found = (PetscBool)(first < finest);
  if (*found) {
    PetscCall(Begin_Private(&hierarchy->grid[first], solvability[first], &own[first % 2]));
    PetscCall(StateCreate_Private(&hierarchy->grid[first], &state));
  }
  for (PetscInt l = first; l < finest; l++) {
    Grid    *finer = &hierarchy->grid[l + 1];
    Springs *above = l + 1 < finest ? &own[(l + 1) % 2] : springs;

    PetscCall(SolveLevel_Private(hierarchy, l, solvability[l], type, *gained, (PetscBool)(l > first), &state));
    PetscCall(End_Private(&hierarchy->grid[l], &own[l % 2], state.y));
    if (l + 1 < finest) PetscCall(Begin_Private(finer, solvability[l + 1], above));
    PetscCall(GoUp_Private(hierarchy, finer, l + 1 < finest ? NULL : pc, &state, above, &next, gained));
    if (strcmp(type, SNESPDAS)) PetscCall(Touch_Private(finer->vi, next.active, next.y));
    PetscCall(StateDestroy_Private(&state));
    state = next;
  }
  if (*found) {
    PetscCall(VecCopy(state.y, y));
    PetscCall(VecCopy(state.active, active));
    PetscCall(StateDestroy_Private(&state));
  }
  for (PetscInt l = hierarchy->first; l < finest; l++) PetscCall(SolvabilityDestroy(&solvability[l]));
  PetscCall(PetscFree(solvability));
  PetscFunctionReturn(PETSC_SUCCESS);
}
