/* test_curvedfiles.c -- Gmsh files of second order: their curves are kept by reading, cutting, refining and mapping. */
#include "mesh_scene.h"

enum { NUM_ARCS = 8, NUM_FILES = 5, NUM_NODES = 49 };
/* The unit disc as eight parabolas through points of the circle, which Gmsh places to 1e-9 along it. */
static const char *const DiscFile[NUM_FILES] = {MESHES "/disc_22.msh", MESHES "/disc_22_bin.msh", MESHES "/disc_41.msh",
                                                MESHES "/disc_41_bin.msh", MESHES "/disc_quad8.msh"};
static const PetscReal   Precision           = 1e-8;
static const PetscReal   HalfArc             = PETSC_PI / NUM_ARCS;

/* Area of the disc with chords from end to end of the parabolas, or to their middles, which are on the circle as well. */
static PetscReal ChordArea(PetscInt level)
{
  const PetscReal half = HalfArc / (1 << level);

  return (NUM_ARCS << level) * PetscSinReal(half) * PetscCosReal(half);
}

static PetscReal ParabolaArea(void)
{
  return ChordArea(0) + NUM_ARCS * 2. / 3 * 2 * PetscSinReal(HalfArc) * (1 - PetscCosReal(HalfArc));
}

/* Every node of the rim lies on one of the parabolas. */
static void CheckRim(TestScene *t, Level *level, PetscInt body, PetscInt num_facets)
{
  Facets facets;

  CHECK(!LevelGetFacets(level, &t->scene, body, "rim", &facets));
  CHECK_NEAR(Total(facets.num), num_facets, 0);
  for (PetscInt f = 0; f < facets.num; ++f) {
    CHECK(ElementOrder(facets.type[f]) == t->bodies[body].order);
    for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); ++i) {
      const PetscReal *x = &level->coords[2 * facets.nodes[f * ELEMENT_MAX_FACET_NODES + i]];
      const PetscReal  middle =
          2 * HalfArc * (PetscFloorReal(PetscAtan2Real(x[1], x[0]) / (2 * HalfArc)) + 0.5); // angle of its arc's
      const PetscReal c = PetscCosReal(middle), s = PetscSinReal(middle), out = c * x[0] + s * x[1];
      const PetscReal along = (c * x[1] - s * x[0]) / PetscSinReal(HalfArc), foot = PetscCosReal(HalfArc);

      CHECK_NEAR(out, foot + (1 - foot) * (1 - along * along), Precision);
    }
  }
  CHECK(!FacetsDestroy(&facets));
}

/* A body of a file and a region, with its sides in use. */
static SceneBody *AddDisc(TestScene *t, const char name[], const char file[], const char region[], PetscInt order)
{
  SceneBody *body = TestSceneAddFile(t, name, file, region);

  body->order = order;
  TestSceneAddBoundary(body, BOUNDARY_PRESSURE, "rim", "1");
  return body;
}

