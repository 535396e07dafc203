/* memory.h -- the peak memory of the processes, and what happens without memory. */
#ifndef MORTISE_MEMORY_H
#define MORTISE_MEMORY_H

#include <petscsys.h>

/* Without memory, cJSON cannot return an error, and BLAS would wait for ever: from now on they end the
   program by UserErrorEndMemory(). The buffer of BLAS is taken now. Not collective; MPI is initialized. */
void MemoryPrepare(void);

/* bytes = sum over the ranks of the largest resident memory so far, since the program began or since
   MemoryPeakReset(). Collective on comm.
   [out] bytes - the same on all ranks; NAN where the system does not report it;
   [out] largest - the peak of the rank with most memory; may be NULL */
PetscErrorCode MemoryPeak(MPI_Comm comm, PetscReal *bytes, PetscReal *largest);
/* Returns freed memory to the system and sets the peak to the present memory: for a run among several.
   Collective on comm.
   [out] done - whether the system can do so; elsewhere the peak stays that of the whole program */
PetscErrorCode MemoryPeakReset(MPI_Comm comm, PetscBool *done);
/* Whether each machine has this much memory for its processes together; yes where the system does not report
   it. Collective on comm.
   [in] bytes - of this rank; [out] suffices - the same on all ranks */
PetscErrorCode MemorySuffices(MPI_Comm comm, PetscReal bytes, PetscBool *suffices);
/* What all ranks may have together: what is resident now, and what their machines and limits of addresses
   still give the rank with least of it, times their number. Free memory at the top of the heap counts.
   Infinite where the system does not report it. Collective on comm. [out] bytes - the same on all ranks */
PetscErrorCode MemoryLimit(MPI_Comm comm, PetscReal *bytes);

#endif
