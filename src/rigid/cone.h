/* cone.h -- nonnegative least squares, kernels and projections over rows that are distributed over ranks.

   There is a row for each contact node. A row has few entries, and at most m rows are in use. Every rank
   solves the small problem. Only the choice of the next row is collective: two reductions of a few numbers in
   each of about m steps. No rank has rows of another one. */
#ifndef MORTISE_CONE_H
#define MORTISE_CONE_H

#include "kernel/nnls.h"

typedef struct {
  MPI_Comm         comm;
  PetscInt         num, m;   /* rows of this rank, their length */
  const PetscReal *rows;     /* [num][m] */
  const PetscBool *equality; /* rows whose weight may have either sign; NULL for none [num] */
} Cone;

/* Adds the row of largest reduced cost of all ranks until none has one above the tolerance. Collective.
   [in] tolerance - in the unit of the target of nnls;
   [in,out] nnls - the same on all ranks; [out] weight - of each row of this rank [num]; optional, may be
   NULL */
PetscErrorCode ConeSolve(const Cone *cone, PetscReal tolerance, NNLS *nnls, PetscReal weight[]);

/* All q with row.q = 0 for the chosen rows, as a basis in reduced echelon form: so each motion has few bodies
   and components. Collective.
   [in] take - chosen rows, NULL for all [num]; [out] dim - dimension; [out] kernel - the same on all ranks
   [dim][m], allocated [m][m] */
PetscErrorCode ConeKernel(const Cone *cone, const PetscBool take[], PetscInt *dim, PetscReal kernel[]);

/* min |q - target|  over  row.q <= bound for all rows, bound >= 0; row.q = bound where equality is set.
   Collective.
   [in] bound - [num]; [in] target - [m]; [out] q - the same on all ranks [m] */
PetscErrorCode ConeProject(const Cone *cone, const PetscReal bound[], const PetscReal target[], PetscReal q[]);

#endif
