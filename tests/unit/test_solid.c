/* test_solid.c -- cells in space and their facets: shape functions, quadrature, geometry, stiffness. */
#include "kernel/element.h"
#include "kernel/material.h"
#include <test.h>

#include "solid_cells.h"

static void TestTable(void)
{
  const PetscInt    nodes[] = {4, 8, 10, 27}, edges[] = {6, 12, 6, 12}, facets[] = {4, 6, 4, 6};
  const ElementType facet[] = {ELEMENT_TRI3, ELEMENT_QUAD4, ELEMENT_TRI6, ELEMENT_QUAD9};

  for (PetscInt t = 0; t < NUM_TYPES; t++) {
    const ElementType type = TYPES[t], linear = TYPES[t % 2];
    const PetscInt    num_vertices = ElementNumNodes(linear);

    CHECK(ElementDim(type) == DIM && ElementOrder(type) == 1 + t / 2);
    CHECK(ElementNumNodes(type) == nodes[t] && ElementNumEdges(type) == edges[t] &&
          ElementNumFacets(type) == facets[t]);
    CHECK(ElementFacetType(type) == facet[t] && ElementLinear(type) == linear);
    CHECK(ElementOfOrder(linear, ElementOrder(type)) == type);
    for (PetscInt i = 0; i < num_vertices * DIM; i++)
      CHECK_NEAR(ElementNode(type, i / DIM)[i % DIM], ElementNode(linear, i / DIM)[i % DIM], 0.);
    for (PetscInt e = 0; e < edges[t] && t >= 2; e++) { /* middles of edges follow the vertices */
      const PetscReal *a = ElementNode(type, ElementEdgeNodes(type, e)[0]);
      const PetscReal *b = ElementNode(type, ElementEdgeNodes(type, e)[1]);

      for (PetscInt k = 0; k < DIM; k++) CHECK_NEAR(ElementNode(type, num_vertices + e)[k], 0.5 * (a[k] + b[k]), 0.);
    }
    for (PetscInt f = 0; f < facets[t]; f++) { /* the facet's nodes lie where its own reference cell says */
      const PetscInt *number = ElementFacetNodes(type, f);

      for (PetscInt i = 0; i < ElementNumNodes(facet[t]); i++) {
        PetscReal phi[ELEMENT_MAX_NODES];

        ElementShape(facet[t % 2], ElementNode(facet[t], i), phi, NULL);
        for (PetscInt k = 0; k < DIM; k++) {
          PetscReal x = -ElementNode(type, number[i])[k];

          for (PetscInt j = 0; j < ElementNumNodes(facet[t % 2]); j++) x += phi[j] * ElementNode(type, number[j])[k];
          CHECK_NEAR(x, 0., 0.);
        }
      }
    }
  }
}

/* Plane cells have their facets for edges, a line itself. */
static void TestPlaneEdges(void)
{
  const ElementType plane[] = {ELEMENT_TRI3, ELEMENT_QUAD4, ELEMENT_TRI6, ELEMENT_QUAD9};

  for (PetscInt t = 0; t < 4; t++) {
    CHECK(ElementNumEdges(plane[t]) == ElementNumFacets(plane[t]));
    for (PetscInt e = 0; e < ElementNumEdges(plane[t]); e++) {
      for (PetscInt i = 0; i < 2; i++) CHECK(ElementEdgeNodes(plane[t], e)[i] == ElementFacetNodes(plane[t], e)[i]);
    }
  }
  CHECK(ElementNumEdges(ELEMENT_LINE3) == 1 && ElementEdgeNodes(ELEMENT_LINE3, 0)[1] == 1);
}

/* One at the own node, zero at the others; sum 1; derivatives by central differences, exact for these polynomials. */
static void TestShape(ElementType type)
{
  const PetscInt  n = ElementNumNodes(type);
  const PetscReal h = 0.25;

  for (PetscInt node = 0; node < n; node++) {
    PetscReal phi[ELEMENT_MAX_NODES];

    ElementShape(type, ElementNode(type, node), phi, NULL);
    for (PetscInt i = 0; i < n; i++) CHECK_NEAR(phi[i], i == node ? 1. : 0., 0.);
  }
  for (PetscInt trial = 0; trial < NUM_TRIALS; trial++) {
    PetscReal xi[DIM], phi[ELEMENT_MAX_NODES], dphi[MAX_DOFS], plus[ELEMENT_MAX_NODES], minus[ELEMENT_MAX_NODES];
    PetscReal sum = 0.;

    RandomPoint(type, xi);
    ElementShape(type, xi, phi, dphi);
    for (PetscInt i = 0; i < n; i++) sum += phi[i];
    CHECK_NEAR(sum, 1., 8. * PETSC_MACHINE_EPSILON);
    for (PetscInt k = 0; k < DIM; k++) {
      PetscReal shifted[DIM] = {xi[0], xi[1], xi[2]};

      shifted[k] = xi[k] + h;
      ElementShape(type, shifted, plus, NULL);
      shifted[k] = xi[k] - h;
      ElementShape(type, shifted, minus, NULL);
      for (PetscInt i = 0; i < n; i++) CHECK_NEAR(dphi[i * DIM + k], (plus[i] - minus[i]) / (2. * h), EXACT);
    }
  }
}

