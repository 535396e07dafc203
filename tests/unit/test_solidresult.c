/* test_solidresult.c -- in space: gradients of formulas, stresses recovered from displacements that are known, and norms of errors
   against integrals done by hand. */
#include <math.h>
#include "base/compat.h"
#include "kernel/material.h"
#include "solid_scene.h"
#include "result/cellerror.h"
#include "result/exact.h"
#include "result/stress.h"

enum { DIM = 3 };

static const ElementType Types[] = {ELEMENT_TET4, ELEMENT_HEX8, ELEMENT_TET10, ELEMENT_HEX27};

/* --- gradients ---------------------------------------------------------------------------------------------------- */

/* A displacement and its gradient g[k][i] = d u_i / d x_k. */
typedef void (*FieldFn)(const PetscReal x[], PetscReal u[], PetscReal g[]);

static const char SmoothText[] = "sin(3*x+y-2*z), exp(x)*cos(2*z), x*y*z";

static void SmoothFn(const PetscReal x[], PetscReal u[], PetscReal g[])
{
  const PetscReal c = cos(3 * x[0] + x[1] - 2 * x[2]), e = exp(x[0]);
  const PetscReal all[9] = {3 * c,       e * cos(2 * x[2]),
                            x[1] * x[2], //
                            c,           0,
                            x[0] * x[2], //
                            -2 * c,      -2 * e * sin(2 * x[2]),
                            x[0] * x[1]};

  u[0] = sin(3 * x[0] + x[1] - 2 * x[2]);
  u[1] = all[1];
  u[2] = x[0] * x[1] * x[2];
  CHECK(!PetscArraycpy(g, all, 9));
}

/* The root of the distance from the origin, where it is singular. */
static const char RootText[] = "sqrt(sqrt(x^2+y^2+z^2)), 0, 0";

static void RootFn(const PetscReal x[], PetscReal u[], PetscReal g[])
{
  const PetscReal r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);

  CHECK(!PetscArrayzero(g, 9));
  u[0] = sqrt(r);
  u[1] = u[2] = 0;
  for (PetscInt k = 0; k < DIM; ++k) g[3 * k] = x[k] / (2 * r * sqrt(r));
}

/* Nodes of a cell of size h, thin along z by a ratio, sheared, its corner at a point; cells of second order are bent. */
static void MakeCell(ElementType type, PetscReal h, PetscReal ratio, const PetscReal corner[], PetscReal X[])
{
  const PetscReal bend = ElementOrder(type) > 1 ? 0.1 : 0;

  for (PetscInt a = 0; a < ElementNumNodes(type); ++a) {
    const PetscReal *xi = ElementNode(type, a), s = xi[0], t = xi[1], w = xi[2] + bend * s * (1 - s);

    X[3 * a]     = corner[0] + h * (s + 0.3 * t);
    X[3 * a + 1] = corner[1] + h * (t + 0.2 * ratio * w);
    X[3 * a + 2] = corner[2] + h * ratio * w;
  }
}

/* Largest error of the gradient over a cell's quadrature points, relative to its size there. */
static PetscReal GradientError(Expression e, FieldFn field, ElementType type, const PetscReal X[])
{
  PetscReal      xi[DIM * ELEMENT_MAX_POINTS], w[ELEMENT_MAX_POINTS], phi[ELEMENT_MAX_NODES], worst = 0;
  const PetscInt n = QuadratureRule(type, 8, xi, w);

  CHECK(n > 0);
  for (PetscInt q = 0; q < n; ++q) {
    PetscReal       x[DIM], u[DIM], g[9], true_u[DIM], true_g[9], grad[DIM * ELEMENT_MAX_NODES], size = 0, error = 0;
    const CellPoint at = {type, X, &xi[DIM * q], grad, 1};

    ElementMap(type, X, &xi[DIM * q], x, phi, grad);
    CHECK(!ExactEvaluate(e, &at, u, g));
    field(x, true_u, true_g);
    for (PetscInt i = 0; i < DIM; ++i) CHECK_NEAR(u[i], true_u[i], 1e-14);
    for (PetscInt j = 0; j < 9; ++j) {
      size  = PetscMax(size, PetscAbsReal(true_g[j]));
      error = PetscMax(error, PetscAbsReal(g[j] - true_g[j]));
    }
    worst = PetscMax(worst, error / size);
  }
  return worst;
}

