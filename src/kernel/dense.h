/* dense.h -- the few operations on small symmetric matrices that the kernel needs.

   They have 2 to 9 rows, once per facet or material: calls of LAPACK would take more time than the work
   itself. Row-major, both triangles stored. */
#ifndef MORTISE_DENSE_H
#define MORTISE_DENSE_H

#include <petscsys.h>

enum { DENSE_MAX = 9 }; /* rows: a quad9 facet, or a Hooke tensor in 3D */

/* A = L L'. Returns PETSC_FALSE where a pivot has lost all its digits: A is singular or indefinite.
   [in,out] A - symmetric [n][n]; its lower triangle becomes L */
PetscBool DenseCholesky(PetscInt n, PetscReal A[]);

/* Solves L L' x = b in place. [in] L - of DenseCholesky() [n][n]; [in,out] b - [n] */
void DenseCholeskySolve(PetscInt n, const PetscReal L[], PetscReal b[]);

/* Eigenvalues of a symmetric matrix, the largest first.
   [in] A - [n][n], n <= DENSE_MAX; [out] values - [n] */
void DenseEigenvalues(PetscInt n, const PetscReal A[], PetscReal values[]);

/* Smallest and largest eigenvalue of a symmetric matrix. [in] A - [n][n], n <= DENSE_MAX */
void DenseEigenRange(PetscInt n, const PetscReal A[], PetscReal *smallest, PetscReal *largest);

/* A = V diag(values) V'.
   [in,out] A - symmetric [n][n] of any size, destroyed; [out] values - [n]; [out] V - orthogonal, its columns
   are the eigenvectors, those of a diagonal matrix the axes in their order [n][n] */
void DenseEigen(PetscInt n, PetscReal A[], PetscReal values[], PetscReal V[]);

#endif
