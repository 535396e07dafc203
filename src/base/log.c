/* log.c -- stages: named in PETSc's log, and timed here as well, since PETSc keeps no times without
   -log_view. */
#include "base/compat.h"
#include "base/log.h"
#include <math.h>
#include <sys/resource.h>
#include <time.h>

static const char *const stage_names[STAGE_COUNT] = {"Setup", "Mortar", "Assembly", "Condense", "Solve", "Output"};

enum { STAGE_DEPTH = 4 }; // stages within stages, at most

static struct {
  PetscLogStage handle[STAGE_COUNT];
  double        begin[STAGE_COUNT];   // clock at which the stage was last entered
  double        seconds[STAGE_COUNT]; // of all visits
  LogStage      within[STAGE_DEPTH];  // the stages that are open, outermost first
  int           depth;
  PetscBool     off;    // whether stages are not counted
  double        start;  // clock at which the program, or the run, began
  double        worked; // processor seconds by then
} journal;

double LogWallClock(void)
{
  struct timespec now;

  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Processor seconds of this process since it began. */
static double LogGetProcessorSeconds_Private(void)
{
  struct rusage usage;

  if (getrusage(RUSAGE_SELF, &usage)) return NAN;
  return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

PetscErrorCode LogInitialize(double start)
{
  PetscFunctionBeginUser;
  for (int s = 0; s < STAGE_COUNT; s++) {
    PetscCall(PetscLogStageGetId(stage_names[s], &journal.handle[s]));
    if (journal.handle[s] < 0) PetscCall(PetscLogStageRegister(stage_names[s], &journal.handle[s]));
  }
  PetscCall(LogReset(start));
  journal.worked = 0; // the start of PETSc is part of the program
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LogReset(double start)
{
  PetscFunctionBeginUser;
  journal.start  = start;
  journal.worked = LogGetProcessorSeconds_Private();
  for (int s = 0; s < STAGE_COUNT; s++) journal.seconds[s] = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LogStageBegin(LogStage stage)
{
  const double now = LogWallClock();

  PetscFunctionBeginUser;
  PetscCheck(journal.depth < STAGE_DEPTH, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Too many stages within each other");
  PetscCall(PetscLogStagePush(journal.handle[stage]));
  if (journal.off) PetscFunctionReturn(PETSC_SUCCESS);
  if (journal.depth) {
    const LogStage outer = journal.within[journal.depth - 1];
    journal.seconds[outer] += now - journal.begin[outer];
  }
  journal.within[journal.depth++] = stage;
  journal.begin[stage]            = now;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LogStageEnd(LogStage stage)
{
  const double now = LogWallClock();

  PetscFunctionBeginUser;
  if (journal.off) {
    PetscCall(PetscLogStagePop());
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  journal.seconds[stage] += now - journal.begin[stage];
  if (--journal.depth) journal.begin[journal.within[journal.depth - 1]] = now;
  PetscCall(PetscLogStagePop());
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LogUnwind(void)
{
  PetscFunctionBeginUser;
  journal.off = PETSC_FALSE;
  while (journal.depth) PetscCall(LogStageEnd(journal.within[journal.depth - 1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void LogCount(PetscBool on)
{
  journal.off = (PetscBool)!on;
}

double LogStageSeconds(LogStage stage)
{
  return journal.seconds[stage];
}

double LogTotalSeconds(void)
{
  return LogWallClock() - journal.start;
}

double LogProcessorSeconds(void)
{
  return LogGetProcessorSeconds_Private() - journal.worked;
}
