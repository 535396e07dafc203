/* dual.h -- dual basis of one facet or of its covered part (floor 1).

   psi_i = sum_j A_ij phi_j with A = D_e M_e^-1, M_e = int_cov phi phi^T, D_e = diag(int_cov phi), so that
   int_cov psi_i phi_j = delta_ij int_cov phi_j and sum_i psi_i = 1 (T6; Wohlmuth 2000, Cichosz & Bischoff 2011 for cut
   facets). The integrals come from the very points that later integrate M and the gap. */
#ifndef MORTISE_DUAL_H
#define MORTISE_DUAL_H

#include <petscsys.h>

/* A from shape function values at weighted points. Returns PETSC_FALSE where M_e is numerically singular;
   D is set all the same. n <= DENSE_MAX.
   [in] phi - [num_points][n]; [in] w - [num_points]; [out] A - [n][n]; [out] D - [n] */
PetscBool DualBasis(PetscInt n, PetscInt num_points, const PetscReal phi[], const PetscReal w[], PetscReal A[],
                    PetscReal D[]);

/* psi = A phi. [in] A - [n][n]; [in] phi - [n]; [out] psi - [n] */
void DualEvaluate(PetscInt n, const PetscReal A[], const PetscReal phi[], PetscReal psi[]);

#endif
