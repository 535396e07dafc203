/* reference.h -- what the last linear system costs by itself; internal (floor 6). */
#ifndef MORTISE_REFERENCE_H
#define MORTISE_REFERENCE_H

#include "springs.h"

/* Solves the system of the active set of y from zero to a relative residual of 1e-8, with what SNES and KSP are configured to. Collective.
   [in] y - of springs->original; [out] iterations - of the KSP; [out] solved */
PetscErrorCode ReferenceSolve(const Springs *springs, SNES snes, Vec y, PetscInt *iterations, PetscBool *solved);

#endif
