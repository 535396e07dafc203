/* obstacle.h -- rigid obstacles as a gap along the nonmortar normal (floor 4; T15). */
#ifndef MORTISE_OBSTACLE_H
#define MORTISE_OBSTACLE_H

#include <mortise/scene.h>

/* Signed distance from x along the unit normal n to the obstacle's surface, open > 0; PETSC_INFINITY where the ray
   turns away from it. Not collective. [in] x, n - [dim] */
PetscErrorCode ObstacleGap(const SceneObstacle *obstacle, PetscInt dim, const PetscReal x[], const PetscReal n[],
                           PetscReal *gap);

#endif
