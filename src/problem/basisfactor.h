/* basisfactor.h -- a factor 1 + E of a change of basis, where E has few rows. */
#ifndef MORTISE_BASISFACTOR_H
#define MORTISE_BASISFACTOR_H

#include <petscmat.h>

typedef struct {
  Mat few;  /* the rows of E that are not empty, rank by rank */
  IS  rows; /* their numbers, counted from this rank's first; of this process alone */
} BasisFactor;

/* Collective.
   [in] E - AIJ, whose empty rows are left out;
   [in] places - numbers of its rows, counted from this rank's first, ascending; NULL: E has all rows;
   [out] factor - to be released by BasisFactorDestroy() */
PetscErrorCode BasisFactorCreate(Mat E, IS places, BasisFactor *factor);
/* E with all rows. Collective. [out] E - AIJ, owned by the caller */
PetscErrorCode BasisFactorCreateSquare(const BasisFactor *factor, Mat *E);
/* Collective. */
PetscErrorCode BasisFactorDestroy(BasisFactor *factor);

#endif
