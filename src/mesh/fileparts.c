/* fileparts.c -- the mesh of files of many cells, made by all ranks: read in parts, connected, partitioned,
   redistributed, and joined. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/bodymerge.h"
#include "mesh/filecells.h"
#include "mesh/fileconnect.h"
#include "mesh/filelists.h"
#include "mesh/fileparting.h"
#include "mesh/fileparts.h"
#include "partition/plexjoin.h"
#include <string.h>

const FileLimits FILE_LIMITS = {.parts = 4096, .parallel = 200000};

/* Whether a file can be read in parts. */
static PetscBool FileHasParts_Private(const char path[])
{
  const char *ending = strrchr(path, '.');

  return (PetscBool)(ending && (!strncmp(ending, ".msh", strlen(".msh")) || !strcmp(ending, ".h5")));
}

PetscBool FilePartsWanted(Scene scene, PetscInt coarser, PetscMPIInt num_ranks)
{
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    const SceneBody *body = &scene->bodies[b];

    if (!body->mesh_file || body->map || body->refine > coarser || !FileHasParts_Private(body->mesh_file))
      return PETSC_FALSE;
  }
  return (PetscBool)(num_ranks > 1 && !scene->adapt.on);
}

/* Reads each file once. Collective. [out] good - whether all can be used, and have many cells */
static PetscErrorCode FilesCreate_Private(Scene scene, PetscInt min_cells, Files *files, PetscBool *good)
{
  PetscInt cells = 0;

  PetscFunctionBeginUser;
  *files = (Files){.comm = scene->comm, .dim = scene->dim};
  *good  = PETSC_TRUE;
  PetscCallMPI(MPI_Comm_rank(scene->comm, &files->rank));
  PetscCallMPI(MPI_Comm_size(scene->comm, &files->size));
  PetscCall(PetscCalloc4(scene->num_bodies, &files->part, scene->num_bodies, &files->names, scene->num_bodies + 1,
                         &files->first_point, scene->num_bodies, &files->of_body));
  for (PetscInt b = 0; b < scene->num_bodies && *good; b++) {
    const PetscInt f    = files->num;
    PetscInt       same = 0;

    while (same < b && strcmp(scene->bodies[same].mesh_file, scene->bodies[b].mesh_file)) same++;
    files->of_body[b] = same < b ? files->of_body[same] : f;
    if (same < b) continue;
    files->num++;
    PetscCall(
        GmshPartRead(scene->comm, scene->bodies[b].mesh_file, scene->dim, &files->names[f], &files->part[f], good));
    if (files->part[f].all_nodes > PETSC_MAX_INT / scene->num_bodies - files->num_points) *good = PETSC_FALSE;
    if (*good) files->num_points += files->part[f].all_nodes;
    files->first_point[f + 1] = files->num_points;
    for (PetscInt e = 0; e < files->part[f].mesh.num_elements; e++)
      cells += files->part[f].mesh.type[e]->dim == scene->dim;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, good, 1, MPIU_BOOL, MPI_LAND, scene->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &cells, 1, MPIU_INT, MPI_SUM, scene->comm));
  if (cells < min_cells) *good = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode FilesDestroy_Private(Files *files)
{
  PetscFunctionBeginUser;
  for (PetscInt f = 0; f < files->num; f++) {
    PetscCall(GmshNamesDestroy(&files->names[f]));
    PetscCall(GmshMeshDestroy(&files->part[f].mesh));
  }
  PetscCall(PetscFree4(files->part, files->names, files->first_point, files->of_body));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether each side has facets, and none inside its body. Collective. [in,out] good */
static PetscErrorCode SidesCheck_Private(Scene scene, const Files *files, const FileCells *cells,
                                         const SideNames names[], PetscBool *good)
{
  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    for (PetscInt s = 0; s < names[b].num; s++) {
      PetscInt tag, num = 0;

      if (!GmshNamesFindGroup(&files->names[files->of_body[b]], files->dim - 1, names[b].name[s], &tag) || tag <= 0)
        *good = PETSC_FALSE;
      for (PetscInt c = 0; c < cells->num && *good; c++) {
        for (PetscInt f = 0; f < ElementNumFacets((ElementType)cells->type[c]) && cells->body[c] == b; f++) {
          if (!FileCellsHasSide(files, cells, c, f, tag)) continue;
          if (cells->neighbour[c * FILE_FACETS + f] >= 0) *good = PETSC_FALSE;
          num++;
        }
      }
      PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &num, 1, MPIU_INT, MPI_SUM, files->comm));
      if (!num) *good = PETSC_FALSE;
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, good, 1, MPIU_BOOL, MPI_LAND, files->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The lists of this rank as parts of one mesh. Collective. [out] good - whether each body is connected */
static PetscErrorCode FilePartsMerge_Private(Scene scene, const Files *files, const FileCells *cells,
                                             const SideNames names[], DM *dm, Curves *curves, PetscBool *good)
{
  PetscInt *ids, num;
  BodyList *lists;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(scene->num_bodies, &lists));
  PetscCall(FileListsCreate(scene, files, cells, names, lists, &ids));
  PetscCall(MeshMerge(scene, lists, names, dm, curves));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    scene->bodies[b].curved_file     = lists[b].curved_file;
    scene->bodies[b].straightened    = lists[b].straightened;
    scene->bodies[b].num_nonmanifold = 0;
    PetscCall(BodyListDestroy(&lists[b]));
  }
  PetscCall(PetscFree(lists));
  PetscCall(PlexJoin(*dm, scene->num_bodies * files->num_points, ids));
  PetscCall(PetscFree(ids));
  PetscCall(PlexCountComponents(*dm, &num));
  *good = (PetscBool)(num == scene->num_bodies);
  if (!*good) {
    PetscCall(DMDestroy(dm));
    PetscCall(CurvesDestroy(curves));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Components of a body may touch, or be connected by vertices alone: only the first rank can check this. */
PetscErrorCode FilePartsCreate(Scene scene, const FileLimits *limits, PetscInt refine, DM *dm, Curves *curves,
                               PetscBool *good)
{
  SideNames *names;
  FileCells  cells = {0};
  Files      files;
  PetscInt  *part;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(scene->num_bodies, &names));
  for (PetscInt b = 0; b < scene->num_bodies; b++) PetscCall(SideNamesOfBody(scene, b, &names[b]));
  PetscCall(FilesCreate_Private(scene, limits->parts, &files, good));
  if (*good) PetscCall(FileCellsCreate(scene, &files, &cells, good));
  if (*good) PetscCall(FileCellsConnect(&files, &cells, good));
  if (*good) PetscCall(SidesCheck_Private(scene, &files, &cells, names, good));
  if (*good) {
    PetscCall(PetscMalloc1(cells.num, &part));
    PetscCall(FileCellsPart(scene, &files, &cells, limits, refine, part));
    PetscCall(FileCellsMove(&files, part, &cells));
    PetscCall(PetscFree(part));
    PetscCall(FilePartsMerge_Private(scene, &files, &cells, names, dm, curves, good));
  }
  PetscCall(FileCellsDestroy(&cells));
  PetscCall(FilesDestroy_Private(&files));
  for (PetscInt b = 0; b < scene->num_bodies; b++) PetscCall(SideNamesDestroy(&names[b]));
  PetscCall(PetscFree(names));
  PetscFunctionReturn(PETSC_SUCCESS);
}
