/* test_coarsen.c -- boxes that begin with fewer cells and more levels than their options say: the meshes are the same. */
#include "solid_scene.h"

static const PetscReal Precision = 1e-11; /* of sums over a thousand cells */

/* Numbers that differ between meshes, whatever their numbering: sums over cells and facets of the cube of a
   sum over their nodes. The cube has products of values at neighbours. */
typedef struct {
  PetscReal cells, nodes, sum, sides;
} Imprint;

static PetscReal Wave(const Level *level, PetscInt num, const PetscInt nodes[])
{
  PetscReal sum = 0;

  for (PetscInt i = 0; i < num; ++i) {
    PetscReal phase = 1 + level->node_body[nodes[i]];

    for (PetscInt d = 0; d < level->dim; ++d) phase += (13 + 16 * d) * level->coords[nodes[i] * level->dim + d];
    sum += PetscSinReal(phase);
  }
  return sum * sum * sum;
}

static Imprint ImprintOf(TestScene *t, Level *level)
{
  Imprint imprint = {Total(level->num_cells), level->num_global, 0, 0};

  for (PetscInt c = 0; c < level->num_cells; ++c)
    imprint.sum +=
        Wave(level, level->cell_start[c + 1] - level->cell_start[c], &level->cell_nodes[level->cell_start[c]]);
  for (PetscInt b = 0; b < t->scene.num_bodies; ++b) {
    Facets facets;

    CHECK(!LevelGetFacets(level, &t->scene, b, b ? "top+left" : "bottom", &facets));
    for (PetscInt f = 0; f < facets.num; ++f)
      imprint.sides +=
          Wave(level, ElementNumNodes(facets.type[f]), &facets.nodes[f * ELEMENT_MAX_FACET_NODES]) * (1 + (PetscReal)b);
    CHECK(!FacetsDestroy(&facets));
  }
  imprint.sum   = Total(imprint.sum);
  imprint.sides = Total(imprint.sides);
  return imprint;
}

/* Levels that nobody asked for come before those of -dm_refine, and the others are the same without them. */
static void CompareLevels(TestScene *t, PetscInt extra)
{
  Mesh flat, deep;

  t->scene.levels = LEVELS_UNUSED;
  flat            = TestSceneMesh(t);
  t->scene.levels = LEVELS_USED;
  deep            = TestSceneMesh(t);
  CHECK(flat->own == t->scene.refine && flat->num_levels == flat->own + 1);
  CHECK(deep->own == flat->own + extra && deep->num_levels == deep->own + 1);
  for (PetscInt l = 0; l < flat->num_levels; ++l) {
    const Imprint a = ImprintOf(t, &flat->levels[l]), b = ImprintOf(t, &deep->levels[l + extra]);

    CHECK(a.cells == b.cells && a.nodes == b.nodes);
    CHECK_NEAR(b.sum, a.sum, Precision * a.cells);
    CHECK_NEAR(b.sides, a.sides, Precision * a.cells);
  }
  for (PetscInt l = 1; l < deep->num_levels; ++l) CHECK(deep->levels[l].prolongation);
  CHECK(!MeshDestroy(&flat));
  CHECK(!MeshDestroy(&deep));
}

static void TestPlane(PetscInt order, PetscInt refine)
{
  TestScene t;

  TestSceneInit(&t);
  t.scene.refine = refine;
  TestSceneAddBoundary(TestSceneAddBox(&t, "upper", 12, 8, 0, 0, 1, 1), BOUNDARY_DISPLACEMENT, "top", "0,0");
  TestSceneAddBox(&t, "lower", 48, 24, 0, -1, 1, 0)->simplex = PETSC_TRUE;
  TestSceneAddBoundary(&t.bodies[1], BOUNDARY_DISPLACEMENT, "left", "0,0");
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top");
  TestSceneSetMap(&t.bodies[1], "x+0.1*y*y, y-0.2*x*(1-x)");
  t.bodies[0].refine = 2;
  t.bodies[0].order  = order;
  CompareLevels(&t, 1);
  TestSceneFree(&t);
}

/* A bottom box of bricks, a top box of bricks, or of tetrahedra, which are not made of larger ones. */
static void TestSolid(PetscBool simplex, PetscInt order)
{
  const PetscInt  faces[2][3] = {{12, 8, 12}, {8, 12, 12}};
  const PetscReal lower[2][3] = {{0, 0, 0}, {0, 0, -1}}, upper[2][3] = {{1, 1, 1}, {1, 1, 0}};
  TestScene       t;

  SolidSceneInit(&t);
  SolidSceneAddBox(&t, "upper", faces[0], lower[0], upper[0])->simplex = simplex;
  SolidSceneAddBox(&t, "lower", faces[1], lower[1], upper[1])->order   = order;
  TestSceneAddBoundary(&t.bodies[1], BOUNDARY_DISPLACEMENT, "left", "0,0,0");
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top");
  CompareLevels(&t, simplex ? 0 : 1);
  TestSceneFree(&t);
}

/* By size: none for few unknowns, no coarsest mesh that is too small to be worth it, no halves of odd numbers. */
static void TestSize(void)
{
  const PetscInt  faces[3] = {8, 16, 24}, order[3] = {1, 2, 1}, coarser[3] = {0, 1, 1};
  const PetscReal lower[2][3] = {{0, 0, 0}, {0, 0, -1}}, upper[2][3] = {{1, 1, 1}, {1, 1, 0}};
  TestScene       t;
  Mesh            mesh;

  for (PetscInt i = 0; i < 3; ++i) {
    const PetscInt n[3] = {faces[i], faces[i], faces[i]}, m[3] = {3 * faces[i] / 4, faces[i] / 2, faces[i]};

    SolidSceneInit(&t);
    SolidSceneAddBox(&t, "upper", n, lower[0], upper[0])->order = order[i];
    SolidSceneAddBox(&t, "lower", m, lower[1], upper[1])->order = order[i];
    mesh                                                        = TestSceneMesh(&t);
    CHECK(mesh->own == coarser[i]);
    CHECK(!MeshDestroy(&mesh));
    TestSceneFree(&t);
  }
}

/* A quarter of a ring as one cell is sound, half a ring is none: where cells tangle there are fewer levels. */
static void TestTangled(void)
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  t.scene.levels = LEVELS_USED;
  TestSceneAddBox(&t, "ring", 4, 2, 0, 1, 4, 2);
  TestSceneSetMap(&t.bodies[0], "y*cos(1.5707963267948966*x), -y*sin(1.5707963267948966*x)");
  mesh = TestSceneMesh(&t);
  CHECK(mesh->num_levels == 1 && mesh->own == 0);
  CHECK_NEAR(Total(mesh->levels[0].num_cells), 8, 0);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  for (PetscInt order = 1; order <= 2; ++order) {
    for (PetscInt refine = 0; refine <= 1; ++refine) TestPlane(order, refine);
    for (PetscInt simplex = 0; simplex <= 1; ++simplex) TestSolid(simplex ? PETSC_TRUE : PETSC_FALSE, order);
  }
  TestSize();
  TestTangled();
  CHECK(!PetscFinalize());
  return 0;
}
