/* pdas.c -- the SNES type `pdas`: primal-dual active set method for  min 1/2 y'A y - b'y,  y <= upper.

   Each iteration fixes the active unknowns at their bounds, solves for all others, and moves those with a tensile force out of
   the set and those beyond their bound into it (T10); when none moves, all inequalities hold. It is a semismooth Newton method
   [2] and takes few steps whatever the size; where it cycles (it may, [3]) safeguard.c takes over until the set has settled.

   Only public headers: the type rides on SNESSHELL, its context is composed with the SNES.

   References: [1] Hueber, Wohlmuth, A primal-dual active set strategy for non-linear multibody contact problems, 2005.
               [2] Hintermueller, Ito, Kunisch, The primal-dual active set strategy as a semismooth Newton method, 2002.
               [3] Ben Gharbia, Gilbert, Nonconvergence of the plain Newton-min algorithm for LCPs with a P-matrix, 2012. */
#include <mortise/fault.h>
#include <mortise/pdas.h>
#include "active.h"

/* Contact problems take fewer than ten steps; one that takes so many is wandering. */
static const PetscInt MANY_STEPS = 30;

/* Bounded unknowns up to which a dense factorisation per set (here 9e9 operations, a second, and 144 MB) is cheaper than a
   sparse one. */
static const PetscInt MAX_REDUCED = 3000;

static const char CONTEXT[] = "MortisePDAS"; /* name under which the context is composed */

typedef enum { START_EMPTY, START_FULL, START_GAP, START_PREVIOUS, START_COUNT } PDASStart;
static const char *const PDASStarts[] = {"empty", "full", "gap", "previous"};

typedef struct {
  /* what the user wants */
  PetscReal c;
  PDASStart start;
  PetscBool reduce, reduce_set;
  Vec       lower, upper; /* NULL without bounds */
  Vec       previous;     /* of PDASSetStart(), or NULL */
  /* what happened */
  PetscInt    iterations, max_it, linear_iterations;
  PetscInt   *changed; /* [max_it] */
  uint64_t   *seen;    /* hashes of the sets solved for since the last cure [max_it], the newest last */
  PetscInt    num_seen;
  PetscBool   safeguarded, reduced;
  PetscReal   residual;
  const char *failure;
  Vec         active;
  PetscInt    num_active;
} PDAS;

