/* symmetricblocks.c -- see the header.

   Iterations read a matrix from memory again and again. Half of it, without a column for every entry, is read in half the time. Each block
   is used twice on the way through it: for its row, and transposed for the row of its column (eq. 13.2). */
#include "problem/symmetricblocks.h"
#include "base/compat.h"

PetscErrorCode SymmetricBlocksCreate(PetscInt bs, PetscInt num, PetscInt start[], PetscInt column[],
                                     SymmetricBlocks *blocks)
{
  PetscFunctionBeginUser;
  PetscCheck(bs >= 2 && bs <= SYMMETRIC_BLOCKS_MAX, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Blocks of size %" PetscInt_FMT,
             bs);
  *blocks = (SymmetricBlocks){.bs = bs, .num = num, .start = start, .column = column};
  PetscCall(PetscMalloc1(num, &blocks->diagonal));
  PetscCall(PetscMalloc1(num + 1, &blocks->first));
  blocks->first[0] = 0;
  for (PetscInt i = 0; i < num; i++) {
    PetscInt at = start[i];

    while (column[at] < i) at++;
    blocks->diagonal[i]  = at;
    blocks->first[i + 1] = blocks->first[i] + start[i + 1] - at;
  }
  PetscCall(PetscCalloc1((size_t)blocks->first[num] * bs * bs, &blocks->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SymmetricBlocksDestroy(SymmetricBlocks *blocks)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(blocks->start));
  PetscCall(PetscFree(blocks->column));
  PetscCall(PetscFree(blocks->diagonal));
  PetscCall(PetscFree(blocks->first));
  PetscCall(PetscFree(blocks->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscScalar *SymmetricBlocksAt(const SymmetricBlocks *blocks, PetscInt i, PetscInt j)
{
  const PetscInt *column = &blocks->column[blocks->diagonal[i]];
  PetscInt        lower = 0, size = blocks->start[i + 1] - blocks->diagonal[i];

  while (size > 1) { // without branches to guess
    lower += column[lower + size / 2] <= j ? size / 2 : 0;
    size -= size / 2;
  }
  return &blocks->value[(size_t)(blocks->first[i] + lower) * blocks->bs * blocks->bs];
}

/* Blocks left of the diagonal lie in other rows, so they are asked for some blocks before they are read. */
enum { AHEAD = 8 };

void SymmetricBlocksGetRow(const SymmetricBlocks *blocks, PetscInt i, PetscInt width, PetscScalar rows[])
{
  const PetscInt     bs = blocks->bs, lower = blocks->diagonal[i] - blocks->start[i];
  const PetscInt    *column = &blocks->column[blocks->start[i]];
  const PetscScalar *v      = &blocks->value[(size_t)blocks->first[i] * bs * bs];
  const PetscScalar *other[AHEAD];

  for (PetscInt at = 0; at < lower + AHEAD; at++) {
    const PetscScalar **slot = &other[at % AHEAD];

    if (at >= AHEAD) {
      for (PetscInt k = 0; k < bs; k++)
        for (PetscInt l = 0; l < bs; l++) rows[k * width + l] = (*slot)[bs * l + k];
      rows += bs;
    }
    if (at < lower) {
      *slot = SymmetricBlocksAt(blocks, column[at], i);
      PetscPrefetchBlock(*slot, bs * bs, 0, PETSC_PREFETCH_HINT_T0);
    }
  }
  for (PetscInt at = blocks->diagonal[i]; at < blocks->start[i + 1]; at++, rows += bs, v += bs * bs) {
    for (PetscInt k = 0; k < bs; k++)
      for (PetscInt l = 0; l < bs; l++) rows[k * width + l] = v[bs * k + l];
  }
}

/* To be inlined where bs is known, so that its loops are unrolled. */
static inline void SymmetricBlocksAddProduct_Private(const PetscInt bs, const SymmetricBlocks *blocks, PetscReal factor,
                                                     const PetscScalar *restrict x, PetscScalar *restrict y)
{
  const PetscScalar *restrict v = blocks->value;

  for (PetscInt i = 0; i < blocks->num; i++) {
    PetscScalar xi[SYMMETRIC_BLOCKS_MAX], sum[SYMMETRIC_BLOCKS_MAX];

    for (PetscInt k = 0; k < bs; k++) {
      sum[k] = 0;
      for (PetscInt l = 0; l < bs; l++) sum[k] += v[bs * k + l] * x[bs * i + l];
    }
    for (PetscInt k = 0; k < bs; k++) xi[k] = factor * x[bs * i + k];
    v += bs * bs;
    for (PetscInt at = blocks->diagonal[i] + 1; at < blocks->start[i + 1]; at++, v += bs * bs) {
      const PetscScalar *restrict xj = &x[bs * blocks->column[at]];
      PetscScalar *restrict yj       = &y[bs * blocks->column[at]];

      for (PetscInt k = 0; k < bs; k++) {
        for (PetscInt l = 0; l < bs; l++) {
          sum[k] += v[bs * k + l] * xj[l];
          yj[k] += v[bs * l + k] * xi[l];
        }
      }
    }
    for (PetscInt k = 0; k < bs; k++) y[bs * i + k] += factor * sum[k];
  }
}

void SymmetricBlocksMult(const SymmetricBlocks *blocks, PetscReal factor, const PetscScalar x[], PetscScalar y[])
{
  for (PetscInt i = 0; i < blocks->bs * blocks->num; i++) y[i] = 0;
  if (blocks->bs == 2)
    SymmetricBlocksAddProduct_Private(2, blocks, factor, x, y);
  else
    SymmetricBlocksAddProduct_Private(3, blocks, factor, x, y);
}
