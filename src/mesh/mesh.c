/* mesh.c -- the life of a mesh: bodies as lists, merged, partitioned, refined level by level.

   Input is the first rank's business until the mesh is whole, so that reading needs no thought of ranks. The
   coarsest mesh is spread, and every rank refines its own part: the work and the memory that grow with refinement
   are shared from the beginning. */
#include "room.h"
#include <mortise/compat.h>
#include <mortise/fault.h>

PetscErrorCode MeshCreate(Scene scene, Mesh *mesh)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(mesh));
  (*mesh)->scene = scene;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Makes or reads every body; the first rank alone does, and stops at the first mistake. */
static PetscErrorCode MeshMakeBodies_Private(Scene scene, const SideNames names[], BodyList lists[])
{
  char        sentence[MESH_SENTENCE] = "";
  MeshFile    files                   = NULL;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(scene->comm, &rank));
  for (PetscInt b = 0; b < scene->num_bodies && !rank && !sentence[0]; ++b) {
    const SceneBody *body = &scene->bodies[b];

    // a later body is not made once there is a mistake to tell
    if (body->mesh_file)
      PetscCall(BodyListCreateFile(body, scene->dim, &names[b], &files, &lists[b], sentence));
    else
      PetscCall(BodyListCreateBox(body, scene->dim, &names[b], &lists[b], sentence));
  }
  PetscCall(MeshFileDestroy(&files));
  PetscCall(FaultCheck(scene->comm, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The merged mesh, whole on the first rank. */
static PetscErrorCode MeshCreateWhole_Private(Scene scene, DM *dm, Curves *curves)
{
  BodyList  *lists;
  SideNames *names;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(scene->num_bodies, &lists, scene->num_bodies, &names));
  for (PetscInt b = 0; b < scene->num_bodies; ++b) PetscCall(SideNamesOfBody(scene, b, &names[b]));
  PetscCall(MeshMakeBodies_Private(scene, names, lists));
  PetscCall(MeshMerge(scene, lists, names, dm, curves));
  for (PetscInt b = 0; b < scene->num_bodies; ++b) {
    scene->bodies[b].straightened = lists[b].straightened;
    PetscCallMPI(MPI_Bcast(&scene->bodies[b].straightened, 1, MPIU_BOOL, 0, scene->comm));
    PetscCall(SideNamesDestroy(&names[b]));
    PetscCall(BodyListDestroy(&lists[b]));
  }
  PetscCall(PetscFree2(lists, names));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshRefine(Mesh mesh)
{
  PetscFunctionBeginUser;
  PetscCall(PetscRealloc((mesh->num_levels + 1) * sizeof(Level), &mesh->levels));
  PetscCall(LevelRefine(&mesh->levels[mesh->num_levels - 1], &mesh->levels[mesh->num_levels]));
  ++mesh->num_levels;
  PetscCall(MeshShapeRefine(mesh));
  PetscCall(LevelTurnCells(MeshFinest(mesh)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Body by body on the first rank; together from there on. */
PetscErrorCode MeshSetUp(Mesh mesh)
{
  Scene  scene = mesh->scene;
  Curves curves;
  DM     dm;

  PetscFunctionBeginUser;
  PetscCall(MeshCreateWhole_Private(scene, &dm, &curves));
  PetscCall(MeshPartition(scene, &dm, &curves));
  PetscCall(PetscMalloc1(1, &mesh->levels));
  PetscCall(LevelCreateTables(scene, dm, SceneMaxOrder(scene), &mesh->levels[0]));
  PetscCall(DMRemoveLabel(dm, "body", NULL)); // refinement would carry it on at a quarter of its costs
  mesh->num_levels = 1;
  PetscCall(LevelSetCoords(&mesh->levels[0], &curves));
  PetscCall(LevelTurnCells(&mesh->levels[0]));
  PetscCall(MeshShapeCreate(mesh, &curves));
  PetscCall(CurvesDestroy(&curves));
  PetscCall(DMDestroy(&dm));
  for (PetscInt l = 0; l < scene->refine; ++l) PetscCall(MeshRefine(mesh));
  PetscCall(MeshChooseRoles(mesh));
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
  for (PetscInt l = 0; l < (*mesh)->num_levels; ++l) PetscCall(LevelDestroy(&(*mesh)->levels[l]));
  PetscCall(MeshShapeDestroy(*mesh));
  PetscCall(PetscFree((*mesh)->levels));
  PetscCall(PetscFree(*mesh));
  PetscFunctionReturn(PETSC_SUCCESS);
}
