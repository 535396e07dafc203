/* sidenodes.h -- the nodes of a side. */
#ifndef MORTISE_SIDENODES_H
#define MORTISE_SIDENODES_H

#include "level/level.h"

/* The nodes of a set of facets that this rank owns, ascending. Those of all ranks, one rank behind the other,
   then ascend by their global numbers. The rank that holds a facet need not own its nodes. Collective.
   [out] nodes - local [num], owned by the caller, PetscFree() */
PetscErrorCode SideNodesCreate(Level *level, const Facets *facets, PetscInt *num, PetscInt **nodes);

#endif
