/* frictionrelease.c -- goes on from the solution without friction, where Newton's steps do not descend.

   A thin body that is pressed by its own tension, like a belt, has no tension behind nodes that stick, and
   so no pressure there. Contact and slip then spread along it by its bending length in each step. Without
   friction all of it slides and is pressed, and the next step finds what sticks. So it is where heat moves
   all of a body along rigid jaws.

   Friction alone may hold the body. Then it slides far without friction. The first step after that ends where
   all slip has turned back, and the method goes on from where it was. */
#include "pdas/frictionimpl.h"

/* Largest number of steps without friction. */
enum { RELEASED_STEPS = 8 };
/* Gaps below this part of the largest value are closed. */
static const PetscReal TOUCHES = 1e-10;

/* The active set method, from the initial set. [in,out] y - initial guess, solution */
static PetscErrorCode FrictionReleaseSets_Private(SNES snes, FrictionMethod method, Vec y)
{
  PDAS      *pdas = method->pdas;
  ActiveSet *set  = &pdas->set;
  PetscBool *closed;
  PetscInt   changed;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(set->n, &closed));
  for (PetscInt i = 0; i < set->n; i++) closed[i] = (PetscBool)(set->active[i] && set->upper[i] < PETSC_INFINITY);
  PetscCall(ActiveSetReplace(set, closed, &changed));
  PetscCall(PetscFree(closed));
  pdas->num_seen = 0;
  PetscCall(PDASIterate(snes, pdas, set, method->solver, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The first decisions: closed is what touches. Forces at the begin of a load step tell less, and so do those
   beside nodes that stick. */
static void FrictionReleaseTouch_Private(FrictionUnits *units)
{
  PetscReal largest = 0;

  FrictionUnitsForget(units);
  for (PetscInt i = 0; i < units->n; i++) largest = PetscMax(largest, PetscAbsReal(units->y[i]));
  for (PetscInt a = 0; a < units->num; a++) {
    FrictionUnit *unit = &units->unit[a];

    unit->closed = (PetscBool)(units->y[unit->normal] >= unit->upper - TOUCHES * largest);
  }
}

/* Steps of the dense system, before which sweeps find what is closed. [in,out] y - initial guess, solution */
static PetscErrorCode FrictionReleaseSteps_Private(SNES snes, FrictionMethod method, Vec y)
{
  FrictionUnits *units = &method->units;
  FrictionUnit  *law;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(units->num, &law));
  PetscCall(PetscArraycpy(law, units->unit, units->num));
  for (PetscInt a = 0; a < units->num; a++) units->unit[a].coefficient = units->unit[a].bound = 0;
  PetscCall((*method->set)(method, y));
  FrictionReleaseTouch_Private(units);
  method->decided = PETSC_TRUE;
  method->grows   = PETSC_TRUE;
  PetscCall(FrictionIterationNewton(snes, method, y, PETSC_FALSE));
  method->grows = PETSC_FALSE;
  PetscCall((*method->get)(method, y));
  PetscCall(PetscArraycpy(units->unit, law, units->num));
  PetscCall(PetscFree(law));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves without friction. [in,out] y - initial guess, solution; [out] solved */
static PetscErrorCode FrictionReleaseSolve_Private(SNES snes, FrictionMethod method, Vec y, PetscBool *solved)
{
  PDAS          *pdas   = method->pdas;
  const PetscInt max_it = pdas->max_it;

  PetscFunctionBeginUser;
  pdas->max_it = PetscMin(max_it, pdas->iterations + RELEASED_STEPS);
  if (pdas->reduced)
    PetscCall(FrictionReleaseSteps_Private(snes, method, y));
  else
    PetscCall(FrictionReleaseSets_Private(snes, method, y));
  *solved         = pdas->converged;
  pdas->max_it    = max_it;
  pdas->converged = PETSC_FALSE;
  pdas->failure   = NULL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionRelease(SNES snes, FrictionMethod method, Vec start, PetscReal residual)
{
  PDAS          *pdas  = method->pdas;
  FrictionUnits *units = &method->units;
  FrictionUnit  *kept;
  FrictionStep   step = {.residual = residual};
  Vec            before, without;
  PetscBool      solved = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(units->num, &kept));
  PetscCall(PetscArraycpy(kept, units->unit, units->num));
  PetscCall(VecDuplicate(start, &before));
  PetscCall(VecDuplicate(start, &without));
  PetscCall((*method->get)(method, before));
  PetscCall(VecCopy(start, without));
  PetscCall(FrictionReleaseSolve_Private(snes, method, without, &solved));
  PetscCall(FrictionIterationRestart(method));
  if (solved) {
    FrictionUnitsForget(units);
    PetscCall((*method->set)(method, without));
    PetscCall(FrictionIterationStep(snes, method, &step));
  }
  if (!pdas->converged && (step.turned || !(step.residual < residual))) {
    PetscCall(PetscInfo(snes, "friction: back from the solution without it\n"));
    PetscCall(PetscArraycpy(units->unit, kept, units->num));
    PetscCall((*method->set)(method, before));
    PetscCall(FrictionIterationRestart(method));
    pdas->failure = NULL;
  }
  PetscCall(VecDestroy(&before));
  PetscCall(VecDestroy(&without));
  PetscCall(PetscFree(kept));
  PetscFunctionReturn(PETSC_SUCCESS);
}
