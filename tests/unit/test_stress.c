/* test_stress.c -- loads on cells and sides of both orders, and stresses recovered from displacements that are known. */
#include <math.h>
#include "base/compat.h"
#include "problem/elasticity.h"
#include "mesh_scene.h"
#include "result/stress.h"

typedef PetscReal (*Function)(const PetscReal x[]);

/* The values of a vector field at nodes. */
static Vec Interpolate(Level *level, Function ux, Function uy)
{
  Vec          u;
  PetscScalar *a;

  CHECK(!LevelCreateVec(level, 2, &u));
  CHECK(!VecGetArray(u, &a));
  for (PetscInt i = 0; i < level->num_owned; ++i) {
    a[2 * i]     = ux(&level->coords[2 * i]);
    a[2 * i + 1] = uy(&level->coords[2 * i]);
  }
  CHECK(!VecRestoreArray(u, &a));
  CHECK(!VecGhostUpdateBegin(u, INSERT_VALUES, SCATTER_FORWARD));
  CHECK(!VecGhostUpdateEnd(u, INSERT_VALUES, SCATTER_FORWARD));
  return u;
}

static PetscReal Zero(const PetscReal x[])
{
  return 0 * x[0];
}

static PetscReal One(const PetscReal x[])
{
  return 1 + 0 * x[0];
}

static PetscReal X2(const PetscReal x[])
{
  return x[0] * x[0];
}

static PetscReal Ux(const PetscReal x[])
{
  return 0.3 * x[0] * x[0] - 0.7 * x[0] * x[1] + 0.2 * x[1] * x[1] + 0.5 * x[1] + 1;
}

static PetscReal Uy(const PetscReal x[])
{
  return -0.4 * x[0] * x[0] + 0.1 * x[0] * x[1] + 0.6 * x[1] * x[1] - 0.2 * x[0];
}

/* Linear stresses come out exactly at every node of cells of order 2 with straight sides, parallelograms or not, on any
   number of ranks. E = 1, nu = 0.3, plane strain. */
