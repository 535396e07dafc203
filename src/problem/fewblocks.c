/* fewblocks.c -- see the header.

   Blocks of nodes take a quarter of the bytes of an AIJ matrix. Half of them are stored, in half of the
   precision, with one column for a block. */
#include "problem/fewblocks.h"
#include "base/compat.h"
#include "problem/symmetricblocks.h"

typedef struct {
  PetscInt       *node; /* with entries, ascending [blocks.num] */
  SymmetricBlocks blocks;
  float          *single;
  PetscScalar    *x, *y;  /* at these nodes [blocks.num][bs] */
  Mat             others; /* rows of this rank, columns of others; NULL on one process, as all below */
  Vec             ghosts, own;
  VecScatter      scatter;
} FewBlocks;

static PetscErrorCode MultAdd_FewBlocks(Mat S, Vec x, Vec y, Vec z)
{
  FewBlocks         *few;
  const PetscScalar *xa;
  PetscScalar       *za;
  PetscInt           bs;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &few));
  bs = few->blocks.bs;
  if (few->others) PetscCall(VecScatterBegin(few->scatter, x, few->ghosts, INSERT_VALUES, SCATTER_FORWARD));
  if (y != z) PetscCall(VecCopy(y, z));
  PetscCall(VecGetArrayRead(x, &xa));
  for (PetscInt i = 0; i < few->blocks.num; i++)
    for (PetscInt k = 0; k < bs; k++) few->x[i * bs + k] = xa[few->node[i] * bs + k];
  PetscCall(VecRestoreArrayRead(x, &xa));
  SymmetricBlocksMultSingle(&few->blocks, few->single, few->x, few->y);
  PetscCall(VecGetArray(z, &za));
  for (PetscInt i = 0; i < few->blocks.num; i++)
    for (PetscInt k = 0; k < bs; k++) za[few->node[i] * bs + k] += few->y[i * bs + k];
  PetscCall(VecRestoreArray(z, &za));
  if (few->others) {
    PetscCall(VecScatterEnd(few->scatter, x, few->ghosts, INSERT_VALUES, SCATTER_FORWARD));
    PetscCall(VecGetLocalVector(z, few->own));
    PetscCall(MatMultAdd(few->others, few->ghosts, few->own, few->own));
    PetscCall(VecRestoreLocalVector(z, few->own));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_FewBlocks(Mat S)
{
  FewBlocks *few;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &few));
  PetscCall(PetscFree(few->node));
  PetscCall(SymmetricBlocksDestroy(&few->blocks));
  PetscCall(PetscFree(few->single));
  PetscCall(PetscFree2(few->x, few->y));
  PetscCall(MatDestroy(&few->others));
  PetscCall(VecDestroy(&few->ghosts));
  PetscCall(VecDestroy(&few->own));
  PetscCall(VecScatterDestroy(&few->scatter));
  PetscCall(PetscFree(few));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Entries of a matrix by rows. */
typedef struct {
  PetscInt           n;
  const PetscInt    *start, *column;
  const PetscScalar *value;
} Rows;

