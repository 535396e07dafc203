/* csrmatrix.h -- matrices from compressed rows. */
#ifndef MORTISE_CSRMATRIX_H
#define MORTISE_CSRMATRIX_H

#include <petscmat.h>

/* Compressed rows of this rank. */
typedef struct {
  PetscInt     bs;             /* block size of the matrix */
  PetscInt     m, n;           /* rows and columns of this rank */
  PetscInt    *start, *column; /* global columns, each once in a row, in any order [m + 1], [start[m]] */
  PetscScalar *value;          /* [start[m]]; NULL: all are 1, as of a graph */
} CSRRows;

/* An AIJ matrix with these rows. Collective.
   [in,out] rows - borrowed; columns of a row become ascending;
   [out] A - owned by the caller */
PetscErrorCode CSRMatrixCreate(MPI_Comm comm, CSRRows *rows, Mat *A);

/* Sorts the entries of one row by columns, and adds up those of the same column. Not collective.
   [in,out] num - of entries; column, value - [num] */
PetscErrorCode CSRMatrixMergeRow(PetscInt *num, PetscInt column[], PetscScalar value[]);

#endif
