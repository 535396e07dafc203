/* redistribution.c -- redistribution of removed constraints.

   psi_a + sum_c w_ac psi_c keeps sum psi = 1 and D diagonal on the kept nodes, so constant pressures are
   represented exactly. In 2D this is the constant dual function of Wohlmuth (2000) at the ends of a side.
   Removed nodes lie in rings around the kept ones: ring 1 has kept neighbours, ring k has neighbours in ring
   k - 1. W_k = W_(k-1) N_k, with N_k the mean over them. One ring is usual; more are needed where another
   pair constrains several nodes in a row. */
#include "base/compat.h"
#include "contact/redistribution.h"
#include "level/ghosted.h"

/* Least weight of a kept node with the rows that it takes over, as a share of its own. With less, its dual
   function would be negative on as much of the side as positive. */
static const PetscReal LEFT_OVER = 0.1;

/* Whether two nodes of a facet are neighbours on the lattice of its nodes, with steps of 1 / order along its
   edges. Vertices of a quadratic facet are not, nor opposite ones of a quad. */
static PetscBool RedistributionAreNeighbours_Private(ElementType type, PetscInt i, PetscInt j)
{
  const PetscReal *a = ElementNode(type, i), *b = ElementNode(type, j), longest = 1.5 / ElementOrder(type);
  const PetscReal  x = PetscAbsReal(a[0] - b[0]), y = ElementDim(type) == 1 ? 0 : PetscAbsReal(a[1] - b[1]);

  if (i == j) return PETSC_FALSE;
  if (ElementLinear(type) == ELEMENT_TRI3)
    return (PetscBool)(PetscMax(PetscMax(x, y), PetscAbsReal(a[0] - b[0] + a[1] - b[1])) < longest);
  return (PetscBool)(x + y < longest);
}

/* Assigns ring k, on every rank, to nodes without a ring beside ring k - 1.
   [in,out] ring - [num_nodes], -1 for none; [out] found - whether there was any */
static PetscErrorCode RedistributionNextRing_Private(Level *level, const Facets *facets, const MortarIntegrals *sums,
                                                     PetscInt k, PetscInt ring[], PetscBool *found)
{
  Vec          flags;
  PetscScalar *flag;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, &flags));
  PetscCall(GhostedGetArray(flags, &flag));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * ELEMENT_MAX_FACET_NODES], n = ElementNumNodes(sums->carrier[f]);
    for (PetscInt i = 0; sums->covered[f] && i < n; i++) {
      for (PetscInt j = 0; j < n; j++) {
        if (ring[nodes[i]] == k - 1 && ring[nodes[j]] == -1 &&
            RedistributionAreNeighbours_Private(sums->carrier[f], i, j))
          flag[nodes[j]] = 1;
      }
    }
  }
  PetscCall(GhostedRestoreArray(flags, &flag));
  PetscCall(LevelShareVec(flags, MAX_VALUES));
  *found = PETSC_FALSE;
  PetscCall(GhostedGetArray(flags, &flag));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    if (flag[i] > 0) ring[i] = k;
    *found = (PetscBool)(*found || flag[i] > 0);
  }
  PetscCall(GhostedRestoreArray(flags, &flag));
  PetscCall(VecDestroy(&flags));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, found, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* N diag(1 / column sums). N has ones in row a, column c for every node a of ring k - 1 beside a node c of
   ring k. */
