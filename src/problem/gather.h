/* gather.h -- matrices of cells, summed up before a Mat sees them (private to the room). */
#ifndef MORTISE_GATHER_H
#define MORTISE_GATHER_H

#include <mortise/mesh.h>

/* Block rows of this rank's nodes, as far as its own columns go. */
typedef struct {
  const Level *level; /* borrowed */
  PetscInt    *start; /* [num_owned+1] */
  PetscInt    *node;  /* neighbours that this rank owns, local, ascending [start[num_owned]] */
  PetscReal   *value; /* a node's rows [dim][neighbours][dim], one node after the other */
} Gather;

/* Zeros. Not collective. [out] gather - to be destroyed by GatherFinish() */
PetscErrorCode GatherCreate(const Level *level, Gather *gather);
/* Adds the matrix of a cell: to the sums, or to K where it couples nodes of other ranks. Not collective.
   [in] Ke - [dim * num_nodes][dim * num_nodes] */
PetscErrorCode GatherAdd(Gather *gather, PetscInt cell, const PetscReal Ke[], Mat K);
/* Adds the sums to K, whose assembly is left to do, and frees them. Not collective. */
PetscErrorCode GatherFinish(Gather *gather, Mat K);

#endif
