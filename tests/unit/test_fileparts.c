/* test_fileparts.c -- a file that all ranks read in parts has the mesh that the first rank makes of it.
   Nodes, cells, sides and curves agree, on the mesh and on its refinement. What is to be told about a file is
   left to the first rank. */
#include "base/compat.h"
#include "bodies/cellmeasure.h"
#include "level/facets.h"
#include "level/level.h"
#include "level/leveltables.h"
#include "mesh/bodycurves.h"
#include "mesh/fileparting.h"
#include "mesh/fileparts.h"
#include "mesh/mesh.h"
#include "refinement/curves.h"
#include "refinement/levelrefine.h"
#include "solid_scene.h"

enum { NUM_SUMS = 40 };

/* Of nodes, cells and sides: numbers, places, measures. */
static void Measure(TestScene *t, Level *level, const char *const sides[], PetscReal sums[])
{
  PetscInt num = 0;

  for (PetscInt i = 0; i < NUM_SUMS; ++i) sums[i] = 0;
  sums[num++] = (PetscReal)level->num_owned;
  for (PetscInt a = 0; a < level->num_owned; ++a) {
    const PetscReal *x = &level->coords[a * level->dim];

    for (PetscInt d = 0; d < level->dim; ++d) {
      sums[num + 2 * d] += (1 + level->node_body[a]) * x[d];
      sums[num + 2 * d + 1] += x[d] * x[d] * (x[(d + 1) % level->dim] + 0.3);
    }
  }
  num += 6;
  for (PetscInt c = 0; c < level->num_cells; ++c) {
    PetscReal X[ELEMENT_MAX_NODES * 3];

    for (PetscInt i = level->cell_start[c]; i < level->cell_start[c + 1]; ++i)
      for (PetscInt d = 0; d < level->dim; ++d)
        X[(i - level->cell_start[c]) * level->dim + d] = level->coords[level->cell_nodes[i] * level->dim + d];
    sums[num] += 1 + 3 * level->cell_material[c];
    sums[num + 1] += CellGetMeasure((ElementType)level->cell_type[c], level->dim, X);
  }
  num += 2;
  for (PetscInt s = 0; sides[s]; ++s, num += 5) {
    Facets facets;

    for (PetscInt b = 0; b < t->scene.num_bodies; ++b) {
      CHECK(!LevelGetFacets(level, &t->scene, b, sides[s], &facets));
      for (PetscInt f = 0; f < facets.num; ++f) {
        PetscReal normal[3];

        sums[num] += 1 + b;
        sums[num + 1] += FacetGetMeasure(level, &facets, f, normal);
        for (PetscInt d = 0; d < level->dim; ++d) sums[num + 2 + d] += normal[d];
      }
      CHECK(!FacetsDestroy(&facets));
    }
  }
  CHECK(num <= NUM_SUMS);
  for (PetscInt i = 0; i < NUM_SUMS; ++i) sums[i] = Total(sums[i]);
}

/* A body for each region, one for NULL; every side is a side of each. */
static void Init(TestScene *t, PetscInt dim, const char file[], const char *const regions[], const char *const sides[])
{
  static const char *const names[] = {"first", "second"};

  if (dim == 3)
    SolidSceneInit(t);
  else
    TestSceneInit(t);
  for (PetscInt b = 0; b == 0 || (regions && regions[b]); ++b) {
    SceneBody *body = TestSceneAddFile(t, names[b], file, regions ? regions[b] : NULL);

    for (PetscInt s = 0; sides[s]; ++s) TestSceneAddBoundary(body, BOUNDARY_PRESSURE, sides[s], "1");
  }
}

/* The mesh by all ranks, once refined. [in] expected - of both levels */
static void CheckParts(TestScene *t, const char *const sides[], const FileLimits *limits,
                       PetscReal expected[2][NUM_SUMS])
{
  PetscReal      found[NUM_SUMS];
  struct _n_Mesh own = {.scene = &t->scene, .num_levels = 1};
  Curves         curves;
  DM             dm;
  PetscBool      good;

  CHECK(!FilePartsCreate(&t->scene, limits, 1, &dm, &curves, &good));
  CHECK(good);
  CHECK(!PetscMalloc1(1, &own.levels));
  CHECK(!LevelCreateFromPlex(&t->scene, dm, &curves, &own.levels[0]));
  CHECK(!LevelBeginArcs(&own.levels[0]));
  CHECK(!MeshShapeCreate(&t->scene, &own.levels[0], &curves, &own.shape));
  CHECK(!LevelTurnCells(&own.levels[0], NULL));
  CHECK(!CurvesDestroy(&curves));
  CHECK(!DMDestroy(&dm));
  CHECK(!MeshRefine(&own));
  for (PetscInt l = 0; l < 2; ++l) {
    Measure(t, &own.levels[l], sides, found);
    for (PetscInt i = 0; i < NUM_SUMS; ++i) CHECK_NEAR(found[i], expected[l][i], 1e-11);
  }
  for (PetscInt l = 0; l < 2; ++l) CHECK(!LevelDestroy(&own.levels[l]));
  CHECK(!MeshShapeDestroy(&own.shape));
  CHECK(!PetscFree(own.levels));
}

