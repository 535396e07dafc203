/* fewrows.c -- see the header. */
#include "multigrid/fewrows.h"
#include "base/compat.h"
#include "base/csrmatrix.h"

PetscErrorCode FewRowsCreate(PetscInt num_lists, const RowList lists[], Mat *few)
{
  PetscInt    *start, *column, num = 0, n, count = 0;
  PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(lists[0].from, NULL, &n));
  for (PetscInt l = 0; l < num_lists; l++) num += lists[l].num;
  PetscCall(PetscMalloc1(num + 1, &start));
  start[0] = 0;
  for (int pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(PetscMalloc2(count, &column, count, &value));
    count = num = 0;
    for (PetscInt l = 0; l < num_lists; l++) {
      for (PetscInt i = 0; i < lists[l].num; i++) {
        PetscInt           size;
        const PetscInt    *c;
        const PetscScalar *v;

        PetscCall(MatGetRow(lists[l].from, lists[l].row[i], &size, &c, &v));
        if (pass) PetscCall(PetscArraycpy(&column[count], c, size));
        if (pass) PetscCall(PetscArraycpy(&value[count], v, size));
        start[++num] = count += size;
        PetscCall(MatRestoreRow(lists[l].from, lists[l].row[i], &size, &c, &v));
      }
    }
  }
  PetscCall(
      CSRMatrixCreate(PetscObjectComm((PetscObject)lists[0].from), &(CSRRows){1, num, n, start, column, value}, few));
  PetscCall(PetscFree(start));
  PetscCall(PetscFree2(column, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}
