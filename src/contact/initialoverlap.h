/* initialoverlap.h -- bodies that initially overlap by more than the search radius. */
#ifndef MORTISE_INITIALOVERLAP_H
#define MORTISE_INITIALOVERLAP_H

#include "level/level.h"

/* The largest distance of nodes of a side from the partner's side. Only nodes inside the partner's body
   count, with no part of its side within reach. Collective.
   [in] side, partner - facets of this rank; [in] body - of the partner; [in,out] depth - increased if there
   is a node farther away; [in,out] at - position of that node [dim] */
PetscErrorCode InitialOverlapFind(const Level *level, const Facets *side, PetscInt body, const Facets *partner,
                                  PetscReal reach, PetscReal *depth, PetscReal at[]);

#endif
