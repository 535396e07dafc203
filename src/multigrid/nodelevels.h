/* nodelevels.h -- levels of nodes below the coarsest mesh; internal (eq. 13.6). */
#ifndef MORTISE_NODELEVELS_H
#define MORTISE_NODELEVELS_H

#include "multigrid/operator.h"
#include "multigrid/nodecoarsening.h"

/* The nodes of a level of the mesh and its K. Not collective. [in,out] table - taken over; [out] nodes - to
   be destroyed by the caller; borrows K from op */
PetscErrorCode NodeLevelsBegin(const Operator *op, NodeTable *table, NodeSet *nodes);
/* The next coarser level. Collective. [in] fine - the level of nodes; [in,out] nodes - of the coarser level
   afterwards; [out] P - y of the coarser level to y of the fine one, owned by the caller; [out] coarse - to
   be released by the caller, after nodes are destroyed */
PetscErrorCode NodeLevelsCoarsen(const Operator *fine, NodeSet *nodes, Mat *P, Operator *coarse);

/* Sums of the squares of the columns of P. Collective. [in] open - 1 for rows that count, 0 for others; NULL
   for all rows; [out] weight - owned by the caller */
PetscErrorCode NodeLevelsSumSquares(Mat P, Vec open, Vec *weight);

#endif
