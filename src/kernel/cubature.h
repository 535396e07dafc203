/* cubature.h -- integrals of functions with jumps and kinks over a reference cell.

   A function of several components is given by its values at points. A rule with points up to the vertices
   tells whether it is smooth. Where it is not, nested integrals along lines find its jumps and kinks by
   bisection and are cut there. */
#ifndef MORTISE_CUBATURE_H
#define MORTISE_CUBATURE_H

#include "kernel/element.h"

enum { CUBATURE_MAX_SIZE = 3 * ELEMENT_MAX_NODES, CUBATURE_MAX_PIECES = 8, CUBATURE_MAX_GAUSS = 8 };

/* value = the integrand at xi, with all measures but that of the reference cell.
   [in] xi - [ElementDim]; [out] value - [size] */
typedef PetscErrorCode (*CubatureFn)(void *ctx, const PetscReal xi[], PetscReal value[]);

/* value = switching function i: the integrand jumps or bends only where one of these functions is zero.
   [in] xi - [ElementDim] */
typedef PetscErrorCode (*CubatureSwitchFn)(void *ctx, PetscInt i, const PetscReal xi[], PetscReal *value);

typedef struct {
  ElementType      type;
  PetscInt         size; /* components, up to CUBATURE_MAX_SIZE */
  CubatureFn       integrand;
  CubatureSwitchFn switches;     /* of CubatureSwitches() */
  PetscInt         num_switches; /* up to 16 */
  void            *ctx;
  const PetscReal *tolerance; /* positive, permitted error of each integral [size] */
  PetscReal        inset;     /* part of a line at each end without points; shorter intervals are roundoff */
  PetscInt         pieces;    /* each line is cut into so many to begin with, up to CUBATURE_MAX_PIECES */
  PetscInt         budget;    /* evaluations that CubatureAdaptive() may take */
  PetscInt         count;     /* evaluations that it took */
} Cubature;

/* The integrals by a product of equal rules. CubatureGauss(): Gauss-Legendre with num points on each line,
   exact to degree 2 num - 1 in each coordinate. CubatureLobatto(): Gauss-Lobatto with 5 points on each of the
   pieces, exact to degree 7. Points of the latter reach the vertices of the reference cell, less the inset.
   On simplices both are exact to one degree less in the plane and two less in space. Not collective.
   [in] num - up to CUBATURE_MAX_GAUSS; [out] value - [size] */
PetscErrorCode CubatureGauss(Cubature *cubature, PetscInt num, PetscReal value[]);
PetscErrorCode CubatureLobatto(Cubature *cubature, PetscReal value[]);

/* The integrals by nested adaptive rules, which are cut at jumps and kinks. Not collective.
   [out] value - [size];
   [out] error - its estimate in units of the tolerance, 1 or less unless the budget is used up */
PetscErrorCode CubatureAdaptive(Cubature *cubature, PetscReal value[], PetscReal *error);

/* Whether a switching function may be zero in the cell, judged by values on a lattice and their second
   differences. Not collective. */
PetscErrorCode CubatureMayJump(Cubature *cubature, PetscBool *may);
/* The integrals by Gauss rules between the zeros of known functions. Not collective.
   [out] value, error - as above; after many bisections of a cell the error may be a few times the
   tolerance */
PetscErrorCode CubatureSwitches(Cubature *cubature, PetscReal value[], PetscReal *error);

/* The largest difference of two rules in units of the tolerance. Not collective. [in] a, b - [size] */
PetscReal CubatureDifference(const Cubature *cubature, const PetscReal a[], const PetscReal b[]);

#endif
