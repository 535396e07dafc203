/* levelrefine.c -- the coarsest level, and its refinements. */
#include "base/compat.h"
#include "refinement/refinementimpl.h"
#include "side/normalerrors.h"

PetscErrorCode LevelCreateFromPlex(Scene scene, DM dm, const Curves *curves, Level *level)
{
  PetscFunctionBeginUser;
  PetscCall(LevelCreateTables(scene, dm, SceneMaxOrder(scene), level));
  PetscCall(DMRemoveLabel(dm, "material", NULL)); // refinement would copy it, for a quarter of its time
  PetscCall(LevelSetCoords(level, curves));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The cells' materials and bodies of a refined level, from where they come. */
static PetscErrorCode LevelFollowCellMaterials_Private(const Level *coarse, const Refinement *refinement, Level *fine)
{
  PetscInt begin, coarse_begin;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(coarse->dm, 0, &coarse_begin, NULL));
  PetscCall(DMPlexGetHeightStratum(fine->dm, 0, &begin, NULL));
  for (PetscInt c = 0; c < fine->num_cells; c++) {
    const PetscInt cell = RefinementGetSource(refinement, begin + c, NULL) - coarse_begin;

    fine->cell_material[c] = coarse->cell_material[cell];
    fine->cell_body[c]     = coarse->cell_body[cell];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Only the refinement knows the origin of each new point, so the prolongation is created here. */
PetscErrorCode LevelRefine(Level *coarse, const ArcSides *sides, Level *fine)
{
  Refinement refinement;
  DM         dm;

  PetscFunctionBeginUser;
  PetscCall(RefinementCreate(coarse->dm, &refinement, &dm));
  PetscCall(LevelBegin(coarse->scene, dm, fine));
  PetscCall(LevelFollowCellMaterials_Private(coarse, &refinement, fine));
  PetscCall(LevelSetNodes(fine, SceneMaxOrder(coarse->scene)));
  PetscCall(LevelCreateProlongation(coarse, &refinement, fine));
  PetscCall(LevelFollowCoords(coarse, sides, &refinement, fine));
  PetscCall(LevelFollowNormalErrors(coarse, fine));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}
