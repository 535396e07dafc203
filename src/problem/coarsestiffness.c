/* coarsestiffness.c -- the stiffness of a coarser level as P'K P.

   MatPtAP() has every entry of an AIJ copy of K, nine for a pair of nodes in space, and finds out which
   entries the product has. On one process blocks are summed up here, in the places that coarse cells have. */
#include "base/compat.h"
#include "problem/cellsums.h"
#include "problem/coarsestiffness.h"
#include "problem/conforming.h"

/* Rows of P. */
typedef struct {
  PetscInt           num;
  const PetscInt    *start, *column;
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

/* One row of blocks of (U + D/2) P, K = U + D + U'. */
typedef struct {
  PetscInt     num, *column; /* [num] */
  PetscBool   *listed;       /* [columns of P] */
  PetscScalar *value;        /* 0 where not listed [columns of P][bs][bs] */
} HalfRow;

/* Sums up row i. */
static inline void CoarseStiffnessSetRow_Private(PetscInt bs, const SymmetricBlocks *K, PetscInt i, const Weights *P,
                                                 HalfRow *row)
{
  const PetscScalar *V = &K->value[(size_t)K->first[i] * (size_t)(bs * bs)];

  for (PetscInt at = K->diagonal[i]; at < K->start[i + 1]; at++, V += bs * bs) {
    const PetscInt j = K->column[at];

    for (PetscInt q = P->start[j]; q < P->start[j + 1]; q++) {
      const PetscInt  b = P->column[q];
      const PetscReal w = PetscRealPart(P->value[q]) * (i == j ? 0.5 : 1);

      if (!row->listed[b]) row->column[row->num++] = b;
      row->listed[b] = PETSC_TRUE;
      for (PetscInt k = 0; k < bs * bs; k++) row->value[bs * bs * b + k] += w * V[k];
    }
  }
}

/* C += P'(U + D/2) P + its transpose. To be inlined where bs is known. */
static inline void CoarseStiffnessSum_Private(PetscInt bs, const SymmetricBlocks *K, const Weights *P, HalfRow *row,
                                              Product *product)
{
  for (PetscInt i = 0; i < K->num; i++) {
    CoarseStiffnessSetRow_Private(bs, K, i, P, row);
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

/* The product block by block, on one process. */
static PetscErrorCode CoarseStiffnessCreateOfBlocks_Private(Level *coarse, const SymmetricBlocks *K, Mat nodal,
                                                            Mat *product)
{
  Weights   P;
  HalfRow   row = {.num = 0};
  Product   sum = {.missing = PETSC_FALSE};
  PetscBool done;

  PetscFunctionBeginUser;
  PetscCall(CellSumsCreate(coarse, &sum.C));
  PetscCall(MatGetRowIJ(nodal, 0, PETSC_FALSE, PETSC_FALSE, &P.num, &P.start, &P.column, &done));
  PetscCheck(done && P.num == K->num, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A prolongation of other nodes");
  PetscCall(MatSeqAIJGetArrayRead(nodal, &P.value));
  PetscCall(PetscCalloc3(sum.C.num, &row.column, sum.C.num, &row.listed, sum.C.num * K->bs * K->bs, &row.value));
  if (K->bs == 2)
    CoarseStiffnessSum_Private(2, K, &P, &row, &sum);
  else
    CoarseStiffnessSum_Private(3, K, &P, &row, &sum);
  PetscCall(PetscFree3(row.column, row.listed, row.value));
  PetscCheck(!sum.missing, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A fine cell is no part of a coarse one");
  PetscCall(MatSeqAIJRestoreArrayRead(nodal, &P.value));
  PetscCall(MatRestoreRowIJ(nodal, 0, PETSC_FALSE, PETSC_FALSE, &P.num, &P.start, &P.column, &done));
  PetscCall(CellSumsFinish(coarse, &sum.C, product));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CoarseStiffnessCreate(Level *coarse, Mat K, Mat P, Mat nodal, Mat *product)
{
  const SymmetricBlocks *blocks = NULL;
  Mat                    whole, C;

  PetscFunctionBeginUser;
  if (nodal) PetscCall(StiffnessGetBlocks(K, &blocks));
  if (blocks) {
    PetscCall(CoarseStiffnessCreateOfBlocks_Private(coarse, blocks, nodal, product));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MatConvert(K, MATAIJ, MAT_INITIAL_MATRIX, &whole));
  PetscCall(MatPtAP(whole, P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &C));
  PetscCall(MatProductClear(C)); // it would keep its factors
  PetscCall(MatDestroy(&whole));
  PetscCall(ConformingHold(coarse, C));
  PetscCall(StiffnessCreateOfMatrix(C, product));
  PetscCall(MatDestroy(&C));
  PetscFunctionReturn(PETSC_SUCCESS);
}
