/* graphcomponents.h -- connected components of the graph of a matrix. */
#ifndef MORTISE_GRAPHCOMPONENTS_H
#define MORTISE_GRAPHCOMPONENTS_H

#include <petscmat.h>

/* Labels the components that nonzero entries connect, each by the number of its first row. Collective.
   [in] A - AIJ, symmetric as a graph; [out] label - [rows of this rank] */
PetscErrorCode GraphComponentsLabel(Mat A, PetscReal label[]);
/* Assigns whole components to ranks: each to one that owns rows of it, so that ranks get about as many rows
   as they own. Collective.
   [in] own - one value per row; [in] label - the number of one of the rows of each component [rows of this
   rank]; [out] rows - of all components of this rank, ascending, owned by the caller */
PetscErrorCode GraphComponentsDeal(Vec own, const PetscReal label[], IS *rows);
/* The same for the components that nonzero entries of A connect. Collective. */
PetscErrorCode GraphComponentsGather(Mat A, IS *rows);

#endif
