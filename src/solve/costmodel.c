/* costmodel.c -- when a factorization replaces an iteration.

   Soft structures need hundreds of active sets; bodies that only contact holds need many proximal point
   steps. By iteration, each of these linear systems costs about the same. One factorization can serve all of
   them, and then each costs little. The number of future systems is unknown. The rule assumes as many as so
   far: then the total cost is at most twice the least possible one [1]. Costs are counted operations:
   measured times would vary between runs.

   References: [1] Karlin, Manasse, Rudolph, Sleator, Competitive snoopy caching, 1988. */
#include "base/compat.h"
#include "base/memory.h"
#include "pdas/pdasimpl.h"
#include "pdas/factorization.h"
#include "solve/costmodel.h"

/* Work (in products) after which the cost of a factorization is predicted; the second number is for bodies
   that only contact holds. Scenes suited to multigrid stay below it. The prediction costs about a tenth of
   the first number. */
static const PetscReal PREDICT_FROM = 300, FLOATING_PREDICT_FROM = 120;
/* Operations of a factorization in the time of one operation of a product; time of a product with block
   smoothing, relative to one without. Measured on one core with OpenBLAS: balls of 36,000 unknowns, order
   2. */
static const PetscReal OPERATION_RATE = 1.5, SMOOTHING_COST = 2;
/* Largest cost of the iteration for bodies that only contact holds, relative to a factorization. Measured in
   products, iteration and factorization: cubes of 46,875 unknowns 80 to 110 and 530; stacked blocks of
   60,225, 49 and 516; balls of order 2, of 27,783 unknowns 15,000 and 681, of 36,501 unknowns 29,000 and
   875. */
static const PetscReal FLOATING_FACTOR = 0.25;
/* The same ratio once the inequality has been solved with a proximal term: a factorization would begin with
   an unknown contact state again. */
static const PetscReal FOUND_FACTOR = 2;
/* The same ratio for the remaining cost of a system, once an iterate has confirmed its set. */
static const PetscReal LEFT_FACTOR = 0.5;
/* Assumed part of the bounded unknowns that is free, for the dense factorization of each set. */
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

/* Predicts the cost from the pattern of K: contact couples few unknowns more. */
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

/* Whether only contact holds a body. */
static PetscBool CostModelFloats_Private(const CostModel *model)
{
  return (PetscBool)(model->hierarchy->level[model->hierarchy->num - 1].op.W != NULL);
}

/* Largest cost of the iteration, relative to a factorization. */
static PetscReal CostModelFactor_Private(const CostModel *model)
{
  if (model->found) return FOUND_FACTOR;
  return CostModelFloats_Private(model) ? FLOATING_FACTOR : 1;
}

/* The callback of HierarchySetCostTest(). */
static PetscErrorCode IsOverFn(void *ctx, PetscReal left, PetscBool *over)
{
  CostModel      *model = ctx;
  const PetscReal work  = model->hierarchy->work;

  PetscFunctionBeginUser;
  if (model->on && work > (CostModelFloats_Private(model) ? FLOATING_PREDICT_FROM : PREDICT_FROM)) {
    if (!model->asked) PetscCall(CostModelPredict_Private(model));
    model->over = (PetscBool)(model->on && work > CostModelFactor_Private(model) * CostModelPredicted(model) &&
                              left > LEFT_FACTOR * CostModelPredicted(model));
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
