/* energysearch.c -- a line search that lowers the energy.

   The residual on the free set jumps when the set changes, so a search that reduces it may cycle. The energy
   does not jump. A projected step s(t) = min(y + t d, upper) - y changes it by F.s + s.As / 2. It falls if t
   is small [1] (eq. 10.2). No set returns.

   References: [1] Bertsekas, Projected Newton methods for optimization problems with simple constraints,
   1982. */
#include "base/compat.h"
#include "solve/solverimpl.h"

/* A step is accepted if the energy falls by this part of the prediction by its slope; else it is halved, at
   most so often. */
static const PetscReal DECREASE = 1e-4;
enum { MAX_HALVINGS = 50 };

/* A step and where it may lead; step and product are work. */
typedef struct {
  Vec y, f, d, next, step, product;
} EnergyStep;

/* Sets next to the end of a step, which may be shorter than the projected one: the energy is least there.
   [in] part - of d;
   [out] enough - whether the energy falls enough */
static PetscErrorCode EnergySearchTry_Private(const Inequality *solved, const EnergyStep *at, PetscReal part,
                                              PetscBool *enough)
{
  PetscScalar slope, curvature, promised;
  PetscReal   along = 1;

  PetscFunctionBeginUser;
  PetscCall(VecWAXPY(at->next, -part, at->d, at->y)); // PETSc subtracts steps
  PetscCall(VecPointwiseMin(at->next, at->next, solved->upper));
  PetscCall(VecWAXPY(at->step, -1, at->y, at->next));
  PetscCall(MatMult(solved->A, at->step, at->product));
  PetscCall(VecDot(at->f, at->step, &slope));
  PetscCall(VecDot(at->step, at->product, &curvature));
  PetscCall(VecDot(at->f, at->d, &promised));
  if (PetscRealPart(slope) < 0 && PetscRealPart(curvature) > -PetscRealPart(slope))
    along = -PetscRealPart(slope) / PetscRealPart(curvature);
  PetscCall(VecWAXPY(at->next, along, at->step, at->y));
  *enough = (PetscBool)(along * PetscRealPart(slope) + 0.5 * along * along * PetscRealPart(curvature) <=
                        -DECREASE * part * PetscAbsReal(PetscRealPart(promised)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnergySearchApply(SNESLineSearch search, void *ctx)
{
  const Inequality *solved = ctx;
  PetscBool         enough = PETSC_FALSE, changed_step, changed_next;
  PetscReal         part   = 1;
  SNES              snes;
  EnergyStep        at;

  PetscFunctionBeginUser;
  PetscCall(SNESLineSearchGetSNES(search, &snes));
  PetscCall(SNESLineSearchGetVecs(search, &at.y, &at.f, &at.d, &at.next, &at.product));
  PetscCall(VecDuplicate(at.y, &at.step));
  for (PetscInt i = 0; i <= MAX_HALVINGS && !enough; i++, part *= 0.5)
    PetscCall(EnergySearchTry_Private(solved, &at, part, &enough));
  PetscCall(VecDestroy(&at.step));
  PetscCall(SNESLineSearchPostCheck(search, at.y, at.d, at.next, &changed_step, &changed_next));
  PetscCall(VecCopy(at.next, at.y));
  PetscCall(SNESComputeFunction(snes, at.y, at.f));
  PetscCall(SNESLineSearchSetReason(search, SNES_LINESEARCH_SUCCEEDED));
  PetscCall(SNESLineSearchComputeNorms(search));
  PetscFunctionReturn(PETSC_SUCCESS);
}
