/* insidebody.h -- points on all ranks, and which of them are inside a body. */
#ifndef MORTISE_INSIDEBODY_H
#define MORTISE_INSIDEBODY_H

#include "level/level.h"

/* Points of all ranks in the order of the ranks, and a flag for each; the same on every rank. */
typedef struct {
  PetscInt   num;
  PetscReal *x;    /* [num][dim] */
  PetscBool *flag; /* not set here [num] */
} GatheredPoints;

/* Gathers the points of all ranks. Collective.
   [in] mine - of this rank [num][dim]; [out] points - owned by the caller */
PetscErrorCode GatheredPointsCreate(const Level *level, PetscInt num, const PetscReal mine[], GatheredPoints *points);
PetscErrorCode GatheredPointsDestroy(GatheredPoints *points);

/* Which points lie in a cell of a body, or on its side, on any rank. Collective.
   [in] x - the same on all ranks [num][dim]; [out] inside - [num] */
PetscErrorCode InsideBodyFind(const Level *level, PetscInt body, PetscInt num, const PetscReal x[], PetscBool inside[]);

#endif
