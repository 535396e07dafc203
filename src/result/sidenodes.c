/* sidenodes.c -- the rank that reports each node of a side. */
#include "base/compat.h"
#include "result/sidenodes.h"

/* 1 at the nodes of the facets of all ranks, 0 elsewhere. */
static PetscErrorCode SideNodesMark_Private(Level *level, const Facets *facets, Vec *marks)
{
  Vec        local;
  PetscReal *mark;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, marks));
  PetscCall(VecGhostGetLocalForm(*marks, &local));
  PetscCall(VecSet(local, 0.0));
  PetscCall(VecGetArray(local, &mark));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      mark[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]] = 1.0;
    }
  }
  PetscCall(VecRestoreArray(local, &mark));
  PetscCall(VecGhostRestoreLocalForm(*marks, &local));
  PetscCall(LevelShareVec(*marks, MAX_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SideNodesCreate(Level *level, const Facets *facets, PetscInt *num, PetscInt **nodes)
{
  Vec              marks;
  const PetscReal *mark;
  PetscInt         n = 0;

  PetscFunctionBeginUser;
  PetscCall(SideNodesMark_Private(level, facets, &marks));
  PetscCall(VecGetArrayRead(marks, &mark));
  for (PetscInt a = 0; a < level->num_owned; a++) n += mark[a] != 0.0;
  PetscCall(PetscMalloc1(n, nodes));
  *num = 0;
  for (PetscInt a = 0; a < level->num_owned; a++) {
    if (mark[a] != 0.0) (*nodes)[(*num)++] = a;
  }
  PetscCall(VecRestoreArrayRead(marks, &mark));
  PetscCall(VecDestroy(&marks));
  PetscFunctionReturn(PETSC_SUCCESS);
}
