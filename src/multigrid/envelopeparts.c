/* envelopeparts.c -- see the header.

   Contact couples blocks of both bodies along their sides. Blocks without edges are eliminated first, each in
   an order that ends at its edges. Then the edges are, in an order of their own. Active unknowns are edges:
   the blocks of S without active unknowns keep their factors. */
#include "base/compat.h"
#include "multigrid/envelopeparts.h"

enum { ALONE = -1, EDGE = -2, OPEN = -3 }; /* instead of the number of a block; the last one is not known yet */

/* Entries up to this part of the geometric mean of both diagonal ones are roundoff, not couplings. */
static const PetscReal COUPLING_ROUNDOFF = 1e-14;

/* What finds the blocks. */
typedef struct {
  const EnvelopeRows  *rows, *base; /* of S, and of the matrix with the factors of `from` */
  PetscInt             bs;
  const PetscReal     *label;
  const EnvelopeParts *from; /* or NULL */
  EnvelopeParts       *to;
  PetscReal           *root;       /* of the diagonal [n] */
  PetscInt            *place;      /* in the order of the block [n] */
  PetscInt            *mark, last; /* numbers of searches, of rows, then of blocks [2 n] */
  PetscInt            *order;      /* [n] */
  PetscInt            *sorted;     /* [n] */
  PetscInt            *left;       /* of EnvelopeBlockCreate() [n] */
} Search;

PetscErrorCode EnvelopePartsDestroy(EnvelopeParts **parts)
{
  EnvelopeParts *p = *parts;

  PetscFunctionBeginUser;
  *parts = NULL;
  if (!p || --p->references) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt b = 0; b < p->num; b++) PetscCall(EnvelopeBlockDestroy(&p->block[b]));
  PetscCall(EnvelopeBlockDestroy(&p->edges));
  PetscCall(PetscFree(p->block));
  PetscCall(PetscFree4(p->of, p->place, p->alone, p->inverse));
  PetscCall(PetscFree(p->start));
  PetscCall(PetscFree(p->work));
  PetscCall(PetscFree(p));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether entry k of row i is a coupling. */
static PetscBool SearchCouples_Private(const Search *search, PetscInt i, PetscInt k)
{
  const PetscReal limit = COUPLING_ROUNDOFF * search->root[i] * search->root[search->rows->column[k]];

  return (PetscBool)(PetscAbsReal(search->rows->value[k]) > limit);
}

static void SearchSetRoots_Private(Search *search)
{
  const EnvelopeRows *A = search->rows;

  for (PetscInt i = 0; i < A->n; i++) {
    search->root[i] = 0;
    for (PetscInt k = A->start[i]; k < A->start[i + 1]; k++)
      if (A->column[k] == i) search->root[i] = PetscSqrtReal(PetscAbsReal(A->value[k]));
  }
}

/* Which rows are alone, and which are edges; edges stay edges. */
static void SearchClassify_Private(Search *search)
{
  const EnvelopeRows *A     = search->rows;
  const PetscReal    *label = search->label;
  const PetscInt      bs    = search->bs;
  EnvelopeParts      *to    = search->to;

  for (PetscInt i = 0; i < A->n; i++) {
    PetscBool others = PETSC_FALSE, cut = PETSC_FALSE;

    for (PetscInt k = A->start[i]; k < A->start[i + 1]; k++) {
      const PetscInt j = A->column[k];

      if (j == i || !SearchCouples_Private(search, i, k)) continue;
      others = PETSC_TRUE;
      if (label[j / bs] != label[i / bs]) cut = PETSC_TRUE;
    }
    if (search->from && search->from->of[i] == EDGE) cut = PETSC_TRUE;
    to->of[i] = !others ? ALONE : cut ? EDGE : OPEN;
    if (!others) to->alone[to->num_alone++] = i;
    to->place[i] = -1;
  }
  for (PetscInt i = 0; i < to->num_alone; i++)
    for (PetscInt k = A->start[to->alone[i]]; k < A->start[to->alone[i] + 1]; k++)
      if (A->column[k] == to->alone[i]) to->inverse[i] = 1 / A->value[k];
}

