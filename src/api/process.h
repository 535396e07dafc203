/* process.h -- process control, which a program has and a library must not: signals, lack of memory, ends of
   ranks. */
#ifndef MORTISE_PROCESS_H
#define MORTISE_PROCESS_H

#include <petscsys.h>
#include "base/usererror.h"

/* Starts MPI; the clock of the summary begins here. MortiseInitialize() then handles signals and lack of
   memory, prints mistakes on stderr and results on stdout, and allows -report. Call it first in main().
   Collective on all ranks.
   [in] solves - PETSC_FALSE where only text is printed: then MPI is not started without a launcher */
void ProcessBegin(int *argc, char ***argv, PetscBool solves);
/* Whether this is the rank that prints. Not collective; after ProcessBegin(). */
PetscBool ProcessIsFirst(void);
/* Whether ProcessBegin() was called; its time, by LogWallClock(). Not collective. */
PetscBool ProcessIsOwn(void);
double    ProcessStart(void);
/* Ends MPI where it runs, and writes the page of -report. Returns the exit code: the verdict, or
   MORTISE_FAILED where output was lost. Where only some ranks have noticed a mistake the others are ended.
   Collective on all ranks. */
int ProcessEnd(MortiseExit verdict);

#endif
