/* test_meshfaults.c -- every mistake that only the mesh can tell is one sentence that names the culprit. */
#include "solid_scene.h"
#include "support/support.h"

static char FileName[PETSC_MAX_PATH_LEN]; /* written for one test after the other, removed in the end */

/* A file of format 2.2: `nodes` and `elements` begin with their number. */
static void WriteFile(const char nodes[], const char elements[])
{
  PetscMPIInt rank;
  FILE       *file;

  CHECK(!MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank) return;
  file = fopen(FileName, "w");
  CHECK(file);
  fprintf(file, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%s\n$EndNodes\n$Elements\n%s\n$EndElements\n", nodes,
          elements);
  CHECK(!fclose(file));
}

/* Meshes the scene, and gathers its supports if that went well; the fault must say all the words (up to a NULL). */
static void CheckFault(TestScene *t, const char *const words[])
{
  Mesh           mesh;
  PetscErrorCode code;
  Support        support;

  CHECK(!MeshCreate(&t->scene, &mesh));
  code = MeshSetUp(mesh);
  if (!code) code = SupportCreate(MeshFinest(mesh), &t->scene, &support);
  CHECK(code == MORTISE_ERR_USER);
  for (; *words; ++words) {
    if (strstr(UserErrorSentence(), *words)) continue;
    fprintf(stderr, "'%s' does not say '%s'\n", UserErrorSentence(), *words);
    CHECK(0);
  }
  CHECK(!MPI_Barrier(PETSC_COMM_WORLD));
}

/* A body `block` from the file under test, held on `side`. */
static void CheckFileFault(const char nodes[], const char elements[], const char region[], const char side[],
                           const char *const words[])
{
  TestScene t;

  WriteFile(nodes, elements);
  TestSceneInit(&t);
  TestSceneAddBoundary(TestSceneAddFile(&t, "block", FileName, region), BOUNDARY_NORMAL, side, NULL);
  CheckFault(&t, words);
}

static const char Square[] = "4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0"; /* the corners of the unit square */

static void TestFiles(void)
{
  static const char cells[] = "3\n1 1 2 5 1 1 2\n2 2 2 1 1 1 2 3\n3 2 2 2 1 1 3 4";

  CheckFileFault(Square, cells, NULL, "6",
                 (const char *[]){"body 'block'", "side '6'", FileName, "its sides are 5", NULL});
  CheckFileFault(Square, cells, NULL, "left", (const char *[]){"side 'left'", "its sides are 5", NULL});
  CheckFileFault(Square, cells, "2", "5", (const char *[]){"side '5'", "physical curves", NULL}); // on the other region
  CheckFileFault(
      Square, "4\n1 1 2 5 1 1 2\n2 1 2 5 1 1 3\n3 2 2 2 1 1 2 3\n4 2 2 1 1 1 3 4", NULL, "5",
      (const char *[]){"side '5' of body 'block'", "facets inside the body (1)", "-block_mesh_region", NULL});
  CheckFileFault(Square, cells, NULL, "2", (const char *[]){"side '2'", "which is a surface", "its sides are 5", NULL});
  CheckFileFault(Square, cells, "5", "5",
                 (const char *[]){"-block_mesh_region 5", "which is a curve", "it has 1, 2", NULL});
  CheckFileFault(Square, cells, "wood", "5", (const char *[]){"-block_mesh_region wood", "it has 1, 2", NULL});
  CheckFileFault(Square, "1\n1 2 2 1 1 1 2 9", NULL, "5",
                 (const char *[]){"-block_dm_plex_filename", FileName, "element 1 refers to node 9", NULL});
  CheckFileFault("3\n1 0 0 0\n2 1 0 0\n3 x 1 0", cells, NULL, "5",
                 (const char *[]){FileName, "text instead of a coordinate", NULL});
  CheckFileFault(Square, "2\n1 2 2 1 1 1 2 3", NULL, "5",
                 (const char *[]){FileName, "text instead of a whole number", NULL});
  CheckFileFault(Square, "1\n1 1 2 5 1 1 2", NULL, "5", (const char *[]){FileName, "dimension 1", "gmsh -2", NULL});
  CheckFileFault(Square, "1\n1 4 2 1 1 1 2 3 4", NULL, "5",
                 (const char *[]){FileName, "dimension 3", "the scene has 2", "-model solid", NULL});
  CheckFileFault(Square, "1\n1 21 2 1 1 1 2 3 4 1 2 3 4 1 2", NULL, "5",
                 (const char *[]){FileName, "type 21", "hexahedra of first and second order", NULL});
  CheckFileFault("4\n1 0 0 0\n2 1 0 0\n3 1 0 1\n4 0 0 1", cells, NULL, "5",
                 (const char *[]){FileName, "not parallel to the x,y plane", "gmsh -3", NULL});
  CheckFileFault(
      Square, "3\n1 1 2 5 1 2 4\n2 2 2 1 1 1 2 3\n3 2 2 2 1 1 3 4", NULL, "5",
      (const char *[]){FileName, "lines in physical group 5", "(1, 0) (0, 1)", "not a facet of any cell", NULL});
}

