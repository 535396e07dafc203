/* integrals.c -- D, M and G of a side as sums at nodes.

   Facets are integrated by the rank that holds them and summed at their nodes' owners, so that no result depends on the
   partition. */
#include <mortise/compat.h>
#include "integrals.h"

/* Number of mortar nodes that each facet meets is bounded by what its row must hold: counts per local node. */
static PetscErrorCode CreateM_Private(Level *level, const Facets *facets, const FacetIntegral integrals[], Mat *M)
{
  Vec          counts, local;
  PetscScalar *ca;
  PetscInt    *d_nnz, *o_nnz;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, &counts));
  PetscCall(VecGhostGetLocalForm(counts, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &ca));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < integrals[f].n; i++)
      ca[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]] += (PetscReal)integrals[f].num_columns;
  }
  PetscCall(VecRestoreArray(local, &ca));
  PetscCall(VecGhostRestoreLocalForm(counts, &local));
  PetscCall(LevelShareVec(counts, ADD_VALUES));
  PetscCall(PetscMalloc2(level->num_owned, &d_nnz, level->num_owned, &o_nnz));
  PetscCall(VecGetArray(counts, &ca));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    d_nnz[i] = PetscMin((PetscInt)PetscRealPart(ca[i]), level->num_owned);
    o_nnz[i] = PetscMin((PetscInt)PetscRealPart(ca[i]), level->num_global - level->num_owned);
  }
  PetscCall(VecRestoreArray(counts, &ca));
  PetscCall(VecDestroy(&counts));
  PetscCall(MatCreateAIJ(level->comm, level->num_owned, level->num_owned, level->num_global, level->num_global, 0,
                         d_nnz, 0, o_nnz, M));
  PetscCall(PetscFree2(d_nnz, o_nnz));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds one facet's integrals to the nodal sums. [in,out] D, full, G - local arrays [num_nodes] */
static PetscErrorCode AddFacet_Private(const Level *level, const PetscInt nodes[], const FacetIntegral *integral,
                                       PetscScalar D[], PetscScalar full[], PetscScalar G[], Mat M)
{
  PetscInt rows[ELEMENT_MAX_FACET_NODES];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < integral->n; i++) {
    rows[i] = level->node_global[nodes[i]];
    D[nodes[i]] += integral->covered[i];
    full[nodes[i]] += integral->full[i];
    G[nodes[i]] += integral->gap[i];
  }
  for (PetscInt j = 0; j < integral->num_columns; j++) {
    PetscCall(MatSetValues(M, integral->n, rows, 1, &integral->columns[j], &integral->M[j * ELEMENT_MAX_FACET_NODES],
                           ADD_VALUES));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums what this rank's facets contribute; ghosts are not yet shared. */
static PetscErrorCode SumFacets_Private(Level *level, const Facets *facets, const FacetIntegral integrals[],
                                        Integrals *sums)
{
  Vec          v[3] = {sums->D, sums->full, sums->G}, local[3];
  PetscScalar *a[3];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 3; i++) {
    PetscCall(VecGhostGetLocalForm(v[i], &local[i]));
    PetscCall(VecZeroEntries(local[i]));
    PetscCall(VecGetArray(local[i], &a[i]));
  }
  for (PetscInt f = 0; f < facets->num; f++) {
    sums->covered[f] = (PetscBool)(integrals[f].covered[0] > 0);
    PetscCall(
        AddFacet_Private(level, &facets->nodes[f * ELEMENT_MAX_FACET_NODES], &integrals[f], a[0], a[1], a[2], sums->M));
  }
  for (PetscInt i = 0; i < 3; i++) {
    PetscCall(VecRestoreArray(local[i], &a[i]));
    PetscCall(VecGhostRestoreLocalForm(v[i], &local[i]));
    PetscCall(LevelShareVec(v[i], ADD_VALUES));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode IntegralsCreate(Level *level, const FacetPartner *partner, const Facets *facets, Vec normals,
                               Integrals *sums)
{
  const PetscInt     dim = level->dim;
  PetscReal          X[3 * ELEMENT_MAX_FACET_NODES], N[3 * ELEMENT_MAX_FACET_NODES];
  const PetscScalar *na;
  FacetIntegral     *integrals;
  Vec                local;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(facets->num, &integrals));
  PetscCall(PetscMalloc1(facets->num, &sums->covered));
  PetscCall(VecGhostGetLocalForm(normals, &local));
  PetscCall(VecGetArrayRead(local, &na));
  for (PetscInt f = 0; f < facets->num; f++) {
    FacetCoordinates(level, facets, f, X);
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      for (PetscInt k = 0; k < dim; k++)
        N[i * dim + k] = PetscRealPart(na[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i] * dim + k]);
    }
    PetscCall(FacetIntegrate(partner, facets->type[f], X, N, &integrals[f]));
  }
  PetscCall(VecRestoreArrayRead(local, &na));
  PetscCall(VecGhostRestoreLocalForm(normals, &local));
  PetscCall(LevelCreateVec(level, 1, &sums->D));
  PetscCall(VecDuplicate(sums->D, &sums->full));
  PetscCall(VecDuplicate(sums->D, &sums->G));
  sums->M = NULL;
  if (partner->mortar) PetscCall(CreateM_Private(level, facets, integrals, &sums->M));
  PetscCall(SumFacets_Private(level, facets, integrals, sums));
  if (sums->M) {
    PetscCall(MatAssemblyBegin(sums->M, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(sums->M, MAT_FINAL_ASSEMBLY));
  }
  for (PetscInt f = 0; f < facets->num; f++) PetscCall(FacetIntegralDestroy(&integrals[f]));
  PetscCall(PetscFree(integrals));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode IntegralsDestroy(Integrals *sums)
{
  PetscFunctionBeginUser;
  PetscCall(VecDestroy(&sums->D));
  PetscCall(VecDestroy(&sums->full));
  PetscCall(VecDestroy(&sums->G));
  PetscCall(PetscFree(sums->covered));
  PetscFunctionReturn(PETSC_SUCCESS);
}
