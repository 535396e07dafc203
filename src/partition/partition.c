/* partition.c -- the partition: bodies that touch share ranks where they touch.

   METIS minimizes the weight of cut edges in the graph of cells. Cells of two bodies share no facet. So a
   plain partition of two equal bodies gives one body to each of two ranks: all contact is remote. Cells whose
   facets may touch are therefore joined by additional, heavier edges. These alone could give all contact to
   one rank. Contact is work, and is a second load that is balanced like the cells [1]. Edges across which
   cells are short are heavier, too: there K couples strongly, and the lines of smoothers should not be cut.

   Reference: [1] G. Karypis, V. Kumar, Multilevel algorithms for multi-constraint graph partitioning,
   1998. */
#include "base/compat.h"
#include "level/leveltables.h"
#include "partition/cellgraph.h"
#include "partition/graphcut.h"
#include "partition/partition.h"
#include "refinement/levelrefine.h"
#include <petscsf.h>

enum {
  MIN_CELLS_A_PART = 4 /* with fewer METIS is not called */
};

static PetscReal CellsGetDistance_Private(const Level *level, const PetscInt cells[2])
{
  PetscReal square = 0;

  for (PetscInt d = 0; d < level->dim; d++) {
    PetscReal x[2] = {0, 0};

    for (PetscInt k = 0; k < 2; k++) {
      const PetscInt begin = level->cell_start[cells[k]], end = level->cell_start[cells[k] + 1];

      for (PetscInt i = begin; i < end; i++)
        x[k] += level->coords[level->cell_nodes[i] * level->dim + d] / (PetscReal)(end - begin);
    }
    square += PetscSqr(x[1] - x[0]);
  }
  return PetscSqrtReal(square);
}

/* Adds an edge for each facet between two cells. Cells are short across it if their middles are nearer than
   those of other neighbours. */
static PetscErrorCode NeighboursAdd_Private(const Level *level, CellGraph *graph)
{
  PetscInt   begin, end;
  PetscReal *farthest; /* of each cell's neighbours */

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(level->num_cells, &farthest));
  PetscCall(DMPlexGetHeightStratum(level->dm, 1, &begin, &end));
  for (PetscInt pass = 0; pass < 2; pass++) {
    for (PetscInt f = begin; f < end; f++) {
      const PetscInt *cells; // the first points
      PetscInt        num;
      PetscReal       distance, most;

      PetscCall(DMPlexGetSupportSize(level->dm, f, &num));
      PetscCall(DMPlexGetSupport(level->dm, f, &cells));
      if (num != 2) continue;
      distance = CellsGetDistance_Private(level, cells);
      most     = PetscMax(farthest[cells[0]], farthest[cells[1]]);
      for (PetscInt k = 0; k < 2; k++) farthest[cells[k]] = PetscMax(farthest[cells[k]], distance);
      if (!pass) continue;
      PetscCall(CellGraphAddEdge(graph, cells[0], cells[1], CellGraphWeight(distance, most)));
    }
  }
  graph->num_neighbours = graph->num;
  PetscCall(PetscFree(farthest));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Edges across a pair. */
