/* test_stiffness.c -- strains, and the stiffness of one plane cell built from shape functions, quadrature and Hooke's law. */
#include "base/compat.h"
#include "kernel/element.h"
#include "kernel/material.h"
#include <test.h>

#include "plane_cells.h"

/* The strains of u = G x on a tetrahedron (3D) and a triangle (2D) against the definition; turns give none. */
static void TestStrainMatrix(PetscInt dim)
{
  const PetscInt num_nodes = dim + 1, num_strains = dim == 2 ? 3 : 6, num_dofs = num_nodes * dim;
  PetscReal      G[3][3], B[6 * 12], grad[12]                                  = {0.}, strain[6], expected[6];

  for (PetscInt k = 0; k < dim; k++) {
    grad[k]                 = -1.;
    grad[(k + 1) * dim + k] = 1.;
  }
  ElementStrainMatrix(dim, num_nodes, grad, NULL, B);
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

/* The strains of an axisymmetric triangle: those of the plane, and u_r / r around the axis before the shear. */
static void TestHoopStrain(void)
{
  const PetscReal r = 0.7, grad[6] = {-1., -1., 1., 0., 0., 1.}, phi[3] = {0.2, 0.3, 0.5};
  const PetscReal hoop[3] = {phi[0] / r, phi[1] / r, phi[2] / r};
  PetscReal       B[4 * 6], plane[3 * 6];

  ElementStrainMatrix(2, 3, grad, NULL, plane);
  ElementStrainMatrix(2, 3, grad, hoop, B);
  for (PetscInt j = 0; j < 6; j++) {
    CHECK_NEAR(B[j], plane[j], 0.);
    CHECK_NEAR(B[6 + j], plane[6 + j], 0.);
    CHECK_NEAR(B[12 + j], j % 2 ? 0. : hoop[j / 2], 0.);
    CHECK_NEAR(B[18 + j], plane[12 + j], 0.);
  }
}

/* K = sum_q w det B'CB of one cell, as the assembler builds it. */
static void Stiffness(ElementType type, const PetscReal X[], const PetscReal C[], PetscReal K[])
{
  const PetscInt n = 2 * ElementNumNodes(type);
  PetscReal      points[2 * ELEMENT_MAX_POINTS], weights[ELEMENT_MAX_POINTS];
  const PetscInt num_points = QuadratureRule(type, ElementStiffnessDegree(type), points, weights);

  for (PetscInt i = 0; i < n * n; i++) K[i] = 0.;
  for (PetscInt q = 0; q < num_points; q++) {
    PetscReal phi[ELEMENT_MAX_NODES], grad[MAX_DOFS], B[NUM_STRAINS * MAX_DOFS], CB[NUM_STRAINS * MAX_DOFS] = {0.};
    PetscReal w = weights[q] * ElementMap(type, X, &points[2 * q], NULL, phi, grad);

    ElementStrainMatrix(2, n / 2, grad, NULL, B);
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
      for (PetscInt t = 0; t < 3; t++) expected += 0.5 * CellArea(type, X) * strain[s] * C[3 * s + t] * strain[t];
    }
    CHECK_NEAR(energy / expected, 1., EXACT);
  }
}

/* The unit square in plane stress, E = 1: K_00 = (1/2 - nu/6)/(1 - nu^2), K_01 = (1 + nu)/(8 (1 - nu^2)). */
static void TestUnitSquare(void)
{
  const PetscReal X[] = {0., 0., 1., 0., 1., 1., 0., 1.};
  const PetscReal nu = 0.3, factor = 1. / (1. - nu * nu);
  PetscReal       C[9], K[MAX_DOFS * MAX_DOFS];

  MaterialIsotropic(MODEL_PLANE_STRESS, 1., nu, C);
  Stiffness(ELEMENT_QUAD4, X, C, K);
  CHECK_NEAR(K[0], factor * (0.5 - nu / 6.), 1e-15);
  CHECK_NEAR(K[1], factor * (1. + nu) / 8., 1e-15);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (PetscInt t = 0; t < ELEMENT_COUNT; t++) {
    if (ElementDim((ElementType)t) == 2) TestStiffness((ElementType)t);
  }
  TestStrainMatrix(2);
  TestHoopStrain();
  TestStrainMatrix(3);
  TestUnitSquare();
  PetscCall(PetscFinalize());
  return 0;
}
