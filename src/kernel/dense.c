/* dense.c -- Cholesky's factorization and Jacobi's eigenvalue iteration on small symmetric matrices.

   References:
     [1] G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed. (2013), sections 4.2 and 8.5. */
#include "kernel/dense.h"

/* A pivot below this share of its diagonal entry is roundoff. The share is invariant under common scaling of
   rows and columns. So a facet covered by a sliver at one end, badly scaled but regular, passes. */
static const PetscReal PIVOT_SHARE = 64. * PETSC_MACHINE_EPSILON;

/* Jacobi converges quadratically: matrices of this size need 5 to 7 sweeps, more than this means NaN. */
enum { JACOBI_MAX_SWEEPS = 30 };

PetscBool DenseCholesky(PetscInt n, PetscReal A[])
{
  for (PetscInt j = 0; j < n; j++) {
    PetscReal pivot = A[j * n + j];

    for (PetscInt k = 0; k < j; k++) pivot -= A[j * n + k] * A[j * n + k];
    if (!(pivot > PIVOT_SHARE * A[j * n + j])) return PETSC_FALSE; /* written so that NaN fails, too */
    A[j * n + j] = PetscSqrtReal(pivot);
    for (PetscInt i = j + 1; i < n; i++) {
      for (PetscInt k = 0; k < j; k++) A[i * n + j] -= A[i * n + k] * A[j * n + k];
      A[i * n + j] /= A[j * n + j];
    }
  }
  return PETSC_TRUE;
}

void DenseCholeskySolve(PetscInt n, const PetscReal L[], PetscReal b[])
{
  for (PetscInt i = 0; i < n; i++) { /* L y = b */
    for (PetscInt k = 0; k < i; k++) b[i] -= L[i * n + k] * b[k];
    b[i] /= L[i * n + i];
  }
  for (PetscInt i = n - 1; i >= 0; i--) { /* L' x = y */
    for (PetscInt k = i + 1; k < n; k++) b[i] -= L[k * n + i] * b[k];
    b[i] /= L[i * n + i];
  }
}

/* A <- J'AJ and V <- V J with the rotation J in the plane (p,q) that makes A_pq zero [1, alg. 8.5.1]. V may
   be NULL. */
static void DenseJacobiRotate_Private(PetscInt n, PetscReal A[], PetscInt p, PetscInt q, PetscReal V[])
{
  const PetscReal tau = (A[q * n + q] - A[p * n + p]) / (2. * A[p * n + q]);
  const PetscReal t   = (tau >= 0. ? 1. : -1.) / (PetscAbsReal(tau) + PetscSqrtReal(1. + tau * tau));
  const PetscReal c = 1. / PetscSqrtReal(1. + t * t), s = t * c;

  for (PetscInt k = 0; k < n; k++) { /* A J: columns */
    const PetscReal kp = A[k * n + p], kq = A[k * n + q];

    A[k * n + p] = c * kp - s * kq;
    A[k * n + q] = s * kp + c * kq;
  }
  for (PetscInt k = 0; k < n && V; k++) {
    const PetscReal kp = V[k * n + p], kq = V[k * n + q];

    V[k * n + p] = c * kp - s * kq;
    V[k * n + q] = s * kp + c * kq;
  }
  for (PetscInt k = 0; k < n; k++) { /* J' (A J): rows */
    const PetscReal pk = A[p * n + k], qk = A[q * n + k];

    A[p * n + k] = c * pk - s * qk;
    A[q * n + k] = s * pk + c * qk;
  }
}

void DenseEigen(PetscInt n, PetscReal A[], PetscReal values[], PetscReal V[])
{
  PetscReal scale  = 0.;
  PetscBool turned = PETSC_TRUE;

  for (PetscInt i = 0; i < n * n; i++) {
    scale = PetscMax(scale, PetscAbsReal(A[i]));
    if (V) V[i] = i / n == i % n ? 1. : 0.;
  }
  for (PetscInt sweep = 0; sweep < JACOBI_MAX_SWEEPS && turned; sweep++) {
    turned = PETSC_FALSE;
    for (PetscInt p = 0; p < n; p++) {
      for (PetscInt q = p + 1; q < n; q++) {
        if (PetscAbsReal(A[p * n + q]) <= PETSC_MACHINE_EPSILON * scale) continue; /* changes no eigenvalue by more */
        DenseJacobiRotate_Private(n, A, p, q, V);
        turned = PETSC_TRUE;
      }
    }
  }
  for (PetscInt i = 0; i < n; i++) values[i] = A[i * n + i];
}

void DenseEigenvalues(PetscInt n, const PetscReal A[], PetscReal values[])
{
  PetscReal B[DENSE_MAX * DENSE_MAX], any[DENSE_MAX];

  for (PetscInt i = 0; i < n * n; i++) B[i] = A[i];
  DenseEigen(n, B, any, NULL);
  for (PetscInt i = 0; i < n; i++) { /* each is put behind those that are larger */
    PetscInt at = i;

    for (; at > 0 && values[at - 1] < any[i]; at--) values[at] = values[at - 1];
    values[at] = any[i];
  }
}

void DenseEigenRange(PetscInt n, const PetscReal A[], PetscReal *smallest, PetscReal *largest)
{
  PetscReal values[DENSE_MAX];

  DenseEigenvalues(n, A, values);
  *smallest = values[n - 1];
  *largest  = values[0];
}
