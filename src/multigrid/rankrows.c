/* rankrows.c -- rows of own unknowns and of ghosts, in one numbering. */
#include "base/compat.h"
#include "multigrid/rankrows.h"

/* Own unknowns and ghosts, ascending. rows->at becomes the position of each among own unknowns, then
   ghosts. */
static PetscErrorCode RankRowsColumns_Private(RankRows *rows, IS *columns)
{
  const GhostExchange *ghosts = rows->ghosts;
  const PetscInt       bs = rows->bs, num = bs * (ghosts->n + ghosts->num);
  PetscInt            *global, below = 0, count = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, &global));
  PetscCall(PetscMalloc1(num, &rows->at));
  while (below < ghosts->num && ghosts->ghost[below] < ghosts->begin) below++;
  for (PetscInt i = -below; i < ghosts->n + ghosts->num - below; i++) {
    const PetscBool own   = (PetscBool)(i >= 0 && i < ghosts->n);
    const PetscInt  ghost = i < 0 ? i + below : i - ghosts->n + below;

    for (PetscInt k = 0; k < bs; k++) {
      global[count]     = bs * (own ? ghosts->begin + i : ghosts->ghost[ghost]) + k;
      rows->at[count++] = bs * (own ? i : ghosts->n + ghost) + k;
    }
  }
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, global, PETSC_OWN_POINTER, columns));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RankRowsCreate(Mat A, PetscInt bs, const GhostExchange *ghosts, RankRows *rows)
{
  PetscMPIInt size;
  PetscInt   *global;
  IS          which, columns;
  Mat        *theirs, whole;

  PetscFunctionBeginUser;
  *rows = (RankRows){.A = A, .bs = bs, .ghosts = ghosts};
  if (!A) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscObjectReference((PetscObject)A));
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)A), &size));
  if (size == 1) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(bs * ghosts->num, &global));
  for (PetscInt i = 0; i < bs * ghosts->num; i++) global[i] = bs * ghosts->ghost[i / bs] + i % bs;
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, bs * ghosts->num, global, PETSC_OWN_POINTER, &which));
  PetscCall(RankRowsColumns_Private(rows, &columns));
  PetscCall(MatConvert(A, MATAIJ, MAT_INITIAL_MATRIX, &whole));
  PetscCall(MatCreateSubMatrices(whole, 1, &which, &columns, MAT_INITIAL_MATRIX, &theirs));
  PetscCall(MatDestroy(&whole));
  rows->theirs = theirs[0];
  PetscCall(PetscObjectReference((PetscObject)rows->theirs));
  PetscCall(MatDestroySubMatrices(1, &theirs));
  PetscCall(ISDestroy(&which));
  PetscCall(ISDestroy(&columns));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RankRowsDestroy(RankRows *rows)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&rows->A));
  PetscCall(MatDestroy(&rows->theirs));
  PetscCall(PetscFree(rows->at));
  PetscCall(PetscFree(rows->column));
  PetscCall(PetscFree(rows->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Position of a global column, -1 if it is no ghost. */
static PetscErrorCode RankRowsFind_Private(const RankRows *rows, PetscInt column, PetscInt *at)
{
  const GhostExchange *ghosts = rows->ghosts;
  const PetscInt       bs = rows->bs, node = column / bs;

  PetscFunctionBeginUser;
  *at = column - bs * ghosts->begin;
  if (node >= ghosts->begin && node < ghosts->begin + ghosts->n) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscFindInt(node, ghosts->num, ghosts->ghost, at));
  *at = *at < 0 ? -1 : bs * (ghosts->n + *at) + column % bs;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RankRowsGet(RankRows *rows, PetscInt row, PetscInt *num, const PetscInt **column,
                           const PetscScalar **value)
{
  const PetscInt     mine = rows->bs * rows->ghosts->n;
  const PetscBool    own  = (PetscBool)(row < mine);
  const PetscInt    *columns;
  const PetscScalar *values;
  const Mat          A    = own ? rows->A : rows->theirs;
  const PetscInt     here = own ? rows->bs * rows->ghosts->begin + row : row - mine;
  PetscInt           length, at;

  PetscFunctionBeginUser;
  *num = 0;
  if (!A) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatGetRow(A, here, &length, &columns, &values));
  if (length > rows->max) {
    rows->max = 2 * length;
    PetscCall(PetscRealloc((size_t)rows->max * sizeof(PetscInt), &rows->column));
    PetscCall(PetscRealloc((size_t)rows->max * sizeof(PetscScalar), &rows->value));
  }
  for (PetscInt j = 0; j < length; j++) {
    at = columns[j];
    if (own)
      PetscCall(RankRowsFind_Private(rows, columns[j], &at));
    else
      at = rows->at[columns[j]];
    if (at < 0) continue;
    rows->column[*num]    = at;
    rows->value[(*num)++] = values[j];
  }
  PetscCall(MatRestoreRow(A, here, &length, &columns, &values));
  *column = rows->column;
  *value  = rows->value;
  PetscFunctionReturn(PETSC_SUCCESS);
}
