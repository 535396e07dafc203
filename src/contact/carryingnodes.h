/* carryingnodes.h -- the nodes whose functions are not zero on a facet of the nonmortar side.

   These are the facet's own nodes, unless some of them hang. Functions of the mesh are then sums of those of
   the facet. Nodes on which a node of the facet hangs take its place in the list. */
#ifndef MORTISE_CARRYINGNODES_H
#define MORTISE_CARRYINGNODES_H

#include "kernel/dual.h"
#include "level/level.h"

typedef struct {
  Facets     facets; /* those of the side, whose types and cells are borrowed, with these nodes */
  PetscInt  *number; /* of each facet, among `functions`; -1 where no node hangs [facets.num] */
  PetscInt   num;
  DualNodes *functions; /* of facets with hanging nodes [num] */
} CarryingNodes;

/* Not collective. [in] facets - of the side, on this rank; [out] carrying - owned by the caller */
PetscErrorCode CarryingNodesCreate(const Level *level, const Facets *facets, CarryingNodes *carrying);
PetscErrorCode CarryingNodesDestroy(CarryingNodes *carrying);

#endif
