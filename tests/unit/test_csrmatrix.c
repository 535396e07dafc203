/* test_csrmatrix.c -- a matrix from compressed rows equals that of MatSetValues(), and rows are merged, on any number of ranks. */
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "test.h"

enum { OWN = 7, WIDTH = 4, BLOCK = 1 };

/* Row `row` has row % 4 entries, in descending columns: an empty one, too. */
static PetscInt Entries(PetscInt row)
{
  return row % WIDTH;
}

static PetscInt Column(PetscInt row, PetscInt k, PetscInt all)
{
  return (row + 3 * (WIDTH - k)) % all;
}

static void TestMergeRow(void)
{
  PetscInt    num = 6, column[6] = {9, 2, 9, 5, 2, 9};
  PetscScalar value[6] = {1, 2, 4, 8, 16, 32};

  CHECK(!CSRMatrixMergeRow(&num, column, value));
  CHECK(num == 3 && column[0] == 2 && column[1] == 5 && column[2] == 9);
  CHECK(value[0] == 18 && value[1] == 8 && value[2] == 37);
  num = 0;
  CHECK(!CSRMatrixMergeRow(&num, NULL, NULL));
  CHECK(num == 0);
}

int main(int argc, char **argv)
{
  PetscInt    start[OWN + 1] = {0}, column[OWN * WIDTH], first, all, num = 0;
  PetscScalar value[OWN * WIDTH];
  PetscMPIInt rank, size;
  Mat         A, expected;
  PetscReal   norm;

  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  TestMergeRow();
  first = rank * OWN;
  all   = size * OWN;
  for (int ones = 0; ones < 2; ++ones) {
    CHECK(!MatCreateAIJ(PETSC_COMM_WORLD, OWN, OWN, all, all, WIDTH, NULL, WIDTH, NULL, &expected));
    num = 0;
    for (PetscInt i = 0; i < OWN; ++i) {
      for (PetscInt k = 0; k < Entries(first + i); ++k) {
        column[num] = Column(first + i, k, all);
        value[num]  = ones ? 1 : 1 + (PetscReal)(first + i) + 0.1 * (PetscReal)k;
        CHECK(!MatSetValue(expected, first + i, column[num], value[num], INSERT_VALUES));
        ++num;
      }
      start[i + 1] = num;
    }
    CHECK(!MatAssemblyBegin(expected, MAT_FINAL_ASSEMBLY));
    CHECK(!MatAssemblyEnd(expected, MAT_FINAL_ASSEMBLY));
    CHECK(!CSRMatrixCreate(PETSC_COMM_WORLD, &(CSRRows){BLOCK, OWN, OWN, start, column, ones ? NULL : value}, &A));
    CHECK(!MatAXPY(expected, -1, A, DIFFERENT_NONZERO_PATTERN));
    CHECK(!MatNorm(expected, NORM_FROBENIUS, &norm));
    CHECK_NEAR(norm, 0, 0);
    CHECK(!MatNorm(A, NORM_FROBENIUS, &norm));
    CHECK(norm > 1);
    CHECK(!MatDestroy(&A));
    CHECK(!MatDestroy(&expected));
  }
  CHECK(!PetscFinalize());
  return 0;
}
