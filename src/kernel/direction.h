/* direction.h -- the direction of contact between two curved surfaces (eq. 4.3). */
#ifndef MORTISE_DIRECTION_H
#define MORTISE_DIRECTION_H

#include <petscsys.h>

/* Normal and shape operator of a surface at a point: n outward, S = dn/dx symmetric in the tangent plane, > 0 where convex. */
typedef struct {
  PetscReal normal[3], curvature[9]; /* [dim], [dim][dim] */
} SurfacePoint;

/* n = n_s - sum_i w_i (d_i . (n_s + n_m)) d_i,  w = S_s (S_s + S_m)^-1 between 0 and 1: the line of centres of two bodies that
   touch near these points, the normal of the flatter one where one lies in the other. Unit. The surfaces face each other. */
void DirectionOfContact(PetscInt dim, const SurfacePoint *nonmortar, const SurfacePoint *mortar, PetscReal n[]);

/* The shape operator of a surface as seen in another tangent plane: turned with the normal, the shortest way, so that principal curvatures
   stay. [in] S - [dim][dim], across `from`; [in] from, to - unit, not opposite; [out] turned - across `to` [dim][dim] */
void DirectionTransportCurvature(PetscInt dim, const PetscReal S[], const PetscReal from[], const PetscReal to[],
                                 PetscReal turned[]);

#endif
