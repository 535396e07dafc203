/* threads.h -- threads of libraries, which compete with other ranks for the processors. */
#ifndef MORTISE_THREADS_H
#define MORTISE_THREADS_H

#include <petscsys.h>

/* Limits CHOLMOD and OpenBLAS to one thread, unless the environment sets a number. Not collective; for the
   program, once. */
void ThreadsLimit(void);
/* Restores the threads of OpenBLAS for one large computation, or limits them again. No effect without
   ThreadsLimit(). Not collective. */
void ThreadsAllow(PetscBool allow);

#endif
