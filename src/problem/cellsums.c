/* cellsums.c -- sums of cell matrices before they enter a Mat.

   A Mat looks for every entry by itself, and moves others out of its way. Here nodes are looked for, once for all entries of a block,
   and rows reach the Mat complete and in order; what belongs to rows of other ranks goes there once, in sums. These are made in the order
   of the cells. */
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

/* Where a node is in an ascending list, or would be: lists are so short that comparing all is faster than to branch. */
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

PetscErrorCode CellSumsCreate(const Level *level, Gather *gather)
{
  const PetscInt num  = level->num_nodes;
  PetscInt       most = 0, size;
  Stars          stars;

  PetscFunctionBeginUser;
  gather->level = level;
  PetscCall(CellSumsListCellsOfNodes_Private(level, &stars));
  for (PetscInt i = 0; i < stars.start[num]; i++)
    most += level->cell_start[stars.cell[i] + 1] - level->cell_start[stars.cell[i]];
  PetscCall(PetscMalloc1(num + 1, &gather->start));
  PetscCall(PetscMalloc1(most, &gather->node));
  gather->start[0] = 0;
  for (PetscInt i = 0; i < num; i++) {
    CellSumsListNeighbours_Private(level, stars.start[i + 1] - stars.start[i], &stars.cell[stars.start[i]], &size,
                                   &gather->node[gather->start[i]]);
    gather->start[i + 1] = gather->start[i] + size;
  }
  PetscCall(PetscFree(stars.start));
  PetscCall(PetscFree(stars.cell));
  PetscCall(PetscCalloc1((size_t)gather->start[num] * level->dim * level->dim, &gather->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds one block of a cell's matrix to a node's rows. [in] Ke - the block, in rows of n */
static inline void CellSumsAddBlock_Private(PetscInt dim, PetscInt n, const PetscReal Ke[], PetscInt width,
                                            PetscReal rows[])
{
  for (PetscInt k = 0; k < dim; k++)
    for (PetscInt l = 0; l < dim; l++) rows[k * width + l] += Ke[k * n + l];
}

void CellSumsAdd(Gather *gather, PetscInt cell, const PetscReal Ke[])
{
  const Level    *level = gather->level;
  const PetscInt *nodes = &level->cell_nodes[level->cell_start[cell]], dim = level->dim;
  const PetscInt  num = level->cell_start[cell + 1] - level->cell_start[cell], n = dim * num;

  for (PetscInt a = 0; a < num; a++) {
    const PetscInt begin = gather->start[nodes[a]], size = gather->start[nodes[a] + 1] - begin;

    for (PetscInt b = 0; b < num; b++) {
      const PetscInt at = CellSumsFindNeighbour_Private(size, &gather->node[begin], nodes[b]);

      CellSumsAddBlock_Private(dim, n, &Ke[(dim * a) * n + dim * b], dim * size,
                               &gather->value[(size_t)begin * dim * dim + dim * at]);
    }
  }
}

PetscErrorCode CellSumsFinish(Gather *gather, Mat K)
{
  const Level *level = gather->level;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < gather->start[level->num_nodes]; i++) gather->node[i] = level->node_global[gather->node[i]];
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    const PetscInt begin = gather->start[i];

    PetscCall(MatSetValuesBlocked(K, 1, &level->node_global[i], gather->start[i + 1] - begin, &gather->node[begin],
                                  &gather->value[(size_t)begin * level->dim * level->dim], ADD_VALUES));
  }
  PetscCall(PetscFree(gather->start));
  PetscCall(PetscFree(gather->node));
  PetscCall(PetscFree(gather->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}
