/* costmodel.c -- when an iteration that drags gives way to a factorisation.

   Soft structures take hundreds of active sets, and bodies that only contact holds many sweeps. Each costs an iteration what all of it
   costs others, and a factorisation that serves all sets next to nothing. How many are to come nobody knows; as many as there have been is a guess
   that is wrong by a factor of two at most when it counts [1]. Costs are counted, not measured: a clock would decide otherwise on another day.

   References: [1] Karlin, Manasse, Rudolph, Sleator, Competitive snoopy caching, 1988: rent until that has cost as much as to buy. */
#include "base/compat.h"
#include "base/memory.h"
#include "pdas/pdasimpl.h"
#include "pdas/factorization.h"
#include "solve/costmodel.h"

/* Work that no scene reaches which multigrid is good for; the analysis of a factorisation takes some tenth of it. */
static const PetscReal SUSPICIOUS = 300;
/* Operations of a factorisation in the time of one of a product, and the part of a product's time that smoothing takes beside it where it solves
   for lines and planes. Measured, on one core, with OpenBLAS: balls of 36,000 unknowns, order 2. */
static const PetscReal FASTER = 1.5, SMOOTHING = 2;
/* Factorisations where springs hold bodies, which get weaker once in a while. */
enum { WITH_SPRINGS = 2 };
/* When contacts are found, an iteration may take so many times what a factorisation would: that begins with finding them. */
static const PetscReal FOUND = 2;
/* Part of the unknowns with bounds that are free, for the dense factorisation of each set. */
static const PetscReal FREE = 0.5;

PetscErrorCode CostModelUnit(VI vi, PetscReal *operations)
{
  MatInfo info;

  PetscFunctionBeginUser;
  PetscCall(MatGetInfo(vi->K, MAT_GLOBAL_SUM, &info));
  *operations = FASTER * 2 * info.nz_used;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal CostModelPerSet(PetscInt num)
{
  return PetscPowRealInt(FREE * (PetscReal)num, 3) / 3;
}

PetscReal CostModelPredicted(const CostModel *model)
{
  return model->asked ? model->once + (PetscReal)model->hierarchy->num_systems * model->set : 0;
}

/* By the pattern of K: contact adds couplings of one side with the other, which few unknowns have. */
static PetscErrorCode CostModelPredict_Private(CostModel *model)
{
  const HierarchyLevel *finest = &model->hierarchy->level[model->hierarchy->num - 1];
  const VI              vi     = model->vi;
  ActiveSet             set;
  FactorizationCost     cost;
  PetscReal             unit;
  PetscBool             one, suffices;
  PetscInt             *C = NULL;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetCreate(vi->upper, vi->A, &set));
  one = (PetscBool)(set.N <= ACTIVE_MAX_SCHUR);
  if (one) PetscCall(ActiveSetAll(&set, &C));
  PetscCall(FactorizationPredict(vi->K, one ? set.N : 0, C, "", &cost));
  PetscCall(CostModelUnit(vi, &unit));
  if (finest->S) unit *= SMOOTHING;
  model->once = one ? (finest->op.W ? WITH_SPRINGS : 1) * cost.operations / unit : 0;
  model->set  = (one ? CostModelPerSet(set.N) : cost.operations) / unit;
  PetscCall(MemorySuffices(set.comm, cost.bytes, &suffices));
  model->asked = PETSC_TRUE;
  model->on    = (PetscBool)(cost.known && suffices);
  PetscCall(PetscInfo(vi->K, "a factorisation takes %g products, and %g for each set; memory %s\n", (double)model->once,
                      (double)model->set, suffices ? "suffices" : "does not suffice"));
  PetscCall(PetscFree(C));
  PetscCall(ActiveSetDestroy(&set));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Of HierarchySetCostTest(). */
static PetscErrorCode IsOverFn(void *ctx, PetscBool *over)
{
  CostModel      *model = ctx;
  const PetscReal work  = model->hierarchy->work;

  PetscFunctionBeginUser;
  if (model->on && work > SUSPICIOUS) {
    if (!model->asked) PetscCall(CostModelPredict_Private(model));
    model->over = (PetscBool)(model->on && work > (model->found ? FOUND : 1) * CostModelPredicted(model));
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
