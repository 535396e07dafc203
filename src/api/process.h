/* process.h -- what the program does with its process, and a library must not: signals, memory that runs out, ends of ranks. */
#ifndef MORTISE_PROCESS_H
#define MORTISE_PROCESS_H

#include <petscsys.h>
#include "base/usererror.h"

/* Starts MPI; the clock of the summary begins here. MortiseInitialize() then takes care of signals and of memory that runs out,
   mistakes are told on stderr, results on stdout, and -report is allowed. Call first of all in main().
   [in] solves - PETSC_FALSE where nothing but words will be printed: then there is no MPI without a launcher */
void ProcessBegin(int *argc, char ***argv, PetscBool solves);
/* Whether this is the rank that prints. Not collective; after ProcessBegin(). */
PetscBool ProcessIsFirst(void);
/* Whether ProcessBegin() was called; its time, by LogWallClock(). Not collective. */
PetscBool ProcessIsOwn(void);
double    ProcessStart(void);
/* Ends MPI where it runs, writes the page of -report, and returns what main() returns: the verdict, or MORTISE_FAILED where what was printed has not
   arrived. Where only some ranks know of a mistake the others are ended. Collective on all ranks. */
int ProcessEnd(MortiseExit verdict);

#endif
