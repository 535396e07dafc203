/* pdasiteration.c -- the iteration of `pdas`: from the initial active set to the solution of the inequality.

   Each step fixes the active unknowns at their bounds and solves for the others. Then it removes those with a
   tensile force from the set and adds those beyond their bound (eq. 10.1). If none moves, all inequalities
   hold. It is a semismooth Newton method [1], and its number of steps hardly depends on the size. It may
   cycle [2]: then the projected Newton globalization takes over (projectednewton.c).

   References: [1] Hintermueller, Ito, Kunisch, The primal-dual active set strategy as a semismooth Newton
   method, 2002. [2] Ben Gharbia, Gilbert, Nonconvergence of the plain Newton-min algorithm for LCPs, 2012. */
#include <string.h>
#include "pdas/pdasimpl.h"

/* Steps after which the globalization starts: contact problems take up to about fifteen. */
static const PetscInt MAX_PLAIN_STEPS = 30;
/* Residual at which an inexact solution is first evaluated, and its factor each time the solution confirms
   the set. */
static const PetscReal FIRST_RESIDUAL = 1e-2, RESIDUAL_FACTOR = 0.03;
/* The system was too inexact on two conditions. A step changes more than CHANGES_FACTOR of the changes
   before, and more than ENTERING_PART of its changes enter the set. A set that only shrinks loses one ring of
   nodes in each step, however exact the system. */
static const PetscReal CHANGES_FACTOR = 0.7, ENTERING_PART = 0.25;
/* Threshold of a set in a vector, which has 1 and 0. */
static const PetscReal ACTIVE_FROM = 0.5;

