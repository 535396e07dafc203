/* cellsums.c -- K as a sum of cell matrices.

   The functions of a cell whose nodes hang on larger cells are those of these cells. Its matrix is that of
   their nodes before it is added.

   A Mat searches the place of every entry, and moves other entries to make room. Here nodes are searched,
   once for all entries of a block. Blocks in rows of other ranks are sent once, as sums, which are made in
   the order of the cells; their owner adds them in the order of the ranks. */
#include "problem/cellsums.h"
#include "base/compat.h"
#include "level/exchange.h"

enum { N = ELEMENT_MAX_NODES, MOST_CARRIED = 9 /* nodes that one hangs on: those of a quad9 */ };

/* The nodes that the functions of a cell belong to: its own ones, and those of larger cells that others of
   them hang on. */
typedef struct {
  PetscInt  num, node[2 * N]; /* larger cells are neighbours of the cell that this one is a part of */
  PetscInt  start[N + 1];     /* of each of the cell's own nodes */
  PetscInt  at[MOST_CARRIED * N];
  PetscReal weight[MOST_CARRIED * N];
} Carriers;

static void CarriersAdd_Private(Carriers *carriers, PetscInt place, PetscInt node, PetscReal weight)
{
  PetscInt at = 0;

  while (at < carriers->num && carriers->node[at] != node) at++;
  if (at == carriers->num) carriers->node[carriers->num++] = node;
  carriers->at[place]     = at;
  carriers->weight[place] = weight;
}

/* Returns whether nodes hang. */
static PetscBool CarriersSet_Private(const Level *level, PetscInt cell, Carriers *carriers)
{
  const Hanging  *hanging = &level->hanging;
  const PetscInt *nodes   = &level->cell_nodes[level->cell_start[cell]];
  const PetscInt  num     = level->cell_start[cell + 1] - level->cell_start[cell];
  PetscInt        place   = 0;
  PetscBool       any     = PETSC_FALSE;

  carriers->num = 0;
  for (PetscInt i = 0; i < num; i++) {
    carriers->start[i] = place;
    if (LevelNodeHangs(level, nodes[i])) {
      any = PETSC_TRUE;
      for (PetscInt k = hanging->start[nodes[i]]; k < hanging->start[nodes[i] + 1]; k++)
        CarriersAdd_Private(carriers, place++, hanging->node[k], hanging->weight[k]);
    } else {
      CarriersAdd_Private(carriers, place++, nodes[i], 1);
    }
  }
  carriers->start[num] = place;
  return any;
}

/* Nodes that K couples with each other: those of each cell, and each hanging node of this rank with the nodes
   it hangs on (conforming.h). */
typedef struct {
  PetscInt  num;
  PetscInt *start, *node; /* [num + 1], [start[num]] */
} Groups;

