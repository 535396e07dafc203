/* test_partition.c -- contact edges keep cells that touch on one rank, without spoiling the balance. */
#include "level/level.h"
#include "mesh/mesh.h"
#include "partition/partition.h"
#include "solid_scene.h"

enum { N = 16 };

/* Cells behind facets that overlap, and how many of these couples the partition separates. */
static PetscInt CountSeparated(TestScene *t, Level *level, const PetscInt part[], PetscInt *num_touching)
{
  Facets   upper, lower;
  PetscInt separated = 0;

  *num_touching = 0;
  CHECK(!LevelGetFacets(level, &t->scene, 0, "bottom", &upper));
  CHECK(!LevelGetFacets(level, &t->scene, 1, "top", &lower));
  for (PetscInt f = 0; f < upper.num; ++f) {
    for (PetscInt g = 0; g < lower.num; ++g) {
      const PetscReal *a = &level->coords[2 * upper.nodes[f * ELEMENT_MAX_FACET_NODES]],
                      *b = &level->coords[2 * upper.nodes[f * ELEMENT_MAX_FACET_NODES + 1]];
      const PetscReal *c = &level->coords[2 * lower.nodes[g * ELEMENT_MAX_FACET_NODES]],
                      *d = &level->coords[2 * lower.nodes[g * ELEMENT_MAX_FACET_NODES + 1]];

      if (PetscMin(b[0], c[0]) - PetscMax(a[0], d[0]) < 1e-9) continue; // facing sides run against each other
      ++*num_touching;
      separated += part[upper.cell[f]] != part[lower.cell[g]];
    }
  }
  CHECK(!FacetsDestroy(&upper));
  CHECK(!FacetsDestroy(&lower));
  return separated;
}

enum { MAX_PARTS = 16 };

/* Most nodes of one part over the mean, when each cell has so many along an edge: nodes between parts are the highest one's. */
static PetscReal Imbalance(const Level *level, PetscInt along, PetscInt num_parts, const PetscInt part[])
{
  const PetscReal on_facet         = PetscPowRealInt((PetscReal)along, (int)level->dim - 1);
  PetscReal       nodes[MAX_PARTS] = {0}, most = 0, total = 0;
  PetscInt        begin, end;

  for (PetscInt c = 0; c < level->num_cells; ++c) nodes[part[c]] += (PetscReal)along * on_facet;
  CHECK(!DMPlexGetHeightStratum(level->dm, 1, &begin, &end));
  for (PetscInt f = begin; f < end; ++f) {
    const PetscInt *cells;
    PetscInt        num;

    CHECK(!DMPlexGetSupportSize(level->dm, f, &num));
    CHECK(!DMPlexGetSupport(level->dm, f, &cells));
    if (num == 2 && part[cells[0]] != part[cells[1]]) nodes[PetscMax(part[cells[0]], part[cells[1]])] += on_facet;
  }
  for (PetscInt p = 0; p < num_parts; ++p) most = PetscMax(most, nodes[p]);
  for (PetscInt p = 0; p < num_parts; ++p) total += nodes[p];
  return most * (PetscReal)num_parts / total;
}

