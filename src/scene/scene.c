/* scene.c -- the life of a scene: created empty, filled from the options, destroyed. */
#include "parts.h"

PetscErrorCode SceneCreate(MPI_Comm comm, Scene *scene)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(scene));
  (*scene)->comm = comm;
  (*scene)->dim  = 2;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What holds for the whole scene. */
static PetscErrorCode SceneReadGlobal_Private(Scene scene)
{
  Option   title, model, thickness, refine, order;
  PetscInt choice = MODEL_PLANE_STRAIN, number = 0;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-title", NULL, NULL, &title));
  PetscCall(OptionFind(scene, "-model", NULL, NULL, &model));
  PetscCall(OptionFind(scene, "-thickness", NULL, NULL, &thickness));
  PetscCall(OptionFind(scene, "-dm_refine", NULL, NULL, &refine));
  PetscCall(OptionFind(scene, "-order", NULL, NULL, &order));
  PetscCall(PetscStrallocpy(title.set ? title.text : "", &scene->title));
  PetscCall(OptionGetChoice(&model, &choice));
  scene->model = (ModelKind)choice;
  if (scene->model == MODEL_SOLID) {
    PetscCall(OptionRaise(&model, "this version solves plane_strain, plane_stress and axisymmetric only"));
  }
  if (scene->model == MODEL_AXISYMMETRIC && thickness.set)
    PetscCall(OptionRaise(&thickness, "an axisymmetric model is a whole ring, it has no thickness; leave this out"));
  PetscCall(OptionGetReals(&thickness, 1, &scene->thickness));
  if (!(scene->thickness > 0)) PetscCall(OptionRaise(&thickness, "a thickness must be above 0"));
  PetscCall(OptionGetInts(&refine, 1, 0, &scene->refine));
  PetscCall(OptionGetChoice(&order, &number));
  for (PetscInt i = 0; i < scene->num_bodies; i++) scene->bodies[i].order = number + 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneSetFromOptions(Scene scene)
{
  Option allow;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-options_allow_unused", NULL, NULL, &allow));
  PetscCall(OptionGetBool(&allow, &scene->allow_unused));
  PetscCall(NamesRead(scene));
  if (!scene->allow_unused)
    PetscCall(UnusedCheckUnknown(scene, PETSC_FALSE)); /* before the options that misspelt ones leave missing */
  PetscCall(SceneReadGlobal_Private(scene));
  PetscCall(StudyRead(scene));
  for (PetscInt i = 0; i < scene->num_bodies; i++) PetscCall(BodyRead(scene, &scene->bodies[i]));
  PetscCall(StudySettleOrders(scene));
  for (PetscInt i = 0; i < scene->num_pairs; i++) PetscCall(PairRead(scene, &scene->pairs[i]));
  for (PetscInt i = 0; i < scene->num_probes; i++) PetscCall(ProbeRead(scene, &scene->probes[i]));
  PetscCall(ResultsRead(scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneDestroy(Scene *scene)
{
  PetscFunctionBeginUser;
  if (!*scene) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt i = 0; i < (*scene)->num_bodies; i++) PetscCall(BodyDestroy(&(*scene)->bodies[i]));
  for (PetscInt i = 0; i < (*scene)->num_pairs; i++) PetscCall(PairDescriptionDestroy(&(*scene)->pairs[i]));
  for (PetscInt i = 0; i < (*scene)->num_probes; i++) PetscCall(PetscFree((*scene)->probes[i].name));
  PetscCall(PetscFree((*scene)->bodies));
  PetscCall(PetscFree((*scene)->pairs));
  PetscCall(PetscFree((*scene)->probes));
  PetscCall(PetscFree((*scene)->title));
  PetscCall(PetscFree((*scene)->output));
  PetscCall(PetscFree((*scene)->summary));
  PetscCall(PetscFree(*scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}
