/* stiffnessproducts.c -- K for products alone: its upper triangle in blocks.

   Iterations read K from memory again and again. Half of it, without a column for every entry, is read in half the time. Each block
   is used twice on the way through it: for its row, and transposed for the row of its column (eq. 13.2). Blocks that couple to unknowns of other
   ranks follow by themselves. */
#include "base/compat.h"
#include <petscvec.h>
#include "problem/condensation.h"

enum { MAX_DIM = 3 };

/* Block rows, each block row by row. */
typedef struct {
  PetscInt     num;
  PetscInt    *row;            /* NULL where these are all [num] */
  PetscInt    *start, *column; /* [num+1], [start[num]] */
  PetscScalar *value;          /* [start[num]][bs][bs] */
} Blocks;

typedef struct {
  PetscInt   bs;
  Blocks     own;    /* from the diagonal on, counted from this rank's first */
  Blocks     others; /* columns among ghosts */
  Vec        ghosts; /* unknowns of other ranks; NULL on one rank */
  VecScatter scatter;
} Products;

/* y += V x for the symmetric V whose upper triangle these blocks are. To be inlined where bs is known, so that its loops are unrolled. */
static inline void StiffnessProductsAddSymmetric_Private(const PetscInt bs, const Blocks *own,
                                                         const PetscScalar *restrict x, PetscScalar *restrict y)
{
  const PetscScalar *restrict v = own->value;

  for (PetscInt i = 0; i < own->num; i++) {
    PetscScalar xi[MAX_DIM], sum[MAX_DIM];

    for (PetscInt k = 0; k < bs; k++) xi[k] = x[bs * i + k];
    for (PetscInt k = 0; k < bs; k++) {
      sum[k] = 0;
      for (PetscInt l = 0; l < bs; l++) sum[k] += v[bs * k + l] * xi[l];
    }
    v += bs * bs;
    for (PetscInt j = own->start[i] + 1; j < own->start[i + 1]; j++, v += bs * bs) {
      const PetscScalar *restrict xj = &x[bs * own->column[j]];
      PetscScalar *restrict yj       = &y[bs * own->column[j]];

      for (PetscInt k = 0; k < bs; k++) {
        for (PetscInt l = 0; l < bs; l++) {
          sum[k] += v[bs * k + l] * xj[l];
          yj[k] += v[bs * l + k] * xi[l];
        }
      }
    }
    for (PetscInt k = 0; k < bs; k++) y[bs * i + k] += sum[k];
  }
}

/* y += V x. The same. */
static inline void StiffnessProductsAddOthers_Private(const PetscInt bs, const Blocks *others,
                                                      const PetscScalar *restrict x, PetscScalar *restrict y)
{
  const PetscScalar *restrict v = others->value;

  for (PetscInt i = 0; i < others->num; i++) {
    PetscScalar sum[MAX_DIM] = {0};

    for (PetscInt j = others->start[i]; j < others->start[i + 1]; j++, v += bs * bs) {
      const PetscScalar *restrict xj = &x[bs * others->column[j]];

      for (PetscInt k = 0; k < bs; k++)
        for (PetscInt l = 0; l < bs; l++) sum[k] += v[bs * k + l] * xj[l];
    }
    for (PetscInt k = 0; k < bs; k++) y[bs * others->row[i] + k] += sum[k];
  }
}

