/* mortarintegrals.c -- D, M and G of a side as sums at nodes.

   Facets are integrated by their rank and summed at the owners of their nodes, so that no result depends on
   the partition. */
#include "base/compat.h"
#include "contact/mortarintegrals.h"
#include "kernel/rise.h"
#include "level/ghosted.h"

PetscErrorCode MortarIntegralsCreateMat(Level *level, const Facets *facets, const PetscInt entries[], PetscInt bs,
                                        Mat *A)
{
  const PetscInt rows = bs * level->num_owned, all = bs * level->num_global;
  Vec            counts;
  PetscScalar   *ca;
  PetscInt      *d_nnz, *o_nnz;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, &counts));
  PetscCall(GhostedGetArray(counts, &ca));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++)
      ca[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]] += (PetscReal)entries[f];
  }
  PetscCall(GhostedRestoreArray(counts, &ca));
  PetscCall(LevelShareVec(counts, ADD_VALUES));
  PetscCall(PetscMalloc2(rows, &d_nnz, rows, &o_nnz));
  PetscCall(VecGetArray(counts, &ca));
  for (PetscInt i = 0; i < rows; i++) {
    d_nnz[i] = PetscMin(bs * (PetscInt)PetscRealPart(ca[i / bs]), rows);
    o_nnz[i] = PetscMin(bs * (PetscInt)PetscRealPart(ca[i / bs]), all - rows);
  }
  PetscCall(VecRestoreArray(counts, &ca));
  PetscCall(VecDestroy(&counts));
  PetscCall(MatCreateAIJ(level->comm, rows, rows, all, all, 0, d_nnz, 0, o_nnz, A));
  PetscCall(MatSetBlockSize(*A, bs));
  PetscCall(PetscFree2(d_nnz, o_nnz));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds one facet's entries to M and D_other. */
