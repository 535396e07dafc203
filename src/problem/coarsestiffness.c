/* coarsestiffness.c -- the stiffness of a coarser level as P'K P.

   MatPtAP() has every entry of an AIJ copy of K, nine for a pair of nodes in space. It finds out which
   entries the product has. Here blocks are summed up in the places that coarse cells have. A rank adds what
   its rows of K give. Couplings to nodes of other ranks count half, since those ranks have them too. */
#include "base/compat.h"
#include "problem/cellsums.h"
#include "problem/coarsestiffness.h"
#include "problem/conforming.h"

/* Rows of P: those of this rank's fine nodes, then of its ghosts. */
typedef struct {
  PetscInt           num;
  const PetscInt    *start, *column; /* coarse nodes: of the level, then more ghosts */
  const PetscScalar *value;
} Weights;

typedef struct {
  SymmetricBlocks C;
  PetscBool       missing; /* whether it has no place for some block */
} Product;

/* C_ab += w V, or w V', for a <= b */
static inline void CoarseStiffnessAdd_Private(PetscInt bs, PetscInt a, PetscInt b, PetscReal w, PetscBool transposed,
                                              const PetscScalar V[], Product *product)
{
  const SymmetricBlocks *C   = &product->C;
  PetscScalar           *sum = SymmetricBlocksAt(C, a, b);
  const PetscInt         at  = (PetscInt)((size_t)(sum - C->value) / (size_t)(bs * bs)) - C->first[a];

  if (C->column[C->diagonal[a] + at] != b) {
    product->missing = PETSC_TRUE;
    return;
  }
  for (PetscInt k = 0; k < bs; k++)
    for (PetscInt l = 0; l < bs; l++) sum[bs * k + l] += w * (transposed ? V[bs * l + k] : V[bs * k + l]);
}

/* One row of blocks of (U + D/2 + O/2) P, K = U + D + U' between nodes of this rank, O those to ghosts. */
typedef struct {
  PetscInt     num, *column; /* [num] */
  PetscBool   *listed;       /* [coarse nodes] */
  PetscScalar *value;        /* 0 where not listed [coarse nodes][bs][bs] */
} HalfRow;

/* row += w V P_j */
static inline void CoarseStiffnessAddToRow_Private(PetscInt bs, const PetscScalar V[], PetscReal w, PetscInt j,
                                                   const Weights *P, HalfRow *row)
{
  for (PetscInt q = P->start[j]; q < P->start[j + 1]; q++) {
    const PetscInt  b = P->column[q];
    const PetscReal p = PetscRealPart(P->value[q]) * w;

    if (!row->listed[b]) row->column[row->num++] = b;
    row->listed[b] = PETSC_TRUE;
    for (PetscInt k = 0; k < bs * bs; k++) row->value[bs * bs * b + k] += p * V[k];
  }
}

/* Sums up row i. */
static inline void CoarseStiffnessSetRow_Private(PetscInt bs, const SymmetricBlocks *K, const GhostBlocks *others,
                                                 PetscInt i, const Weights *P, HalfRow *row)
{
  const PetscScalar *V = &K->value[(size_t)K->first[i] * (size_t)(bs * bs)];

  for (PetscInt at = K->diagonal[i]; at < K->start[i + 1]; at++, V += bs * bs)
    CoarseStiffnessAddToRow_Private(bs, V, K->column[at] == i ? 0.5 : 1, K->column[at], P, row);
  for (PetscInt at = others->start ? others->start[i] : 0; at < (others->start ? others->start[i + 1] : 0); at++)
    CoarseStiffnessAddToRow_Private(bs, &others->value[(size_t)at * (size_t)(bs * bs)], 0.5,
                                    K->num + others->column[at], P, row);
}

/* C += P'(U + D/2 + O/2) P + its transpose. To be inlined where bs is known. */
static inline void CoarseStiffnessSum_Private(PetscInt bs, const SymmetricBlocks *K, const GhostBlocks *others,
                                              const Weights *P, HalfRow *row, Product *product)
{
  for (PetscInt i = 0; i < K->num; i++) {
    CoarseStiffnessSetRow_Private(bs, K, others, i, P, row);
    while (row->num > 0) {
      const PetscInt b = row->column[--row->num];
      PetscScalar   *V = &row->value[bs * bs * b];

      for (PetscInt p = P->start[i]; p < P->start[i + 1]; p++) {
        const PetscInt  a = P->column[p];
        const PetscReal w = PetscRealPart(P->value[p]);

        if (a <= b) CoarseStiffnessAdd_Private(bs, a, b, w, PETSC_FALSE, V, product);
        if (b <= a) CoarseStiffnessAdd_Private(bs, b, a, w, PETSC_TRUE, V, product);
      }
      for (PetscInt k = 0; k < bs * bs; k++) V[k] = 0;
      row->listed[b] = PETSC_FALSE;
    }
  }
}

