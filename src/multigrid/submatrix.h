/* submatrix.h -- a matrix whose submatrices are products, not copies. */
#ifndef MORTISE_SUBMATRIX_H
#define MORTISE_SUBMATRIX_H

#include <petscmat.h>

/* A matrix that multiplies by A and counts products; MatCreateSubMatrix() of it copies nothing. Collective.
   [in] A - symmetric; referenced; [in] share - added to *work with every product; [in] work - borrowed for as
   long as they live; [out] whole - owned by the caller */
PetscErrorCode SubmatrixCreateWhole(Mat A, PetscReal share, PetscReal *work, Mat *whole);

#endif
