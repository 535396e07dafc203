/* test_dense.c -- small factorizations and eigenvalues against products and closed forms. */
#include "kernel/dense.h"
#include <test.h>

#include "uniform.h"

static const PetscReal EXACT = 1e-13;

/* A = B B' + I, positive definite for any B. */
static void RandomDefinite(PetscInt n, PetscReal A[])
{
  PetscReal B[DENSE_MAX * DENSE_MAX];

  for (PetscInt i = 0; i < n * n; i++) B[i] = Uniform(-1., 1.);
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = 0; j < n; j++) {
      A[i * n + j] = i == j ? 1. : 0.;
      for (PetscInt k = 0; k < n; k++) A[i * n + j] += B[i * n + k] * B[j * n + k];
    }
  }
}

static void TestSolve(void)
{
  for (PetscInt n = 1; n <= DENSE_MAX; n++) {
    PetscReal A[DENSE_MAX * DENSE_MAX], L[DENSE_MAX * DENSE_MAX], x[DENSE_MAX], b[DENSE_MAX];

    RandomDefinite(n, A);
    for (PetscInt i = 0; i < n * n; i++) L[i] = A[i];
    for (PetscInt i = 0; i < n; i++) x[i] = Uniform(-1., 1.);
    for (PetscInt i = 0; i < n; i++) {
      b[i] = 0.;
      for (PetscInt j = 0; j < n; j++) b[i] += A[i * n + j] * x[j];
    }
    CHECK(DenseCholesky(n, L));
    DenseCholeskySolve(n, L, b);
    for (PetscInt i = 0; i < n; i++) CHECK_NEAR(b[i], x[i], EXACT);
  }
}

static void TestRefusal(void)
{
  PetscReal singular[] = {1., 2., 2., 4.}, indefinite[] = {1., 2., 2., 1.}, zero[] = {0.}, nan[] = {NAN};
  PetscReal scaled[] = {1., 1e-10, 1e-10, 4e-20}; /* regular whatever the scale of its rows */

  CHECK(!DenseCholesky(2, singular));
  CHECK(!DenseCholesky(2, indefinite));
  CHECK(!DenseCholesky(1, zero));
  CHECK(!DenseCholesky(1, nan));
  CHECK(DenseCholesky(2, scaled));
  for (PetscInt trial = 0; trial < 1000; trial++) { /* v v' is singular but for roundoff */
    const PetscReal v[2]    = {Uniform(-1., 1.), Uniform(-1., 1.)};
    PetscReal       outer[] = {v[0] * v[0], v[0] * v[1], v[0] * v[1], v[1] * v[1]};

    CHECK(!DenseCholesky(2, outer));
  }
}

/* The second difference matrix of n rows has the eigenvalues 2 - 2 cos(k pi / (n + 1)). */
static void TestEigenRange(void)
{
  for (PetscInt n = 1; n <= DENSE_MAX; n++) {
    PetscReal A[DENSE_MAX * DENSE_MAX] = {0.}, smallest, largest;

    for (PetscInt i = 0; i < n; i++) {
      A[i * n + i] = 2.;
      if (i > 0) A[i * n + i - 1] = A[(i - 1) * n + i] = -1.;
    }
    DenseEigenRange(n, A, &smallest, &largest);
    CHECK_NEAR(smallest, 2. - 2. * PetscCosReal(PETSC_PI / (n + 1.)), EXACT);
    CHECK_NEAR(largest, 2. - 2. * PetscCosReal(n * PETSC_PI / (n + 1.)), EXACT);
  }
}

/* All eigenvalues, the largest first: their sum, the sum of their squares and their product are those of the
   matrix. Of a matrix with a double one they are known. */
static void TestEigenvalues(void)
{
  const PetscReal twice[] = {2., 1., 1., 1., 2., 1., 1., 1., 2.}; /* 4, 1, 1 */
  PetscReal       values[DENSE_MAX];

  DenseEigenvalues(3, twice, values);
  CHECK_NEAR(values[0], 4., EXACT);
  CHECK_NEAR(values[1], 1., EXACT);
  CHECK_NEAR(values[2], 1., EXACT);
  for (PetscInt n = 1; n <= DENSE_MAX; n++) {
    PetscReal A[DENSE_MAX * DENSE_MAX], trace = 0., squares = 0., size;

    RandomDefinite(n, A);
    DenseEigenvalues(n, A, values);
    size = values[0] * n;
    for (PetscInt i = 0; i < n; i++) {
      CHECK(i == 0 || values[i] <= values[i - 1]);
      trace += A[i * n + i] - values[i];
      squares -= values[i] * values[i];
      for (PetscInt j = 0; j < n; j++) squares += A[i * n + j] * A[i * n + j];
    }
    CHECK_NEAR(trace / size, 0., EXACT);
    CHECK_NEAR(squares / (size * size), 0., EXACT);
  }
}

/* A = V diag(values) V' with V'V = I; a diagonal matrix keeps its axes. */
static void TestEigen(void)
{
  for (PetscInt n = 1; n <= DENSE_MAX; n++) {
    PetscReal A[DENSE_MAX * DENSE_MAX], B[DENSE_MAX * DENSE_MAX], values[DENSE_MAX], V[DENSE_MAX * DENSE_MAX];

    RandomDefinite(n, A);
    for (PetscInt i = 0; i < n * n; i++) B[i] = A[i];
    DenseEigen(n, B, values, V);
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt j = 0; j < n; j++) {
        PetscReal product = 0., unit = 0.;

        for (PetscInt k = 0; k < n; k++) product += V[i * n + k] * values[k] * V[j * n + k];
        for (PetscInt k = 0; k < n; k++) unit += V[k * n + i] * V[k * n + j];
        CHECK_NEAR(product, A[i * n + j], 1e-12);
        CHECK_NEAR(unit, i == j, EXACT);
      }
    }
    for (PetscInt i = 0; i < n * n; i++) B[i] = i / n == i % n ? (PetscReal)(n - i / n) : 0.;
    DenseEigen(n, B, values, V);
    for (PetscInt i = 0; i < n * n; i++) CHECK(V[i] == (i / n == i % n) && values[i / n] == n - i / n);
  }
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestSolve();
  TestRefusal();
  TestEigenRange();
  TestEigenvalues();
  TestEigen();
  PetscCall(PetscFinalize());
  return 0;
}
