/* snessetup.c -- a SNES for an inequality. */
#include <math.h>
#include <string.h>
#include "base/compat.h"
#include "base/usererror.h"
#include "pdas/pdas.h"
#include "pdas/pdasimpl.h"
#include "multigrid/multigrid.h"
#include "solve/solverimpl.h"

/* Tolerance of an iterative linear solver, so that mostly one call reaches the tolerance of pdas. */
static const PetscReal KSP_RTOL       = 1e-10;
static const PetscReal MULTIGRID_RTOL = 5e-9;
/* About ten iterations are usual: after so many a factorization would have been cheaper, or the iteration
   does not converge. */
static const PetscInt MULTIGRID_MAX_IT = 500;
/* Divergence tolerance: an initial guess may be this much worse than zero, the solution of a set that left a
   body nearly free. */
static const PetscReal MULTIGRID_DTOL = 1e16;
/* Tolerances of PETSc's own types: relative to the first residual; many times the usual number of steps. */
static const PetscReal OTHER_RTOL   = 1e-12;
static const PetscInt  OTHER_MAX_IT = 500;
/* After so many steps the sets of PETSc's own type probably cycle. */
static const PetscInt CYCLING_IT = 30;
/* Largest number of steps of pdas: with one factorization for all sets they are cheap, and soft structures
   need many. */
static const PetscInt PDAS_MAX_IT = 500;
/* A residual below this part of |A| |y| after a step is roundoff. This is the only possible test for a soft
   structure, or a start at the solution. Before any step the residual may be a thousand times larger for
   bodies of different stiffness. */
static const PetscReal OTHER_ROUNDOFF = 1e-14;
/* Below this part of |A| |y| the residuals of two steps differ by roundoff mostly. */
static const PetscReal OTHER_ALIKE = 1e-12;

