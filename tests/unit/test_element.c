/* test_element.c -- shape functions, quadrature, geometry, strains; the stiffness of one cell built from them. */
#include <mortise/compat.h>
#include <mortise/element.h>
#include <mortise/material.h>
#include <petscdt.h>
#include <test.h>

#include "uniform.h"

static const PetscReal EXACT = 1e-13;

enum { NUM_TRIALS = 500, MAX_DIM = 2, MAX_DOFS = ELEMENT_MAX_NODES * MAX_DIM, NUM_STRAINS = 3 };

static const PetscReal CORNERS[ELEMENT_COUNT][ELEMENT_MAX_NODES * MAX_DIM] = {
    {0., 1.}, {0., 0., 1., 0., 0., 1.}, {0., 0., 1., 0., 1., 1., 0., 1.}};

/* A point of the reference cell. */
static void RandomPoint(ElementType type, PetscReal xi[])
{
  do {
    for (PetscInt k = 0; k < ElementDim(type); k++) xi[k] = Uniform(0., 1.);
  } while (type == ELEMENT_TRI3 && xi[0] + xi[1] > 1.);
}

/* The reference cell with its nodes shaken, turned and stretched up to 10^decades times, but not tangled. */
static void RandomCell(ElementType type, PetscReal decades, PetscReal X[])
{
  const PetscInt dim = ElementDim(type);
  PetscReal      stretch, turn;

  do {
    stretch = PetscPowReal(10., Uniform(-decades, decades));
    turn    = Uniform(0., 2. * PETSC_PI);
    for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
      const PetscReal x = CORNERS[type][i * dim] + Uniform(-0.4, 0.4);
      const PetscReal y = dim == 2 ? stretch * (CORNERS[type][i * dim + 1] + Uniform(-0.4, 0.4)) : 0.;

      X[i * dim] = dim == 2 ? PetscCosReal(turn) * x - PetscSinReal(turn) * y : x;
      if (dim == 2) X[i * dim + 1] = PetscSinReal(turn) * x + PetscCosReal(turn) * y;
    }
  } while (ElementMinJacobian(type, X) < 0.05 * (dim == 2 ? stretch : 1.));
}

