/* sidecorners.h -- where sides end, and the angles of bodies at their vertices. */
#ifndef MORTISE_SIDECORNERS_H
#define MORTISE_SIDECORNERS_H

#include "level/level.h"

/* A vector at each vertex of a side that is 0 where facets surround the vertex. At the boundary of the side
   it leads in space from the first to the last neighbour on the boundary; in a plane it is 1 or -1.
   Collective. [out] ways - ghosted, dim per node, owned by the caller */
PetscErrorCode SideCornersGetEnds(Level *level, const Facets *facets, Vec *ways);
/* Whether the side ends at a vertex. [in] way - there [dim]; [in] size - usual length of its facets */
PetscBool SideCornersIsEnd(PetscInt dim, const PetscScalar way[], PetscReal size);
/* Angle of the body at its vertices: the sum of those of its cells, in space of half their solid angles.
   Collective. [out] angles - ghosted, one per node, owned by the caller */
PetscErrorCode SideCornersGetAngles(Level *level, PetscInt body, Vec *angles);

#endif
