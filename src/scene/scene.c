/* scene.c -- the life of a scene: created empty, filled from the options, destroyed. */
#include "scene/sceneparts.h"
#include "base/options.h"
#include "base/warning.h"
#include "gmsh/gmsh.h"
#include "gmsh/hdf5mesh.h"
#include <string.h>

PetscErrorCode SceneCreate(MPI_Comm comm, Scene *scene)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(scene));
  (*scene)->comm = comm;
  (*scene)->dim  = 2;
  (*scene)->time = 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Highest dimension of the elements in a Gmsh file, or in one that was converted; 0 if it is another file or
   cannot be read. [out] reason - why it cannot, "" if nothing is known [OPTION_MAX] */
static PetscErrorCode SceneProbeFile_Private(const Option *file, PetscInt *dim, char reason[])
{
  const char *extension = strrchr(file->text, '.');
  char        path[PETSC_MAX_PATH_LEN];
  PetscBool   exists, converted, gmsh = (PetscBool)(extension && !strncmp(extension, ".msh", strlen(".msh")));
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  *dim      = 0;
  reason[0] = '\0';
  if (!gmsh && (!extension || strcmp(extension, ".h5"))) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionsFindFile(file->comm, file->text, path, sizeof(path), &exists));
  if (!exists) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCallMPI(MPI_Comm_rank(file->comm, &rank));
  if (!rank && gmsh) PetscCall(GmshGetDimension(path, dim, reason, OPTION_MAX));
  if (!rank && !gmsh) PetscCall(HDF5MeshProbe(path, &converted, dim));
  PetscCallMPI(MPI_Bcast(reason, OPTION_MAX, MPI_CHAR, 0, file->comm));
  PetscCallMPI(MPI_Bcast(dim, 1, MPIU_INT, 0, file->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The option that gives a body's mesh, and its dimension: 0 (unknown), 2 or 3.
   [out] reason - as of SceneProbeFile_Private() */
static PetscErrorCode BodyGetDimension_Private(Scene scene, const SceneBody *body, Option *mesh, PetscInt *dim,
                                               char reason[])
{
  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-<body>_dm_plex_box_faces", body->name, NULL, mesh));
  *dim = OptionCountItems(mesh);
  if (!mesh->set) {
    PetscCall(OptionFind(scene, "-<body>_dm_plex_filename", body->name, NULL, mesh));
    if (mesh->set) PetscCall(SceneProbeFile_Private(mesh, dim, reason));
  }
  if (*dim != 2 && *dim != 3) *dim = 0; /* a mistake, reported with the body or its mesh */
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Says that a body has another dimension than the model that the user gave. */
static PetscErrorCode SceneRaiseModel_Private(const Option *model, const SceneBody *body, const Option *mesh,
                                              PetscInt dim)
{
  PetscFunctionBeginUser;
  if (strstr(mesh->entry->name, "filename"))
    PetscCall(OptionRaise(mesh, "the cells of body %s have dimension %d, -model %s has %d; %s", body->name, (int)dim,
                          model->text, dim == 3 ? 2 : 3,
                          dim == 3 ? "-model solid takes solids"
                                   : "gmsh -3 makes solids, and writes those in a physical volume where there are "
                                     "physical groups"));
  PetscCall(OptionRaise(mesh, "%s",
                        dim == 2 ? "-model solid has three dimensions; give three numbers"
                                 : "three numbers make a solid; give two, or -model solid"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Prepares the message for data of a solid in a plane scene. The scene is plane because a mesh file could not
   be read or has no solids. */
static PetscErrorCode SceneSetUnread_Private(Scene scene, const Option *file, PetscInt dim, const char reason[])
{
  char text[2 * OPTION_MAX + PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  if (!strstr(file->entry->name, "filename")) PetscFunctionReturn(PETSC_SUCCESS);
  if (dim)
    PetscCall(PetscSNPrintf(text, sizeof(text),
                            "%s %s: this file has no solids; gmsh -3 makes them, and writes those in a physical volume "
                            "where there are physical groups",
                            file->name, file->text));
  else
    PetscCall(PetscSNPrintf(text, sizeof(text), "%s %s: no cells are found in this file%s%s", file->name, file->text,
                            reason[0] ? ": " : "",
                            reason[0] ? reason : "; one that is not of Gmsh (2.2, 4.1) needs -model solid"));
  PetscCall(PetscStrallocpy(text, &scene->unread));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The model determines the dimension. Where it is not given, boxes and Gmsh files determine it, and must
   agree. */
static PetscErrorCode SceneReadModel_Private(Scene scene)
{
  Option   model, mesh, first = {.set = PETSC_FALSE}, unread = {.set = PETSC_FALSE};
  PetscInt choice = MODEL_PLANE_STRAIN, num, dim = 0;
  char     reason[OPTION_MAX] = "", why[OPTION_MAX] = "";

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-model", NULL, NULL, &model));
  PetscCall(OptionGetChoice(&model, &choice));
  if (model.set) dim = choice == MODEL_SOLID ? 3 : 2;
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    PetscCall(BodyGetDimension_Private(scene, &scene->bodies[b], &mesh, &num, reason));
    if (!num && mesh.set && !unread.set) {
      unread = mesh;
      PetscCall(PetscStrncpy(why, reason, sizeof(why)));
    }
    if (!num) continue;
    if (!dim) {
      dim   = num;
      first = mesh;
    }
    if (num == dim) continue;
    if (!first.set) PetscCall(SceneRaiseModel_Private(&model, &scene->bodies[b], &mesh, num));
    PetscCall(OptionRaise(
        &mesh, "all bodies of a scene have the same dimensions, two or three; this one has %d, that of %s %s has %d",
        (int)num, first.name, first.text, (int)dim));
  }
  if (!dim && unread.set) PetscCall(SceneSetUnread_Private(scene, &unread, 0, why));
  if (dim == 2 && first.set) PetscCall(SceneSetUnread_Private(scene, &first, dim, ""));
  scene->dim   = dim == 3 ? 3 : 2;
  scene->model = dim == 3 ? MODEL_SOLID : (ModelKind)choice;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The solver reads -ksp_type and -pc_type; the mesh needs to know only whether coarser levels are of use. */
static PetscErrorCode SceneReadLevels_Private(Scene scene)
{
  Option   ksp, pc, stop;
  PetscInt choice = STOP_RESIDUAL;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-stop", NULL, NULL, &stop));
  PetscCall(OptionGetChoice(&stop, &choice));
  scene->stop = (SceneStop)choice;
  if (scene->stop == STOP_DISCRETISATION) scene->levels = LEVELS_USED;
  PetscCall(OptionFind(scene, "-ksp_type", NULL, NULL, &ksp));
  PetscCall(OptionFind(scene, "-pc_type", NULL, NULL, &pc));
  if (pc.set)
    scene->levels = strcmp(pc.text, "truncatedmg") ? LEVELS_UNUSED : LEVELS_USED;
  else if (ksp.set)
    scene->levels = strcmp(ksp.text, "preonly") ? LEVELS_USED : LEVELS_UNUSED;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads the options of the whole scene. */
static PetscErrorCode SceneReadGlobal_Private(Scene scene)
{
  Option   title, thickness, refine, order;
  PetscInt number = 0;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-title", NULL, NULL, &title));
  PetscCall(OptionFind(scene, "-thickness", NULL, NULL, &thickness));
  PetscCall(OptionFind(scene, "-dm_refine", NULL, NULL, &refine));
  PetscCall(OptionFind(scene, "-order", NULL, NULL, &order));
  PetscCall(PetscStrallocpy(title.set ? title.text : "", &scene->title));
  PetscCall(SceneUnitsRead(scene));
  PetscCall(SceneReadModel_Private(scene));
  if (scene->model == MODEL_AXISYMMETRIC && thickness.set)
    PetscCall(OptionRaise(&thickness, "an axisymmetric model is a whole ring and has no thickness; omit the option"));
  if (scene->model == MODEL_SOLID && thickness.set)
    PetscCall(OptionRaise(&thickness, "a solid has no thickness; omit the option"));
  PetscCall(OptionGetReals(&thickness, 1, &scene->thickness));
  if (!(scene->thickness > 0)) PetscCall(OptionRaise(&thickness, "a thickness must be above 0"));
  PetscCall(OptionGetInts(&refine, 1, 0, &scene->refine));
  PetscCall(SceneReadLevels_Private(scene));
  PetscCall(OptionGetChoice(&order, &number));
  if (!order.set && scene->adapt.on) number = 1; // the same accuracy takes fewer unknowns
  for (PetscInt i = 0; i < scene->num_bodies; i++) scene->bodies[i].order = number + 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* User errors: options that adaptive meshes with friction do not have. */
static PetscErrorCode SceneCheckAdaptiveFriction_Private(Scene scene)
{
  PetscFunctionBeginUser;
  if (!scene->adapt.on || !SceneHasFriction(scene)) PetscFunctionReturn(PETSC_SUCCESS);
  if (scene->adapt.num_goals)
    PetscCall(
        UserErrorRaise(scene->comm, "-adapt_goal: not with friction; omit it, and -adapt refines for the energy norm"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warnings: options that one file gives two values. */
static PetscErrorCode SceneWarnRepeated_Private(void)
{
  const char *const *sentences;
  const int          num = OptionsGetRepeated(&sentences);

  PetscFunctionBeginUser;
  for (int i = 0; i < num; i++)
    PetscCall(WarningAdd(&(Warning){.code = "repeated_option", .advice = "delete one"}, "%s", sentences[i]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneSetFromOptions(Scene scene)
{
  Option allow;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-options_allow_unused", NULL, NULL, &allow));
  PetscCall(OptionGetBool(&allow, &scene->allow_unused));
  PetscCall(SceneWarningsRead(scene));
  PetscCall(SceneWarnRepeated_Private());
  PetscCall(SceneNamesRead(scene));
  if (!scene->allow_unused)
    PetscCall(UnusedOptionsCheckUnknown(scene, PETSC_FALSE)); /* before the options that misspelt ones leave missing */
  PetscCall(SceneAdaptRead(scene));
  PetscCall(SceneReadGlobal_Private(scene));
  PetscCall(SceneStudyRead(scene));
  PetscCall(SceneStepsRead(scene));
  for (PetscInt i = 0; i < scene->num_bodies; i++) PetscCall(SceneBodyRead(scene, &scene->bodies[i]));
  PetscCall(SceneStudySetOrders(scene));
  for (PetscInt i = 0; i < scene->num_pairs; i++) PetscCall(ScenePairRead(scene, &scene->pairs[i]));
  PetscCall(SceneCheckAdaptiveFriction_Private(scene));
  for (PetscInt i = 0; i < scene->num_probes; i++) PetscCall(SceneProbeRead(scene, &scene->probes[i]));
  for (PetscInt i = 0; i < scene->num_paths; i++) PetscCall(ScenePathRead(scene, &scene->paths[i]));
  PetscCall(SceneAdaptCheck(scene));
  PetscCall(SceneResultsRead(scene));
  PetscCall(SceneRestartRead(scene));
  PetscCall(SceneHalvedRead(scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneDestroy(Scene *scene)
{
  PetscFunctionBeginUser;
  if (!*scene) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt i = 0; i < (*scene)->num_bodies; i++) PetscCall(SceneBodyDestroy(&(*scene)->bodies[i]));
  for (PetscInt i = 0; i < (*scene)->num_pairs; i++) PetscCall(ScenePairDestroy(&(*scene)->pairs[i]));
  for (PetscInt i = 0; i < (*scene)->num_probes; i++) PetscCall(PetscFree((*scene)->probes[i].name));
  for (PetscInt i = 0; i < (*scene)->num_paths; i++) PetscCall(PetscFree((*scene)->paths[i].name));
  PetscCall(PetscFree((*scene)->steps.t));
  PetscCall(PetscFree((*scene)->steps.restart));
  PetscCall(PetscFree((*scene)->steps.past));
  PetscCall(SceneAdaptDestroy(&(*scene)->adapt));
  for (PetscInt i = 0; i < (*scene)->num_regions; i++) {
    PetscCall(SceneMaterialDestroy(&(*scene)->regions[i].material));
    PetscCall(PetscFree((*scene)->regions[i].group));
    PetscCall(PetscFree((*scene)->regions[i].prefix));
  }
  PetscCall(PetscFree((*scene)->bodies));
  PetscCall(PetscFree((*scene)->regions));
  PetscCall(PetscFree((*scene)->pairs));
  PetscCall(PetscFree((*scene)->probes));
  PetscCall(PetscFree((*scene)->paths));
  PetscCall(PetscFree((*scene)->title));
  for (PetscInt i = 0; i < 4; i++) PetscCall(PetscFree((*scene)->units[i]));
  PetscCall(PetscFree((*scene)->unread));
  PetscCall(PetscFree((*scene)->output));
  PetscCall(PetscFree((*scene)->summary));
  PetscCall(PetscFree(*scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}
