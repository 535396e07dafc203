/* partition.h -- the partition: bodies that touch share ranks where they touch. */
#ifndef MORTISE_PARTITION_H
#define MORTISE_PARTITION_H

#include "refinement/curves.h"

/* The rank of each cell of a mesh that is complete on the first rank; other ranks have no cells.
   Not collective.
   [in] refine - number of later refinements;
   [in] contact_weight - of an edge across contact, relative to one across a facet; 0 for bodies that do not
   touch; [in] bricks - of each cell, NULL for one; [out] part - [level->num_cells] */
PetscErrorCode PartitionCompute(Scene scene, Level *level, PetscInt refine, PetscInt contact_weight,
                                const PetscInt bricks[], PetscInt num_parts, PetscInt part[]);
/* The same for a DM that is complete on the first rank, by its vertices. Collective.
   [out] part - owned by the caller, PetscFree() */
PetscErrorCode PartitionCreate(Scene scene, DM dm, PetscInt refine, const PetscInt bricks[], PetscInt *num_cells,
                               PetscInt **part);
/* Distributes the mesh over the ranks; the DM and its curves are replaced. Collective.
   [in] refine - number of later refinements;
   [out] origin - the point of the original DM of each point of this rank, owned by the caller, PetscFree();
   optional, may be NULL */
PetscErrorCode PartitionDistribute(Scene scene, PetscInt refine, DM *dm, Curves *curves, PetscInt **origin);

#endif