/* Lists rows of a block that are connected to the first num ones, neighbours before those farther away.
   [in,out] order - [return value] */
static PetscInt SearchList_Private(Search *search, PetscInt num, PetscInt order[])
{
  const EnvelopeRows *A = search->rows;

  search->last++;
  for (PetscInt i = 0; i < num; i++) search->mark[order[i]] = search->last;
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = A->start[order[i]]; k < A->start[order[i] + 1]; k++) {
      const PetscInt j = A->column[k];

      if (search->mark[j] == search->last || search->to->of[j] != OPEN) continue;
      if (!SearchCouples_Private(search, order[i], k)) continue;
      search->mark[j] = search->last;
      order[num++]    = j;
    }
  }
  return num;
}

static void SearchReverse_Private(PetscInt num, PetscInt order[])
{
  for (PetscInt i = 0; i < num / 2; i++) {
    const PetscInt swap = order[i];

    order[i]           = order[num - 1 - i];
    order[num - 1 - i] = swap;
  }
}

/* The order of a block: that of Cuthill and McKee from its edges, or without any from one end, reversed.
   [in] root - a row of it; [return value] rows, in search->order */
static PetscInt SearchOrder_Private(Search *search, PetscInt root)
{
  const EnvelopeRows *A     = search->rows;
  PetscInt           *order = search->order, num = 1, num_near = 0;

  order[0] = root;
  num      = SearchList_Private(search, 1, order);
  for (int again = 0; again < 2; again++) {
    order[0] = order[num - 1];
    num      = SearchList_Private(search, 1, order);
  }
  for (PetscInt i = 0; i < num; i++) {
    PetscBool near = PETSC_FALSE;

    for (PetscInt k = A->start[order[i]]; k < A->start[order[i] + 1] && !near; k++)
      near = (PetscBool)(search->to->of[A->column[k]] == EDGE && SearchCouples_Private(search, order[i], k));
    if (near) search->sorted[num_near++] = order[i];
  }
  for (PetscInt i = 0; i < num_near; i++) order[i] = search->sorted[i];
  if (num_near) num = SearchList_Private(search, num_near, order);
  SearchReverse_Private(num, order);
  return num;
}

/* Whether a kept block has the same rows, but for edges that are alone now. */
static PetscBool SearchIsKept_Private(const Search *search, const EnvelopeBlock *block)
{
  const EnvelopeRows *A = search->rows, *B = search->base;

  for (PetscInt i = 0; i < block->num; i++) {
    const PetscInt row = block->row[i], a = A->start[row], b = B->start[row], num = A->start[row + 1] - a;

    if (search->to->of[row] != OPEN || num != B->start[row + 1] - b) return PETSC_FALSE;
    for (PetscInt k = 0; k < num; k++) {
      const PetscInt j = A->column[a + k];

      if (j != B->column[b + k]) return PETSC_FALSE;
      if (A->value[a + k] != B->value[b + k] && (A->value[a + k] != 0 || search->to->of[j] != ALONE))
        return PETSC_FALSE;
    }
  }
  return PETSC_TRUE;
}

