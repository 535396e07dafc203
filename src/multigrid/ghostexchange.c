/* ghostexchange.c -- values of rows that other ranks own. */
#include "base/compat.h"
#include "multigrid/ghostexchange.h"

/* The exchange of ghosts that are known. */
static PetscErrorCode GhostExchangeConnect_Private(MPI_Comm comm, GhostExchange *ghosts)
{
  IS which;

  PetscFunctionBeginUser;
  PetscCall(VecCreateMPI(comm, ghosts->n, PETSC_DETERMINE, &ghosts->own));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, ghosts->num, &ghosts->theirs));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, ghosts->num, ghosts->ghost, PETSC_USE_POINTER, &which));
  PetscCall(VecScatterCreate(ghosts->own, which, ghosts->theirs, NULL, &ghosts->scatter));
  PetscCall(ISDestroy(&which));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GhostExchangeCreate(Mat A, PetscInt bs, GhostExchange *ghosts)
{
  PetscInt        end, num_columns;
  const PetscInt *columns;

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
  PetscCall(GhostExchangeConnect_Private(PetscObjectComm((PetscObject)A), ghosts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GhostExchangeCreateUnion(const GhostExchange *one, const GhostExchange *other, PetscInt bs,
                                        GhostExchange *ghosts)
{
  PetscInt num = one->num + other->num;

  PetscFunctionBeginUser;
  *ghosts = (GhostExchange){.begin = bs * one->begin, .n = bs * one->n};
  PetscCall(PetscMalloc1(bs * num, &ghosts->ghost));
  PetscCall(PetscArraycpy(ghosts->ghost, one->ghost, one->num));
  PetscCall(PetscArraycpy(&ghosts->ghost[one->num], other->ghost, other->num));
  PetscCall(PetscSortRemoveDupsInt(&num, ghosts->ghost));
  ghosts->num = bs * num;
  for (PetscInt i = ghosts->num - 1; i >= 0; i--) ghosts->ghost[i] = bs * ghosts->ghost[i / bs] + i % bs;
  PetscCall(GhostExchangeConnect_Private(PetscObjectComm((PetscObject)one->own), ghosts));
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
