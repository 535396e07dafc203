/* plexjoin.h -- joins parts of a mesh on several ranks to one DMPlex. */
#ifndef MORTISE_PLEXJOIN_H
#define MORTISE_PLEXJOIN_H

/* Joins the parts of all ranks. Collective.
   [in] ids - of the DM's vertices, ascending, below num_ids: the same on all ranks */
PetscErrorCode PlexJoin(DM dm, PetscInt num_ids, const PetscInt ids[]);
/* Orients edges and facets of several ranks from their vertex of the lowest number towards the lower
   neighbour: refinement depends on their orientation. Ranks have vertices in the same order. Collective. */
PetscErrorCode PlexOrientShared(DM dm, PetscInt dim);
/* Number of sets of cells that are joined facet by facet, on all ranks. Collective. */
PetscErrorCode PlexCountComponents(DM dm, PetscInt *num);

#endif
