/* dualsolve.c -- linear problems with the matrix of an inequality and its final active set. */
#include "base/compat.h"
#include "base/log.h"
#include "pdas/pdasimpl.h"
#include "solve/dualsolve.h"
#include "solve/linearreference.h"
#include "solve/solvercontext.h"

/* Relative residual: weights of errors need few digits. With a proximal term each step removes the part of W
   from the residual. */
static const PetscReal DUAL_RTOL = 1e-6;
enum { MAX_PROXIMAL = 8 };

/* The solver and its data. */
typedef struct {
  VI           vi;
  ActiveSolver solver;
  PetscReal   *zero; /* [set->n] */
} Dual;

/* d = A_FF^-1 r with the solver's own matrix. [in,out] solved - false after a failure */
static PetscErrorCode DualCorrect_Private(Dual *dual, Vec r, Vec d, PetscBool *solved)
{
  const ActiveSolver solver = dual->solver;
  const ActiveSet   *set    = solver->set;
  ActiveSolution     solution;

  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(d));
  PetscCall((*solver->load)(solver, r, d));
  PetscCall(ActiveSolutionCreate(set, &solution));
  PetscCall((*solver->solve)(solver, set->active, dual->zero, &solution));
  if (!solution.failure) PetscCall((*solver->finish)(solver, &solution, d));
  if (solution.failure) {
    PetscCall(PetscInfo(dual->vi->A, "dual problem: %s\n", solution.failure));
    *solved = PETSC_FALSE;
  }
  PetscCall(ActiveSolutionDestroy(&solution));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* r = b - A z in F, with the matrix without proximal term. [out] size - |r| */
static PetscErrorCode DualGetResidual_Private(Dual *dual, Vec b, Vec z, Vec r, PetscReal *size)
{
  const ActiveSet *set = dual->solver->set;
  PetscReal       *values;

  PetscFunctionBeginUser;
  PetscCall(MatMult(dual->vi->A, z, r));
  PetscCall(VecAYPX(r, -1, b));
  PetscCall(PetscMalloc1(set->n, &values));
  PetscCall(ActiveSetGather(set, r, values));
  for (PetscInt i = 0; i < set->n; i++) {
    if (set->active[i]) values[i] = 0;
  }
  PetscCall(ActiveSetScatter(set, values, r));
  PetscCall(PetscFree(values));
  PetscCall(VecNorm(r, NORM_2, size));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One right-hand side. */
static PetscErrorCode DualSolveOne_Private(Dual *dual, Vec b, Vec z, PetscBool *solved)
{
  Vec       r, d;
  PetscReal first, left;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(b, &r));
  PetscCall(VecDuplicate(b, &d));
  PetscCall(VecZeroEntries(z));
  PetscCall(DualGetResidual_Private(dual, b, z, r, &first));
  left = first;
  for (PetscInt k = 0; k < MAX_PROXIMAL && left > DUAL_RTOL * first && *solved; k++) {
    PetscCall(DualCorrect_Private(dual, r, d, solved));
    if (!*solved) break;
    PetscCall(VecAXPY(z, 1, d));
    if (dual->solver->A == dual->vi->A) break;
    PetscCall(DualGetResidual_Private(dual, b, z, r, &left));
  }
  PetscCall(VecDestroy(&r));
  PetscCall(VecDestroy(&d));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All of them. A solver that iterates needs less accuracy than for an inequality, and has its own
   afterwards. */
static PetscErrorCode DualSolveAll_Private(VI vi, ActiveSolver solver, PetscInt num, const Vec b[], Vec z[],
                                           PetscBool *solved)
{
  const struct _n_ActiveSolver before = *solver;
  Dual                         dual   = {.vi = vi, .solver = solver};

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(solver->set->n, &dual.zero));
  if (!solver->factored) {
    solver->rtol            = 0; // only the residual counts
    solver->target          = DUAL_RTOL;
    solver->holds           = NULL;
    solver->error_reduction = 0;
  }
  for (PetscInt i = 0; i < num; i++) PetscCall(DualSolveOne_Private(&dual, b[i], z[i], solved));
  solver->rtol            = before.rtol;
  solver->target          = before.target;
  solver->holds           = before.holds;
  solver->error_reduction = before.error_reduction;
  solver->b               = before.b;
  PetscCall(PetscFree(dual.zero));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nothing replaces an iteration here that costs more than a factorization. */
static void DualForbidReplacement_Private(SolverContext *context)
{
  if (context->levels) context->levels->cost.on = PETSC_FALSE;
}

/* With a new solver for the set of y. */
static PetscErrorCode DualSolveAnew_Private(SolverContext *context, Vec y, PetscInt num, const Vec b[], Vec z[],
                                            PetscBool *solved)
{
  const Inequality *inequality = &context->proximal.solved;
  ActiveSolver      solver;
  ActiveSet         set;
  const char       *failure;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetCreateWithTangents(inequality->upper, inequality->A, inequality->vi->friction, &set));
  PetscCall(LinearReferenceSetActive(inequality->vi, y, &set));
  PetscCall(PDASCreateSolver(context->snes, &set, inequality->A, inequality->b, DUAL_RTOL, &solver, &failure));
  *solved = (PetscBool)!failure;
  if (!failure) PetscCall(DualSolveAll_Private(inequality->vi, solver, num, b, z, solved));
  PetscCall(ActiveSolverDestroy(&solver));
  PetscCall(ActiveSetDestroy(&set));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode DualSolve(Solver solver, const SolverReport *report, Vec y, PetscInt num, const Vec b[], Vec z[],
                         PetscBool *solved)
{
  ActiveSolver  kept = NULL;
  SolverContext context;
  Vec           own;

  PetscFunctionBeginUser;
  *solved = PETSC_TRUE;
  PetscCall(LogStageBegin(STAGE_SOLVE));
  if (solver->context) PetscCall(PDASGetSolver(solver->context->snes, &kept));
  if (kept) {
    DualForbidReplacement_Private(solver->context);
    PetscCall(DualSolveAll_Private(solver->vi, kept, num, b, z, solved));
  } else {
    PetscCall(SolverCreateContext(solver, report, &context));
    context.keep = solver->vi->scene->adapt.on; // the next mesh extends its levels
    DualForbidReplacement_Private(&context);
    PetscCall(SolverSubtractRigid(solver->solvability, y, &own));
    PetscCall(DualSolveAnew_Private(&context, own, num, b, z, solved));
    PetscCall(SolverContextDestroy(&context, own));
    PetscCall(VecDestroy(&own));
  }
  PetscCall(LogStageEnd(STAGE_SOLVE));
  PetscFunctionReturn(PETSC_SUCCESS);
}
