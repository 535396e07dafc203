/* planecut.h -- integrals of functions that jump or bend across planes; internal to cubature.h. */
#ifndef MORTISE_PLANECUT_H
#define MORTISE_PLANECUT_H

#include "kernel/cubature.h"

/* Looks for the largest jump or kink along a line. Not collective.
   [in] cubature - of a line; [out] at - in [0,1] */
PetscErrorCode CubatureFindCut(Cubature *cubature, PetscReal *at, PetscBool *found);

/* The integrals over simplices that are cut along planes, in the plane and in space. Not collective.
   [out] value - [size];
   [out] error - as of CubatureAdaptive(); above 1 where jumps and kinks are curved, or too many */
PetscErrorCode CubaturePlanes(Cubature *cubature, PetscReal value[], PetscReal *error);

#endif
