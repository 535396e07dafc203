/* roundness.h -- test for a round support of a body. */
#ifndef MORTISE_ROUNDNESS_H
#define MORTISE_ROUNDNESS_H

#include "rigid/solvability.h"

/* Whether all contact forces that balance the loads (solvability->y) act where a side, or the obstacle it
   meets, is curved and smooth. A body that rests there rolls; one that rests at an edge tips. Collective. */
PetscErrorCode RoundnessCarriesLoads(VI vi, Solvability solvability, PetscBool *round);

#endif
