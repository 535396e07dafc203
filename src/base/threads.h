/* threads.h -- threads of libraries, which ranks would share the processors with. */
#ifndef MORTISE_THREADS_H
#define MORTISE_THREADS_H

#include <petscsys.h>

/* Takes the threads of CHOLMOD and OpenBLAS away, unless the environment asks for a number. Not collective; for the program, once. */
void ThreadsLimit(void);
/* Gives OpenBLAS its threads back for one large computation, or takes them away again. Nothing happens without ThreadsLimit(). Not collective. */
void ThreadsAllow(PetscBool allow);

#endif
