/* test_residual.c -- b - A y where all but the last digits cancel. */
#include "base/compat.h"
#include "pdas/pdasimpl.h"
#include "test.h"

enum { SIZE = 60, THREES = 5, ENTRIES = 3 * THREES };

/* Row i is  2^40 at i, 1 + 2^-40 at i + 1, -2^40 at i + 2,  and so on five times;  y is 1 + 2^-40 everywhere. Then
   5 (1 + 2^-40)^2 = 5 (1 + 2^-39 + 2^-80) is left. b cancels all of it but the last term, which is smaller than
   the rounding of any of the products. A row has four times three entries, which are summed side by side, and
   three more. */
int main(int argc, char **argv)
{
  const PetscReal    large = PetscPowReal(2, 40), small = PetscPowReal(2, -40), left = -THREES * PetscPowReal(2, -80);
  Mat                A;
  Vec                y, b, r;
  PetscInt           begin, end;
  const PetscScalar *a;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, SIZE, SIZE, ENTRIES, NULL, ENTRIES, NULL, &A));
  PetscCall(MatGetOwnershipRange(A, &begin, &end));
  for (PetscInt i = begin; i < end; i++) {
    const PetscScalar three[] = {large, 1 + small, -large};

    for (PetscInt k = 0; k < ENTRIES; k++) PetscCall(MatSetValue(A, i, (i + k) % SIZE, three[k % 3], INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatCreateVecs(A, &y, &b));
  PetscCall(VecDuplicate(b, &r));
  PetscCall(VecSet(y, 1 + small));
  PetscCall(VecSet(b, THREES * (1 + 2 * small)));
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
