/* test_eigenvalue.c -- eigenvalues that steps of CG see, also where these break down. */
#include "base/compat.h"
#include <errno.h>
#include <malloc.h>
#include <string.h>
#include "multigrid/eigenvalue.h"
#include "test.h"

enum { N = 40 };

/* In place of the C library's: what is read before it is written is no number here, and PETSc loops for ever on that. */
int posix_memalign(void **memory, size_t alignment, size_t size)
{
  *memory = memalign(alignment, size);
  if (!*memory) return ENOMEM;
  memset(*memory, 0xff, size);
  return 0;
}

/* A = diag(a_0 .. a_N-1). [in] value - a_i as a function of i */
static PetscErrorCode CreateDiagonal(PetscReal (*value)(PetscInt), Mat *A)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, N, N, 1, NULL, 0, NULL, A));
  PetscCall(MatGetOwnershipRange(*A, &begin, &end));
  for (PetscInt i = begin; i < end; i++) PetscCall(MatSetValue(*A, i, i, (*value)(i), INSERT_VALUES));
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscReal One(PetscInt i)
{
  (void)i;
  return 1;
}

static PetscReal OneOrThree(PetscInt i)
{
  return i % 2 ? 3 : 1;
}

static PetscReal OneOrLess(PetscInt i)
{
  return i == 7 ? -1 : 1 + 0.1 * (PetscReal)i;
}

/* All is seen after as many steps as there are eigenvalues: no residual is left for the next one. A bound is a tenth above what is seen. */
static PetscErrorCode TestFew(void)
{
  PetscReal largest;
  Mat       A, S;

  PetscFunctionBeginUser;
  PetscCall(CreateDiagonal(One, &S));
  PetscCall(EigenvalueLargest(S, NULL, NULL, &largest));
  CHECK(PetscAbsReal(largest - 1.1) < 1e-14);
  PetscCall(CreateDiagonal(OneOrThree, &A));
  PetscCall(EigenvalueLargest(A, NULL, NULL, &largest)); // by its own diagonal
  CHECK(PetscAbsReal(largest - 1.1) < 1e-14);
  PetscCall(MatDestroy(&A));
  PetscCall(MatDestroy(&S));
  PetscFunctionReturn(0);
}

/* An iteration that meets an indefinite preconditioner counts a step that saw nothing. */
static PetscErrorCode TestBroken(void)
{
  PetscReal          largest = -7, smallest = -7;
  KSPConvergedReason reason;
  PetscBool          seen;
  Vec                b, x;
  Mat                A, B;
  KSP                ksp;
  PC                 pc;

  PetscFunctionBeginUser;
  PetscCall(CreateDiagonal(OneOrThree, &A));
  PetscCall(CreateDiagonal(OneOrLess, &B));
  PetscCall(MatCreateVecs(A, &x, &b));
  PetscCall(EigenvalueSeed(b));
  PetscCall(KSPCreate(PETSC_COMM_WORLD, &ksp));
  PetscCall(KSPSetType(ksp, KSPCG));
  PetscCall(KSPSetOperators(ksp, A, B));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCJACOBI));
  PetscCall(KSPSetComputeSingularValues(ksp, PETSC_TRUE));
  PetscCall(KSPSetTolerances(ksp, 1e-12, PETSC_DEFAULT, PETSC_DEFAULT, N));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  CHECK(reason == KSP_DIVERGED_INDEFINITE_PC || reason == KSP_DIVERGED_INDEFINITE_MAT);
  PetscCall(EigenvalueGetRitz(ksp, &largest, &smallest, &seen));
  CHECK(!seen && largest == -7 && smallest == -7);
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&b));
  PetscCall(VecDestroy(&x));
  PetscCall(MatDestroy(&A));
  PetscCall(MatDestroy(&B));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(TestFew());
  PetscCall(TestBroken());
  PetscCall(PetscFinalize());
  return 0;
}
