/* galerkin.h -- the operator of a subspace, for matrices with few entries; internal. */
#ifndef MORTISE_GALERKIN_H
#define MORTISE_GALERKIN_H

#include <petscmat.h>

/* P'A P. Collective. [in] A, P - AIJ; [out] product - keeps no reference to them; owned by the caller */
PetscErrorCode GalerkinProduct(Mat A, Mat P, Mat *product);

#endif
