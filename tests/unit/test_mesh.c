/* test_mesh.c -- bodies of every kind in one mesh: counts, areas, sides, maps, files, roles. */
#include "mesh_scene.h"

/* Two squares of triangles in both senses; nodes that no cell uses; no names. */
static const char ClockwiseFile[] = MESHES "/clockwise.msh";
/* Triangles below, quadrangles above, in four formats. */
static const char *const RegionFile[] = {MESHES "/two_regions_22.msh", MESHES "/two_regions_22_bin.msh",
                                         MESHES "/two_regions_41.msh", MESHES "/two_regions_41_bin.msh"};
/* Cells and facets in two physical groups, which format 2.2 lists once for each group. */
static const char *const GroupFile[] = {MESHES "/two_groups_22.msh", MESHES "/two_groups_22_bin.msh",
                                        MESHES "/two_groups_41.msh", MESHES "/two_groups_41_bin.msh"};

/* A side's length and the sum of its outward normals. */
static void CheckSide(TestScene *t, Level *level, PetscInt body, const char side[], PetscReal length, PetscReal nx,
                      PetscReal ny)
{
  PetscReal n[2];

  CHECK_NEAR(SideLength(t, level, body, side, n), length, 1e-13);
  CHECK_NEAR(n[0], nx, 1e-13);
  CHECK_NEAR(n[1], ny, 1e-13);
}

