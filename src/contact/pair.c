/* pair.c -- one contact pair: normals, integrals, and who carries a multiplier.

   Everything is computed once, in the reference configuration (the bodies move little). Facets are integrated by the rank
   that holds them and summed at their nodes' owners, so that no result depends on the partition. */
#include <mortise/compat.h>
#include <mortise/frame.h>
#include <mortise/pair.h>
#include "integrals.h"
#include "spread.h"

/* A normal whose free part is shorter than this is held: no multiplier. */
static const PetscReal HELD_NORMAL = 0.1;
/* Covered share of a node's support below which its pressure could not be recovered accurately. */
static const PetscReal SLIVER = 1e-3;
/* Covered share that is nothing but roundoff. */
static const PetscReal NOTHING = 1e-13;
/* Two constraints at one node need normals that differ by at least 20 degrees. */
static const PetscReal SAME_DIRECTION = 0.93969262078590838;
/* Facets within this many facet sizes of the other side are candidates ... */
static const PetscReal REACH_FACETS = 3;
/* ... and within twice the largest prescribed displacement, and within a tenth of the smaller side: what approaches from
   farther away does not move little. */
static const PetscReal REACH_PRESCRIBED = 2, REACH_SIDE = 0.1;

/* Diagonal of the box around a side, over all ranks; 0 for an empty one. */
static PetscErrorCode SideExtent_Private(const Level *level, const Facets *facets, PetscReal *extent)
{
  PetscReal bounds[6], d2 = 0; // upper bounds of x and of -x

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 6; k++) bounds[k] = PETSC_MIN_REAL;
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      const PetscReal *x = &level->coords[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i] * level->dim];
      for (PetscInt k = 0; k < level->dim; k++) {
        bounds[k]     = PetscMax(bounds[k], x[k]);
        bounds[3 + k] = PetscMax(bounds[3 + k], -x[k]);
      }
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bounds, 6, MPIU_REAL, MPIU_MAX, level->comm));
  for (PetscInt k = 0; k < level->dim; k++) d2 += PetscSqr(bounds[k] + bounds[3 + k]);
  *extent = bounds[0] > PETSC_MIN_REAL ? PetscSqrtReal(d2) : 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How far apart faces are still candidates. [in] mortar - NULL for an obstacle */
