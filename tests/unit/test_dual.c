/* test_dual.c -- closed forms of the dual basis, and biorthogonality on random covered parts. */
#include "kernel/dual.h"
#include "kernel/element.h"
#include <test.h>

#include "uniform.h"

static const PetscReal EXACT = 1e-13;

enum { MAX_POINTS = 64 };

/* Points on the part [a,b] of a line of length 1. */
static PetscInt LinePoints(PetscReal a, PetscReal b, PetscReal xi[], PetscReal w[])
{
  PetscReal      points[8];
  const PetscInt n = QuadratureLine(3, points, w);

  for (PetscInt q = 0; q < n; q++) {
    xi[2 * q]     = a + (b - a) * points[q];
    xi[2 * q + 1] = 0.;
    w[q] *= b - a;
  }
  return n;
}

/* A_ij = psi_i(node j). */
static void Matrix(const DualBasis *basis, PetscReal A[])
{
  const PetscInt n = ElementNumNodes(basis->type);

  for (PetscInt j = 0; j < n; j++) {
    PetscReal psi[DUAL_MAX];

    DualBasisEvaluate(basis, ElementNode(basis->type, j), psi);
    for (PetscInt i = 0; i < n; i++) A[i * n + j] = psi[i];
  }
}

/* Full coverage of affine facets of measure 1 (1/2 for the triangle). [in] expected - A [n][n]; D - [n] */
static void TestFull(ElementType type, const PetscReal expected[], const PetscReal D[])
{
  const PetscInt n = ElementNumNodes(type), dim = ElementDim(type);
  PetscReal      points[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], xi[2 * ELEMENT_MAX_POINTS] = {0.};
  PetscReal      A[DUAL_MAX * DUAL_MAX];
  const PetscInt num_points = QuadratureRule(type, 2 * ElementOrder(type), points, w);
  DualBasis      basis;

  for (PetscInt q = 0; q < num_points; q++) {
    for (PetscInt k = 0; k < dim; k++) xi[2 * q + k] = points[q * dim + k];
  }
  CHECK(DualBasisCreate(type, num_points, xi, w, NULL, &basis));
  Matrix(&basis, A);
  for (PetscInt i = 0; i < n; i++) {
    CHECK_NEAR(basis.D[i], D[i], EXACT);
    for (PetscInt j = 0; j < n; j++) CHECK_NEAR(A[i * n + j], expected[i * n + j], EXACT);
  }
}

/* Lines covered on [1/4,1] and on [0,1/2]. */
static void TestCut(void)
{
  const PetscReal right[] = {3.5, -1.5, -2.5, 2.5}, left[] = {3., -6., -2., 7.};
  PetscReal       xi[16], w[8], A[4];
  DualBasis       basis;

  CHECK(DualBasisCreate(ELEMENT_LINE2, LinePoints(0.25, 1., xi, w), xi, w, NULL, &basis));
  Matrix(&basis, A);
  CHECK_NEAR(basis.D[0], 9. / 32., EXACT);
  CHECK_NEAR(basis.D[1], 15. / 32., EXACT);
  for (PetscInt i = 0; i < 4; i++) CHECK_NEAR(A[i], right[i], EXACT);
  CHECK(DualBasisCreate(ELEMENT_LINE2, LinePoints(0., 0.5, xi, w), xi, w, NULL, &basis));
  Matrix(&basis, A);
  CHECK_NEAR(basis.D[0], 3. / 8., EXACT);
  CHECK_NEAR(basis.D[1], 1. / 8., EXACT);
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
    PetscReal       xi[16], w[8], A[4];
    DualBasis       basis;

    CHECK(DualBasisCreate(ELEMENT_LINE2, LinePoints(0., e, xi, w), xi, w, NULL, &basis));
    Matrix(&basis, A);
    CHECK_NEAR(basis.D[0] / e, 1. - e / 2., EXACT);
    CHECK_NEAR(basis.D[1] / e, e / 2., EXACT);
    for (PetscInt i = 0; i < 4; i++) CHECK_NEAR(A[i] / expected[i], 1., 1e-12);
  }
}

