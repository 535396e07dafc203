/* plexlist.h -- lists of cells as one DMPlex. Functions are not collective unless they say so. */
#ifndef MORTISE_PLEXLIST_H
#define MORTISE_PLEXLIST_H

#include "bodies/bodylist.h"

/* Numbers of the cells and vertices of lists as points of a DM. */
typedef struct {
  PetscInt   num_bodies, num_cells, num_vertices;
  PetscInt **point;        /* of every cell of every body [num_bodies][num_cells] */
  PetscInt  *first_vertex; /* point of the body's first vertex [num_bodies] */
} Numbering;

PetscErrorCode NumberingCreate(PetscInt num_bodies, const BodyList lists[], Numbering *numbering);
PetscErrorCode NumberingDestroy(Numbering *numbering);
/* Cells, edges, vertices and their positions, without labels. Collective on comm. */
PetscErrorCode PlexCreate(MPI_Comm comm, PetscInt dim, const BodyList lists[], const Numbering *numbering, DM *dm);

#endif
