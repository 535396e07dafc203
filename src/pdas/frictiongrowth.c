/* frictiongrowth.c -- large coefficients of friction: the solution with a smaller one first.

   Where the coefficient is large there are many solutions, and Newton's steps lead to and fro between them.
   With a smaller coefficient they find one. It then grows, each time by the largest factor with which the
   steps descend. The first step after it has grown keeps the decisions: where the limit grows at once, all
   nodes that slip would stick. */
#include "pdas/frictionimpl.h"

/* The factor is FIRST_FACTOR at first, squared after growth that took one step, and its root after steps that
   did not descend, down to LEAST_FACTOR. */
static const PetscReal FIRST_FACTOR = 4, LEAST_FACTOR = 1.1;

/* Newton steps with a part of the coefficients. Collective.
   [in] law - units with the whole ones; [in] first - whether no smaller part was solved */
static PetscErrorCode FrictionGrowthSolve_Private(SNES snes, FrictionMethod method, Vec start, const FrictionUnit law[],
                                                  PetscReal part, PetscBool first)
{
  PDAS          *pdas  = method->pdas;
  const PetscInt begun = pdas->iterations;

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < method->units.num; a++) method->units.unit[a].coefficient = part * law[a].coefficient;
  method->decided = method->grows = (PetscBool)!first;
  pdas->failure                   = NULL;
  PetscCall(FrictionIterationNewton(snes, method, start, (PetscBool)!first));
  PetscCall(PetscInfo(snes, "friction, %g of the coefficient: %s in %" PetscInt_FMT " steps\n", (double)part,
                      pdas->converged ? "solved" : "given up", pdas->iterations - begun));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Lets the coefficients grow until they are whole, or no factor leads on. Collective.
   [in] law, kept - units with the whole coefficients, and memory [num]; [in] part - the first one;
   [in] solved - memory */
static PetscErrorCode FrictionGrowthRun_Private(SNES snes, FrictionMethod method, Vec start, const FrictionUnit law[],
                                                FrictionUnit kept[], PetscReal part, Vec solved)
{
  const FrictionUnits *units  = &method->units;
  PDAS                *pdas   = method->pdas;
  PetscReal            factor = FIRST_FACTOR, last = 0;

  PetscFunctionBeginUser;
  while (last < 1 && factor >= LEAST_FACTOR && pdas->iterations < pdas->max_it) {
    const PetscInt begun = pdas->iterations;

    PetscCall(FrictionGrowthSolve_Private(snes, method, start, law, part, (PetscBool)(last == 0)));
    if (pdas->converged) {
      if (pdas->iterations == begun + 1) factor *= factor;
      last = part;
      PetscCall((*method->get)(method, solved));
      PetscCall(PetscArraycpy(kept, units->unit, units->num));
    } else {
      if (last == 0 || pdas->friction_yields) break;
      factor = PetscSqrtReal(factor);
      PetscCall((*method->set)(method, solved));
      PetscCall(PetscArraycpy(units->unit, kept, units->num));
    }
    part = PetscMin(1, last * factor);
  }
  if (last < 1) pdas->converged = PETSC_FALSE; // with a part of the coefficients, at the limit of iterations
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionGrow(SNES snes, FrictionMethod method, PetscReal largest, Vec start)
{
  FrictionUnits *units = &method->units;
  FrictionUnit  *law, *kept;
  Vec            solved;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(units->num, &law, units->num, &kept));
  PetscCall(VecDuplicate(start, &solved));
  PetscCall(PetscArraycpy(law, units->unit, units->num));
  FrictionUnitsForget(units);
  PetscCall((*method->set)(method, start));
  PetscCall(FrictionGrowthRun_Private(snes, method, start, law, kept, 1 / largest, solved));
  for (PetscInt a = 0; a < units->num; a++) units->unit[a].coefficient = law[a].coefficient;
  method->grows = PETSC_FALSE;
  PetscCall(VecDestroy(&solved));
  PetscCall(PetscFree2(law, kept));
  PetscFunctionReturn(PETSC_SUCCESS);
}
