/* mesh.c -- see the header. */
#include "base/compat.h"
#include "level/leveltables.h"
#include "mesh/bodycurves.h"
#include "mesh/mesh.h"
#include "mesh/meshforest.h"

PetscErrorCode MeshCreate(Scene scene, Mesh *mesh)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(mesh));
  (*mesh)->scene = scene;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshClear(Mesh mesh)
{
  PetscFunctionBeginUser;
  PetscCall(MeshForestDestroy(&mesh->forest));
  for (PetscInt l = 0; l < mesh->num_levels; l++) PetscCall(LevelDestroy(&mesh->levels[l]));
  PetscCall(MeshShapeDestroy(&mesh->shape));
  PetscCall(PetscFree(mesh->levels));
  mesh->num_levels = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

Level *MeshFinest(Mesh mesh)
{
  return &mesh->levels[mesh->num_levels - 1];
}

PetscErrorCode MeshDestroy(Mesh *mesh)
{
  PetscFunctionBeginUser;
  if (!*mesh) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MeshClear(*mesh));
  PetscCall(PetscFree(*mesh));
  PetscFunctionReturn(PETSC_SUCCESS);
}
