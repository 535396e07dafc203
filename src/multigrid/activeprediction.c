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
/* Sets without a coarser mesh to start from: one that is too large loses a few rings of nodes in each. */
enum { MAX_FIRST_CYCLES = 12 };
/* The systems of the last few changes cost less than cycles: these stop where less than this part of the set
   changes. */
static const PetscReal FEW_CHANGES = 0.01;
/* Where contact alone holds a body, the first cycle moves it far beyond its bounds. Unknowns that go less
   than this part of the farthest one beyond are not in the first set. Each set then has two cycles. */
static const PetscReal DEEP_FROM = 0.9;
enum { FLOATING_CYCLES = 2 };
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
  PetscInt              pulling; /* active unknowns whose force has become a pull */
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

/* Updates the active set, and counts what pulls. [out] changed */
static PetscErrorCode ActivePredictionUpdateActive_Private(Iterate *it, PetscInt *changed)
{
  const PetscScalar *upper, *y, *r, *free;
  PetscScalar       *active;
  PetscInt           n, count[2] = {0, 0};

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(it->y, &n));
  PetscCall(VecGetArrayRead(it->free, &free));
  PetscCall(VecGetArrayRead(it->level->op.upper, &upper));
  PetscCall(VecGetArrayRead(it->y, &y));
  PetscCall(VecGetArrayRead(it->r, &r));
  PetscCall(VecGetArray(it->active, &active));
  for (PetscInt i = 0; i < n; i++) {
    const PetscScalar now = PetscRealPart(y[i]) >= PetscRealPart(upper[i]) && PetscRealPart(r[i]) > 0 ? 1 : 0;

    count[0] += active[i] != now;
    count[1] += free[i] == 0 && now == 0;
    active[i] = now;
  }
  PetscCall(VecRestoreArray(it->active, &active));
  PetscCall(VecRestoreArrayRead(it->r, &r));
  PetscCall(VecRestoreArrayRead(it->y, &y));
  PetscCall(VecRestoreArrayRead(it->level->op.upper, &upper));
  PetscCall(VecRestoreArrayRead(it->free, &free));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 2, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)it->y)));
  *changed    = count[0];
  it->pulling = count[1];
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

/* The largest limit below which at most num of the pressures lie, up to 1/BINS^ROUNDS of the largest one.
   Each round counts the pressures in equal parts of an interval. [in] pressure - positive, of this rank
   [n] */
static PetscErrorCode ActivePredictionLimit_Private(MPI_Comm comm, PetscInt n, const PetscReal pressure[], PetscInt num,
                                                    PetscReal *limit)
{
  enum { BINS = 1024, ROUNDS = 4 };
  PetscReal width = 0;
  PetscInt  count[BINS];

  PetscFunctionBeginUser;
  *limit = 0;
  for (PetscInt i = 0; i < n; i++) width = PetscMax(width, pressure[i]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &width, 1, MPIU_REAL, MPIU_MAX, comm));
  for (PetscInt k = 0; k < ROUNDS && width > 0; k++) {
    PetscInt bin = 0;

    width /= BINS;
    PetscCall(PetscArrayzero(count, BINS));
    for (PetscInt i = 0; i < n; i++) {
      const PetscReal at = (pressure[i] - *limit) / width;

      if (at >= 0 && at < BINS) count[(PetscInt)at]++;
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, BINS, MPIU_INT, MPI_SUM, comm));
    while (bin < BINS - 1 && count[bin] <= num) num -= count[bin++];
    *limit += width * (PetscReal)bin;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Frees as many pressed unknowns as pull, those with the least pressure: half of what is too much in a round
   contact pulls, if supports hold both bodies. What should touch is projected back. */