/* A new block, without numbers. [in] num - rows in search->order; [out] block */
static PetscErrorCode SearchCreateBlock_Private(Search *search, PetscInt num, EnvelopeBlock **block)
{
  const EnvelopeRows *A     = search->rows;
  PetscInt           *order = search->order, num_edges = 0;

  PetscFunctionBeginUser;
  search->last++;
  for (PetscInt i = 0; i < num; i++) search->place[order[i]] = i;
  for (PetscInt i = 0; i < num; i++) {
    search->left[i] = i;
    for (PetscInt k = A->start[order[i]]; k < A->start[order[i] + 1]; k++) {
      const PetscInt j = A->column[k];

      if (!SearchCouples_Private(search, order[i], k)) continue;
      if (search->place[j] < num && order[search->place[j]] == j)
        search->left[i] = PetscMin(search->left[i], search->place[j]);
      if (search->to->of[j] != EDGE || search->mark[j] == search->last) continue;
      search->mark[j]               = search->last;
      search->left[num + num_edges] = i;
      order[num + num_edges++]      = j;
    }
  }
  PetscCall(EnvelopeBlockCreate(num, num_edges, order, search->left, block));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All blocks, kept or without numbers. */
static PetscErrorCode SearchBlocks_Private(Search *search)
{
  EnvelopeParts *to = search->to;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(search->rows->n, &to->block));
  for (PetscInt i = 0; i < search->rows->n; i++) {
    EnvelopeBlock *block = NULL;

    if (to->of[i] != OPEN) continue;
    if (search->from && search->from->of[i] >= 0) block = search->from->block[search->from->of[i]];
    if (block && SearchIsKept_Private(search, block))
      block->references++;
    else
      PetscCall(SearchCreateBlock_Private(search, SearchOrder_Private(search, i), &block));
    for (PetscInt k = 0; k < block->num; k++) to->of[block->row[k]] = to->num;
    to->block[to->num++] = block;
  }
  PetscCall(PetscRealloc((size_t)to->num * sizeof(EnvelopeBlock *), &to->block));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds an edge to a list, unless it is there. */
static void SearchAppend_Private(Search *search, PetscInt row, PetscInt *num, PetscInt order[])
{
  if (search->to->of[row] != EDGE || search->to->place[row] >= 0 || search->mark[row] == search->last) return;
  search->mark[row] = search->last;
  order[(*num)++]   = row;
}

/* Lists edges that entries or blocks connect to the first one. [in,out] order - [return value] */
static PetscInt SearchListEdges_Private(Search *search, PetscInt order[])
{
  const EnvelopeRows *A   = search->rows;
  PetscInt            num = 0;

  search->last++;
  SearchAppend_Private(search, order[0], &num, order);
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = A->start[order[i]]; k < A->start[order[i] + 1]; k++) {
      const PetscInt       j = A->column[k], b = search->to->of[j];
      const EnvelopeBlock *block = b >= 0 ? search->to->block[b] : NULL;

      if (!SearchCouples_Private(search, order[i], k)) continue;
      SearchAppend_Private(search, j, &num, order);
      if (!block || search->mark[A->n + b] == search->last) continue;
      search->mark[A->n + b] = search->last;
      for (PetscInt e = 0; e < block->num_edges; e++)
        SearchAppend_Private(search, block->row[block->num + e], &num, order);
    }
  }
  return num;
}

/* Leftmost places of edges. [in] num - edges in search->order */
static void SearchSetLeft_Private(Search *search, PetscInt num)
{
  const EnvelopeRows  *A  = search->rows;
  const EnvelopeParts *to = search->to;

  for (PetscInt i = 0; i < num; i++) {
    search->left[i] = i;
    for (PetscInt k = A->start[search->order[i]]; k < A->start[search->order[i] + 1]; k++) {
      const PetscInt j = A->column[k];

      if (to->of[j] == EDGE && SearchCouples_Private(search, search->order[i], k))
        search->left[i] = PetscMin(search->left[i], to->place[j]);
    }
  }
  for (PetscInt b = 0; b < to->num; b++) {
    const EnvelopeBlock *block = to->block[b];
    const PetscInt      *edge  = &block->row[block->num];
    PetscInt             least = PETSC_MAX_INT;

    for (PetscInt e = 0; e < block->num_edges; e++)
      if (to->place[edge[e]] >= 0) least = PetscMin(least, to->place[edge[e]]);
    for (PetscInt e = 0; e < block->num_edges; e++)
      if (to->place[edge[e]] >= 0) search->left[to->place[edge[e]]] = PetscMin(search->left[to->place[edge[e]]], least);
  }
}

