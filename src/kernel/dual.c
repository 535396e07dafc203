/* dual.c -- the dual basis (T6) of one facet from the quadrature points that cover it.

   References:
     [1] B. Wohlmuth, A mortar finite element method using dual spaces for the Lagrange multiplier (2000).
     [2] T. Cichosz, M. Bischoff, Consistent treatment of boundaries with mortar contact formulations (2011). */
#include <mortise/dense.h>
#include <mortise/dual.h>

PetscBool DualBasis(PetscInt n, PetscInt num_points, const PetscReal phi[], const PetscReal w[], PetscReal A[],
                    PetscReal D[])
{
  PetscReal M[DENSE_MAX * DENSE_MAX] = {0.};

  /* Full coverage and cut facets are the same case here: the points lie on what is covered [2]. */
  for (PetscInt i = 0; i < n; i++) D[i] = 0.;
  for (PetscInt q = 0; q < num_points; q++) {
    for (PetscInt i = 0; i < n; i++) {
      const PetscReal w_phi = w[q] * phi[q * n + i];

      D[i] += w_phi;
      for (PetscInt j = 0; j < n; j++) M[i * n + j] += w_phi * phi[q * n + j];
    }
  }
  if (!DenseCholesky(n, M)) return PETSC_FALSE;
  /* Row i of A = D M^-1 is D_i M^-1 e_i because M is symmetric; A itself is not, except on whole affine facets. */
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = 0; j < n; j++) A[i * n + j] = i == j ? D[i] : 0.;
    DenseCholeskySolve(n, M, &A[i * n]);
  }
  return PETSC_TRUE;
}

void DualEvaluate(PetscInt n, const PetscReal A[], const PetscReal phi[], PetscReal psi[])
{
  for (PetscInt i = 0; i < n; i++) {
    psi[i] = 0.;
    for (PetscInt j = 0; j < n; j++) psi[i] += A[i * n + j] * phi[j];
  }
}
