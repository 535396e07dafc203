/* basisrows.h -- a square matrix, most rows of which are those of 1: the inverse of a change of basis. */
#ifndef MORTISE_BASISROWS_H
#define MORTISE_BASISROWS_H

#include <petscmat.h>

typedef struct {
  Mat few;  /* AIJ: the rows that are not those of 1, rank by rank; NULL: the matrix is 1 */
  IS  rows; /* their numbers, counted from this rank's first, ascending; of this process alone */
} BasisRows;

/* Not collective. [out] to - the same matrix, to be released by BasisRowsDestroy() */
PetscErrorCode BasisRowsReference(const BasisRows *from, BasisRows *to);
/* Collective. [in,out] basis - 1 from now on */
PetscErrorCode BasisRowsDestroy(BasisRows *basis);

/* Some rows. Collective.
   [in] basis - not 1;
   [in] row - numbers, counted from this rank's first, ascending [num];
   [out] some - AIJ, owned by the caller */
PetscErrorCode BasisRowsCreateSome(const BasisRows *basis, PetscInt num, const PetscInt row[], Mat *some);
/* The matrix less 1. Collective. [in] basis - not 1; [out] E - AIJ with all rows, owned by the caller */
PetscErrorCode BasisRowsCreateDifference(const BasisRows *basis, Mat *E);

/* P <- basis P T. Rows where neither factor changes anything are copied. Collective.
   [in,out] P - AIJ, owned by the caller; another matrix afterwards, where a factor is not 1;
   [in] T - AIJ, square, or NULL for 1 */
PetscErrorCode BasisRowsMultiply(const BasisRows *basis, Mat T, Mat *P);

#endif