/* F(y) = A y - b */
static PetscErrorCode FunctionFn(SNES snes, Vec y, Vec f, void *ctx)
{
  const Inequality *solved = ctx;

  PetscFunctionBeginUser;
  (void)snes;
  PetscCall(CompensatedResidual(solved->A, solved->b, y, f));
  PetscCall(VecScale(f, -1));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* F'(y) = A, which exists already */
static PetscErrorCode JacobianFn(SNES snes, Vec y, Mat A, Mat P, void *ctx)
{
  (void)snes, (void)y, (void)A, (void)P, (void)ctx;
  return PETSC_SUCCESS;
}

/* |A|; for a shell |K| / stiffness, which differs next to contact only. */
static PetscErrorCode SNESSetupNorm_Private(const Inequality *solved, PetscReal *norm)
{
  const VI vi = solved->vi;

  PetscFunctionBeginUser;
  PetscCall(MatNorm(vi->assembled ? solved->A : vi->K, NORM_INFINITY, norm));
  if (!vi->assembled) *norm /= vi->stiffness;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Replaces the line search on the residual of vinewtonrsls by one on the energy, which excludes cycles. */
static PetscErrorCode SNESSetupLowerEnergy_Private(SNES snes)
{
  SNESLineSearch search;
  PetscBool      reduced, secant;
  void          *solved;

  PetscFunctionBeginUser;
  PetscCall(SNESGetLineSearch(snes, &search));
  PetscCall(PetscObjectTypeCompare((PetscObject)snes, SNESVINEWTONRSLS, &reduced));
  PetscCall(PetscObjectTypeCompare((PetscObject)search, SNESLINESEARCHSECANT, &secant));
  if (!reduced || !secant) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SNESGetFunction(snes, NULL, NULL, &solved));
  PetscCall(SNESLineSearchSetType(search, SNESLINESEARCHSHELL));
  PetscCall(SNESLineSearchShellSetApply(search, EnergySearchApply, solved));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Convergence test of PETSc's own types: relative to the first residual, or at roundoff. [in] ctx - |A| */
static PetscErrorCode ConvergedFn(SNES snes, PetscInt it, PetscReal xnorm, PetscReal snorm, PetscReal fnorm,
                                  SNESConvergedReason *reason, void *ctx)
{
  const PetscReal *norm = ctx;
  Vec              y;

  PetscFunctionBeginUser;
  PetscCall(SNESConvergedDefault(snes, it, xnorm, snorm, fnorm, reason, NULL));
  if (*reason) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SNESGetSolution(snes, &y));
  PetscCall(VecNorm(y, NORM_2, &xnorm));
  if (fnorm <= (it ? OTHER_ROUNDOFF : 0) * *norm * xnorm) *reason = SNES_CONVERGED_FNORM_ABS;
  if (!*reason && it == CYCLING_IT) PetscCall(SNESSetupLowerEnergy_Private(snes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes the full step where residuals cannot rank steps. [in] ctx - |A| */
static PetscErrorCode PostCheckFn(SNESLineSearch search, Vec y, Vec step, Vec next, PetscBool *changed_step,
                                  PetscBool *changed_next, void *ctx)
{
  const PetscReal *norm = ctx;
  PetscReal        fnorm, ynorm;
  SNES             snes;
  void            *solved;

  PetscFunctionBeginUser;
  PetscCall(SNESLineSearchGetSNES(search, &snes));
  PetscCall(SNESGetFunctionNorm(snes, &fnorm));
  PetscCall(VecNorm(y, NORM_2, &ynorm));
  *changed_step = PETSC_FALSE;
  *changed_next = (PetscBool)(fnorm <= OTHER_ALIKE * *norm * ynorm);
  if (!*changed_next) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SNESGetFunction(snes, NULL, NULL, &solved));
  PetscCall(VecWAXPY(next, -1, step, y));
  PetscCall(VecPointwiseMin(next, next, ((const Inequality *)solved)->upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Checks a relative tolerance that the user has set. [in] option - without prefix */
static PetscErrorCode SNESSetupCheckPart_Private(MPI_Comm comm, const char prefix[], const char option[])
{
  PetscReal part;
  PetscBool given;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetReal(NULL, prefix, option, &part, &given));
  if (given && !(isgreaterequal(part, 0) && isless(part, 1))) {
    PetscCall(UserErrorRaise(comm, "-%s%s %g: must be at least 0 and less than 1", prefix, option + 1, (double)part));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Checks a number of iterations that the user has set. */
static PetscErrorCode SNESSetupCheckMost_Private(MPI_Comm comm, const char prefix[], const char option[])
{
  PetscInt  most;
  PetscBool given;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetInt(NULL, prefix, option, &most, &given));
  if (given && most < 1) {
    PetscCall(UserErrorRaise(comm, "-%s%s %" PetscInt_FMT ": must be at least 1", prefix, option + 1, most));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Checks limits before PETSc reads them: up to 3.21 it accepts any number, and later negative ones have other
   meanings. */
static PetscErrorCode SNESSetupCheckLimits_Private(MPI_Comm comm, const char prefix[])
{
  PetscFunctionBeginUser;
  PetscCall(SNESSetupCheckMost_Private(comm, prefix, "-snes_max_it"));
  PetscCall(SNESSetupCheckMost_Private(comm, prefix, "-ksp_max_it"));
  PetscCall(SNESSetupCheckPart_Private(comm, prefix, "-snes_rtol"));
  PetscCall(SNESSetupCheckPart_Private(comm, prefix, "-ksp_rtol"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises tolerances below roundoff to roundoff. */
static PetscErrorCode SNESSetupRaiseToRounding_Private(SNES snes)
{
  KSP       ksp;
  PetscReal rtol;

  PetscFunctionBeginUser;
  PetscCall(SNESGetTolerances(snes, NULL, &rtol, NULL, NULL, NULL));
  rtol = PetscMax(rtol, PETSC_MACHINE_EPSILON);
  PetscCall(SNESSetTolerances(snes, PETSC_DEFAULT, rtol, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetTolerances(ksp, &rtol, NULL, NULL, NULL));
  rtol = PetscMax(rtol, PETSC_MACHINE_EPSILON);
  PetscCall(KSPSetTolerances(ksp, rtol, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SNESSetupConfigureLinear_Private(const SolverChoice *choice, KSP ksp)
{
  const PetscBool multigrid = (PetscBool)!strcmp(choice->pc, PCTRUNCATEDMG);
  PC              pc;

  PetscFunctionBeginUser;
  PetscCall(KSPSetType(ksp, choice->ksp));
  PetscCall(KSPSetTolerances(ksp, KSP_RTOL, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, choice->pc));
  if (multigrid) {
    PetscCall(KSPSetTolerances(ksp, MULTIGRID_RTOL, PETSC_DEFAULT, MULTIGRID_DTOL, MULTIGRID_MAX_IT));
    if (!strcmp(choice->ksp, KSPCG))
      PetscCall(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED)); // not all types support it
  }
  if (SolverChoiceFactors(choice->pc)) PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Configures PETSc's own types. [out] norm - for their test */
static PetscErrorCode SNESSetupConfigureOther_Private(const Inequality *solved, PetscInt max_it, PetscReal *norm,
                                                      SNES snes)
{
  SNESLineSearch search;

  PetscFunctionBeginUser;
  /* full steps may cycle; minimizing the residual along a step rarely does */
  PetscCall(SNESGetLineSearch(snes, &search));
  PetscCall(SNESLineSearchSetType(search, SNESLINESEARCHSECANT));
  PetscCall(SNESSetTolerances(snes, PETSC_DEFAULT, OTHER_RTOL, 0, max_it, PETSC_DEFAULT));
  PetscCall(
      SNESSetDivergenceTolerance(snes, PETSC_UNLIMITED)); // none: the first steps may go far before the set is right
  PetscCall(SNESSetupNorm_Private(solved, norm));
  PetscCall(SNESSetConvergenceTest(snes, ConvergedFn, norm, NULL));
  PetscCall(SNESLineSearchSetPostCheck(search, PostCheckFn, norm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SNESSetupCreate(const Inequality *solved, const SolverChoice *choice, Vec scratch, PetscReal *norm,
                               SNES *snes)
{
  const PetscBool pdas   = (PetscBool)!strcmp(choice->snes, SNESPDAS);
  const PetscInt  max_it = PetscMax(choice->max_it, pdas ? PDAS_MAX_IT : OTHER_MAX_IT);
  KSP             ksp;

  PetscFunctionBeginUser;
  PetscCall(SNESCreate(PetscObjectComm((PetscObject)solved->A), snes));
  PetscCall(SNESSetOptionsPrefix(*snes, choice->prefix));
  PetscCall(SNESSetFunction(*snes, scratch, FunctionFn, (void *)solved));
  PetscCall(SNESSetJacobian(*snes, solved->A, solved->A, JacobianFn, NULL));
  PetscCall(SNESGetKSP(*snes, &ksp));
  PetscCall(SNESSetupConfigureLinear_Private(choice, ksp));
  PetscCall(SNESSetType(*snes, choice->snes));
  if (pdas)
    PetscCall(SNESSetTolerances(*snes, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, max_it, PETSC_DEFAULT));
  else
    PetscCall(SNESSetupConfigureOther_Private(solved, max_it, norm, *snes));
  PetscCall(SNESSetupCheckLimits_Private(PetscObjectComm((PetscObject)*snes), choice->prefix));
  PetscCall(SNESSetFromOptions(*snes));
  PetscCall(SNESSetupRaiseToRounding_Private(*snes));
  PetscCall(SNESVISetVariableBounds(*snes, solved->vi->lower,
                                    solved->upper)); /* pdas keeps them itself, so not before the type */
  PetscFunctionReturn(PETSC_SUCCESS);
}
