/* groupsets.h -- the sets of physical groups that elements are in: elements of one entity of Gmsh have the same. */
#ifndef MORTISE_GROUPSETS_H
#define MORTISE_GROUPSETS_H

#include "gmsh/gmsh.h"

typedef struct {
  PetscInt  num;
  PetscInt *start, *number; /* ascending [num+1]; physical groups [start[num]]; set 0 is empty */
} GroupSets;

/* Of the elements of these dimensions that are kept: cells, of the highest dimension, and the facets in a group. Not collective.
   [out] set - of each element, -1 for others [mesh->num_elements], freed by the caller */
PetscErrorCode GroupSetsCreate(const GmshMesh *mesh, PetscInt dim, GroupSets *sets, PetscInt **set);
PetscErrorCode GroupSetsDestroy(GroupSets *sets);

#endif
