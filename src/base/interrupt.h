/* interrupt.h -- an end by Ctrl-C, by a time limit or by a closed terminal that leaves complete files behind.

   SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU and SIGPIPE have their usual effect, which their sender can see, but not
   in the midst of what is held together; before it what is only half done is cleaned up, and the first rank says a sentence
   if it was given one. */
#ifndef MORTISE_INTERRUPT_H
#define MORTISE_INTERRUPT_H

#include <petscsys.h>

/* From now on, and until InterruptEnd(); pairs may be nested. Not collective; all ranks. */
PetscErrorCode InterruptBegin(void);
PetscErrorCode InterruptEnd(void);
/* Between the two a signal waits; pairs may be nested. Not collective. */
void InterruptHold(void);
void InterruptRelease(void);
/* What is said when a signal ends the program; "" for nothing. Of SIGPIPE nothing is said. Not collective; counts on ranks that
   have one. */
void InterruptSetSentence(const char sentence[]);
/* What cleans up, or NULL; it may call nothing but what signal handlers may call. Not collective. */
void InterruptSetCleanUp(void (*clean)(void));
/* Cleans up, at the end of a program that fails. Not collective. */
void InterruptCleanUp(void);

#endif
