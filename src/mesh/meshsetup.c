/* meshsetup.c -- a mesh: lists of bodies, merged, partitioned, refined level by level.

   Boxes and files of many cells are made, read and partitioned by all ranks. Other meshes are made on the
   first rank alone: so readers, user errors and warnings need no communication. The coarsest mesh is
   distributed, and each rank refines its part: all ranks share the work and the memory of refinement. */
#include "base/compat.h"
#include "base/usererror.h"
#include "base/warning.h"
#include "bodies/bodyfile.h"
#include "bodies/bodylist.h"
#include "bodies/bodymerge.h"
#include "bodies/box.h"
#include "mesh/boxcoarsening.h"
#include "bodies/meshfile.h"
#include "bodies/unjoinedpieces.h"
#include "level/leveltables.h"
#include "mesh/bodycurves.h"
#include "mesh/bodyoverlap.h"
#include "mesh/boxparts.h"
#include "mesh/fileparts.h"
#include "mesh/mesh.h"
#include "mesh/meshforest.h"
#include "mesh/mortarchoice.h"
#include "partition/partition.h"
#include "refinement/levelrefine.h"

/* Whether the cells of a file can be numbered on the finest mesh, as those of boxes can. [in] list - of the
   coarsest mesh; [out] sentence - untouched if so */
static void MeshCheckSize_Private(const struct _n_Scene *scene, PetscInt coarser, const SceneBody *body,
                                  const BodyList *list, char sentence[])
{
  const PetscInt  refine = coarser + scene->refine + (scene->study.kind == STUDY_UNIFORM ? scene->study.levels - 1 : 0);
  const PetscInt  unknowns = scene->dim == 2 ? 2 * 4 : 3 * 8; // of a cell of order 2 that shares its nodes
  const PetscReal cells    = PetscPowReal(2, (PetscReal)(scene->dim * refine)) * (PetscReal)list->num_cells;

  if (cells * unknowns < (PetscReal)PETSC_MAX_INT) return;
  snprintf(sentence, MESH_SENTENCE,
           "-%s_dm_plex_filename %.400s: refined %d times (-%s_dm_refine and -dm_refine%s) this mesh of %d cells has "
           "%.3g, more than can be numbered",
           body->name, body->mesh_file, (int)refine, body->name,
           scene->study.kind == STUDY_UNIFORM ? ", then -study_levels" : "", (int)list->num_cells, (double)cells);
}