/* Whole, on three levels: area and rim stay what they were. */
static void TestWhole(const char file[])
{
  TestScene t;
  Mesh      mesh;
  PetscReal area;

  TestSceneInit(&t);
  t.scene.refine = 2;
  AddDisc(&t, "disc", file, NULL, 2);
  mesh = TestSceneMesh(&t);
  area = BodyArea(&mesh->levels[0], 0);
  CHECK(mesh->levels[0].num_global == NUM_NODES);
  CHECK_NEAR(area, ParabolaArea(), Precision);
  for (PetscInt l = 0; l <= 2; ++l) {
    CHECK_NEAR(BodyArea(&mesh->levels[l], 0), area, 1e-13);
    CheckRim(&t, &mesh->levels[l], 0, NUM_ARCS << l);
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Points between a chord and its parabola are in the body. */
static void TestLocate(void)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  AddDisc(&t, "disc", DiscFile[0], NULL, 2);
  mesh = TestSceneMesh(&t);
  for (PetscInt arc = 0; arc < NUM_ARCS; ++arc) {
    static const PetscReal radius[] = {0.5, 0.95, 0.999, 1.001};

    for (int k = 0; k < 4; ++k) {
      const PetscReal angle = (2 * arc + 1) * HalfArc,
                      x[]   = {radius[k] * PetscCosReal(angle), radius[k] * PetscSinReal(angle)};
      PetscReal xi[2], at[2], phi[ELEMENT_MAX_NODES], X[2 * ELEMENT_MAX_NODES];
      PetscInt  cell;
      PetscBool found;

      CHECK(!LevelLocate(MeshFinest(mesh), 0, x, &cell, xi, &found));
      CHECK(found == (k < 3));
      if (cell < 0) continue;
      CellCoords(MeshFinest(mesh), cell, X);
      (void)ElementMap((ElementType)MeshFinest(mesh)->cell_type[cell], X, xi, at, phi, NULL);
      for (int d = 0; d < 2; ++d) CHECK_NEAR(at[d], x[d], 1e-13);
    }
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* The halves as bodies of different orders: order 1 has chords between points of the curves, more of them on every level. */
static void TestOrders(PetscInt upper, PetscInt lower)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  t.scene.refine = 1;
  AddDisc(&t, "upper", DiscFile[2], "upper", upper);
  AddDisc(&t, "lower", DiscFile[2], "2", lower);
  TestSceneAddPair(&t, "joint", 0, "middle", 1, "middle");
  mesh = TestSceneMesh(&t);
  for (PetscInt b = 0; b < 2; ++b) CHECK(t.bodies[b].straightened == (t.bodies[b].order == 1));
  for (PetscInt l = 0; l <= 1; ++l) {
    const PetscReal area[] = {0, 0.5 * ChordArea(l), 0.5 * ParabolaArea()}; /* of half a disc by order */
    Level          *level  = &mesh->levels[l];

    for (PetscInt c = 0; c < level->num_cells; ++c)
      CHECK(ElementOrder((ElementType)level->cell_type[c]) == t.bodies[level->cell_body[c]].order);
    CHECK_NEAR(BodyArea(level, 0), area[upper], Precision);
    CHECK_NEAR(BodyArea(level, 1), area[lower], Precision);
    for (PetscInt b = 0; b < 2; ++b) CheckRim(&t, level, b, NUM_ARCS / 2 << l);
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Refining the body alone follows the curves, whatever its order. */
static void TestOwnRefinement(PetscInt order)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  AddDisc(&t, "upper", DiscFile[4], "upper", order)->refine = 2;
  mesh                                                      = TestSceneMesh(&t);
  CheckRim(&t, MeshFinest(mesh), 0, 2 * NUM_ARCS);
  if (order > 1) CHECK_NEAR(BodyArea(MeshFinest(mesh), 0), 0.5 * ParabolaArea(), Precision);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* New vertices of order 1 lie on the curves, level by level. */
static void TestFollow(void)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  t.scene.refine = 2;
  AddDisc(&t, "disc", DiscFile[3], NULL, 1);
  mesh = TestSceneMesh(&t);
  CHECK(!MeshRefine(mesh));
  for (PetscInt l = 0; l <= 3; ++l) CheckRim(&t, &mesh->levels[l], 0, NUM_ARCS << l);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* A map moves curves like everything else, on every level. */
static void TestMap(void)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  t.scene.refine = 1;
  TestSceneSetMap(AddDisc(&t, "disc", DiscFile[1], NULL, 2), "1+2*y, x+y");
  mesh = TestSceneMesh(&t);
  for (PetscInt l = 0; l <= 1; ++l) CHECK_NEAR(BodyArea(&mesh->levels[l], 0), 2 * ParabolaArea(), 2 * Precision);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* One clockwise quadrangle of eight nodes, whose top is a parabola of height 0.2. */
static void TestBulge(void)
{
  TestScene t;
  Mesh      mesh;
  Level    *level;
  Facets    facets;
  PetscReal middle = 0;

  TestSceneInit(&t);
  TestSceneAddBoundary(TestSceneAddFile(&t, "bulge", MESHES "/bulge.msh", NULL), BOUNDARY_PRESSURE, "3", "1");
  t.bodies[0].order = 2;
  mesh              = TestSceneMesh(&t);
  level             = MeshFinest(mesh);
  CHECK(level->num_global == ElementNumNodes(ELEMENT_QUAD9));
  CHECK_NEAR(BodyArea(level, 0), 1 + 2 * 0.2 / 3, 1e-14);
  for (PetscInt c = 0; c < level->num_cells; ++c) { // by serendipity: half the rise of the side
    const PetscReal *x = &level->coords[2 * level->cell_nodes[level->cell_start[c + 1] - 1]];

    CHECK_NEAR(x[0], 0.5, 1e-15);
    CHECK_NEAR(x[1], 0.6, 1e-15);
    middle += 1;
  }
  CHECK_NEAR(Total(middle), 1, 0);
  CHECK(!LevelGetFacets(level, &t.scene, 0, "3", &facets));
  for (PetscInt f = 0; f < facets.num; ++f) { // outward: from right to left
    static const PetscReal X[] = {1, 1, 0, 1, 0.5, 1.2};

    for (PetscInt i = 0; i < 6; ++i)
      CHECK_NEAR(level->coords[2 * facets.nodes[f * ELEMENT_MAX_FACET_NODES + i / 2] + i % 2], X[i], 1e-15);
  }
  CHECK(!FacetsDestroy(&facets));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  for (int f = 0; f < NUM_FILES; ++f) TestWhole(DiscFile[f]);
  TestLocate();
  TestOrders(2, 2);
  TestOrders(1, 2);
  TestOrders(2, 1);
  TestOrders(1, 1);
  TestOwnRefinement(1);
  TestOwnRefinement(2);
  TestFollow();
  TestMap();
  TestBulge();
  CHECK(!PetscFinalize());
  return 0;
}
