/* treenormals.h -- normals of smooth sides on bisected levels, from those of the mesh of the file. */
#ifndef MORTISE_TREENORMALS_H
#define MORTISE_TREENORMALS_H

#include "mesh/meshforest.h"

/* Sets level->arcs, where a body of order 1 has smooth sides that bend and no map. Collective.
   [in] forest - with the cells of the level, MeshForestGather() */
PetscErrorCode MeshForestSetNormals(MeshForest forest, Level *level);

#endif
