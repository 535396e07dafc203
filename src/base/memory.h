/* memory.h -- the peak memory of the processes, and what happens without memory. */
#ifndef MORTISE_MEMORY_H
#define MORTISE_MEMORY_H

#include <petscsys.h>

/* Lets cJSON, which cannot return an error, and BLAS, which would wait for ever, end the program by UserErrorEndMemory(). The
   buffer of BLAS is taken now. Not collective; MPI is initialized. */
void MemoryPrepare(void);

/* bytes = sum over the ranks of the largest resident memory so far, since the program began or since MemoryPeakReset().
   Collective on comm. [out] bytes - the same on all ranks; NAN where the system does not tell; [out] largest - that of the rank which held
   most, or NULL */
PetscErrorCode MemoryPeak(MPI_Comm comm, PetscReal *bytes, PetscReal *largest);
/* Gives freed memory back to the system and lets the peak begin anew at what is held now: for a run among several.
   Collective on comm. [out] done - whether the system can do so; elsewhere the peak stays that of the whole program */
PetscErrorCode MemoryPeakReset(MPI_Comm comm, PetscBool *done);
/* Whether the processes of each machine can have so many bytes more together; yes where the system does not tell. Collective on comm.
   [in] bytes - of this rank; [out] suffices - the same on all ranks */
PetscErrorCode MemorySuffices(MPI_Comm comm, PetscReal bytes, PetscBool *suffices);

#endif
