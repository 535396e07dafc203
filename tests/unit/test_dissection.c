/* test_dissection.c -- the pivot order of solids: every unknown once, those of the Schur complement last.
   Also the factors that MUMPS makes with it, or with an order of its own. */
#include "base/compat.h"
#include "pdas/factorization.h"
#include "test.h"

enum { SIDE = 9, DOFS = 3, NUM = SIDE * SIDE * SIDE * DOFS };

/* A matrix like that of SIDE^3 nodes of hexahedra: every node with its 27 neighbours, diagonally dominant. */
static Mat Cube(void)
{
  Mat      A;
  PetscInt begin, end, own = PETSC_DECIDE, nodes = NUM / DOFS;

  CHECK(!PetscSplitOwnership(PETSC_COMM_WORLD, &own, &nodes));
  CHECK(!MatCreateAIJ(PETSC_COMM_WORLD, own * DOFS, own * DOFS, NUM, NUM, 81, NULL, 81, NULL, &A));
  CHECK(!MatSetBlockSize(A, DOFS));
  CHECK(!MatGetOwnershipRange(A, &begin, &end));
  for (PetscInt row = begin; row < end; ++row) {
    const PetscInt node = row / DOFS, place[3] = {node % SIDE, node / SIDE % SIDE, node / SIDE / SIDE};

    for (PetscInt n = 0; n < 27 * DOFS; ++n) {
      const PetscInt k = n / DOFS, x = place[0] + k % 3 - 1, y = place[1] + k / 3 % 3 - 1, z = place[2] + k / 9 - 1;
      const PetscInt column = ((z * SIDE + y) * SIDE + x) * DOFS + n % DOFS;

      if (PetscMin(PetscMin(x, y), z) < 0 || PetscMax(PetscMax(x, y), z) >= SIDE) continue;
      CHECK(!MatSetValue(A, row, column, row == column ? 60 : -0.5 - 0.1 * ((row + column) % 3), INSERT_VALUES));
    }
  }
  CHECK(!MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  CHECK(!MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  return A;
}

static void TestOrder(Mat A, PetscInt num, const PetscInt C[])
{
  PetscInt   *position, *at;
  PetscMPIInt rank;

  CHECK(!PetscMalloc2(NUM, &position, NUM, &at));
  CHECK(!DissectionOrder(A, num, C, position));
  CHECK(!MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  for (PetscInt i = 0; i < NUM; ++i) at[i] = -1;
  for (PetscInt i = 0; i < NUM && !rank; ++i) {
    CHECK(position[i] >= 1 && position[i] <= NUM);
    CHECK(at[position[i] - 1] == -1);
    at[position[i] - 1] = i;
  }
  for (PetscInt i = 0; i < num && !rank; ++i) CHECK(position[C[i]] == NUM - num + i + 1);
  CHECK(!PetscFree2(position, at));
}

/* x_I = A_II^-1 b_I and 0 on C; S e = A_CC e + A_CI x for x = -A_II^-1 A_IC e. */
static void TestFactors(Mat A, PetscInt num, const PetscInt C[])
{
  PetscScalar   *S, *all;
  PetscReal      residual = 0;
  PetscMPIInt    rank;
  MatFactorError error;
  VecScatter     scatter;
  Factorization  factor;
  Vec            e, x, r, host;

  CHECK(!MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  CHECK(!PetscMalloc1(num * num, &S));
  CHECK(!FactorizationCreate(A, num, C, NULL, rank ? NULL : S, &factor, &error));
  CHECK(!error);
  CHECK(!MatCreateVecs(A, &e, &x));
  CHECK(!VecDuplicate(e, &r));
  CHECK(!VecZeroEntries(e));
  if (!rank) CHECK(!VecSetValue(e, C[1], 1, INSERT_VALUES));
  CHECK(!VecAssemblyBegin(e));
  CHECK(!VecAssemblyEnd(e));
  CHECK(!MatMult(A, e, r));
  CHECK(!VecScale(r, -1));
  CHECK(!FactorizationSolve(factor, r, x));
  CHECK(!VecAXPY(x, 1, e));
  CHECK(!MatMult(A, x, r)); // 0 on I, the second column of S on C
  CHECK(!VecScatterCreateToZero(r, &scatter, &host));
  CHECK(!VecScatterBegin(scatter, r, host, INSERT_VALUES, SCATTER_FORWARD));
  CHECK(!VecScatterEnd(scatter, r, host, INSERT_VALUES, SCATTER_FORWARD));
  CHECK(!VecGetArray(host, &all));
  for (PetscInt j = 0; j < num && !rank; ++j) { // MUMPS gives one triangle
    const PetscReal s = PetscMax(PetscAbsReal(S[num + j]), PetscAbsReal(S[j * num + 1]));

    CHECK_NEAR(PetscAbsReal(all[C[j]]), s, 1e-12);
    all[C[j]] = 0;
  }
  for (PetscInt i = 0; i < NUM && !rank; ++i) residual = PetscMax(residual, PetscAbsReal(all[i]));
  CHECK_NEAR(residual, 0, 1e-12);
  CHECK(!VecRestoreArray(host, &all));
  CHECK(!VecScatterDestroy(&scatter));
  CHECK(!VecDestroy(&host));
  CHECK(!VecDestroy(&r));
  CHECK(!VecDestroy(&x));
  CHECK(!VecDestroy(&e));
  CHECK(!FactorizationDestroy(&factor));
  CHECK(!PetscFree(S));
}

int main(int argc, char **argv)
{
  PetscInt C[SIDE * SIDE];
  Mat      A;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  A = Cube();
  for (PetscInt i = 0; i < SIDE * SIDE; ++i) C[i] = (i + SIDE * SIDE * (SIDE / 2)) * DOFS + 2; // a plane inside
  TestOrder(A, SIDE * SIDE, C);
  TestFactors(A, SIDE * SIDE, C);
  CHECK(!PetscOptionsSetValue(NULL, "-mat_mumps_icntl_7", "0"));
  TestFactors(A, SIDE * SIDE, C);
  CHECK(!MatDestroy(&A));
  PetscCall(PetscFinalize());
  return 0;
}
