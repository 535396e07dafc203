/* test_meshsolid.c -- bodies in space, on any number of ranks: volumes, sides, levels, maps. */
#include "solid_scene.h"
#include "level/level.h"
#include "mesh/boxparts.h"
#include "mesh/mesh.h"
#include "refinement/curves.h"

/* A box of hexahedra above one of tetrahedra: every measure of both on every level. */
static void TestBoxes(PetscInt refine, PetscInt order)
{
  TestScene t;
  Mesh      mesh;

  SolidSceneInit(&t);
  t.scene.refine                                                                                              = refine;
  SolidSceneAddBox(&t, "upper", (PetscInt[]){3, 2, 1}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 2, 3})->order = order;
  SolidSceneAddBox(&t, "lower", (PetscInt[]){1, 2, 2}, (PetscReal[]){-1, 0, -2}, (PetscReal[]){2, 2, 0})->order = order;
  t.bodies[1].simplex = PETSC_TRUE;
  for (int s = 0; s < 6; ++s) {
    TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, SolidSides[s], NULL);
    TestSceneAddBoundary(&t.bodies[1], BOUNDARY_NORMAL, SolidSides[s], NULL);
  }
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top");
  mesh = TestSceneMesh(&t);
  CHECK(mesh->num_levels == refine + 1);
  for (PetscInt l = 0; l <= refine; ++l) {
    Level         *level = &mesh->levels[l];
    const PetscInt s = 1 << l, k = order * s;

    CHECK(level->dim == 3);
    CHECK_NEAR(Total(level->num_cells), (6 + 6 * 4) * s * s * s, 0);
    CHECK(level->num_global == (3 * k + 1) * (2 * k + 1) * (k + 1) + (k + 1) * (2 * k + 1) * (2 * k + 1));
    CHECK_NEAR(Total(level->num_owned), level->num_global, 0);
    CHECK_NEAR(SolidVolume(level, 0), 6, 1e-12);
    CHECK_NEAR(SolidVolume(level, 1), 12, 1e-12);
    SolidCheckBoxSides(&t, level, 0, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 2, 3});
    SolidCheckBoxSides(&t, level, 1, (PetscReal[]){-1, 0, -2}, (PetscReal[]){2, 2, 0});
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Boxes of many cells, which all ranks make. Each has its share before anything is parted, and ranks agree on
   what they share, on all levels. */
