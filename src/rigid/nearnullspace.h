/* nearnullspace.h -- rigid body modes as near null space of A. */
#ifndef MORTISE_NEARNULLSPACE_H
#define MORTISE_NEARNULLSPACE_H

#include "problem/vi.h"

/* Attaches to vi->A, as near null space, the rigid body modes of every body in the unknowns y: orthonormal,
   zero at fixed unknowns. Collective. */
PetscErrorCode NearNullSpaceAttach(VI vi);

#endif
