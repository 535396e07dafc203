/* test_dealtrows.c -- rows that a rank works on, its own and others, against MatCreateSubMatrices(); any rank may own or want none. */
#include "base/compat.h"
#include "multigrid/dealtrows.h"
#include "test.h"

/* Every third number of this rank is left out, every fourth of all others is taken. [in] num - of this rank; [out] list - ascending */
static void CreateList(PetscInt num, PetscInt begin, PetscInt end, PetscBool none, IS *list)
{
  PetscInt count = 0, *number;

  CHECK(!PetscMalloc1(num, &number));
  for (PetscInt i = 0; i < num && !none; i++)
    if (i >= begin && i < end ? i % 3 : i % 4 == 1) number[count++] = i;
  CHECK(!ISCreateGeneral(PETSC_COMM_SELF, count, number, PETSC_OWN_POINTER, list));
}

/* [in] n - rows and columns of this rank; [in] none - whether this rank wants no row */
static void TestRows(const PetscInt n[2], PetscBool none)
{
  PetscInt  begin[2], end[2], num[2];
  PetscBool same;
  Mat       A, own, *expected;
  IS        rows, chosen, all;

  CHECK(!MatCreateAIJ(PETSC_COMM_WORLD, n[0], n[1], PETSC_DETERMINE, PETSC_DETERMINE, 9, NULL, 9, NULL, &A));
  CHECK(!MatSetType(A, MATMPIAIJ)); // on one process, too
  CHECK(!MatMPIAIJSetPreallocation(A, 9, NULL, 9, NULL));
  CHECK(!MatGetSize(A, &num[0], &num[1]));
  CHECK(!MatGetOwnershipRange(A, &begin[0], &end[0]));
  CHECK(!MatGetOwnershipRangeColumn(A, &begin[1], &end[1]));
  for (PetscInt i = begin[0]; i < end[0]; i++)
    for (PetscInt k = 0; k < i % 9; k++)
      CHECK(!MatSetValue(A, i, (11 * i + 17 * k * k) % num[1], PetscSinReal((PetscReal)(i + 100 * k)), INSERT_VALUES));
  CHECK(!MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  CHECK(!MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  CreateList(num[0], begin[0], end[0], none, &rows);
  CreateList(num[1], begin[1], end[1], PETSC_FALSE, &chosen);
  CHECK(!ISCreateStride(PETSC_COMM_SELF, num[1], 0, 1, &all));
  for (int k = 0; k < 2; k++) {
    CHECK(!DealtRowsCreate(A, rows, k ? NULL : chosen, &own));
    CHECK(!MatCreateSubMatrices(A, 1, &rows, k ? &all : &chosen, MAT_INITIAL_MATRIX, &expected));
    CHECK(!MatEqual(own, expected[0], &same));
    CHECK(same);
    CHECK(!MatDestroySubMatrices(1, &expected));
    CHECK(!MatDestroy(&own));
  }
  CHECK(!ISDestroy(&rows));
  CHECK(!ISDestroy(&chosen));
  CHECK(!ISDestroy(&all));
  CHECK(!MatDestroy(&A));
}

int main(int argc, char **argv)
{
  PetscMPIInt rank;

  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  TestRows((PetscInt[2]){60, 60}, PETSC_FALSE);
  TestRows((PetscInt[2]){60, 9}, (PetscBool)(rank == 1));
  TestRows((PetscInt[2]){rank == 1 ? 0 : 60, 5000}, PETSC_FALSE); // more columns than are remembered
  CHECK(!PetscFinalize());
  return 0;
}
