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

/* C += P'K P. To be inlined where bs is known. */
static inline void CoarseStiffnessSum_Private(PetscInt bs, const SymmetricBlocks *K, const Weights *P, Product *product)
{
  const PetscScalar *V = K->value;

  for (PetscInt i = 0; i < K->num; i++) {
    for (PetscInt at = K->diagonal[i]; at < K->start[i + 1]; at++, V += bs * bs) {
      const PetscInt j = K->column[at];

      for (PetscInt p = P->start[i]; p < P->start[i + 1]; p++) {
        for (PetscInt q = P->start[j]; q < P->start[j + 1]; q++) {
          const PetscInt  a = P->column[p], b = P->column[q];
          const PetscReal w = PetscRealPart(P->value[p] * P->value[q]);

          if (a <= b) CoarseStiffnessAdd_Private(bs, a, b, w, PETSC_FALSE, V, product);
          if (b <= a && i != j) CoarseStiffnessAdd_Private(bs, b, a, w, PETSC_TRUE, V, product);
        }
      }
    }
  }
}

/* The product block by block, on one process. */
static PetscErrorCode CoarseStiffnessCreateOfBlocks_Private(Level *coarse, const SymmetricBlocks *K, Mat nodal,
                                                            Mat *product)
{
  Weights   P;
  Product   sum = {.missing = PETSC_FALSE};
  PetscBool done;

  PetscFunctionBeginUser;
  PetscCall(CellSumsCreate(coarse, &sum.C));
  PetscCall(MatGetRowIJ(nodal, 0, PETSC_FALSE, PETSC_FALSE, &P.num, &P.start, &P.column, &done));
  PetscCheck(done && P.num == K->num, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A prolongation of other nodes");
  PetscCall(MatSeqAIJGetArrayRead(nodal, &P.value));
  if (K->bs == 2)
    CoarseStiffnessSum_Private(2, K, &P, &sum);
  else
    CoarseStiffnessSum_Private(3, K, &P, &sum);
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
