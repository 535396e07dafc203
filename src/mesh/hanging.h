/* hanging.h -- nodes that hang on an edge or a face of a larger cell. */
#ifndef MORTISE_HANGING_H
#define MORTISE_HANGING_H

#include "mesh/meshforest.h"

/* Which nodes of the latest level hang: level->conforming, level->inner. Moves them to the edges and
   faces that they hang on. Its cells are not reversed yet. Collective. */
PetscErrorCode MeshForestSetHanging(MeshForest forest, Level *level);

#endif