static PetscErrorCode Get_Private(SNES snes, PDAS **pdas)
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
  PetscCall(Get_Private(snes, &pdas));
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
  PetscCall(Get_Private(snes, &pdas));
  if (iterations) *iterations = pdas->linear_iterations;
  if (residual) *residual = pdas->residual;
  if (reduced) *reduced = pdas->reduced;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASGetFailure(SNES snes, const char *sentence[])
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(Get_Private(snes, &pdas));
  *sentence = pdas->failure ? pdas->failure : "";
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASGetActive(SNES snes, Vec *active)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(Get_Private(snes, &pdas));
  *active = pdas->active;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASSetStart(SNES snes, Vec active)
{
  PDAS *pdas;

  PetscFunctionBeginUser;
  PetscCall(Get_Private(snes, &pdas));
  if (!pdas->previous) PetscCall(VecDuplicate(active, &pdas->previous));
  PetscCall(VecCopy(active, pdas->previous));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Answers SNESVISetVariableBounds(). */
static PetscErrorCode SetVariableBounds_PDAS(SNES snes, Vec lower, Vec upper)
{
  PDAS     *pdas;
  PetscReal max;

  PetscFunctionBeginUser;
  PetscCall(Get_Private(snes, &pdas));
  PetscCall(VecMax(lower, NULL, &max));
  PetscCheck(max <= PETSC_NINFINITY, PetscObjectComm((PetscObject)snes), PETSC_ERR_SUP,
             SNESPDAS " knows upper bounds only");
  PetscCall(PetscObjectReference((PetscObject)lower));
  PetscCall(PetscObjectReference((PetscObject)upper));
  PetscCall(VecDestroy(&pdas->lower));
  PetscCall(VecDestroy(&pdas->upper));
  pdas->lower = lower;
  pdas->upper = upper;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The set to begin with. [in] r - forces b - A y at the initial guess y, for START_PREVIOUS without a set */
static PetscErrorCode Start_Private(PDAS *pdas, ActiveSet *set, Vec y, Vec r)
{
  PetscBool *next;
  PetscReal *guess, *force;
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
        next[i] = (PetscBool)(guess[i] > 0.5);
      else
        next[i] = (PetscBool)(force[i] + pdas->c * set->diag[i] * (guess[i] - set->upper[i]) > 0); /* (T10) */
      break;
    default: next[i] = PETSC_FALSE;
    }
  }
  PetscCall(ActiveSetReplace(set, next, &changed));
  PetscCall(PetscFree3(next, guess, force));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the present set was solved for before; remembers it. */
static PetscErrorCode Seen_Private(PDAS *pdas, const ActiveSet *set, PetscBool *seen)
{
  uint64_t hash;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetHash(set, &hash));
  *seen = PETSC_FALSE;
  for (PetscInt i = 0; i < pdas->num_seen; i++) *seen = (PetscBool)(*seen || pdas->seen[i] == hash);
  pdas->seen[pdas->num_seen++] = hash;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Writes one iteration down and tells the monitors. */
static PetscErrorCode Record_Private(SNES snes, PDAS *pdas, const ActiveSet *set, const ActiveSolution *solution,
                                     PetscInt changed, PetscReal violation)
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

/* From set to set until none changes. [out] y */
static PetscErrorCode Iterate_Private(SNES snes, PDAS *pdas, ActiveSet *set, ActiveSolver solver, Vec y)
{
  ActiveSolution solution;
  Safeguard      guard     = {.on = PETSC_FALSE};
  PetscBool      converged = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolutionCreate(set, &solution));
  while (!converged && !solution.failure && pdas->iterations < pdas->max_it) {
    PetscBool seen      = PETSC_FALSE;
    PetscInt  changed   = 0;
    PetscReal violation = 0;

    if (!guard.on) {
      PetscCall(Seen_Private(pdas, set, &seen));
      if (seen || pdas->num_seen > MANY_STEPS) {
        pdas->safeguarded = PETSC_TRUE;
        PetscCall(SafeguardBegin(&guard, set, solver, &solution));
      }
    }
    if (guard.on && !guard.settled)
      PetscCall(SafeguardStep(&guard, set, solver, &solution, &changed, &violation));
    else {
      guard.settled = PETSC_FALSE; /* unless its set is the one, it goes on from where it was */
      PetscCall(solver->solve(solver, set->active, set->upper, &solution));
      if (!solution.failure) PetscCall(ActiveSetUpdate(set, &solution, pdas->c, &changed, &violation));
      if (!changed && !solution.failure) {
        PetscCall(solver->finish(solver, &solution, y));
        converged = (PetscBool)!solution.failure;
      }
    }
    PetscCall(Record_Private(snes, pdas, set, &solution, changed, violation));
  }
  if (!converged && !solution.failure && pdas->iterations) PetscCall(solver->finish(solver, &solution, y));
  if (guard.on) PetscCall(SafeguardEnd(&guard));
  PetscCall(ActiveSolutionDestroy(&solution));
  if (converged)
    PetscCall(SNESSetConvergedReason(snes, SNES_CONVERGED_FNORM_RELATIVE));
  else
    PetscCall(SNESSetConvergedReason(snes, pdas->failure ? SNES_DIVERGED_LINEAR_SOLVE : SNES_DIVERGED_MAX_IT));
  if (!converged && !pdas->failure) pdas->failure = "the active set had not settled after -snes_max_it iterations";
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Forgets the last solve. */
static PetscErrorCode Reset_Private(PDAS *pdas)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(pdas->changed, pdas->seen));
  PetscCall(VecDestroy(&pdas->active));
  pdas->iterations = pdas->linear_iterations = pdas->num_seen = pdas->num_active = 0;
  pdas->safeguarded                                                              = PETSC_FALSE;
  pdas->residual                                                                 = 0;
  pdas->failure                                                                  = NULL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether one factorisation is to serve all sets: by itself where the KSP is a MUMPS Cholesky solve and nothing else. */