/* Points of tetrahedra come so near to the boundary that steps have to be shorter there. */
static void TestGradient(void)
{
  static const PetscReal inside[] = {0.3, 0.7, 0.2}, origin[] = {0, 0, 0}, sizes[] = {1, 1e-2}, ratios[] = {1, 1e-2};
  PetscReal              X[DIM * ELEMENT_MAX_NODES];
  Expression             smooth, root;

  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-smooth", SmoothText, DIM, PETSC_FALSE, &smooth));
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-root", RootText, DIM, PETSC_FALSE, &root));
  for (size_t t = 0; t < PETSC_STATIC_ARRAY_LENGTH(Types); ++t) {
    for (size_t s = 0; s < PETSC_STATIC_ARRAY_LENGTH(sizes); ++s) {
      for (size_t r = 0; r < PETSC_STATIC_ARRAY_LENGTH(ratios); ++r) {
        MakeCell(Types[t], sizes[s], ratios[r], inside, X);
        CHECK(GradientError(smooth, SmoothFn, Types[t], X) < 1e-9 + 2e-11 / (sizes[s] * ratios[r]));
      }
      MakeCell(Types[t], sizes[s], 1, origin, X);
      CHECK(GradientError(root, RootFn, Types[t], X) < 1e-7);
    }
  }
  CHECK(!ExpressionDestroy(&smooth));
  CHECK(!ExpressionDestroy(&root));
}

/* --- one body ----------------------------------------------------------------------------------------------------- */

static Mesh MakeBody(TestScene *t, PetscBool simplex, PetscInt order, const PetscInt faces[], const char map[])
{
  static const PetscReal lower[] = {0, 0, 0}, upper[] = {1, 1, 1};
  SceneBody             *body;

  SolidSceneInit(t);
  body          = SolidSceneAddBox(t, "body", faces, lower, upper);
  body->simplex = simplex;
  body->order   = order;
  if (map) CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", map, DIM, PETSC_FALSE, &body->map));
  return TestSceneMesh(t);
}

/* The values of a field at the nodes; of none, zeros. */
static Vec Interpolate(Level *level, FieldFn field)
{
  Vec        u;
  PetscReal *a, g[9];

  CHECK(!LevelCreateVec(level, DIM, &u));
  CHECK(!VecGetArray(u, &a));
  for (PetscInt i = 0; field && i < level->num_owned; ++i) field(&level->coords[DIM * i], &a[DIM * i], g);
  CHECK(!VecRestoreArray(u, &a));
  CHECK(!VecGhostUpdateBegin(u, INSERT_VALUES, SCATTER_FORWARD));
  CHECK(!VecGhostUpdateEnd(u, INSERT_VALUES, SCATTER_FORWARD));
  return u;
}

/* Stresses of a gradient, E = 1, nu = 0.3. */
static void Hooke(const PetscReal g[], PetscReal stress[6])
{
  static const PetscInt voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  const PetscReal       nu = 0.3, mu = 1 / (2 * (1 + nu)), lambda = nu / ((1 + nu) * (1 - 2 * nu));

  for (PetscInt s = 0; s < 6; ++s) {
    const PetscInt i = voigt[s][0], j = voigt[s][1];

    stress[s] = mu * (g[3 * i + j] + g[3 * j + i]) + (i == j ? lambda * (g[0] + g[4] + g[8]) : 0);
  }
}

static void QuadraticFn(const PetscReal x[], PetscReal u[], PetscReal g[])
{
  const PetscReal a = x[0], b = x[1], c = x[2];
  const PetscReal all[9] = {0.6 * a - 0.7 * b,
                            -0.8 * a + 0.5 * c,
                            b - 0.2 * c, //
                            -0.7 * a + 0.4 * b + 0.5,
                            1.2 * b,
                            a + 0.6 * b, //
                            0.2 * c,
                            0.5 * a - 0.3,
                            -0.2 * a + 0.8 * c};

  u[0] = 0.3 * a * a - 0.7 * a * b + 0.2 * b * b + 0.5 * b + 0.1 * c * c + 1;
  u[1] = -0.4 * a * a + 0.5 * a * c + 0.6 * b * b - 0.3 * c;
  u[2] = a * b - 0.2 * a * c + 0.3 * b * b + 0.4 * c * c;
  CHECK(!PetscArraycpy(g, all, 9));
}

