/* nodelevels.h -- levels below the coarsest mesh; internal (eq. 13.6). */
#ifndef MORTISE_NODELEVELS_H
#define MORTISE_NODELEVELS_H

#include "multigrid/operator.h"
#include "multigrid/nodecoarsening.h"

/* K of a level of the mesh and its nodes. Not collective. [in,out] table - taken over; [out] points - to be destroyed by the caller; borrows K
   from op */
PetscErrorCode NodeLevelsBegin(const Operator *op, NodeTable *table, NodeSet *nodes);
/* The next coarser level. Collective. [in] fine - mesh level or one made here, that points belong to; [in,out] points - of the coarser level
   afterwards; [out] P - y of the coarser level to y of the fine one, owned by the caller; [out] coarse - to be
   released by the caller, after points are destroyed */
PetscErrorCode NodeLevelsCoarsen(const Operator *fine, NodeSet *nodes, Mat *P, Operator *coarse);

/* The squares of every column, summed up. Collective. [in] open - 1 in rows that count, 0 in others; NULL for all; [out] weight - owned by the
   caller */
PetscErrorCode NodeLevelsSumSquares(Mat P, Vec open, Vec *weight);

#endif
