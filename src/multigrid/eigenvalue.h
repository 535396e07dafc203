/* eigenvalue.h -- estimates of extreme eigenvalues by conjugate gradients. */
#ifndef MORTISE_EIGENVALUE_H
#define MORTISE_EIGENVALUE_H

#include <petscksp.h>

/* Upper bound on the largest eigenvalue of S^-1 A, estimated by Lanczos from b; may be low if b has no
   component along it (see MultigridShortenSteps()). Collective.
   [in] S - or NULL for the diagonal of A; [in] b - or NULL for EigenvalueSeed(); [out] largest */
PetscErrorCode EigenvalueLargest(Mat A, Mat S, Vec b, PetscReal *largest);
/* A vector with components along all eigenvectors, made of the numbers of unknowns. It depends on the
   partition. Collective. [out] b */
PetscErrorCode EigenvalueSeed(Vec b);

/* Extreme Ritz values of B A, B the preconditioner: after a solve by CG, or in its convergence test.
   Collective.
   [out] seen - whether there are any: not after no step, after a breakdown, or with residual zero
   (KSP_CONVERGED_ATOL) */
PetscErrorCode EigenvalueGetRitz(KSP ksp, PetscReal *largest, PetscReal *smallest, PetscBool *seen);

#endif