/* int x^a y^b z^c: a! b! c! / (a+b+c+3)! on the tetrahedron, 1 / ((a+1)(b+1)(c+1)) on the cube. */
static PetscReal MonomialIntegral(ElementType type, const PetscInt power[])
{
  PetscReal value = 1.;
  PetscInt  total = 0;

  for (PetscInt k = 0; k < DIM; k++) {
    if (!IsTetrahedron(type)) value /= power[k] + 1.;
    for (PetscInt j = 1; j <= power[k] && IsTetrahedron(type); j++) value *= j / (PetscReal)++total;
  }
  return IsTetrahedron(type) ? value / ((total + 1.) * (total + 2.) * (total + 3.)) : value;
}

static void TestMonomial(ElementType type, const PetscInt power[], PetscInt n, const PetscReal points[],
                         const PetscReal weights[])
{
  PetscReal sum = 0.;

  for (PetscInt q = 0; q < n; q++) {
    PetscReal value = weights[q];

    for (PetscInt k = 0; k < DIM; k++) {
      for (PetscInt j = 0; j < power[k]; j++) value *= points[DIM * q + k];
    }
    sum += value;
  }
  CHECK_NEAR(sum, MonomialIntegral(type, power), 16. * PETSC_MACHINE_EPSILON); /* sums of up to 252 numbers */
}

/* [in] num_stiffness - points of the rule for the stiffness */
static void TestQuadrature(ElementType type, PetscInt highest, PetscInt num_stiffness)
{
  PetscReal points[ELEMENT_MAX_POINTS * DIM], weights[ELEMENT_MAX_POINTS];

  for (PetscInt degree = 0; degree <= highest; degree++) {
    const PetscInt n = QuadratureRule(type, degree, points, weights), side = degree + 1;

    CHECK(n > 0 && n <= ELEMENT_MAX_POINTS);
    for (PetscInt q = 0; q < n; q++) {
      PetscReal sum = 0.;

      for (PetscInt k = 0; k < DIM; k++) {
        CHECK(points[DIM * q + k] > 0. && points[DIM * q + k] < 1.);
        sum += points[DIM * q + k];
      }
      CHECK(weights[q] > 0. && (sum < 1. || !IsTetrahedron(type)));
    }
    for (PetscInt i = 0; i < side * side * side; i++) {
      const PetscInt power[DIM] = {i % side, i / side % side, i / (side * side)};

      if (IsTetrahedron(type) && power[0] + power[1] + power[2] > degree) continue;
      TestMonomial(type, power, n, points, weights);
    }
  }
  CHECK(QuadratureRule(type, highest + 1, points, weights) == 0);
  CHECK(QuadratureRule(type, ElementStiffnessDegree(type), points, weights) == num_stiffness);
}

/* A linear field on any cell: its value and its gradient come back. int det J = volume by the facets. Facets
   are where the cell's own map puts them. */
