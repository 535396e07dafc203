/* test_solidfaults.c -- mistakes in files of solids: each is one sentence that names the culprit. Cells that
   are merely inside out, or of two kinds, are no mistake. */
#include "solid_scene.h"

static char FileName[PETSC_MAX_PATH_LEN]; /* written for one test after the other, removed in the end */

/* The corners of the unit cube, one point above it and one below. */
static const char Cube[] =
    "10\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 0.5 0.5 2\n10 0.5 0.5 -1";
static const char Names[] = "4\n2 5 \"floor\"\n3 1 \"steel\"\n3 2 \"floor\"\n1 9 \"rim\"";

/* A file of format 2.2: `elements` begins with their number. */
static void WriteFile(const char elements[])
{
  PetscMPIInt rank;
  FILE       *file;

  CHECK(!MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank) return;
  file = fopen(FileName, "w");
  CHECK(file);
  fprintf(file,
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%s\n$EndPhysicalNames\n$Nodes\n%s\n$EndNodes\n"
          "$Elements\n%s\n$EndElements\n",
          Names, Cube, elements);
  CHECK(!fclose(file));
}

/* A body `block` of the file, of which a side is loaded. */
static void SceneInit(TestScene *t, const char elements[], const char region[], const char side[])
{
  WriteFile(elements);
  SolidSceneInit(t);
  TestSceneAddBoundary(TestSceneAddFile(t, "block", FileName, region), BOUNDARY_PRESSURE, side, "1");
}

/* The fault must say all the words (up to a NULL). */
static void CheckFault(const char elements[], const char region[], const char side[], const char *const words[])
{
  TestScene t;
  Mesh      mesh;

  SceneInit(&t, elements, region, side);
  CHECK(!MeshCreate(&t.scene, &mesh));
  CHECK(MeshSetUp(mesh) == MORTISE_ERR_USER);
  for (; *words; ++words) {
    if (strstr(UserErrorSentence(), *words)) continue;
    fprintf(stderr, "'%s' does not say '%s'\n", UserErrorSentence(), *words);
    CHECK(0);
  }
  CHECK(!MPI_Barrier(PETSC_COMM_WORLD));
}

/* A hexahedron on its floor. */
#define HEX   "1 5 2 1 1 1 2 3 4 5 6 7 8"
#define FLOOR "2 3 2 5 1 1 2 3 4"

static void TestCells(void)
{
  CheckFault("3\n" HEX "\n" FLOOR "\n3 6 2 1 1 5 6 9 8 7 10", NULL, "5",
             (const char *[]){"-block_dm_plex_filename", FileName, "1 wedges", "(0, 0, 1)", "tetrahedra and hexahedra",
                              "Recombine", NULL});
  CheckFault("3\n" FLOOR "\n2 7 2 1 1 5 6 7 8 9\n3 6 2 1 1 1 2 3 5 6 7", NULL, "5",
             (const char *[]){"1 pyramids and 1 others", NULL});
  CheckFault("1\n" FLOOR, NULL, "5",
             (const char *[]){"dimension 2", "the scene has 3", "gmsh -3", "physical volume", NULL});
  CheckFault("2\n" FLOOR "\n2 4 2 1 1 1 2 3 4", NULL, "5", (const char *[]){"quadrangles", "not a facet", NULL});
  CheckFault("2\n1 2 2 5 1 1 2 3\n2 4 2 1 1 1 2 3 4", NULL, "5", (const char *[]){"'block'", "degenerate", NULL});
  CheckFault("2\n" FLOOR "\n2 5 2 1 1 1 2 3 4 5 6 8 7", NULL, "5", // two corners of the top change places
             (const char *[]){"'block'", "tangled", "(1, 1, 1)", NULL});
  CheckFault("3\n1 2 2 5 1 1 2 3\n2 4 2 1 1 1 2 3 6\n3 4 2 1 1 1 2 3 9", NULL, "5",
             (const char *[]){"'block'", "overlap at", "-block_mesh_region", NULL});
}

static void TestSides(void)
{
  CheckFault("2\n" HEX "\n" FLOOR, NULL, "steel",
             (const char *[]){"'block' has no side 'steel'", "which is a volume", "its sides are floor (5)", NULL});
  CheckFault("2\n" HEX "\n" FLOOR, NULL, "1", (const char *[]){"side '1'", "which is a volume", NULL});
  CheckFault("2\n" HEX "\n" FLOOR, NULL, "rim", (const char *[]){"side 'rim'", "which is a curve", NULL});
  CheckFault("2\n" HEX "\n" FLOOR, "5", "5",
             (const char *[]){"-block_mesh_region 5", "which is a surface", "it has steel (1)", NULL});
  CheckFault("3\n" HEX "\n" FLOOR "\n3 2 2 6 1 1 2 3", NULL, "5", // half of a facet
             (const char *[]){FileName, "triangles in physical group 6", "(0, 0, 0) (1, 0, 0) (1, 1, 0)",
                              "not a facet of any cell", NULL});
  CheckFault("3\n" HEX "\n" FLOOR "\n3 2 2 6 1 1 2 9", NULL, "6", // sticks out
             (const char *[]){"(0.5, 0.5, 2)", "not a facet of any cell", NULL});
  CheckFault(
      "3\n1 2 2 5 1 1 2 3\n2 4 2 1 1 1 2 3 9\n3 4 2 2 1 1 2 3 10", NULL, "floor",
      (const char *[]){"side 'floor' of body 'block'", "facets inside the body (1)", "-block_mesh_region", NULL});
}

