/* test_basis.c -- the change of basis: rows of B are single unknowns, rigid motions keep A's null space,
   supports are met. This holds for any order, any nodes with multipliers, in the plane and in space, and on
   any number of ranks. */
#include "base/compat.h"
#include "problem/condensedproduct.h"
#include "problem/stiffness.h"
#include "rigid/nearnullspace.h"
#include "mesh_scene.h"
#include "solid_scene.h"
#include "uniform.h"

/* What a scene in the plane is made of; all bodies are boxes of order 2, over and under y = 0. */
typedef enum {
  CASE_VERTICES, /* a block on a block, multipliers at vertices */
  CASE_CHAIN,    /* the side that is shifted in one pair is the mortar side of another, which has them at all nodes */
  CASE_TWICE,    /* a side in two pairs, with multipliers at vertices in both */
  CASE_COUNT
} Case;

static VI CreateVI(TestScene *t, Case which, PetscBool supports, Mesh *mesh)
{
  SceneBody *body;
  VI         vi;

  TestSceneInit(t);
  body        = TestSceneAddBox(t, "base", 5, 3, 0, -1, 2, 0);
  body->order = 2;
  if (supports) {
    TestSceneAddBoundary(body, BOUNDARY_DISPLACEMENT, "bottom", "0, 0");
    TestSceneAddBoundary(body, BOUNDARY_DISPLACEMENT, "left", "0.01*(1+y)^2, free"); // reaches the contact at (0, 0)
  }
  for (PetscInt b = 1; b < (which == CASE_VERTICES ? 2 : 3); ++b) {
    body        = TestSceneAddBox(t, b == 1 ? "first" : "second", 3, 2, b - 1, 0, b == 1 ? 0.9 : 2, 1);
    body->order = 2;
    if (supports) {
      TestSceneAddBoundary(body, BOUNDARY_DISPLACEMENT, "top", "0.01*x, -0.02");
      TestSceneAddBoundary(body, BOUNDARY_DISPLACEMENT, b == 1 ? "left" : "right", "0.01*(x+(y-1)^2), free");
    }
  }
  if (which == CASE_VERTICES) {
    TestSceneAddPair(t, "pair", 1, "bottom+left", 0, "top")->multipliers = MULTIPLIERS_VERTICES;
  } else {
    if (which == CASE_CHAIN)
      TestSceneAddPair(t, "above", 1, "bottom", 0, "top");
    else
      TestSceneAddPair(t, "above", 0, "top", 1, "bottom")->multipliers = MULTIPLIERS_VERTICES;
    TestSceneAddPair(t, "below", 0, "top", 2, "bottom")->multipliers = MULTIPLIERS_VERTICES;
  }
  *mesh = TestSceneMesh(t);
  CHECK(!VICreate(&t->scene, *mesh, &vi));
  return vi;
}

/* A block of tetrahedra in the corner of two others, all of order 2: eq. 3.5 on its sides, two constraints on its edge. */
static VI CreateSolidVI(TestScene *t, PetscBool supports, Mesh *mesh)
{
  const PetscInt  faces[3][3] = {{2, 2, 2}, {3, 2, 1}, {1, 2, 3}};
  const PetscReal lower[3][3] = {{0, 0, 0}, {0, 0, -1}, {-1, 0, 0}}, upper[3][3] = {{1, 1, 1}, {1, 1, 0}, {0, 1, 1}};
  const char     *names[3] = {"block", "floor", "wall"};
  SceneBody      *body;
  VI              vi;

  SolidSceneInit(t);
  for (PetscInt b = 0; b < 3; ++b) {
    body          = SolidSceneAddBox(t, names[b], faces[b], lower[b], upper[b]);
    body->order   = 2;
    body->simplex = (PetscBool)(b == 0);
    if (supports) TestSceneAddBoundary(body, BOUNDARY_DISPLACEMENT, "front", "free, 0.01*(x^2+z), free");
    if (supports && b == 0) TestSceneAddBoundary(body, BOUNDARY_DISPLACEMENT, "right", "0.01*z*y^2, free, 0.02*y");
  }
  TestSceneAddPair(t, "below", 0, "bottom", 1, "top");
  TestSceneAddPair(t, "beside", 0, "left", 2, "right");
  *mesh = TestSceneMesh(t);
  CHECK(!VICreate(&t->scene, *mesh, &vi));
  return vi;
}

static void DestroyVI(TestScene *t, Mesh *mesh, VI *vi)
{
  CHECK(!VIDestroy(vi));
  CHECK(!MeshDestroy(mesh));
  TestSceneFree(t);
}

