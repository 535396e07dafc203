/* graphcomponents.h -- connected components of the graph of a matrix. */
#ifndef MORTISE_GRAPHCOMPONENTS_H
#define MORTISE_GRAPHCOMPONENTS_H

#include <petscmat.h>

/* Labels the components that nonzero entries connect, each by the number of its first row. Collective.
   [in] A - AIJ, symmetric as a graph; [out] label - [rows of this rank] */
PetscErrorCode GraphComponentsLabel(Mat A, PetscReal label[]);
/* Assigns whole components to ranks: each to the rank that owns most of its rows. Collective.
   [out] rows - of all components of this rank, ascending, owned by the caller */
PetscErrorCode GraphComponentsGather(Mat A, IS *rows);

#endif
