/* dissection.c -- a pivot ordering by nested dissection, for a factorization with some unknowns last.

   METIS dissects the graph of the matrix's blocks (nodes) on the first rank, where MUMPS needs the ordering.
   Couplings through the last unknowns do not count.

   Reference: G. Karypis, V. Kumar, A fast and high quality multilevel scheme for partitioning irregular
   graphs, 1998. */
#include "base/compat.h"
#include <metis.h>
#include <petscbt.h>
#include "pdas/factorization.h"

/* Neighbours of every block in compressed rows. */
typedef struct {
  PetscInt  num;   /* blocks */
  PetscInt *start; /* [num+1] */
  PetscInt *end;   /* [start[num]] */
} Graph;

/* Appends the blocks of a row that are not marked with its block yet.
   [in,out] mark - [blocks of all ranks] */
static PetscErrorCode DissectionAddRow_Private(Mat A, PetscInt row, const PetscBT last, PetscInt mark[], Graph *graph,
                                               PetscInt *max)
{
  PetscInt           bs, num;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  PetscCall(MatGetBlockSize(A, &bs));
  PetscCall(MatGetRow(A, row, &num, &columns, &values));
  for (PetscInt c = 0; c < num; c++) {
    const PetscInt block = columns[c] / bs;

    if (values[c] == 0 || mark[block] == row / bs || PetscBTLookup(last, columns[c])) continue;
    mark[block] = row / bs;
    if (graph->start[graph->num] == *max) {
      *max *= 2;
      PetscCall(PetscRealloc(*max * sizeof(PetscInt), &graph->end));
    }
    graph->end[graph->start[graph->num]++] = block;
  }
  PetscCall(MatRestoreRow(A, row, &num, &columns, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rows of this rank. */
static PetscErrorCode DissectionCreateGraph_Private(Mat A, const PetscBT last, Graph *graph)
{
  PetscInt begin, end, N, bs, max, *mark;

  PetscFunctionBeginUser;
  PetscCall(MatGetBlockSize(A, &bs));
  PetscCall(MatGetSize(A, &N, NULL));
  PetscCall(MatGetOwnershipRange(A, &begin, &end));
  graph->num = 0;
  max        = 1 + 16 * (end - begin) / bs;
  PetscCall(PetscMalloc1((end - begin) / bs + 1, &graph->start));
  PetscCall(PetscMalloc1(max, &graph->end));
  PetscCall(PetscMalloc1(N / bs, &mark));
  for (PetscInt i = 0; i < N / bs; i++) mark[i] = -1;
  graph->start[0] = 0;
  for (PetscInt block = begin / bs; block < end / bs; block++) {
    graph->num++;
    graph->start[graph->num] = graph->start[graph->num - 1];
    mark[block]              = block; /* METIS wants no edge from a block to itself */
    for (PetscInt row = block * bs; row < (block + 1) * bs; row++) {
      if (!PetscBTLookup(last, row)) PetscCall(DissectionAddRow_Private(A, row, last, mark, graph, &max));
    }
  }
  PetscCall(PetscFree(mark));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gathers the rows of all ranks on the first one; its graph replaces own. */
static PetscErrorCode DissectionGatherGraph_Private(MPI_Comm comm, Graph *own)
{
  PetscMPIInt  rank, size, counts[2] = {(PetscMPIInt)own->num, (PetscMPIInt)own->start[own->num]};
  PetscMPIInt *all, *num = NULL, *offsets = NULL;
  Graph        whole = {0, NULL, NULL};

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  if (size == 1) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc3(2 * size, &all, 2 * size, &num, 2 * (size + 1), &offsets));
  PetscCallMPI(MPI_Gather(counts, 2, MPI_INT, all, 2, MPI_INT, 0, comm));
  offsets[0] = offsets[size + 1] = 0;
  for (PetscMPIInt r = 0; r < size && !rank; r++) {
    num[r]                = all[2 * r];
    num[size + r]         = all[2 * r + 1];
    offsets[r + 1]        = offsets[r] + num[r];
    offsets[size + r + 2] = offsets[size + r + 1] + num[size + r];
  }
  if (!rank) {
    whole.num = offsets[size];
    PetscCall(PetscMalloc1(whole.num + 1, &whole.start));
    PetscCall(PetscMalloc1(offsets[2 * size + 1], &whole.end));
    whole.start[0] = 0;
  }
  PetscCallMPI(
      MPI_Gatherv(own->end, counts[1], MPIU_INT, whole.end, num + size, offsets + size + 1, MPIU_INT, 0, comm));
  PetscCallMPI(
      MPI_Gatherv(own->start + 1, counts[0], MPIU_INT, whole.start + (rank ? 0 : 1), num, offsets, MPIU_INT, 0, comm));
  for (PetscMPIInt r = 1; r < size && !rank; r++) {
    for (PetscInt i = offsets[r]; i < offsets[r + 1]; i++) whole.start[i + 1] += offsets[size + r + 1];
  }
  PetscCall(PetscFree3(all, num, offsets));
  PetscCall(PetscFree(own->start));
  PetscCall(PetscFree(own->end));
  *own = whole;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [out] position - as of DissectionOrder() */
static PetscErrorCode DissectionDissect_Private(const Graph *graph, PetscInt bs, const PetscBT last, PetscInt num,
                                                const PetscInt C[], PetscInt position[])
{
  idx_t    n     = (idx_t)graph->num, options[METIS_NOPTIONS], *start, *end, *old, *new;
  PetscInt place = 0;
  int      status;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc4(n + 1, &start, graph->start[n], &end, n, &old, n, &new));
  for (idx_t i = 0; i <= n; i++) start[i] = (idx_t)graph->start[i];
  for (idx_t i = 0; i < start[n]; i++) end[i] = (idx_t)graph->end[i];
  METIS_SetDefaultOptions(options);
  status = METIS_NodeND(&n, start, end, NULL, options, old, new);
  PetscCheck(status != METIS_ERROR_MEMORY, PETSC_COMM_SELF, PETSC_ERR_MEM, "No memory for METIS");
  PetscCheck(status == METIS_OK, PETSC_COMM_SELF, PETSC_ERR_LIB, "METIS could not dissect the graph of the matrix");
  for (idx_t i = 0; i < n; i++) {
    for (PetscInt dof = old[i] * bs; dof < (old[i] + 1) * bs; dof++) {
      if (!PetscBTLookup(last, dof)) position[dof] = ++place;
    }
  }
  for (PetscInt i = 0; i < num; i++) position[C[i]] = ++place;
  PetscCall(PetscFree4(start, end, old, new));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode DissectionOrder(Mat A, PetscInt num, const PetscInt C[], PetscInt position[])
{
  MPI_Comm    comm = PetscObjectComm((PetscObject)A);
  PetscInt    N, bs;
  PetscMPIInt rank;
  PetscBT     last;
  Graph       graph;

  PetscFunctionBeginUser;
  PetscCall(MatGetSize(A, &N, NULL));
  PetscCall(MatGetBlockSize(A, &bs));
  PetscCall(PetscBTCreate(N, &last));
  for (PetscInt i = 0; i < num; i++) PetscCall(PetscBTSet(last, C[i]));
  PetscCall(DissectionCreateGraph_Private(A, last, &graph));
  PetscCall(DissectionGatherGraph_Private(comm, &graph));
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (!rank) PetscCall(DissectionDissect_Private(&graph, bs, last, num, C, position));
  PetscCall(PetscFree(graph.start));
  PetscCall(PetscFree(graph.end));
  PetscCall(PetscBTDestroy(&last));
  PetscFunctionReturn(PETSC_SUCCESS);
}
