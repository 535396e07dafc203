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

/* Seconds on a clock that never jumps; its zero is arbitrary. Works before MPI and PETSc do. Not collective. */
double LogWallClock(void);
/* Registers stages, once; collective on PETSC_COMM_WORLD. start is LogWallClock() when the program began. */
PetscErrorCode LogInitialize(double start);
/* Leaves all stages that an error has left open. Not collective. */
PetscErrorCode LogUnwind(void);
/* Begins to count anew, as if the program had begun at start: for a run among several. Within no stage. Not collective. */
PetscErrorCode LogReset(double start);
/* Enters and leaves a stage; wall seconds are added up. A stage within another one stops that one's clock. Collective on PETSC_COMM_WORLD. */
PetscErrorCode LogStageBegin(LogStage stage);
PetscErrorCode LogStageEnd(LogStage stage);
/* Stages that are entered while counting is off are stages of PETSc's log alone. Within no stage. Not collective. */
void LogCount(PetscBool on);
/* Wall seconds so far of one stage (largest over the ranks is taken by the caller), and since the program began. */
double LogStageSeconds(LogStage stage);
double LogTotalSeconds(void);
/* Seconds that this rank's processor worked, for the program and for the system on its behalf, on all threads, since the
   program began or since LogReset(). Not collective. */
double LogProcessorSeconds(void);

#endif
