/* gatherarrays.h -- arrays of all ranks, concatenated on the first rank. */
#ifndef MORTISE_GATHERARRAYS_H
#define MORTISE_GATHERARRAYS_H

#include <petscsys.h>

/* All values that the ranks hold, in the order of the ranks, on the first rank; NULL elsewhere. Collective.
   [out] all - owned by the caller; [out] total - may be NULL */
PetscErrorCode GatherArraysReal(MPI_Comm comm, PetscInt n, const PetscReal mine[], PetscInt *total, PetscReal **all);
PetscErrorCode GatherArraysInt(MPI_Comm comm, PetscInt n, const PetscInt mine[], PetscInt *total, PetscInt **all);

#endif