/* Makes or reads every body; the first rank alone does, and stops at the first mistake. */
static PetscErrorCode MeshMakeBodies_Private(Scene scene, PetscInt coarser, const SideNames names[], BodyList lists[])
{
  char        sentence[MESH_SENTENCE] = "";
  MeshFile    files                   = NULL;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(scene->comm, &rank));
  for (PetscInt b = 0; b < scene->num_bodies && !rank && !sentence[0]; b++) {
    SceneBody body = scene->bodies[b];

    // no further body after a mistake
    BodyCoarsen(&body, scene->dim, coarser);
    if (body.mesh_file) {
      PetscCall(BodyListCreateFile(scene, b, body.refine, &names[b], &files, &lists[b], sentence));
      if (!sentence[0]) MeshCheckSize_Private(scene, coarser, &body, &lists[b], sentence);
    } else
      PetscCall(BodyListCreateBox(&body, scene->dim, &names[b], NULL, &lists[b], sentence));
  }
  PetscCall(MeshFileDestroy(&files));
  PetscCall(UserErrorCheck(scene->comm, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Makes the merged mesh, or with -adapt the forest of its cells, on the first rank.
   [in] coarser - number of coarser levels;
   [out] forest - NULL without -adapt; else dm and curves are not set */
static PetscErrorCode MeshCreateWhole_Private(Scene scene, PetscInt coarser, DM *dm, Curves *curves, MeshForest *forest)
{
  BodyList  *lists;
  SideNames *names;

  PetscFunctionBeginUser;
  *forest = NULL;
  PetscCall(PetscCalloc2(scene->num_bodies, &lists, scene->num_bodies, &names));
  for (PetscInt b = 0; b < scene->num_bodies; b++) PetscCall(SideNamesOfBody(scene, b, &names[b]));
  PetscCall(MeshMakeBodies_Private(scene, coarser, names, lists));
  if (!scene->adapt.on) PetscCall(MeshMerge(scene, lists, names, dm, curves));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    scene->bodies[b].straightened    = lists[b].straightened;
    scene->bodies[b].curved_file     = lists[b].curved_file;
    scene->bodies[b].num_nonmanifold = lists[b].num_nonmanifold;
    PetscCall(PetscArraycpy(scene->bodies[b].nonmanifold, lists[b].nonmanifold, 3));
    PetscCallMPI(MPI_Bcast(&scene->bodies[b].straightened, 1, MPIU_BOOL, 0, scene->comm));
    PetscCallMPI(MPI_Bcast(&scene->bodies[b].curved_file, 1, MPIU_BOOL, 0, scene->comm));
    PetscCall(UnjoinedPiecesWarn(&scene->bodies[b], &lists[b]));
  }
  if (scene->adapt.on) PetscCall(MeshForestCreate(scene, lists, names, forest)); // takes what is destroyed here
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    PetscCall(SideNamesDestroy(&names[b]));
    PetscCall(BodyListDestroy(&lists[b]));
  }
  PetscCall(PetscFree2(lists, names));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends a level whose cells are not checked yet. */
static PetscErrorCode MeshAppend_Private(Mesh mesh)
{
  ArcSides sides;

  PetscFunctionBeginUser;
  PetscCall(PetscRealloc((mesh->num_levels + 1) * sizeof(Level), &mesh->levels));
  PetscCall(ArcSidesCreate(MeshFinest(mesh), 1, &sides));
  PetscCall(LevelRefine(MeshFinest(mesh), &sides, &mesh->levels[mesh->num_levels]));
  PetscCall(ArcSidesDestroy(&sides));
  mesh->num_levels++;
  PetscCall(MeshShapeRefine(mesh->shape, MeshFinest(mesh)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshRefine(Mesh mesh)
{
  PetscFunctionBeginUser;
  PetscCall(MeshAppend_Private(mesh));
  PetscCall(LevelTurnCells(MeshFinest(mesh), NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Makes the coarsest level, whose cells are not checked yet. */
static PetscErrorCode MeshBegin_Private(Mesh mesh, PetscInt coarser)
{
  Scene       scene  = mesh->scene;
  PetscInt   *origin = NULL;
  Curves      curves;
  DM          dm;
  PetscMPIInt size;
  PetscBool   parts;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(scene->comm, &size));
  parts = BoxPartsWanted(scene, coarser, size);
  if (parts)
    PetscCall(BoxPartsCreate(scene, coarser, &dm, &curves));
  else if (FilePartsWanted(scene, coarser, size))
    PetscCall(FilePartsCreate(scene, &FILE_LIMITS, coarser + scene->refine, &dm, &curves, &parts));
  if (!parts) PetscCall(MeshCreateWhole_Private(scene, coarser, &dm, &curves, &mesh->forest));
  PetscCall(PetscMalloc1(mesh->forest ? MESH_MAX_ADAPTED : 1, &mesh->levels)); // inequalities point there
  mesh->num_levels = 1;
  if (mesh->forest) PetscCall(MeshForestMerge(scene, mesh->forest, &dm, &curves));
  if (!parts)
    PetscCall(PartitionDistribute(scene, coarser + scene->refine, &dm, &curves, mesh->forest ? &origin : NULL));
  PetscCall(LevelCreateFromPlex(scene, dm, &curves, &mesh->levels[0]));
  PetscCall(LevelBeginArcs(&mesh->levels[0]));
  if (mesh->forest) PetscCall(MeshForestGather(mesh->forest, &mesh->levels[0], origin));
  if (!mesh->forest) PetscCall(MeshShapeCreate(scene, &mesh->levels[0], &curves, &mesh->shape));
  PetscCall(CurvesDestroy(&curves));
  PetscCall(PetscFree(origin));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of parts of a body that are connected by vertices alone. */
static PetscErrorCode MeshWarnNonManifold_Private(const SceneBody *body, PetscInt dim)
{
  const Warning hinged = {
      .code   = "hinged_parts",
      .body   = body->name,
      .dim    = dim,
      .at     = {body->nonmanifold[0], body->nonmanifold[1], body->nonmanifold[2]},
      .advice = "let them share facets, or tie them as bodies of their own",
  };
  char z[32] = "";

  PetscFunctionBeginUser;
  if (dim == 3) (void)snprintf(z, sizeof(z), ", %g", (double)body->nonmanifold[2]);
  PetscCall(WarningAdd(&hinged,
                       "parts of body %s are connected by vertices alone (%d), the first at (%g, %g%s), and rotate "
                       "about them without resistance",
                       body->name, (int)body->num_nonmanifold, (double)body->nonmanifold[0],
                       (double)body->nonmanifold[1], z));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Coarser levels of boxes must not fail: if a map tangles large cells, there are fewer coarser levels. */
PetscErrorCode MeshSetUp(Mesh mesh)
{
  Scene       scene = mesh->scene;
  PetscMPIInt size;
  PetscInt    coarser;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(scene->comm, &size));
  coarser = scene->adapt.on ? 0 : SceneCountCoarser(scene, size);
  PetscCall(MeshBegin_Private(mesh, coarser));
  while (mesh->num_levels <= coarser) {
    PetscBool sound;

    PetscCall(LevelTurnCells(MeshFinest(mesh), &sound));
    if (sound) {
      PetscCall(MeshAppend_Private(mesh));
    } else {
      coarser -= mesh->num_levels;
      PetscCall(MeshClear(mesh));
      PetscCall(MeshBegin_Private(mesh, coarser));
    }
  }
  PetscCall(LevelTurnCells(MeshFinest(mesh), NULL));
  for (PetscInt l = 0; l < scene->refine; l++) PetscCall(mesh->forest ? MeshAdaptAll(mesh) : MeshRefine(mesh));
  mesh->own = coarser + scene->refine;
  PetscCall(MortarChoiceMake(mesh));
  for (PetscInt b = 0; b < scene->num_bodies; b++)
    if (scene->bodies[b].num_nonmanifold) PetscCall(MeshWarnNonManifold_Private(&scene->bodies[b], scene->dim));
  PetscCall(BodyOverlapWarn(MeshFinest(mesh)));
  PetscFunctionReturn(PETSC_SUCCESS);
}
