/* sidehanging.h -- normals and curvatures of a side beside hanging nodes. Private. */
#ifndef MORTISE_SIDEHANGING_H
#define MORTISE_SIDEHANGING_H

#include "side/sideshape.h"

/* Normals of a facet at its corners beside nodes that hang. Their sum over the facets around a node is exact
   on a sphere if neighbours have the edge between them in common. So small facets take the larger one's edge.
   Not collective. [in] X - of the facet; [in,out] N - [nodes][dim] */
void SideHangingSetCorners(const Level *level, const Facets *facets, PetscInt f, const PetscReal X[], PetscReal N[]);

/* Gives corners that hang the normals and curvatures of the nodes that they hang on, interpolated. Without
   hanging nodes nothing happens. Collective. */
PetscErrorCode SideHangingSetShape(Level *level, const Facets *facets, SideShape *shape);

#endif