/* Two squares that do not match, one upon the other. */
static void TestContactEdges(PetscInt num_parts)
{
  TestScene t;
  Mesh      mesh;
  Level    *level;
  PetscInt  part[2 * N * N], touching, plain, joined;

  TestSceneInit(&t);
  t.scene.comm = PETSC_COMM_SELF;
  TestSceneAddBox(&t, "upper", N, N, 0, 0, 1, 1);
  TestSceneAddBox(&t, "lower", N - 3, N, 0, -1, 1, 0);
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top");
  mesh  = TestSceneMesh(&t);
  level = MeshFinest(mesh);
  CHECK(!PartitionCompute(&t.scene, level, 0, 0, NULL, num_parts, part));
  plain = CountSeparated(&t, level, part, &touching);
  CHECK(!PartitionCompute(&t.scene, level, 0, 5, NULL, num_parts, part));
  joined = CountSeparated(&t, level, part, &touching);
  CHECK(touching == N + N - 3 - 1);
  CHECK(Imbalance(level, 1, num_parts, part) < (num_parts < 8 ? 1.06 : 1.25)); // of forty cells each;
  CHECK(joined <= num_parts - 1); // at most where a cut between parts crosses the contact line
  CHECK(plain > joined);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Couples of facets in one plane of space whose boxes overlap, and how many of them the partition separates. */
static PetscInt CountSolidSeparated(TestScene *t, Level *level, const PetscInt part[], PetscInt *num_touching)
{
  Facets   facets[2];
  PetscInt separated = 0;

  *num_touching = 0;
  for (int k = 0; k < 2; ++k) CHECK(!LevelGetFacets(level, &t->scene, k, k ? "top" : "bottom", &facets[k]));
  for (PetscInt f = 0; f < facets[0].num; ++f) {
    for (PetscInt g = 0; g < facets[1].num; ++g) {
      PetscReal low[2] = {0, 0}, high[2] = {1, 1};

      for (int k = 0; k < 2; ++k) {
        PetscReal X[12];

        SolidNodes(level, 4, &facets[k].nodes[(k ? g : f) * ELEMENT_MAX_FACET_NODES], X);
        for (int d = 0; d < 2; ++d) { // the first and the third corner are opposite
          low[d]  = PetscMax(low[d], PetscMin(X[d], X[6 + d]));
          high[d] = PetscMin(high[d], PetscMax(X[d], X[6 + d]));
        }
      }
      if (high[0] - low[0] < 1e-9 || high[1] - low[1] < 1e-9) continue;
      ++*num_touching;
      separated += part[facets[0].cell[f]] != part[facets[1].cell[g]];
    }
  }
  for (int k = 0; k < 2; ++k) CHECK(!FacetsDestroy(&facets[k]));
  return separated;
}

/* One cube upon another: the cut between two parts crosses the contact, and does not run along it. */
static void TestSolidContactEdges(void)
{
  const PetscInt n = 8;
  TestScene      t;
  Mesh           mesh;
  Level         *level;
  PetscInt       part[2 * 8 * 8 * 8], touching, plain, joined;

  SolidSceneInit(&t);
  t.scene.comm = PETSC_COMM_SELF;
  SolidSceneAddBox(&t, "upper", (PetscInt[]){n, n, n}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 1, 1});
  SolidSceneAddBox(&t, "lower", (PetscInt[]){n - 1, n - 1, n}, (PetscReal[]){0, 0, -1}, (PetscReal[]){1, 1, 0});
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top");
  mesh  = TestSceneMesh(&t);
  level = MeshFinest(mesh);
  CHECK(!PartitionCompute(&t.scene, level, 0, 0, NULL, 2, part));
  plain = CountSolidSeparated(&t, level, part, &touching);
  CHECK(touching == (2 * n - 2) * (2 * n - 2));
  CHECK(!PartitionCompute(&t.scene, level, 0, 5, NULL, 2, part));
  joined = CountSolidSeparated(&t, level, part, &touching);
  CHECK(Imbalance(level, 1, 2, part) < 1.05);
  CHECK(plain > joined);
  CHECK(joined <= touching / 10); // a row of facets or two
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Cubes with 25 facets in contact, on up to 16 parts: none has two facets more than others, or a quarter more cells than the mean. */
static void TestFewFacets(PetscInt num_parts)
{
  PetscInt  facets[MAX_PARTS] = {0}, cells[MAX_PARTS] = {0}, part[125 + 64];
  TestScene t;
  Mesh      mesh;
  Level    *level;
  Facets    upper;

  SolidSceneInit(&t);
  t.scene.comm = PETSC_COMM_SELF;
  SolidSceneAddBox(&t, "upper", (PetscInt[]){5, 5, 5}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 1, 1});
  SolidSceneAddBox(&t, "lower", (PetscInt[]){4, 4, 4}, (PetscReal[]){0, 0, -1}, (PetscReal[]){1, 1, 0});
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top");
  mesh  = TestSceneMesh(&t);
  level = MeshFinest(mesh);
  CHECK(!PartitionCompute(&t.scene, level, 3, 5, NULL, num_parts, part));
  CHECK(!LevelGetFacets(level, &t.scene, 0, "bottom", &upper));
  for (PetscInt f = 0; f < upper.num; ++f) ++facets[part[upper.cell[f]]];
  for (PetscInt c = 0; c < level->num_cells; ++c) ++cells[part[c]];
  for (PetscInt p = 0; p < num_parts; ++p) {
    CHECK(facets[p] <= 25 / num_parts + 1);
    CHECK(4 * num_parts * cells[p] <= 5 * level->num_cells);
  }
  CHECK(!FacetsDestroy(&upper));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Fewer cells than parts: every part has at most one. */
static void TestTiny(void)
{
  TestScene t;
  Mesh      mesh;
  PetscInt  part[3];

  TestSceneInit(&t);
  t.scene.comm = PETSC_COMM_SELF;
  TestSceneAddBox(&t, "box", 3, 1, 0, 0, 1, 1);
  mesh = TestSceneMesh(&t);
  CHECK(!PartitionCompute(&t.scene, MeshFinest(mesh), 0, 5, NULL, 5, part));
  CHECK(part[0] >= 0 && part[0] < part[1] && part[1] < part[2] && part[2] < 5);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Each of two parts of cubes on cubes gets half of the nonmortar facets: by edges alone it would be none or all.
   So it is if the lower block ends before the upper one, and facets have no partner there. */
static void TestShared(PetscReal end)
{
  TestScene t;
  Mesh      mesh;
  PetscInt  part[5 * 5 * 5 + 4 * 4 * 4], own = 0;
  Facets    facets;

  SolidSceneInit(&t);
  t.scene.comm = PETSC_COMM_SELF;
  SolidSceneAddBox(&t, "upper", (PetscInt[]){5, 5, 5}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 1, 1});
  SolidSceneAddBox(&t, "lower", (PetscInt[]){4, 4, 4}, (PetscReal[]){0, 0, -1}, (PetscReal[]){end, end, 0});
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top");
  mesh = TestSceneMesh(&t);
  CHECK(!PartitionCompute(&t.scene, MeshFinest(mesh), 0, 5, NULL, 2, part));
  CHECK(Imbalance(MeshFinest(mesh), 1, 2, part) < 1.1);
  CHECK(!LevelGetFacets(MeshFinest(mesh), &t.scene, 0, "bottom", &facets));
  for (PetscInt f = 0; f < facets.num; ++f) own += part[facets.cell[f]];
  CHECK(facets.num == 25);
  CHECK(own >= 10 && own <= 15);
  CHECK(!FacetsDestroy(&facets));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Cells of order 2 beside some of order 1, and triangles beside quadrilaterals: parts have equally many nodes. */
static void TestNodes(PetscInt order, PetscBool simplex)
{
  const PetscInt a_cell =
      order == 2 ? 4 : 2; // nodes of a quadrilateral of the lower body, by those of a cell of the upper one
  TestScene t;
  Mesh      mesh;
  Level    *level;
  PetscInt  part[2 * N * N + N * N], nodes = 0, total = 0;

  TestSceneInit(&t);
  t.scene.comm                                            = PETSC_COMM_SELF;
  TestSceneAddBox(&t, "upper", N, N, 0, 0, 1, 1)->simplex = simplex;
  TestSceneAddBox(&t, "lower", N, N, 0, -1, 1, 0)->order  = order;
  mesh                                                    = TestSceneMesh(&t);
  level                                                   = MeshFinest(mesh);
  CHECK(!PartitionCompute(&t.scene, level, 0, 5, NULL, 2, part));
  for (PetscInt c = 0; c < level->num_cells; ++c) {
    nodes += part[c] * (level->cell_body[c] ? a_cell : 1);
    total += level->cell_body[c] ? a_cell : 1;
  }
  CHECK(total == N * N * (order == 2 ? 5 : 4));
  CHECK(20 * PetscAbsInt(2 * nodes - total) <= 2 * total);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Nodes between parts are the highest rank's: with them all parts have equally many on the finest level. With equally many cells the
   second of two has 3 % too many. */
static void TestBetween(PetscInt num_parts)
{
  const PetscInt n = 8, refine = 2, along = 4; // cells of the finest level along an edge
  TestScene      t;
  Mesh           mesh;
  PetscInt       part[8 * 8 * 8];

  SolidSceneInit(&t);
  t.scene.comm = PETSC_COMM_SELF;
  SolidSceneAddBox(&t, "box", (PetscInt[]){n, n, n}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 1, 1});
  mesh = TestSceneMesh(&t);
  CHECK(!PartitionCompute(&t.scene, MeshFinest(mesh), refine, 5, NULL, num_parts, part));
  CHECK(Imbalance(MeshFinest(mesh), along, num_parts, part) < 1.03);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* Cells that are four times longer than wide. Parts end where they are long, but for a corner or two, though
   the cut then has more facets. */
static void TestLines(void)
{
  TestScene t;
  Mesh      mesh;
  Level    *level;
  PetscInt  part[N * 2 * N], begin, end, cut[2] = {0, 0}; // across the long way, across the short one

  TestSceneInit(&t);
  t.scene.comm = PETSC_COMM_SELF;
  TestSceneAddBox(&t, "box", 2 * N, N, 0, 0, 1, 2);
  mesh  = TestSceneMesh(&t);
  level = MeshFinest(mesh);
  CHECK(!PartitionCompute(&t.scene, level, 0, 5, NULL, 2, part));
  CHECK(!DMPlexGetHeightStratum(level->dm, 1, &begin, &end));
  for (PetscInt f = begin; f < end; ++f) {
    const PetscInt *cells;
    PetscInt        num;
    PetscReal       along = 0;

    CHECK(!DMPlexGetSupportSize(level->dm, f, &num));
    CHECK(!DMPlexGetSupport(level->dm, f, &cells));
    if (num < 2 || part[cells[0]] == part[cells[1]]) continue;
    for (PetscInt i = 0; i < 8; ++i)
      along += (i < 4 ? -1 : 1) * level->coords[level->cell_nodes[level->cell_start[cells[i / 4]] + i % 4] * 2];
    ++cut[PetscAbsReal(along) > 1e-9];
  }
  CHECK(cut[0] >= 2 * N);
  CHECK(cut[1] <= 2);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* The mesh arrives as it was parted: nothing lost, no rank overloaded. Two triangles weigh as much as a quadrilateral. */
static void TestSpread(void)
{
  TestScene   t;
  Mesh        mesh;
  PetscInt    num, largest = 0;
  PetscMPIInt size;

  CHECK(!MPI_Comm_size(PETSC_COMM_WORLD, &size));
  TestSceneInit(&t);
  TestSceneAddBox(&t, "upper", N, N, 0, 0, 1, 1);
  TestSceneAddBox(&t, "lower", N, N, 0, -1, 1, 0)->simplex = PETSC_TRUE;
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top");
  mesh = TestSceneMesh(&t);
  num  = MeshFinest(mesh)->num_cells;
  for (PetscInt c = 0; c < num; ++c) largest += MeshFinest(mesh)->cell_body[c] ? 1 : 2;
  CHECK_NEAR(Total(num), 3 * N * N, 0);
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_INT, MPI_MAX, PETSC_COMM_WORLD));
  CHECK(largest * size <= 1.1 * 4 * N * N);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* A reach as long as the sides makes no more edges than facets can use. These are some tens of bytes for each
   of a few neighbours, and not for each of all. */
static void TestFarReach(void)
{
  const PetscInt
      n    = 40,
      some = 4000; // bytes for each facet, in edges and METIS's rows; all others would take a hundred times as much
  TestScene      t;
  Mesh           mesh;
  PetscInt       part[2 * 40 * 40];
  PetscLogDouble before, after;

  SolidSceneInit(&t);
  t.scene.comm = PETSC_COMM_SELF;
  SolidSceneAddBox(&t, "upper", (PetscInt[]){n, n, 1}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 1, 0.1});
  SolidSceneAddBox(&t, "lower", (PetscInt[]){n, n, 1}, (PetscReal[]){0, 0, -0.1}, (PetscReal[]){1, 1, 0});
  TestSceneAddPair(&t, "joint", 0, "bottom", 1, "top")->reach = 1;
  mesh                                                        = TestSceneMesh(&t);
  CHECK(!PetscMallocGetMaximumUsage(&before));
  CHECK(!PartitionCompute(&t.scene, MeshFinest(mesh), 0, 5, NULL, 2, part));
  CHECK(!PetscMallocGetMaximumUsage(&after));
  CHECK(after - before < some * n * n);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  for (PetscInt parts = 2; parts <= 12; parts += parts < 4 ? 1 : 4) TestContactEdges(parts); // both of METIS's methods
  TestSolidContactEdges();
  for (PetscInt parts = 4; parts <= MAX_PARTS; parts += 4) TestFewFacets(parts);
  TestShared(1);
  TestShared(0.3);
  TestNodes(2, PETSC_FALSE);
  TestNodes(1, PETSC_TRUE);
  TestBetween(2);
  TestBetween(4);
  TestLines();
  TestFarReach();
  TestTiny();
  TestSpread();
  CHECK(!PetscFinalize());
  return 0;
}
