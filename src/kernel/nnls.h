/* nnls.h -- nonnegative least squares, one column at a time (Lawson and Hanson 1974, chapter 23).

       min | target - sum_j y_j c_j |   over  y_j >= 0,      c_j in R^m, any number of them

   At most m columns carry a weight, and only these are kept: the caller searches the others for the next one to enter,
   column by column or on many ranks at once. The residual r of the minimum is where the target leaves the cone of the columns:
   r.c_j <= 0 for all j and r.target = |r|^2, so that either the target is a combination of the columns (r = 0) or r proves that it
   is none. */
#ifndef MORTISE_NNLS_H
#define MORTISE_NNLS_H

#include <petscsys.h>

typedef struct {
  PetscInt   m;        /* size of the columns */
  PetscInt   num;      /* columns that carry a weight, at most m */
  PetscInt  *name;     /* their names [m] */
  PetscReal *column;   /* themselves [m][m] */
  PetscReal *weight;   /* y > 0 [m] */
  PetscReal *target;   /* [m] */
  PetscReal *residual; /* target - sum y c [m] */
  PetscReal *work;
  PetscInt   steps; /* columns that entered so far */
} NNLS;

/* Nothing entered, the residual is the target. [in] target - [m], copied; [out] nnls - to be freed by NNLSDestroy() */
PetscErrorCode NNLSCreate(PetscInt m, const PetscReal target[], NNLS *nnls);
PetscErrorCode NNLSDestroy(NNLS *nnls);

/* Takes in a column with residual.column > 0 and finds the best weights of the present ones; columns that would have to push the
   other way leave. Returns whether it was taken; if not, what is left of the residual is rounding.
   [in] name - of the caller's choice; [in] column - [m], copied */
PetscBool NNLSEnter(NNLS *nnls, PetscInt name, const PetscReal column[]);

/* How promising a column is: the part of the residual along it. [in] column - [m] */
PetscReal NNLSPrice(const NNLS *nnls, const PetscReal column[]);

#endif
