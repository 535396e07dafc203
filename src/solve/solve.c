/* solve.c -- from an inequality to a configured SNES, and from what it did to a report. */
#include <stdbool.h>
#include <string.h>
#include <mortise/compat.h>
#include <mortise/fault.h>
#include <mortise/log.h>
#include <mortise/pdas.h>
#include <mortise/solvability.h>
#include "active.h"
#include "bound.h"
#include "factor.h"
#include "cascade.h"
#include "multigrid.h"
#include "reference.h"
#include "room.h"

/* A control that can only be reached through the options database. */
typedef struct {
  const char *name, *value;
  bool        needed;
  PetscBool   set; /* by us, so to be cleared by us */
} Default;

/* Puts defaults into the options database where the user has put nothing, or takes them out again. */
static PetscErrorCode DefaultsApply_Private(PetscInt n, Default defaults[], const char prefix[], PetscBool apply)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < n; i++) {
    char      option[128];
    PetscBool there;

    PetscCall(PetscSNPrintf(option, sizeof(option), "-%s%s", prefix, defaults[i].name));
    if (!defaults[i].needed) continue; /* not even looked up: an option that nothing reads is a mistake */
    if (apply) {
      PetscCall(PetscOptionsHasName(NULL, NULL, option, &there));
      defaults[i].set = (PetscBool)!there;
      if (defaults[i].set) PetscCall(PetscOptionsSetValue(NULL, option, defaults[i].value));
    } else if (defaults[i].set) {
      PetscCall(PetscOptionsClearValue(NULL, option));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

enum { NUM_DEFAULTS = 4 };

/* MUMPS: spare memory, in percent; approximate minimum degree, which orders meshes in 2D in a fifth of the time of what MUMPS would
   choose, for factors of the same size. A tolerance in the unit of y, which is of order one. [in] previous - whether there is a set to
   begin with */
static void Defaults_Private(VI vi, const SolveChoice *choice, PetscBool previous, Default defaults[])
{
  const PetscBool direct = SolveFactors(choice->pc), pdas = (PetscBool)!strcmp(choice->snes, SNESPDAS);

  defaults[0] = (Default){.name = "mat_mumps_icntl_14", .value = "50", .needed = direct};
  defaults[1] = (Default){.name = "mat_mumps_icntl_7", .value = "0", .needed = direct && vi->level->dim == 2};
  defaults[2] = (Default){.name = "snes_vi_zero_tolerance", .value = "1e-12", .needed = !pdas};
  defaults[3] = (Default){.name = "snes_pdas_start", .value = "previous", .needed = pdas && previous};
}

PetscErrorCode SolveMeasure(VI vi, Vec y, PetscInt *active, PetscReal *residual)
{
  ActiveSet    set;
  ActiveSolver solver;
  Vec          v, r, f;
  PetscReal   *values, *forces, reference, size;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetCreate(vi->upper, vi->A, &set));
  PetscCall(ActiveSolverCreate(&set, vi->A, vi->b, 0, &solver));
  PetscCall(PetscMalloc2(set.n, &values, set.n, &forces));
  PetscCall(VecDuplicate(vi->b, &v));
  PetscCall(VecDuplicate(vi->b, &r));
  PetscCall(VecDuplicate(vi->b, &f));
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

/* Why a type of PETSc's did not converge. */
static PetscErrorCode ReasonOther_Private(SNES snes, SNESConvergedReason reason, SolveReport *report)
{
  PetscFunctionBeginUser;
  if (reason == SNES_DIVERGED_LINEAR_SOLVE) {
    KSP            ksp;
    PC             pc;
    PCFailedReason failed;

    PetscCall(SNESGetKSP(snes, &ksp));
    PetscCall(FactorCheckMemory(ksp));
    PetscCall(KSPGetPC(ksp, &pc));
    PetscCall(PCGetFailedReason(pc, &failed));
    PetscCall(PetscStrncpy(report->reason, failed ? ActiveFailureOfFactor((MatFactorError)failed) : FAILURE_ITERATIVE,
                           sizeof(report->reason)));
  } else if (reason == SNES_DIVERGED_MAX_IT) {
    PetscCall(PetscSNPrintf(report->reason, sizeof(report->reason),
                            "%s had not converged after %" PetscInt_FMT " iterations (-snes_max_it)", report->type,
                            report->iterations));
  } else {
    PetscCall(PetscSNPrintf(report->reason, sizeof(report->reason), "%s stopped with PETSc's %s", report->type,
                            SNESConvergedReasons[reason]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What the SNES did, added to what it did before. */
static PetscErrorCode Report_Private(SNES snes, VI vi, Vec y, SolveReport *report)
{
  SNESConvergedReason reason;
  SNESType            type;
  KSPType             ksp_type;
  PCType              pc_type;
  KSP                 ksp;
  PC                  pc;
  MatSolverType       package = NULL;
  PetscBool           pdas, safeguarded, reduced = PETSC_FALSE;
  PetscInt            iterations, linear;
  const PetscInt     *changed;
  const char         *failure;
  char                words[96];

  PetscFunctionBeginUser;
  PetscCall(SNESGetType(snes, &type));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(KSPGetType(ksp, &ksp_type));
  PetscCall(PCGetType(pc, &pc_type));
  PetscCall(PetscStrcmp(type, SNESPDAS, &pdas));
  PetscCall(PetscStrncpy(report->type, type, sizeof(report->type)));
  PetscCall(SNESGetConvergedReason(snes, &reason));
  PetscCall(SNESGetIterationNumber(snes, &iterations));
  report->iterations += iterations;
  report->converged = (PetscBool)(reason > 0);
  if (pdas) {
    PetscCall(PDASGetHistory(snes, NULL, &report->active, &changed, &safeguarded));
    PetscCall(PDASGetLinear(snes, &linear, &report->linear_residual, &reduced));
    report->safeguarded = (PetscBool)(report->safeguarded || safeguarded);
    report->linear_iterations += linear;
    PetscCall(PDASGetFailure(snes, &failure));
    PetscCall(PetscStrncpy(report->reason, failure, sizeof(report->reason)));
    for (PetscInt k = 0; k < iterations && report->num_changed < SOLVE_MAX_HISTORY; k++)
      report->changed[report->num_changed++] = changed[k];
  } else {
    PetscCall(SNESGetLinearSolveIterations(snes, &linear));
    report->linear_iterations += linear;
    PetscCall(SolveMeasure(vi, y, &report->active, &report->linear_residual));
    if (!report->converged) PetscCall(ReasonOther_Private(snes, reason, report));
  }
  if (SolveFactors(pc_type)) PetscCall(PCFactorGetMatSolverType(pc, &package));
  if (reduced) { // whatever the KSP is, it was not asked
    PetscCall(SolveDescribe(KSPPREONLY, PCCHOLESKY, MATSOLVERMUMPS, words, sizeof(words)));
  } else {
    PetscCall(SolveDescribe(ksp_type, pc_type, package, words, sizeof(words)));
  }
  PetscCall(
      PetscSNPrintf(report->linear, sizeof(report->linear), "%s%s", words, reduced ? ", one for all active sets" : ""));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves once, and where springs hold bodies again and again until they have nothing left to do. */
static PetscErrorCode Sweep_Private(VI vi, SNES snes, Springs *springs, Vec y, SolveReport *report)
{
  PetscBool done = PETSC_FALSE, again;

  PetscFunctionBeginUser;
  while (!done) {
    do {
      PetscCall(SNESSolve(snes, NULL, y));
      PetscCall(FactorMoreRoom(snes, &again));
    } while (again);
    PetscCall(Report_Private(snes, vi, y, report));
    report->sweeps++;
    PetscCall(SpringsRelax(springs, snes, y, report, &done));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A as the choice needs it: multigrid needs its products alone, AMG the motions of the bodies. */
static PetscErrorCode Prepare_Private(VI vi, const SolveChoice *choice)
{
  const PetscBool multigrid = (PetscBool)!strcmp(choice->pc, PCTRUNCATEDMG);

  PetscFunctionBeginUser;
  if (!multigrid || strcmp(choice->snes, SNESPDAS)) PetscCall(VIAssemble(vi));
  if (!multigrid && !SolveFactors(choice->pc)) PetscCall(VIAttachModes(vi));
  if (multigrid) PetscCall(VIPrepareProducts(vi)); // here: of a copy with springs nobody would give them back
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The levels that a preconditioner works on, if it does. [in] snes - that leaves it the free unknowns alone, or NULL; [in,out] hierarchy -
   made where it is NULL, and left so if it is not needed */
static PetscErrorCode Hierarchy_Private(const Springs *springs, PC pc, SNES snes, Hierarchy *hierarchy)
{
  const VI  vi = springs->vi;
  PetscBool multigrid;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCTRUNCATEDMG, &multigrid));
  if (!multigrid || vi->mesh->num_levels < 2) PetscFunctionReturn(PETSC_SUCCESS);
  if (!*hierarchy) PetscCall(HierarchyCreate(vi, vi->solvability ? vi->solvability->springs : NULL, hierarchy));
  PetscCall(MultigridSetHierarchy(pc, *hierarchy, (*hierarchy)->num - 1, snes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode GetPC_Private(SNES snes, PC *pc)
{
  KSP ksp;

  PetscFunctionBeginUser;
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPGetPC(ksp, pc));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Begins with what coarser levels find. */
static PetscErrorCode Cascade_Private(Hierarchy hierarchy, SNES snes, Vec y)
{
  Vec active;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, &active));
  PetscCall(CascadeStart(hierarchy, y, active));
  PetscCall(PDASSetStart(snes, active));
  PetscCall(VecDestroy(&active));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolveRun(VI vi, const SolveChoice *choice, const char prefix[], PetscBool progress, Vec guess, Vec y,
                        SolveReport *report)
{
  const PetscBool pdas   = (PetscBool)!strcmp(choice->snes, SNESPDAS);
  const PetscBool nested = (PetscBool)(pdas && !guess && !vi->solvability && !strcmp(choice->pc, PCTRUNCATEDMG));
  Default         defaults[NUM_DEFAULTS];
  SNES            snes;
  Vec             scratch;
  PetscReal       norm;
  Springs         springs;
  Hierarchy       hierarchy = NULL;
  PC              pc;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(report, sizeof(*report)));
  PetscCall(Prepare_Private(vi, choice));
  PetscCall(SpringsBegin(vi, &springs));
  PetscCall(VecDuplicate(vi->b, &scratch));
  Defaults_Private(vi, choice, (PetscBool)(vi->solvability || guess || nested), defaults);
  PetscCall(DefaultsApply_Private(NUM_DEFAULTS, defaults, prefix, PETSC_TRUE));
  PetscCall(SolveConfigure(springs.vi, choice, prefix, scratch, &norm, &snes));
  PetscCall(GetPC_Private(snes, &pc));
  PetscCall(Hierarchy_Private(&springs, pc, pdas ? NULL : snes, &hierarchy));
  if (progress) PetscCall(ProgressSet(snes, springs.vi));
  PetscCall(SolveStart(springs.vi, pdas, prefix, guess, y));
  PetscCall(SpringsSet(&springs, guess ? y : NULL, snes, pdas));
  if (pdas && (choice->bound || vi->solvability)) PetscCall(PDASSetKeep(snes, PETSC_TRUE));
  if (hierarchy && nested) PetscCall(Cascade_Private(hierarchy, snes, y));
  PetscCall(Sweep_Private(springs.vi, snes, &springs, y, report));
  report->bound.value = NAN;
  if (choice->bound && !pdas) PetscCall(Hierarchy_Private(&springs, pc, NULL, &hierarchy));
  if (choice->bound) PetscCall(BoundCompute(&springs, snes, y, &report->bound));
  PetscCall(DefaultsApply_Private(NUM_DEFAULTS, defaults, prefix, PETSC_FALSE));
  PetscCall(SNESDestroy(&snes));
  if (hierarchy) report->work = hierarchy->work;
  PetscCall(HierarchyDestroy(&hierarchy));
  PetscCall(VecDestroy(&scratch));
  PetscCall(SpringsEnd(&springs, y));
  PetscCall(SolvabilitySettle(vi, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VISolve(VI vi, Vec guess, Vec y, SolveReport *report)
{
  const MPI_Comm comm  = PetscObjectComm((PetscObject)vi->A);
  const double   start = LogWallClock();
  SolveChoice    choice;
  PetscBool      progress, again;

  PetscFunctionBeginUser;
  PetscCall(SolveChoose(vi, &choice));
  if (choice.nearly && !SolveFactors(choice.pc)) {
    PetscCall(
        PetscFPrintf(comm, PETSC_STDERR,
                     "mortise: warning: -pc_type %s: may take thousands of iterations for a body that is so nearly "
                     "incompressible, where -pc_type cholesky takes none\n",
                     choice.pc));
  }
  PetscCall(ProgressWanted(vi->scene, &progress));
  PetscCall(SolveRun(vi, &choice, "", progress, guess, y, report));
  PetscCall(SolveChooseAnother(comm, report, &choice, &again));
  if (again) PetscCall(SolveRun(vi, &choice, "", progress, guess, y, report));
  report->seconds = LogWallClock() - start;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &report->seconds, 1, MPIU_REAL, MPI_MAX, comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A solver of its own for what is asked after the solution is known. */
typedef struct {
  SolveChoice choice;
  Springs     springs;
  SNES        snes;
  Vec         scratch;
  PetscReal   norm;
  Hierarchy   hierarchy;
  Default     defaults[NUM_DEFAULTS];
} Aftermath;

static PetscErrorCode AftermathBegin_Private(VI vi, Aftermath *after)
{
  PC pc;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(after, sizeof(*after)));
  PetscCall(SolveChoose(vi, &after->choice));
  PetscCall(Prepare_Private(vi, &after->choice));
  PetscCall(SpringsBegin(vi, &after->springs));
  PetscCall(VecDuplicate(vi->b, &after->scratch));
  Defaults_Private(vi, &after->choice, PETSC_FALSE, after->defaults);
  PetscCall(DefaultsApply_Private(NUM_DEFAULTS, after->defaults, "", PETSC_TRUE));
  PetscCall(SolveConfigure(after->springs.vi, &after->choice, "", after->scratch, &after->norm, &after->snes));
  PetscCall(GetPC_Private(after->snes, &pc));
  PetscCall(Hierarchy_Private(&after->springs, pc, NULL, &after->hierarchy));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in,out] y - a copy to be spoilt */
static PetscErrorCode AftermathEnd_Private(Aftermath *after, Vec y)
{
  PetscFunctionBeginUser;
  PetscCall(DefaultsApply_Private(NUM_DEFAULTS, after->defaults, "", PETSC_FALSE));
  PetscCall(SNESDestroy(&after->snes));
  PetscCall(HierarchyDestroy(&after->hierarchy));
  PetscCall(VecDestroy(&after->scratch));
  PetscCall(SpringsEnd(&after->springs, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y without what VISolve() adds to the solution of the inequality. [out] own - to be destroyed by the caller */
static PetscErrorCode Unsettle_Private(VI vi, Vec y, Vec *own)
{
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(y, own));
  PetscCall(VecCopy(y, *own));
  if (vi->solvability) PetscCall(VecAXPY(*own, -1, vi->solvability->rest));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VIEnergyBound(VI vi, Vec y, EnergyBound *bound)
{
  Aftermath after;
  Vec       own;

  PetscFunctionBeginUser;
  PetscCall(Unsettle_Private(vi, y, &own));
  PetscCall(AftermathBegin_Private(vi, &after));
  PetscCall(BoundCompute(&after.springs, after.snes, own, bound));
  PetscCall(AftermathEnd_Private(&after, own));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode VILinearReference(VI vi, Vec y, LinearReference *reference)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)vi->A);
  Aftermath      after;
  Vec            own;
  double         start;

  PetscFunctionBeginUser;
  PetscCall(Unsettle_Private(vi, y, &own));
  PetscCallMPI(MPI_Barrier(comm));
  LogCount(PETSC_FALSE);
  start = LogWallClock();
  PetscCall(AftermathBegin_Private(vi, &after));
  PetscCall(ReferenceSolve(&after.springs, after.snes, own, &reference->iterations, &reference->done));
  reference->seconds = LogWallClock() - start;
  LogCount(PETSC_TRUE);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &reference->seconds, 1, MPIU_REAL, MPI_MAX, comm));
  reference->work = after.hierarchy ? after.hierarchy->work : 0;
  PetscCall(AftermathEnd_Private(&after, own));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}
