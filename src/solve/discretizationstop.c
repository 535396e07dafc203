/* discretizationstop.c -- stopping when the error of the solver is small beside the discretization error (eq.
   14.7).

   The difference from the solution of the next coarser level estimates the discretization error. If the
   squares of these differences fall by rho per level, |u - u_h|_K^2 is 1/(rho - 1) times |u_h - u_2h|_K^2
   [1]. Three levels determine rho. During the iteration rho = 4^p of smooth solutions is assumed for order p.
   At corners and at the ends of contact this demands too much rather than too little.

   References: [1] Bank, Weiser, Some a posteriori error estimators for elliptic partial differential
   equations, 1985; it is Richardson extrapolation of the energy. */
#include "base/compat.h"
#include "pdas/pdas.h"
#include "pdas/pdasimpl.h"
#include "solve/errorbound.h"
#include "solve/discretizationstop.h"

/* Largest solver error relative to the discretization error, and the part of it that the iteration aims at,
   since its own error estimate is inexact. */
static const PetscReal ERROR_SHARE = 0.1, AIM = 0.7;
/* Largest number of continued solves after the error bound. */
enum { MAX_CONTINUED = 4 };

/* Least rho: without a third level, and for three levels. Order 1/2, as at the worst corners. */
static const PetscReal MIN_RHO = 2;

/* Largest |u_h - u_2h|^2 / |u - u_h|^2. */
static PetscReal DiscretizationStopRatio_Private(const Scene scene)
{
  PetscInt order = 1;

  for (PetscInt b = 0; b < scene->num_bodies; b++) order = PetscMax(order, scene->bodies[b].order);
  return PetscPowReal(4, order) - 1;
}

/* The same as observed on the levels. [in] change - |u_h - u_2h|^2, and of the level before, or 0 */
static PetscReal DiscretizationStopObserved_Private(const Scene scene, PetscReal change, PetscReal before)
{
  const PetscReal fall = change > 0 && before > 0 ? before / change : MIN_RHO;

  return PetscMin(PetscMax(fall, MIN_RHO) - 1, DiscretizationStopRatio_Private(scene));
}

PetscReal DiscretizationStopPart(const Scene scene)
{
  return PetscSqr(AIM * ERROR_SHARE) / DiscretizationStopRatio_Private(scene);
}

PetscErrorCode DiscretizationStopSet(const SolverContext *context, PetscReal energy_decrease)
{
  const VI vi = context->proximal.solved.vi;

  PetscFunctionBeginUser;
  PetscCall(PDASSetErrorReduction(context->snes, DiscretizationStopPart(vi->scene), energy_decrease));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode DiscretizationStopConfirm(SolverContext *context, Vec y, SolverReport *report)
{
  const VI        vi    = context->proximal.solved.vi;
  const PetscReal ratio = DiscretizationStopRatio_Private(vi->scene);
  PetscReal       aim   = AIM, change;
  ActiveSolver    solver;
  Vec             active;

  PetscFunctionBeginUser;
  PetscCall(PDASGetSolver(context->snes, &solver));
  if (!solver) PetscFunctionReturn(PETSC_SUCCESS);
  change                 = solver->first * vi->stiffness * PetscSqr(vi->length);
  report->discretisation = PetscSqrtReal(
      change / DiscretizationStopObserved_Private(vi->scene, change, context->levels ? context->levels->change : 0));
  for (PetscInt k = 0;
       k < MAX_CONTINUED && report->converged && !(report->bound.value <= ERROR_SHARE * report->discretisation); k++) {
    const PetscReal excess = report->bound.value / (ERROR_SHARE * report->discretisation);

    aim /= excess > 0 && excess < 1 / PETSC_SMALL ? 2 * excess : 2;
    PetscCall(PDASSetErrorReduction(context->snes, PetscSqr(aim * ERROR_SHARE) / ratio, 0));
    PetscCall(PDASGetActive(context->snes, &active));
    PetscCall(PDASSetStart(context->snes, active));
    PetscCall(SNESSolve(context->snes, NULL, y));
    PetscCall(SolverReportAdd(context->snes, &context->proximal.solved, y, report));
    PetscCall(ErrorBoundCompute(&context->proximal, context->snes, y, &report->bound));
  }
  if (report->converged && !(report->bound.value <= ERROR_SHARE * report->discretisation)) {
    report->converged = PETSC_FALSE;
    PetscCall(PetscStrncpy(
        report->reason,
        "the error of the solver stays above a tenth of the discretisation error; omit -stop discretisation",
        sizeof(report->reason)));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
