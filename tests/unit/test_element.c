/* test_element.c -- lines and plane cells: shape functions, quadrature, geometry. */
#include "base/compat.h"
#include "kernel/element.h"
#include <petscdt.h>
#include <test.h>

#include "plane_cells.h"

static void TestTable(void)
{
  const ElementType types[] = {ELEMENT_LINE2, ELEMENT_TRI3, ELEMENT_QUAD4, ELEMENT_LINE3, ELEMENT_TRI6, ELEMENT_QUAD9};
  const PetscInt    dims[] = {1, 2, 2, 1, 2, 2}, nodes[] = {2, 3, 4, 3, 6, 9}, facets[] = {2, 3, 4, 2, 3, 4};
  const ElementType linear[] = {ELEMENT_LINE2, ELEMENT_TRI3, ELEMENT_QUAD4, ELEMENT_LINE2, ELEMENT_TRI3, ELEMENT_QUAD4};
  const ElementType facet[]  = {ELEMENT_COUNT, ELEMENT_LINE2, ELEMENT_LINE2,
                                ELEMENT_COUNT, ELEMENT_LINE3, ELEMENT_LINE3};

  for (size_t t = 0; t < PETSC_STATIC_ARRAY_LENGTH(types); t++) {
    const ElementType type = types[t];

    CHECK(ElementDim(type) == dims[t]);
    CHECK(ElementNumNodes(type) == nodes[t]);
    CHECK(ElementNumFacets(type) == facets[t]);
    CHECK(ElementFacetType(type) == facet[t]);
    CHECK(ElementLinear(type) == linear[t]);
    CHECK(ElementOrder(type) == (t < 3 ? 1 : 2));
    CHECK(ElementOfOrder(linear[t], ElementOrder(type)) == type);
    for (PetscInt i = 0; i < ElementNumNodes(linear[t]); i++) { /* vertices come first, the same ones */
      for (PetscInt k = 0; k < dims[t]; k++) CHECK_NEAR(ElementNode(type, i)[k], ElementNode(linear[t], i)[k], 0.);
    }
    for (PetscInt f = 0; f < facets[t] && facet[t] == ELEMENT_LINE3; f++) {
      const PetscInt *ends = ElementFacetNodes(type, f);

      for (PetscInt k = 0; k < 2; k++) {
        CHECK(ends[k] == ElementFacetNodes(linear[t], f)[k]);
        CHECK_NEAR(ElementNode(type, ends[2])[k], 0.5 * (ElementNode(type, ends[0])[k] + ElementNode(type, ends[1])[k]),
                   0.);
      }
    }
  }
}

/* Facets run around the cell with the normal outward: sum int x.n = 2 area of any cell, sum int n = 0. The
   facet's own shape functions give the cell's side. */
static void TestFacets(ElementType type)
{
  const ElementType facet = ElementFacetType(type);
  const PetscInt    n     = ElementNumNodes(facet);

  for (PetscInt trial = 0; trial < NUM_TRIALS; trial++) {
    PetscReal X[MAX_DOFS], flux = 0., closed[2] = {0., 0.}, points[ELEMENT_MAX_POINTS], weights[ELEMENT_MAX_POINTS];
    const PetscInt num_points = QuadratureRule(facet, 4, points, weights);

    RandomCell(type, 0., X);
    for (PetscInt f = 0; f < ElementNumFacets(type); f++) {
      const PetscInt *nodes = ElementFacetNodes(type, f);
      PetscReal       Y[2 * ELEMENT_MAX_FACET_NODES];

      for (PetscInt i = 0; i < 2 * n; i++) Y[i] = X[2 * nodes[i / 2] + i % 2];
      for (PetscInt q = 0; q < num_points; q++) {
        PetscReal x[2], y[2], xi[2], phi[ELEMENT_MAX_NODES], normal[2];
        PetscReal ds = weights[q] * ElementSurface(facet, Y, &points[q], x, phi, normal);

        CHECK_NEAR(normal[0] * normal[0] + normal[1] * normal[1], 1., EXACT);
        flux += ds * (x[0] * normal[0] + x[1] * normal[1]);
        for (PetscInt k = 0; k < 2; k++) {
          closed[k] += ds * normal[k];
          xi[k] = (1. - points[q]) * ElementNode(type, nodes[0])[k] + points[q] * ElementNode(type, nodes[1])[k];
        }
        ElementMap(type, X, xi, y, phi, NULL);
        for (PetscInt k = 0; k < 2; k++) CHECK_NEAR(x[k], y[k], EXACT);
      }
    }
    CHECK_NEAR(flux / CellArea(type, X), 2., EXACT);
    for (PetscInt k = 0; k < 2; k++) CHECK_NEAR(closed[k], 0., EXACT);
  }
}