/* Two tetrahedra on the two sides of a triangle; volume 1/6 over a triangle of area 1/2 with height 1. [in] cells - both */
static void CheckSound(const char cells[])
{
  TestScene t;
  SideSums  sums;
  Mesh      mesh;

  SceneInit(&t, cells, "steel", "5");
  TestSceneAddBoundary(TestSceneAddFile(&t, "other", FileName, "2"), BOUNDARY_PRESSURE, "floor", "1");
  mesh = TestSceneMesh(&t);
  CHECK_NEAR(SolidVolume(MeshFinest(mesh), 0), 2. / 6, 1e-15);
  CHECK_NEAR(SolidVolume(MeshFinest(mesh), 1), 1. / 6, 1e-15);
  for (PetscInt b = 0; b < 2; ++b) {
    SolidSumSide(&t, MeshFinest(mesh), b, b ? "floor" : "5", &sums);
    CHECK_NEAR(sums.normal[2], b ? 0.5 : -0.5, 1e-15);
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* The cells of a file may be inside out, all or some. */
static void TestInsideOut(void)
{
  CheckSound("3\n1 2 2 5 1 1 2 3\n2 4 2 1 1 1 2 3 9\n3 4 2 2 1 1 2 3 10");
  CheckSound("3\n1 2 2 5 1 1 2 3\n2 4 2 1 1 2 1 3 9\n3 4 2 2 1 1 2 3 10");
  CheckSound("3\n1 2 2 5 1 1 3 2\n2 4 2 1 1 2 1 3 9\n3 4 2 2 1 2 1 3 10");
}

/* A hexahedron, and on half of its top a tetrahedron of another body: bodies of one file have nothing in common. */
static void TestTwoKinds(void)
{
  TestScene t;
  Mesh      mesh;

  SceneInit(&t, "4\n" HEX "\n" FLOOR "\n3 2 2 6 1 5 6 7\n4 4 2 2 1 5 6 7 9", "steel", "5");
  TestSceneAddBoundary(TestSceneAddFile(&t, "other", FileName, "2"), BOUNDARY_PRESSURE, "6", "1");
  t.scene.refine = 1;
  mesh           = TestSceneMesh(&t);
  CHECK(mesh->levels[0].num_global == 8 + 4);
  for (PetscInt l = 0; l <= 1; ++l) {
    SideSums sums;

    CHECK_NEAR(SolidVolume(&mesh->levels[l], 0), 1, 1e-14);
    CHECK_NEAR(SolidVolume(&mesh->levels[l], 1), 1. / 6, 1e-14);
    SolidSumSide(&t, &mesh->levels[l], 1, "6", &sums);
    CHECK_NEAR(sums.normal[2], -0.5, 1e-14);
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* A file cut short anywhere is one that ends too early. */
static void TestCut(const char path[])
{
  enum { NUM_CUTS = 20, MAX_SIZE = 100000 };
  static char text[MAX_SIZE];
  FILE       *file = fopen(path, "rb");
  size_t      size;

  CHECK(file);
  size = fread(text, 1, MAX_SIZE, file);
  CHECK(!fclose(file));
  for (int cut = 0; cut < NUM_CUTS; ++cut) {
    TestScene   t;
    Mesh        mesh;
    PetscMPIInt rank;

    CHECK(!MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
    if (!rank) {
      file = fopen(FileName, "wb");
      CHECK(file && fwrite(text, 1, size * (size_t)cut / (NUM_CUTS + 1), file) == size * (size_t)cut / (NUM_CUTS + 1));
      CHECK(!fclose(file));
    }
    SolidSceneInit(&t);
    TestSceneAddFile(&t, "block", FileName, NULL);
    CHECK(!MeshCreate(&t.scene, &mesh));
    CHECK(MeshSetUp(mesh) == MORTISE_ERR_USER);
    CHECK(strstr(UserErrorSentence(), FileName));
    CHECK(!MPI_Barrier(PETSC_COMM_WORLD));
  }
}

int main(int argc, char **argv)
{
  PetscMPIInt size;

  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  CHECK(!MPI_Comm_size(PETSC_COMM_WORLD, &size));
  snprintf(FileName, sizeof(FileName), "solidfaults_%d.msh", size); // runs on other numbers of ranks may be about
  TestCells();
  TestSides();
  TestInsideOut();
  TestTwoKinds();
  TestCut(MESHES "/drum_22.msh");
  TestCut(MESHES "/drum_41_bin.msh");
  TestCut(MESHES "/drum_tets_41.msh");
  TestCut(MESHES "/drum_tets_22_bin.msh");
  remove(FileName);
  CHECK(!MPI_Finalize()); // PetscFinalize() would list what the faults have left behind: a run ends with its first
  return 0;
}
