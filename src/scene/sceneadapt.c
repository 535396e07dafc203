/* sceneadapt.c -- adaptive meshes: the error that is asked for, and what ends the search for it. */
#include "scene/sceneparts.h"

enum { MOST_MESHES = 100 }; /* as many levels as a mesh has room for */

/* A number that must lie between two others, ends excluded. */
static PetscErrorCode AdaptReadBetween_Private(const Option *option, PetscReal lower, PetscReal upper, PetscReal *value)
{
  PetscFunctionBeginUser;
  PetscCall(OptionGetReals(option, 1, value));
  if (!(*value > lower && *value < upper))
    PetscCall(OptionRaise(option, "give a number above %g and below %g", (double)lower, (double)upper));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What belongs to adaptive meshes is read only where there are some, so that it is told otherwise. */
PetscErrorCode SceneAdaptRead(Scene scene)
{
  SceneAdapt *adapt = &scene->adapt;
  Option      tolerance, marking, unknowns, meshes, study, steps;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-adapt", NULL, NULL, &tolerance));
  if (!tolerance.set) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionFind(scene, "-study", NULL, NULL, &study));
  if (study.set) PetscCall(OptionRaise(&tolerance, "a study has its own meshes; omit -study or -adapt"));
  PetscCall(OptionFind(scene, "-load_steps", NULL, NULL, &steps));
  if (steps.set) PetscCall(OptionRaise(&tolerance, "load steps keep one mesh; omit -load_steps or -adapt"));
  PetscCall(AdaptReadBetween_Private(&tolerance, 0, 1, &adapt->tolerance));
  PetscCall(OptionFind(scene, "-adapt_marking", NULL, NULL, &marking));
  PetscCall(OptionFind(scene, "-adapt_max_unknowns", NULL, NULL, &unknowns));
  PetscCall(OptionFind(scene, "-adapt_max_meshes", NULL, NULL, &meshes));
  PetscCall(AdaptReadBetween_Private(&marking, 0, 1, &adapt->marking));
  PetscCall(OptionGetReals(&unknowns, 1, &adapt->max_unknowns));
  if (!(adapt->max_unknowns >= 1)) PetscCall(OptionRaise(&unknowns, "give a number of at least 1"));
  PetscCall(OptionGetInts(&meshes, 1, 1, &adapt->max_meshes));
  if (adapt->max_meshes > MOST_MESHES) PetscCall(OptionRaise(&meshes, "give a number of at most %d", (int)MOST_MESHES));
  PetscFunctionReturn(PETSC_SUCCESS);
}