static PetscErrorCode PairAdd_Private(Scene scene, const ScenePair *pair, PetscInt weight, Level *level,
                                      CellGraph *graph)
{
  Facets nonmortar, mortar;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, scene, pair->nonmortar.body, pair->nonmortar.side, &nonmortar));
  PetscCall(LevelGetFacets(level, scene, pair->mortar.body, pair->mortar.side, &mortar));
  PetscCall(CellGraphAddContact(level, &nonmortar, &mortar, pair->reach, weight, graph));
  PetscCall(FacetsDestroy(&nonmortar));
  PetscCall(FacetsDestroy(&mortar));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PartitionCompute(Scene scene, Level *level, PetscInt refine, PetscInt contact_weight,
                                const PetscInt bricks[], PetscInt num_parts, PetscInt part[])
{
  CellGraph graph = {.bricks = bricks};

  PetscFunctionBeginUser;
  if (level->num_cells < MIN_CELLS_A_PART * num_parts) {
    for (PetscInt c = 0; c < level->num_cells; c++) part[c] = c * num_parts / level->num_cells;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscCalloc1(level->num_cells, &graph.contact));
  PetscCall(NeighboursAdd_Private(level, &graph));
  for (PetscInt p = 0; p < scene->num_pairs && contact_weight; p++) {
    if (scene->pairs[p].mortar.body >= 0)
      PetscCall(PairAdd_Private(scene, &scene->pairs[p], contact_weight, level, &graph));
  }
  PetscCall(CellGraphCut(scene, level, refine, &graph, num_parts, part));
  PetscCall(PetscFree(graph.contact));
  PetscCall(CellGraphDestroy(&graph));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The partition for PETSc: the cells of rank 0, of rank 1, ... */
static PetscErrorCode PartitionerSet_Private(PetscInt num_cells, const PetscInt part[], PetscMPIInt size,
                                             PetscPartitioner partitioner)
{
  PetscInt *sizes, *points, *fill;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(size, &sizes, num_cells, &points, size, &fill));
  for (PetscInt c = 0; c < num_cells; c++) sizes[part[c]]++;
  for (PetscMPIInt r = 1; r < size; r++) fill[r] = fill[r - 1] + sizes[r - 1];
  for (PetscInt c = 0; c < num_cells; c++) points[fill[part[c]]++] = c;
  PetscCall(PetscPartitionerSetType(partitioner, PETSCPARTITIONERSHELL));
  PetscCall(PetscPartitionerShellSetPartition(partitioner, size, sizes, points));
  PetscCall(PetscFree3(sizes, points, fill));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The point of the original DM of each point of this rank.
   [in] sf - of DMPlexDistribute(), NULL if nothing moved */
static PetscErrorCode OriginCreate_Private(DM dm, PetscSF sf, PetscInt **origin)
{
  const PetscSFNode *remote;
  const PetscInt    *local;
  PetscInt           begin, end, num;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(dm, &begin, &end));
  PetscCall(PetscMalloc1(end - begin, origin));
  for (PetscInt p = begin; p < end; p++) (*origin)[p - begin] = p;
  if (!sf) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscSFGetGraph(sf, NULL, &num, &local, &remote));
  for (PetscInt i = 0; i < num; i++) (*origin)[(local ? local[i] : i) - begin] = remote[i].index;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PartitionCreate(Scene scene, DM dm, PetscInt refine, const PetscInt bricks[], PetscInt *num_cells,
                               PetscInt **part)
{
  PetscMPIInt size;
  Level       level;
  DM          clone;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(scene->comm, &size));
  PetscCall(DMClone(dm, &clone)); // tables set a section on their DM, which must not be distributed
  PetscCall(LevelCreateTables(scene, clone, 1, &level));
  PetscCall(LevelSetCoords(&level, NULL));
  PetscCall(DMDestroy(&clone));
  *num_cells = level.num_cells;
  PetscCall(PetscMalloc1(level.num_cells, part));
  PetscCall(PartitionCompute(scene, &level, refine, CONTACT_WEIGHT, bricks, size, *part));
  PetscCall(LevelDestroy(&level));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The coarsest mesh is partitioned: descendants of a cell stay on its rank, and the graph is small. It
   depends on vertices alone, so that meshes of all orders have one partition. Cells are checked later, on any
   number of ranks. */
PetscErrorCode PartitionDistribute(Scene scene, PetscInt refine, DM *dm, Curves *curves, PetscInt **origin)
{
  PetscPartitioner partitioner;
  PetscMPIInt      size;
  PetscInt        *part, num_cells;
  PetscSF          sf;
  DM               spread;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(scene->comm, &size));
  if (size == 1) {
    if (origin) PetscCall(OriginCreate_Private(*dm, NULL, origin));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PartitionCreate(scene, *dm, refine, NULL, &num_cells, &part));
  PetscCall(DMPlexGetPartitioner(*dm, &partitioner));
  PetscCall(PartitionerSet_Private(num_cells, part, size, partitioner));
  PetscCall(PetscFree(part));
  PetscCall(DMPlexDistribute(*dm, 0, &sf, &spread));
  PetscCall(CurvesDistribute(*dm, sf, curves));
  if (origin) PetscCall(OriginCreate_Private(spread, sf, origin));
  PetscCall(PetscSFDestroy(&sf));
  PetscCall(DMDestroy(dm));
  *dm = spread;
  PetscFunctionReturn(PETSC_SUCCESS);
}
