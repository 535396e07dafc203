/* condense.h -- T'KT (private to the room). */
#ifndef MORTISE_CONDENSE_H
#define MORTISE_CONDENSE_H

#include <petscmat.h>

/* Z = T'KT - K for a symmetric K and a T that differs from the identity in few rows. Collective. [out] Z - AIJ, owned by the caller */
PetscErrorCode CondenseCreate(Mat K, Mat T, Mat *Z);

/* A = M (K / stiffness + Z) M + 1 - M + W without forming it: a shell. Collective.
   [in] K; [in] Z - or NULL; [in] fixed - counted from this rank's first, where M is 0 [num]; [in] springs - diagonal of W, 0 where M is, or
   NULL; all borrowed for as long as A lives */
PetscErrorCode CondensedCreateShell(Mat K, PetscReal stiffness, Mat Z, PetscInt num, const PetscInt fixed[],
                                    Vec springs, Mat *A);
/* The same as a matrix. Collective. [in] fixed - global numbers [num] */
PetscErrorCode CondensedAssemble(Mat K, PetscReal stiffness, Mat Z, PetscInt num, const PetscInt fixed[], Mat *A);
/* Lets a shell take products with K / stiffness from S. Not collective. [in] S - ProductsCreate(), borrowed for as long as A lives */
PetscErrorCode CondensedSetProducts(Mat A, Mat S);
/* factor K for products with vectors alone. Collective. [in] K - symmetric, AIJ, in full blocks; [out] S - a shell, owned by the caller */
PetscErrorCode ProductsCreate(Mat K, PetscReal factor, Mat *S);

#endif