static PetscErrorCode RedistributionNeighbourMeans_Private(Level *level, const Facets *facets,
                                                           const MortarIntegrals *sums, PetscInt k,
                                                           const PetscInt ring[], Mat *N)
{
  Vec       ones, columns;
  PetscInt *entries;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(facets->num, &entries));
  for (PetscInt f = 0; f < facets->num; f++) entries[f] = ElementNumNodes(sums->carrier[f]) - 1;
  PetscCall(MortarIntegralsCreateMat(level, facets, entries, 1, N));
  PetscCall(PetscFree(entries));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * ELEMENT_MAX_FACET_NODES], n = ElementNumNodes(sums->carrier[f]);
    for (PetscInt i = 0; sums->covered[f] && i < n; i++) {
      for (PetscInt j = 0; j < n; j++) {
        if (ring[nodes[i]] != k - 1 || ring[nodes[j]] != k ||
            !RedistributionAreNeighbours_Private(sums->carrier[f], i, j))
          continue;
        PetscCall(MatSetValue(*N, level->node_global[nodes[i]], level->node_global[nodes[j]], 1.0, INSERT_VALUES));
      }
    }
  }
  PetscCall(MatAssemblyBegin(*N, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*N, MAT_FINAL_ASSEMBLY));
  PetscCall(MatCreateVecs(*N, &columns, &ones));
  PetscCall(VecSet(ones, 1.0));
  PetscCall(MatMultTranspose(*N, ones, columns));
  PetscCall(VecReciprocal(columns));
  PetscCall(MatDiagonalScale(*N, NULL, columns));
  PetscCall(VecDestroy(&ones));
  PetscCall(VecDestroy(&columns));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RedistributionWeights(Level *level, const Facets *facets, const MultiplierStatus status[],
                                     const MortarIntegrals *sums, Mat *W)
{
  PetscInt *ring;
  PetscBool found;
  Mat       N, last = NULL, next;

  PetscFunctionBeginUser;
  *W = NULL;
  PetscCall(PetscMalloc1(level->num_nodes, &ring));
  for (PetscInt i = 0; i < level->num_nodes; i++)
    ring[i] = status[i] == NODE_KEPT ? 0 : (status[i] == NODE_REMOVED ? -1 : -2);
  PetscCall(RedistributionNextRing_Private(level, facets, sums, 1, ring, &found));
  for (PetscInt k = 1; found; k++) {
    PetscCall(RedistributionNeighbourMeans_Private(level, facets, sums, k, ring, &N));
    if (last) {
      PetscCall(MatMatMult(last, N, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &next));
      PetscCall(MatAXPY(*W, 1.0, next, DIFFERENT_NONZERO_PATTERN));
      PetscCall(MatDestroy(&last));
      PetscCall(MatDestroy(&N));
      last = next;
    } else {
      PetscCall(MatDuplicate(N, MAT_COPY_VALUES, W));
      last = N;
    }
    PetscCall(RedistributionNextRing_Private(level, facets, sums, k + 1, ring, &found));
  }
  PetscCall(MatDestroy(&last));
  PetscCall(PetscFree(ring));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A := A + W A. */
static PetscErrorCode RedistributionAddSpread_Private(Mat W, Mat *A)
{
  Mat WA;

  PetscFunctionBeginUser;
  PetscCall(MatMatMult(W, *A, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &WA));
  PetscCall(MatAXPY(WA, 1.0, *A, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(A));
  *A = WA;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The same for all components, with W (x) 1. */
static PetscErrorCode RedistributionAddBlockSpread_Private(Mat W, PetscInt dim, Mat *A)
{
  Mat blocks;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateBlocks(W, dim, &blocks));
  PetscCall(RedistributionAddSpread_Private(blocks, A));
  PetscCall(MatDestroy(&blocks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Empties the rows of nodes that are not kept. */
static PetscErrorCode RedistributionKeepRows_Private(const Level *level, const MultiplierStatus status[], Mat A)
{
  Vec          kept;
  PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(A, NULL, &kept));
  PetscCall(VecGetArray(kept, &value));
  for (PetscInt i = 0; i < level->num_owned; i++) value[i] = status[i] == NODE_KEPT ? 1 : 0;
  PetscCall(VecRestoreArray(kept, &value));
  PetscCall(MatDiagonalScale(A, kept, NULL));
  PetscCall(VecDestroy(&kept));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Removes kept nodes whose weight has become too small: rows that they take over may have negative weights.
   [in] W - NULL where no row is redistributed; [out] any - whether there was such a node */
static PetscErrorCode RedistributionRemoveOverdrawn_Private(Mat W, const MortarIntegrals *sums, PetscInt num_nodes,
                                                            MultiplierStatus status[], PetscBool *any)
{
  Vec                total;
  const PetscScalar *D, *t;

  PetscFunctionBeginUser;
  *any = PETSC_FALSE;
  if (!W) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDuplicate(sums->D, &total));
  PetscCall(MatMultAdd(W, sums->D, sums->D, total));
  PetscCall(LevelShareVec(total, INSERT_VALUES));
  PetscCall(GhostedGetArrayRead(total, &t));
  PetscCall(GhostedGetArrayRead(sums->D, &D));
  for (PetscInt i = 0; i < num_nodes; i++) {
    if (status[i] != NODE_KEPT || PetscRealPart(t[i]) >= LEFT_OVER * PetscRealPart(D[i])) continue;
    status[i] = NODE_REMOVED;
    *any      = PETSC_TRUE;
  }
  PetscCall(GhostedRestoreArrayRead(sums->D, &D));
  PetscCall(GhostedRestoreArrayRead(total, &t));
  PetscCall(VecDestroy(&total));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, PetscObjectComm((PetscObject)W)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RedistributionApply(Level *level, const Facets *facets, MultiplierStatus status[], MortarIntegrals *sums,
                                   Mat *D_other)
{
  PetscBool any = PETSC_FALSE;
  Mat       W   = NULL;
  Vec       WG;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < level->num_nodes; i++) any = (PetscBool)(any || status[i] == NODE_REMOVED);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  while (any) {
    PetscCall(MatDestroy(&W));
    PetscCall(RedistributionWeights(level, facets, status, sums, &W));
    PetscCall(RedistributionRemoveOverdrawn_Private(W, sums, level->num_nodes, status, &any));
  }
  if (W) {
    PetscCall(VecDuplicate(sums->G, &WG));
    PetscCall(MatMult(W, sums->G, WG));
    PetscCall(VecAXPY(sums->G, 1.0, WG));
    PetscCall(VecDestroy(&WG));
    if (sums->M) PetscCall(RedistributionAddSpread_Private(W, &sums->M));
    if (sums->arm) PetscCall(RedistributionAddBlockSpread_Private(W, level->dim, &sums->arm));
    if (sums->D_other) PetscCall(RedistributionAddSpread_Private(W, &sums->D_other));
    PetscCall(MatDiagonalScale(W, NULL, sums->D));
    if (sums->D_other) PetscCall(MatAXPY(sums->D_other, 1.0, W, DIFFERENT_NONZERO_PATTERN));
  }
  if (sums->D_other) {
    PetscCall(RedistributionKeepRows_Private(level, status, sums->D_other));
    PetscCall(MatDestroy(&W));
    W = sums->D_other;
  }
  sums->D_other = NULL;
  *D_other      = W;
  PetscFunctionReturn(PETSC_SUCCESS);
}
