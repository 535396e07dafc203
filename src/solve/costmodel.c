/* costmodel.c -- when a factorization replaces an iteration.

   Soft structures need hundreds of active sets, and bodies that contact alone holds need many proximal point
   steps. Each costs an iteration the same; a factorization that serves all sets solves them at little cost.
   The number of future sets is unknown. The rule assumes as many as so far, which is wrong by a factor of two
   at most [1]. Costs are counted, not measured: times would vary between runs.

   References: [1] Karlin, Manasse, Rudolph, Sleator, Competitive snoopy caching, 1988. */
#include "base/compat.h"
#include "base/memory.h"
#include "pdas/pdasimpl.h"
#include "pdas/factorization.h"
#include "solve/costmodel.h"

/* Work (in products) after which a factorization is predicted: scenes suited to multigrid stay below it. The
   analysis costs about a tenth of the first. The second is for bodies that contact alone holds. */
static const PetscReal PREDICT_FROM = 300, FLOATING_PREDICT_FROM = 120;
/* Operations of a factorization in the time of one operation of a product; time of block smoothing relative
   to a product. Measured, on one core, with OpenBLAS: balls of 36,000 unknowns, order 2. */
static const PetscReal OPERATION_RATE = 1.5, SMOOTHING_COST = 2;
/* An iteration for bodies that contact alone holds may cost so much of a factorization. In products, iteration and factorization: cubes of
   46,875 unknowns 80 to 110 and 530, stacked blocks of 60,225 49 and 516; balls of 27,783 and 36,501, order 2, 15,000 and 681, 29,000 and 875.
   Others end more often between half and one. */
static const PetscReal FLOATING_FACTOR = 0.25;
/* Once contacts are found, an iteration may cost so many times a factorization, which would have to find them
   again. */
static const PetscReal FOUND_FACTOR = 2;
/* Part of the bounded unknowns that is free, for the dense factorization of each set. */
static const PetscReal FREE_PART = 0.5;

PetscErrorCode CostModelUnit(VI vi, PetscReal *operations)
{
  MatInfo info;

  PetscFunctionBeginUser;
  PetscCall(MatGetInfo(vi->K, MAT_GLOBAL_SUM, &info));
  *operations = OPERATION_RATE * 2 * info.nz_used;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal CostModelPerSet(PetscInt num)
{
  return PetscPowRealInt(FREE_PART * (PetscReal)num, 3) / 3;
}

PetscReal CostModelPredicted(const CostModel *model)
{
  return model->asked ? model->once + (PetscReal)model->hierarchy->num_systems * model->set : 0;
}

/* Predicts the cost by the pattern of K: contact adds couplings of few unknowns only. */
static PetscErrorCode CostModelPredict_Private(CostModel *model)
{
  const HierarchyLevel *finest = &model->hierarchy->level[model->hierarchy->num - 1];
  const VI              vi     = model->vi;
  ActiveSet             set;
  FactorizationCost     cost;
  PetscReal             unit;
  PetscBool             one, suffices;
  Mat                   K;
  PetscInt             *C = NULL;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetCreate(vi->upper, vi->A, &set));
  one = (PetscBool)(set.N <= ACTIVE_MAX_SCHUR);
  if (one) PetscCall(ActiveSetAll(&set, &C));
  PetscCall(MatConvert(vi->K, MATAIJ, MAT_INITIAL_MATRIX, &K));
  PetscCall(FactorizationPredict(K, one ? set.N : 0, C, "", &cost));
  PetscCall(MatDestroy(&K));
  PetscCall(CostModelUnit(vi, &unit));
  if (finest->S) unit *= SMOOTHING_COST;
  model->once = one ? cost.operations / unit : 0;
  model->set  = (one ? CostModelPerSet(set.N) : cost.operations) / unit;
  PetscCall(MemorySuffices(set.comm, cost.bytes, &suffices));
  model->asked = PETSC_TRUE;
  model->on    = (PetscBool)(cost.known && suffices);
  PetscCall(PetscInfo(vi->K, "a factorization takes %g products, and %g for each set; memory %s\n", (double)model->once,
                      (double)model->set, suffices ? "suffices" : "does not suffice"));
  PetscCall(PetscFree(C));
  PetscCall(ActiveSetDestroy(&set));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether contact alone holds a body. */
static PetscBool CostModelFloats_Private(const CostModel *model)
{
  return (PetscBool)(model->hierarchy->level[model->hierarchy->num - 1].op.W != NULL);
}

/* How many times a factorization an iteration may cost. */
static PetscReal CostModelFactor_Private(const CostModel *model)
{
  if (model->found) return FOUND_FACTOR;
  return CostModelFloats_Private(model) ? FLOATING_FACTOR : 1;
}

/* The callback of HierarchySetCostTest(). */
static PetscErrorCode IsOverFn(void *ctx, PetscBool *over)
{
  CostModel      *model = ctx;
  const PetscReal work  = model->hierarchy->work;

  PetscFunctionBeginUser;
  if (model->on && work > (CostModelFloats_Private(model) ? FLOATING_PREDICT_FROM : PREDICT_FROM)) {
    if (!model->asked) PetscCall(CostModelPredict_Private(model));
    model->over = (PetscBool)(model->on && work > CostModelFactor_Private(model) * CostModelPredicted(model));
  }
  *over = model->over;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CostModelSet(CostModel *model, VI vi, Hierarchy hierarchy)
{
  PetscFunctionBeginUser;
  *model = (CostModel){.vi = vi, .hierarchy = hierarchy};
  PetscCall(HierarchySetCostTest(hierarchy, IsOverFn, model));
  PetscFunctionReturn(PETSC_SUCCESS);
}
