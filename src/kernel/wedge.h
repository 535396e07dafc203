/* wedge.h -- the singularity of the pressure at the edge of a body on the flat side of a larger partner. */
#ifndef MORTISE_WEDGE_H
#define MORTISE_WEDGE_H

#include <petscsys.h>

/* The exponent e >= 0 of the pressure r^-e at the distance r from the edge, without friction; 0 where the
   pressure has a limit.
   [in] angle - of the body at its edge, in radians, below pi;
   [in] ratio - contact modulus of the body over that of the partner */
PetscReal WedgeExponent(PetscReal angle, PetscReal ratio);

#endif
