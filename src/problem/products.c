/* products.c -- K for products alone: its upper triangle in blocks.

   Iterations read K from memory again and again. Half of it, without a column for every entry, is read in half the time. Each block
   is used twice on the way through it: for its row, and transposed for the row of its column (T39). What couples to unknowns of other ranks
   is little, and stays where it is. */
#include <mortise/compat.h>
#include <petscvec.h>
#include "condense.h"

enum { MAX_DIM = 3 };

typedef struct {
  PetscInt     bs, num;        /* block rows of this rank */
  PetscInt    *start, *column; /* from the diagonal on, counted from this rank's first [num+1], [start[num]] */
  PetscScalar *value;          /* [start[num]][bs][bs], each block row by row */
  PetscReal    factor;         /* is in value */
  Mat          others;         /* K's columns of other ranks, borrowed, NULL on one rank; without the factor */
  Vec          ghosts, result; /* what stands there; this rank's part of a product */
  VecScatter   scatter;
} Products;

/* y += V x. To be inlined where bs is known, so that its loops are unrolled. */
static inline void AddBlocks_Private(const PetscInt bs, const Products *products, const PetscScalar *restrict x,
                                     PetscScalar *restrict y)
{
  const PetscScalar *restrict v = products->value;

  for (PetscInt i = 0; i < products->num; i++) {
    PetscScalar own[MAX_DIM], sum[MAX_DIM];

    for (PetscInt k = 0; k < bs; k++) own[k] = x[bs * i + k];
    for (PetscInt k = 0; k < bs; k++) {
      sum[k] = 0;
      for (PetscInt l = 0; l < bs; l++) sum[k] += v[bs * k + l] * own[l];
    }
    v += bs * bs;
    for (PetscInt j = products->start[i] + 1; j < products->start[i + 1]; j++, v += bs * bs) {
      const PetscScalar *restrict xj = &x[bs * products->column[j]];
      PetscScalar *restrict yj       = &y[bs * products->column[j]];

      for (PetscInt k = 0; k < bs; k++) {
        for (PetscInt l = 0; l < bs; l++) {
          sum[k] += v[bs * k + l] * xj[l];
          yj[k] += v[bs * l + k] * own[l];
        }
      }
    }
    for (PetscInt k = 0; k < bs; k++) y[bs * i + k] += sum[k];
  }
}

