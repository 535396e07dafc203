/* smoother.h -- the smoother of one level: the diagonal, blocks, or body by body; internal (eq. 13.3). */
#ifndef MORTISE_SMOOTHER_H
#define MORTISE_SMOOTHER_H

#include <petscksp.h>
#include "multigrid/operator.h"

/* The matrix S of the smoother, with no active unknowns. Collective.
   [in] finest - whether only active unknowns will change A; [in] single - whether there is no coarser mesh;
   [in,out] round - whether it is known that no cell is long; [out] S - distributed like A, owned by the
   caller: a matrix, or a shell of its inverse (bodysmoother.h); NULL for the diagonal */
PetscErrorCode SmootherCreate(const Operator *op, PetscBool finest, PetscBool single, PetscBool *round, Mat *S);
/* Whether `finest` matters: a nonmortar side is much stiffer than its mortar side. Collective. */
PetscErrorCode SmootherDependsOnFinest(const Operator *op, PetscBool *depends);
/* S := factor S. Collective. */
PetscErrorCode SmootherScale(Mat S, PetscReal factor);
/* S with fixed unknowns; S >= A still holds. Collective.
   [in] op - of SmootherCreate(); [in] from - without fixed unknowns, or NULL; [in] change - of A, or NULL;
   [in] fixed - counted from this rank's first [num]; [in,out] S - replaced, owned by the caller; NULL like
   `from` */
PetscErrorCode SmootherSetFixed(const Operator *op, Mat from, Mat change, PetscInt num, const PetscInt fixed[], Mat *S);
/* Makes pc the inverse of S, its second operator; each block is solved on one rank. Collective.
   [in] S - or NULL for the diagonal */
PetscErrorCode SmootherSetPC(PC pc, Mat S);
/* Call it after pc of SmootherSetPC() got another S, not NULL. Collective. */
PetscErrorCode SmootherRenew(PC pc);

#endif
