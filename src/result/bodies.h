/* bodies.h -- how many cells and nodes each body has on all ranks together. */
#ifndef MORTISE_RESULT_BODIES_H
#define MORTISE_RESULT_BODIES_H

#include <mortise/vi.h>

typedef struct {
  PetscInt cells, nodes;
} BodyCount;

/* Collective. [out] counts - [num_bodies], the same on all ranks */
PetscErrorCode BodiesCount(const Level *level, PetscInt num_bodies, BodyCount counts[]);

#endif
