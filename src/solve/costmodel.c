/* costmodel.c -- when an iteration that drags gives way to a factorisation.

   Soft structures take hundreds of active sets, and bodies that only contact holds many sweeps. Each costs an iteration what all of it
   costs others, and a factorisation that serves all sets next to nothing. How many are to come nobody knows; as many as there have been is a guess
   that is wrong by a factor of two at most when it counts [1]. Costs are counted, not measured: a clock would decide otherwise on another day.

   References: [1] Karlin, Manasse, Rudolph, Sleator, Competitive snoopy caching, 1988: rent until that has cost as much as to buy. */
#include "base/compat.h"
#include "base/memory.h"
#include "contact/pair.h"
#include "pdas/pdasimpl.h"
#include "pdas/factorization.h"
#include "multigrid/iterationcost.h"

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

PetscErrorCode PatienceUnit(VI vi, PetscReal *operations)
{
  MatInfo info;

  PetscFunctionBeginUser;
  PetscCall(MatGetInfo(vi->K, MAT_GLOBAL_SUM, &info));
  *operations = FASTER * 2 * info.nz_used;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal PatienceSet(PetscInt num)
{
  return PetscPowRealInt(FREE * (PetscReal)num, 3) / 3;
}

PetscReal PatienceForetold(const Patience *patience)
{
  return patience->asked ? patience->once + (PetscReal)patience->sets * patience->set : 0;
}

/* By the pattern of K: contact adds couplings of one side with the other, which few unknowns have. */
static PetscErrorCode Ask_Private(Patience *patience, VI vi, PetscBool slow, PetscBool sprung)
{
  ActiveSet      set;
  FactorForecast forecast;
  PetscReal      unit;
  PetscBool      one, suffices;
  PetscInt      *C = NULL;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetCreate(vi->upper, vi->A, &set));
  one = (PetscBool)(set.N <= ACTIVE_MAX_REDUCED);
  if (one) PetscCall(ActiveSetAll(&set, &C));
  PetscCall(FactorForetell(vi->K, one ? set.N : 0, C, "", &forecast));
  PetscCall(PatienceUnit(vi, &unit));
  if (slow) unit *= SMOOTHING;
  patience->once = one ? (sprung ? WITH_SPRINGS : 1) * forecast.operations / unit : 0;
  patience->set  = (one ? PatienceSet(set.N) : forecast.operations) / unit;
  PetscCall(MemorySuffices(set.comm, forecast.bytes, &suffices));
  patience->asked = PETSC_TRUE;
  patience->on    = (PetscBool)(forecast.known && suffices);
  PetscCall(PetscInfo(vi->K, "a factorisation takes %g products, and %g for each set; memory %s\n",
                      (double)patience->once, (double)patience->set, suffices ? "suffices" : "does not suffice"));
  PetscCall(PetscFree(C));
  PetscCall(ActiveSetDestroy(&set));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PatienceCheck(Patience *patience, VI vi, PetscBool slow, PetscBool sprung, PetscReal work)
{
  PetscFunctionBeginUser;
  if (!patience->on || work <= SUSPICIOUS) PetscFunctionReturn(PETSC_SUCCESS);
  if (!patience->asked) PetscCall(Ask_Private(patience, vi, slow, sprung));
  patience->over = (PetscBool)(patience->on && work > (patience->found ? FOUND : 1) * PatienceForetold(patience));
  PetscFunctionReturn(PETSC_SUCCESS);
}
