/* bodysmoother.h -- smoothing each body in its own displacements, whatever it leans on; internal (eq. 13.5). */
#ifndef MORTISE_BODYSMOOTHER_H
#define MORTISE_BODYSMOOTHER_H

#include "multigrid/operator.h"

/* S = T'D T, D = diag K, of a level with T, no unknown held but fixed ones. Collective.
   [out] inverse - a shell that multiplies by S^-1, owned by the caller */
PetscErrorCode BodySmootherCreate(const Operator *op, Mat *inverse);
/* Whether a matrix is such a shell. Not collective. */
PetscErrorCode BodySmootherIs(Mat S, PetscBool *apart);
/* S of unknowns that are not held: its inverse is 0 at the others. Collective. [in] held - counted from this rank's first [num], eliminated
   ones among them */
PetscErrorCode BodySmootherSetFixed(Mat inverse, PetscInt num, const PetscInt fixed[]);

#endif