static void TestLinearStress(PetscBool simplex, const char map[])
{
  const PetscReal  E = 1, nu = 0.3, lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  TestScene        t;
  Mesh             mesh;
  Level           *level;
  Vec              u;
  NodalStress      stress;
  const PetscReal *s;
  SceneBody       *body;

  TestSceneInit(&t);
  body          = TestSceneAddBox(&t, "body", 4, 3, -0.2, 0.1, 1, 1);
  body->order   = 2;
  body->simplex = simplex;
  if (map) TestSceneSetMap(body, map);
  mesh  = TestSceneMesh(&t);
  level = MeshFinest(mesh);
  u     = Interpolate(level, Ux, Uy);
  CHECK(!StressCreate(&t.scene, level, u, &stress));
  CHECK(!VecGetArrayRead(stress.value[0], &s));
  for (PetscInt i = 0; i < level->num_owned; ++i) {
    const PetscReal x = level->coords[2 * i], y = level->coords[2 * i + 1];
    const PetscReal xx = 0.6 * x - 0.7 * y, yy = 0.1 * x + 1.2 * y;
    const PetscReal xy = (-0.7 * x + 0.4 * y + 0.5) + (-0.8 * x + 0.1 * y - 0.2);

    CHECK_NEAR(s[6 * i], lambda * (xx + yy) + 2 * mu * xx, 1e-12);
    CHECK_NEAR(s[6 * i + 1], lambda * (xx + yy) + 2 * mu * yy, 1e-12);
    CHECK_NEAR(s[6 * i + 2], lambda * (xx + yy), 1e-12);
    CHECK_NEAR(s[6 * i + 5], mu * xy, 1e-12);
    CHECK(s[6 * i + 3] == 0 && s[6 * i + 4] == 0);
  }
  CHECK(!VecRestoreArrayRead(stress.value[0], &s));
  CHECK(!NodalStressDestroy(&stress));
  CHECK(!VecDestroy(&u));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* The work of the loads on a displacement. */
static PetscReal Work(TestScene *t, Level *level, Function ux, Function uy)
{
  Mat         K;
  Vec         f, u = Interpolate(level, ux, uy);
  PetscScalar work;

  CHECK(!ElasticityAssemble(&t->scene, level, &K, &f));
  CHECK(!VecDot(f, u, &work));
  CHECK(!VecDestroy(&u));
  CHECK(!VecDestroy(&f));
  CHECK(!MatDestroy(&K));
  return PetscRealPart(work);
}

/* The work of polynomial loads on one cell (two triangles): exact as far as loads.c promises, with shape functions of
   their full degree. */
static void TestPolynomialLoads(PetscBool simplex)
{
  TestScene  t;
  Mesh       mesh;
  SceneBody *body;

  TestSceneInit(&t);
  t.scene.thickness = 2;
  body              = TestSceneAddBox(&t, "body", 1, 1, 0, 0, 1, 1);
  body->order       = 2;
  body->simplex     = simplex;
  TestSceneAddBoundary(body, BOUNDARY_TRACTION, "top", "x^9, 5");
  mesh = TestSceneMesh(&t);
  CHECK_NEAR(Work(&t, MeshFinest(mesh), X2, Zero), 2. / 12, 1e-14);
  CHECK_NEAR(Work(&t, MeshFinest(mesh), Zero, X2), 2 * 5. / 3, 1e-14);
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-force", "x^5, 0", 2, PETSC_FALSE, &body->material.body_force));
  CHECK_NEAR(Work(&t, MeshFinest(mesh), X2, Zero), 2. / 12 + 2. / 8, 1e-14);
  CHECK(!ExpressionDestroy(&body->material.body_force));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* A quarter of a ring whose sides are parabolas. The resultant of a pressure on a curve depends on its ends
   alone. The length of the curve, and the area between two, are those of circles but for the fourth power of
   the angle of a cell. */
static void TestCurvedLoads(PetscBool simplex)
{
  const PetscReal angle4 = PetscPowReal(PETSC_PI / 2 / 6, 4);
  TestScene       t;
  Mesh            mesh;
  SceneBody      *body;

  TestSceneInit(&t);
  body          = TestSceneAddBox(&t, "body", 2, 6, 1, 0, 2, 2 * atan(1.));
  body->order   = 2;
  body->simplex = simplex;
  TestSceneSetMap(body, "x*cos(y), x*sin(y)");
  TestSceneAddBoundary(body, BOUNDARY_PRESSURE, "right", "3");
  TestSceneAddBoundary(body, BOUNDARY_TRACTION, "left", "0, 1");
  mesh = TestSceneMesh(&t);
  CHECK_NEAR(Work(&t, MeshFinest(mesh), One, Zero), -3. * 2, 1e-13);
  CHECK_NEAR(Work(&t, MeshFinest(mesh), Zero, One), -3. * 2 + PETSC_PI / 2, 0.1 * angle4);
  CHECK(!ConstantCreate("-force", 2, (PetscReal[]){1, 0}, &body->material.body_force));
  CHECK_NEAR(Work(&t, MeshFinest(mesh), One, Zero), -3. * 2 + 0.75 * PETSC_PI, 0.1 * angle4);
  CHECK(!ExpressionDestroy(&body->material.body_force));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestLinearStress(PETSC_FALSE, NULL);
  TestLinearStress(PETSC_FALSE, "x + 0.2*x*y, y - 0.3*x*y");
  TestLinearStress(PETSC_TRUE, NULL);
  TestLinearStress(PETSC_TRUE, "x + 0.2*y, y - 0.3*x");
  for (int simplex = 0; simplex < 2; ++simplex) {
    TestPolynomialLoads((PetscBool)simplex);
    TestCurvedLoads((PetscBool)simplex);
  }
  PetscCall(PetscFinalize());
  return 0;
}
