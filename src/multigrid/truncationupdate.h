/* truncationupdate.h -- what emptying a few rows and columns changes in a matrix, and in the coarser one; internal (eq. 13.3). */
#ifndef MORTISE_TRUNCATIONUPDATE_H
#define MORTISE_TRUNCATIONUPDATE_H

#include "multigrid/operator.h"

/* M A M + M C M after a change of M and C, less the same before it: nonzero where M or C change, in rows and columns.
   Collective. [in] op - whose matrix A is; [in] C - before the change, or NULL; [in] dC - its change, or NULL; [in] was, is - diagonal of M, 1 or 0, before
   and after; [in] springs - on the diagonal, counted as a change as well, or NULL; [out] strip - owned by the caller */
PetscErrorCode TruncationUpdateCreate(const Operator *op, Mat C, Mat dC, Vec was, Vec is, Vec W, Mat *update);
/* P' strip P. Collective. [out] product - owned by the caller */
PetscErrorCode TruncationUpdateRestrict(Mat update, Mat P, Mat *product);

#endif