/* A quadratic line covered on a small part at its beginning or inside. M_e has a condition of e^-4, but the
   polynomials keep their accuracy. psi_i is D_i times the function that gives values at the node i: psi_i =
   D_i sum_k p_k(node i) p_k with Legendre's polynomials on the part. D is in closed form, negative at the far
   end. */
static void TestQuadraticSliver(PetscReal begin)
{
  const PetscReal covered[] = {0.25, 0.1, 1e-2, 1e-4, 1e-6, 1e-8};

  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(covered); k++) {
    const PetscReal end = begin + covered[k], e = end - begin,
                    s[]   = {begin + 0.1 * e, begin + 0.5 * e, begin + 0.9 * e};
    const PetscReal D_end = -e * (begin + end) / 2. + 2. / 3. * e * (begin * begin + begin * end + end * end);
    /* the places of the points are rounded: a share of the part that grows as it shrinks */
    const PetscReal tolerance = 1e-12 + 20. * PETSC_MACHINE_EPSILON * begin / e;
    PetscReal       xi[16], w[8];
    DualBasis       basis;

    CHECK(DualBasisCreate(ELEMENT_LINE3, LinePoints(begin, end, xi, w), xi, w, NULL, &basis));
    CHECK_NEAR(basis.D[1] / D_end, 1., tolerance);
    for (PetscInt q = 0; q < 3; q++) {
      const PetscReal t = 2. * (s[q] - begin) / e - 1., at[2] = {s[q], 0.};
      PetscReal       psi[3], sum = 0., size = 0.;

      DualBasisEvaluate(&basis, at, psi);
      for (PetscInt i = 0; i < 3; i++) {
        const PetscReal T        = 2. * (ElementNode(ELEMENT_LINE3, i)[0] - begin) / e - 1.;
        const PetscReal legendre = 1. + 3. * T * t + 5. / 4. * (3. * T * T - 1.) * (3. * t * t - 1.);
        const PetscReal largest  = 1. + 3. * PetscAbsReal(T) + 5. * (3. * T * T + 1.);

        CHECK_NEAR(psi[i], basis.D[i] / e * legendre, tolerance * PetscAbsReal(basis.D[i] / e) * largest);
        sum += psi[i];
        size += PetscAbsReal(psi[i]);
      }
      CHECK_NEAR(sum, 1., 1e-12 * size);
    }
  }
}

static void TestSingular(void)
{
  const PetscReal one_point[] = {0.75, 0.}, two_points[] = {0.25, 0., 0.75, 0.}, w[] = {1., 1.}, no_weight[] = {0., 0.};
  DualBasis       basis;

  CHECK(!DualBasisCreate(ELEMENT_LINE2, 0, NULL, NULL, NULL, &basis));
  CHECK_NEAR(basis.D[0], 0., 0.);
  CHECK(!DualBasisCreate(ELEMENT_LINE2, 1, one_point, w, NULL, &basis)); /* one point cannot tell two functions apart */
  CHECK_NEAR(basis.D[1], 0.75, 0.);                                      /* the integrals are good all the same */
  CHECK(!DualBasisCreate(ELEMENT_LINE3, 2, two_points, w, NULL, &basis));
  CHECK(!DualBasisCreate(ELEMENT_LINE2, 2, two_points, no_weight, NULL, &basis));
}

/* Random points with random weights stand for any rule on any covered part:
   int psi_i phi_j = delta_ij int phi_j and sum_i psi_i = 1, because both use the same points. */