/* Two boxes, one of triangles, refined together: everything adds up on every level. */
static void TestBoxes(PetscInt refine)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  t.scene.refine = refine;
  TestSceneAddBoundary(TestSceneAddBox(&t, "upper", 3, 2, 0, 0, 1, 1), BOUNDARY_DISPLACEMENT, "top", "0,0");
  TestSceneAddBox(&t, "lower", 2, 3, -1, -2, 2, 0)->simplex = PETSC_TRUE;
  TestSceneAddBoundary(&t.bodies[1], BOUNDARY_DISPLACEMENT, "bottom+left", "0,0");
  TestSceneAddBoundary(&t.bodies[1], BOUNDARY_PRESSURE, "right", "1");
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top");
  mesh = TestSceneMesh(&t);
  CHECK(mesh->num_levels == refine + 1);
  CHECK(MeshFinest(mesh) == &mesh->levels[refine]);
  for (PetscInt l = 0; l <= refine; ++l) {
    Level         *level = &mesh->levels[l];
    const PetscInt s     = 1 << l;

    CHECK_NEAR(Total(level->num_cells), (6 + 12) * s * s, 0);
    CHECK(level->num_global == (3 * s + 1) * (2 * s + 1) + (2 * s + 1) * (3 * s + 1));
    CHECK_NEAR(Total(level->num_owned), level->num_global, 0);
    CHECK_NEAR(BodyArea(level, 0), 1, 1e-14);
    CHECK_NEAR(BodyArea(level, 1), 6, 1e-14);
    CheckSide(&t, level, 0, "bottom", 1, 0, -1);
    CheckSide(&t, level, 0, "top", 1, 0, 1);
    CheckSide(&t, level, 1, "top", 3, 0, 3);
    CheckSide(&t, level, 1, "right", 2, 2, 0);
    CheckSide(&t, level, 1, "left+bottom+left", 5, -2, -3); // no facet twice
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Refining a body alone gives the box of more cells; the other body is left alone. */
static void TestOwnRefinement(void)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  TestSceneAddBox(&t, "fine", 2, 1, 0, 0, 1, 1)->refine = 2;
  TestSceneAddBox(&t, "coarse", 2, 1, 0, 2, 1, 3);
  TestSceneAddFile(&t, "file", RegionFile[0], "soft")->refine = 1;
  TestSceneAddBoundary(&t.bodies[2], BOUNDARY_NORMAL, "bottom", NULL);
  mesh = TestSceneMesh(&t);
  CHECK_NEAR(Total(mesh->levels[0].num_cells), 8 * 4 + 2 + 14 * 4, 0);
  CHECK_NEAR(BodyArea(&mesh->levels[0], 2), 2, 1e-14);
  CheckSide(&t, &mesh->levels[0], 2, "bottom", 2, 0, -2);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* A quarter of a ring from a box. Its nodes lie on circles on every level; a map that turns inside out does no harm. */
static void TestRing(const char map[], const char inner[], const char outer[])
{
  TestScene t;
  Mesh      mesh;
  PetscReal n[2];

  TestSceneInit(&t);
  t.scene.refine = 2;
  TestSceneAddBox(&t, "ring", 2, 4, 1, 0, 2, PETSC_PI / 2);
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_PRESSURE, inner, "1");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_PRESSURE, outer, "1");
  TestSceneSetMap(&t.bodies[0], map);
  mesh = TestSceneMesh(&t);
  for (PetscInt l = 0; l <= 2; ++l) {
    Level          *level = &mesh->levels[l];
    const PetscReal angle = PETSC_PI / 2 / (4 << l); // chords of this angle
    Facets          facets;

    CHECK_NEAR(BodyArea(level, 0), (4 << l) * 0.5 * PetscSinReal(angle) * 3, 1e-13);
    CHECK_NEAR(SideLength(&t, level, 0, inner, n), (4 << l) * 2 * PetscSinReal(angle / 2), 1e-13);
    CHECK_NEAR(PetscAbsReal(n[0]), 1, 1e-13);
    CHECK_NEAR(n[0] * n[1], 1, 1e-13); // both towards the centre
    CHECK(n[0] < 0);
    CHECK(!LevelGetFacets(level, &t.scene, 0, outer, &facets));
    for (PetscInt f = 0; f < facets.num; ++f) {
      const PetscReal *x = &level->coords[2 * facets.nodes[f * ELEMENT_MAX_FACET_NODES]];

      CHECK_NEAR(x[0] * x[0] + x[1] * x[1], 4, 1e-14);
    }
    CHECK(!FacetsDestroy(&facets));
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* The same mesh in four formats, whole: triangles and quadrangles in one body. */
static void TestFormats(void)
{
  for (int f = 0; f < 4; ++f) {
    TestScene t;
    Mesh      mesh;

    TestSceneInit(&t);
    t.scene.refine = 1;
    TestSceneAddBoundary(TestSceneAddFile(&t, "both", RegionFile[f], NULL), BOUNDARY_NORMAL, "bottom", NULL);
    TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "top side+15", NULL);
    TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "right of both", NULL);
    TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "7", NULL);
    mesh = TestSceneMesh(&t);
    CHECK_NEAR(Total(mesh->levels[0].num_cells), 17, 0);
    CHECK(mesh->levels[0].num_global == 17);
    CHECK_NEAR(Total(mesh->levels[1].num_cells), 68, 0);
    for (PetscInt l = 0; l < 2; ++l) {
      CHECK_NEAR(BodyArea(&mesh->levels[l], 0), 3, 1e-13);
      CheckSide(&t, &mesh->levels[l], 0, "bottom", 2, 0, -2);
      CheckSide(&t, &mesh->levels[l], 0, "top side+15", 3, -1, 2);
      CheckSide(&t, &mesh->levels[l], 0, "7", 1.5, 1.5, 0);
      CheckSide(&t, &mesh->levels[l], 0, "right of both", 1.5, 1.5, 0); // the same lines as 7, which has no name
    }
    CHECK(!MeshDestroy(&mesh));
    TestSceneFree(&t);
  }
}

/* Two bodies from the regions of one file: the line between them is a side of both, and its nodes are there twice. */
static void TestRegions(void)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  TestSceneAddFile(&t, "soft", RegionFile[2], "soft");
  TestSceneAddFile(&t, "stiff", RegionFile[2], "2");
  TestSceneAddPair(&t, "joint", 0, "between", 1, "12");
  mesh = TestSceneMesh(&t);
  CHECK(mesh->levels[0].num_global == 13 + 8);
  CHECK_NEAR(BodyArea(&mesh->levels[0], 0), 2, 1e-13);
  CHECK_NEAR(BodyArea(&mesh->levels[0], 1), 1, 1e-13);
  CheckSide(&t, &mesh->levels[0], 0, "between", 2, 0, 2);
  CheckSide(&t, &mesh->levels[0], 1, "12", 2, 0, -2);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Clockwise cells, and nodes that no cell uses. */
