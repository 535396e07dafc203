/* log.h -- stages of a run, in PETSc's log and in the summary's timing block. */
#ifndef MORTISE_LOG_H
#define MORTISE_LOG_H

#include <petscsys.h>

/* The life of one problem (src/README.md): one PETSc log stage each. */
typedef enum {
  STAGE_SETUP,
  STAGE_MORTAR,
  STAGE_ASSEMBLY,
  STAGE_CONDENSE,
  STAGE_SOLVE,
  STAGE_OUTPUT,
  STAGE_COUNT
} LogStage;

/* Seconds on a clock that never jumps; its zero is arbitrary. Works before MPI and PETSc do.
   Not collective. */
double LogWallClock(void);
/* Registers stages, once; collective on PETSC_COMM_WORLD. start is LogWallClock() when the program began. */
PetscErrorCode LogInitialize(double start);
/* Leaves all stages that an error has left open. Not collective. */
PetscErrorCode LogUnwind(void);
/* Resets all times, as if the program had begun at start: for a run among several. Call it outside of stages.
   Not collective. */
PetscErrorCode LogReset(double start);
/* Enters and leaves a stage; wall seconds are added. During a stage within another one the clock of the outer
   stage stops. Collective on PETSC_COMM_WORLD. */
PetscErrorCode LogStageBegin(LogStage stage);
PetscErrorCode LogStageEnd(LogStage stage);
/* While counting is off stages appear in PETSc's log alone. Call it outside of stages. Not collective. */
void LogCount(PetscBool on);
/* Wall seconds of one stage so far, and since the program began, on this rank. Not collective. */
double LogStageSeconds(LogStage stage);
double LogTotalSeconds(void);
/* Processor seconds of this rank, user and system, of all threads, since the program began or since
   LogReset(). Not collective. */
double LogProcessorSeconds(void);

#endif