static PetscErrorCode ActivePredictionRelease_Private(Iterate *it)
{
  const PetscScalar *r, *diag;
  PetscScalar       *free;
  PetscReal         *pressure, limit;
  PetscInt           n, num = 0;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(it->free, &n));
  PetscCall(PetscMalloc1(n, &pressure));
  PetscCall(VecGetArrayRead(it->r, &r));
  PetscCall(VecGetArrayRead(it->level->diag, &diag));
  PetscCall(VecGetArray(it->free, &free));
  for (PetscInt i = 0; i < n; i++)
    if (free[i] == 0) pressure[num++] = PetscRealPart(r[i] / diag[i]);
  PetscCall(ActivePredictionLimit_Private(PetscObjectComm((PetscObject)it->free), num, pressure, it->pulling, &limit));
  for (PetscInt i = 0; i < n; i++)
    if (free[i] == 0 && PetscRealPart(r[i] / diag[i]) < limit) free[i] = 1;
  PetscCall(VecRestoreArray(it->free, &free));
  PetscCall(VecRestoreArrayRead(it->level->diag, &diag));
  PetscCall(VecRestoreArrayRead(it->r, &r));
  PetscCall(PetscFree(pressure));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ActivePredictionSetFree_Private(Iterate *it)
{
  PetscFunctionBeginUser;
  PetscCall(VecSet(it->free, 1));
  PetscCall(VecAXPY(it->free, -1, it->active));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* c = M B M r, a cycle for the free unknowns. */
static PetscErrorCode ActivePredictionCorrect_Private(Iterate *it, PC pc, Vec c)
{
  PetscFunctionBeginUser;
  PetscCall(VecPointwiseMult(it->product, it->r, it->free));
  PetscCall(PCApply(pc, it->product, c));
  PetscCall(VecPointwiseMult(c, c, it->free));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Cycles for the free unknowns, projected onto the bounds. */
static PetscErrorCode ActivePredictionCycle_Private(Iterate *it, PC pc, PetscInt num)
{
  const Vec upper = it->level->op.upper, c = it->step;

  PetscFunctionBeginUser;
  PetscCall(MultigridSetFree(pc, it->free, NULL));
  for (PetscInt k = 0; k < num; k++) {
    PetscCall(ActivePredictionCorrect_Private(it, pc, c));
    PetscCall(VecAXPY(c, 1, it->y));
    PetscCall(VecPointwiseMin(c, c, upper));
    PetscCall(VecAXPY(c, -1, it->y));
    PetscCall(ActivePredictionMove_Private(it, c));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One cycle beyond the bounds, and back onto them: unknowns beyond their bounds are set to these. From a
   start without contact a step within the bounds would be short. it->step is how far they were beyond.
   [in] kept - whether pc has the factors of the set before */
static PetscErrorCode ActivePredictionJump_Private(Iterate *it, PC pc, PetscBool kept)
{
  const Vec   c = it->step;
  PetscScalar work, energy;

  PetscFunctionBeginUser;
  PetscCall(ActivePredictionSetFree_Private(it));
  if (!kept) PetscCall(MultigridSetFree(pc, it->free, NULL));
  PetscCall(ActivePredictionCorrect_Private(it, pc, c));
  PetscCall(MatMult(it->level->op.A, c, it->product));
  it->hierarchy->work += it->level->share;
  PetscCall(VecDot(c, it->r, &work));
  PetscCall(VecDot(c, it->product, &energy));
  if (PetscRealPart(energy) > 0) PetscCall(VecAXPY(it->y, work / energy, c));
  PetscCall(VecCopy(it->y, it->step));
  PetscCall(VecPointwiseMin(it->y, it->y, it->level->op.upper));
  PetscCall(VecAXPY(it->step, -1, it->y));
  PetscCall(ActivePredictionEvaluate_Private(it));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Leaves in the set what the first cycle moved farthest beyond the bounds, and what it began with. */
static PetscErrorCode ActivePredictionKeepDeep_Private(Iterate *it)
{
  const PetscScalar *beyond, *free;
  PetscScalar       *active;
  PetscReal          most;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecMax(it->step, NULL, &most));
  PetscCall(VecGetLocalSize(it->step, &n));
  PetscCall(VecGetArrayRead(it->step, &beyond));
  PetscCall(VecGetArrayRead(it->free, &free));
  PetscCall(VecGetArray(it->active, &active));
  for (PetscInt i = 0; i < n; i++)
    if (free[i] != 0 && PetscRealPart(beyond[i]) < DEEP_FROM * most) active[i] = 0;
  PetscCall(VecRestoreArray(it->active, &active));
  PetscCall(VecRestoreArrayRead(it->free, &free));
  PetscCall(VecRestoreArrayRead(it->step, &beyond));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode ActivePredictionBegin_Private(Iterate *it)
{
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(it->y, &it->r));
  PetscCall(VecDuplicate(it->y, &it->free));
  PetscCall(VecDuplicate(it->y, &it->step));
  PetscCall(VecDuplicate(it->y, &it->product));
  PetscCall(VecSet(it->free, 1));
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
    PetscCall(ActivePredictionSetFree_Private(&it));
    PetscCall(ActivePredictionCycle_Private(&it, pc, 1));
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

PetscErrorCode ActivePredictionStart(Hierarchy hierarchy, const HierarchyLevel *level, PC pc, PetscBool floats, Vec y,
                                     Vec active)
{
  Iterate   it      = {.hierarchy = hierarchy, .level = level, .y = y, .active = active};
  PetscInt  changed = 0;
  PetscReal size;

  PetscFunctionBeginUser;
  PetscCall(ActivePredictionBegin_Private(&it));
  PetscCall(ActivePredictionJump_Private(&it, pc, PETSC_FALSE));
  PetscCall(ActivePredictionUpdateActive_Private(&it, &changed));
  if (floats) PetscCall(ActivePredictionKeepDeep_Private(&it));
  it.pulling = 0;
  PetscCall(VecNorm(active, NORM_1, &size));
  for (PetscInt k = 0; k < MAX_FIRST_CYCLES && (PetscReal)changed > FEW_CHANGES * size; k++) {
    PetscCall(ActivePredictionSetFree_Private(&it));
    if (it.pulling) PetscCall(ActivePredictionRelease_Private(&it));
    PetscCall(ActivePredictionCycle_Private(&it, pc, floats ? FLOATING_CYCLES : 1));
    PetscCall(ActivePredictionUpdateActive_Private(&it, &changed));
    PetscCall(VecNorm(active, NORM_1, &size));
    PetscCall(PetscInfo(pc, "cycle %" PetscInt_FMT " ahead: %" PetscInt_FMT " changed\n", k + 1, changed));
  }
  PetscCall(ActivePredictionEnd_Private(&it));
  PetscFunctionReturn(PETSC_SUCCESS);
}