/* y += factor K_others ghosts */
static PetscErrorCode AddOthers_Private(const Products *products, Vec y)
{
  PetscFunctionBeginUser;
  PetscCall(VecScale(products->ghosts, products->factor));
  PetscCall(VecGetLocalVector(y, products->result));
  PetscCall(MatMultAdd(products->others, products->ghosts, products->result, products->result));
  PetscCall(VecRestoreLocalVector(y, products->result));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Mult_Products(Mat S, Vec x, Vec y)
{
  Products          *p;
  const PetscScalar *xa;
  PetscScalar       *ya;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &p));
  if (p->others) PetscCall(VecScatterBegin(p->scatter, x, p->ghosts, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecZeroEntries(y));
  PetscCall(VecGetArrayRead(x, &xa));
  PetscCall(VecGetArray(y, &ya));
  if (p->bs == 2)
    AddBlocks_Private(2, p, xa, ya);
  else
    AddBlocks_Private(3, p, xa, ya);
  PetscCall(VecRestoreArray(y, &ya));
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCall(PetscLogFlops(4.0 * p->start[p->num] * p->bs * p->bs));
  if (p->others) PetscCall(VecScatterEnd(p->scatter, x, p->ghosts, INSERT_VALUES, SCATTER_FORWARD));
  if (p->others) PetscCall(AddOthers_Private(p, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Products(Mat S)
{
  Products *products;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &products));
  PetscCall(PetscFree(products->start));
  PetscCall(PetscFree2(products->column, products->value));
  PetscCall(VecDestroy(&products->ghosts));
  PetscCall(VecDestroy(&products->result));
  PetscCall(VecScatterDestroy(&products->scatter));
  PetscCall(PetscFree(products));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The first entry of a row that is not left of its diagonal block. */
static PetscInt FindDiagonal_Private(PetscInt num, const PetscInt columns[], PetscInt first)
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

/* How many blocks the upper triangle has. [in] K - this rank's */
static PetscErrorCode CountBlocks_Private(Mat K, Products *products)
{
  const PetscInt bs = products->bs;

  PetscFunctionBeginUser;
  products->start[0] = 0;
  for (PetscInt i = 0; i < products->num; i++) {
    const PetscInt *columns;
    PetscInt        num;

    PetscCall(MatGetRow(K, bs * i, &num, &columns, NULL));
    products->start[i + 1] = products->start[i] + (num - FindDiagonal_Private(num, columns, bs * i)) / bs;
    PetscCall(MatRestoreRow(K, bs * i, &num, &columns, NULL));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode FillBlocks_Private(Mat K, Products *products)
{
  const PetscInt bs = products->bs;

  PetscFunctionBeginUser;
  for (PetscInt row = 0; row < bs * products->num; row++) {
    const PetscInt     i = row / bs, k = row % bs, *columns;
    PetscInt           num, first;
    const PetscScalar *values;

    PetscCall(MatGetRow(K, row, &num, &columns, &values));
    first = FindDiagonal_Private(num, columns, row - k);
    for (PetscInt j = first; j < num; j++) {
      const PetscInt block = products->start[i] + (j - first) / bs, l = (j - first) % bs;

      products->column[block]                    = columns[j] / bs;
      products->value[(block * bs + k) * bs + l] = products->factor * values[j];
    }
    PetscCall(MatRestoreRow(K, row, &num, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What it takes to have the unknowns of other ranks that this rank's rows couple to. [in] columns - which these are */
static PetscErrorCode CreateScatter_Private(Mat K, Mat own, const PetscInt columns[], Products *products)
{
  IS       from;
  PetscInt n;
  Vec      x;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(K, &x, NULL));
  PetscCall(MatCreateVecs(own, NULL, &products->result));
  PetscCall(MatCreateVecs(products->others, &products->ghosts, NULL));
  PetscCall(VecGetSize(products->ghosts, &n));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, n, columns, PETSC_USE_POINTER, &from));
  PetscCall(VecScatterCreate(x, from, products->ghosts, NULL, &products->scatter));
  PetscCall(ISDestroy(&from));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProductsCreate(Mat K, PetscReal factor, Mat *S)
{
  Mat             own = K;
  Products       *products;
  PetscBool       sequential;
  const PetscInt *columns;
  PetscInt        n, bs, blocks;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&products));
  PetscCall(MatGetLocalSize(K, &n, NULL));
  PetscCall(MatGetBlockSize(K, &bs));
  PetscCheck(bs == 2 || bs == MAX_DIM, PetscObjectComm((PetscObject)K), PETSC_ERR_PLIB, "Blocks of size %" PetscInt_FMT,
             bs);
  products->bs     = bs;
  products->num    = n / bs;
  products->factor = factor;
  PetscCall(PetscObjectTypeCompare((PetscObject)K, MATSEQAIJ, &sequential));
  if (!sequential) {
    PetscCall(MatMPIAIJGetSeqAIJ(K, &own, &products->others, &columns));
    PetscCall(CreateScatter_Private(K, own, columns, products));
  }
  PetscCall(PetscMalloc1(products->num + 1, &products->start));
  PetscCall(CountBlocks_Private(own, products));
  blocks = products->start[products->num];
  PetscCall(PetscMalloc2(blocks, &products->column, blocks * bs * bs, &products->value));
  PetscCall(FillBlocks_Private(own, products));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)K), n, n, PETSC_DETERMINE, PETSC_DETERMINE, products, S));
  PetscCall(MatSetBlockSize(*S, bs));
  PetscCall(MatShellSetOperation(*S, MATOP_MULT, (void (*)(void))Mult_Products));
  PetscCall(MatShellSetOperation(*S, MATOP_DESTROY, (void (*)(void))Destroy_Products));
  PetscFunctionReturn(PETSC_SUCCESS);
}