/* Cells that cannot be computed with. */
static void TestCells(void)
{
  CheckFileFault(Square, "2\n1 1 2 5 1 1 2\n2 3 2 1 1 1 2 4 3", NULL, "5",
                 (const char *[]){"'block'", "tangled", "(1, 1)", NULL}); // bow tie
  CheckFileFault("3\n1 0 0 0\n2 1 0 0\n3 2 0 0", "2\n1 1 2 5 1 1 2\n2 2 2 1 1 1 2 3", NULL, "5",
                 (const char *[]){"degenerate", "(2, 0)", NULL});
  CheckFileFault(Square, "4\n1 1 2 5 1 1 2\n2 2 2 1 1 1 2 3\n3 2 2 1 1 1 3 4\n4 3 2 1 1 1 2 3 4", NULL, "5",
                 (const char *[]){"overlap at", NULL});
}

/* A triangle of second order whose curved side goes through the opposite vertex. Its vertices alone are
   sound, those of its parts after a split are not. */
static void TestCurvedCells(void)
{
  static const char nodes[] = "6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.5 0 0\n5 -0.1 -0.1 0\n6 0 0.5 0";
  static const char cells[] = "2\n1 8 2 5 1 1 2 4\n2 9 2 1 1 1 2 3 4 5 6";

  for (PetscInt order = 1; order <= 2; ++order) {
    TestScene t;
    Mesh      mesh;

    WriteFile(nodes, cells);
    TestSceneInit(&t);
    TestSceneAddFile(&t, "block", FileName, NULL)->order = order;
    TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "5", NULL);
    if (order > 1) {
      CheckFault(&t, (const char *[]){"'block'", "degenerate or tangled", "(1, 0)", NULL});
    } else {
      mesh = TestSceneMesh(&t);
      CHECK_NEAR(BodyArea(&mesh->levels[0], 0), 0.5, 1e-14);
      CHECK(!MeshDestroy(&mesh));
      t.scene.refine = 1;
      CheckFault(&t, (const char *[]){"'block'", "inside out", "curved sides", "-block_order 2", NULL});
    }
  }
}

static void TestFileNames(void)
{
  TestScene t;

  TestSceneInit(&t);
  TestSceneAddFile(&t, "block", "no/such/file.msh", NULL);
  CheckFault(&t, (const char *[]){"-block_dm_plex_filename no/such/file.msh", "cannot be opened", NULL});
  TestSceneInit(&t);
  TestSceneAddFile(&t, "block", "mesh.txt", NULL);
  CheckFault(&t, (const char *[]){"-block_dm_plex_filename mesh.txt", "files of this ending",
                                  ".msh, version 2.2 or 4.1", NULL});
}

static void TestBoxSides(void)
{
  TestScene t;

  TestSceneInit(&t);
  TestSceneAddBoundary(TestSceneAddBox(&t, "block", 1, 1, 0, 0, 1, 1), BOUNDARY_NORMAL, "left+front", NULL);
  CheckFault(&t, (const char *[]){"'block'", "'front'", "left, right, bottom and top", NULL});
}

static void CheckMapFault(const char map[], const char *const words[])
{
  TestScene t;

  TestSceneInit(&t);
  TestSceneAddBox(&t, "block", 4, 4, 0, 0, 1, 1);
  TestSceneSetMap(&t.bodies[0], map);
  CheckFault(&t, words);
}

static void TestMaps(void)
{
  CheckMapFault("x, 1/(x-0.5)", (const char *[]){"-map", NULL}); // infinite in the middle
  CheckMapFault("x, x", (const char *[]){"'block'", "degenerate", "after its map", NULL});
  CheckMapFault("x*cos(y), x*sin(y)",
                (const char *[]){"'block'", "degenerate", NULL}); // the left side shrinks to a point
  CheckMapFault("abs(x-0.5), y", (const char *[]){"-block_map abs(x-0.5), y", "folds", NULL});
}

