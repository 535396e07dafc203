/* log.c -- stages: named in PETSc's log, and timed here as well, since PETSc keeps no times without -log_view. */
#include <mortise/compat.h>
#include <mortise/log.h>
#include <time.h>

static const char *const stage_names[STAGE_COUNT] = {"Setup", "Mortar", "Assembly", "Condense", "Solve", "Output"};

static struct {
  PetscLogStage handle[STAGE_COUNT];
  double        begin[STAGE_COUNT];   // clock at which the stage was last entered
  double        seconds[STAGE_COUNT]; // of all visits
  double        start;                // clock at which the program began
} journal;

double LogWallClock(void)
{
  struct timespec now;

  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

PetscErrorCode LogInitialize(double start)
{
  PetscFunctionBeginUser;
  journal.start = start;
  for (int s = 0; s < STAGE_COUNT; ++s) {
    journal.seconds[s] = 0;
    PetscCall(PetscLogStageRegister(stage_names[s], &journal.handle[s]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LogStageBegin(LogStage stage)
{
  PetscFunctionBeginUser;
  PetscCall(PetscLogStagePush(journal.handle[stage]));
  journal.begin[stage] = LogWallClock();
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LogStageEnd(LogStage stage)
{
  PetscFunctionBeginUser;
  journal.seconds[stage] += LogWallClock() - journal.begin[stage];
  PetscCall(PetscLogStagePop());
  PetscFunctionReturn(PETSC_SUCCESS);
}

double LogStageSeconds(LogStage stage)
{
  return journal.seconds[stage];
}

double LogTotalSeconds(void)
{
  return LogWallClock() - journal.start;
}
