/* nested.h -- points and values of nested integrals. */
#ifndef MORTISE_NESTED_H
#define MORTISE_NESTED_H

#include "kernel/cubature.h"

enum {
  CUBATURE_LOBATTO = 5,
  CUBATURE_POINTS  = 9 /* of a piece: Gauss-Lobatto with 5 and Gauss-Legendre with 4 by turns, in ascending order */
};

/* On [0,1]; weights of both rules, each of which sums to 1. */
extern const PetscReal CUBATURE_POINT[CUBATURE_POINTS], CUBATURE_WEIGHT[CUBATURE_POINTS];

/* The integrand at a point of the unit cube, with the Jacobian of the collapsed coordinates; counts it. [in] u - [dim] */
PetscErrorCode CubatureEvaluate(Cubature *cubature, const PetscReal u[], PetscReal value[]);

#endif
