/* stiffness.h -- the stiffness K of all bodies as a Mat that keeps half of it. */
#ifndef MORTISE_STIFFNESSMAT_H
#define MORTISE_STIFFNESSMAT_H

#include <petscmat.h>
#include "problem/symmetricblocks.h"

/* K of one process. It knows products, rows, its diagonal and its infinity norm; MatConvert() makes an AIJ
   matrix of it. Collective.
   [in] blocks - taken over; [out] K - a shell, owned by the caller */
PetscErrorCode StiffnessCreate(MPI_Comm comm, SymmetricBlocks *blocks, Mat *K);
/* The same of an AIJ matrix, on any number of ranks. Collective.
   [in] A - symmetric, in full blocks of its block size; copied */
PetscErrorCode StiffnessCreateOfMatrix(Mat A, Mat *K);
/* The same of a matrix and of rows that it need not have: they couple nodes of this rank alone. Collective.
   [in] A - its complete rows are not read; [in] sums - of which the complete rows are copied; [in] complete -
   rows of blocks of this rank, or NULL for none [own rows of blocks of A] */
PetscErrorCode StiffnessCreateOfRows(Mat A, const SymmetricBlocks *sums, const PetscBool complete[], Mat *K);
/* All of K, of one process. Not collective. [out] blocks - borrowed; NULL on several ranks */
PetscErrorCode StiffnessGetBlocks(Mat K, const SymmetricBlocks **blocks);
/* factor K for products alone, of the same entries. Collective. [out] S - a shell, owned by the caller */
PetscErrorCode StiffnessCreateScaled(Mat K, PetscReal factor, Mat *S);
/* The same with numbers in single precision, for a preconditioner. */
PetscErrorCode StiffnessCreateSingle(Mat K, PetscReal factor, Mat *S);

#endif
