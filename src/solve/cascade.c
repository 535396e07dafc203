/* cascade.c -- nested iteration: each level begins where the coarser one ended.

   The coarser mesh knows the solution up to its own discretisation error, and where contact ends up to one of its facets. What is left
   to do on the finer level is little, and on coarse levels everything is cheap; for the same reason no system there needs more digits
   than that error has. Where contact ends on the finer mesh is a matter of the finer mesh: a few projected steps of a simple
   iteration [1] see it.

   References: [1] Kornhuber, Monotone multigrid methods for elliptic variational inequalities I, 1994. */
#include <string.h>
#include <mortise/compat.h>
#include <mortise/pdas.h>
#include "active.h"
#include "cascade.h"
#include "multigrid.h"
#include "room.h"
#include "stop.h"

/* Linear residual that is enough where there is no coarser mesh that tells the discretisation error. */
static const PetscReal COARSEST_RTOL = 1e-4;
/* Of a type that does not tell errors: part of the residual that a level begins with, and of that of each of its systems. */
static const PetscReal OTHER_RTOL = 1e-3, OTHER_LINEAR_RTOL = 1e-2;
/* Projected steps, and their length by the largest one that is stable. */
enum { RELAXATION_STEPS = 4 };
static const PetscReal RELAXATION = 0.9;
/* An unknown begins as active where so much of what it comes from is active. */
static const PetscReal ACTIVE_SHARE = 0.5;
/* Options of the solvers on coarser levels. */
static const char PREFIX[] = "nested_";

/* Eliminated unknowns have their values. */
static PetscErrorCode Prescribe_Private(VI vi, Vec y)
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

