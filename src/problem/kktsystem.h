/* kktsystem.h -- the uncondensed KKT system [K B'; B 0]. */
#ifndef MORTISE_KKTSYSTEM_H
#define MORTISE_KKTSYSTEM_H

#include "problem/basischange.h"

/* Fills vi->B and vi->G from the pairs; row a, direction i of B is thickness F_i . (D_aa u_a + (record
     u)_a)  with couplings->record = chain - M.  NULL where no pair has a multiplier. Collective. */
PetscErrorCode KKTSystemCreate(VI vi, const NodeBases *bases, const Couplings *couplings);
/* G by the gaps of the pairs. Collective. */
PetscErrorCode KKTSystemSetGaps(VI vi);

#endif
