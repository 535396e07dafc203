/* spread.c -- the removed-node rule.

   psi_a + w psi_c keeps sum psi = 1 and stays diagonal on the kept nodes, so constant pressures still pass; in 2D this is
   the constant dual function of Wohlmuth (2000) at the ends of a side. Written as products with W = (w_ac). */
#include <mortise/compat.h>
#include "spread.h"

/* W of ones: row a, column c for every kept node a beside a removed node c. */
static PetscErrorCode NeighbourMatrix_Private(Level *level, const Facets *facets, const NodeFate fate[],
                                              const PetscBool covered[], Mat *W)
{
  enum { MAX_NEIGHBOURS = 16 }; /* removed nodes beside one kept node; two in 2D */

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(level->comm, level->num_owned, level->num_owned, level->num_global, level->num_global, 0, NULL,
                         0, NULL, W));
  PetscCall(MatSeqAIJSetPreallocation(*W, MAX_NEIGHBOURS, NULL));
  PetscCall(MatMPIAIJSetPreallocation(*W, MAX_NEIGHBOURS, NULL, MAX_NEIGHBOURS, NULL));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * ELEMENT_MAX_FACET_NODES], n = ElementNumNodes(facets->type[f]);
    if (!covered[f]) continue;
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt j = 0; j < n; j++) {
        if (fate[nodes[i]] != NODE_KEPT || fate[nodes[j]] != NODE_REMOVED) continue;
        PetscCall(MatSetValue(*W, level->node_global[nodes[i]], level->node_global[nodes[j]], 1.0, INSERT_VALUES));
      }
    }
  }
  PetscCall(MatAssemblyBegin(*W, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*W, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* W := W diag(1 / column sums): the weights w_ac. */
static PetscErrorCode NormalizeColumns_Private(Mat W)
{
  Vec          ones, sums;
  PetscScalar *s;
  PetscInt     n;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(W, &sums, &ones));
  PetscCall(VecSet(ones, 1.0));
  PetscCall(MatMultTranspose(W, ones, sums));
  PetscCall(VecGetLocalSize(sums, &n));
  PetscCall(VecGetArray(sums, &s));
  for (PetscInt i = 0; i < n; i++) s[i] = s[i] != 0.0 ? 1.0 / s[i] : 0.0;
  PetscCall(VecRestoreArray(sums, &s));
  PetscCall(MatDiagonalScale(W, NULL, sums));
  PetscCall(VecDestroy(&ones));
  PetscCall(VecDestroy(&sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SpreadRemovedRows(Level *level, const Facets *facets, const NodeFate fate[], const PetscBool covered[],
                                 Vec D, Vec G, Mat *M, Mat *chain)
{
  PetscBool any = PETSC_FALSE;
  Mat       W, WM;
  Vec       WG;

  PetscFunctionBeginUser;
  *chain = NULL;
  for (PetscInt i = 0; i < level->num_nodes; i++) any = (PetscBool)(any || fate[i] == NODE_REMOVED);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(NeighbourMatrix_Private(level, facets, fate, covered, &W));
  PetscCall(NormalizeColumns_Private(W));
  PetscCall(VecDuplicate(G, &WG));
  PetscCall(MatMult(W, G, WG));
  PetscCall(VecAXPY(G, 1.0, WG));
  PetscCall(VecDestroy(&WG));
  if (*M) {
    PetscCall(MatMatMult(W, *M, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &WM));
    PetscCall(MatAXPY(WM, 1.0, *M, DIFFERENT_NONZERO_PATTERN));
    PetscCall(MatDestroy(M));
    *M = WM;
  }
  PetscCall(MatDiagonalScale(W, NULL, D));
  *chain = W;
  PetscFunctionReturn(PETSC_SUCCESS);
}
