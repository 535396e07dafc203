/* arcnormals.h -- normals of smooth sides on bisected levels, from those of the file's mesh. Private. */
#ifndef MORTISE_ARCNORMALS_H
#define MORTISE_ARCNORMALS_H

#include "mesh/forest.h"
#include "mesh/sideshape.h"

/* Sets level->arcs, where a body of order 1 has smooth sides that bend and no map. Collective.
   [in] forest - with the cells of the level, MeshForestGather() */
PetscErrorCode MeshForestSetNormals(MeshForest forest, Level *level);

/* Gives corners of a side the normals of level->arcs, where these are known. Not collective.
   [in,out] shape - with normals */
PetscErrorCode ArcNormalsTake(const Level *level, const Facets *facets, SideShape *shape);

#endif
