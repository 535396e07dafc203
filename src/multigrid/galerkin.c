/* galerkin.c -- see the header. Two products take half the time of MatPtAP(), which merges rows of P'A P
   entry by entry, but need room for A P. */
#include "base/compat.h"
#include "multigrid/galerkin.h"
#include "multigrid/transposedproduct.h"

PetscErrorCode GalerkinProduct(Mat A, Mat P, Mat *product)
{
  Mat AP;

  PetscFunctionBeginUser;
  PetscCall(MatMatMult(A, P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &AP));
  PetscCall(TransposedProductCreate(P, AP, product));
  PetscCall(MatDestroy(&AP));
  PetscFunctionReturn(PETSC_SUCCESS);
}
