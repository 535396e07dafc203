/* eigenvalue.h -- how large a step a smoother may take; internal (floor 6). */
#ifndef MORTISE_EIGENVALUE_H
#define MORTISE_EIGENVALUE_H

#include <petscmat.h>

/* An upper bound, but for bad luck, of the eigenvalues of S^-1 A that b sees. Collective. [in] S - or NULL for the diagonal of A; [in] b - or NULL
   for one that has some of everything; [out] largest */
PetscErrorCode EigenvalueLargest(Mat A, Mat S, Vec b, PetscReal *largest);
/* Something of everything, the same whatever the number of ranks. Collective. [out] b */
PetscErrorCode EigenvalueSeed(Vec b);

#endif
