/* blocks.h -- the book of record [K B'; B 0] (private to the room). */
#ifndef MORTISE_BLOCKS_H
#define MORTISE_BLOCKS_H

#include "basis.h"

/* Fills vi->B, vi->G, vi->nest from the pairs; row a, direction i of B is
     thickness F_i . (D_aa u_a + (record u)_a)  with couplings->record = chain - M.  NULL where no pair has a multiplier. Collective. */
PetscErrorCode BlocksCreate(VI vi, const NodeBases *bases, const Couplings *couplings);

#endif
