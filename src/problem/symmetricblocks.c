/* symmetricblocks.c -- see the header.

   The time of a product is that of reading the matrix from memory. Half of the blocks, with one column for
   each block, take half of the time. A product uses each block twice: for its row, and transposed for the row
   of its column (eq. 13.2). Numbers in single precision take 0.6 of the time again. With AVX2, blocks of
   space in the cache take 0.6 of the time.

   Where cells are translations of each other, nearly all rows have the same numbers. They are stored once,
   and then lie in the cache: products take a third of the time. */
#include <string.h>
#include "problem/symmetricblocks.h"
#include "base/compat.h"
#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#endif

/* Numbers after the last block: a register is loaded with four numbers, of which a row of a block uses
   three. */
enum { PADDING = 1 };

/* Rows that are compared: boxes have up to some thousand different ones. The hash is that of Fibonacci, 2^64
   over the golden ratio. */
enum { NUM_SLOTS = 1 << 14, HASH_SHIFT = 32 };
static const size_t HASH_FACTOR = 0x9E3779B97F4A7C15;

/* Places of the diagonal blocks; columns ascend in each row. */
static PetscErrorCode SymmetricBlocksSetDiagonal_Private(SymmetricBlocks *blocks)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(blocks->num, &blocks->diagonal));
  for (PetscInt i = 0; i < blocks->num; i++) {
    PetscInt at = blocks->start[i];

    while (blocks->column[at] < i) at++;
    blocks->diagonal[i] = at;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SymmetricBlocksCreate(PetscInt bs, PetscInt num, PetscInt start[], PetscInt column[],
                                     SymmetricBlocks *blocks)
{
  PetscFunctionBeginUser;
  PetscCheck(bs >= 2 && bs <= SYMMETRIC_BLOCKS_MAX, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Blocks of size %" PetscInt_FMT,
             bs);
  *blocks = (SymmetricBlocks){.bs = bs, .num = num, .start = start, .column = column};
  PetscCall(SymmetricBlocksSetDiagonal_Private(blocks));
  PetscCall(PetscMalloc1(num, &blocks->first));
  for (PetscInt i = 0; i < num; i++) {
    blocks->first[i] = blocks->num_values;
    blocks->num_values += start[i + 1] - blocks->diagonal[i];
  }
  blocks->num_ordered = blocks->num_values;
  PetscCall(PetscCalloc1((size_t)blocks->num_values * bs * bs + PADDING, &blocks->value));
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

/* A number that rows with the same numbers share. Of each block its first number counts: comparing rows costs
   less than a better hash. */
static size_t SymmetricBlocksHash_Private(PetscInt size, PetscInt block, const PetscScalar value[])
{
  PetscInt64 bits;
  size_t     hash = 0;

  for (PetscInt k = 0; k < size; k++) {
    memcpy(&bits, &value[k * block], sizeof(bits));
    hash = (hash ^ (size_t)bits) * HASH_FACTOR;
    hash ^= hash >> HASH_SHIFT;
  }
  return hash % NUM_SLOTS;
}

/* Finds a row with the same numbers, or moves those of row i to the front. [in,out] slot - the last row of a
   hash, or -1 [NUM_SLOTS]; [in,out] stored - blocks at the front */
static void SymmetricBlocksShareRow_Private(SymmetricBlocks *blocks, PetscInt i, PetscInt slot[], PetscInt *stored)
{
  const PetscInt     block = blocks->bs * blocks->bs, size = blocks->start[i + 1] - blocks->diagonal[i];
  const PetscScalar *value = &blocks->value[(size_t)blocks->first[i] * (size_t)block];
  const size_t       bytes = (size_t)(size * block) * sizeof(PetscScalar);
  PetscInt          *like  = &slot[SymmetricBlocksHash_Private(size, block, value)];

  if (*like >= 0 && blocks->start[*like + 1] - blocks->diagonal[*like] == size &&
      !memcmp(&blocks->value[(size_t)blocks->first[*like] * (size_t)block], value, bytes)) {
    blocks->first[i] = blocks->first[*like];
    return;
  }
  if (*stored < blocks->first[i]) memmove(&blocks->value[(size_t)*stored * (size_t)block], value, bytes);
  blocks->first[i] = *stored;
  *stored += size;
  *like = i;
}

PetscErrorCode SymmetricBlocksShare(SymmetricBlocks *blocks)
{
  const PetscInt ordered = blocks->num_ordered;
  PetscInt       stored  = 0, *slot;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(NUM_SLOTS, &slot));
  for (PetscInt k = 0; k < NUM_SLOTS; k++) slot[k] = -1;
  for (PetscInt i = 0; i < blocks->num; i++)
    if (blocks->first[i] < ordered) SymmetricBlocksShareRow_Private(blocks, i, slot, &stored);
  for (PetscInt i = 0; i < blocks->num; i++)
    if (blocks->first[i] >= ordered) SymmetricBlocksShareRow_Private(blocks, i, slot, &stored);
  PetscCall(PetscFree(slot));
  blocks->num_values  = stored;
  blocks->num_ordered = stored;
  PetscCall(PetscRealloc(((size_t)stored * (size_t)(blocks->bs * blocks->bs) + PADDING) * sizeof(PetscScalar),
                         &blocks->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SymmetricBlocksCreateWithin(PetscInt num, PetscInt start[], PetscInt column[], const PetscBool kept[],
                                           SymmetricBlocks *from, SymmetricBlocks *blocks)
{
  const size_t square = (size_t)(from->bs * from->bs);
  PetscInt     more = 0, room = num < from->num ? from->first[num] : from->num_values;

  PetscFunctionBeginUser;
  *blocks = (SymmetricBlocks){.bs = from->bs, .num = num, .start = start, .column = column, .num_ordered = room};
  PetscCall(SymmetricBlocksSetDiagonal_Private(blocks));
  PetscCall(PetscMalloc1(num, &blocks->first));
  for (PetscInt i = 0; i < num; i++) {
    blocks->first[i] = kept[i] ? from->first[i] : room + more;
    if (!kept[i]) more += start[i + 1] - blocks->diagonal[i];
  }
  blocks->num_values = room + more;
  PetscCall(PetscRealloc(((size_t)blocks->num_values * square + PADDING) * sizeof(PetscScalar), &from->value));
  PetscCall(PetscArrayzero(&from->value[(size_t)room * square], (size_t)more * square + PADDING));
  blocks->value = from->value;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscScalar *SymmetricBlocksAt(const SymmetricBlocks *blocks, PetscInt i, PetscInt j)
{
  const PetscInt *column = &blocks->column[blocks->diagonal[i]];
  PetscInt        lower = 0, size = blocks->start[i + 1] - blocks->diagonal[i];

  while (size > 1) { // without branches, which would be mispredicted
    lower += column[lower + size / 2] <= j ? size / 2 : 0;
    size -= size / 2;
  }
  return &blocks->value[(size_t)(blocks->first[i] + lower) * blocks->bs * blocks->bs];
}

/* Blocks left of the diagonal are stored in other rows: they are prefetched this number of blocks ahead. */
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

/* The numbers of the blocks, in double or in single precision; the other one is NULL. Functions that have
   them are inlined where it is known which. */
typedef struct {
  const PetscScalar *fp64;
  const float       *fp32;
  PetscInt           num;  /* rows that are multiplied */
  const PetscInt    *rows; /* these, or NULL for the first ones [num] */
} Numbers;

static inline PetscInt NumbersRow_Private(const Numbers *numbers, PetscInt k)
{
  return numbers->rows ? numbers->rows[k] : k;
}

static inline PetscScalar NumbersGet_Private(Numbers numbers, size_t at)
{
  return numbers.fp32 ? (PetscScalar)numbers.fp32[at] : numbers.fp64[at];
}

/* Inlined where bs is a constant: then its loops are unrolled. */
static inline void SymmetricBlocksAddProduct_Private(const PetscInt bs, const SymmetricBlocks *blocks,
                                                     const Numbers numbers, PetscReal factor,
                                                     const PetscScalar *restrict x, PetscScalar *restrict y)
{
  for (PetscInt r = 0; r < numbers.num; r++) {
    const PetscInt i     = NumbersRow_Private(&numbers, r);
    size_t         first = (size_t)blocks->first[i] * (size_t)(bs * bs);
    PetscScalar    xi[SYMMETRIC_BLOCKS_MAX], sum[SYMMETRIC_BLOCKS_MAX];

    for (PetscInt k = 0; k < bs; k++) {
      sum[k] = 0;
      for (PetscInt l = 0; l < bs; l++)
        sum[k] += NumbersGet_Private(numbers, first + (size_t)(bs * k + l)) * x[bs * i + l];
    }
    for (PetscInt k = 0; k < bs; k++) xi[k] = factor * x[bs * i + k];
    first += (size_t)(bs * bs);
    for (PetscInt at = blocks->diagonal[i] + 1; at < blocks->start[i + 1]; at++, first += (size_t)(bs * bs)) {
      const PetscScalar *restrict xj = &x[bs * blocks->column[at]];
      PetscScalar *restrict yj       = &y[bs * blocks->column[at]];

      for (PetscInt k = 0; k < bs; k++) {
        for (PetscInt l = 0; l < bs; l++) {
          sum[k] += NumbersGet_Private(numbers, first + (size_t)(bs * k + l)) * xj[l];
          yj[k] += NumbersGet_Private(numbers, first + (size_t)(bs * l + k)) * xi[l];
        }
      }
    }
    for (PetscInt k = 0; k < bs; k++) y[bs * i + k] += factor * sum[k];
  }
}

static inline void SymmetricBlocksMult_Private(const SymmetricBlocks *blocks, const Numbers numbers, PetscReal factor,
                                               const PetscScalar x[], PetscScalar y[])
{
  if (blocks->bs == 2)
    SymmetricBlocksAddProduct_Private(2, blocks, numbers, factor, x, y);
  else
    SymmetricBlocksAddProduct_Private(3, blocks, numbers, factor, x, y);
}

#if defined(__x86_64__) && defined(__GNUC__)
#define WITH_AVX2        __attribute__((target("avx2,fma")))
#define WITH_AVX2_INLINE __attribute__((target("avx2,fma"), always_inline)) static inline

WITH_AVX2_INLINE __m256d NumbersLoad_AVX2(const Numbers numbers, size_t at)
{
  return numbers.fp32 ? _mm256_cvtps_pd(_mm_loadu_ps(&numbers.fp32[at])) : _mm256_loadu_pd(&numbers.fp64[at]);
}

/* The same for blocks of the plane on processors with AVX2: a register has a whole block. */
WITH_AVX2_INLINE void SymmetricBlocksAddPlane_AVX2(const SymmetricBlocks *blocks, const Numbers numbers,
                                                   PetscReal factor, const PetscScalar *restrict x,
                                                   PetscScalar *restrict y)
{
  const __m128d factors = _mm_set1_pd(factor);

  for (PetscInt r = 0; r < numbers.num; r++) {
    const PetscInt i  = NumbersRow_Private(&numbers, r);
    size_t         at = 4 * (size_t)blocks->first[i];
    const __m128d  xi = _mm_loadu_pd(&x[2 * i]);
    const __m256d  times =
        _mm256_set_m128d(_mm_mul_pd(factors, _mm_unpackhi_pd(xi, xi)), _mm_mul_pd(factors, _mm_unpacklo_pd(xi, xi)));
    __m256d rows = _mm256_mul_pd(NumbersLoad_AVX2(numbers, at), _mm256_set_m128d(xi, xi));
    __m128d sum;

    at += 4;
    for (PetscInt j = blocks->diagonal[i] + 1; j < blocks->start[i + 1]; j++, at += 4) {
      const __m128d xj = _mm_loadu_pd(&x[2 * blocks->column[j]]);
      PetscScalar  *yj = &y[2 * blocks->column[j]];
      const __m256d v = NumbersLoad_AVX2(numbers, at), product = _mm256_mul_pd(v, times);

      rows = _mm256_fmadd_pd(v, _mm256_set_m128d(xj, xj), rows);
      sum  = _mm_add_pd(_mm256_castpd256_pd128(product), _mm256_extractf128_pd(product, 1));
      _mm_storeu_pd(yj, _mm_add_pd(_mm_loadu_pd(yj), sum));
    }
    sum = _mm_hadd_pd(_mm256_castpd256_pd128(rows), _mm256_extractf128_pd(rows, 1));
    _mm_storeu_pd(&y[2 * i], _mm_add_pd(_mm_loadu_pd(&y[2 * i]), _mm_mul_pd(factors, sum)));
  }
}

/* For blocks of space: a register has a row of a block. */
WITH_AVX2_INLINE void SymmetricBlocksAddSpace_AVX2(const SymmetricBlocks *blocks, const Numbers numbers,
                                                   PetscReal factor, const PetscScalar *restrict x,
                                                   PetscScalar *restrict y)
{
  for (PetscInt r = 0; r < numbers.num; r++) {
    const PetscInt     i  = NumbersRow_Private(&numbers, r);
    size_t             at = 9 * (size_t)blocks->first[i];
    const PetscScalar *xi = &x[3 * i];
    __m256d            row[3], times[3], product;
    PetscScalar        sum[3][4];

    for (PetscInt k = 0; k < 3; k++) {
      times[k] = _mm256_set_pd(0, factor * xi[k], factor * xi[k], factor * xi[k]);
      row[k]   = _mm256_mul_pd(NumbersLoad_AVX2(numbers, at + 3 * (size_t)k), _mm256_set_pd(0, xi[2], xi[1], xi[0]));
    }
    at += 9;
    for (PetscInt j = blocks->diagonal[i] + 1; j < blocks->start[i + 1]; j++, at += 9) {
      const PetscScalar *xj    = &x[3 * blocks->column[j]];
      PetscScalar       *yj    = &y[3 * blocks->column[j]];
      const __m256d      other = _mm256_set_m128d(_mm_load_sd(&xj[2]), _mm_loadu_pd(xj));
      const __m256d      v0 = NumbersLoad_AVX2(numbers, at), v1 = NumbersLoad_AVX2(numbers, at + 3),
                    v2 = NumbersLoad_AVX2(numbers, at + 6);

      row[0]  = _mm256_fmadd_pd(v0, other, row[0]);
      row[1]  = _mm256_fmadd_pd(v1, other, row[1]);
      row[2]  = _mm256_fmadd_pd(v2, other, row[2]);
      product = _mm256_fmadd_pd(v0, times[0], _mm256_fmadd_pd(v1, times[1], _mm256_mul_pd(v2, times[2])));
      _mm_storeu_pd(yj, _mm_add_pd(_mm_loadu_pd(yj), _mm256_castpd256_pd128(product)));
      _mm_store_sd(&yj[2], _mm_add_sd(_mm_load_sd(&yj[2]), _mm256_extractf128_pd(product, 1)));
    }
    for (PetscInt k = 0; k < 3; k++) {
      _mm256_storeu_pd(sum[k], row[k]);
      y[3 * i + k] += factor * (sum[k][0] + sum[k][1] + sum[k][2]);
    }
  }
}

WITH_AVX2 static void SymmetricBlocksAddDouble_AVX2(const SymmetricBlocks *blocks, const Numbers numbers,
                                                    PetscReal factor, const PetscScalar x[], PetscScalar y[])
{
  if (blocks->bs == 2)
    SymmetricBlocksAddPlane_AVX2(blocks, numbers, factor, x, y);
  else
    SymmetricBlocksAddSpace_AVX2(blocks, numbers, factor, x, y);
}

WITH_AVX2 static void SymmetricBlocksAddSingle_AVX2(const SymmetricBlocks *blocks, const Numbers numbers,
                                                    const PetscScalar x[], PetscScalar y[])
{
  if (blocks->bs == 2)
    SymmetricBlocksAddPlane_AVX2(blocks, numbers, 1, x, y);
  else
    SymmetricBlocksAddSpace_AVX2(blocks, numbers, 1, x, y);
}

static PetscBool SymmetricBlocksHasAVX2_Private(void)
{
  return (PetscBool)(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"));
}
#else
#define SymmetricBlocksAddDouble_AVX2(...) (void)0
#define SymmetricBlocksAddSingle_AVX2(...) (void)0
#define SymmetricBlocksHasAVX2_Private()   PETSC_FALSE
#endif

static void SymmetricBlocksClear_Private(const SymmetricBlocks *blocks, PetscScalar y[])
{
  for (PetscInt i = 0; i < blocks->bs * blocks->num; i++) y[i] = 0;
}

void SymmetricBlocksMultPortably(const SymmetricBlocks *blocks, PetscReal factor, const PetscScalar x[],
                                 PetscScalar y[])
{
  SymmetricBlocksClear_Private(blocks, y);
  SymmetricBlocksMult_Private(blocks, (Numbers){.fp64 = blocks->value, .num = blocks->num}, factor, x, y);
}

void SymmetricBlocksMultSinglePortably(const SymmetricBlocks *blocks, const float single[], const PetscScalar x[],
                                       PetscScalar y[])
{
  SymmetricBlocksClear_Private(blocks, y);
  SymmetricBlocksMult_Private(blocks, (Numbers){.fp32 = single, .num = blocks->num}, 1, x, y);
}

void SymmetricBlocksMult(const SymmetricBlocks *blocks, PetscReal factor, const PetscScalar x[], PetscScalar y[])
{
  if (!SymmetricBlocksHasAVX2_Private()) {
    SymmetricBlocksMultPortably(blocks, factor, x, y);
    return;
  }
  SymmetricBlocksClear_Private(blocks, y);
  SymmetricBlocksAddDouble_AVX2(blocks, (Numbers){.fp64 = blocks->value, .num = blocks->num}, factor, x, y);
}

PetscErrorCode SymmetricBlocksCreateSingle(const SymmetricBlocks *blocks, PetscReal factor, float **single)
{
  const size_t num = (size_t)blocks->num_values * (size_t)(blocks->bs * blocks->bs);

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num + PADDING, single));
  for (size_t k = 0; k < num; k++) (*single)[k] = (float)(factor * blocks->value[k]);
  for (size_t k = num; k < num + PADDING; k++) (*single)[k] = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

void SymmetricBlocksMultSingle(const SymmetricBlocks *blocks, const float single[], const PetscScalar x[],
                               PetscScalar y[])
{
  if (!SymmetricBlocksHasAVX2_Private()) {
    SymmetricBlocksMultSinglePortably(blocks, single, x, y);
    return;
  }
  SymmetricBlocksClear_Private(blocks, y);
  SymmetricBlocksAddSingle_AVX2(blocks, (Numbers){.fp32 = single, .num = blocks->num}, x, y);
}

void SymmetricBlocksMultRows(const SymmetricBlocks *blocks, const BlockRows *rows, PetscReal factor,
                             const float single[], const PetscScalar x[], PetscScalar y[])
{
  const Numbers numbers = {.fp64 = single ? NULL : blocks->value, .fp32 = single, .num = rows->num, .rows = rows->row};

  SymmetricBlocksClear_Private(blocks, y);
  if (!SymmetricBlocksHasAVX2_Private())
    SymmetricBlocksMult_Private(blocks, numbers, single ? 1 : factor, x, y);
  else if (single)
    SymmetricBlocksAddSingle_AVX2(blocks, numbers, x, y);
  else
    SymmetricBlocksAddDouble_AVX2(blocks, numbers, factor, x, y);
}
