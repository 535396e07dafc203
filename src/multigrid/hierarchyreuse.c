/* hierarchyreuse.c -- levels that outlast a solve: the next one of the same inequality, by another method, finds them in its VI. */
#include "base/compat.h"
#include "multigrid/hierarchy.h"

static PetscErrorCode DestroyFn(void *ctx)
{
  Hierarchy hierarchy = ctx;

  PetscFunctionBeginUser;
  PetscCall(HierarchyDestroy(&hierarchy));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HierarchyKeep(VI vi, Hierarchy *hierarchy)
{
  PetscFunctionBeginUser;
  PetscCall(PetscContainerDestroy(&vi->levels));
  PetscCall(PetscContainerCreate(PetscObjectComm((PetscObject)vi->upper), &vi->levels));
  PetscCall(PetscContainerSetPointer(vi->levels, *hierarchy));
  PetscCall(PetscContainerSetUserDestroy(vi->levels, DestroyFn));
  *hierarchy = NULL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HierarchyTake(VI from, VI finest, Hierarchy *hierarchy)
{
  Grid *grid;

  PetscFunctionBeginUser;
  *hierarchy = NULL;
  if (!from->levels) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscContainerGetPointer(from->levels, (void **)hierarchy));
  PetscCall(PetscContainerSetUserDestroy(from->levels, NULL));
  PetscCall(PetscContainerDestroy(&from->levels));
  grid               = &(*hierarchy)->grid[(*hierarchy)->num - 1];
  grid->vi           = finest;
  grid->A            = finest->A;
  (*hierarchy)->work = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}