static PetscErrorCode MortarIntegralsAddCouplings_Private(const Level *level, const Facets *facets, PetscInt f,
                                                          const FacetIntegral *integral, MortarIntegrals *sums)
{
  const PetscInt n = integral->n, num_nodes = ElementNumNodes(facets->type[f]);
  PetscInt       nodes[ELEMENT_MAX_FACET_NODES];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num_nodes; i++)
    nodes[i] = level->node_global[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]];
  for (PetscInt j = 0; j < integral->num_columns; j++) {
    PetscCall(MatSetValues(sums->M, n, nodes, 1, &integral->columns[j], &integral->M[j * ELEMENT_MAX_FACET_NODES],
                           ADD_VALUES));
  }
  for (PetscInt i = 0; i < n && num_nodes > n; i++)
    PetscCall(
        MatSetValues(sums->D_other, 1, &nodes[i], num_nodes - n, &nodes[n], &integral->D_other[i][n], ADD_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds one facet's blocks to the arm. */
static PetscErrorCode MortarIntegralsAddArm_Private(const Level *level, const Facets *facets, PetscInt f,
                                                    const FacetIntegral *integral, Mat arm)
{
  const PetscInt squares = level->dim * level->dim;

  PetscFunctionBeginUser;
  for (PetscInt j = 0; integral->has_arm && j < integral->num_columns; j++) {
    for (PetscInt i = 0; i < integral->n; i++) {
      const PetscInt row = level->node_global[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]];

      PetscCall(MatSetValuesBlocked(arm, 1, &row, 1, &integral->columns[j],
                                    &integral->arm[(j * ELEMENT_MAX_FACET_NODES + i) * squares], ADD_VALUES));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Collects the overlap boundary, and marks the nodes of facets that are covered in part or completely.
   Collective. */
static PetscErrorCode MortarIntegralsGatherBoundary_Private(const Facets *facets, const FacetIntegral integrals[],
                                                            MortarIntegrals *sums)
{
  Vec          v[2] = {sums->fully_covered, sums->partly_covered}, local[2];
  PetscScalar *a[2];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 2; i++) {
    PetscCall(VecGhostGetLocalForm(v[i], &local[i]));
    PetscCall(VecZeroEntries(local[i]));
    PetscCall(VecGetArray(local[i], &a[i]));
  }
  sums->num_boundary = 0;
  for (PetscInt f = 0; f < facets->num; f++) sums->num_boundary += integrals[f].num_boundary;
  PetscCall(PetscMalloc1(sums->num_boundary, &sums->boundary));
  for (PetscInt f = 0, n = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * ELEMENT_MAX_FACET_NODES];

    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      if (integrals[f].fully_covered) a[0][nodes[i]] = 1;
      if (integrals[f].partly_covered) a[1][nodes[i]] = 1;
    }
    for (PetscInt i = 0; i < integrals[f].num_boundary; i++, n++) {
      sums->boundary[n]      = integrals[f].boundary[i];
      sums->boundary[n].node = nodes[0];
    }
  }
  for (PetscInt i = 0; i < 2; i++) {
    PetscCall(VecRestoreArray(local[i], &a[i]));
    PetscCall(VecGhostRestoreLocalForm(v[i], &local[i]));
    PetscCall(LevelShareVec(v[i], MAX_VALUES));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest overlap at a point of the facets around each node. Collective. */
static PetscErrorCode MortarIntegralsSetOverlap_Private(const Facets *facets, const FacetIntegral integrals[],
                                                        Vec overlap)
{
  Vec          local;
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(overlap, &local));
  PetscCall(VecSet(local, PETSC_MIN_REAL));
  PetscCall(VecGetArray(local, &a));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < integrals[f].n; i++) {
      PetscScalar *at = &a[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]];

      *at = PetscMax(PetscRealPart(*at), -integrals[f].least_gap);
    }
  }
  PetscCall(VecRestoreArray(local, &a));
  PetscCall(VecGhostRestoreLocalForm(overlap, &local));
  PetscCall(LevelShareVec(overlap, MAX_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums the contributions of this rank's facets; ghosts are not yet shared. */
static PetscErrorCode MortarIntegralsSumFacets_Private(Level *level, const Facets *facets,
                                                       const FacetIntegral integrals[], MortarIntegrals *sums)
{
  enum { NUM_SUMS = 5 };
  Vec          v[NUM_SUMS] = {sums->D, sums->full, sums->G, sums->measure, sums->cover}, local[NUM_SUMS];
  PetscScalar *a[NUM_SUMS];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < NUM_SUMS; i++) {
    PetscCall(VecGhostGetLocalForm(v[i], &local[i]));
    PetscCall(VecZeroEntries(local[i]));
    PetscCall(VecGetArray(local[i], &a[i]));
  }
  for (PetscInt f = 0; f < facets->num; f++) {
    PetscReal measure = 0; // single integrals of shape functions may be negative, their sum is the covered measure
    for (PetscInt i = 0; i < integrals[f].n; i++) {
      const PetscInt node = facets->nodes[f * ELEMENT_MAX_FACET_NODES + i];
      a[0][node] += integrals[f].covered[i];
      a[1][node] += integrals[f].full[i];
      a[2][node] += integrals[f].gap[i];
      a[3][node] += integrals[f].measure;
      a[4][node] += integrals[f].cover;
      measure += integrals[f].covered[i];
    }
    sums->covered[f] = (PetscBool)(measure > 0);
    PetscCall(MortarIntegralsAddCouplings_Private(level, facets, f, &integrals[f], sums));
  }
  for (PetscInt i = 0; i < NUM_SUMS; i++) {
    PetscCall(VecRestoreArray(local[i], &a[i]));
    PetscCall(VecGhostRestoreLocalForm(v[i], &local[i]));
    PetscCall(LevelShareVec(v[i], ADD_VALUES));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* An empty M for the mortar nodes of all facets; NULL for an obstacle. Collective. */
static PetscErrorCode MortarIntegralsCreateM_Private(Level *level, const FacetPartner *partner, const Facets *facets,
                                                     const FacetIntegral integrals[], Mat *M)
{
  PetscInt *entries;

  PetscFunctionBeginUser;
  *M = NULL;
  if (!partner->mortar || partner->gap_only) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(facets->num, &entries));
  for (PetscInt f = 0; f < facets->num; f++) entries[f] = integrals[f].num_columns;
  PetscCall(MortarIntegralsCreateMat(level, facets, entries, 1, M));
  PetscCall(PetscFree(entries));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Creates an empty D_other for nodes without multipliers; NULL where all nodes may have one. Collective. */
static PetscErrorCode MortarIntegralsCreateOffDiagonal_Private(Level *level, const Facets *facets,
                                                               const ElementType carrier[], Mat *chain)
{
  PetscInt *entries;
  PetscBool any = PETSC_FALSE;

  PetscFunctionBeginUser;
  *chain = NULL;
  for (PetscInt f = 0; f < facets->num; f++) any = (PetscBool)(any || carrier[f] != facets->type[f]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(facets->num, &entries));
  for (PetscInt f = 0; f < facets->num; f++)
    entries[f] = ElementNumNodes(facets->type[f]) - ElementNumNodes(carrier[f]);
  PetscCall(MortarIntegralsCreateMat(level, facets, entries, 1, chain));
  PetscCall(PetscFree(entries));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Creates the arm of a tie; NULL where its sides touch. Collective. */
static PetscErrorCode MortarIntegralsCreateArm_Private(Level *level, const FacetPartner *partner, const Facets *facets,
                                                       const FacetIntegral integrals[], Mat *arm)
{
  PetscBool any = PETSC_FALSE;
  PetscInt *entries;

  PetscFunctionBeginUser;
  *arm = NULL;
  if (partner->spec->type != PAIR_TIED) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt f = 0; f < facets->num; f++) any = (PetscBool)(any || integrals[f].has_arm);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(facets->num, &entries));
  for (PetscInt f = 0; f < facets->num; f++) entries[f] = integrals[f].has_arm ? integrals[f].num_columns : 0;
  PetscCall(MortarIntegralsCreateMat(level, facets, entries, level->dim, arm));
  PetscCall(PetscFree(entries));
  for (PetscInt f = 0; f < facets->num; f++)
    PetscCall(MortarIntegralsAddArm_Private(level, facets, f, &integrals[f], *arm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Assembles a matrix. */
static PetscErrorCode MortarIntegralsAssemble_Private(Mat A)
{
  PetscFunctionBeginUser;
  if (!A) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Hanging nodes of a mortar side have the displacement of the nodes that they hang on: M := M S. The arm
   follows the same rule. Collective. */
static PetscErrorCode MortarIntegralsConform_Private(Level *level, MortarIntegrals *sums)
{
  Mat  S, product;
  Mat *A[2] = {&sums->M, &sums->arm};

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 2 && level->conforming; i++) {
    if (!*A[i]) continue;
    PetscCall(LevelCreateBlocks(level->conforming, i ? level->dim : 1, &S));
    PetscCall(MatMatMult(*A[i], S, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
    PetscCall(MatProductClear(product)); // it would keep its factors
    PetscCall(MatDestroy(&S));
    PetscCall(MatDestroy(A[i]));
    *A[i] = product;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The integrals over each facet.
   [in,out] sums - its carrying nodes; points and carriers of facets are added; [out] integrals - [num] */
static PetscErrorCode MortarIntegralsCompute_Private(Level *level, const FacetPartner *partner, const Facets *facets,
                                                     Vec normals, MortarIntegrals *sums, FacetIntegral integrals[])
{
  const PetscInt     dim = level->dim;
  PetscReal          X[3 * ELEMENT_MAX_FACET_NODES], N[3 * ELEMENT_MAX_FACET_NODES];
  const PetscScalar *na;
  const Facets      *at = &sums->carrying.facets;
  OverlapPoints      list;

  PetscFunctionBeginUser;
  PetscCall(OverlapPointsCreate(dim, &list));
  PetscCall(GhostedGetArrayRead(normals, &na));
  for (PetscInt f = 0; f < facets->num; f++) {
    const ClipFacet facet  = {facets->type[f], X, N};
    const PetscInt  number = sums->carrying.number[f];
    FacetRows       rows   = {.nodes = number < 0 ? NULL : &sums->carrying.functions[number]};

    sums->carrier[f] = FacetIntegralCarrier(partner->spec, facets->type[f]);
    ContactFacetCoordinates(level, facets, f, X);
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      for (PetscInt k = 0; k < dim; k++)
        N[i * dim + k] = PetscRealPart(na[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i] * dim + k]);
      for (PetscInt k = 0; k < dim; k++)
        rows.N[i * dim + k] = PetscRealPart(na[at->nodes[f * ELEMENT_MAX_FACET_NODES + i] * dim + k]);
    }
    PetscCall(FacetIntegralCompute(
        partner, &facet, &rows, partner->rises ? &partner->rises[f * RISE_TERMS * dim] : NULL, &list, &integrals[f]));
    if (sums->points) PetscCall(PairPointsAdd(sums->points, f, &list));
  }
  PetscCall(GhostedRestoreArrayRead(normals, &na));
  PetscCall(OverlapPointsDestroy(&list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortarIntegralsCreate(Level *level, const FacetPartner *partner, const Facets *facets, Vec normals,
                                     MortarIntegrals *sums)
{
  const Facets  *at = &sums->carrying.facets;
  FacetIntegral *integrals;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(facets->num, &integrals));
  PetscCall(CarryingNodesCreate(level, facets, &sums->carrying));
  sums->points = NULL;
  if (!partner->gap_only) PetscCall(PairPointsCreate(&sums->points));
  PetscCall(PetscMalloc2(facets->num, &sums->covered, facets->num, &sums->carrier));
  PetscCall(MortarIntegralsCompute_Private(level, partner, facets, normals, sums, integrals));
  PetscCall(LevelCreateVec(level, 1, &sums->D));
  PetscCall(VecDuplicate(sums->D, &sums->full));
  PetscCall(VecDuplicate(sums->D, &sums->G));
  PetscCall(VecDuplicate(sums->D, &sums->overlap));
  PetscCall(VecDuplicate(sums->D, &sums->measure));
  PetscCall(VecDuplicate(sums->D, &sums->cover));
  PetscCall(VecDuplicate(sums->D, &sums->fully_covered));
  PetscCall(VecDuplicate(sums->D, &sums->partly_covered));
  PetscCall(MortarIntegralsCreateM_Private(level, partner, at, integrals, &sums->M));
  PetscCall(MortarIntegralsCreateArm_Private(level, partner, at, integrals, &sums->arm));
  PetscCall(MortarIntegralsCreateOffDiagonal_Private(level, at, sums->carrier, &sums->D_other));
  PetscCall(MortarIntegralsSumFacets_Private(level, at, integrals, sums));
  PetscCall(MortarIntegralsSetOverlap_Private(at, integrals, sums->overlap));
  PetscCall(MortarIntegralsGatherBoundary_Private(at, integrals, sums));
  PetscCall(MortarIntegralsAssemble_Private(sums->M));
  PetscCall(MortarIntegralsAssemble_Private(sums->arm));
  PetscCall(MortarIntegralsAssemble_Private(sums->D_other));
  PetscCall(MortarIntegralsConform_Private(level, sums));
  for (PetscInt f = 0; f < facets->num; f++) PetscCall(FacetIntegralDestroy(&integrals[f]));
  PetscCall(PetscFree(integrals));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortarIntegralsDestroy(MortarIntegrals *sums)
{
  PetscFunctionBeginUser;
  PetscCall(VecDestroy(&sums->D));
  PetscCall(VecDestroy(&sums->full));
  PetscCall(VecDestroy(&sums->G));
  PetscCall(VecDestroy(&sums->overlap));
  PetscCall(VecDestroy(&sums->measure));
  PetscCall(VecDestroy(&sums->cover));
  PetscCall(VecDestroy(&sums->fully_covered));
  PetscCall(VecDestroy(&sums->partly_covered));
  PetscCall(PetscFree(sums->boundary));
  PetscCall(PairPointsDestroy(&sums->points));
  PetscCall(MatDestroy(&sums->arm));
  PetscCall(MatDestroy(&sums->D_other));
  PetscCall(CarryingNodesDestroy(&sums->carrying));
  PetscCall(PetscFree2(sums->covered, sums->carrier));
  PetscFunctionReturn(PETSC_SUCCESS);
}