static void TestMap(ElementType type)
{
  const ElementType facet      = ElementFacetType(type);
  const PetscInt    n          = ElementNumNodes(type);
  const PetscReal   slope[DIM] = {0.7, -1.3, 0.4};

  for (PetscInt trial = 0; trial < NUM_TRIALS; trial++) {
    PetscReal      X[MAX_DOFS], points[DIM * ELEMENT_MAX_POINTS], weights[ELEMENT_MAX_POINTS], volume = 0.;
    const PetscInt num_points = QuadratureRule(type, 5, points, weights), f = trial % ElementNumFacets(type);
    PetscReal      Y[DIM * ELEMENT_MAX_FACET_NODES], x[DIM], y[DIM], phi[ELEMENT_MAX_NODES], grad[MAX_DOFS];
    PetscReal      at[2] = {Uniform(0., 0.5), Uniform(0., 0.5)}, xi[DIM] = {0.};

    RandomCell(type, 0., X);
    for (PetscInt q = 0; q < num_points; q++) {
      PetscReal value = 0., gradient[DIM] = {0.};

      volume += weights[q] * ElementMap(type, X, &points[DIM * q], x, phi, grad);
      for (PetscInt i = 0; i < n; i++) {
        const PetscReal u = slope[0] * X[DIM * i] + slope[1] * X[DIM * i + 1] + slope[2] * X[DIM * i + 2];

        value += phi[i] * u;
        for (PetscInt k = 0; k < DIM; k++) gradient[k] += grad[DIM * i + k] * u;
      }
      CHECK_NEAR(value, slope[0] * x[0] + slope[1] * x[1] + slope[2] * x[2], EXACT);
      for (PetscInt k = 0; k < DIM; k++) CHECK_NEAR(gradient[k], slope[k], 10. * EXACT);
    }
    CHECK_NEAR(volume / Volume(type, X), 1., EXACT);

    ContactFacetCoordinates(type, f, X, Y);
    ElementSurface(facet, Y, at, x, phi, NULL);
    for (PetscInt i = 0; i < ElementNumNodes(facet); i++) {
      for (PetscInt k = 0; k < DIM; k++) xi[k] += phi[i] * ElementNode(type, ElementFacetNodes(type, f)[i])[k];
    }
    ElementMap(type, X, xi, y, phi, NULL);
    for (PetscInt k = 0; k < DIM; k++) CHECK_NEAR(x[k], y[k], EXACT);
  }
}

/* The sheet z = x^2 over the unit square has the area of the parabola, and the normal (-2x, 0, 1). */
static void TestSurface(void)
{
  PetscReal      X[DIM * 9], points[2 * ELEMENT_MAX_POINTS], weights[ELEMENT_MAX_POINTS], area = 0.;
  const PetscInt n = QuadratureRule(ELEMENT_QUAD9, 15, points, weights);

  for (PetscInt i = 0; i < 9; i++) {
    X[DIM * i]     = ElementNode(ELEMENT_QUAD9, i)[0];
    X[DIM * i + 1] = ElementNode(ELEMENT_QUAD9, i)[1];
    X[DIM * i + 2] = X[DIM * i] * X[DIM * i];
  }
  for (PetscInt q = 0; q < n; q++) {
    PetscReal phi[ELEMENT_MAX_NODES], normal[DIM];

    area += weights[q] * ElementSurface(ELEMENT_QUAD9, X, &points[2 * q], NULL, phi, normal);
    CHECK_NEAR(normal[0], -2. * points[2 * q] * normal[2], EXACT);
    CHECK_NEAR(normal[1], 0., EXACT);
    CHECK(normal[2] > 0.);
  }
  CHECK_NEAR(area, 0.5 * PetscSqrtReal(5.) + 0.25 * PetscAsinhReal(2.), 1e-8);
}

/* [out] X - of the reference cell */
static void Reference(ElementType type, PetscReal X[])
{
  for (PetscInt i = 0; i < DIM * ElementNumNodes(type); i++) X[i] = ElementNode(type, i / DIM)[i % DIM];
}

static void TestMinJacobian(void)
{
  PetscReal X[MAX_DOFS];

  for (PetscInt t = 0; t < NUM_TYPES; t++) {
    Reference(TYPES[t], X);
    CHECK_NEAR(ElementMinJacobian(TYPES[t], X), 1., EXACT);
    for (PetscInt i = 0; i < ElementNumNodes(TYPES[t]); i++) X[DIM * i] *= -2.; /* mirrored */
    CHECK_NEAR(ElementMinJacobian(TYPES[t], X), -2., EXACT);
  }
  Reference(ELEMENT_HEX8, X); /* a quarter turn of the top: det J is (1-z)^2 + z^2, smallest half way up */
  for (PetscInt i = 4; i < 8; i++) {
    const PetscReal x = X[DIM * i], y = X[DIM * i + 1];

    X[DIM * i]     = 1. - y;
    X[DIM * i + 1] = x;
  }
  CHECK_NEAR(ElementMinJacobian(ELEMENT_HEX8, X), 0.5, EXACT);
  Reference(ELEMENT_TET10, X); /* the middle of an edge along x moved by d: det J = 1 + 4 d (1 - 2x - y - z) */
  X[DIM * 4] += 0.3;
  CHECK_NEAR(ElementMinJacobian(ELEMENT_TET10, X), 1. - 4. * 0.3, EXACT);
}

