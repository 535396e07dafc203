/* test_mesh.c -- bodies of every kind in one mesh: counts, areas, sides. */
#include "mesh_scene.h"

/* Two boxes, one of triangles, refined together: everything adds up on every level. */
static void TestBoxes(PetscInt refine)
{
  TestScene t;
  Mesh      mesh;
  PetscReal n[2];

  TestSceneInit(&t);
  t.scene.refine = refine;
  TestSceneAddBoundary(TestSceneAddBox(&t, "upper", 3, 2, 0, 0, 1, 1), BOUNDARY_DISPLACEMENT, "top", "0,0");
  TestSceneAddBox(&t, "lower", 2, 3, -1, -2, 2, 0)->simplex = PETSC_TRUE;
  TestSceneAddBoundary(&t.bodies[1], BOUNDARY_DISPLACEMENT, "bottom+left", "0,0");
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top");
  mesh = TestSceneMesh(&t);
  CHECK(mesh->num_levels == refine + 1);
  for (PetscInt l = 0; l <= refine; ++l) {
    Level         *level = &mesh->levels[l];
    const PetscInt s     = 1 << l;

    CHECK_NEAR(Total(level->num_cells), (6 + 12) * s * s, 0);
    CHECK(level->num_global == (3 * s + 1) * (2 * s + 1) + (2 * s + 1) * (3 * s + 1));
    CHECK_NEAR(Total(level->num_owned), level->num_global, 0);
    CHECK_NEAR(BodyArea(level, 0), 1, 1e-14);
    CHECK_NEAR(BodyArea(level, 1), 6, 1e-14);
    CHECK_NEAR(SideLength(&t, level, 0, "bottom", n), 1, 1e-14);
    CHECK_NEAR(n[0], 0, 1e-14);
    CHECK_NEAR(n[1], -1, 1e-14);
    CHECK_NEAR(SideLength(&t, level, 1, "left+bottom+left", n), 5, 1e-14);
    CHECK_NEAR(n[0], -2, 1e-14);
    CHECK_NEAR(n[1], -3, 1e-14);
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!FaultInitialize());
  TestBoxes(0);
  TestBoxes(2);
  CHECK(!PetscFinalize());
  return 0;
}
