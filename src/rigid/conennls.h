/* conennls.h -- nonnegative least squares over rows that are spread over ranks.

   There are as many rows as contact nodes, yet only a few numbers in each and at most m of them in use. So the small problem is
   solved by every rank alike, and the ranks only look together for the row that is to enter next: two reductions of a few numbers for
   each of the about m steps, and no rank ever holds the rows of another. */
#ifndef MORTISE_CONENNLS_H
#define MORTISE_CONENNLS_H

#include "kernel/nnls.h"

typedef struct {
  MPI_Comm         comm;
  PetscInt         num, m; /* rows of this rank, their length */
  const PetscReal *rows;   /* [num][m] */
  const PetscBool *both;   /* rows whose weight may have either sign, NULL for none [num] */
} Cone;

/* NNLSSolve() over the rows of all ranks. Collective; nnls is the same on all ranks before and after.
   [in] tolerance - in the unit of nnls' target; [out] weight - of each row of this rank, or NULL [num] */
PetscErrorCode ConeSolve(const Cone *cone, PetscReal tolerance, NNLS *nnls, PetscReal weight[]);

/* The motions q with row.q = 0 for the rows that are taken, as rows of a reduced echelon form: those of few bodies and few
   components. Collective. [in] take - NULL for all [num]; [out] dim - how many; [out] kernel - the same on all ranks [dim][m] of
   [m][m] */
PetscErrorCode ConeKernel(const Cone *cone, const PetscBool take[], PetscInt *dim, PetscReal kernel[]);

#endif