/* (B u)_row = D_row y_row for any y. */
static void TestRows(VI vi)
{
  Vec              y, u, Bu;
  PetscScalar     *ya;
  const PetscReal *ba;
  PetscInt         begin, end, rows = vi->num_rows;

  CHECK(!VecDuplicate(vi->upper, &y));
  CHECK(!VecGetOwnershipRange(y, &begin, &end));
  CHECK(!VecGetArray(y, &ya));
  for (PetscInt i = 0; i < end - begin; ++i) ya[i] = Uniform(-1, 1);
  CHECK(!VecRestoreArray(y, &ya));
  CHECK(!LevelCreateVec(vi->level, vi->level->dim, &u));
  CHECK(!VIRecoverDisplacement(vi, y, u));
  CHECK(!VecDuplicate(vi->G, &Bu));
  CHECK(!MatMult(vi->B, u, Bu));
  CHECK(!VecGetArray(y, &ya));
  CHECK(!VecGetArrayRead(Bu, &ba));
  for (PetscInt r = 0; r < vi->num_rows; ++r)
    CHECK_NEAR(ba[r] / (vi->row_D[r] * vi->length), ya[vi->row_dof[r] - begin], 1e-13);
  CHECK(!VecRestoreArrayRead(Bu, &ba));
  CHECK(!VecRestoreArray(y, &ya));
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, &rows, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  CHECK(rows >= 3);
  CHECK(!VecDestroy(&Bu));
  CHECK(!VecDestroy(&u));
  CHECK(!VecDestroy(&y));
}

/* Without supports the near null space is the null space of A: every rigid motion of every body. */
static void TestMotions(VI vi)
{
  MatNullSpace space;
  PetscInt     num;
  const Vec   *vectors;
  Vec          image;
  PetscReal    norm;

  CHECK(!NearNullSpaceAttach(vi));
  CHECK(!MatGetNearNullSpace(vi->A, &space));
  CHECK(!MatNullSpaceGetVecs(space, NULL, &num, &vectors));
  CHECK(num == (vi->level->dim == 3 ? 6 : 3) * vi->scene->num_bodies);
  CHECK(!VecDuplicate(vi->upper, &image));
  for (PetscInt i = 0; i < num; ++i) {
    CHECK(!MatMult(vi->A, vectors[i], image));
    CHECK(!VecNorm(image, NORM_INFINITY, &norm));
    CHECK_NEAR(norm, 0, 1e-13);
  }
  CHECK(!VecDestroy(&image));
}

/* Fixed unknowns make u what the supports prescribe, also in the middle of facets of a shifted side. Their
   rows of A are unit rows, whose right-hand sides are their values. */
static void TestSupports(VI vi)
{
  Vec                y, u;
  const PetscScalar *ua;
  const Support     *held = &vi->support;
  const PetscInt     dim  = vi->level->dim;

  CHECK(!VecDuplicate(vi->upper, &y));
  CHECK(!VecCopy(vi->b, y)); // any other unknown may have any value
  CHECK(!LevelCreateVec(vi->level, vi->level->dim, &u));
  CHECK(!VIRecoverDisplacement(vi, y, u));
  CHECK(!VecGetArrayRead(u, &ua));
  for (PetscInt i = 0; i < vi->level->num_owned; ++i) {
    for (PetscInt j = 0; j < held->count[i]; ++j) {
      const PetscReal *d   = &held->directions[(dim * i + j) * dim];
      PetscReal        dot = 0;

      for (PetscInt k = 0; k < dim; ++k) dot += d[k] * ua[dim * i + k];
      CHECK_NEAR(dot, held->values[dim * i + j], 1e-14);
    }
  }
  CHECK(!VecRestoreArrayRead(u, &ua));
  CHECK(!VecDestroy(&u));
  CHECK(!VecDestroy(&y));
}

/* A is the same by products with half of K and as a matrix, which its rows make. */
static void TestProducts(VI vi)
{
  PetscReal    norm, off;
  PetscScalar *a;
  PetscInt     n;
  Vec          x, y[2];

  CHECK(!VecDuplicate(vi->b, &x));
  CHECK(!VecGetLocalSize(x, &n));
  CHECK(!VecGetArray(x, &a));
  for (PetscInt i = 0; i < n; ++i) a[i] = Uniform(-1, 1);
  CHECK(!VecRestoreArray(x, &a));
  for (int way = 0; way < 2; ++way) {
    if (way == 1) CHECK(!VIAssemble(vi));
    CHECK(!VecDuplicate(vi->b, &y[way]));
    CHECK(!MatMult(vi->A, x, y[way]));
    if (way == 0) continue;
    CHECK(!VecNorm(y[0], NORM_2, &norm));
    CHECK(!VecAXPY(y[way], -1, y[0]));
    CHECK(!VecNorm(y[way], NORM_2, &off));
    CHECK_NEAR(off, 0, 1e-12 * norm);
  }
  for (int way = 0; way < 2; ++way) CHECK(!VecDestroy(&y[way]));
  CHECK(!VecDestroy(&x));
}

