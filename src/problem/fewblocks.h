/* fewblocks.h -- products in single precision with a symmetric matrix in which most rows are empty. */
#ifndef MORTISE_FEWBLOCKS_H
#define MORTISE_FEWBLOCKS_H

#include <petscmat.h>

/* For a preconditioner. Collective.
   [in] Z - AIJ, symmetric; [in] bs - unknowns of a node; [out] S - a shell that knows MatMultAdd();
   references parts of Z, owned by the caller */
PetscErrorCode FewBlocksCreate(Mat Z, PetscInt bs, Mat *S);

#endif
