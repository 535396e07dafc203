/* graphparallel.c -- the graph of cells, partitioned by all ranks.

   PT-Scotch or ParMETIS, whichever PETSc has. PT-Scotch takes one weight for a cell: contact is not balanced
   separately, as by METIS. Parts have no correction for nodes between them. */
#include "base/compat.h"
#include "level/exchange.h"
#include "mesh/filecells.h"
#include "mesh/graphparallel.h"
#include "partition/cellgraph.h"
#include "partition/partitionweights.h"
#include <dlfcn.h>
#include <petscmat.h>

#define _GNU_SOURCE // RTLD_DEFAULT

#if defined(PETSC_HAVE_PTSCOTCH)
static const char *const ParallelType = MATPARTITIONINGPTSCOTCH;
#elif defined(PETSC_HAVE_PARMETIS)
static const char *const ParallelType = MATPARTITIONINGPARMETIS;
#else
static const char *const ParallelType = NULL;
#endif

/* Half of an edge: the neighbour of a row. */
typedef struct {
  PetscInt row, column, weight;
} HalfEdge;

/* Debian's PETSc of 64-bit indices is built with a PT-Scotch of 32-bit ones, and fails. */
static PetscBool ScotchFits_Private(void)
{
#if defined(PETSC_HAVE_PTSCOTCH)
  union {
    void *address;
    int (*size)(void);
  } scotch = {.address = dlsym(RTLD_DEFAULT, "SCOTCH_numSizeof")};

  return (PetscBool)(scotch.address ? scotch.size() == (int)sizeof(PetscInt) : sizeof(PetscInt) == sizeof(int));
#else
  return PETSC_TRUE;
#endif
}

PetscBool GraphHasParallel(void)
{
  return (PetscBool)(ParallelType && ScotchFits_Private());
}

/* Both halves of each edge, on the ranks of their rows. Collective. [out] half - freed by the caller [num] */
static PetscErrorCode HalvesSend_Private(const Files *files, const FileCells *cells, const CellGraph *graph,
                                         PetscInt *num, HalfEdge **half)
{
  PetscInt    *last;
  PetscMPIInt *rank;
  HalfEdge    *own;
  Exchange     exchange;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(files->size, &last, 2 * graph->num, &rank, 2 * graph->num, &own));
  PetscCallMPI(MPI_Allgather((PetscInt[]){cells->first + cells->num}, 1, MPIU_INT, last, 1, MPIU_INT, files->comm));
  for (PetscInt i = 0; i < 2 * graph->num; i++) {
    PetscMPIInt low = 0, high = files->size - 1;

    own[i] = (HalfEdge){graph->end[i], graph->end[i ^ 1], graph->weight[i / 2]};
    while (low < high) {
      const PetscMPIInt middle = (low + high) / 2;

      if (own[i].row < last[middle])
        high = middle;
      else
        low = middle + 1;
    }
    rank[i] = low;
  }
  PetscCall(ExchangeCreate(files->comm, 2 * graph->num, rank, &exchange));
  *num = exchange.num;
  PetscCall(PetscMalloc1(exchange.num, half));
  PetscCall(ExchangeSend(&exchange, sizeof(*own), own, *half));
  PetscCall(ExchangeDestroy(&exchange));
  PetscCall(PetscFree3(last, rank, own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* This rank's rows as a matrix; edges that occur twice are summed up. [in] half - [num] */
static PetscErrorCode GraphCreateMat_Private(const Files *files, const FileCells *cells, PetscInt num,
                                             const HalfEdge half[], Mat *adjacency)
{
  PetscInt *start, *begin, *column, *weight, kept = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(cells->num + 1, &start));
  PetscCall(PetscCalloc1(cells->num + 2, &begin));
  PetscCall(PetscMalloc1(num + 1, &column)); // PT-Scotch does not accept NULL for an empty list
  PetscCall(PetscMalloc1(num + 1, &weight));
  for (PetscInt i = 0; i < num; i++) begin[half[i].row - cells->first + 2]++;
  for (PetscInt c = 0; c < cells->num; c++) begin[c + 2] += begin[c + 1];
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt at = begin[half[i].row - cells->first + 1]++;

    column[at] = half[i].column;
    weight[at] = half[i].weight;
  }
  for (PetscInt c = 0; c < cells->num; c++) {
    const PetscInt from = begin[c], size = begin[c + 1] - from;

    start[c] = kept;
    PetscCall(PetscSortIntWithArray(size, &column[from], &weight[from]));
    for (PetscInt i = from; i < from + size; i++) {
      if (kept > start[c] && column[kept - 1] == column[i]) {
        weight[kept - 1] += weight[i];
        continue;
      }
      column[kept]   = column[i];
      weight[kept++] = weight[i];
    }
  }
  start[cells->num] = kept;
  PetscCall(PetscFree(begin));
  PetscCall(MatCreateMPIAdj(files->comm, cells->num, cells->total, start, column, weight, adjacency)); // takes them
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode GraphCutParallel(Scene scene, const Files *files, const FileCells *cells, const CellGraph *graph,
                                PetscInt part[])
{
  const Level level = {.dim = files->dim, .num_cells = cells->num, .cell_type = cells->type, .cell_body = cells->body};
  CellGraph   plain = {.num = 0};
  HalfEdge   *half;
  PartitionWeights shares;
  MatPartitioning  partitioning;
  PetscInt         num, *load;
  const PetscInt  *answer;
  Mat              adjacency;
  IS               is;

  PetscFunctionBeginUser;
  PetscCall(HalvesSend_Private(files, cells, graph, &num, &half));
  PetscCall(GraphCreateMat_Private(files, cells, num, half, &adjacency));
  PetscCall(PetscFree(half));
  PetscCall(PetscCalloc1(cells->num, &plain.contact));
  PetscCall(PartitionWeightsCreate(scene, &level, &plain, files->size, &shares));
  PetscCall(PetscFree(plain.contact));
  PetscCall(PetscMalloc1(cells->num + 1, &load));
  PetscCall(PetscArraycpy(load, shares.load, cells->num));
  PetscCall(PartitionWeightsDestroy(&shares));
  PetscCall(MatPartitioningCreate(files->comm, &partitioning));
  PetscCall(MatPartitioningSetAdjacency(partitioning, adjacency));
  PetscCall(MatPartitioningSetType(partitioning, ParallelType));
  PetscCall(MatPartitioningSetUseEdgeWeights(partitioning, PETSC_TRUE));
  PetscCall(MatPartitioningSetVertexWeights(partitioning, load)); // takes them
  PetscCall(MatPartitioningApply(partitioning, &is));
  PetscCall(ISGetIndices(is, &answer));
  PetscCall(PetscArraycpy(part, answer, cells->num));
  PetscCall(ISRestoreIndices(is, &answer));
  PetscCall(ISDestroy(&is));
  PetscCall(MatPartitioningDestroy(&partitioning));
  PetscCall(MatDestroy(&adjacency));
  PetscFunctionReturn(PETSC_SUCCESS);
}
