/* bodycounts.h -- numbers of cells and nodes of each body on all ranks. */
#ifndef MORTISE_BODYCOUNTS_H
#define MORTISE_BODYCOUNTS_H

#include "problem/vi.h"

typedef struct {
  PetscInt cells, nodes;
} BodyCount;

/* Collective. [out] counts - [num_bodies], the same on all ranks */
PetscErrorCode BodyCountsCompute(const Level *level, PetscInt num_bodies, BodyCount counts[]);

#endif
