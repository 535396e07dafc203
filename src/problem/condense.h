/* condense.h -- T'KT (private to the room). */
#ifndef MORTISE_CONDENSE_H
#define MORTISE_CONDENSE_H

#include <petscmat.h>

/* A = T'KT for a symmetric K and a T that differs from the identity in few rows. Collective. [out] A - AIJ with K's block size,
   owned by the caller */
PetscErrorCode CondenseCreate(Mat K, Mat T, Mat *A);

#endif
