/* test_adapt.c -- levels by bisection and by splitting: sides, prolongation and numbers, on any number of ranks. */
#include "level/level.h"
#include "mesh/mesh.h"
#include "mesh_scene.h"
#include <math.h>
#include <stdint.h>

/* Two boxes, one with a map, of a dimension and an order. */
static Mesh MakeMesh(TestScene *t, PetscInt dim, PetscInt order, PetscBool kept)
{
  TestSceneInit(t);
  t->scene.dim        = dim;
  t->scene.adapt.on   = PETSC_TRUE;
  t->scene.adapt.kept = kept;
  for (PetscInt b = 0; b < 2; b++) {
    SceneBody *body = TestSceneAddBox(t, b ? "lower" : "upper", 2 + b, 2, 0, -b, 1, 1 - b);

    body->order    = order;
    body->faces[2] = 1;
    body->upper[2] = 1;
    body->simplex  = (PetscBool)(b == 0); // the other one has quads or hexahedra, which are cut or kept
  }
  TestSceneAddPair(t, "joint", 0, dim == 2 ? "bottom" : "front", 1, dim == 2 ? "top" : "back");
  return TestSceneMesh(t);
}

/* A polynomial of the order of the mesh. */
static PetscReal Polynomial(PetscInt dim, PetscInt order, const PetscReal x[])
{
  const PetscReal z = dim == 3 ? x[2] : 0, linear = 1 + 2 * x[0] - 3 * x[1] + z;

  return order == 1 ? linear : linear + x[0] * x[0] - 2 * x[0] * x[1] + 3 * x[1] * z - z * z;
}

static Vec Interpolate(Level *level, PetscInt order)
{
  PetscScalar *x;
  Vec          v;

  CHECK(!LevelCreateVec(level, 1, &v));
  CHECK(!VecGetArray(v, &x));
  for (PetscInt i = 0; i < level->num_owned; i++) x[i] = Polynomial(level->dim, order, &level->coords[i * level->dim]);
  CHECK(!VecRestoreArray(v, &x));
  return v;
}

/* The prolongation has polynomials of the order of the mesh. */
static void CheckProlongation(Level *coarse, Level *fine, PetscInt order)
{
  Vec       from = Interpolate(coarse, order), to = Interpolate(fine, order), v;
  PetscReal error;

  CHECK(!VecDuplicate(to, &v));
  CHECK(!MatMult(fine->prolongation, from, v));
  CHECK(!VecAXPY(v, -1, to));
  CHECK(!VecNorm(v, NORM_INFINITY, &error));
  CHECK_NEAR(error, 0, 1e-14);
  CHECK(!VecDestroy(&from));
  CHECK(!VecDestroy(&to));
  CHECK(!VecDestroy(&v));
}

static PetscReal FacetsMeasure(const Level *level, const Facets *facets)
{
  PetscReal area = 0;

  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * ELEMENT_MAX_FACET_NODES];
    PetscReal       a[3] = {0}, b[3] = {0};

    for (PetscInt d = 0; d < level->dim; d++) {
      a[d] = level->coords[nodes[1] * level->dim + d] - level->coords[nodes[0] * level->dim + d];
      if (level->dim == 3) b[d] = level->coords[nodes[2] * 3 + d] - level->coords[nodes[0] * 3 + d];
    }
    area += level->dim == 2 ? PetscSqrtReal(a[0] * a[0] + a[1] * a[1])
                            : PetscSqrtReal(PetscSqr(a[1] * b[2] - a[2] * b[1]) + PetscSqr(a[2] * b[0] - a[0] * b[2]) +
                                            PetscSqr(a[0] * b[1] - a[1] * b[0])) /
                                  (ElementLinear(facets->type[f]) == ELEMENT_QUAD4 ? 1 : 2);
  }
  return area;
}

/* Sides keep their facets, all of them. [in] sides - of the pair, nonmortar first */
static void CheckSides(Level *level, Scene scene)
{
  for (PetscInt b = 0; b < 2; b++) {
    const ScenePair *pair = &scene->pairs[0];
    Facets           facets;
    PetscReal        area;

    CHECK(!LevelGetFacets(level, scene, b, b ? pair->mortar.side : pair->nonmortar.side, &facets));
    area = FacetsMeasure(level, &facets);
    CHECK(!MPI_Allreduce(MPI_IN_PLACE, &area, 1, MPIU_REAL, MPI_SUM, level->comm));
    CHECK_NEAR(area, 1, 1e-13);
    CHECK(!FacetsDestroy(&facets));
  }
}

/* Marks cells near a place. */
static void Adapt(Mesh mesh, const PetscReal place[])
{
  const Level *level = MeshFinest(mesh);
  PetscInt    *marked;

  CHECK(!PetscMalloc1(level->num_cells, &marked));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    PetscReal distance = 0;

    for (PetscInt d = 0; d < level->dim; d++)
      distance += PetscSqr(level->coords[level->cell_nodes[level->cell_start[c]] * level->dim + d] - place[d]);
    marked[c] = (PetscBool)(distance < .1);
  }
  CHECK(!MeshAdapt(mesh, marked));
  CHECK(!PetscFree(marked));
}

/* What was counted on one rank. [kept][dim][order-1][nodes, cells] */
static const PetscInt Expected[2][4][2][2] = {{[2] = {{60, 88}, {206, 88}}, [3] = {{236, 862}, {1460, 862}}},
                                              {[2] = {{60, 82}, {206, 82}}, [3] = {{236, 832}, {1460, 832}}}};

