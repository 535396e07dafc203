/* smoother.h -- what smoothing on one level solves with: the diagonal, and couplings that must not be cut; internal (floor 6; T35). */
#ifndef MORTISE_SMOOTHER_H
#define MORTISE_SMOOTHER_H

#include <petscksp.h>
#include <mortise/vi.h>

/* For a level with no unknown held. Distributed like A. */
typedef struct {
  Mat        S;     /* NULL where the diagonal will do */
  PetscBool *strip; /* unknowns of this rank whose couplings to each other are all in S; NULL like S */
} Smoother;

/* Collective. [in] diag - of vi->A; [out] smoother - S and strip owned by the caller, by SmootherDestroy() */
PetscErrorCode SmootherCreate(VI vi, Vec diag, Smoother *smoother);
PetscErrorCode SmootherDestroy(Smoother *smoother);
/* S where unknowns are held. Collective. [in] more - that the diagonal has now, at least, beside the strip; [in] change - of A, or NULL;
   [in] num, held - unknowns counted from this rank's first; [in,out] S - is replaced, owned by the caller; NULL like smoother's */
PetscErrorCode SmootherHold(const Smoother *smoother, Vec more, Mat change, PetscInt num, const PetscInt held[],
                            Mat *S);
/* Makes pc, whose second operator S is, its inverse on every rank; the point smoother for no S. Collective. [in] S - or NULL */
PetscErrorCode SmootherSetPC(PC pc, Mat S);

#endif
