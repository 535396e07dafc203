/* nnls.h -- nonnegative least squares, one column at a time (Lawson and Hanson 1974, chapter 23).

       min | target - sum_j y_j c_j |   over  y_j >= 0,      c_j in R^m, any number of them

   At most m columns carry a weight, and only these are kept. The caller searches the others for the next one
       to enter, column by column or on many ranks at once. At the minimum the residual r fulfils r.c_j <= 0
       for all j and r.target = |r|^2. Either r = 0, and the target is in the cone of the columns, or r proves
       that it is not. */
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

/* Nothing entered, the residual is the target.
   [in] target - [m], copied; [out] nnls - to be freed by NNLSDestroy() */
PetscErrorCode NNLSCreate(PetscInt m, const PetscReal target[], NNLS *nnls);
PetscErrorCode NNLSDestroy(NNLS *nnls);

/* Enters a column with residual.column > 0 and computes the best weights; columns whose weight would be
   negative leave. Returns whether the column entered; if not, the residual is roundoff. Not collective.
   [in] name - of the caller's choice; [in] column - [m], copied */
PetscBool NNLSEnter(NNLS *nnls, PetscInt name, const PetscReal column[]);

/* The component of the residual along a column, by which the next one is chosen. Not collective.
   [in] column - [m] */
PetscReal NNLSPrice(const NNLS *nnls, const PetscReal column[]);

#endif
