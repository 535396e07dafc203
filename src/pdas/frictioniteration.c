/* frictioniteration.c -- the iterations for contact with friction: Newton's, and the fixed point over
   Tresca's problems. */
#include "pdas/frictionimpl.h"

/* Tresca problems after which limits are accelerated: for a small coefficient they settle before. */
enum { PLAIN_PROBLEMS = 12 };
/* The iteration goes on from elsewhere after STALLED_STEPS steps in a row that stall, or if the
   residual is larger than the forces after FAR_STEPS. Not where a coarser mesh gave the initial states. */
enum { STALLED_STEPS = 2, FAR_STEPS = 2 };
/* The method gives up after PATIENCE successive steps that leave more than DESCENT of the residual. After
   SWEPT_PATIENCE of them it begins anew without sweeps and proximal steps. */
enum { PATIENCE = 40, SWEPT_PATIENCE = 10 };
static const PetscReal DESCENT = 0.9;
/* Above this coefficient tangential forces may be larger than pressures. Solutions with smaller coefficients
   are found first where steps stall again, and where pivoting is not possible. */
static const PetscReal LARGE_COEFFICIENT = 1;

/* A step that changes less than this part of the fewest decisions so far does not stall. */
static const PetscReal CHANGES_FACTOR = 0.7;

#define FAILURE_FIXED_POINT                                                                                            \
  "the fixed point iteration over Tresca's friction does not converge, as for a large coefficient"

