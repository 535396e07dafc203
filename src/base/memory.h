/* memory.h -- the most memory that the processes held at a time, and what happens when there is none left. */
#ifndef MORTISE_MEMORY_H
#define MORTISE_MEMORY_H

#include <petscsys.h>

/* Where memory is limited (ulimit -v), starts the program anew with one thread of OpenBLAS, unless the user chose their number:
   each thread sets a large buffer aside, and waits for ever where it cannot have it. Call first of all in main(). */
void MemoryLimitThreads(char **argv);
/* Makes libraries that could not return an error, or would wait, end the program by UserErrorEndMemory(): C++ (muParser among
   others), cJSON, and BLAS, whose buffer is taken now. Not collective; MPI is initialised. */
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
