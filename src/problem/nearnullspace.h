/* nearnullspace.h -- rigid motions as near null space. */
#ifndef MORTISE_NEARNULLSPACE_H
#define MORTISE_NEARNULLSPACE_H

#include "problem/basischange.h"

/* u of one of vi->motions. [out] u - ghosted, ghosts not set. Not collective. */
PetscErrorCode ModesSetMotion(VI vi, PetscInt k, Vec u);
/* y = T^-1 u. [in] Bu - work vector in the layout of G, or NULL. Collective. */
PetscErrorCode ModesApplyInverse(VI vi, const NodeBases *bases, const Couplings *couplings, Vec u, Vec Bu, Vec y);

/* Attaches to vi->A the rigid motions of every body in the unknowns y, zero at fixed unknowns, orthonormal. Collective.
   [in] fixed - global unknowns with unit rows [num_fixed] */
PetscErrorCode ModesAttach(VI vi, const NodeBases *bases, const Couplings *couplings, PetscInt num_fixed,
                           const PetscInt fixed[]);

#endif
