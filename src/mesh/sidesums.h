/* sidesums.h -- values of the corners of a side's facets, and their sums at nodes. Private. */
#ifndef MORTISE_SIDESUMS_H
#define MORTISE_SIDESUMS_H

#include "mesh/mesh.h"

/* Component k of the position of corner i of facet f; of a node that hangs, on the curve that the side has.
   Not collective. */
PetscReal SideGetPosition(const Level *level, const Facets *facets, PetscInt f, PetscInt i, PetscInt k);

/* Sums values of corners at their nodes over all ranks, and gives each corner the sum. Collective.
   [in] skip - not 0 at corners that have no part in it [num][F = ELEMENT_MAX_FACET_NODES], or NULL;
   [in,out] values - [num][F][bs] */
PetscErrorCode SideSumAtNodes(Level *level, const Facets *facets, PetscInt bs, const PetscReal skip[],
                              PetscReal values[]);

#endif
