/* hangingnodes.c -- functions that are continuous at hanging nodes. */
#include "base/compat.h"
#include "level/level.h"

PetscBool LevelNodeHangs(const Level *level, PetscInt node)
{
  return (PetscBool)(level->hanging.start && level->hanging.start[node + 1] > level->hanging.start[node]);
}

/* v := S v or S'v */
static PetscErrorCode LevelMultiply_Private(Level *level, PetscInt bs, PetscBool transpose, Vec v)
{
  Mat S;
  Vec product;

  PetscFunctionBeginUser;
  if (!level->conforming) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatCreateMAIJ(level->conforming, bs, &S));
  PetscCall(VecDuplicate(v, &product));
  PetscCall(transpose ? MatMultTranspose(S, v, product) : MatMult(S, v, product));
  PetscCall(VecCopy(product, v));
  PetscCall(LevelShareVec(v, INSERT_VALUES));
  PetscCall(VecDestroy(&product));
  PetscCall(MatDestroy(&S));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelConform(Level *level, PetscInt bs, Vec v)
{
  PetscFunctionBeginUser;
  PetscCall(LevelMultiply_Private(level, bs, PETSC_FALSE, v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode LevelConformForces(Level *level, PetscInt bs, Vec v)
{
  PetscFunctionBeginUser;
  PetscCall(LevelMultiply_Private(level, bs, PETSC_TRUE, v));
  PetscFunctionReturn(PETSC_SUCCESS);
}