static void TestParts(PetscInt order, PetscBool simplex)
{
  const PetscInt n = 13;
  PetscMPIInt    size;
  TestScene      t;
  Mesh           mesh;

  CHECK(!MPI_Comm_size(PETSC_COMM_WORLD, &size));
  SolidSceneInit(&t);
  t.scene.refine = order == 1;
  SolidSceneAddBox(&t, "upper", (PetscInt[]){17, 15, 9}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 2, 3})->order = order;
  SolidSceneAddBox(&t, "lower", (PetscInt[]){n, n, n}, (PetscReal[]){-1, 0, -2}, (PetscReal[]){2, 2, 0})->order = order;
  t.bodies[1].simplex = simplex;
  for (int s = 0; s < 6; ++s) TestSceneAddBoundary(&t.bodies[1], BOUNDARY_NORMAL, SolidSides[s], NULL);
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top");
  CHECK(BoxPartsWanted(&t.scene, 0, size) == (size > 1));
  if (size > 1) {
    PetscInt begin, end;
    Curves   none;
    DM       dm;

    CHECK(!BoxPartsCreate(&t.scene, 0, &dm, &none));
    CHECK(!DMPlexGetHeightStratum(dm, 0, &begin, &end));
    if (!simplex) CHECK(end - begin < 1.15 * (17 * 15 * 9 + n * n * n) / size);
    CHECK(Total(end - begin) == 17 * 15 * 9 + n * n * n * (simplex ? 6 : 1));
    CHECK(!DMPlexCheckSymmetry(dm));
    CHECK(!DMPlexCheckFaces(dm, 0));
    CHECK(!DMPlexCheckInterfaceCones(dm));
    CHECK(!CurvesDestroy(&none));
    CHECK(!DMDestroy(&dm));
  }
  mesh = TestSceneMesh(&t);
  for (PetscInt l = 0; l < mesh->num_levels; ++l) {
    Level         *level = &mesh->levels[l];
    const PetscInt k = order << l, m = n * k + 1;

    CHECK(level->num_global == (17 * k + 1) * (15 * k + 1) * (9 * k + 1) + m * m * m);
    CHECK_NEAR(Total(level->num_owned), level->num_global, 0);
    CHECK_NEAR(SolidVolume(level, 0), 6, 1e-9); // a sum of 100,000 cells
    CHECK_NEAR(SolidVolume(level, 1), 12, 1e-9);
    SolidCheckBoxSides(&t, level, 1, (PetscReal[]){-1, 0, -2}, (PetscReal[]){2, 2, 0});
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Curved bodies, inside out or not: the divergence of (x, y, z) / 3 in the isoparametric body is its flux through all
   sides. */
static void TestMaps(PetscBool simplex, PetscInt order)
{
  static const char *const map[] = {"x*cos(y), x*sin(y), z+0.2*x", "x*cos(y), -x*sin(y), z", "y, x, z+x*y/5",
                                    "x+0.1*sin(3*y), y+0.1*sin(3*z), z+0.1*sin(3*x)"};

  for (size_t m = 0; m < sizeof(map) / sizeof(map[0]); ++m) {
    TestScene t;
    Mesh      mesh;

    SolidSceneInit(&t);
    t.scene.refine = 1;
    SolidSceneAddBox(&t, "body", (PetscInt[]){2, 3, 2}, (PetscReal[]){1, 0, 0}, (PetscReal[]){2, 1.5, 1})->order =
        order;
    t.bodies[0].simplex = simplex;
    for (int s = 0; s < 6; ++s) TestSceneAddBoundary(&t.bodies[0], BOUNDARY_PRESSURE, SolidSides[s], NULL);
    CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", map[m], 3, PETSC_FALSE, &t.bodies[0].map));
    mesh = TestSceneMesh(&t);
    for (PetscInt l = 0; l <= 1; ++l) {
      SideSums sums;

      SolidSumSide(&t, &mesh->levels[l], 0, "left+right+front+back+bottom+top", &sums);
      CHECK_NEAR(sums.flux / 3, SolidVolume(&mesh->levels[l], 0), 1e-12);
      CHECK(sums.flux > 0);
      for (int d = 0; d < 3; ++d) CHECK_NEAR(sums.normal[d], 0, 1e-12); // of a closed surface
    }
    CHECK(!MeshDestroy(&mesh));
    TestSceneFree(&t);
  }
}

/* Whether the sides of an open pair are swapped. */
static PetscBool RolesSwapped(PetscInt n_0, PetscInt n_1, PetscReal width_1)
{
  TestScene t;
  Mesh      mesh;
  PetscBool swapped;

  SolidSceneInit(&t);
  SolidSceneAddBox(&t, "upper", (PetscInt[]){n_0, n_0, 1}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 1, 1});
  SolidSceneAddBox(&t, "lower", (PetscInt[]){n_1, n_1, 1}, (PetscReal[]){0, 0, -1}, (PetscReal[]){1, width_1, 0});
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top")->roles_open = PETSC_TRUE;
  mesh                                                             = TestSceneMesh(&t);
  swapped = t.pairs[0].nonmortar.body == 1 ? PETSC_TRUE : PETSC_FALSE;
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
  return swapped;
}

/* Between materials that are alike, facets of smaller area carry the multiplier. */
static void TestRoles(void)
{
  CHECK(RolesSwapped(3, 4, 1));
  CHECK(!RolesSwapped(4, 3, 1));
  CHECK(!RolesSwapped(3, 3, 1));
  CHECK(RolesSwapped(3, 3, 0.5)); // as many facets on half the area
}

/* Refinement keeps the shape of tetrahedra: volume over the cube of the mean edge, against a regular one's. */
static void TestShapes(void)
{
  TestScene t;
  Mesh      mesh;

  SolidSceneInit(&t);
  t.scene.refine = 3;
  SolidSceneAddBox(&t, "cube", (PetscInt[]){1, 1, 1}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 1, 1});
  t.bodies[0].simplex = PETSC_TRUE;
  mesh                = TestSceneMesh(&t);
  for (PetscInt l = 0; l <= 3; ++l) {
    const Level *level = &mesh->levels[l];

    for (PetscInt c = 0; c < level->num_cells; ++c) {
      PetscReal X[12], square = 0;

      SolidNodes(level, 4, &level->cell_nodes[level->cell_start[c]], X);
      for (PetscInt e = 0; e < 6; ++e) {
        const PetscInt *ends = ElementEdgeNodes(ELEMENT_TET4, e);

        for (int d = 0; d < 3; ++d) square += PetscSqr(X[3 * ends[0] + d] - X[3 * ends[1] + d]) / 6;
      }
      CHECK(PetscSqrtReal(2) * ElementMinJacobian(ELEMENT_TET4, X) > 0.56 * PetscPowReal(square, 1.5));
    }
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  for (PetscInt order = 1; order <= 2; ++order) {
    TestBoxes(1, order);
    for (int simplex = 0; simplex < 2; ++simplex) TestMaps(simplex ? PETSC_TRUE : PETSC_FALSE, order);
  }
  TestParts(1, PETSC_TRUE);
  TestParts(2, PETSC_FALSE);
  TestRoles();
  TestShapes();
  CHECK(!PetscFinalize());
  return 0;
}