/* The bound holds in random cells, and is det J itself in affine ones. */
static void TestBoundJacobian(ElementType type)
{
  PetscReal X[MAX_DOFS];

  for (PetscInt trial = 0; trial < NUM_TRIALS; trial++) {
    const PetscReal size = PetscPowRealInt(0.1, (int)(trial % 5)); /* of what bends the cell */

    Reference(type, X);
    for (PetscInt i = 0; i < DIM * ElementNumNodes(type); i++) X[i] += size * Uniform(-0.1, 0.1);
    CHECK(ElementBoundJacobian(type, X) <= ElementMinJacobian(type, X) + EXACT);
    if (size <= 1e-3) CHECK(ElementBoundJacobian(type, X) > 0.9 * ElementMinJacobian(type, X));
    Reference(type, X);
    for (PetscInt i = 0; i < ElementNumNodes(type); i++) X[DIM * i + 2] += 0.7 * X[DIM * i] - 2. * X[DIM * i + 1];
    CHECK_NEAR(ElementBoundJacobian(type, X), 1., 1e3 * EXACT);
  }
}

/* The gradient of a displacement is the sum of those of shape functions, in cells with any sides. */
static void TestGradient(ElementType type)
{
  static ElementRule rule;

  ElementRuleSet(type, ElementStiffnessDegree(type), &rule);
  for (PetscInt trial = 0; trial < NUM_TRIALS; trial++) {
    PetscReal X[MAX_DOFS], v[MAX_DOFS], grad[MAX_DOFS], H[DIM * DIM], x[DIM], same[DIM];

    RandomCell(type, 2., X);
    for (PetscInt i = 0; i < DIM * ElementNumNodes(type); i++) v[i] = Uniform(-1., 1.);
    for (PetscInt q = 0; q < rule.num; q++) {
      const PetscReal det = ElementRuleMap(&rule, q, X, same, grad);

      CHECK_NEAR(ElementRuleGradient(&rule, q, X, v, x, H), det, EXACT);
      for (PetscInt k = 0; k < DIM; k++) CHECK_NEAR(x[k], same[k], EXACT);
      for (PetscInt kl = 0; kl < DIM * DIM; kl++) {
        PetscReal sum = 0., size = 0.;

        for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
          sum += v[DIM * i + kl / DIM] * grad[DIM * i + kl % DIM];
          size += PetscAbsReal(v[DIM * i + kl / DIM] * grad[DIM * i + kl % DIM]);
        }
        CHECK_NEAR(H[kl], sum, 100. * EXACT * (1. + size));
      }
    }
  }
}

/* Points put into random cells are found where they were put; a little inside of a facet is inside, outside is not. */
static void TestLocate(ElementType type)
{
  const ElementType facet  = ElementFacetType(type);
  const PetscReal   offset = 1e-6;

  for (PetscInt trial = 0; trial < 5 * NUM_TRIALS; trial++) {
    const PetscInt node = trial % ElementNumNodes(type);
    PetscReal      X[MAX_DOFS], Y[DIM * ELEMENT_MAX_FACET_NODES], xi[DIM], found[DIM], x[DIM], normal[DIM];
    PetscReal      phi[ELEMENT_MAX_NODES], near[DIM], at[2] = {Uniform(0.1, 0.4), Uniform(0.1, 0.4)};

    RandomCell(type, 2., X);
    RandomPoint(type, xi);
    ElementMap(type, X, xi, x, phi, NULL);
    CHECK(ElementLocate(type, X, x, 1e-8, found));
    for (PetscInt k = 0; k < DIM; k++) CHECK_NEAR(found[k], xi[k], 1e-9);
    CHECK(ElementLocate(type, X, &X[DIM * node], 1e-8, found));
    for (PetscInt k = 0; k < DIM; k++) CHECK_NEAR(found[k], ElementNode(type, node)[k], 1e-9);

    RandomCell(type, 0., X);
    ContactFacetCoordinates(type, trial % ElementNumFacets(type), X, Y);
    ElementSurface(facet, Y, at, x, phi, normal);
    for (PetscInt k = 0; k < DIM; k++) near[k] = x[k] - offset * normal[k];
    CHECK(ElementLocate(type, X, near, 1e-12, xi));
    for (PetscInt k = 0; k < DIM; k++) near[k] = x[k] + offset * normal[k];
    CHECK(!ElementLocate(type, X, near, 1e-12, xi));
  }
}

