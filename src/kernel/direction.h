/* direction.h -- the direction of contact between two curved surfaces (eq. 4.3). */
#ifndef MORTISE_DIRECTION_H
#define MORTISE_DIRECTION_H

#include <petscsys.h>

/* Normal and shape operator of a surface at a point: n outward, S = dn/dx symmetric in the tangent plane, > 0
   where convex. */
typedef struct {
  PetscReal normal[3], curvature[9]; /* [dim], [dim][dim] */
} SurfacePoint;

/* n = n_s - sum_i w_i (d_i . (n_s + n_m)) d_i,  w = S_s (S_s + S_m)^-1 between 0 and 1. This is the line of
   centres of two bodies that touch near these points; where one fits the other, the normal of the flatter
   one. Unit. The surfaces face each other. Not collective. */
void DirectionOfContact(PetscInt dim, const SurfacePoint *nonmortar, const SurfacePoint *mortar, PetscReal n[]);

/* The shape operator of a surface in another tangent plane: rotated with the normal by the smallest angle,
   which keeps principal curvatures. Not collective.
   [in] S - [dim][dim], across `from`; [in] from, to - unit, not opposite; [out] turned - across `to`
   [dim][dim] */
void DirectionTransportCurvature(PetscInt dim, const PetscReal S[], const PetscReal from[], const PetscReal to[],
                                 PetscReal turned[]);

#endif
