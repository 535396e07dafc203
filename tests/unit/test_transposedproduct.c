/* test_transposedproduct.c -- L'R of sparse matrices, against the product of dense ones; any rank may own nothing. */
#include "base/compat.h"
#include "multigrid/galerkin.h"
#include "multigrid/transposedproduct.h"
#include "test.h"

/* Few entries, of which some are 0 and some rows have none. [in] rows, columns - of this rank */
static void CreateSparse(PetscInt rows, PetscInt columns, PetscInt bs, PetscInt seed, Mat *A)
{
  PetscInt begin, end, n;

  CHECK(!MatCreateAIJ(PETSC_COMM_WORLD, rows, columns, PETSC_DETERMINE, PETSC_DETERMINE, 4, NULL, 4, NULL, A));
  CHECK(!MatSetBlockSizes(*A, 1, bs));
  CHECK(!MatGetOwnershipRange(*A, &begin, &end));
  CHECK(!MatGetSize(*A, NULL, &n));
  for (PetscInt i = begin; i < end; i++) {
    for (PetscInt k = 0; k < 4 && n > 0 && i % 5 != 2; k++)
      CHECK(!MatSetValue(*A, i, (i * (7 + seed) + 13 * k * k) % n,
                         PetscSinReal((PetscReal)(i + seed * k)) * (PetscReal)(k % 3), ADD_VALUES));
  }
  CHECK(!MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  CHECK(!MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
}

/* A x, or A'x, of each rank's own dense copy would be the same sum: here products with vectors, for every unit vector of the columns. */
static void CheckProduct(Mat L, Mat R, Mat product)
{
  PetscInt  n, num[2], begin, end;
  PetscReal off;
  Vec       x, y, z, along;

  CHECK(!MatGetSize(product, &num[0], &num[1]));
  CHECK(!MatGetSize(L, NULL, &n));
  CHECK(num[0] == n);
  CHECK(!MatGetSize(R, NULL, &n));
  CHECK(num[1] == n);
  CHECK(!MatCreateVecs(product, &x, &y));
  CHECK(!VecDuplicate(y, &z));
  CHECK(!MatCreateVecs(R, NULL, &along));
  for (PetscInt j = 0; j < n; j++) {
    CHECK(!VecZeroEntries(x));
    CHECK(!VecGetOwnershipRange(x, &begin, &end));
    if (j >= begin && j < end) CHECK(!VecSetValue(x, j, 1, INSERT_VALUES));
    CHECK(!VecAssemblyBegin(x));
    CHECK(!VecAssemblyEnd(x));
    CHECK(!MatMult(product, x, y));
    CHECK(!MatMult(R, x, along));
    CHECK(!MatMultTranspose(L, along, z));
    CHECK(!VecAXPY(z, -1, y));
    CHECK(!VecNorm(z, NORM_INFINITY, &off));
    CHECK_NEAR(off, 0, 1e-14);
  }
  CHECK(!VecDestroy(&x));
  CHECK(!VecDestroy(&y));
  CHECK(!VecDestroy(&z));
  CHECK(!VecDestroy(&along));
}

/* [in] rows, left, right - of this rank: rows of both matrices, columns of each */
static void TestProduct(PetscInt rows, PetscInt left, PetscInt right)
{
  PetscInt bs[2];
  Mat      L, R, product;

  CreateSparse(rows, left, 2, 1, &L);
  CreateSparse(rows, right, 3, 4, &R);
  CHECK(!TransposedProductCreate(L, R, &product));
  CHECK(!MatGetBlockSizes(product, &bs[0], &bs[1]));
  CHECK(bs[0] == 2 && bs[1] == 3);
  CheckProduct(L, R, product);
  CHECK(!MatDestroy(&product));
  CHECK(!MatDestroy(&L));
  CHECK(!MatDestroy(&R));
}

/* P'A P */
static void TestGalerkin(PetscInt rows, PetscInt columns)
{
  Mat A, P, AP, product;

  CreateSparse(rows, rows, 1, 2, &A);
  CreateSparse(rows, columns, 1, 3, &P);
  CHECK(!GalerkinProduct(A, P, &product));
  CHECK(!MatMatMult(A, P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &AP));
  CheckProduct(P, AP, product);
  CHECK(!MatDestroy(&AP));
  CHECK(!MatDestroy(&product));
  CHECK(!MatDestroy(&A));
  CHECK(!MatDestroy(&P));
}

int main(int argc, char **argv)
{
  PetscMPIInt rank;

  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  TestProduct(40, 12, 18);
  TestProduct(rank == 1 ? 0 : 40, 12, 18);
  TestProduct(40, rank == 1 ? 0 : 12, rank == 0 ? 18 : 0);
  TestProduct(0, 12, 18); // no entries at all
  TestGalerkin(50, 15);
  TestGalerkin(rank == 2 ? 0 : 50, 15);
  CHECK(!PetscFinalize());
  return 0;
}
