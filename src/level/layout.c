/* layout.c -- Vecs and matrices in the layout of a level's nodes. */
#include "level/level.h"
#include "base/compat.h"
#include "base/csrmatrix.h"

PetscErrorCode LevelCreateVec(Level *level, PetscInt bs, Vec *v)
{
  const PetscInt ghosts = level->num_nodes - level->num_owned;

  PetscFunctionBeginUser;
  PetscCall(VecCreateGhostBlock(level->comm, bs, bs * level->num_owned, PETSC_DETERMINE, ghosts,
                                level->node_global + level->num_owned, v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelShareVec(Vec v, InsertMode mode)
{
  PetscFunctionBeginUser;
  if (mode != INSERT_VALUES) {
    PetscCall(VecGhostUpdateBegin(v, mode, SCATTER_REVERSE));
    PetscCall(VecGhostUpdateEnd(v, mode, SCATTER_REVERSE));
  }
  PetscCall(VecGhostUpdateBegin(v, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(v, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelCreateBlocks(Mat P, PetscInt bs, Mat *blocks)
{
  PetscInt     begin, end, rows, columns, first, last, *start, *column, count = 0;
  PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(P, &begin, &end));
  PetscCall(MatGetLocalSize(P, &rows, &columns));
  PetscCall(MatGetOwnershipRangeColumn(P, &first, &last));
  for (PetscInt row = begin; row < end; row++) {
    PetscInt num;

    PetscCall(MatGetRow(P, row, &num, NULL, NULL));
    count += bs * num;
    PetscCall(MatRestoreRow(P, row, &num, NULL, NULL));
  }
  PetscCall(PetscMalloc3(bs * rows + 1, &start, count, &column, count, &value));
  count    = 0;
  start[0] = 0;
  for (PetscInt row = begin; row < end; row++) {
    PetscInt           num;
    const PetscInt    *c;
    const PetscScalar *v;

    PetscCall(MatGetRow(P, row, &num, &c, &v));
    for (PetscInt k = 0; k < bs; k++) {
      for (PetscInt j = 0; j < num; j++) {
        column[count]  = bs * c[j] + k;
        value[count++] = v[j];
      }
      start[bs * (row - begin) + k + 1] = count;
    }
    PetscCall(MatRestoreRow(P, row, &num, &c, &v));
  }
  PetscCall(CSRMatrixCreate(PetscObjectComm((PetscObject)P),
                            &(CSRRows){bs, bs * rows, bs * columns, start, column, value}, blocks));
  PetscCall(PetscFree3(start, column, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}
