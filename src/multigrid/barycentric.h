/* barycentric.h -- interpolation of a linear function from scattered points; internal (eq. 13.6). */
#ifndef MORTISE_BARYCENTRIC_H
#define MORTISE_BARYCENTRIC_H

#include <petscsys.h>

enum { BARYCENTRIC_MAX = 32 }; /* largest number of points to choose from */

/* Weights w of at most dim + 1 of the points, with

        sum w = 1,   sum w d = 0,   sum (w if w > 0, else NEGATIVE_COST |w|) d^2 minimal:

   barycentric coordinates in the simplex of the Delaunay triangulation that contains the origin; outside of
   it in a simplex nearby. Returns false if there are none, or if they amplify errors. Not collective.
   [in] num - <= BARYCENTRIC_MAX; [in] d - points relative to the target [num][dim]; [out] weight - [num] */
PetscBool BarycentricWeights(PetscInt dim, PetscInt num, const PetscReal d[], PetscReal weight[]);

#endif
