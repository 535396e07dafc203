/* barycentric.h -- a linear function at one place by its values at others; internal (eq. 13.6). */
#ifndef MORTISE_BARYCENTRIC_H
#define MORTISE_BARYCENTRIC_H

#include <petscsys.h>

enum { BARYCENTRIC_MAX = 32 }; /* places to choose from */

/* Weights w of at most dim + 1 of the places with

     sum w = 1,   sum w d = 0,   sum (w if w > 0, else LOATH |w|) d^2 the least:

   barycentric coordinates in the simplex of Delaunay's triangulation of these places that zero lies in, and outside of it in one that is near. False where
   there are none, or only such as make much of small differences. Not collective.
   [in] num - <= BARYCENTRIC_MAX; [in] d - places, seen from where the function is wanted [num][dim]; [out] weight - [num] */
PetscBool BarycentricWeights(PetscInt dim, PetscInt num, const PetscReal d[], PetscReal weight[]);

#endif