static PetscErrorCode MatMult_StiffnessProducts(Mat S, Vec x, Vec y)
{
  Products          *p;
  const PetscScalar *xa;
  PetscScalar       *ya;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &p));
  if (p->ghosts) PetscCall(VecScatterBegin(p->scatter, x, p->ghosts, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecZeroEntries(y));
  PetscCall(VecGetArrayRead(x, &xa));
  PetscCall(VecGetArray(y, &ya));
  if (p->bs == 2)
    StiffnessProductsAddSymmetric_Private(2, &p->own, xa, ya);
  else
    StiffnessProductsAddSymmetric_Private(3, &p->own, xa, ya);
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCall(PetscLogFlops(4.0 * p->own.start[p->own.num] * p->bs * p->bs));
  if (p->ghosts) {
    PetscCall(VecScatterEnd(p->scatter, x, p->ghosts, INSERT_VALUES, SCATTER_FORWARD));
    PetscCall(VecGetArrayRead(p->ghosts, &xa));
    if (p->bs == 2)
      StiffnessProductsAddOthers_Private(2, &p->others, xa, ya);
    else
      StiffnessProductsAddOthers_Private(3, &p->others, xa, ya);
    PetscCall(VecRestoreArrayRead(p->ghosts, &xa));
    PetscCall(PetscLogFlops(2.0 * p->others.start[p->others.num] * p->bs * p->bs));
  }
  PetscCall(VecRestoreArray(y, &ya));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode StiffnessProductsDestroyBlocks_Private(Blocks *blocks)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(blocks->row));
  PetscCall(PetscFree(blocks->start));
  PetscCall(PetscFree2(blocks->column, blocks->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MatDestroy_StiffnessProducts(Mat S)
{
  Products *products;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &products));
  PetscCall(StiffnessProductsDestroyBlocks_Private(&products->own));
  PetscCall(StiffnessProductsDestroyBlocks_Private(&products->others));
  PetscCall(VecDestroy(&products->ghosts));
  PetscCall(VecScatterDestroy(&products->scatter));
  PetscCall(PetscFree(products));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The first entry of a row that is not left of its diagonal block. */
static PetscInt StiffnessProductsFindDiagonal_Private(PetscInt num, const PetscInt columns[], PetscInt first)
{
  PetscInt lower = 0, upper = num;

  while (lower < upper) {
    const PetscInt middle = (lower + upper) / 2;

    if (columns[middle] < first)
      lower = middle + 1;
    else
      upper = middle;
  }
  return lower;
}

/* Counts blocks, and lists the rows that have some where these are not all. [in] K - this rank's columns, or others' */
static PetscErrorCode StiffnessProductsCountBlocks_Private(Mat K, PetscInt bs, PetscBool symmetric, Blocks *blocks)
{
  PetscInt rows, count = 0;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(K, &rows, NULL));
  rows /= bs;
  PetscCall(PetscMalloc1(rows + 1, &blocks->start));
  if (!symmetric) PetscCall(PetscMalloc1(rows, &blocks->row));
  blocks->num = 0;
  for (PetscInt i = 0; i < rows; i++) {
    const PetscInt *columns;
    PetscInt        num, size;

    PetscCall(MatGetRow(K, bs * i, &num, &columns, NULL));
    size = (num - (symmetric ? StiffnessProductsFindDiagonal_Private(num, columns, bs * i) : 0)) / bs;
    PetscCall(MatRestoreRow(K, bs * i, &num, &columns, NULL));
    if (!symmetric && !size) continue;
    if (!symmetric) blocks->row[blocks->num] = i;
    blocks->start[blocks->num++] = count;
    count += size;
  }
  blocks->start[blocks->num] = count;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode StiffnessProductsCreateBlocks_Private(Mat K, PetscInt bs, PetscReal factor, PetscBool symmetric,
                                                            Blocks *blocks)
{
  PetscFunctionBeginUser;
  PetscCall(StiffnessProductsCountBlocks_Private(K, bs, symmetric, blocks));
  PetscCall(
      PetscMalloc2(blocks->start[blocks->num], &blocks->column, blocks->start[blocks->num] * bs * bs, &blocks->value));
  for (PetscInt r = 0; r < bs * blocks->num; r++) {
    const PetscInt     i = r / bs, k = r % bs, row = bs * (symmetric ? i : blocks->row[i]) + k, *columns;
    PetscInt           num, first;
    const PetscScalar *values;

    PetscCall(MatGetRow(K, row, &num, &columns, &values));
    first = symmetric ? StiffnessProductsFindDiagonal_Private(num, columns, row - k) : 0;
    for (PetscInt j = first; j < num; j++) {
      const PetscInt block = blocks->start[i] + (j - first) / bs, l = (j - first) % bs;

      blocks->column[block]                    = columns[j] / bs;
      blocks->value[(block * bs + k) * bs + l] = factor * values[j];
    }
    PetscCall(MatRestoreRow(K, row, &num, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What it takes to have the unknowns of other ranks that this rank's rows couple to. [in] columns - which these are */
static PetscErrorCode StiffnessProductsCreateScatter_Private(Mat K, Mat others, const PetscInt columns[],
                                                             Products *products)
{
  IS       from;
  PetscInt n;
  Vec      x;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(K, &x, NULL));
  PetscCall(MatCreateVecs(others, &products->ghosts, NULL));
  PetscCall(VecGetSize(products->ghosts, &n));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, n, columns, PETSC_USE_POINTER, &from));
  PetscCall(VecScatterCreate(x, from, products->ghosts, NULL, &products->scatter));
  PetscCall(ISDestroy(&from));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StiffnessProductsCreate(Mat K, PetscReal factor, Mat *S)
{
  Mat             own = K, others;
  Products       *products;
  PetscBool       sequential;
  const PetscInt *columns;
  PetscInt        n, bs;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&products));
  PetscCall(MatGetLocalSize(K, &n, NULL));
  PetscCall(MatGetBlockSize(K, &bs));
  PetscCheck(bs == 2 || bs == MAX_DIM, PetscObjectComm((PetscObject)K), PETSC_ERR_PLIB, "Blocks of size %" PetscInt_FMT,
             bs);
  products->bs = bs;
  PetscCall(PetscObjectTypeCompare((PetscObject)K, MATSEQAIJ, &sequential));
  if (!sequential) {
    PetscCall(MatMPIAIJGetSeqAIJ(K, &own, &others, &columns));
    PetscCall(StiffnessProductsCreateScatter_Private(K, others, columns, products));
    PetscCall(StiffnessProductsCreateBlocks_Private(others, bs, factor, PETSC_FALSE, &products->others));
  }
  PetscCall(StiffnessProductsCreateBlocks_Private(own, bs, factor, PETSC_TRUE, &products->own));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)K), n, n, PETSC_DETERMINE, PETSC_DETERMINE, products, S));
  PetscCall(MatSetBlockSize(*S, bs));
  PetscCall(MatShellSetOperation(*S, MATOP_MULT, (void (*)(void))MatMult_StiffnessProducts));
  PetscCall(MatShellSetOperation(*S, MATOP_DESTROY, (void (*)(void))MatDestroy_StiffnessProducts));
  PetscFunctionReturn(PETSC_SUCCESS);
}
