/* test_blocks.c -- connected components of graphs that ranks cut; lines and planes of nodes in a box of long cells. */
#include "base/compat.h"
#include "multigrid/blocksmoother.h"
#include "multigrid/graphcomponents.h"
#include "solve/meshlevels.h"
#include "mesh_scene.h"
#include "solid_scene.h"

enum { EACH = 12, STRANDS = 5 };

/* Row i is coupled to rows i - STRANDS and i + STRANDS, and to i - 1 and i + 1 by entries that are 0. */
static void CreateStrands(Mat *A)
{
  PetscInt begin, end, N;

  CHECK(!MatCreateAIJ(PETSC_COMM_WORLD, EACH, EACH, PETSC_DETERMINE, PETSC_DETERMINE, 5, NULL, 5, NULL, A));
  CHECK(!MatGetSize(*A, &N, NULL));
  CHECK(!MatGetOwnershipRange(*A, &begin, &end));
  for (PetscInt i = begin; i < end; ++i) {
    CHECK(!MatSetValue(*A, i, i, 2, INSERT_VALUES));
    for (PetscInt side = -1; side <= 1; side += 2) {
      if (i + side >= 0 && i + side < N) CHECK(!MatSetValue(*A, i, i + side, 0, INSERT_VALUES));
      if (i + side * STRANDS >= 0 && i + side * STRANDS < N)
        CHECK(!MatSetValue(*A, i, i + side * STRANDS, -1, INSERT_VALUES));
    }
  }
  CHECK(!MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  CHECK(!MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
}

/* Every strand has its first row for a label, and all of its rows on one rank. */
static void TestStrands(void)
{
  PetscReal       label[EACH];
  PetscInt        begin, N, num, own = 0, all;
  const PetscInt *row;
  IS              rows;
  Mat             A;

  CreateStrands(&A);
  CHECK(!MatGetSize(A, &N, NULL));
  CHECK(!MatGetOwnershipRange(A, &begin, NULL));
  CHECK(!GraphComponentsLabel(A, label));
  for (PetscInt i = 0; i < EACH; ++i) CHECK((PetscInt)label[i] == (begin + i) % STRANDS);
  CHECK(!GraphComponentsGather(A, &rows));
  CHECK(!ISGetLocalSize(rows, &num));
  CHECK(!ISGetIndices(rows, &row));
  for (PetscInt s = 0; s < STRANDS; ++s) {
    const PetscInt whole = N / STRANDS + (s < N % STRANDS);
    PetscInt       count = 0;

    for (PetscInt i = 0; i < num; ++i) count += row[i] % STRANDS == s;
    CHECK(count == 0 || count == whole);
    own += count;
  }
  CHECK(!ISRestoreIndices(rows, &row));
  CHECK(own == num);
  CHECK(!MPI_Allreduce(&num, &all, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  CHECK(all == N);
  CHECK(!ISDestroy(&rows));
  CHECK(!MatDestroy(&A));
}

enum { ALONG = 6, MAX_NODES = (ALONG + 1) * (ALONG + 1) * (ALONG + 1) };

/* A box of cells of this size. [in] axes - those that blocks lead along; none where cells are not long */
static void TestBox(PetscBool simplex, const PetscReal size[3], const PetscBool axes[3])
{
  const PetscInt  faces[] = {ALONG, ALONG, ALONG};
  const PetscReal zero[] = {0, 0, 0}, upper[] = {ALONG * size[0], ALONG * size[1], ALONG * size[2]};
  PetscReal       label[2 * MAX_NODES], code[2 * MAX_NODES], first[MAX_NODES];
  PetscBool       found, round;
  TestScene       t;
  Mesh            mesh;
  VI              vi;
  GhostExchange   ghosts;
  Operator        op;

  SolidSceneInit(&t);
  SolidSceneAddBox(&t, "box", faces, zero, upper)->simplex = simplex;
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_DISPLACEMENT, "bottom", "0, 0, 0");
  mesh = TestSceneMesh(&t);
  CHECK(!VICreate(&t.scene, mesh, &vi));
  CHECK(!MeshLevelsCreateOperator(&(Inequality){.vi = vi, .A = vi->A, .b = vi->b, .upper = vi->upper}, NULL, &op));
  CHECK(!GhostExchangeCreate(vi->K, 3, &ghosts));
  CHECK(!BlockSmootherLabel(&op, &ghosts, PETSC_FALSE, label, &found, &round));
  CHECK(found == (PetscBool)(axes[0] || axes[1] || axes[2]));
  CHECK(round == (PetscBool)!found);
  /* a block is what agrees in all positions but those along its axes */
  for (PetscInt i = 0; found && i < ghosts.n; ++i) {
    code[i] = 0;
    for (PetscInt k = 0; k < 3; ++k)
      if (!axes[k]) code[i] = code[i] * (ALONG + 1) + PetscFloorReal(vi->level->coords[3 * i + k] / size[k] + 0.5);
  }
  if (found) CHECK(!GhostExchangeUpdate(&ghosts, code));
  for (PetscInt i = 0; i < MAX_NODES; ++i) first[i] = -1;
  for (PetscInt i = 0; found && i < ghosts.n + ghosts.num; ++i) {
    const PetscInt at = (PetscInt)code[i];

    if (first[at] < 0) first[at] = label[i];
    CHECK(label[i] == first[at]);
    for (PetscInt other = 0; other < MAX_NODES; ++other) CHECK(other == at || first[other] != label[i]);
  }
  CHECK(!GhostExchangeDestroy(&ghosts));
  CHECK(!OperatorDestroy(&op));
  CHECK(!VIDestroy(&vi));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  const PetscReal cube[] = {1, 1, 1}, broad[] = {1.5, 1, 1}, tall[] = {1, 1.2, 5}, thin[] = {0.2, 1, 1.1};
  const PetscBool none[] = {PETSC_FALSE, PETSC_FALSE, PETSC_FALSE}, plane[] = {PETSC_TRUE, PETSC_TRUE, PETSC_FALSE},
                  line[] = {PETSC_TRUE, PETSC_FALSE, PETSC_FALSE};

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestStrands();
  TestBox(PETSC_FALSE, cube, none);
  TestBox(PETSC_TRUE, cube, none);
  TestBox(PETSC_FALSE, broad, none);
  TestBox(PETSC_FALSE, tall, plane);
  TestBox(PETSC_TRUE, tall, plane);
  TestBox(PETSC_FALSE, thin, line);
  TestBox(PETSC_TRUE, thin, line);
  PetscCall(PetscFinalize());
  return 0;
}