/* The parabola y = x^2 over [0,1] is sqrt(5)/2 + asinh(2)/4 long; its normal at x leans by 2x. */
static void TestParabola(void)
{
  const PetscReal X[] = {0., 0., 1., 1., 0.5, 0.25};
  PetscReal       points[ELEMENT_MAX_POINTS], weights[ELEMENT_MAX_POINTS], length = 0.;
  const PetscInt  n = QuadratureRule(ELEMENT_LINE3, 15, points, weights);

  for (PetscInt q = 0; q < n; q++) {
    PetscReal phi[ELEMENT_MAX_NODES], normal[2];

    length += weights[q] * ElementSurface(ELEMENT_LINE3, X, &points[q], NULL, phi, normal);
    CHECK_NEAR(normal[0], -2. * points[q] * normal[1], EXACT);
    CHECK(normal[1] < 0.);
  }
  CHECK_NEAR(length, 0.5 * PetscSqrtReal(5.) + 0.25 * PetscAsinhReal(2.), 1e-8);
}

/* One at the own node, zero at the others; sum 1; derivatives by central differences, exact for these polynomials. */
static void TestShape(ElementType type)
{
  const PetscInt  n = ElementNumNodes(type), dim = ElementDim(type);
  const PetscReal h = 0.25;
  PetscReal xi[MAX_DIM], phi[ELEMENT_MAX_NODES], dphi[MAX_DOFS], plus[ELEMENT_MAX_NODES], minus[ELEMENT_MAX_NODES];

  for (PetscInt node = 0; node < n; node++) {
    ElementShape(type, ElementNode(type, node), phi, NULL);
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

  if (ElementLinear(type) != ELEMENT_TRI3) return 1. / ((a + 1.) * (b + 1.));
  for (PetscInt k = 1; k <= b; k++) value *= k / (PetscReal)(a + k);
  return value / ((a + b + 1.) * (a + b + 2.));
}

/* [in] num_stiffness - points of the rule for the stiffness */
static void TestQuadrature(ElementType type, PetscInt highest, PetscInt num_stiffness)
{
  const PetscInt dim = ElementDim(type);
  PetscReal      points[ELEMENT_MAX_POINTS * MAX_DIM], weights[ELEMENT_MAX_POINTS];

  for (PetscInt degree = 0; degree <= highest; degree++) {
    const PetscInt n = QuadratureRule(type, degree, points, weights);

    CHECK(n > 0 && n <= ELEMENT_MAX_POINTS);
    for (PetscInt a = 0; a <= degree; a++) {
      const PetscInt b_last = ElementLinear(type) == ELEMENT_TRI3 ? degree - a : degree;

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
  CHECK(QuadratureRule(type, highest + 1, points, weights) == 0);
  CHECK(QuadratureRule(type, ElementStiffnessDegree(type), points, weights) == num_stiffness);
}

static PetscErrorCode TestGauss(void)
{
  PetscReal points[16], weights[16], petsc_points[16], petsc_weights[16];

  PetscFunctionBeginUser;
  for (PetscInt n = 1; n <= 16; n += n < 8 ? 1 : 4) {
    CHECK(QuadratureLine(n, points, weights) == n);
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
    PetscInt  num_points = QuadratureRule(type, 3, points, weights);

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
    if (dim == 2) CHECK_NEAR(area / CellArea(type, X), 1., EXACT);
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

/* Cells of second order, one node of which is moved by d. The unit square's bottom has det J = 1 + 4 d x
   (1-x) (4 y - 3), the triangle's 1 - 4 d x. A line whose middle lies before a quarter folds back at its
   beginning. */
static void TestMinJacobianCurved(void)
{
  const PetscReal line[] = {0., 1., 0.5}, quarter[] = {0., 1., 0.25}, folded[] = {0., 1., 0.2};
  const PetscReal square[] = {1. - 3. * 0.2, 1. - 0.2}, triangle[] = {1. - 4. * 0.2, 1.};

  CHECK_NEAR(ElementMinJacobian(ELEMENT_LINE3, line), 1., EXACT);
  CHECK_NEAR(ElementMinJacobian(ELEMENT_LINE3, quarter), 0., EXACT);
  CHECK_NEAR(ElementMinJacobian(ELEMENT_LINE3, folded), -0.2, EXACT);
  for (PetscInt outward = 0; outward < 2; outward++) {
    const ElementType types[] = {ELEMENT_QUAD9, ELEMENT_TRI6};

    for (PetscInt t = 0; t < 2; t++) {
      PetscReal X[MAX_DOFS];

      for (PetscInt i = 0; i < ElementNumNodes(types[t]); i++) {
        for (PetscInt k = 0; k < 2; k++) X[2 * i + k] = ElementNode(types[t], i)[k];
      }
      X[2 * ElementFacetNodes(types[t], 0)[2] + 1] += outward ? -0.2 : 0.2;
      CHECK_NEAR(ElementMinJacobian(types[t], X), t == 0 ? square[outward] : triangle[outward], EXACT);
    }
  }
}

/* Points put into random cells are found where they were put; random points are found exactly where the half planes of
   straight facets say inside. */
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
    CHECK(ElementLocate(type, X, &X[a * dim], tolerance, found)); /* nodes belong to the cell */
    for (PetscInt k = 0; k < dim; k++) CHECK_NEAR(found[k], ElementNode(type, a)[k], 1e-9);

    if (ElementOrder(type) > 1) continue;
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

/* A little inside of a curved side is inside, a little outside is not. */
static void TestLocateCurved(ElementType type)
{
  const ElementType facet  = ElementFacetType(type);
  const PetscReal   offset = 1e-6;

  for (PetscInt trial = 0; trial < 20 * NUM_TRIALS; trial++) {
    const PetscInt *nodes = ElementFacetNodes(type, trial % ElementNumFacets(type));
    const PetscReal s     = Uniform(0.01, 0.99);
    PetscReal X[MAX_DOFS], Y[2 * ELEMENT_MAX_FACET_NODES], x[2], xi[2], phi[ELEMENT_MAX_NODES], normal[2], near[2];

    RandomCell(type, 0., X);
    for (PetscInt i = 0; i < 2 * ElementNumNodes(facet); i++) Y[i] = X[2 * nodes[i / 2] + i % 2];
    ElementSurface(facet, Y, &s, x, phi, normal);
    for (PetscInt k = 0; k < 2; k++) near[k] = x[k] - offset * normal[k];
    CHECK(ElementLocate(type, X, near, 1e-12, xi));
    for (PetscInt k = 0; k < 2; k++) near[k] = x[k] + offset * normal[k];
    CHECK(!ElementLocate(type, X, near, 1e-12, xi));
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

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestTable();
  PetscCall(TestGauss());
  TestQuadrature(ELEMENT_LINE2, 15, 1);
  TestQuadrature(ELEMENT_TRI3, 14, 1);
  TestQuadrature(ELEMENT_QUAD4, 15, 4);
  TestQuadrature(ELEMENT_LINE3, 15, 2);
  TestQuadrature(ELEMENT_TRI6, 14, 6);
  TestQuadrature(ELEMENT_QUAD9, 15, 9);
  TestParabola();
  for (PetscInt t = 0; t < ELEMENT_COUNT; t++) {
    if (ElementDim((ElementType)t) > MAX_DIM) continue;
    TestShape((ElementType)t);
    TestMap((ElementType)t);
    TestLocate((ElementType)t);
    if (ElementDim((ElementType)t) == 2) {
      TestFacets((ElementType)t);
      TestLocateCurved((ElementType)t);
    }
  }
  TestMinJacobian();
  TestMinJacobianCurved();
  TestLocateTolerance();
  PetscCall(PetscFinalize());
  return 0;
}
