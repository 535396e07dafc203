/* curves.h -- positions of the middle nodes that a file of second order has, on the points of a DM.

   Functions are not collective unless they say so. */
#ifndef MORTISE_CURVES_H
#define MORTISE_CURVES_H

#include "level/level.h"

/* Positions before the map of nodes on edges and in cells, where a file gives them. */
typedef struct {
  PetscSection section;   /* dim numbers on points of a DM that have one; NULL where all is straight */
  Vec          positions; /* this rank's */
} Curves;

PetscErrorCode CurvesDestroy(Curves *curves);
/* Number of numbers on this rank. */
PetscErrorCode CurvesGetSize(const Curves *curves, PetscInt *size);
/* Distributes curves as a DM was. Collective.
   [in] dm - before the distribution; [in] sf - of DMPlexDistribute() */
PetscErrorCode CurvesDistribute(DM dm, PetscSF sf, Curves *curves);
/* Sets the positions of the nodes that curves have. [in,out] X - [num_nodes][dim] */
PetscErrorCode CurvesGetNodes(const Curves *curves, const Level *level, PetscReal X[]);

#endif
