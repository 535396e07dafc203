/* truncationupdate.h -- the change of a matrix and of its coarse operator by truncation of a few unknowns;
   internal (eq. 13.3). */
#ifndef MORTISE_TRUNCATIONUPDATE_H
#define MORTISE_TRUNCATIONUPDATE_H

#include "multigrid/operator.h"

/* The change of M A M + M C M: nonzero where M or C change, in rows and columns. Collective.
   [in] op - of A; [in] C - before the change, or NULL; [in] dC - its change, or NULL; [in] was, is - diagonal
   of M, 1 or 0, before and after; [in] W - a diagonal that counts as a change as well, or NULL; [out] update
   - owned by the caller */
PetscErrorCode TruncationUpdateCreate(const Operator *op, Mat C, Mat dC, Vec was, Vec is, Vec W, Mat *update);
/* P' update P. Collective. [out] product - owned by the caller */
PetscErrorCode TruncationUpdateRestrict(Mat update, Mat P, Mat *product);
/* sum += X, whose nonzeros sum need not have. Collective. */
PetscErrorCode TruncationUpdateAdd(Mat sum, Mat X);
/* sum = X + change. Keeps the nonzeros of the last sum where they suffice: factors of it keep their ordering
   and structure. Collective.
   [in] change - or NULL; [in,out] sum - the last one or NULL, replaced; owned by the caller */
PetscErrorCode TruncationUpdateSum(Mat X, Mat change, Mat *sum);

#endif
