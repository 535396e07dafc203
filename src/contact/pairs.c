/* pairs.c -- all contact pairs, from sides to multipliers.

   All is computed once, in the undeformed configuration. All pairs are integrated before nodes with
   multipliers are chosen: a node can be in several pairs, but each of its directions in only one. */
#include "base/compat.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "contact/heldrows.h"
#include "contact/multiplierstatus.h"
#include "contact/pairintegrals.h"
#include "contact/pairpoints.h"
#include "contact/pairs.h"
#include "contact/quadraticbasis.h"
#include "contact/slidingnodes.h"

/* A removed node with less than this part of its facets covered lies outside its partner; at the partner's
   end it would be half. */
static const PetscReal BEYOND = 0.45;

/* Rows (n, t..): t is the fixed direction where there is one, so that fixed unknowns stay single.
   [out] Q - [dim][dim] */
static void PairsSetFrame_Private(const Support *support, PetscInt node, const PetscReal n[], PetscReal Q[])
{
  const PetscInt   dim = support->dim;
  const PetscReal *d   = &support->directions[node * dim * dim];

  FrameFromNormal(dim, n, Q);
  if (support->count[node] == 0) return;
  for (PetscInt k = 0; k < dim; k++) Q[dim + k] = d[k];
  if (dim == 3) VectorCross(n, d, &Q[6]);
}

/* Fills the pair's plain arrays from the nodes that this rank owns. Collective. */
static PetscErrorCode PairsCollectNodes_Private(Level *level, const Support *support, const PairAssembly *assembly,
                                                Pair pair)
{
  const PetscInt     dim      = level->dim;
  PetscInt           count[3] = {0, 0, 0};
  const PetscScalar *D, *G, *measure, *cover, *overlap, *N, *fully_covered, *partly_covered;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(assembly->sums.D, &D));
  PetscCall(VecGetArrayRead(assembly->sums.G, &G));
  PetscCall(VecGetArrayRead(assembly->sums.measure, &measure));
  PetscCall(VecGetArrayRead(assembly->sums.cover, &cover));
  PetscCall(VecGetArrayRead(assembly->sums.overlap, &overlap));
  PetscCall(VecGetArrayRead(assembly->normals, &N));
  PetscCall(VecGetArrayRead(assembly->sums.fully_covered, &fully_covered));
  PetscCall(VecGetArrayRead(assembly->sums.partly_covered, &partly_covered));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    if (PetscRealPart(measure[i]) > 0) count[assembly->status[i]]++;
  }
  pair->num = count[NODE_KEPT];
  PetscCall(PetscMalloc5(pair->num, &pair->nodes, pair->num, &pair->D, pair->num, &pair->gap, pair->num * dim,
                         &pair->normal, pair->num * dim * dim, &pair->frame));
  PetscCall(PetscMalloc4(pair->num, &pair->partly_covered, pair->num, &pair->fully_covered, pair->num, &pair->overlap,
                         pair->num, &pair->cover));
  PetscCall(PetscMalloc1(count[NODE_REMOVED], &pair->beyond));
  for (PetscInt i = 0, k = 0; i < level->num_owned; i++) {
    if (assembly->status[i] == NODE_REMOVED && PetscRealPart(cover[i]) < BEYOND * PetscRealPart(measure[i]))
      pair->beyond[pair->num_beyond++] = i;
    if (assembly->status[i] != NODE_KEPT) continue;
    pair->nodes[k]   = i;
    pair->D[k]       = PetscRealPart(D[i]);
    pair->gap[k]     = PetscRealPart(G[i]) / pair->D[k];
    pair->overlap[k] = PetscRealPart(overlap[i]);
    pair->cover[k]   = PetscRealPart(cover[i] / measure[i]);
    for (PetscInt j = 0; j < dim; j++) pair->normal[k * dim + j] = PetscRealPart(N[i * dim + j]);
    pair->fully_covered[k]  = (PetscBool)(PetscRealPart(fully_covered[i]) > 0);
    pair->partly_covered[k] = (PetscBool)(PetscRealPart(partly_covered[i]) > 0);
    PairsSetFrame_Private(support, i, &pair->normal[k * dim], &pair->frame[k * dim * dim]);
    k++;
  }
  PetscCall(VecRestoreArrayRead(assembly->sums.partly_covered, &partly_covered));
  PetscCall(VecRestoreArrayRead(assembly->sums.fully_covered, &fully_covered));
  PetscCall(VecRestoreArrayRead(assembly->normals, &N));
  PetscCall(VecRestoreArrayRead(assembly->sums.overlap, &overlap));
  PetscCall(VecRestoreArrayRead(assembly->sums.cover, &cover));
  PetscCall(VecRestoreArrayRead(assembly->sums.measure, &measure));
  PetscCall(VecRestoreArrayRead(assembly->sums.G, &G));
  PetscCall(VecRestoreArrayRead(assembly->sums.D, &D));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 3, MPIU_INT, MPI_SUM, level->comm));
  pair->num_uncovered   = count[NODE_UNCOVERED];
  pair->num_removed     = count[NODE_REMOVED];
  pair->num_multipliers = count[NODE_KEPT];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moves the points to the pair, with the facets of their side. Not collective. */
static void PairsTakePoints_Private(PairAssembly *assembly, Pair pair)
{
  pair->points          = assembly->sums.points;
  pair->points->facets  = assembly->nonmortar;
  pair->points->rises   = assembly->rises;
  pair->points->normals = assembly->normals;
  assembly->sums.points = NULL;
  assembly->nonmortar   = (Facets){0};
  assembly->rises       = NULL;
  assembly->normals     = NULL;
}

