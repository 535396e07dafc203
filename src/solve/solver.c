/* solver.c -- the solve of an inequality, and further solves with its solution. */
#include <string.h>
#include "base/compat.h"
#include "base/log.h"
#include "pdas/pdas.h"
#include "base/warning.h"
#include "solve/solvercontext.h"
#include "pdas/pdasimpl.h"
#include "solve/errorbound.h"
#include "solve/nestediteration.h"
#include "pdas/factorization.h"
#include "solve/linearreference.h"
#include "solve/discretizationstop.h"

/* Solves once; with a proximal term until that is negligible. */
static PetscErrorCode SolverIterateProximal_Private(SolverContext *context, Vec y, SolverReport *report)
{
  PetscBool done = PETSC_FALSE, again;

  PetscFunctionBeginUser;
  while (!done) {
    do {
      PetscCall(SNESSolve(context->snes, NULL, y));
      PetscCall(MumpsMemoryIncrease(context->snes, &again));
    } while (again);
    PetscCall(SolverReportAdd(context->snes, &context->proximal.solved, y, report));
    report->proximal_steps++;
    PetscCall(ProximalCheck(&context->proximal, context->snes, y, report, &done));
    if (context->levels) context->levels->cost.found = PETSC_TRUE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Starts from the solutions of coarser levels. [out] energy_decrease - of NestedIterationStart() */
static PetscErrorCode SolverStartNested_Private(SolverContext *context, Vec y, PetscReal *energy_decrease)
{
  PetscBool pdas, found;
  Vec       active;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)context->snes, SNESPDAS, &pdas));
  PetscCall(VecDuplicate(y, &active));
  PetscCall(
      NestedIterationStart(context->levels, context->snes, &context->proximal, y, active, energy_decrease, &found));
  if (pdas && found) PetscCall(PDASSetStart(context->snes, active));
  PetscCall(VecDestroy(&active));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Starts from the solution of the mesh before this one was refined, or of the load step before.
   [in] kept - of NestedIterationPredict() */
static PetscErrorCode SolverStartExtended_Private(SolverContext *context, PetscBool kept, Vec y)
{
  PetscBool found;
  Vec       active;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, &active));
  PetscCall(
      NestedIterationPredict(context->levels, context->snes, context->proximal.solved.vi, kept, y, active, &found));
  if (found) PetscCall(PDASSetStart(context->snes, active));
  PetscCall(VecDestroy(&active));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the finest level is smoothed by lines and planes. Then the factors of each further set cost more
   than cycles that predict the set of a load step. */
static PetscBool SolverHasBlocks_Private(const MeshLevels levels)
{
  return (PetscBool)(levels && levels->hierarchy->level[levels->hierarchy->num - 1].S);
}

