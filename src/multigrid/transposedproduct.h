/* transposedproduct.h -- the product of a transposed matrix and another one, both with few entries. */
#ifndef MORTISE_TRANSPOSEDPRODUCT_H
#define MORTISE_TRANSPOSEDPRODUCT_H

#include <petscmat.h>

/* L'R. Collective. [in] L, R - AIJ, with the same rows on each rank; [out] product - AIJ, owned by the
   caller */
PetscErrorCode TransposedProductCreate(Mat L, Mat R, Mat *product);

#endif
