/* interrupt.h -- an end by Ctrl-C, by a time limit or by a closed terminal that leaves complete files behind.

   SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU and SIGPIPE end the program as usual, so that the sender sees it.
   Between InterruptHold() and InterruptRelease() they wait. Before the end incomplete files are removed, and
   the first rank prints its sentence. */
#ifndef MORTISE_INTERRUPT_H
#define MORTISE_INTERRUPT_H

#include <petscsys.h>

/* From now on, and until InterruptEnd(); pairs may be nested. Not collective; all ranks. */
PetscErrorCode InterruptBegin(void);
PetscErrorCode InterruptEnd(void);
/* Between these two calls a signal waits; pairs may be nested. Not collective. */
void InterruptHold(void);
void InterruptRelease(void);
/* The sentence that is printed when a signal ends the program, except SIGPIPE; "" for none. Not collective;
   each rank that sets one prints it. */
void InterruptSetSentence(const char sentence[]);
/* The function that cleans up, or NULL; it may call only functions that are safe in signal handlers.
   Not collective. */
void InterruptSetCleanUp(void (*clean)(void));
/* Cleans up, at the end of a program that fails. Not collective. */
void InterruptCleanUp(void);

#endif
