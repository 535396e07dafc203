/* test_symmetricblocks.c -- products with a random symmetric matrix in blocks against the sum of its entries; equal
   rows. */
#include "base/compat.h"
#include "problem/symmetricblocks.h"
#include <test.h>

#include "uniform.h"

enum { NUM = 9, SIZE = NUM * SYMMETRIC_BLOCKS_MAX };

static const PetscReal ROUNDING        = 1e-14;     /* sums of at most 27 products below 1 */
static const PetscReal ROUNDING_SINGLE = 27 * 6e-8; /* of as many factors below 1 */

/* A pattern with every second pair of different rows, and the diagonal. */
static PetscBool Couples(PetscInt i, PetscInt j)
{
  return (PetscBool)(i == j || (i + j) % 2);
}

/* Fills the stored blocks, and the whole matrix. [out] dense - [NUM * bs][NUM * bs] */
static PetscErrorCode CreateRandom(PetscInt bs, SymmetricBlocks *blocks, PetscScalar dense[SIZE][SIZE])
{
  PetscInt *start, *column;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(NUM + 1, &start));
  PetscCall(PetscMalloc1(NUM * NUM, &column));
  start[0] = 0;
  for (PetscInt i = 0; i < NUM; i++) {
    start[i + 1] = start[i];
    for (PetscInt j = 0; j < NUM; j++)
      if (Couples(i, j)) column[start[i + 1]++] = j;
  }
  PetscCall(SymmetricBlocksCreate(bs, NUM, start, column, blocks));
  for (PetscInt i = 0; i < NUM * bs; i++)
    for (PetscInt j = i; j < NUM * bs; j++) dense[i][j] = dense[j][i] = Couples(i / bs, j / bs) ? Uniform(-1, 1) : 0;
  for (PetscInt i = 0; i < NUM; i++) {
    for (PetscInt j = i; j < NUM; j++) {
      for (PetscInt k = 0; k < bs * bs && Couples(i, j); k++)
        SymmetricBlocksAt(blocks, i, j)[k] = dense[bs * i + k / bs][bs * j + k % bs];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A band of blocks that are the same in all rows, but for one number of the fourth one. */
static PetscErrorCode CreateBand(PetscInt bs, SymmetricBlocks *blocks)
{
  PetscInt *start, *column;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(NUM + 1, &start));
  PetscCall(PetscMalloc1(3 * NUM, &column));
  start[0] = 0;
  for (PetscInt i = 0; i < NUM; i++) {
    start[i + 1] = start[i];
    for (PetscInt j = PetscMax(i - 1, 0); j <= PetscMin(i + 1, NUM - 1); j++) column[start[i + 1]++] = j;
  }
  PetscCall(SymmetricBlocksCreate(bs, NUM, start, column, blocks));
  for (PetscInt i = 0; i < NUM; i++) {
    for (PetscInt j = i; j <= PetscMin(i + 1, NUM - 1); j++)
      for (PetscInt k = 0; k < bs * bs; k++) SymmetricBlocksAt(blocks, i, j)[k] = 1. / (1 + k + 10 * (j - i));
  }
  SymmetricBlocksAt(blocks, 3, 4)[0] += PETSC_MACHINE_EPSILON;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Products with the instructions of this processor, and without; the same with rounded numbers. */
static PetscErrorCode TestMult(PetscInt bs)
{
  const PetscReal factor = 0.75;
  SymmetricBlocks blocks;
  PetscScalar     dense[SIZE][SIZE], x[SIZE], y[4][SIZE];
  float          *single;

  PetscFunctionBeginUser;
  PetscCall(CreateRandom(bs, &blocks, dense));
  PetscCall(SymmetricBlocksCreateSingle(&blocks, factor, &single));
  for (PetscInt i = 0; i < NUM * bs; i++) x[i] = Uniform(-1, 1);
  SymmetricBlocksMult(&blocks, factor, x, y[0]);
  SymmetricBlocksMultPortably(&blocks, factor, x, y[1]);
  SymmetricBlocksMultSingle(&blocks, single, x, y[2]);
  SymmetricBlocksMultSinglePortably(&blocks, single, x, y[3]);
  for (PetscInt i = 0; i < NUM * bs; i++) {
    PetscScalar sum = 0;

    for (PetscInt j = 0; j < NUM * bs; j++) sum += factor * dense[i][j] * x[j];
    for (int way = 0; way < 4; way++)
      CHECK_NEAR(PetscRealPart(y[way][i]), PetscRealPart(sum), way < 2 ? ROUNDING : ROUNDING_SINGLE);
    CHECK_NEAR(PetscRealPart(y[3][i]), PetscRealPart(y[2][i]), ROUNDING);
  }
  PetscCall(PetscFree(single));
  PetscCall(SymmetricBlocksDestroy(&blocks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Products of some rows: entries whose row or column, the first of the two, is among them. */
static PetscErrorCode TestMultRows(PetscInt bs)
{
  const PetscReal factor      = 0.75;
  PetscInt        some[]      = {0, 3, 4, 7};
  const BlockRows rows        = {.num = PETSC_STATIC_ARRAY_LENGTH(some), .row = some};
  PetscBool       listed[NUM] = {PETSC_FALSE};
  SymmetricBlocks blocks;
  PetscScalar     dense[SIZE][SIZE], x[SIZE], y[2][SIZE];
  float          *single;

  PetscFunctionBeginUser;
  PetscCall(CreateRandom(bs, &blocks, dense));
  PetscCall(SymmetricBlocksCreateSingle(&blocks, factor, &single));
  for (PetscInt r = 0; r < rows.num; r++) listed[some[r]] = PETSC_TRUE;
  for (PetscInt i = 0; i < NUM * bs; i++) x[i] = Uniform(-1, 1);
  SymmetricBlocksMultRows(&blocks, &rows, factor, NULL, x, y[0]);
  SymmetricBlocksMultRows(&blocks, &rows, factor, single, x, y[1]);
  for (PetscInt i = 0; i < NUM * bs; i++) {
    PetscScalar sum = 0;

    for (PetscInt j = 0; j < NUM * bs; j++)
      if (listed[PetscMin(i, j) / bs]) sum += factor * dense[i][j] * x[j];
    CHECK_NEAR(PetscRealPart(y[0][i]), PetscRealPart(sum), ROUNDING);
    CHECK_NEAR(PetscRealPart(y[1][i]), PetscRealPart(sum), ROUNDING_SINGLE);
  }
  PetscCall(PetscFree(single));
  PetscCall(SymmetricBlocksDestroy(&blocks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A row is copied with the blocks on both sides of the diagonal. */
static PetscErrorCode TestGetRow(PetscInt bs)
{
  SymmetricBlocks blocks;
  PetscScalar     dense[SIZE][SIZE], rows[SYMMETRIC_BLOCKS_MAX * SIZE];

  PetscFunctionBeginUser;
  PetscCall(CreateRandom(bs, &blocks, dense));
  for (PetscInt i = 0; i < NUM; i++) {
    const PetscInt first = blocks.start[i], num = blocks.start[i + 1] - first;

    SymmetricBlocksGetRow(&blocks, i, SIZE, rows);
    for (PetscInt k = 0; k < bs; k++)
      for (PetscInt at = 0; at < num * bs; at++)
        CHECK_NEAR(PetscRealPart(rows[k * SIZE + at]),
                   PetscRealPart(dense[bs * i + k][bs * blocks.column[first + at / bs] + at % bs]), 0);
  }
  PetscCall(SymmetricBlocksDestroy(&blocks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows with the same numbers are stored once, and products and rows do not change. */
static PetscErrorCode TestShare(PetscInt bs)
{
  SymmetricBlocks blocks;
  PetscScalar     x[SIZE], before[SIZE], after[SIZE], rows[2][SYMMETRIC_BLOCKS_MAX * SIZE] = {{0}};
  PetscInt        stored;

  PetscFunctionBeginUser;
  PetscCall(CreateBand(bs, &blocks));
  for (PetscInt i = 0; i < NUM * bs; i++) x[i] = Uniform(-1, 1);
  SymmetricBlocksMult(&blocks, 1, x, before);
  SymmetricBlocksGetRow(&blocks, NUM - 1, SIZE, rows[0]);
  stored = blocks.num_values;
  PetscCall(SymmetricBlocksShare(&blocks));
  CHECK(stored == 2 * NUM - 1);
  CHECK(blocks.num_values == 2 + 2 + 1); // all rows, the fourth one, the last one
  SymmetricBlocksMult(&blocks, 1, x, after);
  SymmetricBlocksGetRow(&blocks, NUM - 1, SIZE, rows[1]);
  for (PetscInt i = 0; i < NUM * bs; i++) CHECK_NEAR(PetscRealPart(after[i]), PetscRealPart(before[i]), 0);
  for (PetscInt k = 0; k < bs * SIZE; k++) CHECK_NEAR(PetscRealPart(rows[1][k]), PetscRealPart(rows[0][k]), 0);
  PetscCall(SymmetricBlocksDestroy(&blocks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (PetscInt bs = 2; bs <= SYMMETRIC_BLOCKS_MAX; bs++) {
    PetscCall(TestMult(bs));
    PetscCall(TestMultRows(bs));
    PetscCall(TestGetRow(bs));
    PetscCall(TestShare(bs));
  }
  PetscCall(PetscFinalize());
  return 0;
}