/* The mesh by the first rank, and by all, which part it themselves or have the first rank part it. */
static void TestSame(PetscInt dim, const char file[], PetscInt order, const char *const regions[],
                     const char *const sides[])
{
  PetscReal expected[2][NUM_SUMS];
  TestScene t;
  Mesh      mesh;

  Init(&t, dim, file, regions, sides);
  for (PetscInt b = 0; b < t.scene.num_bodies; ++b) t.bodies[b].order = order;
  t.scene.refine = 1;
  mesh           = TestSceneMesh(&t);
  for (PetscInt l = 0; l < 2; ++l) Measure(&t, &mesh->levels[l], sides, expected[l]);
  CHECK(!MeshDestroy(&mesh));
  CheckParts(&t, sides, &(FileLimits){1, PETSC_MAX_INT}, expected);
  CheckParts(&t, sides, &(FileLimits){1, 1}, expected);
  TestSceneFree(&t);
}

/* A file, or what a scene wants of it, that the first rank looks at. */
static void TestLeft(PetscInt dim, const char file[], const char *const regions[], const char *const sides[],
                     PetscInt min_cells)
{
  TestScene t;
  Curves    curves;
  DM        dm;
  PetscBool good;

  Init(&t, dim, file, regions, sides);
  CHECK(!FilePartsCreate(&t.scene, &(FileLimits){min_cells, PETSC_MAX_INT}, 0, &dm, &curves, &good));
  CHECK(!good);
  TestSceneFree(&t);
}

#define LIST(...) ((const char *const[]){__VA_ARGS__, NULL})

static void TestFiles(void)
{
  static const char *const discs[] = {MESHES "/disc_22.msh", MESHES "/disc_22_bin.msh", MESHES "/disc_41.msh",
                                      MESHES "/disc_41_bin.msh", MESHES "/disc_quad8.msh"};
  static const char *const drums[] = {MESHES "/drum_22.msh", MESHES "/drum_41_bin.msh", MESHES "/drum_tets_41.msh",
                                      MESHES "/drum_tets_22_bin.msh"};

  for (PetscInt order = 1; order <= 2; ++order) {
    for (size_t f = 0; f < sizeof(discs) / sizeof(discs[0]); ++f) {
      TestSame(2, discs[f], order, NULL, LIST("rim"));
      TestSame(2, discs[f], order, LIST("upper", "2"), LIST("rim", "middle"));
    }
    for (size_t f = 0; f < sizeof(drums) / sizeof(drums[0]); ++f) {
      TestSame(3, drums[f], order, NULL, LIST("rim", "bottom", "top"));
      TestSame(3, drums[f], order, LIST("upper", "lower"), LIST("rim", "middle", "5"));
    }
    TestSame(2, MESHES "/two_groups_41.msh", order, NULL, LIST("foot", "left foot"));
    TestSame(2, MESHES "/two_groups_22.msh", order, LIST("left half"), LIST("left foot"));
    TestSame(2, MESHES "/clockwise.msh", order, NULL, LIST("3"));
  }
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  TestFiles();
  TestLeft(2, MESHES "/disc_41.msh", NULL, LIST("middle"), 1);                // inside the body
  TestLeft(2, MESHES "/disc_41.msh", NULL, LIST("rims"), 1);                  // no such side
  TestLeft(2, MESHES "/disc_41.msh", LIST("left"), LIST("rim"), 1);           // no such region
  TestLeft(2, MESHES "/disc_41.msh", LIST("upper", "upper"), LIST("rim"), 1); // the same cells
  TestLeft(2, MESHES "/disc_41.msh", NULL, LIST("rim"), 1000);                // few cells
  TestLeft(3, MESHES "/disc_41.msh", NULL, LIST("rim"), 1);                   // plane
  TestLeft(2, MESHES "/drum_22.msh", NULL, LIST("rim"), 1);                   // a solid
  TestLeft(2, MESHES "/none.msh", NULL, LIST("rim"), 1);                      // no such file
  TestLeft(2, MESHES "/../../hard/pieces.msh", NULL, LIST("cap"), 1);         // two pieces
  CHECK(!PetscFinalize());
  return 0;
}
