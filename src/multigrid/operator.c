/* operator.c -- the matrices and masks of one level. */
#include "base/compat.h"
#include "multigrid/operator.h"

PetscErrorCode OperatorCreateOfMatrix(Mat A, PetscInt num_fixed, PetscInt fixed[], Operator *op)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 3; i++) PetscCall(PetscObjectReference((PetscObject)A));
  *op = (Operator){.A = A, .K = A, .S = A, .stiffness = 1, .num_fixed = num_fixed, .fixed = fixed};
  PetscCall(MatCreateVecs(A, &op->diagonal, NULL));
  PetscCall(MatGetDiagonal(A, op->diagonal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OperatorDestroy(Operator *op)
{
  PetscFunctionBeginUser;
  PetscCall(OperatorSetInequality(op, NULL, NULL, NULL, NULL));
  PetscCall(MatDestroy(&op->K));
  PetscCall(VecDestroy(&op->diagonal));
  PetscCall(MatDestroy(&op->S));
  PetscCall(MatDestroy(&op->T));
  PetscCall(BasisRowsDestroy(&op->inverse));
  PetscCall(MatDestroy(&op->Z));
  PetscCall(MatDestroy(&op->waves));
  PetscCall(PetscFree(op->fixed));
  PetscCall(PetscFree(op->constrained));
  PetscCall(PetscFree(op->tight));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OperatorSetInequality(Operator *op, Mat A, Vec b, Vec upper, Vec W)
{
  PetscFunctionBeginUser;
  PetscCall(PetscObjectReference((PetscObject)A));
  PetscCall(PetscObjectReference((PetscObject)b));
  PetscCall(PetscObjectReference((PetscObject)upper));
  PetscCall(PetscObjectReference((PetscObject)W));
  PetscCall(MatDestroy(&op->A));
  PetscCall(VecDestroy(&op->b));
  PetscCall(VecDestroy(&op->upper));
  PetscCall(VecDestroy(&op->W));
  op->A     = A;
  op->b     = b;
  op->upper = upper;
  op->W     = W;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OperatorCreateFree(const Operator *op, Vec *free)
{
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(op->diagonal, free));
  PetscCall(VecSet(*free, 1));
  PetscCall(VecGetArray(*free, &a));
  for (PetscInt i = 0; i < op->num_fixed; i++) a[op->fixed[i]] = 0;
  PetscCall(VecRestoreArray(*free, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OperatorMarkFixedDisplacements(const Operator *op, PetscBool marked[])
{
  PetscInt begin;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(op->K, &begin, NULL));
  for (PetscInt i = 0; i < op->num_fixed; i++) {
    const PetscInt  row = begin + op->fixed[i];
    PetscInt        num = 1, column = row;
    const PetscInt *columns;

    if (op->T) {
      PetscCall(MatGetRow(op->T, row, &num, &columns, NULL));
      column = num == 1 ? columns[0] : -1;
      PetscCall(MatRestoreRow(op->T, row, &num, &columns, NULL));
    }
    if (column == row) marked[op->fixed[i]] = PETSC_TRUE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
