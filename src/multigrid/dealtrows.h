/* dealtrows.h -- rows of a distributed matrix that one rank works on; internal. */
#ifndef MORTISE_DEALTROWS_H
#define MORTISE_DEALTROWS_H

#include <petscmat.h>

/* Some rows of A, most of them of this rank, as a matrix of one process. Collective.
   [in] A - AIJ on several ranks; [in] rows - of this rank, ascending; [in] chosen - columns, ascending,
   or NULL for all: entries of other columns are omitted; [out] own - AIJ, owned by the caller */
PetscErrorCode DealtRowsCreate(Mat A, IS rows, IS chosen, Mat *own);

#endif