/* The area inside a polygon run anticlockwise. */
static PetscReal PolygonArea(PetscInt n, const PetscReal X[])
{
  PetscReal area = 0.;

  for (PetscInt i = 0; i < n; i++) {
    const PetscReal *a = &X[2 * i], *b = &X[2 * ((i + 1) % n)];

    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return area;
}

static void TestTable(void)
{
  const char    *names[] = {"line2", "tri3", "quad4"};
  const PetscInt dims[] = {1, 2, 2}, nodes[] = {2, 3, 4}, facets[] = {2, 3, 4};

  for (PetscInt t = 0; t < ELEMENT_LINE3; t++) {
    PetscBool same;

    PetscCallAbort(PETSC_COMM_SELF, PetscStrcmp(ElementName((ElementType)t), names[t], &same));
    CHECK(same);
    CHECK(ElementDim((ElementType)t) == dims[t]);
    CHECK(ElementNumNodes((ElementType)t) == nodes[t]);
    CHECK(ElementNumFacets((ElementType)t) == facets[t]);
    CHECK(ElementFacetType((ElementType)t) == (dims[t] == 2 ? ELEMENT_LINE2 : ELEMENT_COUNT));
  }
}

/* Facets run around the cell with the normal (dy,-dx) outward: sum int x.n = 2 area of any cell, sum int n = 0. */
static void TestFacets(ElementType type)
{
  PetscReal X[MAX_DOFS], flux = 0., closed[2] = {0., 0.};

  RandomCell(type, 0., X);
  for (PetscInt f = 0; f < ElementNumFacets(type); f++) {
    const PetscInt  *nodes = ElementFacetNodes(type, f);
    const PetscReal *a = &X[2 * nodes[0]], *b = &X[2 * nodes[1]], normal[2] = {b[1] - a[1], a[0] - b[0]};

    flux += 0.5 * ((a[0] + b[0]) * normal[0] + (a[1] + b[1]) * normal[1]);
    for (PetscInt k = 0; k < 2; k++) closed[k] += normal[k];
  }
  CHECK_NEAR(flux / PolygonArea(ElementNumNodes(type), X), 2., EXACT);
  for (PetscInt k = 0; k < 2; k++) CHECK_NEAR(closed[k], 0., EXACT);
}

/* One at the own node, zero at the others; sum 1; derivatives by central differences, exact for these polynomials. */
static void TestShape(ElementType type)
{
  const PetscInt  n = ElementNumNodes(type), dim = ElementDim(type);
  const PetscReal h = 0.25;
  PetscReal xi[MAX_DIM], phi[ELEMENT_MAX_NODES], dphi[MAX_DOFS], plus[ELEMENT_MAX_NODES], minus[ELEMENT_MAX_NODES];

  for (PetscInt node = 0; node < n; node++) {
    ElementShape(type, &CORNERS[type][node * dim], phi, NULL);
    for (PetscInt i = 0; i < n; i++) CHECK_NEAR(phi[i], i == node ? 1. : 0., 0.);
  }
  for (PetscInt trial = 0; trial < NUM_TRIALS; trial++) {
    PetscReal sum = 0.;

    RandomPoint(type, xi);
    ElementShape(type, xi, phi, dphi);
    for (PetscInt i = 0; i < n; i++) sum += phi[i];
    CHECK_NEAR(sum, 1., 4. * PETSC_MACHINE_EPSILON);
    for (PetscInt k = 0; k < dim; k++) {
      PetscReal shifted[MAX_DIM] = {xi[0], dim == 2 ? xi[1] : 0.};

      shifted[k] = xi[k] + h;
      ElementShape(type, shifted, plus, NULL);
      shifted[k] = xi[k] - h;
      ElementShape(type, shifted, minus, NULL);
      for (PetscInt i = 0; i < n; i++) CHECK_NEAR(dphi[i * dim + k], (plus[i] - minus[i]) / (2. * h), EXACT);
    }
  }
}

/* int x^a y^b over the reference cell: a! b!/(a+b+2)! on the triangle, 1/((a+1)(b+1)) on the square. */
static PetscReal MonomialIntegral(ElementType type, PetscInt a, PetscInt b)
{
  PetscReal value = 1.;

  if (type != ELEMENT_TRI3) return 1. / ((a + 1.) * (b + 1.));
  for (PetscInt k = 1; k <= b; k++) value *= k / (PetscReal)(a + k);
  return value / ((a + b + 1.) * (a + b + 2.));
}

static void TestQuadrature(ElementType type, PetscInt highest)
{
  const PetscInt dim = ElementDim(type);
  PetscReal      points[ELEMENT_MAX_POINTS * MAX_DIM], weights[ELEMENT_MAX_POINTS];

  for (PetscInt degree = 0; degree <= highest; degree++) {
    const PetscInt n = ElementQuadrature(type, degree, points, weights);

    CHECK(n > 0 && n <= ELEMENT_MAX_POINTS);
    for (PetscInt a = 0; a <= degree; a++) {
      const PetscInt b_last = type == ELEMENT_TRI3 ? degree - a : degree;

      for (PetscInt b = 0; b <= (dim == 2 ? b_last : 0); b++) {
        PetscReal sum = 0.;

        for (PetscInt q = 0; q < n; q++) {
          PetscReal value = weights[q];

          CHECK(weights[q] > 0. && points[q * dim] > 0. && points[q * dim] < 1.);
          for (PetscInt k = 0; k < a; k++) value *= points[q * dim];
          for (PetscInt k = 0; k < b; k++) value *= points[q * dim + 1];
          sum += value;
        }
        CHECK_NEAR(sum, MonomialIntegral(type, a, b), 1e-15);
      }
    }
  }
  CHECK(ElementQuadrature(type, highest + 1, points, weights) == 0);
  CHECK(ElementQuadrature(type, ElementStiffnessDegree(type), points, weights) == (type == ELEMENT_QUAD4 ? 4 : 1));
}

static PetscErrorCode TestGauss(void)
{
  PetscReal points[8], weights[8], petsc_points[8], petsc_weights[8];

  PetscFunctionBeginUser;
  for (PetscInt n = 1; n <= 8; n++) {
    CHECK(GaussLine(n, points, weights) == n);
    PetscCall(PetscDTGaussQuadrature(n, 0., 1., petsc_points, petsc_weights));
    for (PetscInt i = 0; i < n; i++) {
      CHECK_NEAR(points[i], petsc_points[i], 1e-15);
      CHECK_NEAR(weights[i], petsc_weights[i], 2e-15);
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A linear field on any cell: its value and its gradient come back; int det J = area. */
static void TestMap(ElementType type)
{
  const PetscInt  n = ElementNumNodes(type), dim = ElementDim(type);
  const PetscReal slope[2] = {0.7, dim == 2 ? -1.3 : 0.};

  for (PetscInt trial = 0; trial < NUM_TRIALS; trial++) {
    PetscReal X[MAX_DOFS], points[2 * ELEMENT_MAX_POINTS], weights[ELEMENT_MAX_POINTS], area = 0.;
    PetscInt  num_points = ElementQuadrature(type, 2, points, weights);

    RandomCell(type, 0., X);
    for (PetscInt q = 0; q < num_points; q++) {
      PetscReal x[MAX_DIM], phi[ELEMENT_MAX_NODES], grad[MAX_DOFS], value = 0., gradient[MAX_DIM] = {0.};

      area += weights[q] * ElementMap(type, X, &points[q * dim], x, phi, grad);
      for (PetscInt i = 0; i < n; i++) {
        const PetscReal u = slope[0] * X[i * dim] + (dim == 2 ? slope[1] * X[i * dim + 1] : 0.);

        value += phi[i] * u;
        for (PetscInt k = 0; k < dim; k++) gradient[k] += grad[i * dim + k] * u;
      }
      CHECK_NEAR(value, slope[0] * x[0] + (dim == 2 ? slope[1] * x[1] : 0.), EXACT);
      for (PetscInt k = 0; k < dim; k++) CHECK_NEAR(gradient[k], slope[k], EXACT);
    }
    if (dim == 2) CHECK_NEAR(area / PolygonArea(n, X), 1., EXACT);
  }
}

static void TestMinJacobian(void)
{
  const PetscReal triangle[] = {0., 0., 2., 0., 0., 3.}, clockwise[] = {0., 0., 0., 3., 2., 0.};
  const PetscReal flat[] = {0., 0., 1., 0., 2., 0.}, trapezoid[] = {0., 0., 2., 0., 1., 1., 0., 1.};
  const PetscReal bow_tie[] = {0., 0., 1., 0., 0., 1., 1., 1.}, dart[] = {0., 0., 1., 0., 0.2, 0.2, 0., 1.};
  const PetscReal line[] = {1., 4.};

  CHECK_NEAR(ElementMinJacobian(ELEMENT_LINE2, line), 3., 0.);
  CHECK_NEAR(ElementMinJacobian(ELEMENT_TRI3, triangle), 6., EXACT);
  CHECK_NEAR(ElementMinJacobian(ELEMENT_TRI3, clockwise), -6., EXACT);
  CHECK_NEAR(ElementMinJacobian(ELEMENT_TRI3, flat), 0., 0.);
  CHECK_NEAR(ElementMinJacobian(ELEMENT_QUAD4, trapezoid), 1., EXACT); /* at the short side */
  CHECK(ElementMinJacobian(ELEMENT_QUAD4, bow_tie) < 0.);
  CHECK(ElementMinJacobian(ELEMENT_QUAD4, dart) < 0.); /* not convex */
}

/* Points put into random cells are found where they were put; random points are found exactly where the half planes of
   the facets say inside. */
static void TestLocate(ElementType type)
{
  const PetscInt  n = ElementNumNodes(type), dim = ElementDim(type);
  const PetscReal tolerance = 1e-8;

  for (PetscInt trial = 0; trial < 20 * NUM_TRIALS; trial++) {
    PetscReal X[MAX_DOFS], xi[MAX_DIM], found[MAX_DIM], x[MAX_DIM], phi[ELEMENT_MAX_NODES];
    PetscInt  a = (PetscInt)Uniform(0., n), b = (PetscInt)Uniform(0., n);
    PetscBool inside = PETSC_TRUE;

    RandomCell(type, 3., X);
    RandomPoint(type, xi);
    ElementMap(type, X, xi, x, phi, NULL);
    CHECK(ElementLocate(type, X, x, tolerance, found));
    for (PetscInt k = 0; k < dim; k++) CHECK_NEAR(found[k], xi[k], 1e-9);
    CHECK(ElementLocate(type, X, &X[a * dim], tolerance, found)); /* corners belong to the cell */
    for (PetscInt k = 0; k < dim; k++) CHECK_NEAR(found[k], CORNERS[type][a * dim + k], 1e-9);

    for (PetscInt k = 0; k < dim; k++)
      x[k] = X[a * dim + k] + Uniform(-2., 2.) * (X[b * dim + k] - X[a * dim + k] + 0.5);
    for (PetscInt f = 0; f < ElementNumFacets(type) && dim == 2; f++) {
      const PetscReal *p = &X[2 * ElementFacetNodes(type, f)[0]], *q = &X[2 * ElementFacetNodes(type, f)[1]];

      if ((q[0] - p[0]) * (x[1] - p[1]) < (q[1] - p[1]) * (x[0] - p[0])) inside = PETSC_FALSE;
    }
    if (dim == 1) inside = x[0] >= X[0] && x[0] <= X[1] ? PETSC_TRUE : PETSC_FALSE;
    CHECK(ElementLocate(type, X, x, 1e-12, found) == inside);
  }
}

static void TestLocateTolerance(void)
{
  const PetscReal X[] = {0., 0., 100., 0., 100., 100., 0., 100.}, outside[] = {-1e-4, 50.}, far[] = {1e30, -1e30};
  const PetscReal flat[] = {0., 0., 1., 0., 2., 0.}, nan[] = {NAN, 0.};
  PetscReal       xi[2];

  CHECK(ElementLocate(ELEMENT_QUAD4, X, outside, 2e-6, xi));
  CHECK(!ElementLocate(ELEMENT_QUAD4, X, outside, 0.5e-6, xi));
  CHECK(!ElementLocate(ELEMENT_QUAD4, X, far, 1e-8, xi));
  CHECK(!ElementLocate(ELEMENT_TRI3, X, far, 1e-8, xi));
  CHECK(!ElementLocate(ELEMENT_QUAD4, X, nan, 1e-8, xi));
  CHECK(!ElementLocate(ELEMENT_TRI3, flat, outside, 1e-8, xi));
}

/* The strains of u = G x on a tetrahedron (3D) and a triangle (2D) against the definition; turns give none. */
static void TestStrainMatrix(PetscInt dim)
{
  const PetscInt num_nodes = dim + 1, num_strains = dim == 2 ? 3 : 6, num_dofs = num_nodes * dim;
  PetscReal      G[3][3], B[6 * 12], grad[12]                                  = {0.}, strain[6], expected[6];

  for (PetscInt k = 0; k < dim; k++) {
    grad[k]                 = -1.;
    grad[(k + 1) * dim + k] = 1.;
  }
  ElementStrainMatrix(dim, num_nodes, grad, B);
  for (PetscInt turn = 0; turn < 2; turn++) {
    for (PetscInt i = 0; i < dim; i++) {
      for (PetscInt j = 0; j < dim; j++) G[i][j] = turn && j <= i ? (i == j ? 0. : -G[j][i]) : Uniform(-1., 1.);
    }
    for (PetscInt s = 0; s < num_strains; s++) {
      strain[s] = 0.;
      for (PetscInt node = 1; node < num_nodes;
           node++) { /* u is zero at the node 0 and column k of G at the node k + 1 */
        for (PetscInt i = 0; i < dim; i++) strain[s] += B[s * num_dofs + node * dim + i] * G[i][node - 1];
      }
    }
    for (PetscInt k = 0; k < dim; k++) expected[k] = G[k][k];
    if (dim == 2) {
      expected[2] = G[0][1] + G[1][0];
    } else {
      expected[3] = G[1][2] + G[2][1];
      expected[4] = G[0][2] + G[2][0];
      expected[5] = G[0][1] + G[1][0];
    }
    for (PetscInt s = 0; s < num_strains; s++) CHECK_NEAR(strain[s], turn ? 0. : expected[s], EXACT);
  }
}

/* K = sum_q w det B'CB of one cell, as the assembler builds it. */
static void Stiffness(ElementType type, const PetscReal X[], const PetscReal C[], PetscReal K[])
{
  const PetscInt n = 2 * ElementNumNodes(type);
  PetscReal      points[2 * ELEMENT_MAX_POINTS], weights[ELEMENT_MAX_POINTS];
  const PetscInt num_points = ElementQuadrature(type, ElementStiffnessDegree(type), points, weights);

  for (PetscInt i = 0; i < n * n; i++) K[i] = 0.;
  for (PetscInt q = 0; q < num_points; q++) {
    PetscReal phi[ELEMENT_MAX_NODES], grad[MAX_DOFS], B[NUM_STRAINS * MAX_DOFS], CB[NUM_STRAINS * MAX_DOFS] = {0.};
    PetscReal w = weights[q] * ElementMap(type, X, &points[2 * q], NULL, phi, grad);

    ElementStrainMatrix(2, n / 2, grad, B);
    for (PetscInt s = 0; s < NUM_STRAINS; s++) {
      for (PetscInt r = 0; r < NUM_STRAINS; r++) {
        for (PetscInt j = 0; j < n; j++) CB[s * n + j] += C[s * NUM_STRAINS + r] * B[r * n + j];
      }
    }
    for (PetscInt s = 0; s < NUM_STRAINS; s++) {
      for (PetscInt i = 0; i < n; i++) {
        for (PetscInt j = 0; j < n; j++) K[i * n + j] += w * B[s * n + i] * CB[s * n + j];
      }
    }
  }
}

/* K u = 0 for rigid motions; u'Ku = area eps'C eps for a constant strain on distorted cells, too: the patch test. */
static void TestStiffness(ElementType type)
{
  const PetscInt n = ElementNumNodes(type);
  PetscReal      C[9], K[MAX_DOFS * MAX_DOFS];

  MaterialIsotropic(MODEL_PLANE_STRAIN, 2., 0.3, C);
  for (PetscInt trial = 0; trial < NUM_TRIALS; trial++) {
    const PetscReal strain[3] = {Uniform(-1., 1.), Uniform(-1., 1.), Uniform(-1., 1.)};
    PetscReal       X[MAX_DOFS], u[MAX_DOFS], rigid[3][MAX_DOFS], energy = 0., expected = 0., scale = 0.;

    RandomCell(type, 0., X);
    Stiffness(type, X, C, K);
    for (PetscInt i = 0; i < n; i++) {
      const PetscReal x = X[2 * i], y = X[2 * i + 1];

      rigid[0][2 * i] = rigid[1][2 * i + 1] = 1.;
      rigid[0][2 * i + 1] = rigid[1][2 * i] = 0.;
      rigid[2][2 * i]                       = -y;
      rigid[2][2 * i + 1]                   = x;
      u[2 * i]                              = strain[0] * x + strain[2] * y;
      u[2 * i + 1]                          = strain[1] * y;
    }
    for (PetscInt i = 0; i < 2 * n; i++) {
      for (PetscInt j = 0; j < 2 * n; j++) {
        scale = PetscMax(scale, PetscAbsReal(K[i * 2 * n + j]) * PetscMax(1., PetscAbsReal(rigid[2][j])));
        energy += 0.5 * u[i] * K[i * 2 * n + j] * u[j];
        CHECK_NEAR(K[i * 2 * n + j], K[j * 2 * n + i], EXACT * scale);
      }
    }
    for (PetscInt r = 0; r < 3; r++) {
      for (PetscInt i = 0; i < 2 * n; i++) {
        PetscReal force = 0.;

        for (PetscInt j = 0; j < 2 * n; j++) force += K[i * 2 * n + j] * rigid[r][j];
        CHECK_NEAR(force, 0., EXACT * scale);
      }
    }
    for (PetscInt s = 0; s < 3; s++) {
      for (PetscInt t = 0; t < 3; t++) expected += 0.5 * PolygonArea(n, X) * strain[s] * C[3 * s + t] * strain[t];
    }
    CHECK_NEAR(energy / expected, 1., EXACT);
  }
}

/* The unit square in plane stress, E = 1: K_00 = (1/2 - nu/6)/(1 - nu^2), K_01 = (1 + nu)/(8 (1 - nu^2)). */
static void TestUnitSquare(void)
{
  const PetscReal nu = 0.3, factor = 1. / (1. - nu * nu);
  PetscReal       C[9], K[MAX_DOFS * MAX_DOFS];

  MaterialIsotropic(MODEL_PLANE_STRESS, 1., nu, C);
  Stiffness(ELEMENT_QUAD4, CORNERS[ELEMENT_QUAD4], C, K);
  CHECK_NEAR(K[0], factor * (0.5 - nu / 6.), 1e-15);
  CHECK_NEAR(K[1], factor * (1. + nu) / 8., 1e-15);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestTable();
  PetscCall(TestGauss());
  TestQuadrature(ELEMENT_LINE2, 15);
  TestQuadrature(ELEMENT_TRI3, 5);
  TestQuadrature(ELEMENT_QUAD4, 7);
  for (PetscInt t = 0; t < ELEMENT_LINE3; t++) {
    TestShape((ElementType)t);
    TestMap((ElementType)t);
    TestLocate((ElementType)t);
    if (ElementDim((ElementType)t) == 2) {
      TestFacets((ElementType)t);
      TestStiffness((ElementType)t);
    }
  }
  TestMinJacobian();
  TestLocateTolerance();
  TestStrainMatrix(2);
  TestStrainMatrix(3);
  TestUnitSquare();
  PetscCall(PetscFinalize());
  return 0;
}