/* The nodes with entries. [out] place - of a node among them, or -1 [rows->n / bs] */
static PetscErrorCode FewBlocksListNodes_Private(const Rows *rows, PetscInt bs, FewBlocks *few, PetscInt place[],
                                                 PetscInt *num)
{
  PetscFunctionBeginUser;
  *num = 0;
  for (PetscInt i = 0; i < rows->n / bs; i++)
    place[i] = rows->start[bs * (i + 1)] > rows->start[bs * i] ? (*num)++ : -1;
  PetscCall(PetscMalloc1(*num, &few->node));
  for (PetscInt i = 0; i < rows->n / bs; i++)
    if (place[i] >= 0) few->node[place[i]] = i;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The pattern in blocks, with all of the diagonal. [in] place - of FewBlocksListNodes_Private() */
static PetscErrorCode FewBlocksCreatePattern_Private(const Rows *rows, PetscInt bs, PetscInt num,
                                                     const PetscInt place[], FewBlocks *few)
{
  PetscInt *start, *column, most = num;

  PetscFunctionBeginUser;
  most += rows->start[rows->n]; // untouched pages take no memory
  PetscCall(PetscMalloc1(num + 1, &start));
  PetscCall(PetscMalloc1(most, &column));
  start[0] = 0;
  for (PetscInt i = 0; i < num; i++) {
    PetscInt size = 0, *mine = &column[start[i]];

    mine[size++] = i;
    for (PetscInt at = rows->start[bs * few->node[i]]; at < rows->start[bs * (few->node[i] + 1)]; at++)
      mine[size++] = place[rows->column[at] / bs];
    PetscCall(PetscSortRemoveDupsInt(&size, mine));
    start[i + 1] = start[i] + size;
  }
  PetscCall(PetscRealloc((size_t)start[num] * sizeof(PetscInt), &column));
  PetscCall(SymmetricBlocksCreate(bs, num, start, column, &few->blocks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode FewBlocksSetRows_Private(const Rows *rows, PetscInt bs, FewBlocks *few)
{
  PetscInt *place, num;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(rows->n / bs, &place));
  PetscCall(FewBlocksListNodes_Private(rows, bs, few, place, &num));
  PetscCall(FewBlocksCreatePattern_Private(rows, bs, num, place, few));
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = 0; k < bs; k++) {
      const PetscInt row = bs * few->node[i] + k;

      for (PetscInt at = rows->start[row]; at < rows->start[row + 1]; at++) {
        const PetscInt j = place[rows->column[at] / bs];

        if (j >= i) SymmetricBlocksAt(&few->blocks, i, j)[bs * k + rows->column[at] % bs] = rows->value[at];
      }
    }
  }
  PetscCall(PetscFree(place));
  PetscCall(SymmetricBlocksCreateSingle(&few->blocks, 1, &few->single));
  PetscCall(PetscFree(few->blocks.value));
  PetscCall(PetscMalloc2(bs * num, &few->x, bs * num, &few->y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in] others - columns of other ranks; [in] ghost - their numbers in Z */
static PetscErrorCode FewBlocksSetGhosts_Private(Mat Z, Mat others, const PetscInt ghost[], FewBlocks *few)
{
  PetscInt num;
  IS       from;
  Vec      x;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectReference((PetscObject)others));
  few->others = others;
  PetscCall(MatCreateVecs(others, &few->ghosts, &few->own));
  PetscCall(MatCreateVecs(Z, &x, NULL));
  PetscCall(VecGetSize(few->ghosts, &num));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, ghost, PETSC_COPY_VALUES, &from));
  PetscCall(VecScatterCreate(x, from, few->ghosts, NULL, &few->scatter));
  PetscCall(ISDestroy(&from));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FewBlocksCreate(Mat Z, PetscInt bs, Mat *S)
{
  Rows            rows;
  FewBlocks      *few;
  PetscBool       alone, done;
  Mat             own = Z, others;
  const PetscInt *ghost;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&few));
  PetscCall(PetscObjectTypeCompare((PetscObject)Z, MATSEQAIJ, &alone));
  if (!alone) PetscCall(MatMPIAIJGetSeqAIJ(Z, &own, &others, &ghost));
  PetscCall(MatGetRowIJ(own, 0, PETSC_FALSE, PETSC_FALSE, &rows.n, &rows.start, &rows.column, &done));
  PetscCall(MatSeqAIJGetArrayRead(own, &rows.value));
  PetscCall(FewBlocksSetRows_Private(&rows, bs, few));
  PetscCall(MatSeqAIJRestoreArrayRead(own, &rows.value));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)Z), rows.n, rows.n, PETSC_DETERMINE, PETSC_DETERMINE, few, S));
  PetscCall(MatRestoreRowIJ(own, 0, PETSC_FALSE, PETSC_FALSE, &rows.n, &rows.start, &rows.column, &done));
  if (!alone) PetscCall(FewBlocksSetGhosts_Private(Z, others, ghost, few));
  PetscCall(MatShellSetOperation(*S, MATOP_MULT_ADD, (void (*)(void))MultAdd_FewBlocks));
  PetscCall(MatShellSetOperation(*S, MATOP_DESTROY, (void (*)(void))Destroy_FewBlocks));
  PetscFunctionReturn(PETSC_SUCCESS);
}
