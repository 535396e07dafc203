/* pdas.c -- the SNES type `pdas`: primal-dual active set method for  min 1/2 y'A y - b'y,  y <= upper [1].

   Only public headers: the type is built on SNESSHELL, and its context is composed with the SNES. This file
   has its options, its getters, and gets the problem from a SNES; the iteration is in pdasiteration.c.

   References: [1] Hueber, Wohlmuth, A primal-dual active set strategy for non-linear multibody contact,
   2005. */
#include "base/usererror.h"
#include "pdas/pdas.h"
#include "pdas/frictionimpl.h"
#include "pdas/pdasimpl.h"
#include "multigrid/multigrid.h"

static const char CONTEXT[] = "MortisePDAS"; /* name under which the context is composed */

static const char *const PDASStarts[] = {"empty", "full", "gap", "previous"};

PetscErrorCode PDASGet(SNES snes, PDAS **pdas)
{
  PetscContainer container;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectQuery((PetscObject)snes, CONTEXT, (PetscObject *)&container));
  PetscCheck(container, PetscObjectComm((PetscObject)snes), PETSC_ERR_ARG_WRONGSTATE, "SNES is not of type " SNESPDAS);
  PetscCall(PetscContainerGetPointer(container, (void **)pdas));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASGetHistory(SNES snes, PetscInt *iterations, PetscInt *active, const PetscInt *changed[],
                              PetscBool *safeguarded)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  if (iterations) *iterations = pdas->iterations;
  if (active) *active = pdas->num_active;
  if (changed) *changed = pdas->changed;
  if (safeguarded) *safeguarded = pdas->safeguarded;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASGetLinear(SNES snes, PetscInt *iterations, PetscReal *residual, PetscBool *reduced)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  if (iterations) *iterations = pdas->linear_iterations;
  if (residual) *residual = pdas->residual;
  if (reduced) *reduced = pdas->reduced;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASGetFailure(SNES snes, const char *sentence[])
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  *sentence = "";
  if (pdas->failure)
    *sentence = pdas->failure;
  else if (!pdas->converged)
    *sentence = "the active set still changed after -snes_max_it iterations";
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASSetFriction(SNES snes, const FrictionLaw *law)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  pdas->law = law;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASSetFrictionFixedPoint(SNES snes, PetscBool fixed_point)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  pdas->fixed_point = fixed_point;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASSetFrictionTolerance(SNES snes, PetscReal rtol)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  pdas->friction_rtol = rtol;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASSetFrictionRho(SNES snes, PetscBool needed, const FrictionReport *coarser)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  pdas->rho_skipped = (PetscBool)!needed;
  pdas->coarser     = coarser ? *coarser : (FrictionReport){.rho = 0};
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASSetFrictionYields(SNES snes, PetscBool yields)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  pdas->friction_yields = yields;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASSetFrictionCoupling(SNES snes, PetscBool needed)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  pdas->coupling_needed = needed;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASGetFriction(SNES snes, FrictionReport *report)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  *report = pdas->friction_report;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASGetActive(SNES snes, Vec *active)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  *active = pdas->active;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASSetStart(SNES snes, Vec active)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  if (!pdas->previous) PetscCall(VecDuplicate(active, &pdas->previous));
  PetscCall(VecCopy(active, pdas->previous));
  if (!pdas->start_set) pdas->start = START_PREVIOUS;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Destroys what was kept for the next solve. */