/* Linear stresses come out exactly at every node of cells of order 2 with straight edges. */
static void TestLinearStress(PetscBool simplex, const char map[])
{
  static const PetscInt faces[] = {3, 2, 2};
  TestScene             t;
  Mesh                  mesh  = MakeBody(&t, simplex, 2, faces, map);
  Level                *level = MeshFinest(mesh);
  Vec                   u     = Interpolate(level, QuadraticFn);
  NodalStress           stress;
  const PetscReal      *s;

  CHECK(!StressCreate(&t.scene, level, u, &stress));
  CHECK(!VecGetArrayRead(stress.value[0], &s));
  for (PetscInt i = 0; i < level->num_owned; ++i) {
    PetscReal v[DIM], g[9], expected[6];

    QuadraticFn(&level->coords[DIM * i], v, g);
    Hooke(g, expected);
    for (PetscInt k = 0; k < 6; ++k) CHECK_NEAR(s[6 * i + k], expected[k], 1e-12);
  }
  CHECK(!VecRestoreArrayRead(stress.value[0], &s));
  CHECK(!NodalStressDestroy(&stress));
  CHECK(!VecDestroy(&u));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* The body at rest against an exact solution. */
static ErrorSquares SquaresOf(const char text[], PetscBool simplex, PetscInt order, PetscInt num)
{
  const PetscInt faces[] = {num, num, num};
  TestScene      t;
  Mesh           mesh = MakeBody(&t, simplex, order, faces, NULL);
  Vec            u    = Interpolate(MeshFinest(mesh), NULL);
  ErrorSquares   squares;

  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-exact", text, DIM, PETSC_FALSE, &t.bodies[0].exact));
  CHECK(!CellErrorsIntegrate(&t.scene, MeshFinest(mesh), u, NULL, &squares));
  CHECK(!ExpressionDestroy(&t.bodies[0].exact));
  CHECK(!VecDestroy(&u));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
  CHECK_NEAR(squares.error_l2 / squares.size_l2, 1, 1e-13);
  CHECK_NEAR(squares.error_energy / squares.size_energy, 1, 1e-13);
  return squares;
}

/* Norms of a polynomial, and of a displacement whose strains have no bound at a corner of the cube. With u =
   (r^(1/2), 0, 0) these are int r = 3^(1/2)/4 - pi/24 + ln(2 + 3^(1/2))/2, and (lambda + 4 mu)/12 int 1/r =
   ... (3/2 ln(2 + 3^(1/2)) - pi/4). */
static void TestNorms(PetscBool simplex, PetscInt order)
{
  const PetscReal nu = 0.3, mu = 1 / (2 * (1 + nu)), lambda = nu / ((1 + nu) * (1 - 2 * nu)), l = log(2 + sqrt(3.));
  ErrorSquares    squares = SquaresOf("x^2, 0, x*y", simplex, order, 2);

  /* strains xx = 2x, xz = y, yz = x */
  CHECK_NEAR(squares.size_l2, 1. / 5 + 1. / 9, 1e-13);
  CHECK_NEAR(squares.size_energy, (lambda + 2 * mu) * 4. / 3 + mu * 2. / 3, 1e-10);
  squares = SquaresOf(RootText, simplex, order, 2);
  CHECK_NEAR(squares.size_l2 / (sqrt(3.) / 4 - PETSC_PI / 24 + l / 2), 1, 1e-6);
  CHECK_NEAR(squares.size_energy / ((lambda + 4 * mu) / 12 * (1.5 * l - PETSC_PI / 4)), 1,
             1e-3); /* as cellerror.c promises */
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestGradient();
  TestLinearStress(PETSC_FALSE, NULL);
  TestLinearStress(PETSC_FALSE, "x + 0.2*x*y, y - 0.1*x*z, z + 0.15*x*y*z");
  TestLinearStress(PETSC_TRUE, "x + 0.2*y, y - 0.3*x + 0.1*z, z");
  for (PetscInt order = 1; order <= 2; ++order) {
    for (PetscInt simplex = 0; simplex < 2; ++simplex) TestNorms((PetscBool)simplex, order);
  }
  PetscCall(PetscFinalize());
  return 0;
}
