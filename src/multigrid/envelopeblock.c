/* envelopeblock.c -- see the header.

   In the order of Cuthill and McKee, the factor of a line or a plane of nodes is filled anyway. The entries
   reach from the first one of a row to the diagonal [1]. Rows are stored from there on. The time of a
   solution is that of reading the factor.

   References: [1] George, Liu, Computer Solution of Large Sparse Positive Definite Systems, 1981, chapter
   4. */
#include "base/compat.h"
#include "kernel/wide.h"
#include "multigrid/envelopeblock.h"

enum { TILE = ENVELOPE_TILE, ENTRIES = TILE * TILE };

/* Least pivot relative to the diagonal of the matrix with which a factor is kept in single precision, whose
   roundoff is 6e-8 of the diagonal. */
static const PetscReal SINGLE_PIVOT = 1e-4;
/* Pivots below that are roundoff; the diagonal takes their place, and the factor stays definite. */
static const PetscReal ZERO_PIVOT = 1e-14;

PetscErrorCode EnvelopeBlockCreate(PetscInt num, PetscInt num_edges, const PetscInt row[], const PetscInt left[],
                                   EnvelopeBlock **block)
{
  const PetscInt panels = (num + TILE - 1) / TILE, all_panels = panels + (num_edges + TILE - 1) / TILE;
  EnvelopeBlock *b;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&b));
  *b = (EnvelopeBlock){.references = 1, .num = num, .panels = panels, .num_edges = num_edges, .all_panels = all_panels};
  PetscCall(PetscMalloc3(num + num_edges, &b->row, all_panels, &b->first, all_panels + 1, &b->start));
  PetscCall(PetscArraycpy(b->row, row, num + num_edges));
  b->start[0] = 0;
  for (PetscInt p = 0; p < all_panels; p++) {
    const PetscInt begin = p < panels ? TILE * p : num + TILE * (p - panels);
    const PetscInt end   = PetscMin(begin + TILE, p < panels ? num : num + num_edges);

    b->first[p] = PetscMin(p, panels);
    for (PetscInt i = begin; i < end; i++) b->first[p] = PetscMin(b->first[p], left[i] / TILE);
    b->start[p + 1] = b->start[p] + (size_t)(p < panels ? p + 1 - b->first[p] : panels - b->first[p]);
  }
  *block = b;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeBlockDuplicate(const EnvelopeBlock *block, EnvelopeBlock **copy)
{
  EnvelopeBlock *b;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&b));
  *b            = *block;
  b->references = 1;
  b->fp32       = NULL;
  b->fp64       = NULL;
  PetscCall(PetscMalloc3(b->num + b->num_edges, &b->row, b->all_panels, &b->first, b->all_panels + 1, &b->start));
  PetscCall(PetscArraycpy(b->row, block->row, b->num + b->num_edges));
  PetscCall(PetscArraycpy(b->first, block->first, b->all_panels));
  PetscCall(PetscArraycpy(b->start, block->start, b->all_panels + 1));
  *copy = b;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeBlockDestroy(EnvelopeBlock **block)
{
  EnvelopeBlock *b = *block;

  PetscFunctionBeginUser;
  *block = NULL;
  if (!b || --b->references) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscFree3(b->row, b->first, b->start));
  PetscCall(PetscFree(b->fp32));
  PetscCall(PetscFree(b->fp64));
  PetscCall(PetscFree(b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal EnvelopeBlockWork(const EnvelopeBlock *block)
{
  PetscReal work = 0;

  for (PetscInt p = 0; p < block->all_panels; p++)
    work += TILE * PetscSqr(TILE * (PetscReal)(block->start[p + 1] - block->start[p]));
  return work;
}

/* Entry (i, j) of a factor; i is a place in the block, or TILE panels plus that of an edge. */
static size_t EnvelopeBlockAt_Private(const EnvelopeBlock *block, PetscInt i, PetscInt j)
{
  const PetscInt p = i / TILE;

  return ENTRIES * (block->start[p] + (size_t)(j / TILE - block->first[p])) + (size_t)(TILE * (i % TILE) + j % TILE);
}

PetscErrorCode EnvelopeBlockGather(const EnvelopeRows *A, PetscReal factor, const PetscInt place[],
                                   const EnvelopeBlock *block, PetscReal **tiles)
{
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(ENTRIES * block->start[block->all_panels], tiles));
  for (PetscInt i = block->num; i < TILE * block->panels; i++) (*tiles)[EnvelopeBlockAt_Private(block, i, i)] = 1;
  for (PetscInt i = 0; i < block->num + block->num_edges; i++) {
    const PetscInt row = block->row[i], at = i < block->num ? i : TILE * block->panels + i - block->num;

    for (PetscInt k = A->start[row]; k < A->start[row + 1]; k++) {
      const PetscInt j = place[A->column[k]];

      if (A->value[k] == 0 || j < 0 || j > at || j >= block->num || block->row[j] != A->column[k]) continue;
      if (j / TILE < block->first[at / TILE]) continue; // roundoff
      (*tiles)[EnvelopeBlockAt_Private(block, at, j)] = factor * A->value[k];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* c -= sum of products a b' of num tiles, by half tiles of b, whose sums fit into the registers */
static inline void TilesSubtract_Private(PetscInt num, const PetscReal *restrict a, const PetscReal *restrict b,
                                         PetscReal *restrict c)
{
  for (int half = 0; half < TILE; half += TILE / 2) {
    PetscReal sum[TILE][TILE / 2][TILE] = {{{0}}};

    for (PetscInt t = 0; t < num; t++)
      for (int r = 0; r < TILE; r++)
        for (int s = 0; s < TILE / 2; s++)
          for (int k = 0; k < TILE; k++)
            sum[r][s][k] += a[ENTRIES * t + TILE * r + k] * b[ENTRIES * t + TILE * (half + s) + k];
    for (int r = 0; r < TILE; r++)
      for (int s = 0; s < TILE / 2; s++)
        c[TILE * r + half + s] -= (sum[r][s][0] + sum[r][s][1]) + (sum[r][s][2] + sum[r][s][3]);
  }
}

/* c := c w' for a lower triangle w */
static inline void TileMultiply_Private(const PetscReal w[], PetscReal c[])
{
  for (int r = 0; r < TILE; r++) {
    for (int s = TILE - 1; s >= 0; s--) {
      PetscReal sum = 0;

      for (int k = 0; k <= s; k++) sum += c[TILE * r + k] * w[TILE * s + k];
      c[TILE * r + s] = sum;
    }
  }
}

/* The inverse of the Cholesky factor of a tile. [in] was - the diagonal of the matrix; [in,out] c; [in,out]
   least - pivot relative to the diagonal */
static void TileInvert_Private(const PetscReal was[], PetscReal c[], PetscReal *least)
{
  PetscReal w[TILE][TILE] = {{0}};

  for (int i = 0; i < TILE; i++) {
    for (int j = 0; j <= i; j++) {
      PetscReal sum = c[TILE * i + j];

      for (int k = 0; k < j; k++) sum -= c[TILE * i + k] * c[TILE * j + k];
      if (j < i) {
        c[TILE * i + j] = sum / c[TILE * j + j];
      } else {
        *least          = PetscMin(*least, sum / was[i]);
        c[TILE * i + i] = PetscSqrtReal(sum > ZERO_PIVOT * was[i] ? sum : was[i]);
      }
    }
  }
  for (int j = 0; j < TILE; j++) {
    w[j][j] = 1 / c[TILE * j + j];
    for (int i = j + 1; i < TILE; i++) {
      for (int k = j; k < i; k++) w[i][j] -= c[TILE * i + k] * w[k][j];
      w[i][j] /= c[TILE * i + i];
    }
  }
  for (int k = 0; k < ENTRIES; k++) c[k] = w[k / TILE][k % TILE];
}

/* [in,out] tiles; [in,out] least - pivot relative to the diagonal of the matrix */
MORTISE_WIDE static void EnvelopeBlockFactorTiles_Private(const EnvelopeBlock *block, PetscReal tiles[],
                                                          PetscReal *least)
{
  for (PetscInt p = 0; p < block->all_panels; p++) {
    const PetscInt first = block->first[p], end = PetscMin(p, block->panels);
    PetscReal     *panel = &tiles[ENTRIES * block->start[p]], *last = &panel[ENTRIES * (end - first)];
    PetscReal      was[TILE];

    for (PetscInt q = first; q < end; q++) {
      const PetscInt   from  = PetscMax(first, block->first[q]);
      const PetscReal *other = &tiles[ENTRIES * block->start[q]];

      TilesSubtract_Private(q - from, &panel[ENTRIES * (from - first)], &other[ENTRIES * (from - block->first[q])],
                            &panel[ENTRIES * (q - first)]);
      TileMultiply_Private(&other[ENTRIES * (q - block->first[q])], &panel[ENTRIES * (q - first)]);
    }
    if (p >= block->panels) continue;
    for (int r = 0; r < TILE; r++) was[r] = last[(TILE + 1) * r];
    TilesSubtract_Private(p - first, panel, panel, last);
    TileInvert_Private(was, last, least);
  }
}

PetscErrorCode EnvelopeBlockFactor(PetscBool exact, PetscReal **tiles, EnvelopeBlock *block)
{
  const size_t size  = ENTRIES * block->start[block->all_panels];
  PetscReal    least = 1;

  PetscFunctionBeginUser;
  EnvelopeBlockFactorTiles_Private(block, *tiles, &least);
  if (exact || least < SINGLE_PIVOT) {
    block->fp64 = *tiles;
    *tiles      = NULL;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscMalloc1(size, &block->fp32));
  for (size_t k = 0; k < size; k++) block->fp32[k] = (float)(*tiles)[k];
  PetscCall(PetscFree(*tiles));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static inline PetscReal TileGet_Private(const float *restrict fp32, const PetscReal *restrict fp64, size_t at)
{
  return fp32 ? (PetscReal)fp32[at] : fp64[at];
}

/* Products of panels of two groups of edges. [out] c - a b' */
MORTISE_WIDE static void EnvelopeBlockProduct_Private(const EnvelopeBlock *block, PetscInt p, PetscInt q,
                                                      PetscReal c[TILE][TILE])
{
  const PetscInt from = PetscMax(block->first[p], block->first[q]);
  const size_t   a    = ENTRIES * (block->start[p] + (size_t)(from - block->first[p])),
               b      = ENTRIES * (block->start[q] + (size_t)(from - block->first[q]));

  for (int r = 0; r < TILE; r++) {
    for (int s = 0; s < TILE; s++) {
      PetscReal sum[TILE] = {0};

      for (size_t t = 0; t < ENTRIES * (size_t)(block->panels - from); t += ENTRIES)
        for (size_t k = 0; k < TILE; k++)
          sum[k] += TileGet_Private(block->fp32, block->fp64, a + t + (size_t)(TILE * r) + k) *
                    TileGet_Private(block->fp32, block->fp64, b + t + (size_t)(TILE * s) + k);
      c[r][s] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
  }
}

void EnvelopeBlockEliminate(const EnvelopeBlock *block, const PetscInt place[], const EnvelopeBlock *edges,
                            PetscReal tiles[])
{
  const PetscInt *edge = &block->row[block->num];

  for (PetscInt p = block->panels; p < block->all_panels; p++) {
    for (PetscInt q = block->panels; q <= p; q++) {
      PetscReal c[TILE][TILE];

      EnvelopeBlockProduct_Private(block, p, q, c);
      for (PetscInt r = 0; r < TILE; r++) {
        for (PetscInt s = 0; s < TILE; s++) {
          const PetscInt i = TILE * (p - block->panels) + r, j = TILE * (q - block->panels) + s;

          if (i >= block->num_edges || j > i || place[edge[i]] < 0 || place[edge[j]] < 0) continue;
          tiles[EnvelopeBlockAt_Private(edges, PetscMax(place[edge[i]], place[edge[j]]),
                                        PetscMin(place[edge[i]], place[edge[j]]))] -= c[r][s];
        }
      }
    }
  }
}

/* L in one of both precisions, the other one is NULL. Inlined where it is known which. */
static inline void EnvelopeBlockForward_Private(const EnvelopeBlock *block, const float *restrict fp32,
                                                const PetscReal *restrict fp64, PetscReal *restrict x)
{
  size_t at = 0;

  for (PetscInt p = 0; p < block->all_panels; p++) {
    PetscReal sum[TILE][TILE] = {{0}}, rest[TILE];

    for (PetscInt q = block->first[p]; q < PetscMin(p, block->panels); q++, at += ENTRIES)
      for (size_t r = 0; r < TILE; r++)
        for (size_t k = 0; k < TILE; k++)
          sum[r][k] += TileGet_Private(fp32, fp64, at + TILE * r + k) * x[TILE * q + (PetscInt)k];
    for (int r = 0; r < TILE; r++) rest[r] = (sum[r][0] + sum[r][1]) + (sum[r][2] + sum[r][3]);
    if (p >= block->panels) {
      for (int r = 0; r < TILE; r++) x[TILE * p + r] = rest[r];
      continue;
    }
    for (int r = 0; r < TILE; r++) rest[r] = x[TILE * p + r] - rest[r];
    for (size_t r = 0; r < TILE; r++) {
      PetscReal y = 0;

      for (size_t k = 0; k <= r; k++) y += TileGet_Private(fp32, fp64, at + TILE * r + k) * rest[k];
      x[TILE * p + (PetscInt)r] = y;
    }
    at += ENTRIES;
  }
}

static inline void EnvelopeBlockBackward_Private(const EnvelopeBlock *block, const float *restrict fp32,
                                                 const PetscReal *restrict fp64, PetscReal *restrict x)
{
  size_t at = ENTRIES * block->start[block->all_panels];

  for (PetscInt p = block->all_panels - 1; p >= 0; p--) {
    PetscReal y[TILE] = {0};

    if (p < block->panels) {
      at -= ENTRIES;
      for (size_t r = 0; r < TILE; r++)
        for (size_t k = 0; k <= r; k++)
          y[k] += TileGet_Private(fp32, fp64, at + TILE * r + k) * x[TILE * p + (PetscInt)r];
      for (int k = 0; k < TILE; k++) x[TILE * p + k] = y[k];
    } else {
      for (int k = 0; k < TILE; k++) y[k] = x[TILE * p + k];
    }
    for (PetscInt q = PetscMin(p, block->panels) - 1; q >= block->first[p]; q--) {
      at -= ENTRIES;
      for (size_t k = 0; k < TILE; k++)
        x[TILE * q + (PetscInt)k] -=
            (TileGet_Private(fp32, fp64, at + k) * y[0] + TileGet_Private(fp32, fp64, at + TILE + k) * y[1]) +
            (TileGet_Private(fp32, fp64, at + 2 * TILE + k) * y[2] +
             TileGet_Private(fp32, fp64, at + 3 * TILE + k) * y[3]);
    }
  }
}

MORTISE_WIDE static void EnvelopeBlockForwardSingle_Private(const EnvelopeBlock *block, PetscReal x[])
{
  EnvelopeBlockForward_Private(block, block->fp32, NULL, x);
}

MORTISE_WIDE static void EnvelopeBlockForwardDouble_Private(const EnvelopeBlock *block, PetscReal x[])
{
  EnvelopeBlockForward_Private(block, NULL, block->fp64, x);
}

MORTISE_WIDE static void EnvelopeBlockBackwardSingle_Private(const EnvelopeBlock *block, PetscReal x[])
{
  EnvelopeBlockBackward_Private(block, block->fp32, NULL, x);
}

MORTISE_WIDE static void EnvelopeBlockBackwardDouble_Private(const EnvelopeBlock *block, PetscReal x[])
{
  EnvelopeBlockBackward_Private(block, NULL, block->fp64, x);
}

void EnvelopeBlockForward(const EnvelopeBlock *block, PetscReal x[])
{
  if (block->fp32)
    EnvelopeBlockForwardSingle_Private(block, x);
  else
    EnvelopeBlockForwardDouble_Private(block, x);
}

void EnvelopeBlockBackward(const EnvelopeBlock *block, PetscReal x[])
{
  if (block->fp32)
    EnvelopeBlockBackwardSingle_Private(block, x);
  else
    EnvelopeBlockBackwardDouble_Private(block, x);
}
