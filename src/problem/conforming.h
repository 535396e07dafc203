/* conforming.h -- the stiffness where nodes hang. */
#ifndef MORTISE_CONFORMING_H
#define MORTISE_CONFORMING_H

#include "problem/cellsums.h"

/* Adds springs between hanging nodes, whose rows and columns are empty (CellSumsAdd()), and their edges. The
   energy of u is that of S u and of the springs. A solution has no forces on hanging nodes. Hence it is
   continuous and has the energy of the cells. Without hanging nodes nothing happens. Collective.
   [in] global - numbers of the nodes of sums, as CellSumsFinish() takes them; [in,out] sums - of
   CellSumsCreate(), of all cells */
PetscErrorCode ConformingHold(Level *level, const PetscInt global[], SymmetricBlocks *sums);
/* The same of a matrix. Collective. [in,out] K - AIJ, replaced by the sum */
PetscErrorCode ConformingHoldMatrix(Level *level, Mat *K);

#endif