static PetscErrorCode GroupsCreate_Private(const Level *level, Groups *groups)
{
  const Hanging *hanging = &level->hanging;
  Carriers       carriers;

  PetscFunctionBeginUser;
  groups->num = level->num_cells;
  for (PetscInt i = 0; i < level->num_owned; i++) groups->num += LevelNodeHangs(level, i);
  PetscCall(PetscMalloc1(groups->num + 1, &groups->start));
  groups->start[0] = 0;
  for (int pass = 0; pass < 2; pass++) {
    PetscInt at = level->num_cells;

    if (pass) PetscCall(PetscMalloc1(groups->start[groups->num], &groups->node));
    for (PetscInt c = 0; c < level->num_cells; c++) {
      (void)CarriersSet_Private(level, c, &carriers);
      groups->start[c + 1] = groups->start[c] + carriers.num;
      if (pass) PetscCall(PetscArraycpy(&groups->node[groups->start[c]], carriers.node, carriers.num));
    }
    for (PetscInt i = 0; i < level->num_owned; i++) {
      const PetscInt num = hanging->start ? hanging->start[i + 1] - hanging->start[i] : 0;

      if (!num) continue;
      groups->start[at + 1] = groups->start[at] + num + 1;
      if (pass) {
        groups->node[groups->start[at]] = i;
        PetscCall(PetscArraycpy(&groups->node[groups->start[at] + 1], &hanging->node[hanging->start[i]], num));
      }
      at++;
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The groups of every node, ghosts included. */
typedef struct {
  PetscInt *start, *group; /* [num_nodes+1], [start[num_nodes]] */
} Stars;

static PetscErrorCode CellSumsListGroupsOfNodes_Private(const Level *level, const Groups *groups, Stars *stars)
{
  const PetscInt num = level->num_nodes;
  PetscInt      *start;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(num + 2, &stars->start)); // one place ahead, until all groups are listed
  start = &stars->start[1];
  for (PetscInt i = 0; i < groups->start[groups->num]; i++) start[groups->node[i] + 1]++;
  for (PetscInt i = 0; i < num; i++) start[i + 1] += start[i];
  PetscCall(PetscMalloc1(start[num], &stars->group));
  for (PetscInt g = 0; g < groups->num; g++)
    for (PetscInt i = groups->start[g]; i < groups->start[g + 1]; i++) stars->group[start[groups->node[i]]++] = g;
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

/* The nodes of some groups, ascending. [out] list - room for all of them, each as often as groups have it */
static void CellSumsListNeighbours_Private(const Groups *groups, PetscInt num_groups, const PetscInt group[],
                                           PetscInt *num, PetscInt list[])
{
  *num = 0;
  for (PetscInt g = 0; g < num_groups; g++) {
    for (PetscInt i = groups->start[group[g]]; i < groups->start[group[g] + 1]; i++) {
      const PetscInt node = groups->node[i], at = CellSumsFindNeighbour_Private(*num, list, node);

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
  Groups         groups;
  Stars          stars;

  PetscFunctionBeginUser;
  PetscCall(GroupsCreate_Private(level, &groups));
  PetscCall(CellSumsListGroupsOfNodes_Private(level, &groups, &stars));
  for (PetscInt i = 0; i < stars.start[num]; i++)
    most += groups.start[stars.group[i] + 1] - groups.start[stars.group[i]];
  PetscCall(PetscMalloc1(num + 1, &start));
  PetscCall(PetscMalloc1(most + num, &column));
  start[0] = 0;
  for (PetscInt i = 0; i < num; i++) {
    CellSumsListNeighbours_Private(&groups, stars.start[i + 1] - stars.start[i], &stars.group[stars.start[i]], &size,
                                   &column[start[i]]);
    if (!size) column[start[i] + size++] = i; // of no group of this rank
    start[i + 1] = start[i] + size;
  }
  PetscCall(PetscFree(stars.start));
  PetscCall(PetscFree(stars.group));
  PetscCall(PetscFree(groups.start));
  PetscCall(PetscFree(groups.node));
  PetscCall(SymmetricBlocksCreate(level->dim, num, start, column, sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void CellSumsAddNodes(PetscInt num, const PetscInt nodes[], const PetscReal A[], SymmetricBlocks *sums)
{
  const PetscInt dim = sums->bs, n = dim * num;

  for (PetscInt a = 0; a < num; a++) {
    for (PetscInt b = 0; b < num; b++) {
      PetscScalar *sum;

      if (nodes[b] < nodes[a]) continue;
      sum = SymmetricBlocksAt(sums, nodes[a], nodes[b]);
      for (PetscInt k = 0; k < dim; k++)
        for (PetscInt l = 0; l < dim; l++) sum[dim * k + l] += A[(dim * a + k) * n + dim * b + l];
    }
  }
}

/* B += the rows of A, times their weights, in the places of the nodes that they hang on.
   [in] A - [dim * number of the cell's nodes][n]; [out] B - [dim * carriers->num][n] */
static void CarriersCollect_Private(const Carriers *carriers, PetscInt num, PetscInt dim, PetscInt n,
                                    const PetscReal A[], PetscReal B[])
{
  for (PetscInt i = 0; i < dim * carriers->num * n; i++) B[i] = 0;
  for (PetscInt a = 0; a < num; a++)
    for (PetscInt k = carriers->start[a]; k < carriers->start[a + 1]; k++)
      for (PetscInt i = 0; i < dim * n; i++)
        B[dim * n * carriers->at[k] + i] += carriers->weight[k] * A[dim * n * a + i];
}

static void CellSumsTranspose_Private(PetscInt rows, PetscInt columns, const PetscReal A[], PetscReal B[])
{
  for (PetscInt i = 0; i < rows; i++)
    for (PetscInt j = 0; j < columns; j++) B[j * rows + i] = A[i * columns + j];
}

void CellSumsAdd(const Level *level, PetscInt cell, const PetscReal Ke[], SymmetricBlocks *sums)
{
  const PetscInt num = level->cell_start[cell + 1] - level->cell_start[cell], dim = level->dim, n = dim * num;
  Carriers       carriers;
  PetscReal      half[6 * N * 3 * N], across[3 * N * 6 * N], whole[6 * N * 6 * N];

  if (!level->hanging.start || !CarriersSet_Private(level, cell, &carriers)) {
    CellSumsAddNodes(num, &level->cell_nodes[level->cell_start[cell]], Ke, sums);
    return;
  }
  CarriersCollect_Private(&carriers, num, dim, n, Ke, half);
  CellSumsTranspose_Private(dim * carriers.num, n, half, across);
  CarriersCollect_Private(&carriers, num, dim, dim * carriers.num, across, whole);
  CellSumsAddNodes(carriers.num, carriers.node, whole, sums);
}

/* What is added to one block of K. */
typedef struct {
  PetscInt    row, column;                                        /* global numbers of nodes */
  PetscScalar value[SYMMETRIC_BLOCKS_MAX * SYMMETRIC_BLOCKS_MAX]; /* [bs][bs] */
} SumBlock;

/* Blocks in rows of other ranks. [out] owner - of each row [num]; both freed by the caller */
static PetscErrorCode CellSumsListBlocks_Private(const Level *level, const PetscInt global[],
                                                 const SymmetricBlocks *sums, PetscInt *num, SumBlock **blocks,
                                                 PetscMPIInt **owner)
{
  const PetscInt bs    = sums->bs;
  PetscInt       width = 0;
  PetscScalar   *rows;
  PetscLayout    layout;

  PetscFunctionBeginUser;
  *num = 0;
  for (PetscInt i = level->num_owned; i < sums->num; i++) {
    width = PetscMax(width, sums->start[i + 1] - sums->start[i]);
    *num += sums->start[i + 1] - sums->start[i];
  }
  PetscCall(PetscMalloc1(bs * bs * width, &rows));
  PetscCall(PetscCalloc1(*num, blocks)); // all of a block is sent
  PetscCall(PetscMalloc1(*num, owner));
  *num = 0;
  for (PetscInt i = level->num_owned; i < sums->num; i++) {
    const PetscInt length = bs * (sums->start[i + 1] - sums->start[i]);

    SymmetricBlocksGetRow(sums, i, length, rows);
    for (PetscInt at = sums->start[i]; at < sums->start[i + 1]; at++) {
      SumBlock *block = &(*blocks)[(*num)++];

      block->row    = global[i];
      block->column = global[sums->column[at]];
      for (PetscInt kl = 0; kl < bs * bs; kl++)
        block->value[kl] = rows[kl / bs * length + bs * (at - sums->start[i]) + kl % bs];
    }
  }
  PetscCall(PetscFree(rows));
  PetscCall(PetscLayoutCreateFromSizes(level->comm, level->num_owned, PETSC_DETERMINE, 1, &layout));
  for (PetscInt k = 0; k < *num; k++) PetscCall(PetscLayoutFindOwner(layout, (*blocks)[k].row, &(*owner)[k]));
  PetscCall(PetscLayoutDestroy(&layout));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Blocks that this rank's rows get from the ranks, by rows, and for each row in the order of ranks. */
typedef struct {
  PetscInt  num, *start; /* [own nodes + 1] */
  SumBlock *block;       /* [num] */
} ReceivedBlocks;

static PetscErrorCode CellSumsExchange_Private(const Level *level, const PetscInt global[], const SymmetricBlocks *sums,
                                               ReceivedBlocks *received)
{
  PetscInt     num, *fill;
  PetscMPIInt *owner;
  SumBlock    *sent, *blocks;
  Exchange     exchange;

  PetscFunctionBeginUser;
  PetscCall(CellSumsListBlocks_Private(level, global, sums, &num, &sent, &owner));
  PetscCall(ExchangeCreate(level->comm, num, owner, &exchange));
  received->num = exchange.num;
  PetscCall(PetscMalloc1(exchange.num, &blocks));
  PetscCall(ExchangeSend(&exchange, sizeof(SumBlock), sent, blocks));
  PetscCall(ExchangeDestroy(&exchange));
  PetscCall(PetscFree(sent));
  PetscCall(PetscFree(owner));
  PetscCall(PetscMalloc1(received->num, &received->block));
  PetscCall(PetscCalloc1(level->num_owned + 2, &fill)); // one place ahead, until all are sorted
  for (PetscInt k = 0; k < received->num; k++) fill[blocks[k].row - level->node_begin + 2]++;
  for (PetscInt i = 0; i < level->num_owned; i++) fill[i + 2] += fill[i + 1];
  for (PetscInt k = 0; k < received->num; k++)
    received->block[fill[blocks[k].row - level->node_begin + 1]++] = blocks[k];
  received->start = fill;
  PetscCall(PetscFree(blocks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What makes up the rows of this rank. */
typedef struct {
  const Level     *level;
  const PetscInt  *global; /* numbers of nodes [sums->num] */
  SymmetricBlocks *sums;
  ReceivedBlocks   received;
  PetscBool       *kept; /* rows that no other rank adds to, without nodes of other ranks [own nodes] */
} RankSums;

static PetscErrorCode RankSumsFindKept_Private(RankSums *rank)
{
  const SymmetricBlocks *sums = rank->sums;
  const PetscInt         n = rank->level->num_owned, *start = rank->received.start;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &rank->kept));
  for (PetscInt i = 0; i < n; i++) // columns ascend, and nodes of other ranks are last
    rank->kept[i] = (PetscBool)(start[i] == start[i + 1] && sums->column[sums->start[i + 1] - 1] < n);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All columns of a row, global numbers, ascending. [out] list - room for them [num] */
static PetscErrorCode RankSumsListColumns_Private(const RankSums *rank, PetscInt i, PetscInt *num, PetscInt list[])
{
  const SymmetricBlocks *sums     = rank->sums;
  const ReceivedBlocks  *received = &rank->received;

  PetscFunctionBeginUser;
  *num = 0;
  for (PetscInt at = sums->start[i]; at < sums->start[i + 1]; at++) list[(*num)++] = rank->global[sums->column[at]];
  for (PetscInt k = received->start[i]; k < received->start[i + 1]; k++) list[(*num)++] = received->block[k].column;
  PetscCall(PetscSortRemoveDupsInt(num, list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The columns of all rows: own ones, counted from the first, and those of other ranks, by global numbers.
   [out] start, column - owned by the caller; [out] others - without nodes and values */
static PetscErrorCode RankSumsSetPattern_Private(const RankSums *rank, PetscInt **start, PetscInt **column,
                                                 GhostBlocks *others)
{
  const SymmetricBlocks *sums = rank->sums;
  const PetscInt         n = rank->level->num_owned, begin = rank->level->node_begin,
                 room = sums->start[n] + rank->received.num;
  PetscInt *list, size;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n + 1, start));
  PetscCall(PetscMalloc1(n + 1, &others->start));
  PetscCall(PetscMalloc1(room, column)); // untouched pages take no memory
  PetscCall(PetscMalloc1(room, &others->column));
  PetscCall(PetscMalloc1(room, &list));
  (*start)[0] = others->start[0] = 0;
  for (PetscInt i = 0; i < n; i++) {
    (*start)[i + 1]      = (*start)[i];
    others->start[i + 1] = others->start[i];
    if (rank->kept[i]) {
      size = sums->start[i + 1] - sums->start[i];
      PetscCall(PetscArraycpy(&(*column)[(*start)[i]], &sums->column[sums->start[i]], size));
      (*start)[i + 1] += size;
      continue;
    }
    PetscCall(RankSumsListColumns_Private(rank, i, &size, list));
    for (PetscInt k = 0; k < size; k++) {
      if (list[k] >= begin && list[k] < begin + n)
        (*column)[(*start)[i + 1]++] = list[k] - begin;
      else
        others->column[others->start[i + 1]++] = list[k];
    }
  }
  PetscCall(PetscFree(list));
  PetscCall(PetscRealloc((size_t)(*start)[n] * sizeof(PetscInt), column));
  PetscCall(PetscRealloc((size_t)others->start[n] * sizeof(PetscInt), &others->column));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds a block to row i, but not left of the diagonal. */
static PetscErrorCode RankSumsAddBlock_Private(const Level *level, PetscInt i, PetscInt column,
                                               const PetscScalar value[], SymmetricBlocks *own, GhostBlocks *others)
{
  const PetscInt square = own->bs * own->bs, j = column - level->node_begin;
  PetscScalar   *sum = NULL;
  PetscInt       at;

  PetscFunctionBeginUser;
  if (j < 0 || j >= level->num_owned) {
    PetscCall(PetscFindInt(column, others->start[i + 1] - others->start[i], &others->column[others->start[i]], &at));
    sum = &others->value[(size_t)(others->start[i] + at) * (size_t)square];
  } else if (j >= i) {
    sum = SymmetricBlocksAt(own, i, j);
  }
  for (PetscInt kl = 0; kl < square && sum; kl++) sum[kl] += value[kl];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The values of the rows that are not kept. */
static PetscErrorCode RankSumsSetValues_Private(const RankSums *rank, SymmetricBlocks *own, GhostBlocks *others)
{
  const PetscInt         square   = own->bs * own->bs;
  const SymmetricBlocks *sums     = rank->sums;
  const ReceivedBlocks  *received = &rank->received;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)others->start[own->num] * (size_t)square, &others->value));
  for (PetscInt i = 0; i < own->num; i++) {
    const PetscScalar *V = &sums->value[(size_t)sums->first[i] * (size_t)square];

    if (rank->kept[i]) continue;
    for (PetscInt at = sums->diagonal[i]; at < sums->start[i + 1]; at++, V += square)
      PetscCall(RankSumsAddBlock_Private(rank->level, i, rank->global[sums->column[at]], V, own, others));
    for (PetscInt k = received->start[i]; k < received->start[i + 1]; k++)
      PetscCall(
          RankSumsAddBlock_Private(rank->level, i, received->block[k].column, received->block[k].value, own, others));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Lists the nodes of other ranks: from now on columns are places in this list. */
static PetscErrorCode RankSumsNumberGhosts_Private(PetscInt num_rows, GhostBlocks *others)
{
  const PetscInt num = others->start[num_rows];

  PetscFunctionBeginUser;
  others->num = num;
  PetscCall(PetscMalloc1(num, &others->node));
  PetscCall(PetscArraycpy(others->node, others->column, num));
  PetscCall(PetscSortRemoveDupsInt(&others->num, others->node));
  for (PetscInt k = 0; k < num; k++)
    PetscCall(PetscFindInt(others->column[k], others->num, others->node, &others->column[k]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CellSumsFinish(const Level *level, const PetscInt global[], SymmetricBlocks *sums, Mat *K)
{
  PetscMPIInt     size;
  PetscInt       *start, *column;
  RankSums        rank = {.level = level, .global = global, .sums = sums};
  SymmetricBlocks own;
  GhostBlocks     others = {.num = 0};

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(level->comm, &size));
  if (size == 1) { // nodes of this rank are all there are, in their order
    PetscCall(StiffnessCreate(level->comm, sums, NULL, K));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(CellSumsExchange_Private(level, global, sums, &rank.received));
  PetscCall(RankSumsFindKept_Private(&rank));
  PetscCall(RankSumsSetPattern_Private(&rank, &start, &column, &others));
  PetscCall(SymmetricBlocksCreateWithin(level->num_owned, start, column, rank.kept, sums, &own));
  PetscCall(RankSumsSetValues_Private(&rank, &own, &others));
  PetscCall(PetscFree(rank.received.start));
  PetscCall(PetscFree(rank.received.block));
  PetscCall(PetscFree(rank.kept));
  sums->value = NULL; // now of own
  PetscCall(SymmetricBlocksDestroy(sums));
  PetscCall(RankSumsNumberGhosts_Private(level->num_owned, &others));
  PetscCall(StiffnessCreate(level->comm, &own, &others, K));
  PetscFunctionReturn(PETSC_SUCCESS);
}
