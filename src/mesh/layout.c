/* layout.c -- Vecs in the layout of a level's nodes. */
#include "mesh/meshimpl.h"
#include "base/compat.h"

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