static PetscErrorCode Reducible_Private(const PDAS *pdas, const ActiveSet *set, Vec y, KSP ksp, PetscBool *reduced)
{
  PetscBool     direct, cholesky, mumps = PETSC_FALSE;
  MatSolverType type = NULL;
  PetscInt      size;
  PC            pc;

  PetscFunctionBeginUser;
  PetscCall(VecGetSize(y, &size));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)ksp, KSPPREONLY, &direct));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCCHOLESKY, &cholesky));
  if (cholesky) PetscCall(PCFactorGetMatSolverType(pc, &type));
  if (type) PetscCall(PetscStrcmp(type, MATSOLVERMUMPS, &mumps));
  *reduced = (PetscBool)(direct && mumps && set->N <= MAX_REDUCED);
  if (pdas->reduce_set) *reduced = pdas->reduce;
  /* with no bound there is one system only; with nothing but bounds there is nothing to eliminate */
  if (set->N == 0 || set->N == size) *reduced = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Solve_PDAS(SNES snes, Vec y)
{
  const char  *prefix;
  PDAS        *pdas;
  Mat          A;
  Vec          b, r, upper;
  KSP          ksp;
  PetscReal    rtol, norm;
  ActiveSet    set;
  ActiveSolver solver;

  PetscFunctionBeginUser;
  PetscCall(Get_Private(snes, &pdas));
  PetscCall(Reset_Private(pdas));
  PetscCall(SNESGetTolerances(snes, NULL, &rtol, NULL, &pdas->max_it, NULL));
  PetscCall(PetscMalloc2(pdas->max_it, &pdas->changed, pdas->max_it + 1, &pdas->seen));

  /* function and Jacobian give everything: b = -F(0), r = -F(y) */
  PetscCall(SNESGetJacobian(snes, &A, NULL, NULL, NULL));
  PetscCall(VecDuplicate(y, &b));
  PetscCall(VecDuplicate(y, &r));
  PetscCall(VecDuplicate(y, &upper));
  PetscCall(VecZeroEntries(upper));
  PetscCall(SNESComputeFunction(snes, upper, b));
  PetscCall(VecScale(b, -1));
  PetscCall(SNESComputeFunction(snes, y, r));
  PetscCall(VecScale(r, -1));
  PetscCall(SNESComputeJacobian(snes, y, A, A));
  if (pdas->upper)
    PetscCall(VecCopy(pdas->upper, upper));
  else
    PetscCall(VecSet(upper, PETSC_INFINITY));

  PetscCall(ActiveSetCreate(upper, A, &set));
  PetscCall(Start_Private(pdas, &set, y, r));
  pdas->num_active = set.num_active;
  PetscCall(VecNorm(r, NORM_2, &norm));
  PetscCall(SNESSetIterationNumber(snes, 0));
  PetscCall(SNESSetFunctionNorm(snes, norm));
  PetscCall(SNESMonitor(snes, 0, norm));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(Reducible_Private(pdas, &set, y, ksp, &pdas->reduced));
  if (pdas->reduced) {
    PetscCall(KSPGetOptionsPrefix(ksp, &prefix));
    PetscCall(ReducedCreate(&set, A, b, prefix, rtol, &solver, &pdas->failure));
  } else
    PetscCall(TruncatedCreate(&set, A, b, y, ksp, rtol, &solver));
  if (!pdas->failure)
    PetscCall(Iterate_Private(snes, pdas, &set, solver, y));
  else
    PetscCall(SNESSetConvergedReason(snes, SNES_DIVERGED_LINEAR_SOLVE));

  PetscCall(VecDuplicate(y, &pdas->active));
  PetscCall(VecZeroEntries(pdas->active));
  for (PetscInt i = 0; i < set.n; i++) {
    if (set.active[i]) PetscCall(VecSetValue(pdas->active, set.dof[i], 1, INSERT_VALUES));
  }
  PetscCall(VecAssemblyBegin(pdas->active));
  PetscCall(VecAssemblyEnd(pdas->active));
  PetscCall(ActiveSolverDestroy(&solver));
  PetscCall(ActiveSetDestroy(&set));
  PetscCall(VecDestroy(&upper));
  PetscCall(VecDestroy(&r));
  PetscCall(VecDestroy(&b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads the type's own options; SNESSetFromOptions() calls it for every type. SNESSHELL takes no care of the KSP. */
static PetscErrorCode SetFromOptions_Private(SNES snes)
{
  PDAS       *pdas;
  KSP         ksp;
  Mat         A, P;
  const char *prefix;
  PetscBool   is_pdas;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)snes, SNESPDAS, &is_pdas));
  if (!is_pdas) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(Get_Private(snes, &pdas));
  PetscCall(SNESGetOptionsPrefix(snes, &prefix));
  PetscOptionsBegin(PetscObjectComm((PetscObject)snes), prefix, "Primal-dual active set options", "SNES");
  PetscCall(PetscOptionsReal("-snes_pdas_c", "Constant of the active set test, times the local stiffness", "pdas.h",
                             pdas->c, &pdas->c, NULL));
  PetscCall(PetscOptionsEList("-snes_pdas_start", "Set to begin with", "pdas.h", PDASStarts, START_COUNT,
                              PDASStarts[pdas->start], (PetscInt *)&pdas->start, NULL));
  PetscCall(PetscOptionsBool("-snes_pdas_reduce", "One factorisation for all active sets; by default if that is cheap",
                             "pdas.h", pdas->reduce, &pdas->reduce, &pdas->reduce_set));
  PetscOptionsEnd();
  if (!(pdas->c > 0)) {
    PetscCall(
        FaultRaise(PetscObjectComm((PetscObject)snes), "-snes_pdas_c %g: must be a positive number", (double)pdas->c));
  }
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(SNESGetJacobian(snes, &A, &P, NULL, NULL));
  if (A) PetscCall(KSPSetOperators(ksp, A, P));
  PetscCall(KSPSetFromOptions(ksp));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Private(void *ctx)
{
  PDAS *pdas = ctx;

  PetscFunctionBeginUser;
  PetscCall(Reset_Private(pdas));
  PetscCall(VecDestroy(&pdas->lower));
  PetscCall(VecDestroy(&pdas->upper));
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
  PetscCall(PetscContainerSetUserDestroy(container, Destroy_Private));
  PetscCall(PetscObjectCompose((PetscObject)snes, CONTEXT, (PetscObject)container));
  PetscCall(PetscContainerDestroy(&container));
  PetscCall(PetscObjectComposeFunction((PetscObject)snes, "SNESVISetVariableBounds_C", SetVariableBounds_PDAS));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PDASRegister(void)
{
  PetscFunctionBeginUser;
  PetscCall(SNESRegister(SNESPDAS, SNESCreate_PDAS));
  PetscCall(SNESAddOptionsChecker(SetFromOptions_Private));
  PetscFunctionReturn(PETSC_SUCCESS);
}