/* Sums of the rows of D, over D_aa. Collective. */
static PetscErrorCode PairsSetShares_Private(Level *level, Pair pair)
{
  const PetscScalar *value;
  Vec                one, sums;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(pair->num, &pair->share));
  PetscCall(LevelCreateVec(level, 1, &one));
  PetscCall(VecSet(one, 1.0));
  PetscCall(VecDuplicate(one, &sums));
  if (pair->from_nodal) {
    PetscCall(MatMult(pair->from_nodal, one, sums));
    PetscCall(VecAXPY(one, 1.0, sums));
  }
  PetscCall(VecGetArrayRead(one, &value));
  for (PetscInt k = 0; k < pair->num; k++) pair->share[k] = PetscRealPart(value[pair->nodes[k]]);
  PetscCall(VecRestoreArrayRead(one, &value));
  if (pair->D_other) {
    PetscCall(MatMult(pair->D_other, one, sums));
    PetscCall(VecGetArrayRead(sums, &value));
    for (PetscInt k = 0; k < pair->num; k++) pair->share[k] += PetscRealPart(value[pair->nodes[k]]) / pair->D[k];
    PetscCall(VecRestoreArrayRead(sums, &value));
  }
  PetscCall(VecDestroy(&sums));
  PetscCall(VecDestroy(&one));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Redistributes removed rows and collects kept ones. Collective. */
static PetscErrorCode PairsFinish_Private(Level *level, const Support *support, PairAssembly *assembly, Pair pair)
{
  MortarIntegrals *sums = &assembly->sums;

  PetscFunctionBeginUser;
  PetscCall(QuadraticBasisCreate(level, &sums->carrying.facets, sums->carrier, &pair->to_nodal, &pair->from_nodal));
  if (ScenePairHasFriction(pair->spec))
    PetscCall(SlidingNodesRemove(level, support, &sums->carrying.facets, sums, assembly->status));
  PetscCall(RedistributionApply(level, &sums->carrying.facets, assembly->status, sums, &pair->D_other));
  if (pair->spec->type == PAIR_TIED && sums->M)
    PetscCall(HeldRowsPass(level, support, &sums->carrying.facets, assembly->status, sums, pair));
  PetscCall(PairsCollectNodes_Private(level, support, assembly, pair));
  PetscCall(PairsSetShares_Private(level, pair));
  pair->M            = sums->M;
  pair->arm          = sums->arm;
  sums->arm          = NULL;
  pair->num_boundary = sums->num_boundary;
  pair->boundary     = sums->boundary;
  sums->boundary     = NULL;
  if (ScenePairHasFriction(pair->spec)) {
    PetscCall(PetscMalloc1(pair->num, &pair->slides));
    PetscCall(SlidingNodesFindEver(level, support, pair->M, pair->num, pair->nodes, pair->D, pair->slides));
  }
  PairsTakePoints_Private(assembly, pair);
  PetscCall(PairAssemblyDestroy(assembly));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairsCreate(Scene scene, Level *level, const Support *support, Pair pairs[])
{
  PairAssembly *assemblies;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(scene->num_pairs, &assemblies));
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    PetscCall(PetscNew(&pairs[p]));
    pairs[p]->spec  = &scene->pairs[p];
    pairs[p]->level = level;
    PetscCall(PairIntegralsCompute(scene, level, support, pairs[p], &assemblies[p]));
  }
  PetscCall(MultiplierStatusResolve(level, scene->num_pairs, assemblies));
  for (PetscInt p = 0; p < scene->num_pairs; p++)
    PetscCall(PairsFinish_Private(level, support, &assemblies[p], pairs[p]));
  PetscCall(PetscFree(assemblies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether two pairs have multipliers at the same nodes of this rank. */
static PetscBool PairsIsAlike_Private(const Pair a, const Pair b)
{
  if (a->num != b->num) return PETSC_FALSE;
  for (PetscInt k = 0; k < a->num; k++)
    if (a->nodes[k] != b->nodes[k]) return PETSC_FALSE;
  return PETSC_TRUE;
}

PetscErrorCode PairsUpdateGaps(Scene scene, Level *level, const Support *support, Pair pairs[], PetscBool *same)
{
  PetscReal *reach;
  Pair      *fresh;

  PetscFunctionBeginUser;
  *same = PETSC_TRUE;
  PetscCall(PetscMalloc2(scene->num_pairs, &reach, scene->num_pairs, &fresh));
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    reach[p]              = scene->pairs[p].reach;
    scene->pairs[p].reach = pairs[p]->reach;
  }
  PetscCall(PairsCreate(scene, level, support, fresh));
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    scene->pairs[p].reach = reach[p];
    *same                 = (PetscBool)(*same && PairsIsAlike_Private(pairs[p], fresh[p]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, same, 1, MPIU_BOOL, MPI_LAND, level->comm));
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    if (*same) PetscCall(PetscArraycpy(pairs[p]->gap, fresh[p]->gap, fresh[p]->num));
    if (*same) PetscCall(PetscArraycpy(pairs[p]->overlap, fresh[p]->overlap, fresh[p]->num));
    if (*same) {
      const PairPoints points = pairs[p]->points;

      pairs[p]->points = fresh[p]->points;
      fresh[p]->points = points;
    }
    PetscCall(PairDestroy(&fresh[p]));
  }
  PetscCall(PetscFree2(reach, fresh));
  PetscFunctionReturn(PETSC_SUCCESS);
}
