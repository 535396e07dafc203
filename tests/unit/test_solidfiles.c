/* test_solidfiles.c -- Gmsh files of solids: cells of every kind, sides, regions, curves on all levels. */
#include "solid_scene.h"

enum { NUM_ARCS = 8, NUM_FILES = 4 };
/* A drum of radius 1 and height 1 whose rim is eight parabolas, extruded. Its files have hexahedra with 27
   and 20 nodes and tetrahedra with 10. */
static const char *const DrumFile[NUM_FILES] = {MESHES "/drum_22.msh", MESHES "/drum_41_bin.msh",
                                                MESHES "/drum_tets_41.msh", MESHES "/drum_tets_22_bin.msh"};
static const PetscInt    NumCells[NUM_FILES] = {12, 12, 72, 72};
static const PetscReal   Precision           = 1e-8; /* Gmsh finds the middles of arcs to 1e-9 along them */
static const PetscReal   HalfArc             = PETSC_PI / NUM_ARCS;
static const char *const Sides[]             = {"rim", "bottom", "top"};

/* Area of the section with chords, from end to end of the parabolas or to their middles on the circle, and with parabolas. */
static PetscReal SectionArea(PetscInt order, PetscInt level)
{
  const PetscReal half   = order == 1 ? HalfArc / (1 << level) : HalfArc;
  const PetscReal chords = PETSC_PI / half * PetscSinReal(half) * PetscCosReal(half);

  return order == 1 ? chords : chords + NUM_ARCS * 2. / 3 * 2 * PetscSinReal(HalfArc) * (1 - PetscCosReal(HalfArc));
}

/* A body of a file and a region, with its sides in use. */
static SceneBody *AddDrum(TestScene *t, const char name[], const char file[], const char region[], PetscInt order)
{
  SceneBody *body = TestSceneAddFile(t, name, file, region);

  body->order = order;
  for (size_t s = 0; s < sizeof(Sides) / sizeof(Sides[0]); ++s)
    TestSceneAddBoundary(body, BOUNDARY_PRESSURE, Sides[s], "1");
  return body;
}

/* Every node of the rim lies on one of the parabolas. */
static void CheckRim(TestScene *t, Level *level, PetscInt body)
{
  Facets facets;

  CHECK(!LevelGetFacets(level, &t->scene, body, "rim", &facets));
  for (PetscInt f = 0; f < facets.num; ++f) {
    CHECK(ElementOrder(facets.type[f]) == t->bodies[body].order);
    for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); ++i) {
      const PetscReal *x      = &level->coords[3 * facets.nodes[f * ELEMENT_MAX_FACET_NODES + i]];
      const PetscReal  arc    = PetscFloorReal(PetscAtan2Real(x[1], x[0]) / (2 * HalfArc));
      const PetscReal  middle = 2 * HalfArc * (arc + 0.5), c = PetscCosReal(middle), s = PetscSinReal(middle);
      const PetscReal  along = (c * x[1] - s * x[0]) / PetscSinReal(HalfArc), foot = PetscCosReal(HalfArc);

      CHECK_NEAR(c * x[0] + s * x[1], foot + (1 - foot) * (1 - along * along), Precision);
    }
  }
  CHECK(!FacetsDestroy(&facets));
}

/* Measures of a share of the drum with the sides in use, of which none is inside out. The flux of (x, y, z)
   through a closed surface is three times the volume. */
static void CheckMeasures(TestScene *t, Level *level, PetscInt body, PetscReal share, PetscReal area)
{
  SideSums sums;

  CHECK_NEAR(SolidVolume(level, body), share * area, Precision);
  SolidSumSide(t, level, body, "bottom", &sums);
  CHECK_NEAR(sums.area, share * area, Precision);
  CHECK_NEAR(sums.normal[2], -share * area, Precision);
  SolidSumSide(t, level, body, "top", &sums);
  CHECK_NEAR(sums.normal[2], share * area, Precision);
  CHECK_NEAR(sums.flux, share * area, Precision);
  SolidSumSide(t, level, body, "rim", &sums);
  CHECK_NEAR(sums.flux, 2 * share * area, Precision);
}

