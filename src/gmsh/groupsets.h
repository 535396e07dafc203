/* groupsets.h -- the sets of physical groups of elements: elements of one Gmsh entity have the same set. */
#ifndef MORTISE_GROUPSETS_H
#define MORTISE_GROUPSETS_H

#include "gmsh/gmsh.h"

typedef struct {
  PetscInt  num;
  PetscInt *start, *number; /* ascending [num+1]; physical groups [start[num]]; set 0 is empty */
} GroupSets;

/* Finds the sets of the cells, which have the dimension dim, and of the facets in a physical group.
   Not collective.
   [out] sets - owned by the caller, GroupSetsDestroy()
   [out] set - of each element, -1 for other elements [mesh->num_elements]; owned by the caller,
   PetscFree() */
PetscErrorCode GroupSetsCreate(const GmshMesh *mesh, PetscInt dim, GroupSets *sets, PetscInt **set);
PetscErrorCode GroupSetsDestroy(GroupSets *sets);

#endif
