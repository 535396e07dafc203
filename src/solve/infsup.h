/* infsup.h -- the discrete inf-sup number of the mortar pairing (eqs. 11.9, 11.10). */
#ifndef MORTISE_INFSUP_H
#define MORTISE_INFSUP_H

#include "rigid/solvability.h"

/* Of one pair. The same on all ranks. */
typedef struct {
  PetscReal number; /* beta of eq. 11.9, dimensionless; NAN if it is not known */
  PetscReal
      condition; /* lambda_max / lambda_min of the scaled Schur complement; NAN also if contact alone holds a body */
} InfSup;

/* Computes beta of each pair from the Schur complement of its relative displacements: a factorization and a
   dense eigenvalue problem for each pair. Warns of pairs with more multipliers than a dense problem may have.
   Collective.
   [in] solvability - NULL where supports hold all bodies; [out] numbers - [vi->num_pairs] */
PetscErrorCode InfSupCompute(VI vi, Solvability solvability, InfSup numbers[]);

#endif