static PetscErrorCode ChooseReach_Private(const ScenePair *spec, Level *level, const Support *held,
                                          const Facets *nonmortar, const Facets *mortar, PetscReal *reach)
{
  PetscReal size, extent, extent_m;

  PetscFunctionBeginUser;
  *reach = spec->reach;
  if (spec->reach >= 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FacetsMaxSize(level, nonmortar, &size));
  PetscCall(SideExtent_Private(level, nonmortar, &extent));
  if (mortar) {
    PetscCall(SideExtent_Private(level, mortar, &extent_m));
    extent = PetscMin(extent, extent_m);
  }
  *reach = PetscMax(REACH_FACETS * size, PetscMax(REACH_PRESCRIBED * held->max_value, REACH_SIDE * extent));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* n := Pi n / |Pi n| with Pi the projection onto the free directions of a node. Returns whether n is free at all. */
static PetscBool ProjectNormal_Private(const Support *held, PetscInt node, PetscReal n[])
{
  const PetscInt dim = held->dim;

  for (PetscInt j = 0; j < held->count[node]; j++) {
    const PetscReal *d   = &held->directions[(node * dim + j) * dim];
    PetscReal        dot = 0;
    for (PetscInt k = 0; k < dim; k++) dot += d[k] * n[k];
    for (PetscInt k = 0; k < dim; k++) n[k] -= dot * d[k];
  }
  if (held->count[node] == 0) return PETSC_TRUE;
  return (PetscBool)(held->count[node] < dim && FrameNormalize(dim, n) >= HELD_NORMAL);
}

/* Whether an earlier pair's multiplier at the node holds nearly the same direction. [in] taken - [dim] */
static PetscBool SameDirection_Private(PetscInt dim, const PetscReal n[], const PetscScalar taken[])
{
  PetscReal dot = 0;

  for (PetscInt k = 0; k < dim; k++) dot += n[k] * PetscRealPart(taken[k]);
  return (PetscBool)(PetscAbsReal(dot) > SAME_DIRECTION);
}

/* Decides which nodes keep a multiplier. Normals of kept nodes lose their held part and are entered in taken.
   [in,out] N - local normals [num_nodes][dim]; [in,out] taken - local [num_nodes][dim]; [out] fate - [num_nodes] */
static PetscErrorCode DecideFates_Private(const Level *level, const ScenePair *spec, const Support *held,
                                          const Integrals *sums, PetscScalar N[], PetscScalar taken[], NodeFate fate[])
{
  const PetscInt     dim = level->dim;
  const PetscScalar *D, *full;
  Vec                local_D, local_full;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(sums->D, &local_D));
  PetscCall(VecGhostGetLocalForm(sums->full, &local_full));
  PetscCall(VecGetArrayRead(local_D, &D));
  PetscCall(VecGetArrayRead(local_full, &full));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    const PetscReal share = PetscRealPart(full[i]) > 0 ? PetscRealPart(D[i]) / PetscRealPart(full[i]) : 0;
    PetscReal       n[3];
    fate[i] = NODE_UNCOVERED;
    if (share <= NOTHING) continue;
    for (PetscInt k = 0; k < dim; k++) n[k] = PetscRealPart(N[i * dim + k]);
    fate[i] = NODE_REMOVED;
    if (share < SLIVER || !ProjectNormal_Private(held, i, n) || SameDirection_Private(dim, n, &taken[i * dim]))
      continue;
    if (spec->type == PAIR_TIED && held->count[i] > 0) continue; // a tie needs all directions; its neighbours take over
    fate[i] = NODE_KEPT;
    for (PetscInt k = 0; k < dim; k++) {
      N[i * dim + k] = n[k];
      taken[i * dim + k] += n[k];
    }
  }
  PetscCall(VecRestoreArrayRead(local_full, &full));
  PetscCall(VecRestoreArrayRead(local_D, &D));
  PetscCall(VecGhostRestoreLocalForm(sums->full, &local_full));
  PetscCall(VecGhostRestoreLocalForm(sums->D, &local_D));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows (n, t..): t is the held direction where there is one, so that held unknowns stay single. [out] Q - [dim][dim] */
static void NodeFrame_Private(const Support *held, PetscInt node, const PetscReal n[], PetscReal Q[])
{
  const PetscInt   dim = held->dim;
  const PetscReal *d   = &held->directions[node * dim * dim];

  FrameFromNormal(dim, n, Q);
  if (held->count[node] == 0) return;
  for (PetscInt k = 0; k < dim; k++) Q[dim + k] = d[k];
  if (dim == 3) {
    for (PetscInt k = 0; k < 3; k++) Q[6 + k] = n[(k + 1) % 3] * d[(k + 2) % 3] - n[(k + 2) % 3] * d[(k + 1) % 3];
  }
}

/* Fills the pair's plain arrays from the nodes that this rank owns. [in] N - local normals; [in] fate - [num_nodes] */
static PetscErrorCode CollectNodes_Private(Level *level, const Support *held, const Integrals *sums,
                                           const PetscScalar N[], const NodeFate fate[], Pair pair)
{
  const PetscInt     dim      = level->dim;
  PetscInt           count[3] = {0, 0, 0};
  const PetscScalar *D, *G, *full;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(sums->D, &D));
  PetscCall(VecGetArrayRead(sums->G, &G));
  PetscCall(VecGetArrayRead(sums->full, &full));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    if (PetscRealPart(full[i]) > 0) count[fate[i]]++;
  }
  pair->num = count[NODE_KEPT];
  PetscCall(PetscMalloc5(pair->num, &pair->nodes, pair->num, &pair->D, pair->num, &pair->gap, pair->num * dim,
                         &pair->normal, pair->num * dim * dim, &pair->frame));
  for (PetscInt i = 0, k = 0; i < level->num_owned; i++) {
    if (fate[i] != NODE_KEPT) continue;
    pair->nodes[k] = i;
    pair->D[k]     = PetscRealPart(D[i]);
    pair->gap[k]   = PetscRealPart(G[i]) / pair->D[k];
    for (PetscInt j = 0; j < dim; j++) pair->normal[k * dim + j] = PetscRealPart(N[i * dim + j]);
    NodeFrame_Private(held, i, &pair->normal[k * dim], &pair->frame[k * dim * dim]);
    k++;
  }
  PetscCall(VecRestoreArrayRead(sums->full, &full));
  PetscCall(VecRestoreArrayRead(sums->G, &G));
  PetscCall(VecRestoreArrayRead(sums->D, &D));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 3, MPIU_INT, MPI_SUM, level->comm));
  pair->num_uncovered   = count[NODE_UNCOVERED];
  pair->num_removed     = count[NODE_REMOVED];
  pair->num_multipliers = count[NODE_KEPT];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* From integrals to a pair: fates, spreading, arrays. */
