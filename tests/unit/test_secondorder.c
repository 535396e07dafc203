/* test_secondorder.c -- meshes whose bodies are of order 2: nodes on curves, curved facets, the way up from order 1. */
#include "refinement/levelrefine.h"
#include "mesh_scene.h"

/* Largest distance of a cell's middle nodes from the mean of the vertices around them, over the cell's size. */
static PetscReal LargestRise(const Level *level)
{
  PetscReal largest = 0;

  for (PetscInt c = 0; c < level->num_cells; ++c) {
    const ElementType type = (ElementType)level->cell_type[c], facet = ElementFacetType(type);
    const PetscInt   *nodes = &level->cell_nodes[level->cell_start[c]];

    for (PetscInt f = 0; f < ElementNumFacets(type) && ElementOrder(type) > 1; ++f) {
      const PetscInt  *order = ElementFacetNodes(type, f);
      const PetscReal *a = &level->coords[2 * nodes[order[0]]], *b = &level->coords[2 * nodes[order[1]]],
                      *m     = &level->coords[2 * nodes[order[2]]];
      const PetscReal length = PetscSqrtReal(PetscSqr(b[0] - a[0]) + PetscSqr(b[1] - a[1]));

      CHECK(facet == ELEMENT_LINE3);
      for (int d = 0; d < 2; ++d) largest = PetscMax(largest, PetscAbsReal(m[d] - 0.5 * (a[d] + b[d])) / length);
    }
  }
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  return largest;
}

/* Length of a curved side and the integral of its normals; nodes of the side have this distance from the origin. */
static PetscReal CurvedLength(TestScene *t, Level *level, const char side[], PetscReal radius, PetscReal normal[2])
{
  PetscReal length = 0, points[8], weights[8];
  PetscInt  n      = QuadratureLine(8, points, weights);
  Facets    facets;

  normal[0] = normal[1] = 0;
  CHECK(!LevelGetFacets(level, &t->scene, 0, side, &facets));
  for (PetscInt f = 0; f < facets.num; ++f) {
    PetscReal X[2 * ELEMENT_MAX_FACET_NODES], phi[ELEMENT_MAX_NODES], direction[2];

    CHECK(facets.type[f] == ELEMENT_LINE3);
    for (PetscInt i = 0; i < 3; ++i) {
      const PetscReal *x = &level->coords[2 * facets.nodes[f * ELEMENT_MAX_FACET_NODES + i]];

      CHECK_NEAR(x[0] * x[0] + x[1] * x[1], radius * radius, 1e-14);
      for (int d = 0; d < 2; ++d) X[2 * i + d] = x[d];
    }
    for (PetscInt q = 0; q < n; ++q) {
      const PetscReal ds = weights[q] * ElementSurface(ELEMENT_LINE3, X, &points[q], NULL, phi, direction);

      length += ds;
      for (int d = 0; d < 2; ++d) normal[d] += ds * direction[d];
    }
  }
  CHECK(!FacetsDestroy(&facets));
  for (int d = 0; d < 2; ++d) normal[d] = Total(normal[d]);
  return Total(length);
}

/* A quarter of a ring from a box, by a map of either sense. Middle nodes lie on circles too. Areas and
   lengths are those of parabolas, which differ from the circle's by the fourth power of the angle over a
   facet. */
