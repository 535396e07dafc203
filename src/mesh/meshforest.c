/* meshforest.c -- the forest of all bodies: its lists as one DM, its cells on the latest level. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/bodymerge.h"
#include "bodies/plexlist.h"
#include "bodies/simplices.h"
#include "level/leveltables.h"
#include "level/plexpoints.h"
#include "mesh/forest.h"
#include "mesh/meshforest.h"

PetscErrorCode MeshForestCreate(Scene scene, BodyList lists[], SideNames names[], MeshForest *forest)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(forest));
  (*forest)->num_bodies = scene->num_bodies;
  PetscCall(PetscCalloc3(scene->num_bodies, &(*forest)->tree, scene->num_bodies, &(*forest)->names, scene->num_bodies,
                         &(*forest)->cut));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    (*forest)->names[b] = names[b];
    names[b]            = (SideNames){0};
    if (!scene->adapt.kept || !BodyListCanSplit(&lists[b]))
      PetscCall(BodyListCut(&scene->bodies[b], &lists[b], &(*forest)->cut[b]));
    PetscCall(TreeCreate(scene, b, &(*forest)->names[b], &lists[b], &(*forest)->tree[b]));
  }
  PetscCallMPI(MPI_Bcast((*forest)->cut, (PetscMPIInt)scene->num_bodies, MPIU_BOOL, 0, scene->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshForestDestroy(MeshForest *forest)
{
  PetscFunctionBeginUser;
  if (!*forest) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt b = 0; b < (*forest)->num_bodies; b++) {
    PetscCall(TreeDestroy(&(*forest)->tree[b]));
    PetscCall(SideNamesDestroy(&(*forest)->names[b]));
  }
  PetscCall(PetscFree3((*forest)->tree, (*forest)->names, (*forest)->cut));
  PetscCall(PetscFree((*forest)->cell));
  PetscCall(PetscFree((*forest)->gathered));
  PetscCall(PetscFree2((*forest)->counts, (*forest)->begins));
  PetscCall(PetscFree(*forest));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshForestMerge(Scene scene, MeshForest forest, DM *dm, Curves *curves)
{
  BodyList *lists;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(forest->num_bodies, &lists));
  for (PetscInt b = 0; b < forest->num_bodies; b++) lists[b] = forest->tree[b].list;
  PetscCall(MeshMerge(scene, lists, forest->names, dm, curves));
  PetscCall(PetscFree(lists));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Describes the cells of this rank. Their numbers are points of the DM of all ranks, where cells come first.
   Vertices follow, in the order of the lists.
   [in] origin - of PartitionDistribute(); num_all - cells of all ranks; [out] cells - [level->num_cells] */
static PetscErrorCode LevelDescribeCells_Private(const Level *level, const PetscInt origin[], PetscInt num_all,
                                                 ForestCell cells[])
{
  PetscInt *point, begin, first;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(level->dm, &first, NULL));
  PetscCall(DMPlexGetHeightStratum(level->dm, 0, &begin, NULL));
  PetscCall(LevelGetNodePoints(level, &point));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const PetscInt *nodes = &level->cell_nodes[level->cell_start[c]];

    cells[c] = (ForestCell){.cell = origin[begin + c - first], .type = level->cell_type[c], .age = NOT_BISECTED};
    for (PetscInt i = 0; i < LevelNumVertices(level, c); i++)
      cells[c].vertex[i] = origin[point[nodes[i]] - first] - num_all;
    for (PetscInt k = 0; k < ElementNumNodes((ElementType)level->cell_type[c]); k++)
      cells[c].nodes[k] = level->node_global[nodes[k]];
  }
  PetscCall(PetscFree(point));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Renumbers vertices: from those of all bodies to those of their own body. */
static void ForestLocalize_Private(MeshForest forest)
{
  PetscInt cell = 0, vertex = 0;

  for (PetscInt b = 0; b < forest->num_bodies; b++) {
    const Bisection *mesh = &forest->tree[b].mesh;

    for (PetscInt c = 0; c < mesh->num_cells; c++, cell++) {
      for (PetscInt i = 0; i < mesh->corners; i++) forest->cell[cell].vertex[i] -= vertex;
    }
    vertex += mesh->num_vertices;
  }
}

/* The number in the lists of each cell of the DM, where cells are sorted by type. On the first rank.
   [out] number - owned by the caller [cells of all bodies] */
static PetscErrorCode ForestNumberCells_Private(MeshForest forest, PetscInt **number)
{
  PetscInt  cell = 0;
  BodyList *lists;
  Numbering numbering;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(forest->num_bodies, &lists));
  for (PetscInt b = 0; b < forest->num_bodies; b++) lists[b] = forest->tree[b].list;
  PetscCall(NumberingCreate(forest->num_bodies, lists, &numbering));
  PetscCall(PetscMalloc1(numbering.num_cells, number));
  for (PetscInt b = 0; b < forest->num_bodies; b++)
    for (PetscInt c = 0; c < lists[b].num_cells; c++) (*number)[numbering.point[b][c]] = cell++;
  PetscCall(NumberingDestroy(&numbering));
  PetscCall(PetscFree(lists));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshForestGather(MeshForest forest, const Level *level, const PetscInt origin[])
{
  ForestCell  *own, *all = NULL;
  PetscMPIInt  size, rank, num = (PetscMPIInt)level->num_cells, *counts, *begins;
  PetscInt     num_all = level->num_cells, *number;
  MPI_Datatype type;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(level->comm, &size));
  PetscCallMPI(MPI_Comm_rank(level->comm, &rank));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &num_all, 1, MPIU_INT, MPI_SUM, level->comm));
  PetscCall(PetscMalloc1(level->num_cells, &own));
  PetscCall(LevelDescribeCells_Private(level, origin, num_all, own));
  PetscCall(PetscFree2(forest->counts, forest->begins));
  PetscCall(PetscMalloc2(size, &forest->counts, size, &forest->begins));
  counts = forest->counts;
  begins = forest->begins;
  PetscCallMPI(MPI_Gather(&num, 1, MPI_INT, counts, 1, MPI_INT, 0, level->comm));
  PetscCall(PetscFree(forest->cell));
  PetscCall(PetscFree(forest->gathered));
  forest->num_cells = rank ? 0 : num_all;
  if (!rank) {
    begins[0] = 0;
    for (PetscMPIInt r = 1; r < size; r++) begins[r] = begins[r - 1] + counts[r - 1];
    PetscCall(PetscMalloc1(num_all, &all));
  }
  PetscCallMPI(MPI_Type_contiguous(sizeof(ForestCell) / sizeof(PetscInt), MPIU_INT, &type));
  PetscCallMPI(MPI_Type_commit(&type));
  PetscCallMPI(MPI_Gatherv(own, num, type, all, counts, begins, type, 0, level->comm));
  PetscCallMPI(MPI_Type_free(&type));
  PetscCall(PetscFree(own));
  if (!rank) {
    PetscCall(PetscMalloc1(num_all, &forest->cell));
    PetscCall(PetscMalloc1(num_all, &forest->gathered));
    PetscCall(ForestNumberCells_Private(forest, &number));
    for (PetscInt i = 0; i < num_all; i++) {
      all[i].cell               = number[all[i].cell];
      forest->gathered[i]       = all[i].cell;
      forest->cell[all[i].cell] = all[i];
    }
    PetscCall(PetscFree(number));
    ForestLocalize_Private(forest);
  }
  PetscCall(PetscFree(all));
  PetscFunctionReturn(PETSC_SUCCESS);
}