/* The block of all edges, without numbers. */
static PetscErrorCode SearchEdges_Private(Search *search)
{
  EnvelopeParts *to  = search->to;
  PetscInt       all = 0;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < search->rows->n; i++) {
    PetscInt *order = &search->order[all], num;

    if (to->of[i] != EDGE || to->place[i] >= 0) continue;
    order[0] = i;
    num      = SearchListEdges_Private(search, order);
    for (int again = 0; again < 2; again++) {
      order[0] = order[num - 1];
      num      = SearchListEdges_Private(search, order);
    }
    SearchReverse_Private(num, order);
    for (PetscInt k = 0; k < num; k++) to->place[order[k]] = all + k;
    all += num;
  }
  SearchSetLeft_Private(search, all);
  PetscCall(EnvelopeBlockCreate(all, 0, search->order, search->left, &to->edges));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopePartsCreate(const EnvelopeRows *A, PetscInt bs, const PetscReal label[],
                                   const EnvelopeRows *base, const EnvelopeParts *from, EnvelopeParts **parts)
{
  const PetscInt n      = A->n;
  Search         search = {.rows = A, .base = base, .bs = bs, .label = label, .from = from};

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(2 * n, &search.mark));
  PetscCall(PetscCalloc5(n, &search.root, n, &search.place, n, &search.order, n, &search.sorted, n, &search.left));
  SearchSetRoots_Private(&search);
  PetscCall(PetscNew(parts));
  search.to = *parts;
  **parts   = (EnvelopeParts){.references = 1, .scale = from ? from->scale : 1};
  PetscCall(PetscMalloc4(n, &(*parts)->of, n, &(*parts)->place, n, &(*parts)->alone, n, &(*parts)->inverse));
  SearchClassify_Private(&search);
  PetscCall(SearchBlocks_Private(&search));
  PetscCall(SearchEdges_Private(&search));
  PetscCall(PetscFree(search.mark));
  PetscCall(PetscFree5(search.root, search.place, search.order, search.sorted, search.left));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal EnvelopePartsWork(const EnvelopeParts *parts)
{
  PetscReal work = EnvelopeBlockWork(parts->edges);

  for (PetscInt b = 0; b < parts->num; b++) work += EnvelopeBlockWork(parts->block[b]);
  return work;
}