/* Products restricted to every third node are right there for any x, and everywhere for an x that is 0 at other nodes. */
static void TestRegion(VI vi)
{
  const PetscInt dim = vi->level->dim;
  PetscReal      part, norm, off;
  PetscInt       n;
  Vec            region, x, y[2];
  Mat            S, P;

  CHECK(!StiffnessCreateScaled(vi->K, 1 / vi->stiffness, &S));
  CHECK(!CondensedProductCreate(S, vi, &P));
  CHECK(!VecDuplicate(vi->upper, &region));
  CHECK(!VecDuplicate(region, &x));
  CHECK(!VecGetLocalSize(x, &n));
  for (PetscInt i = 0; i < 2; ++i) CHECK(!VecDuplicate(x, &y[i]));
  for (PetscInt i = 0; i < n; ++i) {
    CHECK(!VecSetValue(region, dim * vi->level->node_begin + i, i / dim % 3 == 0, INSERT_VALUES));
    CHECK(!VecSetValue(x, dim * vi->level->node_begin + i, Uniform(-1, 1), INSERT_VALUES));
  }
  CHECK(!VecAssemblyBegin(region));
  CHECK(!VecAssemblyEnd(region));
  CHECK(!VecAssemblyBegin(x));
  CHECK(!VecAssemblyEnd(x));
  for (int within = 0; within < 2; ++within) {
    if (within) CHECK(!VecPointwiseMult(x, x, region));
    CHECK(!MatMult(vi->S, x, y[0]));
    CHECK(!CondensedProductRestrict(P, region, &part));
    CHECK(!MatMult(P, x, y[1]));
    CHECK(!VecNorm(y[0], NORM_2, &norm));
    CHECK(!VecAXPY(y[1], -1, y[0]));
    if (!within) CHECK(!VecPointwiseMult(y[1], y[1], region));
    CHECK(!VecNorm(y[1], NORM_2, &off));
    CHECK(part > 0 && part <= 1);
    CHECK_NEAR(off, 0, 1e-12 * norm);
  }
  for (PetscInt i = 0; i < 2; ++i) CHECK(!VecDestroy(&y[i]));
  CHECK(!VecDestroy(&x));
  CHECK(!VecDestroy(&region));
  CHECK(!MatDestroy(&P));
  CHECK(!MatDestroy(&S));
}

/* A product has one exchange of x and one of what T' adds, whatever T has of factors. */
static void TestExchanges(VI vi)
{
  PetscEventPerfInfo before, after;
  PetscLogEvent      scatter;
  PetscLogStage      stage;
  PetscMPIInt        size;
  Vec                y;

  CHECK(!PetscLogEventGetId("VecScatterBegin", &scatter));
  CHECK(!PetscLogStageGetId("Main Stage", &stage));
  CHECK(!MPI_Comm_size(PETSC_COMM_WORLD, &size));
  CHECK(!VecDuplicate(vi->b, &y));
  CHECK(!PetscLogEventGetPerfInfo(stage, scatter, &before));
  CHECK(!MatMult(vi->S, vi->b, y));
  CHECK(!PetscLogEventGetPerfInfo(stage, scatter, &after));
  CHECK(after.count - before.count == (size > 1 ? 2 : 0));
  CHECK(!VecDestroy(&y));
}

int main(int argc, char **argv)
{
  TestScene t;
  Mesh      mesh;
  VI        vi;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscLogDefaultBegin());
  for (PetscInt which = 0; which < CASE_COUNT; ++which) {
    vi = CreateVI(&t, (Case)which, PETSC_FALSE, &mesh);
    TestExchanges(vi);
    TestRows(vi);
    TestMotions(vi);
    TestRegion(vi);
    TestProducts(vi);
    DestroyVI(&t, &mesh, &vi);
  }
  vi = CreateVI(&t, CASE_VERTICES, PETSC_TRUE, &mesh);
  TestSupports(vi);
  TestRegion(vi);
  TestProducts(vi);
  DestroyVI(&t, &mesh, &vi);
  vi = CreateSolidVI(&t, PETSC_FALSE, &mesh);
  TestExchanges(vi);
  TestRows(vi);
  TestMotions(vi);
  DestroyVI(&t, &mesh, &vi);
  vi = CreateSolidVI(&t, PETSC_TRUE, &mesh);
  TestSupports(vi);
  TestRegion(vi);
  TestProducts(vi);
  DestroyVI(&t, &mesh, &vi);
  PetscCall(PetscFinalize());
  return 0;
}
