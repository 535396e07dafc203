/* test_log.c -- times of stages, of the whole and of the processor, and how they begin anew; stages within others. */
#include "base/compat.h"
#include "base/log.h"
#include <test.h>

static const double WORK = 0.1; /* seconds */

/* Keeps the processor busy. */
static void Work(double seconds)
{
  const double end = LogWallClock() + seconds;

  while (LogWallClock() < end) continue;
}

static PetscErrorCode TestReset(void)
{
  PetscFunctionBeginUser;
  PetscCall(LogStageBegin(STAGE_SOLVE));
  Work(WORK);
  PetscCall(LogStageEnd(STAGE_SOLVE));
  CHECK(LogStageSeconds(STAGE_SOLVE) >= WORK && LogStageSeconds(STAGE_MORTAR) == 0);
  CHECK(LogTotalSeconds() >= LogStageSeconds(STAGE_SOLVE));
  CHECK(LogProcessorSeconds() > 0);

  const double total = LogTotalSeconds(), worked = LogProcessorSeconds();

  PetscCall(LogReset(LogWallClock()));
  CHECK(LogStageSeconds(STAGE_SOLVE) == 0);
  CHECK(LogTotalSeconds() < total && LogProcessorSeconds() < worked);
  PetscCall(LogStageBegin(STAGE_OUTPUT));
  Work(WORK);
  PetscCall(LogStageEnd(STAGE_OUTPUT));
  CHECK(LogStageSeconds(STAGE_OUTPUT) >= WORK && LogTotalSeconds() >= WORK);
  CHECK(LogProcessorSeconds() > 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A stage within another one stops that one's clock, also if it is of the same name. */
static PetscErrorCode TestNested(void)
{
  PetscFunctionBeginUser;
  PetscCall(LogReset(LogWallClock()));
  PetscCall(LogStageBegin(STAGE_SOLVE));
  PetscCall(LogStageBegin(STAGE_MORTAR));
  Work(WORK);
  PetscCall(LogStageBegin(STAGE_MORTAR));
  Work(WORK);
  PetscCall(LogStageEnd(STAGE_MORTAR));
  PetscCall(LogStageBegin(STAGE_SOLVE));
  Work(WORK);
  PetscCall(LogStageEnd(STAGE_SOLVE));
  PetscCall(LogStageEnd(STAGE_MORTAR));
  PetscCall(LogStageEnd(STAGE_SOLVE));
  CHECK(LogStageSeconds(STAGE_MORTAR) >= 2 * WORK && LogStageSeconds(STAGE_SOLVE) >= WORK);
  CHECK(LogStageSeconds(STAGE_MORTAR) + LogStageSeconds(STAGE_SOLVE) <= LogTotalSeconds());
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  const double start = LogWallClock();

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(LogInitialize(start));
  PetscCall(TestReset());
  PetscCall(TestNested());
  PetscCall(PetscFinalize());
  return 0;
}
