/* bodysmoother.h -- constrained smoother, body by body in displacements; internal (eq. 13.5). */
#ifndef MORTISE_BODYSMOOTHER_H
#define MORTISE_BODYSMOOTHER_H

#include "multigrid/operator.h"

/* S = T'D T, D = diag K, for a level with T. Only fixed unknowns of op are constrained. Collective.
   [out] inverse - a shell that multiplies by S^-1, owned by the caller */
PetscErrorCode BodySmootherCreate(const Operator *op, Mat *inverse);
/* The same with D = S_u, blocks of couplings. Collective.
   [in,out] blocks - keeps its factors (envelopefactor.h), without fixed displacements; referenced; [out]
   inverse - NULL where others cost less */
PetscErrorCode BodySmootherCreateOfBlocks(const Operator *op, Mat blocks, Mat *inverse);
/* Its blocks, or NULL. Not collective. [out] blocks - borrowed */
PetscErrorCode BodySmootherGetBlocks(Mat inverse, Mat *blocks);
/* Whether a matrix is such a shell. Not collective. */
PetscErrorCode BodySmootherIs(Mat S, PetscBool *is);
/* Constrains unknowns: S^-1 acts on the others and is 0 there. Collective.
   [in] fixed - counted from this rank's first, fixed unknowns of the operator included [num];
   [out] done - false if T'S_u T costs less */
PetscErrorCode BodySmootherSetFixed(Mat inverse, PetscInt num, const PetscInt fixed[], PetscBool *done);

#endif