/* A block between two others, in the roles that are not possible. */
static void TestRoles(void)
{
  for (int alike = 0; alike < 2; ++alike) {
    TestScene t;

    TestSceneInit(&t);
    TestSceneAddBox(&t, "block", 2, 2, 0, 0, 1, 1);
    TestSceneAddBox(&t, "floor", 2, 2, 0, -1, 1, 0);
    if (alike) {
      TestSceneAddPair(&t, "one", 0, "bottom+left", 1, "top");
      TestSceneAddPair(&t, "two", 0, "left", 1, "right"); // a side may meet two others
      TestSceneAddPair(&t, "three", 0, "left", 1, "left+top");
      CheckFault(&t, (const char *[]){"'one' and 'three'", "block:left", "floor:left+top", NULL});
    } else {
      TestSceneAddPair(&t, "self", 0, "bottom", 0, "left+bottom");
      CheckFault(&t, (const char *[]){"'self'", "'bottom' and 'left+bottom'", "'block'", NULL});
    }
  }
}

static void TestSupports(void)
{
  TestScene t;

  TestSceneInit(&t);
  TestSceneAddBox(&t, "block", 2, 2, 0, 0, 1, 1);
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_DISPLACEMENT, "left", "0,0");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_DISPLACEMENT, "top", "free,0.25");
  CheckFault(&t, (const char *[]){"'block'", "side 'left' and on side 'top'", "(0, 1)", "0.25", NULL});

  TestSceneInit(&t);
  TestSceneAddBox(&t, "block", 2, 2, 0, 0, 1, 1);
  TestSceneSetMap(&t.bodies[0], "x, y+x^2");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "bottom", NULL);
  CheckFault(&t, (const char *[]){"-block_bc_normal", "'bottom'", "not flat", NULL});

  TestSceneInit(&t);
  TestSceneAddBox(&t, "block", 2, 2, 0, 0, 1, 1);
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_DISPLACEMENT, "left", "0,log(y-0.5)");
  CheckFault(&t, (const char *[]){"-value", NULL});
}

/* A box in space `block` under a map, held on a side. */
static void CheckSolidFault(PetscBool simplex, PetscInt order, const char map[], const char side[],
                            const char *const words[])
{
  TestScene t;

  SolidSceneInit(&t);
  SolidSceneAddBox(&t, "block", (PetscInt[]){2, 2, 2}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 1, 1})->order = order;
  t.bodies[0].simplex                                                                                         = simplex;
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, side, NULL);
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-block_map", map, 3, PETSC_FALSE, &t.bodies[0].map));
  CheckFault(&t, words);
}

static void TestSolids(void)
{
  for (PetscInt order = 1; order <= 2; ++order) { // bricks, then tetrahedra of order 2
    const PetscBool cut = order > 1 ? PETSC_TRUE : PETSC_FALSE;

    CheckSolidFault(cut, order, "x, y, z", "left+under",
                    (const char *[]){"'under'", "left, right, front, back, bottom and top", NULL});
    CheckSolidFault(cut, order, "x, y, x+y", "left", (const char *[]){"'block'", "degenerate", "after its map", NULL});
    CheckSolidFault(cut, order, "x*cos(y), x*sin(y), z", "left", (const char *[]){"'block'", "degenerate", NULL});
    CheckSolidFault(cut, order, "x, y, abs(z-0.5)", "left", (const char *[]){"-block_map", "folds", NULL});
    CheckSolidFault(cut, order, "x, y, z+(x-0.5)^2", "bottom+left", (const char *[]){"'bottom'", "is not flat", NULL});
  }
  /* the column of bricks at x = y = 1 is upside down at that edge alone */
  for (PetscInt order = 1; order <= 2; ++order)
    CheckSolidFault(PETSC_FALSE, order, "x, y, z*(1-1.5*x*y)", "bottom",
                    (const char *[]){"'block'", "tangled", "(1, 1, 0)", NULL});
}

int main(int argc, char **argv)
{
  PetscMPIInt size;

  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  CHECK(!MPI_Comm_size(PETSC_COMM_WORLD, &size));
  snprintf(FileName, sizeof(FileName), "meshfaults_%d.msh", size); // runs on other numbers of ranks may be about
  TestFiles();
  TestCells();
  TestCurvedCells();
  TestFileNames();
  TestBoxSides();
  TestMaps();
  TestRoles();
  TestSupports();
  TestSolids();
  remove(FileName);
  CHECK(!MPI_Finalize()); // PetscFinalize() would list what the faults have left behind: a run ends with its first
  return 0;
}