PetscErrorCode FrictionIterationRestart(FrictionMethod method)
{
  PetscFunctionBeginUser;
  method->units.least = method->units.fewest = PETSC_MAX_REAL;
  method->units.waiting = method->units.stalled = 0;
  if (method->restart) PetscCall((*method->restart)(method));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Counts steps in a row that do not descend. They stall if they change no fewer decisions than steps before:
   with fewer and fewer changes they may converge while the residual still rises. Pivoting is sure, and does
   not wait for that. */
static void FrictionIterationCount_Private(FrictionMethod method, const FrictionStep *step)
{
  const PetscInt  patience = method->plain || method->pdas->fixed_point ? PATIENCE : SWEPT_PATIENCE;
  FrictionUnits  *units    = &method->units;
  const PetscBool fewer    = (PetscBool)(!method->pivot && (PetscReal)step->changed < CHANGES_FACTOR * units->fewest);

  units->waiting = step->residual < DESCENT * units->least ? 0 : units->waiting + 1;
  units->stalled = fewer || !units->waiting ? 0 : units->stalled + 1;
  units->least   = PetscMin(units->least, step->residual);
  if (step->changed) units->fewest = PetscMin(units->fewest, (PetscReal)step->changed);
  if (!step->done && units->waiting >= patience) method->pdas->failure = FAILURE_FRICTION;
}

PetscErrorCode FrictionIterationStep(SNES snes, FrictionMethod method, FrictionStep *step)
{
  PDAS *pdas = method->pdas;

  PetscFunctionBeginUser;
  *step = (FrictionStep){0};
  PetscCall((*method->step)(method, step));
  FrictionIterationCount_Private(method, step);
  pdas->converged                   = step->done;
  pdas->changed[pdas->iterations++] = step->changed;
  pdas->linear_iterations += step->iterations;
  pdas->num_active = step->closed;
  pdas->friction_report.shortened += step->shortened ? 1 : 0;
  pdas->safeguarded = (PetscBool)(pdas->friction_report.shortened > 0);
  pdas->residual    = step->size > 0 ? step->residual / step->size : 0;
  PetscCall(PetscInfo(snes,
                      "friction, step %" PetscInt_FMT ": %" PetscInt_FMT " decisions changed, residual %g of %g%s\n",
                      pdas->iterations, step->changed, (double)step->residual, (double)step->size,
                      step->shortened ? ", shortened" : ""));
  PetscCall(SNESSetIterationNumber(snes, pdas->iterations));
  PetscCall(SNESSetFunctionNorm(snes, step->residual));
  PetscCall(SNESMonitor(snes, pdas->iterations, step->residual));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Goes on from elsewhere: from the solution by pivoting, or from that without friction. Collective.
   [in] start - initial guess; [in] residual - after the last step */
static PetscErrorCode FrictionIterationMove_Private(SNES snes, FrictionMethod method, Vec start, PetscReal residual)
{
  PetscBool done = PETSC_FALSE;

  PetscFunctionBeginUser;
  if (method->pivot) PetscCall((*method->pivot)(method, PETSC_FALSE, &done));
  PetscCall(done ? FrictionIterationRestart(method) : FrictionRelease(snes, method, start, residual));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionIterationNewton(SNES snes, FrictionMethod method, Vec start, PetscBool stops)
{
  PDAS           *pdas  = method->pdas;
  PetscInt        begun = pdas->iterations;
  const PetscBool warm  = (PetscBool)(pdas->coarser.slipping + pdas->coarser.sticking > 0);
  PetscBool       moved = (PetscBool)(method->plain || method->grows || pdas->fixed_point || warm);

  PetscFunctionBeginUser;
  PetscCall(FrictionIterationRestart(method));
  pdas->converged = PETSC_FALSE;
  while (!pdas->converged && !pdas->failure && pdas->iterations < pdas->max_it) {
    FrictionStep step;
    PetscBool    far;

    PetscCall(FrictionIterationStep(snes, method, &step));
    far = (PetscBool)(step.residual > step.size);
    if ((moved && !stops) || step.done || pdas->failure) continue;
    if (method->units.stalled < STALLED_STEPS && (pdas->iterations - begun < FAR_STEPS || !far)) continue;
    if (moved || (far && stops && pdas->friction_yields)) break;
    moved = PETSC_TRUE;
    PetscCall(FrictionIterationMove_Private(snes, method, start, step.residual));
    begun = pdas->iterations;
  }
  if (!pdas->converged && !pdas->failure && pdas->iterations < pdas->max_it) pdas->failure = FAILURE_FRICTION;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The second method: Tresca problems; the limits of each follow from the pressures of the one before, after
   PLAIN_PROBLEMS with acceleration. Collective. */
static PetscErrorCode FrictionIterationFixedPoint_Private(SNES snes, PDAS *pdas, FrictionMethod method, Vec y)
{
  PetscReal       *mu, *given;
  PetscBool        settled  = PETSC_FALSE;
  PetscInt         problems = 0;
  FrictionAnderson anderson;

  PetscFunctionBeginUser;
  PetscCall(FrictionAndersonCreate(method->units.num, &anderson));
  PetscCall(FrictionUnitsBeginFixedPoint(&method->units, &mu, &given));
  while (pdas->iterations < pdas->max_it && !pdas->failure && !settled) {
    PetscCall(FrictionIterationNewton(snes, method, y, PETSC_FALSE));
    PetscCall(FrictionUnitsFreeze(&method->units, mu, given, ++problems > PLAIN_PROBLEMS ? &anderson : NULL, &settled));
    PetscCallMPI(MPI_Bcast(&settled, 1, MPIU_BOOL, 0, pdas->set.comm)); // the first rank may have all units
  }
  if (!settled) pdas->converged = PETSC_FALSE;
  if (!pdas->converged && !pdas->failure) pdas->failure = FAILURE_FIXED_POINT;
  PetscCall(FrictionAndersonDestroy(&anderson));
  PetscCall(PetscFree(mu));
  PetscCall(PetscFree(given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode FrictionIterationCreate_Private(PDAS *pdas, FrictionMethod method, Vec y)
{
  PetscFunctionBeginUser;
  PetscCall(pdas->reduced ? FrictionReducedCreate(method, y) : FrictionKrylovCreate(method, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest coefficient of all units. */
static PetscErrorCode FrictionIterationLargest_Private(FrictionMethod method, PetscReal *largest)
{
  const FrictionUnits *units = &method->units;

  PetscFunctionBeginUser;
  *largest = 0;
  for (PetscInt a = 0; a < units->num; a++) *largest = PetscMax(*largest, units->unit[a].coefficient);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPIU_REAL, MPI_MAX, method->pdas->set.comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Newton's method. If it fails, from the solution by pivoting if there is one, or from those with smaller
   coefficients. If that fails, once more from the same y without sweeps or proximal steps. Where there are
   several solutions these may lead to and fro between them. */
static PetscErrorCode FrictionIterationSolve_Private(SNES snes, PDAS *pdas, FrictionMethod method, Vec y)
{
  PetscReal largest;
  PetscBool stops, pivoted = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(FrictionIterationLargest_Private(method, &largest));
  stops = (PetscBool)(!method->pivot && largest > LARGE_COEFFICIENT);
  PetscCall(FrictionIterationNewton(snes, method, y, stops));
  if (pdas->converged || pdas->iterations >= pdas->max_it) PetscFunctionReturn(PETSC_SUCCESS);
  if (stops && pdas->friction_yields && pdas->residual > 1) PetscFunctionReturn(PETSC_SUCCESS);
  if (method->pivot) PetscCall((*method->pivot)(method, PETSC_TRUE, &pivoted));
  if (pivoted) {
    pdas->failure = NULL;
    PetscCall(FrictionIterationNewton(snes, method, y, PETSC_FALSE));
  }
  if (!pdas->converged && largest > LARGE_COEFFICIENT) PetscCall(FrictionGrow(snes, method, largest, y));
  if (pdas->converged || pdas->iterations >= pdas->max_it) PetscFunctionReturn(PETSC_SUCCESS);
  if (stops && pdas->friction_yields) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscInfo(snes, "friction, once more: %s\n", pdas->failure));
  PetscCall((*method->destroy)(method));
  PetscCall(FrictionUnitsDestroy(&method->units));
  pdas->failure = NULL;
  method->plain = PETSC_TRUE;
  PetscCall(FrictionIterationCreate_Private(pdas, method, y));
  PetscCall(FrictionIterationNewton(snes, method, y, PETSC_FALSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionIterate(SNES snes, PDAS *pdas, ActiveSolver solver, Vec y)
{
  struct _n_FrictionMethod method = {.pdas = pdas, .solver = solver};
  const PetscReal          rtol   = solver->rtol;
  PetscBool                beside = PETSC_FALSE;

  PetscFunctionBeginUser;
  method.rtol  = pdas->fixed_point ? 0 : pdas->friction_rtol;
  solver->rtol = PetscMax(rtol, method.rtol);
  PetscCall(FrictionIterationCreate_Private(pdas, &method, y));
  PetscCall(pdas->fixed_point ? FrictionIterationFixedPoint_Private(snes, pdas, &method, y)
                              : FrictionIterationSolve_Private(snes, pdas, &method, y));
  if (pdas->converged) PetscCall(FrictionFindOther(snes, &method, &beside));
  PetscCall((*method.finish)(&method, y));
  pdas->friction_report.others = (PetscBool)(pdas->law->held && (beside || pdas->friction_report.others));
  pdas->friction_report.beside = beside;
  PetscCall((*method.destroy)(&method));
  PetscCall(FrictionUnitsDestroy(&method.units));
  solver->rtol = rtol;
  PetscFunctionReturn(PETSC_SUCCESS);
}