/* r = b - A y;  energy = 1/2 y'A y - b'y */
static PetscErrorCode Residual_Private(Hierarchy hierarchy, const Grid *grid, Vec y, Vec r, PetscReal *energy)
{
  PetscScalar by, ry;

  PetscFunctionBeginUser;
  PetscCall(MatMult(grid->A, y, r));
  PetscCall(VecAYPX(r, -1, grid->vi->b));
  PetscCall(VecDot(y, grid->vi->b, &by));
  PetscCall(VecDot(y, r, &ry));
  *energy = -0.5 * PetscRealPart(by + ry);
  hierarchy->work += grid->share;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* 1 where an unknown is at its bound with a force on it. [out] active */
static PetscErrorCode Pressed_Private(VI vi, Vec y, Vec r, Vec active)
{
  const PetscScalar *upper, *at, *force;
  PetscScalar       *a;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(active, &n));
  PetscCall(VecGetArrayRead(vi->upper, &upper));
  PetscCall(VecGetArrayRead(y, &at));
  PetscCall(VecGetArrayRead(r, &force));
  PetscCall(VecGetArray(active, &a));
  for (PetscInt i = 0; i < n; i++)
    a[i] = PetscRealPart(at[i]) >= PetscRealPart(upper[i]) && PetscRealPart(force[i]) > 0 ? 1 : 0;
  PetscCall(VecRestoreArray(active, &a));
  PetscCall(VecRestoreArrayRead(r, &force));
  PetscCall(VecRestoreArrayRead(y, &at));
  PetscCall(VecRestoreArrayRead(vi->upper, &upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How exact a level's solution is to be. [in] gained, start - of SolveLevel_Private() */
static PetscErrorCode SetTolerances_Private(SNES snes, PetscBool pdas, PetscReal part, PetscReal gained, Vec start)
{
  const PetscReal rtol = pdas || !start ? COARSEST_RTOL : OTHER_RTOL;
  KSP             ksp;

  PetscFunctionBeginUser;
  if (pdas && start) {
    PetscCall(PDASSetEnough(snes, part, gained));
    PetscCall(PDASSetStart(snes, start));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(SNESSetTolerances(snes, PETSC_DEFAULT, rtol, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPSetTolerances(ksp, pdas ? 0.5 * rtol : OTHER_LINEAR_RTOL, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves on one level. [in] type - of the SNES; [in] gained - as of PDASSetEnough(); [in] start - set to begin with, or NULL;
   [in,out] y; [out] active - of the level */
static PetscErrorCode SolveLevel_Private(Hierarchy hierarchy, PetscInt l, const char type[], PetscReal gained,
                                         Vec start, Vec y, Vec active)
{
  const VI        vi     = hierarchy->grid[l].vi;
  const PetscBool pdas   = (PetscBool)!strcmp(type, SNESPDAS);
  SolveChoice     choice = l ? (SolveChoice){.ksp = KSPCG, .pc = PCTRUNCATEDMG, .prefix = PREFIX}
                             : (SolveChoice){.ksp = KSPPREONLY, .pc = PCCHOLESKY, .prefix = PREFIX};
  PetscReal       norm;
  SNES            snes;
  KSP             ksp;
  PC              pc;
  Vec             scratch, last;

  PetscFunctionBeginUser;
  PetscCall(PetscStrncpy(choice.snes, type, sizeof(choice.snes)));
  PetscCall(VecDuplicate(vi->b, &scratch));
  PetscCall(SolveConfigure(vi, &choice, scratch, &norm, &snes));
  PetscCall(SetTolerances_Private(snes, pdas, StopPart(vi->scene), gained, start));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  if (l) PetscCall(MultigridSetHierarchy(pc, hierarchy, l, pdas ? NULL : snes));
  PetscCall(SNESSolve(snes, NULL, y));
  if (pdas) {
    PetscCall(PDASGetActive(snes, &last));
    PetscCall(VecCopy(last, active));
  } else {
    PetscReal energy;

    PetscCall(Residual_Private(hierarchy, &hierarchy->grid[l], y, scratch, &energy));
    PetscCall(Pressed_Private(vi, y, scratch, active));
  }
  PetscCall(SNESDestroy(&snes));
  PetscCall(VecDestroy(&scratch));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A few steps y := min( upper, y + omega D^-1 r ), D = diag A, and the set that they end with; nothing where they lead nowhere.
   [in,out] y - feasible only afterwards; [in,out] active; [out] gained - twice the energy */
static PetscErrorCode Relax_Private(Hierarchy hierarchy, const Grid *grid, Vec y, Vec active, PetscReal *gained)
{
  const VI  vi    = grid->vi;
  PetscReal first = 0, energy;
  Vec       z, r, step;

  PetscFunctionBeginUser;
  *gained = 0;
  if (grid->S) PetscFunctionReturn(PETSC_SUCCESS); // where the diagonal does not smooth it does not see either
  PetscCall(VecDuplicate(y, &z));
  PetscCall(VecDuplicate(y, &r));
  PetscCall(VecDuplicate(y, &step));
  PetscCall(VecPointwiseMin(z, y, vi->upper));
  PetscCall(Residual_Private(hierarchy, grid, z, r, &first));
  for (PetscInt k = 0; k < RELAXATION_STEPS; k++) {
    PetscCall(VecPointwiseDivide(step, r, grid->diag));
    PetscCall(VecAXPY(z, 2 * RELAXATION / grid->largest, step));
    PetscCall(Prescribe_Private(vi, z));
    PetscCall(VecPointwiseMin(z, z, vi->upper));
    PetscCall(Residual_Private(hierarchy, grid, z, r, &energy));
  }
  if (energy < first) {
    PetscCall(VecCopy(z, y));
    PetscCall(Pressed_Private(vi, y, r, active));
  }
  *gained = 2 * PetscMax(first - energy, 0);
  PetscCall(VecDestroy(&step));
  PetscCall(VecDestroy(&r));
  PetscCall(VecDestroy(&z));
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

PetscErrorCode CascadeStart(Hierarchy hierarchy, const char type[], Vec y, Vec active, PetscReal *gained)
{
  Vec at = NULL, start = NULL, found, next;

  PetscFunctionBeginUser;
  *gained = 0;
  for (PetscInt l = hierarchy->first; l + 1 < hierarchy->num; l++) {
    const Grid *finer = &hierarchy->grid[l + 1];

    if (!at) {
      PetscCall(VecDuplicate(hierarchy->grid[l].vi->b, &at));
      PetscCall(VecZeroEntries(at));
    }
    PetscCall(VecDuplicate(at, &found));
    PetscCall(SolveLevel_Private(hierarchy, l, type, *gained, start, at, found));
    PetscCall(VecDuplicate(finer->vi->b, &next));
    PetscCall(MatMult(finer->P, at, next));
    if (finer->lift) PetscCall(VecAXPY(next, 1, finer->lift));
    PetscCall(Prescribe_Private(finer->vi, next));
    PetscCall(VecDestroy(&at));
    at = next;
    PetscCall(VecDestroy(&start));
    PetscCall(VecDuplicate(at, &start));
    PetscCall(MatMult(finer->P, found, start));
    PetscCall(Round_Private(finer->vi, start));
    PetscCall(Relax_Private(hierarchy, finer, at, start, gained));
    if (strcmp(type, SNESPDAS)) PetscCall(Touch_Private(finer->vi, start, at));
    PetscCall(VecDestroy(&found));
  }
  PetscCall(VecCopy(at, y));
  PetscCall(VecCopy(start, active));
  PetscCall(VecDestroy(&at));
  PetscCall(VecDestroy(&start));
  PetscFunctionReturn(PETSC_SUCCESS);
}
