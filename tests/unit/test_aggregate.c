/* test_aggregate.c -- smoothed aggregation of a chain of springs: motions that cost nothing stay such, and held unknowns where they are. */
#include "../../src/solve/aggregate.h"
#include "test.h"

enum { NUM = 40 };

/* Springs between neighbours, from which nothing holds the chain. */
static PetscErrorCode CreateChain(Mat *A)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, NUM, NUM, 3, NULL, 1, NULL, A));
  PetscCall(MatGetOwnershipRange(*A, &begin, &end));
  for (PetscInt i = begin; i < end; i++) {
    if (i) PetscCall(MatSetValue(*A, i, i - 1, -1, INSERT_VALUES));
    if (i + 1 < NUM) PetscCall(MatSetValue(*A, i, i + 1, -1, INSERT_VALUES));
    PetscCall(MatSetValue(*A, i, i, i && i + 1 < NUM ? 2 : 1, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* [in] held - unknown that may not move, -1 for none */
static PetscErrorCode TestChain(PetscInt held)
{
  static const PetscReal LARGEST = 2; /* eigenvalue of D^-1 A */
  Fabric                 fabric  = {.bs = 1, .num = 1, .stronger = 0.02}, coarse;
  PetscInt               begin, n, first, last;
  PetscScalar           *a;
  Mat                    P;
  Vec                    x, y;

  PetscFunctionBeginUser;
  PetscCall(CreateChain(&fabric.A));
  PetscCall(MatGetOwnershipRange(fabric.A, &begin, NULL));
  PetscCall(MatGetLocalSize(fabric.A, &n, NULL));
  PetscCall(PetscMalloc1(n, &fabric.motion));
  PetscCall(PetscCalloc1(n, &fabric.held));
  for (PetscInt i = 0; i < n; i++) {
    fabric.held[i]   = (PetscBool)(begin + i == held);
    fabric.motion[i] = fabric.held[i] ? 0 : 1;
  }
  PetscCall(FabricCoarsen(&fabric, LARGEST, &P, &coarse));
  PetscCall(MatCreateVecs(P, &x, &y));
  PetscCall(VecGetOwnershipRange(x, &first, &last));
  CHECK(last - first > 0 && last - first <= n / 2); // of three nodes each, or so
  PetscCall(VecGetArray(x, &a));
  for (PetscInt i = 0; i < last - first; i++) {
    CHECK(!coarse.held[i] && coarse.motion[i] > 0);
    a[i] = coarse.motion[i];
  }
  PetscCall(VecRestoreArray(x, &a));
  PetscCall(MatMult(P, x, y));
  PetscCall(VecGetArray(y, &a));
  for (PetscInt i = 0; i < n; i++) {
    const PetscInt away = held < 0 ? NUM : PetscAbsInt(begin + i - held);

    if (away == 0) CHECK(a[i] == 0);
    if (away > 1) CHECK_NEAR(PetscRealPart(a[i]), 1, 1e-14);
    if (away == 1)
      CHECK_NEAR(PetscRealPart(a[i]), 1 - 4.0 / 3 / LARGEST / 2, 1e-14); // one step of Jacobi's towards 1/2
  }
  PetscCall(VecRestoreArray(y, &a));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&y));
  PetscCall(MatDestroy(&P));
  PetscCall(MatDestroy(&fabric.A));
  PetscCall(FabricDestroy(&fabric));
  PetscCall(FabricDestroy(&coarse));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(TestChain(-1));
  PetscCall(TestChain(20));
  PetscCall(PetscFinalize());
  return 0;
}