/* K = sum_q w det B'CB of one cell. [out] K - [n][n] */
static void Stiffness(ElementType type, const PetscReal X[], const PetscReal C[], PetscReal K[])
{
  static ElementRule rule;
  const PetscInt     n = DIM * ElementNumNodes(type);

  ElementRuleSet(type, ElementStiffnessDegree(type), &rule);
  for (PetscInt i = 0; i < n * n; i++) K[i] = 0.;
  for (PetscInt q = 0; q < rule.num; q++) {
    PetscReal       grad[MAX_DOFS], B[NUM_STRAINS * MAX_DOFS], CB[NUM_STRAINS * MAX_DOFS] = {0.};
    const PetscReal w = rule.weight[q] * ElementRuleMap(&rule, q, X, NULL, grad);

    ElementStrainMatrix(DIM, n / DIM, grad, NULL, B);
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

/* K u = 0 for rigid motions. A constant stress gives the forces int n.sigma phi on the facets and no others:
   the patch test, on cells with any sides. */
static void TestStiffness(ElementType type)
{
  const ElementType facet = ElementFacetType(type);
  const PetscInt    n     = ElementNumNodes(type);
  PetscReal         C[36], points[2 * ELEMENT_MAX_POINTS], weights[ELEMENT_MAX_POINTS];
  static PetscReal  K[MAX_DOFS * MAX_DOFS];
  const PetscInt    num_points = QuadratureRule(facet, 7, points, weights);

  MaterialIsotropic(MODEL_SOLID, 2., 0.3, C);
  for (PetscInt trial = 0; trial < NUM_TRIALS / 4; trial++) {
    static const PetscInt voigt[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
    PetscReal X[MAX_DOFS], G[9], u[MAX_DOFS], force[MAX_DOFS] = {0.}, strain[6], stress[6] = {0.}, scale = 0.;

    RandomCell(type, 0., X);
    Stiffness(type, X, C, K);
    for (PetscInt i = 0; i < 9; i++) G[i] = Uniform(-1., 1.); /* strain and turn */
    for (PetscInt i = 0; i < 3; i++) {
      for (PetscInt j = i; j < 3; j++) strain[voigt[i][j]] = i == j ? G[4 * i] : G[3 * i + j] + G[3 * j + i];
    }
    for (PetscInt i = 0; i < 36; i++) stress[i / 6] += C[i] * strain[i % 6];
    for (PetscInt i = 0; i < n * DIM; i++) {
      const PetscReal *x = &X[DIM * (i / DIM)], *g = &G[3 * (i % DIM)];

      u[i] = 0.5 + g[0] * x[0] + g[1] * x[1] + g[2] * x[2];
    }
    for (PetscInt f = 0; f < ElementNumFacets(type); f++) {
      PetscReal Y[DIM * ELEMENT_MAX_FACET_NODES];

      ContactFacetCoordinates(type, f, X, Y);
      for (PetscInt q = 0; q < num_points; q++) {
        PetscReal       normal[DIM], phi[ELEMENT_MAX_NODES];
        const PetscReal ds = weights[q] * ElementSurface(facet, Y, &points[2 * q], NULL, phi, normal);

        for (PetscInt i = 0; i < ElementNumNodes(facet); i++) {
          for (PetscInt k = 0; k < DIM; k++) {
            for (PetscInt l = 0; l < DIM; l++)
              force[DIM * ElementFacetNodes(type, f)[i] + k] += ds * phi[i] * stress[voigt[k][l]] * normal[l];
          }
        }
      }
    }
    for (PetscInt i = 0; i < n * DIM; i++) scale = PetscMax(scale, K[i * n * DIM + i]);
    for (PetscInt i = 0; i < n * DIM; i++) {
      PetscReal sum = -force[i];

      for (PetscInt j = 0; j < n * DIM; j++) {
        sum += K[i * n * DIM + j] * u[j];
        CHECK_NEAR(K[i * n * DIM + j], K[j * n * DIM + i], EXACT * scale);
      }
      CHECK_NEAR(sum, 0., 10. * EXACT * scale);
    }
  }
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestTable();
  TestPlaneEdges();
  TestQuadrature(ELEMENT_TET4, 10, 1);
  TestQuadrature(ELEMENT_HEX8, 11, 8);
  TestQuadrature(ELEMENT_TET10, 10, 8);
  TestQuadrature(ELEMENT_HEX27, 11, 27);
  for (PetscInt t = 0; t < NUM_TYPES; t++) {
    TestShape(TYPES[t]);
    TestMap(TYPES[t]);
    TestLocate(TYPES[t]);
    TestGradient(TYPES[t]);
    TestBoundJacobian(TYPES[t]);
    TestStiffness(TYPES[t]);
  }
  TestSurface();
  TestMinJacobian();
  PetscCall(PetscFinalize());
  return 0;
}
