/* test_dual.c -- closed forms of the dual basis, and biorthogonality on random covered parts. */
#include <mortise/dual.h>
#include <mortise/element.h>
#include <test.h>

#include "uniform.h"

static const PetscReal EXACT = 1e-13;

enum { MAX_NODES = 4, MAX_POINTS = 64 };

/* Points on the part [a,b] of a line of length 1. */
static PetscInt LinePoints(PetscReal a, PetscReal b, PetscReal phi[], PetscReal w[])
{
  PetscReal      points[8];
  const PetscInt n = GaussLine(2, points, w);

  for (PetscInt q = 0; q < n; q++) {
    const PetscReal xi = a + (b - a) * points[q];

    ElementShape(ELEMENT_LINE2, &xi, &phi[2 * q], NULL);
    w[q] *= b - a;
  }
  return n;
}

/* Full coverage of affine facets of measure 1 (1/2 for the triangle). */
static void TestFull(ElementType type, const PetscReal expected[], PetscReal D_expected)
{
  const PetscInt n = ElementNumNodes(type), dim = ElementDim(type);
  PetscReal      points[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[MAX_NODES * ELEMENT_MAX_POINTS], A[16],
      D[MAX_NODES];
  const PetscInt num_points = ElementQuadrature(type, 2, points, w);

  for (PetscInt q = 0; q < num_points; q++) ElementShape(type, &points[q * dim], &phi[q * n], NULL);
  CHECK(DualBasis(n, num_points, phi, w, A, D));
  for (PetscInt i = 0; i < n; i++) {
    CHECK_NEAR(D[i], D_expected, EXACT);
    for (PetscInt j = 0; j < n; j++) CHECK_NEAR(A[i * n + j], expected[i * n + j], EXACT);
  }
}

/* Lines covered on [1/4,1] and on [0,1/2]. */
static void TestCut(void)
{
  const PetscReal right[] = {3.5, -1.5, -2.5, 2.5}, left[] = {3., -6., -2., 7.};
  PetscReal       phi[16], w[8], A[4], D[2];

  CHECK(DualBasis(2, LinePoints(0.25, 1., phi, w), phi, w, A, D));
  CHECK_NEAR(D[0], 9. / 32., EXACT);
  CHECK_NEAR(D[1], 15. / 32., EXACT);
  for (PetscInt i = 0; i < 4; i++) CHECK_NEAR(A[i], right[i], EXACT);
  CHECK(DualBasis(2, LinePoints(0., 0.5, phi, w), phi, w, A, D));
  CHECK_NEAR(D[0], 3. / 8., EXACT);
  CHECK_NEAR(D[1], 1. / 8., EXACT);
  for (PetscInt i = 0; i < 4; i++) CHECK_NEAR(A[i], left[i], EXACT);
}

/* Covered on [0,e], det M_e = e^4/12: badly scaled for small e but never singular.
   The inverse of M_e in closed form has the entries 4/e, (4 - 6/e)/e and (4 - 12/e + 12/e^2)/e. */
static void TestSliver(void)
{
  const PetscReal covered[] = {1., 0.1, 1e-3, 1e-6, 1e-9};

  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(covered); k++) {
    const PetscReal e = covered[k], a = 4., b = 4. - 6. / e, c = 4. - 12. / e + 12. / (e * e);
    const PetscReal expected[] = {(1. - e / 2.) * a, (1. - e / 2.) * b, (e / 2.) * b, (e / 2.) * c};
    PetscReal       phi[16], w[8], A[4], D[2];

    CHECK(DualBasis(2, LinePoints(0., e, phi, w), phi, w, A, D));
    CHECK_NEAR(D[0] / e, 1. - e / 2., EXACT);
    CHECK_NEAR(D[1] / e, e / 2., EXACT);
    for (PetscInt i = 0; i < 4; i++) CHECK_NEAR(A[i] / expected[i], 1., 1e-12);
  }
}

static void TestSingular(void)
{
  const PetscReal one_point[] = {0.25, 0.75}, w[] = {1.}, no_weight[] = {0.};
  PetscReal       A[4], D[2];

  CHECK(!DualBasis(2, 0, NULL, NULL, A, D));
  CHECK_NEAR(D[0], 0., 0.);
  CHECK(!DualBasis(2, 1, one_point, w, A, D)); /* one point cannot tell two functions apart */
  CHECK_NEAR(D[1], 0.75, 0.);                  /* the integrals are good all the same */
  CHECK(!DualBasis(2, 1, one_point, no_weight, A, D));
}

/* Random points with random weights stand for any rule on any covered part:
   int psi_i phi_j = delta_ij int phi_j and sum_i psi_i = 1, because both use the same points. */
static void TestBiorthogonality(ElementType type)
{
  const PetscInt n = ElementNumNodes(type);

  for (PetscInt trial = 0; trial < 200; trial++) {
    const PetscInt num_points = 12 + trial % 50;
    PetscReal      phi[MAX_NODES * MAX_POINTS], w[MAX_POINTS], A[MAX_NODES * MAX_NODES], D[MAX_NODES];
    PetscReal      product[MAX_NODES * MAX_NODES] = {0.};

    for (PetscInt q = 0; q < num_points; q++) {
      const PetscReal xi[2] = {Uniform(0., 0.5), Uniform(0., 0.5)};

      ElementShape(type, xi, &phi[q * n], NULL);
      w[q] = Uniform(0.5, 1.) / num_points;
    }
    CHECK(DualBasis(n, num_points, phi, w, A, D));
    for (PetscInt q = 0; q < num_points; q++) {
      PetscReal psi[MAX_NODES], sum = 0., size = 0.;

      DualEvaluate(n, A, &phi[q * n], psi);
      for (PetscInt i = 0; i < n; i++) {
        sum += psi[i];
        size += PetscAbsReal(psi[i]); /* large functions cancel to 1 where a small part is covered */
        for (PetscInt j = 0; j < n; j++) product[i * n + j] += w[q] * psi[i] * phi[q * n + j];
      }
      CHECK_NEAR(sum, 1., EXACT * size);
    }
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt j = 0; j < n; j++) CHECK_NEAR(product[i * n + j], i == j ? D[i] : 0., EXACT);
    }
  }
}

int main(int argc, char **argv)
{
  const PetscReal line[] = {2., -1., -1., 2.}, triangle[] = {3., -1., -1., -1., 3., -1., -1., -1., 3.};
  const PetscReal quad[] = {4., -2., 1., -2., -2., 4., -2., 1., 1., -2., 4., -2., -2., 1., -2., 4.};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestFull(ELEMENT_LINE2, line, 1. / 2.);
  TestFull(ELEMENT_TRI3, triangle, 1. / 6.);
  TestFull(ELEMENT_QUAD4, quad, 1. / 4.);
  TestCut();
  TestSliver();
  TestSingular();
  TestBiorthogonality(ELEMENT_LINE2);
  TestBiorthogonality(ELEMENT_TRI3);
  TestBiorthogonality(ELEMENT_QUAD4);
  PetscCall(PetscFinalize());
  return 0;
}