PetscErrorCode PDASBegin(SNES snes, PDAS *pdas, ActiveSet *set, Vec y, Vec r)
{
  PetscBool *next;
  PetscReal *guess, *force, norm;
  PetscInt   changed;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(set->n, &next, set->n, &guess, set->n, &force));
  PetscCall(ActiveSetGather(set, pdas->previous ? pdas->previous : y, guess));
  PetscCall(ActiveSetGather(set, r, force));
  for (PetscInt i = 0; i < set->n; i++) {
    switch (pdas->start) {
    case START_FULL: next[i] = PETSC_TRUE; break;
    case START_GAP: next[i] = (PetscBool)(set->upper[i] <= 0); break;
    case START_PREVIOUS:
      if (pdas->previous)
        next[i] = (PetscBool)(guess[i] > ACTIVE_FROM);
      else
        next[i] = (PetscBool)(force[i] + pdas->c * set->diag[i] * (guess[i] - set->upper[i]) > 0); /* eq. 10.1 */
      break;
    default: next[i] = PETSC_FALSE;
    }
  }
  PetscCall(ActiveSetReplace(set, next, &changed));
  PetscCall(PetscFree3(next, guess, force));
  pdas->num_active = set->num_active;
  PetscCall(VecNorm(r, NORM_2, &norm));
  PetscCall(SNESSetIterationNumber(snes, 0));
  PetscCall(SNESSetFunctionNorm(snes, norm));
  PetscCall(SNESMonitor(snes, 0, norm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the present set was solved before; adds it to the list. */
static PetscErrorCode PDASIterationIsRepeated_Private(PDAS *pdas, const ActiveSet *set, PetscBool *seen)
{
  uint64_t hash;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetHash(set, &hash));
  *seen = PETSC_FALSE;
  for (PetscInt i = 0; i < pdas->num_seen; i++) *seen = (PetscBool)(*seen || pdas->seen[i] == hash);
  pdas->seen[pdas->num_seen++] = hash;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Records one iteration and calls the monitors. */
static PetscErrorCode PDASIterationRecord_Private(SNES snes, PDAS *pdas, const ActiveSet *set,
                                                  const ActiveSolution *solution, PetscInt changed, PetscReal violation)
{
  const PetscReal norm = PetscSqrtReal(PetscSqr(violation) + PetscSqr(solution->norm));

  PetscFunctionBeginUser;
  pdas->changed[pdas->iterations++] = changed;
  pdas->linear_iterations += solution->iterations;
  pdas->residual   = solution->eta;
  pdas->num_active = set->num_active;
  pdas->failure    = solution->failure;
  PetscCall(SNESSetIterationNumber(snes, pdas->iterations));
  PetscCall(SNESSetFunctionNorm(snes, norm));
  PetscCall(SNESMonitor(snes, pdas->iterations, norm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves the system of the present set and applies the active set test. [in,out] solution - iterations are
   added */
static PetscErrorCode PDASIterationSystem_Private(PDAS *pdas, ActiveSet *set, ActiveSolver solver,
                                                  ActiveSolution *solution, PetscInt *changed, PetscReal *violation)
{
  const PetscInt before = solution->iterations;

  PetscFunctionBeginUser;
  PetscCall(solver->solve(solver, set->active, set->upper, solution));
  solution->iterations += before;
  if (!solution->failure) PetscCall(ActiveSetUpdate(set, solution, pdas->c, changed, violation));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The callback of an inexact solver: lowers the target while the set holds. */
static PetscErrorCode PDASIterationHolds_Private(ActiveSolver solver, const ActiveSolution *iterate, PetscBool *holds)
{
  PDAS *pdas = solver->pdas;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetHolds(solver->set, iterate, pdas->c, holds));
  while (*holds && solver->target > solver->rtol && iterate->eta <= solver->target)
    solver->target = PetscMax(solver->rtol, RESIDUAL_FACTOR * solver->target);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the last system was too inexact to tell which unknowns to change.
   [in] before - size of the set before */
static PetscBool PDASIterationIsNoisy_Private(const PDAS *pdas, const ActiveSet *set, PetscInt before, PetscInt changed)
{
  const PetscReal entering = 0.5 * (PetscReal)(changed + set->num_active - before);

  return (PetscBool)(pdas->iterations > 0 &&
                     (PetscReal)changed > CHANGES_FACTOR * (PetscReal)pdas->changed[pdas->iterations - 1] &&
                     entering > ENTERING_PART * (PetscReal)changed);
}

/* Solves for the set, and again with a lower target if the solver did not call back and the set holds. */
static PetscErrorCode PDASIterationSolveSet_Private(PDAS *pdas, ActiveSet *set, ActiveSolver solver,
                                                    ActiveSolution *solution, PetscInt *changed, PetscReal *violation)
{
  const PetscInt before = set->num_active;

  PetscFunctionBeginUser;
  solver->holds  = PDASIterationHolds_Private;
  solver->pdas   = pdas;
  solver->target = pdas->target;
  PetscCall(PDASIterationSystem_Private(pdas, set, solver, solution, changed, violation));
  while (solver->target > solver->rtol && !*changed && !solution->failure) {
    solver->target = PetscMax(solver->rtol, RESIDUAL_FACTOR * solver->target);
    PetscCall(PDASIterationSystem_Private(pdas, set, solver, solution, changed, violation));
  }
  solver->holds   = NULL;
  pdas->converged = (PetscBool)(!*changed && !solution->failure);
  if (PDASIterationIsNoisy_Private(pdas, set, before, *changed)) {
    pdas->target       = PetscMax(solver->rtol, RESIDUAL_FACTOR * pdas->target);
    solver->all_digits = PETSC_TRUE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether sets were changed by inexact solutions. */
static PetscBool PDASIterationIsInexact_Private(const PDAS *pdas, ActiveSolver solver)
{
  return (PetscBool)(pdas->target > solver->rtol || (solver->error_reduction > 0 && !solver->all_digits));
}

/* One step of the active set method, or of the globalization after a set was repeated. */
static PetscErrorCode PDASIterationStep_Private(PDAS *pdas, ActiveSet *set, ActiveSolver solver,
                                                ProjectedNewton *newton, ActiveSolution *solution, PetscInt *changed,
                                                PetscReal *violation)
{
  PetscBool seen = PETSC_FALSE;

  PetscFunctionBeginUser;
  *changed             = 0;
  *violation           = 0;
  solution->iterations = 0;
  if (!newton->on) {
    PetscCall(PDASIterationIsRepeated_Private(pdas, set, &seen));
    if (seen &&
        PDASIterationIsInexact_Private(pdas, solver)) { // inexact solutions may be the cause; no set was solved exactly
      pdas->target       = PetscMax(solver->rtol, RESIDUAL_FACTOR * pdas->target);
      solver->all_digits = PETSC_TRUE;
      pdas->seen[0]      = pdas->seen[pdas->num_seen - 1];
      pdas->num_seen     = 1;
      seen               = PETSC_FALSE;
    }
    if (seen || pdas->num_seen > MAX_PLAIN_STEPS) {
      pdas->safeguarded = PETSC_TRUE;
      pdas->target = solver->target = solver->rtol;
      PetscCall(ProjectedNewtonBegin(newton, set, solver, solution));
    }
  }
  if (newton->on && !newton->settled) {
    PetscCall(ProjectedNewtonStep(newton, set, solver, solution, changed, violation));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  newton->settled = PETSC_FALSE; /* if this set is not confirmed, the globalization continues */
  PetscCall(PDASIterationSolveSet_Private(pdas, set, solver, solution, changed, violation));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The first set may leave a body unsupported: then more contacts must be active. [out] changed - 0 for other
   failures */
static PetscErrorCode PDASIterationActivateAll_Private(const PDAS *pdas, ActiveSet *set, ActiveSolution *solution,
                                                       PetscInt *changed)
{
  PetscBool *all;

  PetscFunctionBeginUser;
  *changed = 0;
  if (pdas->start_set || pdas->iterations || set->num_active == set->N) PetscFunctionReturn(PETSC_SUCCESS);
  if (!strcmp(solution->failure, FAILURE_MEMORY) || !strcmp(solution->failure, FAILURE_COST))
    PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(set->n, &all));
  for (PetscInt i = 0; i < set->n; i++) all[i] = PETSC_TRUE;
  PetscCall(ActiveSetReplace(set, all, changed));
  PetscCall(PetscFree(all));
  solution->failure = NULL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Iterates until the set does not change. [out] y */
PetscErrorCode PDASIterate(SNES snes, PDAS *pdas, ActiveSet *set, ActiveSolver solver, Vec y)
{
  ActiveSolution  solution;
  ProjectedNewton newton = {.on = PETSC_FALSE};
  PetscInt        changed;
  PetscReal       violation;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolutionCreate(set, &solution));
  solver->all_digits = PETSC_FALSE;
  pdas->target       = solver->inexact ? PetscMax(FIRST_RESIDUAL, solver->rtol) : solver->rtol;
  while (!pdas->converged && !solution.failure && pdas->iterations < pdas->max_it) {
    PetscCall(PDASIterationStep_Private(pdas, set, solver, &newton, &solution, &changed, &violation));
    if (solution.failure) PetscCall(PDASIterationActivateAll_Private(pdas, set, &solution, &changed));
    if (pdas->converged || (!solution.failure && pdas->iterations + 1 == pdas->max_it)) {
      PetscCall(solver->finish(solver, &solution, y));
      if (solution.failure) pdas->converged = PETSC_FALSE;
    }
    PetscCall(PDASIterationRecord_Private(snes, pdas, set, &solution, changed, violation));
  }
  if (newton.on) PetscCall(ProjectedNewtonEnd(&newton));
  PetscCall(ActiveSolutionDestroy(&solution));
  PetscFunctionReturn(PETSC_SUCCESS);
}
