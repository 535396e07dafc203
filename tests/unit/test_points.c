/* test_points.c -- coarser levels of a lattice of nodes: fewer nodes, linear functions, and what is held stays where it is. */
#include "multigrid/nodecoarsening.h"
#include "test.h"

enum { SIDE = 12, DIM = 2, NODES = SIDE * SIDE };

/* Nodes coupled to the eight around them. */
static PetscErrorCode CreateLattice(Mat *A)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(MatCreate(PETSC_COMM_WORLD, A));
  PetscCall(MatSetSizes(*A, PETSC_DECIDE, PETSC_DECIDE, DIM * NODES, DIM * NODES));
  PetscCall(MatSetBlockSize(*A, DIM));
  PetscCall(MatSetType(*A, MATAIJ));
  PetscCall(MatSetUp(*A));
  PetscCall(MatGetOwnershipRange(*A, &begin, &end));
  for (PetscInt row = begin; row < end; row++) {
    const PetscInt i = row / DIM % SIDE, j = row / DIM / SIDE;
    PetscInt       num = 0;

    for (PetscInt k = 0; k < 9; k++) {
      const PetscInt p = i + k % 3 - 1, q = j + k / 3 - 1;

      if (k == 4 || p < 0 || p >= SIDE || q < 0 || q >= SIDE) continue;
      PetscCall(MatSetValue(*A, row, DIM * (q * SIDE + p) + row % DIM, -1, INSERT_VALUES));
      num++;
    }
    PetscCall(MatSetValue(*A, row, row, num, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscReal Linear(const PetscReal x[], PetscInt k)
{
  return 1 + 2 * k + (3 - k) * x[0] + (k - 4) * x[1];
}

/* [in] held - whether the first component of the nodes at the bottom is */
static PetscErrorCode TestLattice(PetscBool held)
{
  NodeSet      points = {.dim = DIM}, coarse;
  PetscInt     begin, n, num;
  PetscScalar *a;
  Mat          P;
  Vec          x, y;

  PetscFunctionBeginUser;
  PetscCall(CreateLattice(&points.A));
  PetscCall(MatGetOwnershipRange(points.A, &begin, NULL));
  PetscCall(MatGetLocalSize(points.A, &n, NULL));
  PetscCall(PetscMalloc1(n, &points.x));
  PetscCall(PetscCalloc1(n, &points.fixed));
  for (PetscInt i = 0; i < n; i++) {
    const PetscInt node = (begin + i) / DIM;

    points.x[i]     = (PetscReal)(i % DIM ? node / SIDE : node % SIDE);
    points.fixed[i] = (PetscBool)(held && node < SIDE && i % DIM == 0);
  }
  PetscCall(NodeCoarseningApply(&points, &P, &coarse));
  PetscCall(MatGetLocalSize(P, NULL, &num));
  CHECK(num > 0 && num <= n / 2);
  PetscCall(MatCreateVecs(P, &x, &y));
  PetscCall(VecGetArray(x, &a));
  for (PetscInt i = 0; i < num; i++) {
    const PetscReal *at = &coarse.x[i / DIM * DIM];

    CHECK(coarse.fixed[i] == (PetscBool)(held && at[1] == 0 && i % DIM == 0));
    a[i] = held ? at[1] : Linear(at, i % DIM);
  }
  PetscCall(VecRestoreArray(x, &a));
  PetscCall(MatMult(P, x, y)); // what is held is 0, as that function there is
  PetscCall(VecGetArray(y, &a));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal *at = &points.x[i / DIM * DIM];

    CHECK_NEAR(PetscRealPart(a[i]), held ? at[1] : Linear(at, i % DIM), 1e-12);
  }
  PetscCall(VecRestoreArray(y, &a));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&y));
  PetscCall(MatDestroy(&P));
  PetscCall(MatDestroy(&points.A));
  PetscCall(NodeCoarseningDestroy(&points));
  PetscCall(NodeCoarseningDestroy(&coarse));
  PetscFunctionReturn(0);
}

/* Where the weights of interpolation are known, nodes have these: every other column of the lattice takes
   from both of its neighbours. */
static PetscErrorCode TestKnown(void)
{
  NodeSet      points = {.dim = DIM}, coarse;
  PetscInt     begin, n, num, chosen = 0;
  PetscScalar *a;
  Mat          P;
  Vec          x, y;

  PetscFunctionBeginUser;
  PetscCall(CreateLattice(&points.A));
  PetscCall(MatGetOwnershipRange(points.A, &begin, NULL));
  PetscCall(MatGetLocalSize(points.A, &n, NULL));
  PetscCall(PetscCalloc1(n, &points.x));
  PetscCall(PetscCalloc1(n, &points.fixed));
  n /= DIM;
  PetscCall(PetscMalloc3(n, &points.count, n * NODE_TERMS, &points.from, n * NODE_TERMS, &points.weight));
  for (PetscInt i = 0; i < n; i++) {
    const PetscInt  node = begin / DIM + i, column = node % SIDE;
    const PetscBool own = (PetscBool)(column % 2 == 0 || column == SIDE - 1);

    chosen += own;
    points.count[i] = own ? 1 : 2;
    for (PetscInt j = 0; j < points.count[i]; j++) {
      points.from[i * NODE_TERMS + j]   = own ? node : node - 1 + 2 * j;
      points.weight[i * NODE_TERMS + j] = own ? 1 : 0.25 + 0.5 * j;
    }
    points.x[i * DIM] = column;
  }
  PetscCall(NodeCoarseningApply(&points, &P, &coarse));
  PetscCall(MatGetLocalSize(P, NULL, &num));
  CHECK(num == DIM * chosen && !coarse.count);
  PetscCall(MatCreateVecs(P, &x, &y));
  PetscCall(VecGetArray(x, &a));
  for (PetscInt i = 0; i < num; i++) a[i] = coarse.x[i / DIM * DIM];
  PetscCall(VecRestoreArray(x, &a));
  PetscCall(MatMult(P, x, y));
  PetscCall(VecGetArray(y, &a));
  for (PetscInt i = 0; i < n; i++)
    CHECK_NEAR(PetscRealPart(a[i * DIM]), points.x[i * DIM] + (points.count[i] == 2 ? 0.5 : 0), 1e-12);
  PetscCall(VecRestoreArray(y, &a));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&y));
  PetscCall(MatDestroy(&P));
  PetscCall(MatDestroy(&points.A));
  PetscCall(NodeCoarseningDestroy(&points));
  PetscCall(NodeCoarseningDestroy(&coarse));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(TestLattice(PETSC_FALSE));
  PetscCall(TestLattice(PETSC_TRUE));
  PetscCall(TestKnown());
  PetscCall(PetscFinalize());
  return 0;
}
