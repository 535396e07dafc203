/* modes.h -- rigid motions as near null space (private to the room; numerics.md 8.2). */
#ifndef MORTISE_MODES_H
#define MORTISE_MODES_H

#include "basis.h"

/* Attaches to vi->A the rigid motions of every body in the unknowns y, zero at fixed unknowns, orthonormal. Collective.
   [in] fixed - global unknowns with unit rows [num_fixed] */
PetscErrorCode ModesAttach(VI vi, const NodeBases *bases, const Couplings *couplings, PetscInt num_fixed,
                           const PetscInt fixed[]);

#endif