/* The numbers of blocks that have none. [in] exact - those with edges in double precision */
static PetscErrorCode EnvelopePartsFactorBlocks_Private(const EnvelopeRows *A, PetscBool exact, EnvelopeParts *parts)
{
  PetscInt  *place;
  PetscReal *tiles;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(A->n, &place));
  for (PetscInt b = 0; b < parts->num; b++) {
    EnvelopeBlock *block = parts->block[b];

    if (block->fp64 || (block->fp32 && (!exact || !block->num_edges))) continue;
    if (block->fp32) {
      PetscCall(EnvelopeBlockDuplicate(block, &parts->block[b]));
      PetscCall(EnvelopeBlockDestroy(&block));
      block = parts->block[b];
    }
    for (PetscInt i = 0; i < block->num; i++) place[block->row[i]] = i;
    PetscCall(EnvelopeBlockGather(A, 1 / parts->scale, place, block, &tiles));
    PetscCall(EnvelopeBlockFactor(exact, &tiles, block));
  }
  PetscCall(PetscFree(place));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode EnvelopePartsFactorEdges_Private(const EnvelopeRows *A, EnvelopeParts *parts)
{
  PetscReal *tiles;

  PetscFunctionBeginUser;
  PetscCall(PetscFree(parts->edges->fp64));
  PetscCall(EnvelopeBlockGather(A, 1 / parts->scale, parts->place, parts->edges, &tiles));
  for (PetscInt b = 0; b < parts->num; b++) EnvelopeBlockEliminate(parts->block[b], parts->place, parts->edges, tiles);
  PetscCall(EnvelopeBlockFactor(PETSC_FALSE, &tiles, parts->edges));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopePartsFactor(const EnvelopeRows *A, EnvelopeParts *parts)
{
  PetscFunctionBeginUser;
  PetscCall(EnvelopePartsFactorBlocks_Private(A, PETSC_FALSE, parts));
  PetscCall(EnvelopePartsFactorEdges_Private(A, parts));
  if (parts->edges->fp64) { // small pivots: the roundoff of blocks would weigh on them
    PetscCall(EnvelopePartsFactorBlocks_Private(A, PETSC_TRUE, parts));
    PetscCall(EnvelopePartsFactorEdges_Private(A, parts));
  }
  PetscCall(PetscMalloc1(parts->num + 1, &parts->start));
  parts->start[0] = 0;
  for (PetscInt b = 0; b < parts->num; b++)
    parts->start[b + 1] = parts->start[b] + (size_t)(ENVELOPE_TILE * parts->block[b]->all_panels);
  PetscCall(PetscMalloc1(parts->start[parts->num] + (size_t)(ENVELOPE_TILE * parts->edges->panels), &parts->work));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void EnvelopePartsScale(PetscReal factor, EnvelopeParts *parts)
{
  parts->scale *= factor;
  for (PetscInt i = 0; i < parts->num_alone; i++) parts->inverse[i] /= factor;
}

/* Forward substitution in a block. [out] x - of the block; [in,out] edges - right-hand side of the edges */
static void EnvelopePartsForward_Private(const EnvelopeParts *parts, PetscInt b, const PetscReal r[], PetscReal x[],
                                         PetscReal edges[])
{
  const EnvelopeBlock *block = parts->block[b];
  const PetscInt      *edge  = &block->row[block->num];
  PetscReal           *more  = &x[ENVELOPE_TILE * block->panels];

  for (PetscInt i = 0; i < block->num; i++) x[i] = r[block->row[i]];
  for (PetscInt i = block->num; i < ENVELOPE_TILE * block->panels; i++) x[i] = 0;
  EnvelopeBlockForward(block, x);
  for (PetscInt e = 0; e < block->num_edges; e++)
    if (parts->place[edge[e]] >= 0) edges[parts->place[edge[e]]] -= more[e];
}

static void EnvelopePartsBackward_Private(const EnvelopeParts *parts, PetscInt b, const PetscReal edges[],
                                          PetscReal x[], PetscReal z[])
{
  const EnvelopeBlock *block = parts->block[b];
  const PetscInt      *edge  = &block->row[block->num];
  PetscReal           *more  = &x[ENVELOPE_TILE * block->panels];

  for (PetscInt e = 0; e < ENVELOPE_TILE * (block->all_panels - block->panels); e++)
    more[e] = e < block->num_edges && parts->place[edge[e]] >= 0 ? edges[parts->place[edge[e]]] : 0;
  EnvelopeBlockBackward(block, x);
  for (PetscInt i = 0; i < block->num; i++) z[block->row[i]] = x[i] / parts->scale;
}

void EnvelopePartsSolve(const EnvelopeParts *parts, const PetscReal r[], PetscReal z[])
{
  PetscReal *edges = &parts->work[parts->start[parts->num]];

  for (PetscInt i = 0; i < ENVELOPE_TILE * parts->edges->panels; i++)
    edges[i] = i < parts->edges->num ? r[parts->edges->row[i]] : 0;
  for (PetscInt b = 0; b < parts->num; b++) {
    PetscReal *x = &parts->work[parts->start[b]];

    EnvelopePartsForward_Private(parts, b, r, x, edges);
    if (!parts->block[b]->num_edges) EnvelopePartsBackward_Private(parts, b, edges, x, z); // from the cache
  }
  EnvelopeBlockForward(parts->edges, edges);
  EnvelopeBlockBackward(parts->edges, edges);
  for (PetscInt b = 0; b < parts->num; b++)
    if (parts->block[b]->num_edges) EnvelopePartsBackward_Private(parts, b, edges, &parts->work[parts->start[b]], z);
  for (PetscInt i = 0; i < parts->edges->num; i++) z[parts->edges->row[i]] = edges[i] / parts->scale;
  for (PetscInt i = 0; i < parts->num_alone; i++) z[parts->alone[i]] = parts->inverse[i] * r[parts->alone[i]];
}

void EnvelopePartsSolveSome(const EnvelopeParts *parts, PetscInt num, const PetscInt which[], const PetscReal r[],
                            PetscReal z[])
{
  for (PetscInt i = 0; i < num; i++) {
    PetscReal *x = &parts->work[parts->start[which[i]]];

    EnvelopePartsForward_Private(parts, which[i], r, x, NULL);
    EnvelopePartsBackward_Private(parts, which[i], NULL, x, z);
  }
  for (PetscInt i = 0; i < parts->num_alone; i++) z[parts->alone[i]] = parts->inverse[i] * r[parts->alone[i]];
}
