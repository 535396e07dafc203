/* test_level.c -- tables, prolongation, Vecs, Mats and point location, on any number of ranks. */
#include "level/ghosted.h"
#include "mesh_scene.h"

/* Orders of the upper and of the lower body. */
static const PetscInt Orders[][2] = {{1, 1}, {1, 2}, {2, 1}};
static PetscInt       Order[2]    = {1, 1}; /* of the meshes that are made next */
enum { NUM_ORDERS = 3 };

/* A box of quads above a box of triangles, refined; nx = 1 leaves ranks without cells. */
static Mesh MakeMesh(TestScene *t, PetscInt nx, PetscInt refine, const char map[])
{
  TestSceneInit(t);
  t->scene.refine = refine;
  TestSceneAddBox(t, "upper", nx, 1, 0, 0, 1, 1);
  TestSceneAddBox(t, "lower", nx, 1, 0, -1, 1, 0)->simplex = PETSC_TRUE;
  TestSceneAddPair(t, "joint", 0, "bottom", 1, "top");
  if (map) TestSceneSetMap(&t->bodies[1], map);
  for (PetscInt b = 0; b < 2; ++b) t->bodies[b].order = Order[b];
  return TestSceneMesh(t);
}

/* Numbers are contiguous per rank, ghosts follow the owned, and all ranks agree on where a node is. */
static void TestTables(PetscInt nx, PetscInt refine)
{
  TestScene t;
  Mesh      mesh  = MakeMesh(&t, nx, refine, "2*x+y, y");
  Level    *level = MeshFinest(mesh);
  Vec       v, local;

  for (PetscInt i = 0; i < level->num_nodes; ++i) {
    if (i < level->num_owned)
      CHECK(level->node_global[i] == level->node_begin + i);
    else
      CHECK(level->node_global[i] < level->node_begin || level->node_global[i] >= level->node_begin + level->num_owned);
  }
  for (PetscInt c = 0; c < level->num_cells; ++c) {
    CHECK(level->cell_start[c + 1] - level->cell_start[c] == ElementNumNodes((ElementType)level->cell_type[c]));
    CHECK(level->cell_type[c] ==
          (PetscInt)ElementOfOrder(level->cell_body[c] ? ELEMENT_TRI3 : ELEMENT_QUAD4, Order[level->cell_body[c]]));
    for (PetscInt i = level->cell_start[c]; i < level->cell_start[c + 1]; ++i) {
      CHECK(level->cell_nodes[i] >= 0 && level->cell_nodes[i] < level->num_nodes);
      CHECK(level->node_body[level->cell_nodes[i]] == level->cell_body[c]);
    }
  }
  CHECK(!LevelCreateVec(level, 2, &v));
  CHECK(!VecGhostGetLocalForm(v, &local));
  for (int sign = -1; sign <= 1; sign += 2) { // the largest of x and of -x on all ranks is this rank's own
    PetscScalar *x;

    CHECK(!VecGetArray(local, &x));
    for (PetscInt i = 0; i < 2 * level->num_nodes; ++i) x[i] = sign * level->coords[i];
    CHECK(!VecRestoreArray(local, &x));
    CHECK(!LevelShareVec(v, MAX_VALUES));
    CHECK(!VecGetArray(local, &x));
    for (PetscInt i = 0; i < 2 * level->num_nodes; ++i) CHECK(x[i] == sign * level->coords[i]);
    CHECK(!VecRestoreArray(local, &x));
  }
  CHECK(!VecGhostRestoreLocalForm(v, &local));
  CHECK(!VecDestroy(&v));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Sums over ranks: every node gets the number of its cells. */
static void TestShare(void)
{
  TestScene          t;
  Mesh               mesh  = MakeMesh(&t, 4, 1, NULL);
  Level             *level = MeshFinest(mesh);
  Vec                v;
  PetscScalar       *sum;
  const PetscScalar *x;

  CHECK(!LevelCreateVec(level, 1, &v));
  CHECK(!GhostedGetArray(v, &sum));
  for (PetscInt i = 0; i < level->cell_start[level->num_cells]; ++i) sum[level->cell_nodes[i]] += 1;
  CHECK(!GhostedRestoreArray(v, &sum));
  CHECK(!LevelShareVec(v, ADD_VALUES));
  CHECK(!GhostedGetArrayRead(v, &x));
  for (PetscInt i = 0; i < level->num_nodes; ++i) {
    const PetscReal *at       = &level->coords[2 * i];
    const PetscBool  inside_x = at[0] > 0 && at[0] < 1 ? PETSC_TRUE : PETSC_FALSE;
    const PetscBool  inside_y = PetscAbsReal(at[1]) > 0 && PetscAbsReal(at[1]) < 1 ? PETSC_TRUE : PETSC_FALSE;

    if (level->node_body[i] == 0)
      CHECK(x[i] == (inside_x ? 2 : 1) * (inside_y ? 2 : 1));
    else if (inside_x && inside_y)
      CHECK(x[i] == 6);
  }
  CHECK(!GhostedRestoreArrayRead(v, &x));
  CHECK(!VecDestroy(&v));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* 1 + 2 x + 3 y, and in bodies of order 2 quadratic terms as well. */
static PetscReal Polynomial(const Level *level, PetscInt node)
{
  const PetscReal x = level->coords[2 * node], y = level->coords[2 * node + 1], linear = 1 + 2 * x + 3 * y;

  return level->scene->bodies[level->node_body[node]].order > 1 ? linear - x * x + 4 * x * y + 5 * y * y : linear;
}

/* Polynomials of their body's order go from level to level without error. */
static void TestProlongation(PetscInt nx)
{
  TestScene t;
  Mesh      mesh = MakeMesh(&t, nx, 3, NULL);

  CHECK(!mesh->levels[0].prolongation);
  for (PetscInt l = 1; l < mesh->num_levels; ++l) {
    Vec       v[2];
    PetscReal norm;

    for (int k = 0; k < 2; ++k) { // on the coarse and on the fine level
      Level       *level = &mesh->levels[l - 1 + k];
      PetscScalar *f;

      CHECK(!LevelCreateVec(level, 1, &v[k]));
      CHECK(!VecGetArray(v[k], &f));
      for (PetscInt i = 0; i < level->num_owned; ++i) f[i] = Polynomial(level, i);
      CHECK(!VecRestoreArray(v[k], &f));
    }
    CHECK(!VecScale(v[1], -1));
    CHECK(!MatMultAdd(mesh->levels[l].prolongation, v[0], v[1], v[1]));
    CHECK(!VecNorm(v[1], NORM_INFINITY, &norm));
    CHECK_NEAR(norm, 0, 1e-14);
    CHECK(!VecDestroy(&v[0]));
    CHECK(!VecDestroy(&v[1]));
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

static void TestLocate(void)
{
  static const PetscReal point[][2]  = {{0.3, 0.7},  {0, 0},  {1, 1},       {0.5, 0},    {0.25, 0.5},
                                        {0.3, -0.7}, {1, -1}, {1.001, 0.5}, {0.5, 1e-6}, {0.5, -1e-6}};
  static const PetscBool inside[][2] = {{1, 0}, {1, 1}, {1, 0}, {1, 1}, {1, 0}, {0, 1}, {0, 1}, {0, 0}, {1, 0}, {0, 1}};
  TestScene              t;
  Mesh                   mesh = MakeMesh(&t, 4, 1, NULL);

  CheckLocate(MeshFinest(mesh), PETSC_STATIC_ARRAY_LENGTH(point), point[0], inside[0]);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Points of a ring are inside up to the true arc, not beyond it, though the facets are chords or parabolas. */
static void TestLocateCurve(PetscInt order)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  TestSceneAddBox(&t, "ring", 2, 4, 1, 0, 2, PETSC_PI / 2)->order = order;
  TestSceneSetMap(&t.bodies[0], "x*cos(y), x*sin(y)");
  mesh = TestSceneMesh(&t);
  for (int i = 0; i <= 32; ++i) { // chords lie up to 0.02 R inside of the arc
    const PetscReal angle = i * PETSC_PI / 64, c = PetscCosReal(angle), s = PetscSinReal(angle);
    const PetscReal radius[] = {0.95, 1, 1.5, 2, 2.01};

    for (int k = 0; k < 5; ++k) {
      const PetscReal x[] = {radius[k] * c, radius[k] * s};
      PetscReal       xi[2];
      PetscInt        cell;
      PetscBool       found;

      CHECK(!LevelLocate(MeshFinest(mesh), 0, x, &cell, xi, &found));
      CHECK(found == (k > 0 && k < 4));
      CHECK_NEAR(Total(cell >= 0), found, 0);
    }
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  TestShare();
  for (int o = 0; o < NUM_ORDERS; ++o) {
    for (int b = 0; b < 2; ++b) Order[b] = Orders[o][b];
    TestTables(5, 2);
    TestTables(1, 0); // three cells
    TestTables(1, 1);
    TestProlongation(1);
    TestProlongation(3);
    TestLocate();
  }
  TestLocateCurve(1);
  TestLocateCurve(2);
  CHECK(!PetscFinalize());
  return 0;
}
