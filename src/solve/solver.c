/* solver.c -- an inequality solved, and what is asked of its solution afterwards. */
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
#include "multigrid/multigrid.h"
#include "solve/linearreference.h"
#include "solve/discretizationstop.h"

/* Solves once, and where springs hold bodies again and again until they have nothing left to do. */
static PetscErrorCode Sweep_Private(Workbench *bench, Vec y, SolveReport *report)
{
  PetscBool done = PETSC_FALSE, again;

  PetscFunctionBeginUser;
  while (!done) {
    do {
      PetscCall(SNESSolve(bench->snes, NULL, y));
      PetscCall(FactorMoreRoom(bench->snes, &again));
    } while (again);
    PetscCall(SolveReportAdd(bench->snes, &bench->springs.solved, y, report));
    report->sweeps++;
    PetscCall(SpringsRelax(&bench->springs, bench->snes, y, report, &done));
    if (bench->levels) bench->levels->cost.found = PETSC_TRUE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Begins with what coarser levels find, by the same method. [out] gained - as of CascadeStart() */
static PetscErrorCode Cascade_Private(Workbench *bench, Vec y, PetscReal *gained)
{
  PetscBool pdas, found;
  Vec       active;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)bench->snes, SNESPDAS, &pdas));
  PetscCall(VecDuplicate(y, &active));
  PetscCall(CascadeStart(bench->levels, bench->snes, &bench->springs, y, active, gained, &found));
  if (pdas && found) PetscCall(PDASSetStart(bench->snes, active));
  PetscCall(VecDestroy(&active));
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
  PetscCall(MeshLevelsDestroy(&(*solver)->levels));
  PetscCall(PetscFree(*solver));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolveRun(Solver solver, const SolveChoice *choice, PetscBool progress, Vec guess, Vec y,
                        SolveReport *report)
{
  const Solvability solvability = solver->solvability;
  const PetscBool   pdas        = (PetscBool)!strcmp(choice->snes, SNESPDAS);
  const PetscBool   nested      = (PetscBool)(choice->nested && (!guess || choice->stop) && (!solvability || pdas));
  PetscReal         gained      = 0;
  Workbench         bench;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(report, sizeof(*report)));
  PetscCall(WorkbenchCreate(solver, choice, (PetscBool)(solvability || guess || nested), &bench));
  PetscCall(WorkbenchSetLevels(&bench, NULL));
  if (progress) PetscCall(ProgressSet(bench.snes, &bench.springs.solved));
  PetscCall(SolveStart(&bench.springs.solved, solvability, choice, bench.snes, guess, y));
  if (!pdas) PetscCall(WorkbenchSetLevels(&bench, bench.snes));
  PetscCall(SpringsSet(&bench.springs, guess ? y : NULL, bench.snes, pdas));
  if (pdas && (choice->bound || solvability)) PetscCall(PDASSetKeep(bench.snes, PETSC_TRUE));
  if (bench.levels) bench.levels->cost.on = choice->yields;
  if (bench.levels && nested) PetscCall(Cascade_Private(&bench, y, &gained));
  if (choice->stop) PetscCall(StopSet(&bench, gained));
  PetscCall(Sweep_Private(&bench, y, report));
  report->bound.value = report->discretisation = NAN;
  if (choice->bound && !pdas) PetscCall(WorkbenchSetLevels(&bench, NULL));
  if (choice->bound) PetscCall(BoundCompute(&bench.springs, bench.snes, y, &report->bound));
  if (choice->stop) PetscCall(StopConfirm(&bench, y, report));
  if (bench.levels) {
    report->work     = bench.levels->hierarchy->work;
    report->foretold = CostModelPredicted(&bench.levels->cost);
  }
  PetscCall(WorkbenchDestroy(&bench, y));
  PetscCall(MinimumNormApply(solver->vi, solvability, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A factorisation where an iteration has failed or cost too much; and if that fails, the iteration to its end where it was but slow. */
static PetscErrorCode Otherwise_Private(Solver solver, const SolveChoice *choice, PetscBool progress, Vec guess, Vec y,
                                        SolveReport *report)
{
  SolveChoice other = *choice;
  PetscBool   again, slow = (PetscBool)!strcmp(report->reason, FAILURE_COST);

  PetscFunctionBeginUser;
  PetscCall(SolveChooseAnother(report, &other, &again));
  if (!again) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SolveRun(solver, &other, progress, guess, y, report));
  report->gave_way = PETSC_TRUE;
  if (!slow || report->converged) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(WarningAdd(&(Warning){.code = "solver_replaced", .advice = "-pc_type truncatedmg does that at once"},
                       "the factorisation that took the place of an iteration has failed; iterating to the end"));
  other        = *choice;
  other.yields = PETSC_FALSE;
  PetscCall(SolveRun(solver, &other, progress, guess, y, report));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverSolve(Solver solver, Vec guess, Vec y, SolveReport *report)
{
  const Scene    scene = solver->vi->scene;
  const MPI_Comm comm  = PetscObjectComm((PetscObject)solver->vi->A);
  const Warning  slow  = {.code = "slow_solver", .advice = "-pc_type cholesky takes none"};
  const double   start = LogWallClock();
  SolveChoice    choice;
  PetscBool      progress;

  PetscFunctionBeginUser;
  PetscCall(SolveChoose(solver, &choice));
  if (choice.nearly && !SolveFactors(choice.pc)) {
    PetscCall(WarningAdd(
        &slow, "-pc_type %s may take thousands of iterations for a body that is so nearly incompressible", choice.pc));
  }
  PetscCall(ProgressWanted(scene, &progress));
  choice.keep = scene->cross_check;
  PetscCall(SolveRun(solver, &choice, progress, guess, y, report));
  if (!report->converged) PetscCall(MeshLevelsDestroy(&solver->levels));
  PetscCall(Otherwise_Private(solver, &choice, progress, guess, y, report));
  report->seconds = LogWallClock() - start;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &report->seconds, 1, MPIU_REAL, MPI_MAX, comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y without what SolverSolve() adds to the solution of the inequality. [out] own - to be destroyed by the caller */
static PetscErrorCode Unsettle_Private(Solvability solvability, Vec y, Vec *own)
{
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, own));
  PetscCall(VecCopy(y, *own));
  if (solvability) PetscCall(VecAXPY(*own, -1, solvability->approach));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All that the solution took once more, for what is asked when it is known. [in] report - of it, or NULL if it is anybody's */
static PetscErrorCode Again_Private(Solver solver, const SolveReport *report, Workbench *bench)
{
  SolveChoice choice;

  PetscFunctionBeginUser;
  PetscCall(SolveChoose(solver, &choice));
  if (report) { // what was chosen may have given way to something else
    PetscCall(PetscStrncpy(choice.ksp, report->ksp, sizeof(choice.ksp)));
    PetscCall(PetscStrncpy(choice.pc, report->pc, sizeof(choice.pc)));
  }
  PetscCall(WorkbenchCreate(solver, &choice, PETSC_FALSE, bench));
  PetscCall(WorkbenchSetLevels(bench, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverBoundError(Solver solver, Vec y, EnergyBound *bound)
{
  Workbench bench;
  Vec       own;

  PetscFunctionBeginUser;
  PetscCall(Unsettle_Private(solver->solvability, y, &own));
  PetscCall(Again_Private(solver, NULL, &bench));
  PetscCall(BoundCompute(&bench.springs, bench.snes, own, bound));
  PetscCall(WorkbenchDestroy(&bench, own));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverSolveLinear(Solver solver, Vec y, SolveReport *report)
{
  const MPI_Comm   comm      = PetscObjectComm((PetscObject)solver->vi->A);
  LinearReference *reference = &report->reference;
  Workbench        bench;
  Vec              own;
  double           start;

  PetscFunctionBeginUser;
  PetscCall(Unsettle_Private(solver->solvability, y, &own));
  PetscCallMPI(MPI_Barrier(comm));
  LogCount(PETSC_FALSE);
  start = LogWallClock();
  PetscCall(Again_Private(solver, report, &bench));
  PetscCall(ReferenceSolve(&bench.springs, bench.snes, own, &reference->iterations, &reference->done));
  reference->seconds = LogWallClock() - start;
  LogCount(PETSC_TRUE);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &reference->seconds, 1, MPIU_REAL, MPI_MAX, comm));
  reference->work = bench.levels ? bench.levels->hierarchy->work : 0;
  PetscCall(WorkbenchDestroy(&bench, own));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}