/* Whole, on all levels. */
static void TestWhole(PetscInt f, PetscInt refine)
{
  TestScene t;
  Mesh      mesh;
  PetscReal volume;

  SolidSceneInit(&t);
  t.scene.refine = refine;
  AddDrum(&t, "drum", DrumFile[f], NULL, 2);
  mesh   = TestSceneMesh(&t);
  volume = SolidVolume(&mesh->levels[0], 0);
  for (PetscInt l = 0; l <= refine; ++l) {
    Level *level = &mesh->levels[l];

    CHECK_NEAR(Total(level->num_cells), NumCells[f] << (3 * l), 0);
    CHECK_NEAR(SolidVolume(level, 0), volume, 1e-12); // sums of up to 70,000 terms
    CheckMeasures(&t, level, 0, 1, SectionArea(2, 0));
    CheckRim(&t, level, 0);
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* The halves as bodies of different orders; what lies between them is a side of each. */
static void TestRegions(const char file[], PetscInt upper, PetscInt lower)
{
  TestScene t;
  Mesh      mesh;

  SolidSceneInit(&t);
  t.scene.refine = 1;
  AddDrum(&t, "upper", file, "upper", upper);
  AddDrum(&t, "lower", file, "2", lower);
  TestSceneAddPair(&t, "joint", 0, "middle", 1, "3");
  mesh = TestSceneMesh(&t);
  for (PetscInt l = 0; l <= 1; ++l) {
    for (PetscInt b = 0; b < 2; ++b) {
      SideSums sums;

      CHECK(t.bodies[b].straightened == (t.bodies[b].order == 1));
      CheckMeasures(&t, &mesh->levels[l], b, 0.5, SectionArea(t.bodies[b].order, l));
      CheckRim(&t, &mesh->levels[l], b);
      SolidSumSide(&t, &mesh->levels[l], b, b ? "3" : "middle", &sums);
      CHECK_NEAR(sums.area, 2, 1e-13);
      CHECK_NEAR(sums.normal[1], b ? 2 : -2, 1e-13);
    }
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Refining the body alone follows the curves, whatever its order. */
static void TestOwnRefinement(const char file[], PetscInt order)
{
  TestScene t;
  Mesh      mesh;

  SolidSceneInit(&t);
  AddDrum(&t, "upper", file, "1", order)->refine = 1;
  mesh                                           = TestSceneMesh(&t);
  CheckRim(&t, &mesh->levels[0], 0);
  if (order > 1) CheckMeasures(&t, &mesh->levels[0], 0, 0.5, SectionArea(2, 0));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* A map moves curves like everything else, and one that mirrors turns all cells. */
static void TestMap(const char file[])
{
  TestScene t;
  Mesh      mesh;

  SolidSceneInit(&t);
  t.scene.refine = 1;
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", "y, x, z+x", 3, PETSC_FALSE,
                          &AddDrum(&t, "drum", file, NULL, 2)->map));
  mesh = TestSceneMesh(&t);
  for (PetscInt l = 0; l <= 1; ++l) {
    PetscReal flux = 0;

    CHECK_NEAR(SolidVolume(&mesh->levels[l], 0), SectionArea(2, 0), Precision);
    for (size_t s = 0; s < sizeof(Sides) / sizeof(Sides[0]); ++s) {
      SideSums sums;

      SolidSumSide(&t, &mesh->levels[l], 0, Sides[s], &sums);
      flux += sums.flux;
    }
    CHECK_NEAR(flux, 3 * SectionArea(2, 0), 10 * Precision);
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  for (PetscInt f = 0; f < NUM_FILES; ++f) {
    TestWhole(f, f % 2 ? 2 : 1);
    TestMap(DrumFile[f]);
  }
  for (PetscInt f = 1; f < NUM_FILES; f += 2) {
    TestRegions(DrumFile[f], 2, 2);
    TestRegions(DrumFile[f], 1, 2);
    TestRegions(DrumFile[f], 1, 1);
    TestOwnRefinement(DrumFile[f], 1);
    TestOwnRefinement(DrumFile[f], 2);
  }
  CHECK(!PetscFinalize());
  return 0;
}