static PetscErrorCode PDASDestroySolver_Private(PDAS *pdas)
{
  PetscFunctionBeginUser;
  if (!pdas->solver) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ActiveSolverDestroy(&pdas->solver));
  PetscCall(ActiveSetDestroy(&pdas->set));
  PetscCall(VecDestroy(&pdas->b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASSetAreas(SNES snes, Vec areas)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  PetscCall(PetscObjectReference((PetscObject)areas));
  PetscCall(VecDestroy(&pdas->areas));
  pdas->areas = areas;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASSetKeep(SNES snes, PetscBool keep)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  pdas->keep = keep;
  if (!keep) PetscCall(PDASDestroySolver_Private(pdas));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASRestart(SNES snes)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  PetscCall(VecDestroy(&pdas->areas));
  PetscCall(VecDestroy(&pdas->previous));
  if (!pdas->start_set) pdas->start = START_PREVIOUS;
  if (pdas->solver && pdas->upper) PetscCall(ActiveSetGather(&pdas->set, pdas->upper, pdas->set.upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASSetErrorReduction(SNES snes, PetscReal error_reduction, PetscReal energy_decrease)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  pdas->error_reduction = error_reduction;
  pdas->energy_decrease = energy_decrease;
  if (pdas->solver) pdas->solver->error_reduction = error_reduction;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Implements SNESVISetVariableBounds(). */
static PetscErrorCode SetVariableBounds_PDAS(SNES snes, Vec lower, Vec upper)
{
  PDAS     *pdas;
  PetscReal max;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  PetscCall(VecMax(lower, NULL, &max));
  PetscCheck(max <= PETSC_NINFINITY, PetscObjectComm((PetscObject)snes), PETSC_ERR_SUP,
             SNESPDAS " accepts upper bounds only");
  PetscCall(PetscObjectReference((PetscObject)lower));
  PetscCall(PetscObjectReference((PetscObject)upper));
  PetscCall(VecDestroy(&pdas->lower));
  PetscCall(VecDestroy(&pdas->upper));
  pdas->lower = lower;
  pdas->upper = upper;
  PetscCall(PDASDestroySolver_Private(pdas));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Forgets the last solve. */
static PetscErrorCode PDASClear_Private(PDAS *pdas)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(pdas->changed, pdas->seen));
  PetscCall(VecDestroy(&pdas->active));
  pdas->iterations = pdas->linear_iterations = pdas->num_seen = pdas->num_active = 0;
  pdas->converged = pdas->safeguarded = PETSC_FALSE;
  pdas->residual                      = 0;
  pdas->failure                       = NULL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Clears the results of the last solve and allocates those of the next. */
static PetscErrorCode PDASReset_Private(SNES snes, PDAS *pdas)
{
  PetscFunctionBeginUser;
  PetscCall(PDASClear_Private(pdas));
  PetscCall(SNESGetTolerances(snes, NULL, NULL, NULL, &pdas->max_it, NULL));
  PetscCall(PetscMalloc2(pdas->max_it, &pdas->changed, pdas->max_it, &pdas->seen));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The matrix, b = -F(0), and r = b - A y = -F(y), from function and Jacobian. */
static PetscErrorCode PDASProblem_Private(SNES snes, Vec y, Mat *A, Vec *b, Vec *r)
{
  Mat P;

  PetscFunctionBeginUser;
  PetscCall(SNESGetJacobian(snes, A, &P, NULL, NULL));
  PetscCall(SNESComputeJacobian(snes, y, *A, P));
  PetscCall(VecDuplicate(y, b));
  PetscCall(VecDuplicate(y, r));
  PetscCall(VecZeroEntries(*r));
  PetscCall(SNESComputeFunction(snes, *r, *b));
  PetscCall(VecScale(*b, -1));
  PetscCall(SNESComputeFunction(snes, y, *r));
  PetscCall(VecScale(*r, -1));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The final set, for PDASGetActive(). */
static PetscErrorCode PDASEnd_Private(PDAS *pdas, const ActiveSet *set, Vec y)
{
  PetscReal *flags;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, &pdas->active));
  PetscCall(VecZeroEntries(pdas->active));
  PetscCall(PetscMalloc1(set->n, &flags));
  for (PetscInt i = 0; i < set->n; i++) flags[i] = set->active[i] ? 1 : 0;
  PetscCall(ActiveSetScatter(set, flags, pdas->active));
  PetscCall(PetscFree(flags));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Creates set and solver, or takes those of the last solve if they were kept. [in] b - taken over; [in] y -
   initial guess; [in] r - its forces */
static PetscErrorCode PDASPrepare_Private(SNES snes, PDAS *pdas, Mat A, Vec b, Vec y, Vec r)
{
  Vec upper;

  PetscFunctionBeginUser;
  if (pdas->solver) {
    PetscCall(PDASBegin(snes, pdas, &pdas->set, y, r));
    PetscCall((*pdas->solver->load)(pdas->solver, b, y));
    PetscCall(VecDestroy(&pdas->b));
  } else {
    PetscCall(VecDuplicate(y, &upper));
    PetscCall(VecSet(upper, PETSC_INFINITY));
    PetscCall(ActiveSetCreateWithTangents(pdas->upper ? pdas->upper : upper, A, pdas->law, &pdas->set));
    PetscCall(VecDestroy(&upper));
    if (pdas->areas) PetscCall(ActiveSetSetAreas(&pdas->set, pdas->areas));
    PetscCall(PDASBegin(snes, pdas, &pdas->set, y, r));
    PetscCall(PDASChooseSolver(snes, pdas, A, b, y));
  }
  pdas->b = b;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Solve_PDAS(SNES snes, Vec y)
{
  PDAS *pdas;
  Mat   A;
  Vec   b, r;

  PetscFunctionBeginUser;
  PetscCall(PDASGet(snes, &pdas));
  PetscCall(PDASReset_Private(snes, pdas));
  PetscCall(PDASProblem_Private(snes, y, &A, &b, &r));
  PetscCall(PDASPrepare_Private(snes, pdas, A, b, y, r));
  if (!pdas->failure && pdas->law)
    PetscCall(FrictionIterate(snes, pdas, pdas->solver, y));
  else if (!pdas->failure)
    PetscCall(PDASIterate(snes, pdas, &pdas->set, pdas->solver, y));
  if (pdas->converged)
    PetscCall(SNESSetConvergedReason(snes, SNES_CONVERGED_FNORM_RELATIVE));
  else
    PetscCall(SNESSetConvergedReason(snes, pdas->failure ? SNES_DIVERGED_LINEAR_SOLVE : SNES_DIVERGED_MAX_IT));
  PetscCall(PDASEnd_Private(pdas, &pdas->set, y));
  pdas->coarser = (FrictionReport){.rho = 0};
  if (!pdas->keep || !pdas->converged) PetscCall(PDASDestroySolver_Private(pdas));
  PetscCall(VecDestroy(&r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the user wants to see the linear solver at work. */
static PetscErrorCode PDASAsksForKSP_Private(SNES snes, PetscBool *asks)
{
  static const char *const views[] = {"-ksp_monitor",          "-ksp_monitor_true_residual", "-ksp_monitor_short",
                                      "-ksp_converged_reason", "-ksp_converged_rate",        "-ksp_view",
                                      "-ksp_view_pre"};
  PetscOptions             options;
  const char              *prefix;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectGetOptions((PetscObject)snes, &options));
  PetscCall(SNESGetOptionsPrefix(snes, &prefix));
  *asks = PETSC_FALSE;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(views) && !*asks; i++)
    PetscCall(PetscOptionsHasName(options, prefix, views[i], asks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads the options of the type; SNESSetFromOptions() calls it for every type. SNESSHELL does not configure
   the KSP. */
static PetscErrorCode PDASSetFromOptions_Private(SNES snes)
{
  PDAS       *pdas;
  KSP         ksp;
  Mat         A, P;
  const char *prefix;
  PetscInt    start;
  PetscBool   is_pdas;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)snes, SNESPDAS, &is_pdas));
  if (!is_pdas) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PDASGet(snes, &pdas));
  PetscCall(SNESGetOptionsPrefix(snes, &prefix));
  start = (PetscInt)pdas->start;
  PetscOptionsBegin(PetscObjectComm((PetscObject)snes), prefix, "Primal-dual active set options", "SNES");
  PetscCall(PetscOptionsReal("-snes_pdas_c", "Constant of the active set test, in units of the local stiffness",
                             "pdas.h", pdas->c, &pdas->c, NULL));
  PetscCall(PetscOptionsEList("-snes_pdas_start", "Initial active set", "pdas.h", PDASStarts, START_COUNT,
                              PDASStarts[start], &start, &pdas->start_set));
  PetscCall(PetscOptionsBool("-snes_pdas_reduce", "One factorization for all active sets; default: where it is cheap",
                             "pdas.h", pdas->reduce, &pdas->reduce, &pdas->reduce_set));
  PetscOptionsEnd();
  if (!pdas->reduce_set) {
    PetscCall(PDASAsksForKSP_Private(snes, &pdas->reduce_set)); // the reduced solver has no KSP to answer
    if (pdas->reduce_set) pdas->reduce = PETSC_FALSE;
  }
  pdas->start = (PDASStart)start;
  PetscCall(PDASDestroySolver_Private(pdas));
  if (!(pdas->c > 0)) {
    PetscCall(UserErrorRaise(PetscObjectComm((PetscObject)snes), "-snes_pdas_c %g: must be a positive number",
                             (double)pdas->c));
  }
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(SNESGetJacobian(snes, &A, &P, NULL, NULL));
  if (A) PetscCall(KSPSetOperators(ksp, A, P));
  PetscCall(KSPSetFromOptions(ksp));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PDASDestroy_Private(ContainerArgument argument)
{
  PDAS *pdas = ContainerArgumentGet(argument);

  PetscFunctionBeginUser;
  PetscCall(PDASClear_Private(pdas));
  PetscCall(PDASDestroySolver_Private(pdas));
  PetscCall(VecDestroy(&pdas->lower));
  PetscCall(VecDestroy(&pdas->upper));
  PetscCall(VecDestroy(&pdas->areas));
  PetscCall(VecDestroy(&pdas->previous));
  PetscCall(PetscFree(pdas));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SNESCreate_PDAS(SNES snes)
{
  PetscContainer container;
  PDAS          *pdas;

  PetscFunctionBeginUser;
  PetscCall(SNESSetType(snes, SNESSHELL));
  PetscCall(SNESShellSetSolve(snes, Solve_PDAS));
  PetscCall(PetscObjectChangeTypeName((PetscObject)snes, SNESPDAS));
  PetscCall(PetscNew(&pdas));
  pdas->c = 1;
  PetscCall(PetscContainerCreate(PetscObjectComm((PetscObject)snes), &container));
  PetscCall(PetscContainerSetPointer(container, pdas));
  PetscCall(PetscContainerSetCtxDestroy(container, PDASDestroy_Private));
  PetscCall(PetscObjectCompose((PetscObject)snes, CONTEXT, (PetscObject)container));
  PetscCall(PetscContainerDestroy(&container));
  PetscCall(PetscObjectComposeFunction((PetscObject)snes, "SNESVISetVariableBounds_C", SetVariableBounds_PDAS));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASRegister(void)
{
  PetscFunctionBeginUser;
  PetscCall(SNESRegister(SNESPDAS, SNESCreate_PDAS));
  PetscCall(MultigridRegister());
  PetscCall(SNESAddOptionsChecker(PDASSetFromOptions_Private));
  PetscFunctionReturn(PETSC_SUCCESS);
}
