/* graphcomponents.h -- parts of a matrix that nothing connects with one another. */
#ifndef MORTISE_GRAPHCOMPONENTS_H
#define MORTISE_GRAPHCOMPONENTS_H

#include <petscmat.h>

/* What entries that are not 0 connect has one label, the number of its first row. Collective. [in] A - AIJ, symmetric as a graph;
   [out] label - [rows of this rank] */
PetscErrorCode GraphComponentsLabel(Mat A, PetscReal label[]);
/* Deals whole components out: each to the rank that has most of its rows. Collective. [out] rows - of all that this rank gets, ascending,
   owned by the caller */
PetscErrorCode GraphComponentsGather(Mat A, IS *rows);

#endif
