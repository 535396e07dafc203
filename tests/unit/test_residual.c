/* test_residual.c -- b - A y where all but the last digits cancel. */
#include "base/compat.h"
#include "pdas/pdasimpl.h"
#include "test.h"

enum { SIZE = 60 };

/* Row i is  2^40 at i, 1 + 2^-40 at i + 1, -2^40 at i + 2;  y is 1 + 2^-40 everywhere. Then (1 + 2^-40)^2 = 1
   + 2^-39 + 2^-80 is the product that is left. b cancels all of it but the last term, which is smaller than
   the rounding of any of the three. */
int main(int argc, char **argv)
{
  const PetscReal    large = PetscPowReal(2, 40), small = PetscPowReal(2, -40), left = -PetscPowReal(2, -80);
  Mat                A;
  Vec                y, b, r;
  PetscInt           begin, end;
  const PetscScalar *a;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, SIZE, SIZE, 3, NULL, 3, NULL, &A));
  PetscCall(MatGetOwnershipRange(A, &begin, &end));
  for (PetscInt i = begin; i < end; i++) {
    const PetscInt    columns[] = {i, (i + 1) % SIZE, (i + 2) % SIZE};
    const PetscScalar row[]     = {large, 1 + small, -large};

    PetscCall(MatSetValues(A, 1, &i, 3, columns, row, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatCreateVecs(A, &y, &b));
  PetscCall(VecDuplicate(b, &r));
  PetscCall(VecSet(y, 1 + small));
  PetscCall(VecSet(b, 1 + 2 * small));
  PetscCall(CompensatedResidual(A, b, y, r));
  PetscCall(VecGetArrayRead(r, &a));
  for (PetscInt i = 0; i < end - begin; i++) CHECK(a[i] == left);
  PetscCall(VecRestoreArrayRead(r, &a));
  PetscCall(MatMult(A, y, r));
  PetscCall(VecAYPX(r, -1, b));
  PetscCall(VecGetArrayRead(r, &a));
  for (PetscInt i = 0; i < end - begin; i++) CHECK(a[i] != left); // or this test would show nothing
  PetscCall(VecRestoreArrayRead(r, &a));
  PetscCall(MatDestroy(&A));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&b));
  PetscCall(VecDestroy(&r));
  PetscCall(PetscFinalize());
  return 0;
}
