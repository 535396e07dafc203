/* process.h -- what the program does with its process, and a library must not: signals, memory that runs out, ends of ranks. */
#ifndef MORTISE_PROCESS_H
#define MORTISE_PROCESS_H

#include <petscsys.h>
#include "base/usererror.h"

/* Starts MPI; the clock of the summary begins here. MortiseInitialize() then takes care of signals and of memory that runs out,
   mistakes are told on stderr, results on stdout, and -report is allowed. Call first of all in main(). */
void ProcessBegin(int *argc, char ***argv);
/* Whether ProcessBegin() was called; its time, by LogWallClock(). Not collective. */
PetscBool ProcessIsOwn(void);
double    ProcessStart(void);
/* Ends MPI, writes the page of -report, and returns what main() returns: the verdict, or MORTISE_FAILED where what was printed has not
   arrived. Where only some ranks know of a mistake the others are ended. Collective on MPI_COMM_WORLD. */
int ProcessEnd(MortiseExit verdict);

#endif
