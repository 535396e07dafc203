/* ghostexchange.c -- values of rows that other ranks own. */
#include "base/compat.h"
#include "multigrid/ghostexchange.h"

PetscErrorCode HaloCreate(Mat A, PetscInt bs, Halo *halo)
{
  PetscInt        end, num_columns;
  const PetscInt *columns;
  IS              which;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(A, &halo->begin, &end));
  PetscCall(MatGetGhosts(A, &num_columns, &columns));
  halo->begin /= bs;
  halo->n   = end / bs - halo->begin;
  halo->num = 0;
  PetscCall(PetscMalloc1(num_columns, &halo->ghost));
  for (PetscInt i = 0; i < num_columns; i++)
    if (!halo->num || halo->ghost[halo->num - 1] != columns[i] / bs) halo->ghost[halo->num++] = columns[i] / bs;
  PetscCall(VecCreateMPI(PetscObjectComm((PetscObject)A), halo->n, PETSC_DETERMINE, &halo->own));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, halo->num, &halo->theirs));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, halo->num, halo->ghost, PETSC_USE_POINTER, &which));
  PetscCall(VecScatterCreate(halo->own, which, halo->theirs, NULL, &halo->scatter));
  PetscCall(ISDestroy(&which));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HaloDestroy(Halo *halo)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(halo->ghost));
  PetscCall(VecDestroy(&halo->own));
  PetscCall(VecDestroy(&halo->theirs));
  PetscCall(VecScatterDestroy(&halo->scatter));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HaloShare(Halo *halo, PetscReal values[])
{
  PetscScalar       *own;
  const PetscScalar *theirs;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayWrite(halo->own, &own));
  for (PetscInt i = 0; i < halo->n; i++) own[i] = values[i];
  PetscCall(VecRestoreArrayWrite(halo->own, &own));
  PetscCall(VecScatterBegin(halo->scatter, halo->own, halo->theirs, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(halo->scatter, halo->own, halo->theirs, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(halo->theirs, &theirs));
  for (PetscInt i = 0; i < halo->num; i++) values[halo->n + i] = PetscRealPart(theirs[i]);
  PetscCall(VecRestoreArrayRead(halo->theirs, &theirs));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HaloFind(const Halo *halo, PetscInt row, PetscInt *at)
{
  PetscFunctionBeginUser;
  *at = row - halo->begin;
  if (*at < 0 || *at >= halo->n) {
    PetscCall(PetscFindInt(row, halo->num, halo->ghost, at));
    *at += halo->n;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
