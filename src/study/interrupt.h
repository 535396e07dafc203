/* interrupt.h -- an end by Ctrl-C or by a time limit that leaves complete files behind (floor 8, private to this room).

   Without it SIGINT and SIGTERM would end a program in the midst of writing. With it they wait until the files are complete;
   the first rank says what there is, and the signal then has its usual effect, so that whoever sent it sees that. */
#ifndef MORTISE_STUDY_INTERRUPT_H
#define MORTISE_STUDY_INTERRUPT_H

#include <petscsys.h>

/* From now on, and until InterruptEnd(). Not collective; all ranks. */
PetscErrorCode InterruptBegin(MPI_Comm comm);
PetscErrorCode InterruptEnd(void);
/* Between the two a signal waits. Not collective; all ranks. */
void InterruptHold(void);
void InterruptRelease(void);
/* What is said when a signal ends the program. Not collective; the first rank's counts. */
void InterruptSetSentence(const char sentence[]);

#endif