/* Coarse nodes in the numbering of the product. */
typedef struct {
  PetscInt  num, *global; /* nodes of the level, then more ghosts [num] */
  PetscInt *sorted, *at;  /* numbers of all ghosts, ascending, and their places [num - own ones] */
} CoarseNodes;

static PetscErrorCode CoarseNodesFind_Private(const Level *coarse, const CoarseNodes *nodes, PetscInt global,
                                              PetscInt *node)
{
  PetscInt at;

  PetscFunctionBeginUser;
  *node = global - coarse->node_begin;
  if (*node >= 0 && *node < coarse->num_owned) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscFindInt(global, nodes->num - coarse->num_owned, nodes->sorted, &at));
  *node = nodes->at[at];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in] num, column - columns of P, global numbers [num] */
static PetscErrorCode CoarseNodesCreate_Private(const Level *coarse, PetscInt num, const PetscInt column[],
                                                CoarseNodes *nodes)
{
  const PetscInt own = coarse->num_owned, ghosts = coarse->num_nodes - own;
  PetscInt      *list, size                      = 0, at;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num + ghosts, &list));
  PetscCall(PetscMalloc2(num + ghosts, &nodes->sorted, num + ghosts, &nodes->at));
  for (PetscInt i = 0; i < ghosts; i++) list[i] = nodes->sorted[i] = coarse->node_global[own + i];
  size = ghosts;
  PetscCall(PetscSortInt(size, nodes->sorted));
  for (PetscInt k = 0; k < num; k++) {
    if (column[k] >= coarse->node_begin && column[k] < coarse->node_begin + own) continue;
    PetscCall(PetscFindInt(column[k], ghosts, nodes->sorted, &at));
    if (at < 0) list[size++] = column[k];
  }
  size -= ghosts;
  PetscCall(PetscSortRemoveDupsInt(&size, &list[ghosts]));
  nodes->num = coarse->num_nodes + size;
  PetscCall(PetscMalloc1(nodes->num, &nodes->global));
  PetscCall(PetscArraycpy(nodes->global, coarse->node_global, coarse->num_nodes));
  PetscCall(PetscArraycpy(&nodes->global[coarse->num_nodes], &list[ghosts], size));
  for (PetscInt i = own; i < nodes->num; i++) {
    nodes->sorted[i - own] = nodes->global[i];
    nodes->at[i - own]     = i;
  }
  PetscCall(PetscSortIntWithArray(nodes->num - own, nodes->sorted, nodes->at));
  PetscCall(PetscFree(list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode CoarseNodesDestroy_Private(CoarseNodes *nodes)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(nodes->global));
  PetscCall(PetscFree2(nodes->sorted, nodes->at));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows of P of the ghosts of K, with all of its columns. [out] theirs - owned by the caller */
static PetscErrorCode WeightsGetGhosts_Private(Mat K, PetscInt bs, PetscInt num, Mat nodal, Mat **theirs)
{
  const PetscInt *unknowns;
  PetscInt       *list, N;
  IS              rows, columns;

  PetscFunctionBeginUser;
  PetscCall(MatGetGhosts(K, NULL, &unknowns));
  PetscCall(PetscMalloc1(num, &list));
  for (PetscInt i = 0; i < num; i++) list[i] = unknowns[bs * i] / bs;
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, list, PETSC_OWN_POINTER, &rows));
  PetscCall(MatGetSize(nodal, NULL, &N));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, N, 0, 1, &columns));
  PetscCall(ISSetIdentity(columns));
  PetscCall(MatCreateSubMatrices(nodal, 1, &rows, &columns, MAT_INITIAL_MATRIX, theirs));
  PetscCall(ISDestroy(&rows));
  PetscCall(ISDestroy(&columns));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Copies of the rows, with global columns. [out] start, column, value - owned by the caller */