static void TestRing(PetscBool simplex, const char map[])
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  t.scene.refine                                                  = 2;
  TestSceneAddBox(&t, "ring", 2, 4, 1, 0, 2, PETSC_PI / 2)->order = 2;
  t.bodies[0].simplex                                             = simplex;
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_PRESSURE, "left", "1");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_PRESSURE, "right", "1");
  TestSceneSetMap(&t.bodies[0], map);
  mesh = TestSceneMesh(&t);
  for (PetscInt l = 0; l <= 2; ++l) {
    Level          *level = &mesh->levels[l];
    const PetscReal power = PetscPowRealInt(PETSC_PI / 2 / (4 << l), 4);
    PetscReal       n[2];

    CHECK(level->num_global == ((4 << l) + 1) * ((8 << l) + 1));
    CHECK_NEAR(BodyArea(level, 0), 0.75 * PETSC_PI, 0.02 * power);
    CHECK_NEAR(CurvedLength(&t, level, "right", 2, n), PETSC_PI, 0.02 * power);
    CHECK_NEAR(n[0], 2, 1e-13);
    CHECK_NEAR(n[1], 2, 1e-13);
    CHECK_NEAR(CurvedLength(&t, level, "left", 1, n), 0.5 * PETSC_PI, 0.01 * power);
    CHECK_NEAR(n[0], -1, 1e-13);
    CHECK_NEAR(n[1], -1, 1e-13);
    CHECK(LargestRise(level) < 0.25 * PETSC_PI / 2 / (4 << l)); // a circle's is an eighth of the angle
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Without a map, and with a linear one, order 2 changes nothing about the geometry. */
static void TestStraight(const char map[])
{
  TestScene t;
  Mesh      mesh;

  TestSceneInit(&t);
  t.scene.refine                                      = 1;
  TestSceneAddBox(&t, "box", 3, 2, 0, 0, 1, 1)->order = 2;
  TestSceneAddBox(&t, "tri", 3, 2, 0, 2, 1, 3)->order = 2;
  t.bodies[1].simplex                                 = PETSC_TRUE;
  for (int b = 0; b < 2 && map; ++b) TestSceneSetMap(&t.bodies[b], map);
  mesh = TestSceneMesh(&t);
  for (PetscInt l = 0; l < 2; ++l) {
    CHECK(mesh->levels[l].num_global == 2 * (7 + 6 * l) * (5 + 4 * l));
    for (int b = 0; b < 2; ++b) CHECK_NEAR(BodyArea(&mesh->levels[l], b), 1, 1e-14);
    CHECK_NEAR(LargestRise(&mesh->levels[l]), 0, 1e-14);
  }
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* A body of quads upon a body of triangles, of given orders. */
static Mesh MakeMesh(TestScene *t, PetscInt upper, PetscInt lower)
{
  TestSceneInit(t);
  t->scene.refine                                       = 1;
  TestSceneAddBox(t, "upper", 4, 3, 0, 0, 1, 1)->order  = upper;
  TestSceneAddBox(t, "lower", 5, 3, 0, -1, 1, 0)->order = lower;
  t->bodies[1].simplex                                  = PETSC_TRUE;
  TestSceneAddPair(t, "joint", 0, "bottom", 1, "top");
  return TestSceneMesh(t);
}

/* Values at the owned nodes of what linear cells can hold: a linear function on triangles, a bilinear one on quads. */
static void SetValues(Level *level, Vec *v)
{
  PetscScalar *f;

  CHECK(!LevelCreateVec(level, 1, v));
  CHECK(!VecGetArray(*v, &f));
  for (PetscInt i = 0; i < level->num_owned; ++i) {
    const PetscReal *x = &level->coords[2 * i];

    f[i] = 1 + 2 * x[0] + 3 * x[1] + (level->node_body[i] == 0 ? 4 * x[0] * x[1] : 0);
  }
  CHECK(!VecRestoreArray(*v, &f));
}

/* Meshes of different orders are cut alike, and functions of the lower order are functions of the higher. */
static void TestEmbedding(void)
{
  TestScene t[2];
  Mesh      low = MakeMesh(&t[0], 1, 1), high = MakeMesh(&t[1], 2, 2);

  CHECK(!MeshRefine(low));
  CHECK(!MeshRefine(high));
  CHECK(low->num_levels == 3 && high->num_levels == 3);
  for (PetscInt l = 0; l < 3; ++l) {
    Level    *a = &low->levels[l], *b = &high->levels[l];
    PetscReal norm;
    Vec       v[2];
    Mat       E;

    CHECK(a->num_cells == b->num_cells);
    for (PetscInt c = 0; c < a->num_cells; ++c) {
      CHECK(a->cell_body[c] == b->cell_body[c]);
      CHECK(a->coords[2 * a->cell_nodes[a->cell_start[c]]] == b->coords[2 * b->cell_nodes[b->cell_start[c]]]);
    }
    SetValues(a, &v[0]);
    SetValues(b, &v[1]);
    CHECK(!LevelCreateEmbedding(a, b, &E));
    CHECK(!VecScale(v[1], -1));
    CHECK(!MatMultAdd(E, v[0], v[1], v[1]));
    CHECK(!VecNorm(v[1], NORM_INFINITY, &norm));
    CHECK_NEAR(norm, 0, 1e-14);
    CHECK(!MatDestroy(&E));
    for (int k = 0; k < 2; ++k) CHECK(!VecDestroy(&v[k]));
  }
  CHECK(!MeshDestroy(&low));
  CHECK(!MeshDestroy(&high));
  for (int k = 0; k < 2; ++k) TestSceneFree(&t[k]);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  for (int simplex = 0; simplex < 2; ++simplex) {
    TestRing(simplex ? PETSC_TRUE : PETSC_FALSE, "x*cos(y), x*sin(y)");
    TestRing(simplex ? PETSC_TRUE : PETSC_FALSE, "x*sin(y), x*cos(y)");
  }
  TestStraight(NULL);
  TestStraight("x+y/4, y");
  TestEmbedding();
  CHECK(!PetscFinalize());
  return 0;
}
