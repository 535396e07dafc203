/* activeprediction.c -- projected steps and truncated cycles, which find the end of contact before any system
   is solved.

   Steps of a simple iteration, y := min( upper, y + omega D^-1 r ), correct the active set locally [1].
   Errors from contact elsewhere need a multigrid cycle on the free unknowns, projected onto the bounds, with
   the step length that minimizes the energy [2]. This costs little compared with a system of a set that is
   not the last one.

   References: [1] Kornhuber, Monotone multigrid methods for elliptic variational inequalities I, 1994. [2]
   Graeser, Kornhuber, Multigrid methods for obstacle problems, 2009. */
#include "base/compat.h"
#include "multigrid/activeprediction.h"
#include "multigrid/multigrid.h"

/* Projected steps at the start and after each cycle, and the largest number of cycles: two or three until the
   set does not change. */
enum { PROJECTED_STEPS = 4, STEPS_PER_CYCLE = 1, MAX_CYCLES = 3 };
/* Cycles without a coarser mesh to start from: a set that is too large loses one ring of nodes in each. */
enum { MAX_FIRST_CYCLES = 12 };
/* The systems of the last few changes cost less than cycles: they stop where this part of the set changes. */
static const PetscReal FEW_CHANGES = 0.02;
/* Step length relative to the largest stable one. */
static const PetscReal RELAXATION = 0.9;

/* The iterate. */
typedef struct {
  Hierarchy             hierarchy;
  const HierarchyLevel *level;
  Vec                   y, r;   /* feasible; b - A y */
  PetscReal             energy; /* 1/2 y'A y - b'y */
  Vec                   active; /* 1 or 0: at its bound with a force on it */
  Vec                   free;   /* 1 - active */
  Vec                   step, product;
} Iterate;

