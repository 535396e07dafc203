/* ghostexchange.c -- values of rows that other ranks own. */
#include "base/compat.h"
#include "multigrid/ghostexchange.h"

PetscErrorCode GhostExchangeCreate(Mat A, PetscInt bs, GhostExchange *ghosts)
{
  PetscInt        end, num_columns;
  const PetscInt *columns;
  IS              which;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(A, &ghosts->begin, &end));
  PetscCall(MatGetGhosts(A, &num_columns, &columns));
  ghosts->begin /= bs;
  ghosts->n   = end / bs - ghosts->begin;
  ghosts->num = 0;
  PetscCall(PetscMalloc1(num_columns, &ghosts->ghost));
  for (PetscInt i = 0; i < num_columns; i++)
    if (!ghosts->num || ghosts->ghost[ghosts->num - 1] != columns[i] / bs)
      ghosts->ghost[ghosts->num++] = columns[i] / bs;
  PetscCall(VecCreateMPI(PetscObjectComm((PetscObject)A), ghosts->n, PETSC_DETERMINE, &ghosts->own));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, ghosts->num, &ghosts->theirs));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, ghosts->num, ghosts->ghost, PETSC_USE_POINTER, &which));
  PetscCall(VecScatterCreate(ghosts->own, which, ghosts->theirs, NULL, &ghosts->scatter));
  PetscCall(ISDestroy(&which));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GhostExchangeDestroy(GhostExchange *ghosts)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(ghosts->ghost));
  PetscCall(VecDestroy(&ghosts->own));
  PetscCall(VecDestroy(&ghosts->theirs));
  PetscCall(VecScatterDestroy(&ghosts->scatter));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GhostExchangeUpdate(GhostExchange *ghosts, PetscReal values[])
{
  PetscScalar       *own;
  const PetscScalar *theirs;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayWrite(ghosts->own, &own));
  for (PetscInt i = 0; i < ghosts->n; i++) own[i] = values[i];
  PetscCall(VecRestoreArrayWrite(ghosts->own, &own));
  PetscCall(VecScatterBegin(ghosts->scatter, ghosts->own, ghosts->theirs, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(ghosts->scatter, ghosts->own, ghosts->theirs, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(ghosts->theirs, &theirs));
  for (PetscInt i = 0; i < ghosts->num; i++) values[ghosts->n + i] = PetscRealPart(theirs[i]);
  PetscCall(VecRestoreArrayRead(ghosts->theirs, &theirs));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GhostExchangeFind(const GhostExchange *ghosts, PetscInt row, PetscInt *at)
{
  PetscFunctionBeginUser;
  *at = row - ghosts->begin;
  if (*at < 0 || *at >= ghosts->n) {
    PetscCall(PetscFindInt(row, ghosts->num, ghosts->ghost, at));
    *at += ghosts->n;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
