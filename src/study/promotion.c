/* promotion.c -- interpolation of a displacement to finer levels. */
#include "study/promotion.h"
#include "base/compat.h"

PetscErrorCode PromotionProlong(Mat P, Level *level, Vec u, Vec *v)
{
  Mat blocks;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, level->dim, v));
  PetscCall(MatCreateMAIJ(P, level->dim, &blocks));
  PetscCall(MatMult(blocks, u, *v));
  PetscCall(MatDestroy(&blocks));
  PetscCall(LevelShareVec(*v, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PromotionApply(Mesh mesh, PetscInt from, PetscInt to, Vec u, Vec *v)
{
  PetscFunctionBeginUser;
  PetscCall(PetscObjectReference((PetscObject)u));
  *v = u;
  for (PetscInt l = from + 1; l <= to; l++) {
    Level *level = &mesh->levels[l];
    Vec    fine;

    PetscCall(PromotionProlong(level->prolongation, level, *v, &fine));
    PetscCall(VecDestroy(v));
    *v = fine;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