/* If an iteration costs too much, its contacts are the initial set of the factorization that replaces it. */
static PetscErrorCode SolverLeaveSet_Private(Solver solver, const SolverContext *context, const SolverReport *report)
{
  Vec active;

  PetscFunctionBeginUser;
  if (report->converged || strcmp(report->reason, FAILURE_COST)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PDASGetActive(context->snes, &active));
  PetscCall(VecDuplicate(active, &solver->left));
  PetscCall(VecCopy(active, solver->left));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SolverTakeSet_Private(Solver solver, const SolverContext *context)
{
  PetscFunctionBeginUser;
  if (!solver->left) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PDASSetStart(context->snes, solver->left));
  PetscCall(VecDestroy(&solver->left));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverCreate(VI vi, Solvability solvability, Solver *solver)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(solver));
  (*solver)->vi          = vi;
  (*solver)->solvability = solvability;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverDestroy(Solver *solver)
{
  PetscFunctionBeginUser;
  if (!*solver) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SolverContextForget(*solver));
  PetscCall(MeshLevelsDestroy(&(*solver)->levels));
  PetscCall(MeshLevelsDestroy(&(*solver)->older));
  PetscCall(VecDestroy(&(*solver)->left));
  PetscCall(PetscFree(*solver));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverExtend(Solver solver, Solver older, VI *vi)
{
  PetscFunctionBeginUser;
  PetscCall(SolverContextForget(older)); // gives its levels back
  solver->older    = older->levels;
  older->levels    = NULL;
  solver->extended = PETSC_TRUE;
  if (!solver->older) PetscFunctionReturn(PETSC_SUCCESS);
  solver->older->own_finest = PETSC_TRUE;
  *vi                       = NULL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverUpdate(Solver solver)
{
  PetscFunctionBeginUser;
  if (solver->vi->scene->stop == STOP_DISCRETISATION)
    PetscCall(MeshLevelsDestroy(&solver->levels)); // coarser levels have loads of their own
  if (!solver->context) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ProximalUpdate(&solver->context->proximal));
  PetscCall(PDASRestart(solver->context->snes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Begins at coarser levels, at the solution before, or with the set of an iteration that this one replaces.
   [in] nested - whether at coarser levels; [in] guessed - whether y is a solution before;
   [out] energy_decrease - of NestedIterationStart(), or 0 */
static PetscErrorCode SolverStart_Private(SolverContext *context, PetscBool nested, PetscBool guessed, Vec y,
                                          PetscReal *energy_decrease)
{
  const Solver    solver   = context->solver;
  const PetscBool extended = solver->extended;
  const PetscBool pdas     = (PetscBool)!strcmp(context->choice.snes, SNESPDAS);
  const PetscBool resumes  = (PetscBool)(context->used && SolverHasBlocks_Private(context->levels));

  PetscFunctionBeginUser;
  *energy_decrease = 0;
  context->used    = PETSC_TRUE;
  solver->extended = PETSC_FALSE;
  if (context->levels && nested) PetscCall(SolverStartNested_Private(context, y, energy_decrease));
  if (context->levels && !nested && guessed && pdas && (extended || resumes) && !solver->vi->friction)
    PetscCall(SolverStartExtended_Private(context, (PetscBool)!extended, y));
  if (pdas) PetscCall(SolverTakeSet_Private(solver, context));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What is measured at a solution, and where it stops by such a measure, the iterations that are left. */
static PetscErrorCode SolverMeasure_Private(SolverContext *context, const SolverChoice *choice, Vec y,
                                            SolverReport *report)
{
  PetscFunctionBeginUser;
  report->bound.value = report->discretisation = NAN;
  if (choice->bound && strcmp(choice->snes, SNESPDAS)) PetscCall(SolverContextSetLevels(context, NULL));
  if (choice->bound) PetscCall(ErrorBoundCompute(&context->proximal, context->snes, y, &report->bound));
  if (choice->stop) PetscCall(DiscretizationStopConfirm(context, y, report));
  if (context->levels) {
    report->work           = context->levels->hierarchy->work;
    report->predicted_cost = CostModelPredicted(&context->levels->cost);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Friction that lets bodies slide is no solution of theirs. */
static PetscErrorCode SolverRefuseSliding_Private(const Solvability solvability, SolverReport *report)
{
  PetscFunctionBeginUser;
  if (!report->converged && !report->slid) PetscFunctionReturn(PETSC_SUCCESS);
  if (!solvability || !solvability->driven.num) PetscFunctionReturn(PETSC_SUCCESS);
  report->converged = PETSC_FALSE;
  PetscCall(PetscSNPrintf(report->reason, sizeof(report->reason),
                          "friction holds the loads no longer, smaller -load_steps may tell from when on: %s, and "
                          "nothing resists",
                          solvability->driven.sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverRun(Solver solver, const SolverChoice *choice, PetscBool progress, Vec guess, Vec y,
                         SolverReport *report)
{
  const Solvability solvability = solver->solvability;
  const PetscBool   pdas        = (PetscBool)!strcmp(choice->snes, SNESPDAS);
  const PetscBool   nested      = (PetscBool)(choice->nested && (!guess || choice->stop) && (!solvability || pdas));
  PetscReal         energy_decrease;
  SolverContext    *context;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(report, sizeof(*report)));
  PetscCall(SolverContextTake(solver, choice, (PetscBool)(solvability || guess || nested), &context));
  if (!context->levels) PetscCall(SolverContextSetLevels(context, NULL));
  if (progress && !context->used) PetscCall(ProgressSet(context->snes, &context->proximal.solved));
  PetscCall(InitialGuessSet(&context->proximal.solved, solvability, choice, context->snes, guess, y));
  if (!pdas) PetscCall(SolverContextSetLevels(context, context->snes));
  PetscCall(ProximalSetStart(&context->proximal, guess ? y : NULL, context->snes, pdas));
  if (pdas && (choice->bound || solvability || choice->again)) PetscCall(PDASSetKeep(context->snes, PETSC_TRUE));
  if (context->levels) context->levels->cost.on = choice->yields;
  PetscCall(SolverStart_Private(context, nested, (PetscBool)(guess != NULL), y, &energy_decrease));
  if (choice->stop) PetscCall(DiscretizationStopSet(context, energy_decrease));
  PetscCall(SolverIterateProximal_Private(context, y, report));
  if (report->slid && report->friction.rho < 1)
    PetscCall(ProximalTestSliding(&context->proximal, &report->friction, y));
  if (pdas && !solvability) PetscCall(SolverLeaveSet_Private(solver, context, report));
  PetscCall(SolverMeasure_Private(context, choice, y, report));
  PetscCall(SolverContextReturn(&context, (PetscBool)(choice->again && pdas && report->converged), y));
  PetscCall(MinimumNormApply(solver->vi, solvability, y));
  PetscCall(SolverRefuseSliding_Private(solvability, report));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Falls back to a factorization if an iteration failed or cost too much. If that fails and the iteration was
   only slow, iterates to the end. */
static PetscErrorCode SolverFallBack_Private(Solver solver, const SolverChoice *choice, PetscBool progress, Vec guess,
                                             Vec y, SolverReport *report)
{
  SolverChoice other = *choice;
  PetscBool    again, slow = (PetscBool)!strcmp(report->reason, FAILURE_COST);

  PetscFunctionBeginUser;
  PetscCall(SolverChoiceSetFallback(report, &other, &again));
  if (!again) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SolverRun(solver, &other, progress, guess, y, report));
  report->gave_way = PETSC_TRUE;
  if (report->converged) solver->choice = other;
  if (!slow || report->converged) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(WarningAdd(&(Warning){.code = "solver_replaced", .advice = "-pc_type truncatedmg avoids the factorization"},
                       "the factorization that replaced the iteration failed; the iteration continues to its end"));
  other        = *choice;
  other.yields = PETSC_FALSE;
  PetscCall(SolverRun(solver, &other, progress, guess, y, report));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Names the motion of bodies that friction hardly holds, which is why the solver failed. */
static PetscErrorCode SolverExplain_Private(Solver solver, SolverReport *report)
{
  const Solvability s = solver->solvability;

  PetscFunctionBeginUser;
  if (!s || s->driven.num || s->status == SOLVABLE_NOT) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SolvabilityFindHardlyHeld(solver->vi, s));
  if (s->driven.num) {
    PetscCall(PetscSNPrintf(report->reason, sizeof(report->reason),
                            "friction holds the loads hardly, or not at all: with 2%% less of it %s",
                            s->driven.sentence));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverSolve(Solver solver, Vec guess, Vec y, SolverReport *report)
{
  const Scene    scene = solver->vi->scene;
  const MPI_Comm comm  = PetscObjectComm((PetscObject)solver->vi->A);
  const Warning  slow  = {.code = "slow_solver", .advice = "-pc_type cholesky needs no iterations"};
  const double   start = LogWallClock();
  SolverChoice   choice;
  PetscBool      progress;

  PetscFunctionBeginUser;
  if (!solver->chosen) PetscCall(SolverChoiceSet(solver, &solver->choice));
  choice = solver->choice;
  if (choice.nearly && !SolverChoiceFactors(choice.pc)) {
    PetscCall(
        WarningAdd(&slow, "-pc_type %s may need thousands of iterations for a nearly incompressible body", choice.pc));
  }
  PetscCall(ProgressWanted(scene, &progress));
  choice.keep  = (PetscBool)(scene->cross_check || (scene->keep && !choice.stop) || scene->adapt.on);
  choice.again = (PetscBool)(((scene->keep && !choice.stop) || scene->adapt.num_goals) &&
                             (!scene->cross_check || SolverChoiceFactors(choice.pc)));
  PetscCall(SolverRun(solver, &choice, progress, guess, y, report));
  report->gave_way = solver->gave_way;
  if (!report->converged) PetscCall(MeshLevelsDestroy(&solver->levels));
  if (!solver->solvability || solver->solvability->status != SOLVABLE_NOT)
    PetscCall(SolverFallBack_Private(solver, &choice, progress, guess, y, report));
  if (!report->converged) PetscCall(SolverExplain_Private(solver, report));
  solver->chosen   = scene->keep;
  solver->gave_way = report->gave_way;
  report->seconds  = LogWallClock() - start;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &report->seconds, 1, MPIU_REAL, MPI_MAX, comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverSubtractRigid(Solvability solvability, Vec y, Vec *own)
{
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, own));
  PetscCall(VecCopy(y, *own));
  if (solvability) PetscCall(VecAXPY(*own, -1, solvability->approach));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverCreateContext(Solver solver, const SolverReport *report, SolverContext *context)
{
  SolverChoice choice;

  PetscFunctionBeginUser;
  PetscCall(SolverChoiceSet(solver, &choice));
  if (report) { // a fallback may have replaced the choice
    choice.replaces = report->gave_way;
    PetscCall(PetscStrncpy(choice.ksp, report->ksp, sizeof(choice.ksp)));
    PetscCall(PetscStrncpy(choice.pc, report->pc, sizeof(choice.pc)));
  }
  PetscCall(SolverContextCreate(solver, &choice, PETSC_FALSE, context));
  PetscCall(SolverContextSetLevels(context, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverSolveLinear(Solver solver, Vec y, SolverReport *report)
{
  const MPI_Comm   comm      = PetscObjectComm((PetscObject)solver->vi->A);
  LinearReference *reference = &report->reference;
  SolverContext    context;
  Vec              own;
  double           start;

  PetscFunctionBeginUser;
  PetscCall(SolverSubtractRigid(solver->solvability, y, &own));
  PetscCallMPI(MPI_Barrier(comm));
  LogCount(PETSC_FALSE);
  start = LogWallClock();
  PetscCall(SolverCreateContext(solver, report, &context));
  PetscCall(LinearReferenceSolve(&context.proximal, context.snes, own, &reference->iterations, &reference->done));
  reference->seconds = LogWallClock() - start;
  LogCount(PETSC_TRUE);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &reference->seconds, 1, MPIU_REAL, MPI_MAX, comm));
  reference->work = context.levels ? context.levels->hierarchy->work : 0;
  PetscCall(SolverContextDestroy(&context, own));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}
