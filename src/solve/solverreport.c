/* solverreport.c -- the results of a SNES in numbers and words. */
#include "base/compat.h"
#include "pdas/pdas.h"
#include "pdas/pdasimpl.h"
#include "pdas/factorization.h"
#include "solve/solverimpl.h"

PetscErrorCode SolverReportMeasure(const Inequality *solved, Vec y, PetscInt *active, PetscReal *residual)
{
  ActiveSet    set;
  ActiveSolver solver;
  Vec          v, r, f;
  PetscReal   *values, *forces, reference, size;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetCreate(solved->upper, solved->A, &set));
  PetscCall(ActiveSolverCreate(&set, solved->A, solved->b, 0, &solver));
  PetscCall(PetscMalloc2(set.n, &values, set.n, &forces));
  PetscCall(VecDuplicate(solved->b, &v));
  PetscCall(VecDuplicate(solved->b, &r));
  PetscCall(VecDuplicate(solved->b, &f));
  PetscCall(ActiveSolverResidual(solver, set.active, y, r, f, &size));
  PetscCall(ActiveSetGather(&set, y, values));
  PetscCall(ActiveSetGather(&set, r, forces));
  *active = 0;
  for (PetscInt i = 0; i < set.n; i++) {
    set.active[i] = (PetscBool)(values[i] >= set.upper[i] && forces[i] > 0);
    *active += set.active[i] ? 1 : 0;
    if (!set.active[i]) values[i] = 0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, active, 1, MPIU_INT, MPI_SUM, set.comm));
  PetscCall(VecZeroEntries(v));
  PetscCall(ActiveSetScatter(&set, values, v));
  PetscCall(ActiveSolverResidual(solver, set.active, v, r, f, &reference));
  PetscCall(ActiveSolverResidual(solver, set.active, y, r, f, &size));
  *residual = reference > 0 ? size / reference : 0;
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&r));
  PetscCall(VecDestroy(&f));
  PetscCall(PetscFree2(values, forces));
  PetscCall(ActiveSolverDestroy(&solver));
  PetscCall(ActiveSetDestroy(&set));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The reason why a type of PETSc did not converge. */
static PetscErrorCode SolverReportReasonOther_Private(SNES snes, SNESConvergedReason reason, SolverReport *report)
{
  const char *prefix;

  PetscFunctionBeginUser;
  PetscCall(SNESGetOptionsPrefix(snes, &prefix));
  if (reason == SNES_DIVERGED_LINEAR_SOLVE) {
    KSP            ksp;
    PC             pc;
    PCFailedReason failed;

    PetscCall(SNESGetKSP(snes, &ksp));
    PetscCall(MumpsMemoryCheck(ksp));
    PetscCall(KSPGetPC(ksp, &pc));
    PetscCall(PCGetFailedReason(pc, &failed));
    PetscCall(PetscStrncpy(report->reason,
                           failed ? ActiveSolverFailureOfFactor((MatFactorError)failed) : FAILURE_ITERATIVE,
                           sizeof(report->reason)));
  } else if (reason == SNES_DIVERGED_MAX_IT) {
    PetscCall(PetscSNPrintf(report->reason, sizeof(report->reason),
                            "%s did not converge in %" PetscInt_FMT " iterations (-%ssnes_max_it)", report->type,
                            report->iterations, prefix ? prefix : ""));
  } else {
    PetscCall(PetscSNPrintf(report->reason, sizeof(report->reason), "%s stopped with PETSc's %s", report->type,
                            SNESConvergedReasons[reason]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The active sets of pdas. [in] iterations - of this solve; [out] reduced - whether by one factorization for
   all sets */
static PetscErrorCode SolverReportAddSets_Private(SNES snes, PetscInt iterations, SolverReport *report,
                                                  PetscBool *reduced)
{
  PetscBool       safeguarded;
  PetscInt        linear;
  const PetscInt *changed;
  const char     *failure;

  PetscFunctionBeginUser;
  PetscCall(PDASGetHistory(snes, NULL, &report->active, &changed, &safeguarded));
  PetscCall(PDASGetLinear(snes, &linear, &report->linear_residual, reduced));
  report->safeguarded = (PetscBool)(report->safeguarded || safeguarded);
  report->linear_iterations += linear;
  PetscCall(PDASGetFriction(snes, &report->friction));
  PetscCall(PDASGetFailure(snes, &failure));
  PetscCall(PetscStrncpy(report->reason, failure, sizeof(report->reason)));
  for (PetscInt k = 0; k < iterations && report->num_changed < SOLVER_MAX_HISTORY; k++)
    report->changed[report->num_changed++] = changed[k];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The linear solver in words. [in] reduced - of SolverReportAddSets_Private(): the KSP was not used then;
   [in] friction - whether multigrid preconditions systems that are not symmetric */
static PetscErrorCode SolverReportDescribeLinear_Private(SNES snes, PetscBool reduced, PetscBool friction,
                                                         SolverReport *report)
{
  KSPType       ksp_type;
  PCType        pc_type;
  KSP           ksp;
  PC            pc;
  MatSolverType package = NULL;
  char          words[96];

  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(KSPGetType(ksp, &ksp_type));
  PetscCall(PCGetType(pc, &pc_type));
  if (SolverChoiceFactors(pc_type)) PetscCall(PCFactorGetMatSolverType(pc, &package));
  if (reduced) {
    ksp_type = KSPPREONLY;
    pc_type  = PCCHOLESKY;
    package  = MATSOLVERMUMPS;
  }
  PetscCall(PetscStrncpy(report->ksp, ksp_type, sizeof(report->ksp)));
  PetscCall(PetscStrncpy(report->pc, pc_type, sizeof(report->pc)));
  if (friction && !reduced) ksp_type = KSPGMRES;
  PetscCall(SolverChoiceDescribe(ksp_type, pc_type, package, words, sizeof(words)));
  PetscCall(
      PetscSNPrintf(report->linear, sizeof(report->linear), "%s%s", words, reduced ? ", one for all active sets" : ""));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolverReportAdd(SNES snes, const Inequality *solved, Vec y, SolverReport *report)
{
  SNESConvergedReason reason;
  SNESType            type;
  PetscBool           pdas, reduced = PETSC_FALSE;
  PetscInt            iterations, linear;

  PetscFunctionBeginUser;
  PetscCall(SNESGetType(snes, &type));
  PetscCall(PetscStrcmp(type, SNESPDAS, &pdas));
  PetscCall(PetscStrncpy(report->type, type, sizeof(report->type)));
  PetscCall(SNESGetConvergedReason(snes, &reason));
  PetscCall(SNESGetIterationNumber(snes, &iterations));
  report->iterations += iterations;
  report->converged = (PetscBool)(reason > 0);
  if (pdas) {
    PetscCall(SolverReportAddSets_Private(snes, iterations, report, &reduced));
  } else {
    PetscCall(SNESGetLinearSolveIterations(snes, &linear));
    report->linear_iterations += linear;
    PetscCall(SolverReportMeasure(solved, y, &report->active, &report->linear_residual));
    if (!report->converged) PetscCall(SolverReportReasonOther_Private(snes, reason, report));
  }
  PetscCall(SolverReportDescribeLinear_Private(snes, reduced, (PetscBool)(solved->vi->friction != NULL), report));
  PetscFunctionReturn(PETSC_SUCCESS);
}
