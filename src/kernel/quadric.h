/* quadric.h -- a quadric: a plane, cylinder, cone, sphere or another surface of second order (eq. 4.1a). */
#ifndef MORTISE_QUADRIC_H
#define MORTISE_QUADRIC_H

#include <petscsys.h>

enum {
  QUADRIC_MONOMIALS = 10, /* 1, x, y, z, xx, xy, xz, yy, yz, zz */
  QUADRIC_LINEAR    = 1,  /* the first one of degree 1, of degree 2 */
  QUADRIC_SQUARE    = 4
};

/* c.m(x - origin) = 0; all zero where there is none. The gradient points outward. */
typedef struct {
  PetscReal origin[3], c[QUADRIC_MONOMIALS];
} Quadric;

/* The monomials m(x). Not collective. [out] m - [QUADRIC_MONOMIALS] */
void QuadricMonomials(const PetscReal x[3], PetscReal m[]);
/* c.m(x) and its gradient. Not collective. [in] c - [QUADRIC_MONOMIALS] */
PetscReal QuadricValue(const PetscReal c[], const PetscReal x[3], PetscReal gradient[3]);

/* Moves the middle of a curve over an edge to the point of a quadric that is nearest to the edge's, if it is
   not there. Arcs (4.5) are on cylinders and spheres, not on cones. Not collective. Returns whether it did.
   [in] quadric - optional, may be NULL; x0, x1 - ends; [in,out] offset - of the curve's middle from the
   edge's; [out] normal - of the quadric there, not set where nothing was moved; optional, may be NULL */
PetscBool QuadricTakeArc(const Quadric *quadric, const PetscReal x0[3], const PetscReal x1[3], PetscReal offset[3],
                         PetscReal normal[3]);

#endif
