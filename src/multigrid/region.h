/* region.h -- the nodes of a bisected mesh that are new to it; internal. */
#ifndef MORTISE_REGION_H
#define MORTISE_REGION_H

#include <petscmat.h>

/* Finds the nodes with an unknown whose function the coarser level has not: new nodes, and those beside
   them. Collective.
   [in] P - from the coarser level; [in] weight - sums of the squares of its columns; [in] bs - unknowns of
   a node;
   [out] region - 1 at all unknowns of these nodes, 0 at others; NULL if nearly all are such; owned by the
   caller */
PetscErrorCode RegionCreate(Mat P, Vec weight, PetscInt bs, Vec *region);

#endif
