/* eigenvalue.h -- how large a step a smoother may take. */
#ifndef MORTISE_EIGENVALUE_H
#define MORTISE_EIGENVALUE_H

#include <petscksp.h>

/* An upper bound, but for bad luck (see MultigridShortenSteps()), of the eigenvalues of S^-1 A that b sees. Collective. [in] S - or NULL for the diagonal of A; [in] b - or NULL
   for one that has some of everything; [out] largest */
PetscErrorCode EigenvalueLargest(Mat A, Mat S, Vec b, PetscReal *largest);
/* Something of everything, by the numbers of unknowns, and so another for another partition. Collective. [out] b */
PetscErrorCode EigenvalueSeed(Vec b);

/* The extreme eigenvalues of B A, B the preconditioner, from inside, as far as CG has seen them: after its solve, or in its test of convergence.
   Collective. [out] seen - whether there are any: not after no step or one that broke down, nor where the residual was zero (KSP_CONVERGED_ATOL) */
PetscErrorCode EigenvalueGetRitz(KSP ksp, PetscReal *largest, PetscReal *smallest, PetscBool *seen);

#endif
