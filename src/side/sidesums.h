/* sidesums.h -- values of the corners of a side's facets, and their sums at nodes. Private. */
#ifndef MORTISE_SIDESUMS_H
#define MORTISE_SIDESUMS_H

#include "level/level.h"

/* The nodes of a side, each once: owned ones first, then those of other ranks. */
typedef struct {
  MPI_Comm      comm;
  PetscMPIInt   size;
  const Facets *facets;
  PetscInt      num, num_owned; /* owned ones may have no facet of this rank */
  PetscInt     *corner;         /* node of each corner [facets->num][F = ELEMENT_MAX_FACET_NODES] */
  PetscInt     *others;         /* numbers among the nodes of all ranks [num - num_owned] */
} SideSums;

/* Finds the nodes of a side. Collective.
   [in] facets - of this rank, borrowed; [out] sums - owned by the caller, SideSumsDestroy() */
PetscErrorCode SideSumsCreate(Level *level, const Facets *facets, SideSums *sums);
PetscErrorCode SideSumsDestroy(SideSums *sums);

/* Sums values over all ranks. Collective. [in,out] values - of nodes [sums->num][bs] */
PetscErrorCode SideSumsShare(const SideSums *sums, PetscInt bs, PetscReal values[]);

/* Sums values of corners at their nodes over all ranks, and gives each corner the sum. Collective.
   [in] skip - not 0 at corners that have no part in it [num][F], or NULL; [in,out] values - [num][F][bs] */
PetscErrorCode SideSumAtNodes(const SideSums *nodes, PetscInt bs, const PetscReal skip[], PetscReal values[]);

/* Component k of the position of corner i of facet f; of a node that hangs, on the curve that the side has.
   Not collective. */
PetscReal SideGetPosition(const Level *level, const Facets *facets, PetscInt f, PetscInt i, PetscInt k);

/* The vector from corner i of facet f to its corner j. Not collective. [out] d - [dim] */
void SideGetWay(const Level *level, const Facets *facets, PetscInt f, PetscInt i, PetscInt j, PetscReal d[]);

#endif