static void TestBiorthogonality(ElementType type)
{
  const PetscInt n = ElementNumNodes(type);

  for (PetscInt trial = 0; trial < 200; trial++) {
    const PetscInt num_points = 12 + trial % 50;
    PetscReal      xi[2 * MAX_POINTS], w[MAX_POINTS], product[DUAL_MAX * DUAL_MAX] = {0.}, largest = 0.;
    DualBasis      basis;

    for (PetscInt q = 0; q < num_points; q++) {
      for (PetscInt k = 0; k < 2; k++) xi[2 * q + k] = Uniform(0., 0.5);
      w[q] = Uniform(0.5, 1.) / num_points;
    }
    CHECK(DualBasisCreate(type, num_points, xi, w, NULL, &basis));
    for (PetscInt q = 0; q < num_points; q++) {
      PetscReal psi[DUAL_MAX], phi[DUAL_MAX], sum = 0., size = 0.;

      DualBasisEvaluate(&basis, &xi[2 * q], psi);
      ElementShape(type, &xi[2 * q], phi, NULL);
      DualShape(type, phi);
      for (PetscInt i = 0; i < n; i++) {
        sum += psi[i];
        size += PetscAbsReal(psi[i]); /* large functions cancel to 1 where a small part is covered */
        for (PetscInt j = 0; j < n; j++) product[i * n + j] += w[q] * psi[i] * phi[j];
      }
      CHECK_NEAR(sum, 1., EXACT * size);
      largest = PetscMax(largest, size);
    }
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt j = 0; j < n; j++) CHECK_NEAR(product[i * n + j], i == j ? basis.D[i] : 0., EXACT * largest);
    }
  }
}

/* A of tri6, psi = A phi~, by hand for the vertex row; D; sum phi~ = 1; phi~ tells u from u~. */
static void TestTransformed(void)
{
  const PetscReal row[6] = {24. / 5., 4. / 5., 4. / 5., -11. / 5., 4. / 5., -11. / 5.}, a = DualShare(ELEMENT_TRI6);
  PetscReal       points[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], u[6], transformed[6];
  const PetscInt  num_points = QuadratureRule(ELEMENT_TRI6, 4, points, w);
  DualBasis       basis;

  CHECK_NEAR(a, 0.2, 0.);
  CHECK(DualBasisCreate(ELEMENT_TRI6, num_points, points, w, NULL, &basis));
  for (PetscInt i = 0; i < 6; i++) CHECK_NEAR(basis.D[i], 0.5 * (i < 3 ? 2. / 15. : 1. / 5.), EXACT);
  for (PetscInt i = 0; i < 6; i++) transformed[i] = Uniform(-1., 1.);
  for (PetscInt i = 0; i < 6; i++)
    u[i] =
        i < 3 ? transformed[i] : (1. - 2. * a) * transformed[i] + a * (transformed[i - 3] + transformed[(i - 2) % 3]);
  for (PetscInt trial = 0; trial < 100; trial++) {
    const PetscReal xi[2] = {Uniform(0., 0.5), Uniform(0., 0.5)};
    PetscReal       phi[6], psi[DUAL_MAX], sum = 0., difference = 0., expected = 0.;

    ElementShape(ELEMENT_TRI6, xi, phi, NULL);
    for (PetscInt i = 0; i < 6; i++) difference += u[i] * phi[i];
    DualShape(ELEMENT_TRI6, phi);
    DualBasisEvaluate(&basis, xi, psi);
    for (PetscInt i = 0; i < 6; i++) {
      sum += phi[i];
      difference -= transformed[i] * phi[i];
      expected += row[i] * phi[i];
    }
    CHECK_NEAR(sum, 1., EXACT);
    CHECK_NEAR(difference, 0., EXACT);
    CHECK_NEAR(psi[0], expected, 10. * EXACT);
  }
}

/* Every other type is left as it is. */
static void TestUntransformed(ElementType type)
{
  const PetscReal xi[2] = {0.3, 0.2};
  PetscReal       phi[DUAL_MAX], same[DUAL_MAX];

  ElementShape(type, xi, phi, NULL);
  ElementShape(type, xi, same, NULL);
  DualShape(type, same);
  CHECK_NEAR(DualShare(type), 0., 0.);
  for (PetscInt i = 0; i < ElementNumNodes(type); i++) CHECK_NEAR(same[i], phi[i], 0.);
}

/* The edge from corner 0 to corner 1 is a half of an edge that ends at (2, 0), on which corner 1 hangs. Functions of
   the mesh are those of the whole edge. */
