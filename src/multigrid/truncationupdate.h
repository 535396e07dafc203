/* truncationupdate.h -- the change of a matrix and of its coarse operator by truncation of a few unknowns;
   internal (eq. 13.3). */
#ifndef MORTISE_TRUNCATIONUPDATE_H
#define MORTISE_TRUNCATIONUPDATE_H

#include "multigrid/operator.h"

/* What changes in M A M + M C M. */
typedef struct {
  Mat C, dC;   /* before the change, and its change; or NULL */
  Vec was, is; /* diagonals of M, 1 or 0, before and after */
  Vec W;       /* a diagonal that counts as a change as well, or NULL */
} TruncationChange;

/* P'X P of this change X. Collective.
   [in] op - of A; [in] change - A and C are symmetric; [in] P - AIJ;
   [out] product - AIJ, owned by the caller */
PetscErrorCode TruncationUpdateRestrict(const Operator *op, const TruncationChange *change, Mat P, Mat *product);
/* sum += X, whose nonzeros sum need not have. Collective. */
PetscErrorCode TruncationUpdateAdd(Mat sum, Mat X);
/* sum = X + change. Keeps the nonzeros of the last sum where they suffice: factors of it keep their ordering
   and structure. Collective.
   [in] change - or NULL; [in,out] sum - the last one or NULL, replaced; owned by the caller */
PetscErrorCode TruncationUpdateSum(Mat X, Mat change, Mat *sum);

#endif
