/* test_levelsolid.c -- tables of levels in space: prolongation, embedding, Mats, point location, parts. */
#include "refinement/levelrefine.h"
#include "solid_scene.h"

static PetscInt Order[2] = {1, 1}; /* of the bodies that are made next */

/* A box of hexahedra above a box of tetrahedra. */
static Mesh MakeMesh(TestScene *t, PetscInt n, PetscInt refine)
{
  SolidSceneInit(t);
  t->scene.refine = refine;
  SolidSceneAddBox(t, "upper", (PetscInt[]){n, 1, 1}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 1, 1});
  SolidSceneAddBox(t, "lower", (PetscInt[]){n, 1, 1}, (PetscReal[]){0, 0, -1}, (PetscReal[]){1, 1, 0});
  t->bodies[1].simplex = PETSC_TRUE;
  TestSceneAddPair(t, "joint", 0, "bottom", 1, "top");
  for (PetscInt b = 0; b < 2; ++b) t->bodies[b].order = Order[b];
  return TestSceneMesh(t);
}

/* All monomials of a total degree that both orders have. */
static PetscReal Polynomial(const Level *level, PetscInt node, PetscInt order)
{
  const PetscReal *x = &level->coords[3 * node], linear = 1 + 2 * x[0] + 3 * x[1] - x[2];

  if (order == 1) return linear;
  return linear - x[0] * x[0] + 4 * x[0] * x[1] + 5 * x[1] * x[1] - 2 * x[2] * x[2] + 3 * x[0] * x[2] + x[1] * x[2];
}

/* How far a Mat is from taking polynomials from one level to another. */
static PetscReal Miss(Mat P, Level *from, Level *to, const PetscInt order[])
{
  Level    *level[2] = {from, to};
  PetscReal norm;
  Vec       v[2];

  for (int k = 0; k < 2; ++k) {
    PetscScalar *f;

    CHECK(!LevelCreateVec(level[k], 1, &v[k]));
    CHECK(!VecGetArray(v[k], &f));
    for (PetscInt i = 0; i < level[k]->num_owned; ++i) f[i] = Polynomial(level[k], i, order[level[k]->node_body[i]]);
    CHECK(!VecRestoreArray(v[k], &f));
  }
  CHECK(!VecScale(v[1], -1));
  CHECK(!MatMultAdd(P, v[0], v[1], v[1]));
  CHECK(!VecNorm(v[1], NORM_INFINITY, &norm));
  CHECK(!VecDestroy(&v[0]));
  CHECK(!VecDestroy(&v[1]));
  return norm;
}

/* Polynomials of their body's order go from level to level without error. */
static void TestProlongation(PetscInt n)
{
  TestScene t;
  Mesh      mesh = MakeMesh(&t, n, 2);

  for (PetscInt l = 1; l < mesh->num_levels; ++l)
    CHECK_NEAR(Miss(mesh->levels[l].prolongation, &mesh->levels[l - 1], &mesh->levels[l], Order), 0, 1e-13);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* From order 1 to order 2 on the same mesh. */
static void TestEmbedding(PetscInt n)
{
  const PetscInt ones[2] = {1, 1};
  TestScene      low, high;
  Mesh           mesh[2];
  Mat            E;

  Order[0] = Order[1] = 1;
  mesh[0]             = MakeMesh(&low, n, 1);
  Order[0] = Order[1] = 2;
  mesh[1]             = MakeMesh(&high, n, 1);
  CHECK(!LevelCreateEmbedding(MeshFinest(mesh[0]), MeshFinest(mesh[1]), &E));
  CHECK_NEAR(Miss(E, MeshFinest(mesh[0]), MeshFinest(mesh[1]), ones), 0, 1e-13);
  CHECK(!MatDestroy(&E));
  CHECK(!MeshDestroy(&mesh[0]));
  CHECK(!MeshDestroy(&mesh[1]));
  TestSceneFree(&low);
  TestSceneFree(&high);
}

static void TestLocate(void)
{
  static const PetscReal point[][3]  = {{0.3, 0.7, 0.1},   {0, 0, 0},        {1, 1, 1},           {0.5, 0.25, 0},
                                        {0.3, 0.2, -0.7},  {1, 1, -1},       {1.001, 0.5, .5},    {0.5, 0.5, 1e-6},
                                        {0.5, 0.5, -1e-6}, {0.5, -1e-6, .5}, {0.123, 0.77, -.345}};
  static const PetscBool inside[][2] = {{1, 0}, {1, 1}, {1, 0}, {1, 1}, {0, 1}, {0, 1},
                                        {0, 0}, {1, 0}, {0, 1}, {0, 0}, {0, 1}};
  TestScene              t;
  Mesh                   mesh = MakeMesh(&t, 3, 1);

  CheckLocate(MeshFinest(mesh), PETSC_STATIC_ARRAY_LENGTH(point), point[0], inside[0]);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* A piece of a hollow ball: points up to its true surface are inside, none beyond it, though facets are flat or parabolic. */
static void TestLocateBall(PetscBool simplex, PetscInt order)
{
  const PetscReal step = PETSC_PI / 36;
  TestScene       t;
  Mesh            mesh;

  SolidSceneInit(&t);
  SolidSceneAddBox(&t, "ball", (PetscInt[]){1, 3, 3}, (PetscReal[]){1, 0, 0},
                   (PetscReal[]){2, PETSC_PI / 2, PETSC_PI / 3});
  t.bodies[0].simplex = simplex;
  t.bodies[0].order   = order;
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", "x*cos(y)*cos(z), x*sin(y)*cos(z), x*sin(z)", 3, PETSC_FALSE,
                          &t.bodies[0].map));
  mesh = TestSceneMesh(&t);
  for (int i = 0; i <= 18; i += 3) {
    for (int j = 0; j <= 13; ++j) { // j = 13 is beyond the cut at 60 degrees
      const PetscReal cut      = PetscCosReal(j * step),
                      n[3]     = {PetscCosReal(i * step) * cut, PetscSinReal(i * step) * cut, PetscSinReal(j * step)};
      const PetscReal radius[] = {0.8, 1, 1.5, 2, 2.001};

      for (int k = 0; k < 5; ++k) {
        const PetscReal x[] = {radius[k] * n[0], radius[k] * n[1], radius[k] * n[2]};
        PetscReal       xi[3];
        PetscInt        cell;
        PetscBool       found;

        CHECK(!LevelLocate(MeshFinest(mesh), 0, x, &cell, xi, &found));
        CHECK(found == (k > 0 && k < 4 && j < 13));
        CHECK_NEAR(Total(cell >= 0), found, 0);
      }
    }
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  static const PetscInt orders[][2] = {{1, 1}, {1, 2}, {2, 1}};

  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  for (int o = 0; o < 3; ++o) {
    for (int b = 0; b < 2; ++b) Order[b] = orders[o][b];
    TestProlongation(1);
    TestProlongation(3);
    TestLocate();
  }
  TestEmbedding(2);
  for (PetscInt order = 1; order <= 2; ++order) {
    TestLocateBall(PETSC_FALSE, order);
    TestLocateBall(PETSC_TRUE, order);
  }
  CHECK(!PetscFinalize());
  return 0;
}
