/* thinbodies.h -- the cost of a frontal factorization of thin bodies; internal (eq. 14.6). */
#ifndef MORTISE_THINBODIES_H
#define MORTISE_THINBODIES_H

#include "problem/vi.h"

/* Whether a factorization is sure to be cheaper than any iteration, because bodies are thin. Collective.
   [in] floating - whether contact alone holds some body; [in] num - unknowns with bounds; [in] one - whether
   one factorization serves all sets */
PetscErrorCode ThinBodiesAreCheap(VI vi, PetscBool floating, PetscInt num, PetscBool one, PetscBool *cheap);

#endif