/* Computes r and the energy of y. */
static PetscErrorCode ActivePredictionEvaluate_Private(Iterate *it)
{
  PetscScalar by, ry;

  PetscFunctionBeginUser;
  PetscCall(MatMult(it->level->op.A, it->y, it->r));
  PetscCall(VecAYPX(it->r, -1, it->level->op.b));
  PetscCall(VecDot(it->y, it->level->op.b, &by));
  PetscCall(VecDot(it->y, it->r, &ry));
  it->energy = -0.5 * PetscRealPart(by + ry);
  it->hierarchy->work += it->level->share;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ActivePredictionSteps_Private(Iterate *it, PetscInt num)
{
  const HierarchyLevel *level = it->level;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < num; k++) {
    PetscCall(VecPointwiseDivide(it->step, it->r, level->diag));
    PetscCall(VecAXPY(it->y, 2 * RELAXATION / level->largest, it->step));
    PetscCall(VecPointwiseMin(it->y, it->y, level->op.upper));
    PetscCall(ActivePredictionEvaluate_Private(it));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Updates the active set. [out] changed */
static PetscErrorCode ActivePredictionUpdateActive_Private(Iterate *it, PetscInt *changed)
{
  const PetscScalar *upper, *y, *r;
  PetscScalar       *active;
  PetscInt           n;

  PetscFunctionBeginUser;
  *changed = 0;
  PetscCall(VecGetLocalSize(it->y, &n));
  PetscCall(VecGetArrayRead(it->level->op.upper, &upper));
  PetscCall(VecGetArrayRead(it->y, &y));
  PetscCall(VecGetArrayRead(it->r, &r));
  PetscCall(VecGetArray(it->active, &active));
  for (PetscInt i = 0; i < n; i++) {
    const PetscScalar now = PetscRealPart(y[i]) >= PetscRealPart(upper[i]) && PetscRealPart(r[i]) > 0 ? 1 : 0;

    *changed += active[i] != now;
    active[i] = now;
  }
  PetscCall(VecRestoreArray(it->active, &active));
  PetscCall(VecRestoreArrayRead(it->r, &r));
  PetscCall(VecRestoreArrayRead(it->y, &y));
  PetscCall(VecRestoreArrayRead(it->level->op.upper, &upper));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, changed, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)it->y)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y := y + a c, a <= 1 where the energy is least. [in] c - y + c is feasible */
static PetscErrorCode ActivePredictionMove_Private(Iterate *it, Vec c)
{
  PetscScalar work, energy;
  PetscReal   a;

  PetscFunctionBeginUser;
  PetscCall(MatMult(it->level->op.A, c, it->product));
  it->hierarchy->work += it->level->share;
  PetscCall(VecDot(c, it->r, &work));
  PetscCall(VecDot(c, it->product, &energy));
  if (!(PetscRealPart(work) > 0)) PetscFunctionReturn(PETSC_SUCCESS);
  a = PetscRealPart(work) < PetscRealPart(energy) ? PetscRealPart(work / energy) : 1;
  PetscCall(VecAXPY(it->y, a, c));
  PetscCall(VecPointwiseMin(it->y, it->y, it->level->op.upper)); // rounding
  PetscCall(VecAXPY(it->r, -a, it->product));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* c = M B M r, a cycle for the free unknowns. [in] kept - whether B is that of the set before */
static PetscErrorCode ActivePredictionCorrect_Private(Iterate *it, PC pc, PetscBool kept, Vec c)
{
  PetscFunctionBeginUser;
  PetscCall(VecSet(it->free, 1));
  PetscCall(VecAXPY(it->free, -1, it->active));
  if (!kept) PetscCall(MultigridSetFree(pc, it->free, NULL));
  PetscCall(VecPointwiseMult(it->product, it->r, it->free));
  PetscCall(PCApply(pc, it->product, c));
  PetscCall(VecPointwiseMult(c, c, it->free));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One cycle for the free unknowns, projected onto the bounds. */
static PetscErrorCode ActivePredictionCycle_Private(Iterate *it, PC pc)
{
  const Vec upper = it->level->op.upper, c = it->step;

  PetscFunctionBeginUser;
  PetscCall(ActivePredictionCorrect_Private(it, pc, PETSC_FALSE, c));
  PetscCall(VecAXPY(c, 1, it->y));
  PetscCall(VecPointwiseMin(c, c, upper));
  PetscCall(VecAXPY(c, -1, it->y));
  PetscCall(ActivePredictionMove_Private(it, c));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One cycle beyond the bounds, and back onto them: unknowns beyond their bounds are set to these. From a
   start without contact a step within the bounds would be short.
   [in] kept - of ActivePredictionCorrect_Private() */
static PetscErrorCode ActivePredictionJump_Private(Iterate *it, PC pc, PetscBool kept)
{
  const Vec   c = it->step;
  PetscScalar work, energy;

  PetscFunctionBeginUser;
  PetscCall(ActivePredictionCorrect_Private(it, pc, kept, c));
  PetscCall(MatMult(it->level->op.A, c, it->product));
  it->hierarchy->work += it->level->share;
  PetscCall(VecDot(c, it->r, &work));
  PetscCall(VecDot(c, it->product, &energy));
  if (PetscRealPart(energy) > 0) PetscCall(VecAXPY(it->y, work / energy, c));
  PetscCall(VecPointwiseMin(it->y, it->y, it->level->op.upper));
  PetscCall(ActivePredictionEvaluate_Private(it));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ActivePredictionBegin_Private(Iterate *it)
{
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(it->y, &it->r));
  PetscCall(VecDuplicate(it->y, &it->free));
  PetscCall(VecDuplicate(it->y, &it->step));
  PetscCall(VecDuplicate(it->y, &it->product));
  PetscCall(ActivePredictionEvaluate_Private(it));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ActivePredictionEnd_Private(Iterate *it)
{
  PetscFunctionBeginUser;
  PetscCall(VecDestroy(&it->product));
  PetscCall(VecDestroy(&it->step));
  PetscCall(VecDestroy(&it->free));
  PetscCall(VecDestroy(&it->r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActivePredictionGetActive(Hierarchy hierarchy, const HierarchyLevel *level, Vec y, Vec active)
{
  Iterate  it = {.hierarchy = hierarchy, .level = level, .y = y, .active = active};
  PetscInt changed;

  PetscFunctionBeginUser;
  PetscCall(ActivePredictionBegin_Private(&it));
  PetscCall(ActivePredictionUpdateActive_Private(&it, &changed));
  PetscCall(ActivePredictionEnd_Private(&it));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActivePredictionApply(Hierarchy hierarchy, const HierarchyLevel *level, PC pc, Vec y, Vec active,
                                     PetscReal *gained)
{
  Iterate   it = {.hierarchy = hierarchy, .level = level, .y = y, .active = active};
  PetscReal first;
  PetscInt  changed = 0;

  PetscFunctionBeginUser;
  *gained = 0;
  if (level->S) PetscFunctionReturn(PETSC_SUCCESS); // the diagonal is no smoother here
  PetscCall(VecPointwiseMin(y, y, level->op.upper));
  PetscCall(ActivePredictionBegin_Private(&it));
  first = it.energy;
  PetscCall(ActivePredictionSteps_Private(&it, PROJECTED_STEPS));
  PetscCall(ActivePredictionUpdateActive_Private(&it, &changed));
  for (PetscInt k = 0; k < MAX_CYCLES && pc && (!k || changed); k++) {
    PetscCall(ActivePredictionCycle_Private(&it, pc));
    PetscCall(ActivePredictionSteps_Private(&it, STEPS_PER_CYCLE));
    PetscCall(ActivePredictionUpdateActive_Private(&it, &changed));
    PetscCall(PetscInfo(pc, "cycle %" PetscInt_FMT " ahead: %" PetscInt_FMT " changed\n", k + 1, changed));
  }
  *gained = 2 * PetscMax(first - it.energy, 0);
  PetscCall(ActivePredictionEnd_Private(&it));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActivePredictionBeyond(Hierarchy hierarchy, const HierarchyLevel *level, PC pc, PetscBool kept, Vec y,
                                      Vec active)
{
  const PetscInt max     = kept ? MAX_CYCLES + 1 : MAX_CYCLES; // the first one needs no factors
  Iterate        it      = {.hierarchy = hierarchy, .level = level, .y = y, .active = active};
  PetscInt       changed = 0;

  PetscFunctionBeginUser;
  PetscCall(VecPointwiseMin(y, y, level->op.upper));
  PetscCall(ActivePredictionBegin_Private(&it));
  PetscCall(ActivePredictionUpdateActive_Private(&it, &changed));
  for (PetscInt k = 0; k < max && (!k || changed); k++) {
    PetscCall(ActivePredictionJump_Private(&it, pc, (PetscBool)(kept && !k)));
    PetscCall(ActivePredictionUpdateActive_Private(&it, &changed));
    PetscCall(PetscInfo(pc, "cycle %" PetscInt_FMT " beyond: %" PetscInt_FMT " changed\n", k + 1, changed));
  }
  PetscCall(ActivePredictionEnd_Private(&it));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActivePredictionStart(Hierarchy hierarchy, const HierarchyLevel *level, PC pc, Vec y, Vec active)
{
  Iterate   it      = {.hierarchy = hierarchy, .level = level, .y = y, .active = active};
  PetscInt  changed = 0;
  PetscReal size;

  PetscFunctionBeginUser;
  PetscCall(ActivePredictionBegin_Private(&it));
  PetscCall(ActivePredictionJump_Private(&it, pc, PETSC_FALSE));
  PetscCall(ActivePredictionUpdateActive_Private(&it, &changed));
  PetscCall(VecNorm(active, NORM_1, &size));
  for (PetscInt k = 0; k < MAX_FIRST_CYCLES && (PetscReal)changed > FEW_CHANGES * size; k++) {
    PetscCall(ActivePredictionCycle_Private(&it, pc));
    PetscCall(ActivePredictionUpdateActive_Private(&it, &changed));
    PetscCall(VecNorm(active, NORM_1, &size));
    PetscCall(PetscInfo(pc, "cycle %" PetscInt_FMT " ahead: %" PetscInt_FMT " changed\n", k + 1, changed));
  }
  PetscCall(ActivePredictionEnd_Private(&it));
  PetscFunctionReturn(PETSC_SUCCESS);
}
