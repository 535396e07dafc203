/* condensation.c -- T'KT, which differs from K next to the contact only.

   With T = 1 + E, T'KT = K + Z, Z = E'K + K E + E'K E = E'W + W'E, W = K (1 + E / 2). E has rows at the nodes
   of the nonmortar sides alone. Of W no other rows are needed, and Z is as small. Every rank works on its own
   of these rows. T has two factors, and this is done for one after the other: the second couples to the
   mortar side and has one row for a node in contact. With all rows of these nodes it would take four times as
   long. */
#include "base/compat.h"
#include "multigrid/fewrows.h"
#include "multigrid/transposedproduct.h"
#include "problem/condensation.h"

/* (1 + E)'(K + before)(1 + E) - K - before. Collective.
   [in] before - AIJ, or NULL; [out] Z - owned by the caller */
static PetscErrorCode CondensationMultiply_Private(Mat K, Mat before, const BasisFactor *factor, Mat *Z)
{
  PetscInt        num, begin, *number;
  const PetscInt *row;
  Mat             E, W, more, KE, left, right;

  PetscFunctionBeginUser;
  PetscCall(ISGetLocalSize(factor->rows, &num));
  PetscCall(ISGetIndices(factor->rows, &row));
  PetscCall(MatGetOwnershipRange(K, &begin, NULL));
  PetscCall(PetscMalloc1(num, &number));
  for (PetscInt i = 0; i < num; i++) number[i] = begin + row[i];
  PetscCall(ISRestoreIndices(factor->rows, &row));
  PetscCall(FewRowsCreate(1, &(RowList){.from = K, .num = num, .row = number}, &W));
  if (before) {
    PetscCall(FewRowsCreate(1, &(RowList){.from = before, .num = num, .row = number}, &more));
    PetscCall(MatAXPY(W, 1, more, DIFFERENT_NONZERO_PATTERN));
    PetscCall(MatDestroy(&more));
  }
  PetscCall(BasisFactorCreateSquare(factor, &E));
  PetscCall(MatMatMult(W, E, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &KE));
  PetscCall(MatDestroy(&E));
  PetscCall(MatAXPY(W, 0.5, KE, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&KE));
  PetscCall(MatGetOwnershipRange(W, &begin, NULL));
  for (PetscInt i = 0; i < num; i++) number[i] = begin + i;
  const RowList of_E = {.from = factor->few, .num = num, .row = number}, of_W = {.from = W, .num = num, .row = number};

  PetscCall(FewRowsCreate(2, (RowList[]){of_E, of_W}, &left));
  PetscCall(FewRowsCreate(2, (RowList[]){of_W, of_E}, &right));
  PetscCall(TransposedProductCreate(left, right, Z)); // both terms at once
  PetscCall(MatDestroy(&left));
  PetscCall(MatDestroy(&right));
  PetscCall(MatDestroy(&W));
  PetscCall(PetscFree(number));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CondensationCreate(Mat K, const BasisFactor factors[], Mat *Z)
{
  PetscInt rows;
  Mat      before;

  PetscFunctionBeginUser;
  PetscCall(CondensationMultiply_Private(K, NULL, &factors[0], Z));
  for (int f = 1; f < BASIS_FACTORS; f++) {
    PetscCall(MatGetSize(factors[f].few, &rows, NULL));
    if (!rows) continue;
    before = *Z;
    PetscCall(CondensationMultiply_Private(K, before, &factors[f], Z));
    PetscCall(MatAXPY(*Z, 1, before, DIFFERENT_NONZERO_PATTERN));
    PetscCall(MatDestroy(&before));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