static void TestHanging(ElementType type)
{
  const PetscInt n = ElementNumNodes(type);
  PetscReal      xi[2 * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], sums[DUAL_MAX][DUAL_MAX] = {{0.}};
  const PetscInt num   = QuadratureRule(type, 2 * ElementOrder(type), xi, w);
  DualNodes      nodes = {.S = {0.}};
  DualBasis      basis;

  for (PetscInt i = 0; i < n; i++) {
    nodes.S[i * n + i] = 1.;
    for (PetscInt k = 0; k < 2; k++) nodes.place[i][k] = ElementNode(type, i)[k];
  }
  if (n == 4) {
    nodes.place[1][0]  = 2.;
    nodes.S[1 * n + 0] = nodes.S[1 * n + 1] = .5;
  } else { // its middle is corner 1; node 4, at a quarter of the whole, gives its place to the end
    nodes.place[4][0]  = 2.;
    nodes.S[4 * n + 0] = 3. / 8.;
    nodes.S[4 * n + 1] = 3. / 4.;
    nodes.S[4 * n + 4] = -1. / 8.;
  }
  CHECK(DualBasisCreate(type, num, xi, w, &nodes, &basis));
  for (PetscInt q = 0; q < num; q++) {
    PetscReal phi[DUAL_MAX], psi[DUAL_MAX], sum = 0.;

    ElementShape(type, &xi[2 * q], phi, NULL);
    DualNodesApply(n, &nodes, phi);
    DualBasisEvaluate(&basis, &xi[2 * q], psi);
    for (PetscInt i = 0; i < n; i++) {
      sum += psi[i];
      for (PetscInt j = 0; j < n; j++) sums[i][j] += w[q] * psi[i] * phi[j];
    }
    CHECK_NEAR(sum, 1., 1e-12);
  }
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = 0; j < n; j++) CHECK_NEAR(sums[i][j], i == j ? basis.D[i] : 0., EXACT);
  }
  CHECK_NEAR(basis.D[n == 4 ? 1 : 4], n == 4 ? 1. / 8. : -1. / 72., EXACT); // of the node outside
}

int main(int argc, char **argv)
{
  const PetscReal line[] = {2., -1., -1., 2.}, triangle[] = {3., -1., -1., -1., 3., -1., -1., -1., 3.};
  const PetscReal quad[] = {4., -2., 1., -2., -2., 4., -2., 1., 1., -2., 4., -2., -2., 1., -2., 4.};

  const PetscReal curve[]  = {1.5, 0.5, -0.25, 0.5, 1.5, -0.25, -1., -1., 1.5};
  const PetscReal halves[] = {1. / 2., 1. / 2.}, sixths[] = {1. / 6., 1. / 6., 1. / 6.};
  const PetscReal quarters[] = {1. / 4., 1. / 4., 1. / 4., 1. / 4.}, simpson[] = {1. / 6., 1. / 6., 2. / 3.};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestFull(ELEMENT_LINE2, line, halves);
  TestFull(ELEMENT_TRI3, triangle, sixths);
  TestFull(ELEMENT_QUAD4, quad, quarters);
  TestFull(ELEMENT_LINE3, curve, simpson);
  TestCut();
  TestSliver();
  TestQuadraticSliver(0.);
  TestQuadraticSliver(0.3);
  TestSingular();
  TestBiorthogonality(ELEMENT_LINE2);
  TestBiorthogonality(ELEMENT_TRI3);
  TestBiorthogonality(ELEMENT_QUAD4);
  TestBiorthogonality(ELEMENT_LINE3);
  TestBiorthogonality(ELEMENT_TRI6);
  TestBiorthogonality(ELEMENT_QUAD9);
  TestHanging(ELEMENT_QUAD4);
  TestHanging(ELEMENT_QUAD9);
  TestTransformed();
  TestUntransformed(ELEMENT_LINE3);
  TestUntransformed(ELEMENT_TRI3);
  TestUntransformed(ELEMENT_QUAD4);
  TestUntransformed(ELEMENT_QUAD9);
  PetscCall(PetscFinalize());
  return 0;
}
