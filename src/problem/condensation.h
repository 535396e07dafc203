/* condensation.h -- T'KT. */
#ifndef MORTISE_CONDENSATION_H
#define MORTISE_CONDENSATION_H

#include "problem/basischange.h"

/* Z = T'KT - K for a symmetric K. Collective.
   [in] factors - of T [BASIS_FACTORS]; [out] Z - AIJ, owned by the caller */
PetscErrorCode CondensationCreate(Mat K, const BasisFactor factors[], Mat *Z);

/* A = M (K / stiffness + Z) M + 1 - M + W without forming it: a shell, where M is 0 for the fixed unknowns of
   vi. Collective.
   [in] vi - its parts are borrowed for as long as A lives;
   [in] regularization - diagonal of W, 0 where M is, or NULL; borrowed as well */
PetscErrorCode CondensedMatrixCreateShell(VI vi, Vec regularization, Mat *A);
/* The same as a matrix. Collective. [in] fixed - global numbers [num] */
PetscErrorCode CondensedMatrixAssemble(Mat K, PetscReal stiffness, Mat Z, PetscInt num, const PetscInt fixed[], Mat *A);

#endif