static uint64_t Mix(uint64_t h)
{
  h = (h ^ h >> 33) * 0xFF51AFD7ED558CCDU;
  h = (h ^ h >> 33) * 0xC4CEB9FE1A85EC53U;
  return h ^ h >> 33;
}

/* A number of a cell that depends on the positions of its vertices alone. */
static uint64_t CellNumber(const Level *level, PetscInt cell)
{
  uint64_t sum = 0;

  for (PetscInt i = 0; i < ElementNumNodes(ElementLinear((ElementType)level->cell_type[cell])); i++) {
    uint64_t vertex = 1;

    for (PetscInt d = 0; d < level->dim; d++) {
      const PetscReal x = level->coords[level->cell_nodes[level->cell_start[cell] + i] * level->dim + d];

      vertex = Mix(vertex ^ (uint64_t)(int64_t)llround(x * 1e9));
    }
    sum += vertex;
  }
  return Mix(sum);
}

/* A number of the mesh that no order of its cells changes. */
static uint64_t MeshNumber(const Level *level)
{
  uint64_t sum = 0;

  for (PetscInt c = 0; c < level->num_cells; c++) sum += CellNumber(level, c);
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_UINT64_T, MPI_SUM, level->comm));
  return sum;
}

enum { NUM_MARKINGS = SANITIZED ? 3 : 4 };

/* Hanging nodes have the values of polynomials, and forces on them have the same work after they moved. The
   facets beside them are no boundary. */
static void CheckHanging(Level *level, Scene scene, PetscInt order)
{
  Vec         v, f, moved;
  PetscScalar work[2];
  PetscReal   error;

  CHECK(level->inner);
  v = Interpolate(level, order);
  CHECK(!VecDuplicate(v, &moved));
  CHECK(!VecDuplicate(v, &f));
  CHECK(!VecCopy(v, moved));
  CHECK(!LevelConform(level, 1, moved));
  CHECK(!VecAXPY(moved, -1, v));
  CHECK(!VecNorm(moved, NORM_INFINITY, &error));
  CHECK_NEAR(error, 0, 1e-13);
  CHECK(!VecCopy(v, f));
  CHECK(!VecShift(f, 1));
  CHECK(!VecDot(f, v, &work[0]));
  CHECK(!LevelConformForces(level, 1, f));
  CHECK(!VecDot(f, v, &work[1]));
  CHECK_NEAR(work[1] / work[0], 1, 1e-13);
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    Facets    facets;
    PetscReal length;

    CHECK(!LevelGetBoundary(level, b, &facets));
    length = FacetsMeasure(level, &facets);
    CHECK(!MPI_Allreduce(MPI_IN_PLACE, &length, 1, MPIU_REAL, MPI_SUM, level->comm));
    CHECK_NEAR(length, 2 * level->dim, 1e-13);
    CHECK(!FacetsDestroy(&facets));
  }
  CHECK(!VecDestroy(&v));
  CHECK(!VecDestroy(&f));
  CHECK(!VecDestroy(&moved));
}

/* Random markings: what they are depends on places alone, and so do the meshes, of both orders. [kept][dim] */
static const uint64_t Random[2][4] = {{[2] = 0xAAABE1246C1CB5A7U, [3] = 0x2B6930710CE323E1U},
                                      {[2] = 0x5A728DE374EA6AF6U, [3] = 0x5DA78DFC3A65ACBCU}};

static void TestRandom(PetscInt dim, PetscInt order, PetscBool kept)
{
  TestScene t;
  Mesh      mesh   = MakeMesh(&t, dim, order, kept);
  uint64_t  number = 0;

  for (PetscInt step = 0; step < NUM_MARKINGS; step++) {
    const Level *level = MeshFinest(mesh);
    PetscInt    *marked;

    CHECK(!PetscMalloc1(level->num_cells, &marked));
    for (PetscInt c = 0; c < level->num_cells; c++)
      marked[c] = (PetscBool)(Mix(CellNumber(level, c) + (uint64_t)step) % 10 == 0);
    CHECK(!MeshAdapt(mesh, marked));
    CHECK(!PetscFree(marked));
    CheckSides(MeshFinest(mesh), &t.scene);
    if (MeshFinest(mesh)->conforming) CheckHanging(MeshFinest(mesh), &t.scene, order);
    number = Mix(number + MeshNumber(MeshFinest(mesh)));
  }
  CHECK(SANITIZED || number == Random[kept][dim]);
  CHECK((MeshFinest(mesh)->conforming != NULL) == kept);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

static void TestMesh(PetscInt dim, PetscInt order, PetscBool kept)
{
  const PetscReal place[] = {0, 0, 0};
  TestScene       t;
  Mesh            mesh = MakeMesh(&t, dim, order, kept);
  PetscInt        cells;

  for (PetscInt step = 0; step < 3; step++) {
    Adapt(mesh, place);
    CheckProlongation(MeshFinest(mesh) - 1, MeshFinest(mesh), order);
    CheckSides(MeshFinest(mesh), &t.scene);
  }
  cells = MeshFinest(mesh)->num_cells;
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, &cells, 1, MPIU_INT, MPI_SUM, MPI_COMM_WORLD));
  CHECK(MeshFinest(mesh)->num_global == Expected[kept][dim][order - 1][0]);
  CHECK(cells == Expected[kept][dim][order - 1][1]);
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (PetscInt dim = 2; dim <= 3; dim++) {
    for (PetscInt order = 1; order <= 2; order++) {
      for (PetscInt kept = 0; kept < 2; kept++) {
        TestMesh(dim, order, (PetscBool)kept);
        TestRandom(dim, order, (PetscBool)kept);
      }
    }
  }
  PetscCall(PetscFinalize());
  return 0;
}