static void TestClockwise(void)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  TestSceneAddBoundary(TestSceneAddFile(&t, "mixed", ClockwiseFile, NULL), BOUNDARY_NORMAL, "3", NULL);
  mesh = TestSceneMesh(&t);
  CHECK(mesh->levels[0].num_global == 6);
  CHECK_NEAR(BodyArea(&mesh->levels[0], 0), 2, 1e-14);
  CheckSide(&t, &mesh->levels[0], 0, "3", 2, 0, -2);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Whether the sides of an open pair are swapped. */
static PetscBool RolesSwapped(PetscReal young_0, PetscReal young_1, PetscInt n_0, PetscInt n_1, PetscReal length_1)
{
  TestScene t;
  Mesh      mesh;
  PetscBool swapped;

  TestSceneInit(&t);
  TestSceneAddBox(&t, "upper", n_0, 1, 0, 0, 1, 1);
  TestSceneAddBox(&t, "lower", n_1, 1, 0, -1, length_1, 0);
  for (PetscInt b = 0; b < 2; ++b) {
    CHECK(!ExpressionDestroy(&t.bodies[b].material.young));
    CHECK(!ConstantCreate("-young", 1, b ? &young_1 : &young_0, &t.bodies[b].material.young));
  }
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top")->roles_open = PETSC_TRUE;
  mesh                                                             = TestSceneMesh(&t);
  swapped = t.pairs[0].nonmortar.body == 1 ? PETSC_TRUE : PETSC_FALSE;
  CHECK(!strcmp(t.pairs[0].nonmortar.side, swapped ? "top" : "bottom"));
  CHECK(!strcmp(t.pairs[0].mortar.side, swapped ? "bottom" : "top"));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
  return swapped;
}

/* Softer beats finer, finer beats shorter. */
static void TestRoles(void)
{
  CHECK(RolesSwapped(10, 1, 8, 4, 1));  // lower is softer, though coarser
  CHECK(!RolesSwapped(1, 10, 4, 8, 1)); // upper is softer, though coarser
  CHECK(RolesSwapped(2, 1, 4, 5, 1));   // lower is finer; stiffness is alike
  CHECK(!RolesSwapped(2, 1, 5, 4, 1));
  CHECK(RolesSwapped(1, 1, 4, 2, 0.5)); // the same facets on a shorter side
  CHECK(!RolesSwapped(1, 1, 4, 4, 1));  // nothing speaks for a swap
}

/* A cell in two groups is one cell, in either region and without one, and its edges are those of two cells at most. */
static void TestGroups(const char file[], const char region[], PetscReal area)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  t.scene.refine = 1;
  TestSceneAddBoundary(TestSceneAddFile(&t, "block", file, region), BOUNDARY_NORMAL, "foot", NULL);
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "left foot", NULL);
  mesh = TestSceneMesh(&t);
  for (PetscInt l = 0; l < mesh->num_levels; ++l) {
    CHECK_NEAR(BodyArea(&mesh->levels[l], 0), area, 1e-14);
    CheckSide(&t, &mesh->levels[l], 0, "foot", area, 0, -area);
    CheckSide(&t, &mesh->levels[l], 0, "left foot", 1, 0, -1);
  }
  CHECK(t.bodies[0].num_nonmanifold == 0);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  TestBoxes(0);
  TestBoxes(2);
  TestOwnRefinement();
  TestRing("x*cos(y), x*sin(y)", "left", "right");
  TestRing("x*sin(y), x*cos(y)", "left", "right");
  TestFormats();
  TestRegions();
  TestClockwise();
  TestRoles();
  for (int f = 0; f < 4; ++f) {
    TestGroups(GroupFile[f], NULL, 2);
    TestGroups(GroupFile[f], "all", 2);
    TestGroups(GroupFile[f], "left half", 1);
  }
  CHECK(!PetscFinalize());
  return 0;
}
