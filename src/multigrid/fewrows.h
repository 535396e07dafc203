/* fewrows.h -- some rows of distributed matrices, one below the other. */
#ifndef MORTISE_FEWROWS_H
#define MORTISE_FEWROWS_H

#include <petscmat.h>

/* Rows of a matrix. */
typedef struct {
  Mat             from; /* knows rows */
  PetscInt        num;
  const PetscInt *row; /* of this rank [num] */
} RowList;

/* All rows of the first list, then those of the next one. Collective.
   [in] lists - of matrices with as many columns [num_lists]; [out] few - AIJ, owned by the caller */
PetscErrorCode FewRowsCreate(PetscInt num_lists, const RowList lists[], Mat *few);

#endif
