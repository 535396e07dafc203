/* patchsmoother.h -- the smoother of nearly incompressible bodies: additive, over stars of vertices or over
   cells; internal (eq. 13.7). */
#ifndef MORTISE_PATCHSMOOTHER_H
#define MORTISE_PATCHSMOOTHER_H

#include "multigrid/operator.h"

/* S^-1 = sum_p R_p' (R_p A R_p')^-1 R_p over patches p of nodes that the operator marks, and the inverse
   diagonal at others. Collective.
   [in] op - with `tight`; [out] inverse - a shell that multiplies by S^-1, owned by the caller */
PetscErrorCode PatchSmootherCreate(const Operator *op, Mat *inverse);
/* Whether a matrix is such a shell, and whether its patches are cells of order 1. Not collective.
   [out] cells - or NULL */
PetscErrorCode PatchSmootherIs(Mat S, PetscBool *is, PetscBool *cells);
/* S^-1 := S^-1 / factor, for a shell of PatchSmootherCreate(). Not collective. */
PetscErrorCode PatchSmootherScale(Mat inverse, PetscReal factor);
/* The same with more fixed unknowns, where it is 0, and another A. Collective.
   [in] from - of PatchSmootherCreate(); [in] change - of A, or NULL;
   [in] fixed - counted from this rank's first, those of the operator included [num];
   [out] inverse - owned by the caller */
PetscErrorCode PatchSmootherSetFixed(Mat from, Mat change, PetscInt num, const PetscInt fixed[], Mat *inverse);

#endif
