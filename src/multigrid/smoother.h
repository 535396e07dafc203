/* smoother.h -- what smoothing on one level solves with: the diagonal, and couplings that must not be cut; internal (eq. 13.3). */
#ifndef MORTISE_SMOOTHER_H
#define MORTISE_SMOOTHER_H

#include <petscksp.h>
#include "multigrid/operator.h"

/* For a level with no unknown held. Collective. [in] finest - whether nothing but held unknowns will change A; [in] single - whether no coarser mesh exists; [out] S - distributed like A, owned by
   the caller: a matrix, or the inverse of one (apart.h); NULL where the diagonal will do */
PetscErrorCode SmootherCreate(const Operator *op, PetscBool finest, PetscBool single, Mat *S);
/* S := factor S. Collective. */
PetscErrorCode SmootherScale(Mat S, PetscReal factor);
/* S where unknowns are held: S >= A by eigenvalues remains so. Collective. [in] from - with none held, or NULL; [in] change - of A, or NULL;
   [in] num, held - unknowns counted from this rank's first; [in,out] S - is replaced, owned by the caller; NULL like `from` */
PetscErrorCode SmootherSetFixed(Mat from, Mat change, PetscInt num, const PetscInt fixed[], Mat *S);
/* Makes pc, whose second operator S is, its inverse, whole however ranks cut it; the point smoother for no S. Collective. [in] S - or NULL */
PetscErrorCode SmootherSetPC(PC pc, Mat S);
/* To be called when pc, made by SmootherSetPC(), has been given another S. Collective. */
PetscErrorCode SmootherRenew(PC pc);

#endif
