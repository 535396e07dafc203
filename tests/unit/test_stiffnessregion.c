/* test_stiffnessregion.c -- products that are restricted to a region, against all of the matrix. */
#include "base/compat.h"
#include "problem/stiffness.h"
#include <test.h>

enum { NODES = 24, WITHIN = 3 };

static const PetscReal FACTOR          = 0.75;
static const PetscReal ROUNDING        = 1e-13;            /* sums of at most 72 products below 1 */
static const PetscReal ROUNDING_SINGLE = 3 * NODES * 6e-8; /* of as many factors below 1 */

/* Nodes with their neighbours, and every fifth with all others. */
static PetscBool Couples(PetscInt i, PetscInt j)
{
  return (PetscBool)(PetscAbsInt(i - j) <= 1 || i % 5 == 0 || j % 5 == 0);
}

/* A number between -1 and 1 of an unordered pair, the same on all ranks. */
static PetscReal Entry(PetscInt i, PetscInt j)
{
  return PetscSinReal((PetscReal)(17 * PetscMin(i, j) + 5 * PetscMax(i, j) + 1));
}

/* Nodes that couple to few others: two within a rank's rows, one at the end. */
static PetscBool IsWithin(PetscInt node)
{
  static const PetscInt within[WITHIN] = {7, 8, NODES - 1};

  for (PetscInt k = 0; k < WITHIN; k++)
    if (within[k] == node) return PETSC_TRUE;
  return PETSC_FALSE;
}

static PetscErrorCode CreateMatrix(PetscInt bs, Mat *A)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(MatCreate(PETSC_COMM_WORLD, A));
  PetscCall(MatSetSizes(*A, PETSC_DECIDE, PETSC_DECIDE, bs * NODES, bs * NODES));
  PetscCall(MatSetBlockSize(*A, bs));
  PetscCall(MatSetType(*A, MATAIJ));
  PetscCall(MatSetUp(*A));
  PetscCall(MatSetOption(*A, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscCall(MatGetOwnershipRange(*A, &begin, &end));
  for (PetscInt i = begin; i < end; i++)
    for (PetscInt j = 0; j < bs * NODES; j++)
      if (Couples(i / bs, j / bs)) PetscCall(MatSetValue(*A, i, j, Entry(i, j), INSERT_VALUES));
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The blocks in rows that couple to the region, as a part of all. */
static PetscReal GetPart(void)
{
  PetscInt read = 0, all = 0;

  for (PetscInt i = 0; i < NODES; i++) {
    PetscBool meets = PETSC_FALSE;
    PetscInt  num   = 0;

    for (PetscInt j = 0; j < NODES; j++) {
      num += Couples(i, j);
      meets = (PetscBool)(meets || (Couples(i, j) && IsWithin(j)));
    }
    all += num;
    read += meets ? num : 0;
  }
  return (PetscReal)read / (PetscReal)all;
}

/* S x against FACTOR A x. [in] everywhere - compare all rows, not those of the region alone */
static PetscErrorCode Compare(Mat A, Mat S, PetscInt bs, Vec x, PetscBool everywhere, PetscReal tolerance)
{
  const PetscScalar *value, *right;
  PetscInt           begin, end;
  Vec                y, expected;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(x, &y));
  PetscCall(VecDuplicate(x, &expected));
  PetscCall(MatMult(A, x, expected));
  PetscCall(MatMult(S, x, y));
  PetscCall(VecGetOwnershipRange(x, &begin, &end));
  PetscCall(VecGetArrayRead(y, &value));
  PetscCall(VecGetArrayRead(expected, &right));
  for (PetscInt i = begin; i < end; i++) {
    if (!everywhere && !IsWithin(i / bs)) continue;
    CHECK_NEAR(PetscRealPart(value[i - begin]), FACTOR * PetscRealPart(right[i - begin]), tolerance);
  }
  PetscCall(VecRestoreArrayRead(expected, &right));
  PetscCall(VecRestoreArrayRead(y, &value));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&expected));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Any vector and one that is 0 outside of the region. */
static PetscErrorCode CreateVectors(Mat A, PetscInt bs, Vec *any, Vec *within, Vec *region)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(A, any, within));
  PetscCall(VecDuplicate(*any, region));
  PetscCall(VecGetOwnershipRange(*any, &begin, &end));
  for (PetscInt i = begin; i < end; i++) {
    const PetscScalar in = IsWithin(i / bs) ? 1 : 0;

    PetscCall(VecSetValue(*any, i, Entry(i, i), INSERT_VALUES));
    PetscCall(VecSetValue(*within, i, in * Entry(i, i), INSERT_VALUES));
    PetscCall(VecSetValue(*region, i, in, INSERT_VALUES));
  }
  for (PetscInt k = 0; k < 3; k++) {
    const Vec filled = k ? (k > 1 ? *region : *within) : *any;

    PetscCall(VecAssemblyBegin(filled));
    PetscCall(VecAssemblyEnd(filled));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode TestRestrict(PetscInt bs, PetscBool single)
{
  const PetscReal tolerance = single ? ROUNDING_SINGLE : ROUNDING;
  PetscReal       part;
  Mat             A, K, S;
  Vec             any, within, region;

  PetscFunctionBeginUser;
  PetscCall(CreateMatrix(bs, &A));
  PetscCall(CreateVectors(A, bs, &any, &within, &region));
  PetscCall(StiffnessCreateOfMatrix(A, &K));
  if (single)
    PetscCall(StiffnessCreateSingle(K, FACTOR, &S));
  else
    PetscCall(StiffnessCreateScaled(K, FACTOR, &S));
  PetscCall(StiffnessRestrict(S, region, &part));
  CHECK_NEAR(part, GetPart(), ROUNDING);
  PetscCall(Compare(A, S, bs, within, PETSC_TRUE, tolerance));
  PetscCall(Compare(A, S, bs, any, PETSC_FALSE, tolerance));
  PetscCall(StiffnessRestrict(S, NULL, &part)); // all of it again
  CHECK_NEAR(part, 1, 0);
  PetscCall(Compare(A, S, bs, any, PETSC_TRUE, tolerance));
  PetscCall(VecDestroy(&any));
  PetscCall(VecDestroy(&within));
  PetscCall(VecDestroy(&region));
  PetscCall(MatDestroy(&S));
  PetscCall(MatDestroy(&K));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (PetscInt bs = 2; bs <= SYMMETRIC_BLOCKS_MAX; bs++) {
    PetscCall(TestRestrict(bs, PETSC_FALSE));
    PetscCall(TestRestrict(bs, PETSC_TRUE));
  }
  PetscCall(PetscFinalize());
  return 0;
}
