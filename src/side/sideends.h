/* sideends.h -- normals where smooth patches of a side end. Private. */
#ifndef MORTISE_SIDEENDS_H
#define MORTISE_SIDEENDS_H

#include "side/sideshape.h"
#include "side/sidesums.h"

/* Extrapolates normals at the ends of patches, where facets are on one side only. Collective.
   [in] share - of a full turn, that the patch fills around a node [num][F]; [in] known - 1 where curvatures
   are those of all directions [num][F]; [in,out] shape - with normals, ridges and curvatures */
PetscErrorCode SideEndsSetNormals(Level *level, const SideSums *nodes, const PetscReal share[], const PetscReal known[],
                                  SideShape *shape);

#endif
