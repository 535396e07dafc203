/* obstacle.h -- rigid obstacles as a gap along the contact normal, and their shape (eqs. 5.2, 4.3). */
#ifndef MORTISE_OBSTACLE_H
#define MORTISE_OBSTACLE_H

#include "kernel/direction.h"
#include "scene/scene.h"

/* Signed distance from x along the unit normal n to the obstacle's surface, open > 0; PETSC_INFINITY where
   the ray turns away from it. Not collective. [in] x, n - [dim] */
PetscErrorCode ObstacleGap(const SceneObstacle *obstacle, PetscInt dim, const PetscReal x[], const PetscReal n[],
                           PetscReal *gap);

/* Outward normal and curvature of the obstacle at its point nearest to x, or nearly so: those of its parallel
   surface through x. For a formula they are differences. Not collective.
   [in] x - [dim]; [in] own - the nonmortar side at x, from which a formula counts; [in] size - of a facet at
   x, for differences;
   [out] at - curvature zero for a plane, exactly;
   [out] known - not at the centre of a ball, nor where a formula has no value */
PetscErrorCode ObstacleShape(const SceneObstacle *obstacle, PetscInt dim, const PetscReal x[], const SurfacePoint *own,
                             PetscReal size, SurfacePoint *at, PetscBool *known);

#endif
