/* ghosted.c -- the values of a ghosted Vec with those of ghosts. */
#include "level/ghosted.h"
#include "base/compat.h"

PetscErrorCode GhostedGetArray(Vec v, PetscScalar **values)
{
  Vec local;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(v, &local));
  PetscCall(VecGetArray(local, values));
  PetscCall(VecGhostRestoreLocalForm(v, &local)); // v keeps it
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GhostedGetArrayRead(Vec v, const PetscScalar **values)
{
  Vec local;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(v, &local));
  PetscCall(VecGetArrayRead(local, values));
  PetscCall(VecGhostRestoreLocalForm(v, &local)); // v keeps it
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GhostedRestoreArray(Vec v, PetscScalar **values)
{
  Vec local;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(v, &local));
  PetscCall(VecRestoreArray(local, values));
  PetscCall(VecGhostRestoreLocalForm(v, &local)); // v keeps it
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GhostedRestoreArrayRead(Vec v, const PetscScalar **values)
{
  Vec local;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(v, &local));
  PetscCall(VecRestoreArrayRead(local, values));
  PetscCall(VecGhostRestoreLocalForm(v, &local)); // v keeps it
  PetscFunctionReturn(PETSC_SUCCESS);
}