static PetscErrorCode FinishPair_Private(Level *level, const Support *held, const Facets *nonmortar, Vec normals,
                                         Vec taken, Integrals *sums, Pair pair)
{
  Vec          local_normals, local_taken;
  PetscScalar *N, *t;
  NodeFate    *fate;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_nodes, &fate));
  PetscCall(VecGhostGetLocalForm(normals, &local_normals));
  PetscCall(VecGhostGetLocalForm(taken, &local_taken));
  PetscCall(VecGetArray(local_normals, &N));
  PetscCall(VecGetArray(local_taken, &t));
  PetscCall(DecideFates_Private(level, pair->spec, held, sums, N, t, fate));
  PetscCall(SpreadRemovedRows(level, nonmortar, fate, sums->covered, sums->D, sums->G, &sums->M, &pair->chain));
  PetscCall(CollectNodes_Private(level, held, sums, N, fate, pair));
  PetscCall(VecRestoreArray(local_taken, &t));
  PetscCall(VecRestoreArray(local_normals, &N));
  PetscCall(VecGhostRestoreLocalForm(taken, &local_taken));
  PetscCall(VecGhostRestoreLocalForm(normals, &local_normals));
  PetscCall(PetscFree(fate));
  pair->M = sums->M;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairCreate(Scene scene, const ScenePair *spec, Level *level, const Support *held, Vec taken, Pair *pair)
{
  Facets          nonmortar, mortar = {0, NULL, NULL, NULL};
  MortarSurface   surface;
  FacetPartner    partner = {.spec = spec, .mortar = NULL, .dim = level->dim};
  const PetscBool meshed  = (PetscBool)(spec->mortar.body >= 0);
  Integrals       sums;
  Vec             normals;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(pair));
  (*pair)->spec  = spec;
  (*pair)->level = level;
  PetscCall(LevelGetFacets(level, scene, spec->nonmortar.body, spec->nonmortar.side, &nonmortar));
  if (meshed) {
    PetscCall(LevelGetFacets(level, scene, spec->mortar.body, spec->mortar.side, &mortar));
    PetscCall(MortarSurfaceCreate(level, &mortar, &surface));
    partner.mortar = &surface;
  }
  PetscCall(ChooseReach_Private(spec, level, held, &nonmortar, meshed ? &mortar : NULL, &partner.reach));
  PetscCall(NodalNormalsCreate(level, &nonmortar, &normals));
  PetscCall(IntegralsCreate(level, &partner, &nonmortar, normals, &sums));
  PetscCall(ExpressionCheck(level->comm, spec->gap));
  PetscCall(ExpressionCheck(level->comm, spec->gap_offset));
  PetscCall(ExpressionCheck(level->comm, spec->obstacle.gap));
  PetscCall(FinishPair_Private(level, held, &nonmortar, normals, taken, &sums, *pair));
  (*pair)->reach                = partner.reach;
  (*pair)->num_facets_nonmortar = nonmortar.num;
  (*pair)->num_facets_mortar    = meshed ? surface.num : 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &(*pair)->num_facets_nonmortar, 1, MPIU_INT, MPI_SUM, level->comm));
  PetscCall(IntegralsDestroy(&sums));
  PetscCall(VecDestroy(&normals));
  if (meshed) PetscCall(MortarSurfaceDestroy(&surface));
  PetscCall(FacetsDestroy(&mortar));
  PetscCall(FacetsDestroy(&nonmortar));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairDestroy(Pair *pair)
{
  PetscFunctionBeginUser;
  if (!*pair) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatDestroy(&(*pair)->M));
  PetscCall(MatDestroy(&(*pair)->chain));
  PetscCall(PetscFree5((*pair)->nodes, (*pair)->D, (*pair)->gap, (*pair)->normal, (*pair)->frame));
  PetscCall(PetscFree(*pair));
  PetscFunctionReturn(PETSC_SUCCESS);
}
