/* test_redundant.c -- the redundant factorization solves, on every rank and on one of each group of ranks; any rank may own nothing. */
#include "base/compat.h"
#include "multigrid/redundantsolve.h"
#include "test.h"

/* Analyses of matrices so far on this rank. */
static int Analyses(void)
{
  PetscLogEvent      event;
  PetscEventPerfInfo info;

  CHECK(!PetscLogEventGetId("MatCholFctrSym", &event));
  CHECK(!PetscLogEventGetPerfInfo(0, event, &info));
  return info.count;
}

/* A chain of springs between walls: row i is 2.5 x_i - x_{i-1} - x_{i+1}. [in] n - rows; empty - whether the second rank has none */
static void TestChain(PetscInt n, PetscBool empty)
{
  PetscMPIInt rank, size;
  const int   before = Analyses();
  PetscInt    begin, end, local = PETSC_DECIDE;
  PetscReal   off;
  Mat         A;
  Vec         x, b, y;
  PC          pc;

  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  if (empty && size > 1) local = rank == 0 ? n : 0;
  CHECK(!MatCreateAIJ(PETSC_COMM_WORLD, local, local, n, n, 3, NULL, 2, NULL, &A));
  CHECK(!MatGetOwnershipRange(A, &begin, &end));
  for (PetscInt i = begin; i < end; ++i) {
    CHECK(!MatSetValue(A, i, i, 2.5, INSERT_VALUES));
    if (i > 0) CHECK(!MatSetValue(A, i, i - 1, -1, INSERT_VALUES));
    if (i < n - 1) CHECK(!MatSetValue(A, i, i + 1, -1, INSERT_VALUES));
  }
  CHECK(!MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  CHECK(!MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  CHECK(!MatSetOption(A, MAT_SPD, PETSC_TRUE));
  CHECK(!MatCreateVecs(A, &x, &b));
  CHECK(!VecDuplicate(x, &y));
  for (PetscInt i = begin; i < end; ++i) CHECK(!VecSetValue(x, i, PetscSinReal((PetscReal)i), INSERT_VALUES));
  CHECK(!VecAssemblyBegin(x));
  CHECK(!VecAssemblyEnd(x));
  CHECK(!PCCreate(PETSC_COMM_WORLD, &pc));
  CHECK(!PCSetOperators(pc, A, A));
  CHECK(!RedundantSolveSetPC(pc));
  for (PetscInt pass = 0; pass < 3; ++pass) { // with another matrix once more
    /* Once gathered, it is not sent a second time. */
    if (pass == 1) CHECK(!RedundantSolveGather(pc));
    if (pass == 1) CHECK(!MatShift(A, 1));
    CHECK(!PCSetUp(pc));
    if (pass == 1 && size > 1) CHECK(!MatShift(A, -1));
    CHECK(!MatMult(A, x, b));
    CHECK(!PCApply(pc, b, y));
    CHECK(!VecAXPY(y, -1, x));
    CHECK(!VecNorm(y, NORM_INFINITY, &off));
    CHECK(off < 1e-13);
    CHECK(!MatShift(A, 1));
  }
  CHECK(Analyses() <= before + 1); // its nonzeros stay where they are
  CHECK(!PCDestroy(&pc));
  CHECK(!VecDestroy(&x));
  CHECK(!VecDestroy(&y));
  CHECK(!VecDestroy(&b));
  CHECK(!MatDestroy(&A));
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!PetscLogDefaultBegin());
  for (int empty = 0; empty < 2; ++empty) {
    TestChain(100, (PetscBool)empty);
    TestChain(4500, (PetscBool)empty);
  }
  CHECK(!PetscFinalize());
  return 0;
}
