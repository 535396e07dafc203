/* gather.h -- some entries of a distributed vector on one process. */
#ifndef MORTISE_GATHER_H
#define MORTISE_GATHER_H

#include <petscvec.h>

/* Collective.
   [in] entry - global numbers that this process asks for, in any order [num];
   [out] some - x there, sequential; owned by the caller */
PetscErrorCode GatherEntries(Vec x, PetscInt num, const PetscInt entry[], Vec *some);

#endif
