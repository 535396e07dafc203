/* progress.c -- the table of nonlinear iterations on the terminal. */
#include <petsctime.h>
#include "base/compat.h"
#include "pdas/pdas.h"
#include "base/terminal.h"
#include "solve/solverimpl.h"

typedef struct {
  const Inequality *solved; /* borrowed */
  PetscLogDouble    start;
} Progress;

PetscErrorCode ProgressWanted(Scene scene, PetscBool *wanted)
{
  PetscBool terminal;

  PetscFunctionBeginUser;
  PetscCall(TerminalIsPresent(scene->comm, &terminal));
  /* a study, load steps and adaptive meshes print their own lines */
  *wanted = (PetscBool)(scene->monitor || (terminal && !scene->quiet && scene->study.kind == STUDY_NONE &&
                                           !scene->steps.num && !scene->adapt.on));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Prints one line. Types other than pdas do not report their set: it is counted, and the number of changes is
   omitted. */
static PetscErrorCode MonitorFn(SNES snes, PetscInt iteration, PetscReal norm, void *ctx)
{
  Progress       *progress = ctx;
  MPI_Comm        comm     = PetscObjectComm((PetscObject)snes);
  PetscInt        active, linear;
  const PetscInt *changed;
  char            change[24] = "";
  PetscBool       pdas;
  PetscLogDouble  now;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)snes, SNESPDAS, &pdas));
  if (pdas) {
    PetscCall(PDASGetHistory(snes, NULL, &active, &changed, NULL));
    PetscCall(PDASGetLinear(snes, &linear, NULL, NULL));
    if (iteration) PetscCall(PetscSNPrintf(change, sizeof(change), "%" PetscInt_FMT, changed[iteration - 1]));
  } else {
    PetscReal residual;
    Vec       y;

    PetscCall(SNESGetSolution(snes, &y));
    PetscCall(SolverReportMeasure(progress->solved, y, &active, &residual));
    PetscCall(SNESGetLinearSolveIterations(snes, &linear));
  }
  PetscCall(PetscTime(&now));
  if (!iteration) PetscCall(PetscPrintf(comm, "iteration   active  changed    residual  linear its  seconds\n"));
  PetscCall(PetscPrintf(comm, "%9" PetscInt_FMT " %8" PetscInt_FMT " %8s %11.3e %11" PetscInt_FMT " %8.2f\n", iteration,
                        active, change, (double)norm, linear, now - progress->start));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode DestroyFn(PetscCtxRt ctx)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(*(Progress **)ctx));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProgressSet(SNES snes, const Inequality *solved)
{
  Progress *progress;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&progress));
  progress->solved = solved;
  PetscCall(PetscTime(&progress->start));
  PetscCall(SNESMonitorSet(snes, MonitorFn, progress, DestroyFn));
  PetscFunctionReturn(PETSC_SUCCESS);
}
