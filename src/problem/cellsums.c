/* cellsums.c -- K as a sum of cell matrices.

   A Mat searches the place of every entry, and moves other entries to make room. Here nodes are searched,
   once for all entries of a block. Entries in rows of other ranks are sent once, as sums, which are made in
   the order of the cells. Rows that couple nodes of one rank alone go through no Mat. */
#include "problem/cellsums.h"
#include "base/compat.h"

/* The cells of every node, ghosts included. */
typedef struct {
  PetscInt *start, *cell; /* [num_nodes+1], [start[num_nodes]] */
} Stars;

static PetscErrorCode CellSumsListCellsOfNodes_Private(const Level *level, Stars *stars)
{
  const PetscInt num = level->num_nodes;
  PetscInt      *start;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num + 2, &stars->start)); // one place ahead, until all cells are listed
  start = &stars->start[1];
  for (PetscInt i = 0; i < level->cell_start[level->num_cells]; i++) start[level->cell_nodes[i] + 1]++;
  for (PetscInt i = 0; i < num; i++) start[i + 1] += start[i];
  PetscCall(PetscMalloc1(start[num], &stars->cell));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    for (PetscInt i = level->cell_start[c]; i < level->cell_start[c + 1]; i++)
      stars->cell[start[level->cell_nodes[i]]++] = c;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Where a node is in an ascending list, or would be: lists are so short that comparing all is faster than to
   branch. */
static inline PetscInt CellSumsFindNeighbour_Private(PetscInt num, const PetscInt list[], PetscInt node)
{
  PetscInt at = 0;

  for (PetscInt k = 0; k < num; k++) at += list[k] < node;
  return at;
}

/* The nodes of some cells, ascending. [out] list - room for all of them, each as often as cells have it */
static void CellSumsListNeighbours_Private(const Level *level, PetscInt num_cells, const PetscInt cells[],
                                           PetscInt *num, PetscInt list[])
{
  *num = 0;
  for (PetscInt c = 0; c < num_cells; c++) {
    for (PetscInt i = level->cell_start[cells[c]]; i < level->cell_start[cells[c] + 1]; i++) {
      const PetscInt node = level->cell_nodes[i], at = CellSumsFindNeighbour_Private(*num, list, node);

      if (at < *num && list[at] == node) continue;
      for (PetscInt k = (*num)++; k > at; k--) list[k] = list[k - 1];
      list[at] = node;
    }
  }
}

PetscErrorCode CellSumsCreate(const Level *level, SymmetricBlocks *sums)
{
  const PetscInt num  = level->num_nodes;
  PetscInt       most = 0, size, *start, *column;
  Stars          stars;

  PetscFunctionBeginUser;
  PetscCall(CellSumsListCellsOfNodes_Private(level, &stars));
  for (PetscInt i = 0; i < stars.start[num]; i++)
    most += level->cell_start[stars.cell[i] + 1] - level->cell_start[stars.cell[i]];
  PetscCall(PetscMalloc1(num + 1, &start));
  PetscCall(PetscMalloc1(most, &column));
  start[0] = 0;
  for (PetscInt i = 0; i < num; i++) {
    CellSumsListNeighbours_Private(level, stars.start[i + 1] - stars.start[i], &stars.cell[stars.start[i]], &size,
                                   &column[start[i]]);
    start[i + 1] = start[i] + size;
  }
  PetscCall(PetscFree(stars.start));
  PetscCall(PetscFree(stars.cell));
  PetscCall(SymmetricBlocksCreate(level->dim, num, start, column, sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void CellSumsAdd(const Level *level, PetscInt cell, const PetscReal Ke[], SymmetricBlocks *sums)
{
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[cell]], dim = level->dim;
  const PetscInt  num = level->cell_start[cell + 1] - level->cell_start[cell], n = dim * num;

  for (PetscInt a = 0; a < num; a++) {
    for (PetscInt b = 0; b < num; b++) {
      PetscScalar *sum;

      if (nodes[b] < nodes[a]) continue;
      sum = SymmetricBlocksAt(sums, nodes[a], nodes[b]);
      for (PetscInt k = 0; k < dim; k++)
        for (PetscInt l = 0; l < dim; l++) sum[dim * k + l] += Ke[(dim * a + k) * n + dim * b + l];
    }
  }
}

/* The rows of this rank that no other rank adds to, and that have no node of another rank. Collective. [out]
   complete - [num_owned] */
static PetscErrorCode CellSumsFindComplete_Private(Level *level, const SymmetricBlocks *sums, PetscBool complete[])
{
  PetscScalar *mark;
  Vec          shared, local;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, &shared));
  PetscCall(VecGhostGetLocalForm(shared, &local));
  PetscCall(VecGetArray(local, &mark));
  for (PetscInt i = level->num_owned; i < level->num_nodes; i++) mark[i] = 1;
  PetscCall(VecRestoreArray(local, &mark));
  PetscCall(VecGhostRestoreLocalForm(shared, &local));
  PetscCall(LevelShareVec(shared, ADD_VALUES));
  PetscCall(VecGetArray(shared, &mark));
  for (PetscInt i = 0; i < level->num_owned; i++) // columns ascend, and nodes of other ranks are last
    complete[i] = (PetscBool)(mark[i] == 0 && sums->column[sums->start[i + 1] - 1] < level->num_owned);
  PetscCall(VecRestoreArray(shared, &mark));
  PetscCall(VecDestroy(&shared));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums over ranks, but for complete rows. */
static PetscErrorCode CellSumsGather_Private(Level *level, const SymmetricBlocks *sums, const PetscBool complete[],
                                             Mat *A)
{
  const PetscInt dim   = level->dim;
  PetscInt       width = 0, *nodes;
  PetscScalar   *rows;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < sums->num; i++) width = PetscMax(width, sums->start[i + 1] - sums->start[i]);
  PetscCall(PetscMalloc2(width, &nodes, dim * dim * width, &rows));
  PetscCall(LevelCreateMat(level, dim, A));
  for (PetscInt i = 0; i < sums->num; i++) {
    const PetscInt num = sums->start[i + 1] - sums->start[i];

    if (i < level->num_owned && complete[i]) continue;
    for (PetscInt j = 0; j < num; j++) nodes[j] = level->node_global[sums->column[sums->start[i] + j]];
    SymmetricBlocksGetRow(sums, i, dim * num, rows);
    PetscCall(MatSetValuesBlocked(*A, 1, &level->node_global[i], num, nodes, rows, ADD_VALUES));
  }
  PetscCall(PetscFree2(nodes, rows));
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CellSumsFinish(Level *level, SymmetricBlocks *sums, Mat *K)
{
  PetscMPIInt size;
  PetscBool  *complete;
  Mat         A;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(level->comm, &size));
  if (size == 1) { // nodes of this rank are all there are, in their order
    PetscCall(StiffnessCreate(level->comm, sums, K));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscMalloc1(level->num_owned, &complete));
  PetscCall(CellSumsFindComplete_Private(level, sums, complete));
  PetscCall(CellSumsGather_Private(level, sums, complete, &A));
  PetscCall(StiffnessCreateOfRows(A, sums, complete, K));
  PetscCall(PetscFree(complete));
  PetscCall(SymmetricBlocksDestroy(sums));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(PETSC_SUCCESS);
}
