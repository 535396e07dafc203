/* submatrix.h -- a matrix for who takes parts out of it and only multiplies with them. */
#ifndef MORTISE_SUBMATRIX_H
#define MORTISE_SUBMATRIX_H

#include <petscmat.h>

/* Products with A, counted, in a matrix whose MatCreateSubMatrix() copies nothing: its parts multiply with A, too. Collective.
   [in] A - symmetric; referenced; [in] share - added to *work with every product, of parts as well; [in] work - borrowed for as long as
   they live; [out] whole - owned by the caller */
PetscErrorCode SubmatrixCreateWhole(Mat A, PetscReal share, PetscReal *work, Mat *whole);

#endif