static PetscErrorCode WeightsCopy_Private(PetscInt own, Mat nodal, PetscInt ghosts, Mat theirs, PetscInt **start,
                                          PetscInt **column, PetscScalar **value)
{
  PetscInt begin, num;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(nodal, &begin, NULL));
  PetscCall(PetscMalloc1(own + ghosts + 1, start));
  (*start)[0] = 0;
  for (int pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(PetscMalloc2((*start)[own + ghosts], column, (*start)[own + ghosts], value));
    for (PetscInt i = 0; i < own + ghosts; i++) {
      const PetscInt     row = i < own ? begin + i : i - own;
      const PetscInt    *columns;
      const PetscScalar *values;

      PetscCall(MatGetRow(i < own ? nodal : theirs, row, &num, &columns, &values));
      (*start)[i + 1] = (*start)[i] + num;
      if (pass) PetscCall(PetscArraycpy(&(*column)[(*start)[i]], columns, num));
      if (pass) PetscCall(PetscArraycpy(&(*value)[(*start)[i]], values, num));
      PetscCall(MatRestoreRow(i < own ? nodal : theirs, row, &num, &columns, &values));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Pairs of coarse nodes that couplings to ghosts connect. [out] row, column - or NULL to count only [num] */
static void CoarseStiffnessListPairs_Private(const SymmetricBlocks *K, const GhostBlocks *others, const Weights *P,
                                             PetscInt *num, PetscInt row[], PetscInt column[])
{
  *num = 0;
  for (PetscInt i = 0; i < K->num; i++) {
    for (PetscInt at = others->start[i]; at < others->start[i + 1]; at++) {
      const PetscInt j = K->num + others->column[at];

      for (PetscInt p = P->start[i]; p < P->start[i + 1]; p++) {
        for (PetscInt q = P->start[j]; q < P->start[j + 1]; q++, *num += 2) {
          if (!row) continue;
          row[*num] = column[*num + 1] = P->column[p];
          row[*num + 1] = column[*num] = P->column[q];
        }
      }
    }
  }
}

/* The product without values: pairs of nodes of coarse cells, and those of these pairs. [in] nodes - of the
   coarse level, and more ghosts */
static PetscErrorCode CoarseStiffnessCreatePattern_Private(const Level *coarse, PetscInt nodes, PetscInt num,
                                                           const PetscInt row[], const PetscInt other[],
                                                           SymmetricBlocks *C)
{
  PetscInt       *room, *start, *column;
  SymmetricBlocks cells;

  PetscFunctionBeginUser;
  PetscCall(CellSumsCreate(coarse, &cells));
  PetscCall(PetscCalloc1(nodes + 1, &room));
  PetscCall(PetscMalloc1(nodes + 1, &start));
  for (PetscInt k = 0; k < num; k++) room[row[k] + 1]++;
  for (PetscInt i = 0; i < nodes; i++)
    room[i + 1] += room[i] + (i < cells.num ? cells.start[i + 1] - cells.start[i] : 1);
  PetscCall(PetscMalloc1(room[nodes], &column));
  for (PetscInt i = 0; i < cells.num; i++) {
    const PetscInt size = cells.start[i + 1] - cells.start[i];

    PetscCall(PetscArraycpy(&column[room[i]], &cells.column[cells.start[i]], size));
    room[i] += size;
  }
  for (PetscInt i = cells.num; i < nodes; i++) column[room[i]++] = i;
  for (PetscInt k = 0; k < num; k++) column[room[row[k]]++] = other[k];
  start[0] = 0;
  for (PetscInt i = 0; i < nodes; i++) { // room[i] is now the end of row i
    const PetscInt from = i ? room[i - 1] : 0;
    PetscInt       size = room[i] - from;

    if (i >= cells.num || size > cells.start[i + 1] - cells.start[i])
      PetscCall(PetscSortRemoveDupsInt(&size, &column[from]));
    for (PetscInt k = 0; k < size; k++) column[start[i] + k] = column[from + k];
    start[i + 1] = start[i] + size;
  }
  PetscCall(PetscFree(room));
  PetscCall(SymmetricBlocksCreate(cells.bs, nodes, start, column, C));
  PetscCall(SymmetricBlocksDestroy(&cells));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All sums of this rank. [in,out] C - without values */
static PetscErrorCode CoarseStiffnessSetValues_Private(const SymmetricBlocks *K, const GhostBlocks *others,
                                                       const Weights *P, SymmetricBlocks *C)
{
  HalfRow row = {.num = 0};
  Product sum = {.C = *C, .missing = PETSC_FALSE};

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(C->num, &row.column, C->num, &row.listed, C->num * K->bs * K->bs, &row.value));
  if (K->bs == 2)
    CoarseStiffnessSum_Private(2, K, others, P, &row, &sum);
  else
    CoarseStiffnessSum_Private(3, K, others, P, &row, &sum);
  PetscCall(PetscFree3(row.column, row.listed, row.value));
  PetscCheck(!sum.missing, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A fine cell is no part of a coarse one");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The product block by block, on one process. */
static PetscErrorCode CoarseStiffnessCreateAlone_Private(Level *coarse, const SymmetricBlocks *K, Mat nodal,
                                                         Mat *product)
{
  const GhostBlocks none = {.num = 0};
  Weights           P;
  SymmetricBlocks   C;
  PetscBool         done;

  PetscFunctionBeginUser;
  PetscCall(CellSumsCreate(coarse, &C));
  PetscCall(MatGetRowIJ(nodal, 0, PETSC_FALSE, PETSC_FALSE, &P.num, &P.start, &P.column, &done));
  PetscCheck(done && P.num == K->num, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A prolongation of other nodes");
  PetscCall(MatSeqAIJGetArrayRead(nodal, &P.value));
  PetscCall(CoarseStiffnessSetValues_Private(K, &none, &P, &C));
  PetscCall(MatSeqAIJRestoreArrayRead(nodal, &P.value));
  PetscCall(MatRestoreRowIJ(nodal, 0, PETSC_FALSE, PETSC_FALSE, &P.num, &P.start, &P.column, &done));
  PetscCall(ConformingHold(coarse, coarse->node_global, &C));
  PetscCall(CellSumsFinish(coarse, coarse->node_global, &C, product));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The same on several ranks. */
static PetscErrorCode CoarseStiffnessCreateTogether_Private(Level *coarse, Mat K, Mat nodal, Mat *product)
{
  PetscInt              *start, *column, num, *pair[2];
  PetscScalar           *value;
  Mat                   *theirs;
  CoarseNodes            nodes;
  GhostBlocks            others;
  const SymmetricBlocks *own;
  SymmetricBlocks        C;
  Weights                P;

  PetscFunctionBeginUser;
  PetscCall(StiffnessGetBlocks(K, &own, &others));
  PetscCall(WeightsGetGhosts_Private(K, own->bs, others.num, nodal, &theirs));
  PetscCall(WeightsCopy_Private(own->num, nodal, others.num, theirs[0], &start, &column, &value));
  PetscCall(MatDestroySubMatrices(1, &theirs));
  P = (Weights){.num = own->num + others.num, .start = start, .column = column, .value = value};
  PetscCall(CoarseNodesCreate_Private(coarse, start[P.num], column, &nodes));
  for (PetscInt k = 0; k < start[P.num]; k++) PetscCall(CoarseNodesFind_Private(coarse, &nodes, column[k], &column[k]));
  CoarseStiffnessListPairs_Private(own, &others, &P, &num, NULL, NULL);
  PetscCall(PetscMalloc2(num, &pair[0], num, &pair[1]));
  CoarseStiffnessListPairs_Private(own, &others, &P, &num, pair[0], pair[1]);
  PetscCall(CoarseStiffnessCreatePattern_Private(coarse, nodes.num, num, pair[0], pair[1], &C));
  PetscCall(PetscFree2(pair[0], pair[1]));
  PetscCall(CoarseStiffnessSetValues_Private(own, &others, &P, &C));
  PetscCall(PetscFree(start));
  PetscCall(PetscFree2(column, value));
  PetscCall(ConformingHold(coarse, nodes.global, &C));
  PetscCall(CellSumsFinish(coarse, nodes.global, &C, product));
  PetscCall(CoarseNodesDestroy_Private(&nodes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CoarseStiffnessCreate(Level *coarse, Mat K, Mat P, Mat nodal, Mat *product)
{
  const SymmetricBlocks *blocks;
  GhostBlocks            others;
  Mat                    whole, C;

  PetscFunctionBeginUser;
  if (nodal) {
    PetscCall(StiffnessGetBlocks(K, &blocks, &others));
    if (others.start)
      PetscCall(CoarseStiffnessCreateTogether_Private(coarse, K, nodal, product));
    else
      PetscCall(CoarseStiffnessCreateAlone_Private(coarse, blocks, nodal, product));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MatConvert(K, MATAIJ, MAT_INITIAL_MATRIX, &whole));
  PetscCall(MatPtAP(whole, P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &C));
  PetscCall(MatProductClear(C)); // it would keep its factors
  PetscCall(MatDestroy(&whole));
  PetscCall(ConformingHoldMatrix(coarse, &C));
  PetscCall(StiffnessCreateOfMatrix(C, product));
  PetscCall(MatDestroy(&C));
  PetscFunctionReturn(PETSC_SUCCESS);
}
