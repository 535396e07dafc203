/* discretizationstop.c -- stopping where the solver's error no longer counts beside that of the mesh (eq. 14.7).

   What the solution differs by from that of the next coarser level tells the discretisation error: if the squares of such differences
   fall by rho from level to level, |u - u_h|_K^2 is a (rho - 1)th of |u_h - u_2h|_K^2 [1]. Three levels show rho. The iteration has to
   know before it ends, and is stopped as if elements of order p converged as they can, rho = 4^p: where they cannot, at corners and
   at the ends of contact, that asks for too much rather than too little.

   References: [1] Bank, Weiser, Some a posteriori error estimators for elliptic partial differential equations, 1985; it is
               Richardson's extrapolation of the energy. */
#include "base/compat.h"
#include "pdas/pdas.h"
#include "pdas/pdasimpl.h"
#include "solve/errorbound.h"
#include "solve/discretizationstop.h"

/* Part of the discretisation error that the solver's may be, and the part of that which it aims at, since what an iteration sees of its
   error is an estimate. */
static const PetscReal SHARE = 0.1, AIM = 0.7;
/* How often the solver goes on where the bound of its error says so. */
enum { MORE = 4 };

/* Of two levels that do not show rho, and the least that is believed of three: an order of 1/2, as beside the worst of corners. */
static const PetscReal SLOW = 2;

/* |u_h - u_2h|^2 by |u - u_h|^2, at most */
static PetscReal DiscretizationStopRatio_Private(const Scene scene)
{
  PetscInt order = 1;

  for (PetscInt b = 0; b < scene->num_bodies; b++) order = PetscMax(order, scene->bodies[b].order);
  return PetscPowReal(4, order) - 1;
}

/* The same by what the levels show. [in] change - |u_h - u_2h|^2, and of the level before, or 0 */
static PetscReal DiscretizationStopObserved_Private(const Scene scene, PetscReal change, PetscReal before)
{
  const PetscReal fall = change > 0 && before > 0 ? before / change : SLOW;

  return PetscMin(PetscMax(fall, SLOW) - 1, DiscretizationStopRatio_Private(scene));
}

PetscReal DiscretizationStopPart(const Scene scene)
{
  return PetscSqr(AIM * SHARE) / DiscretizationStopRatio_Private(scene);
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
  for (PetscInt k = 0; k < MORE && report->converged && !(report->bound.value <= SHARE * report->discretisation); k++) {
    const PetscReal excess = report->bound.value / (SHARE * report->discretisation);

    aim /= excess > 0 && excess < 1 / PETSC_SMALL ? 2 * excess : 2;
    PetscCall(PDASSetErrorReduction(context->snes, PetscSqr(aim * SHARE) / ratio, 0));
    PetscCall(PDASGetActive(context->snes, &active));
    PetscCall(PDASSetStart(context->snes, active));
    PetscCall(SNESSolve(context->snes, NULL, y));
    PetscCall(SolverReportAdd(context->snes, &context->proximal.solved, y, report));
    PetscCall(ErrorBoundCompute(&context->proximal, context->snes, y, &report->bound));
  }
  if (report->converged && !(report->bound.value <= SHARE * report->discretisation)) {
    report->converged = PETSC_FALSE;
    PetscCall(PetscStrncpy(
        report->reason,
        "the error of the solver stays above a tenth of the discretisation error; omit -stop discretisation",
        sizeof(report->reason)));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
