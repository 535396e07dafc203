/* pair.c -- contact pairs, from sides to multipliers.

   All is computed once, in the undeformed configuration. All pairs are integrated before nodes with
   multipliers are chosen: a node can be in several pairs, but each of its directions in only one. */
#include "base/compat.h"
#include "kernel/frame.h"
#include "contact/pair.h"
#include "contact/pairassembly.h"
#include "contact/slidingnodes.h"
#include "contact/heldrows.h"
#include "contact/obliqueholds.h"
#include "contact/smoothgap.h"
#include "contact/quadraticbasis.h"
#include "kernel/vector.h"

/* A removed node with less than this part of its facets covered lies outside its partner; at the partner's
   end it would be half. */
static const PetscReal BEYOND = 0.45;

/* Rows (n, t..): t is the fixed direction where there is one, so that fixed unknowns stay single.
   [out] Q - [dim][dim] */
static void PairSetFrame_Private(const Support *support, PetscInt node, const PetscReal n[], PetscReal Q[])
{
  const PetscInt   dim = support->dim;
  const PetscReal *d   = &support->directions[node * dim * dim];

  FrameFromNormal(dim, n, Q);
  if (support->count[node] == 0) return;
  for (PetscInt k = 0; k < dim; k++) Q[dim + k] = d[k];
  if (dim == 3) VectorCross(n, d, &Q[6]);
}

/* Fills the pair's plain arrays from the nodes that this rank owns. Collective. */
static PetscErrorCode PairCollectNodes_Private(Level *level, const Support *support, const PairAssembly *assembly,
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
    PairSetFrame_Private(support, i, &pair->normal[k * dim], &pair->frame[k * dim * dim]);
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

/* to := from, ghosts included. */
static PetscErrorCode PairCopyGhosts_Private(Vec from, Vec to)
{
  Vec local[2];

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(from, &local[0]));
  PetscCall(VecGhostGetLocalForm(to, &local[1]));
  PetscCall(VecCopy(local[0], local[1]));
  PetscCall(VecGhostRestoreLocalForm(from, &local[0]));
  PetscCall(VecGhostRestoreLocalForm(to, &local[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Integrates D, M and G along the directions of contact. [in] oblique - of the pair */
static PetscErrorCode PairIntegrateFrom_Private(Level *level, const Support *support, const FacetPartner *partner,
                                                const PetscBool oblique[], Vec own, PairAssembly *assembly)
{
  PetscFunctionBeginUser;
  PetscCall(PairCopyGhosts_Private(own, assembly->normals));
  PetscCall(ContactNormalSet(level, partner, &assembly->nonmortar, &assembly->shape, assembly->normals));
  if (assembly->directions) PetscCall(PairCopyGhosts_Private(assembly->normals, assembly->directions));
  PetscCall(MultiplierStatusProjectNormals(level, support, oblique, assembly->normals));
  PetscCall(NodalNormalsConform(level, assembly->normals));
  PetscCall(MortarIntegralsCreate(level, partner, &assembly->nonmortar, assembly->normals, &assembly->sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Discards the integrals and computes them anew. Collective. */
static PetscErrorCode PairIntegrateAgain_Private(Level *level, const Support *support, const FacetPartner *partner,
                                                 const PetscBool oblique[], Vec own, PairAssembly *assembly)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&assembly->sums.M));
  PetscCall(MortarIntegralsDestroy(&assembly->sums));
  PetscCall(PairIntegrateFrom_Private(level, support, partner, oblique, own, assembly));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Integrates and chooses the nodes with multipliers. Integrates again if facets at sharp edges do not face
   the partner, or if supports hold nodes obliquely, as the first integration shows.
   [in,out] oblique - of the pair: found, or with gap_only as it is */
static PetscErrorCode PairIntegrateAlong_Private(Level *level, const Support *support, const FacetPartner *partner,
                                                 PetscBool **oblique, PairAssembly *assembly)
{
  PetscBool changed;
  Vec       own;

  PetscFunctionBeginUser;
  if (!partner->gap_only) PetscCall(VecDuplicate(assembly->normals, &assembly->directions));
  PetscCall(VecDuplicate(assembly->normals, &own));
  PetscCall(PairCopyGhosts_Private(assembly->normals, own));
  PetscCall(PairIntegrateFrom_Private(level, support, partner, *oblique, own, assembly));
  PetscCall(NodalNormalsSharpen(level, &assembly->nonmortar, assembly->sums.covered, own, &changed));
  if (changed) PetscCall(PairIntegrateAgain_Private(level, support, partner, *oblique, own, assembly));
  PetscCall(PetscMalloc1(level->num_nodes, &assembly->status));
  PetscCall(MultiplierStatusDecide(level, support, *oblique, assembly));
  if (!partner->gap_only && partner->spec->type == PAIR_CONTACT) {
    PetscCall(ObliqueHoldsFind(level, support, partner, assembly, oblique));
    if (*oblique) {
      PetscCall(PairIntegrateAgain_Private(level, support, partner, *oblique, own, assembly));
      PetscCall(MultiplierStatusDecide(level, support, *oblique, assembly));
    }
  }
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscBool PairIsPolygonal_Private(const Level *level, const SceneSide *side)
{
  return level->scene->bodies[side->body].polygonal;
}

/* Creates the mortar surface within reach. Its shape is computed for gaps, and for directions at a curved
   nonmortar side and at its edges; a flat nonmortar side alone determines the directions. Collective. */
static PetscErrorCode PairCreateSurface_Private(Level *level, const Facets *mortar, PairAssembly *assembly, Pair pair,
                                                MortarSurface *surface)
{
  PetscBool  curved, curved_m, edge, edge_m;
  SideShape  shape;
  PetscReal *rises = NULL;

  PetscFunctionBeginUser;
  PetscCall(SideShapeCreate(level, mortar, NULL, &shape));
  PetscCall(SideShapeIsCurved(level, &assembly->nonmortar, &assembly->shape, &curved));
  PetscCall(SideShapeIsCurved(level, mortar, &shape, &curved_m));
  PetscCall(ContactNormalHasEdge(level, &assembly->shape, &edge));
  PetscCall(ContactNormalHasEdge(level, &shape, &edge_m));
  if (!curved_m && !pair->spec->gap) PetscCall(PetscFree(assembly->rises));
  if (!pair->spec->gap)
    PetscCall(SmoothGapCreate(level, pair->spec, mortar, &shape, PairIsPolygonal_Private(level, &pair->spec->mortar),
                              &rises, &pair->curve_error[1]));
  pair->smooth[1] = rises ? PETSC_TRUE : PETSC_FALSE;
  PetscCall(MortarSurfaceCreate(level, &assembly->nonmortar, mortar, curved || edge || rises ? &shape : NULL, rises,
                                pair->reach + assembly->motion, surface));
  surface->edged = edge_m;
  PetscCall(PetscFree(rises));
  PetscCall(SideShapeDestroy(&shape));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairAssemblyCreate(Scene scene, Level *level, const Support *support, Pair pair, PairAssembly *assembly)
{
  const ScenePair *spec   = pair->spec;
  const PetscBool  meshed = (PetscBool)(spec->mortar.body >= 0);
  Facets           mortar = {0, NULL, NULL, NULL};
  Level            moved, *at = assembly->displacement ? &moved : level;
  MortarSurface    surface;
  FacetPartner     partner = {
          .scene = scene, .spec = spec, .dim = level->dim, .reach = pair->reach, .gap_only = assembly->gap_only};

  PetscFunctionBeginUser;
  assembly->spec = spec;
  PetscCall(LevelGetFacets(level, scene, spec->nonmortar.body, spec->nonmortar.side, &assembly->nonmortar));
  if (meshed) PetscCall(LevelGetFacets(level, scene, spec->mortar.body, spec->mortar.side, &mortar));
  PetscCall(SideShapeCreate(level, &assembly->nonmortar, NULL, &assembly->shape));
  PetscCall(SmoothGapCreate(level, spec, &assembly->nonmortar, &assembly->shape,
                            PairIsPolygonal_Private(level, &spec->nonmortar), &assembly->rises, &pair->curve_error[0]));
  if (spec->obstacle.kind == OBSTACLE_PLANE && !spec->gap) PetscCall(PetscFree(assembly->rises));
  if (!assembly->gap_only) {
    PetscCall(ReachChoose(spec, level, support, &assembly->nonmortar, meshed ? &mortar : NULL, &partner.reach));
    if (meshed) PetscCall(ReachWiden(spec, level, &assembly->nonmortar, &mortar, &partner.reach));
    pair->reach = partner.reach;
  }
  if (meshed) {
    PetscCall(PairCreateSurface_Private(level, &mortar, assembly, pair, &surface));
    partner.mortar = &surface;
  }
  pair->smooth[0]            = assembly->rises ? PETSC_TRUE : PETSC_FALSE;
  partner.rises              = assembly->rises;
  pair->num_facets_nonmortar = assembly->nonmortar.num;
  pair->num_facets_mortar    = mortar.num;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &pair->num_facets_nonmortar, 1, MPIU_INT, MPI_SUM, level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &pair->num_facets_mortar, 1, MPIU_INT, MPI_SUM, level->comm));
  if (assembly->displacement) PetscCall(DeformedLevelCreate(level, assembly, meshed ? &surface : NULL, &moved));
  PetscCall(NodalNormalsCreate(at, &assembly->nonmortar, &assembly->shape, &assembly->normals));
  PetscCall(PairIntegrateAlong_Private(at, support, &partner, &pair->oblique, assembly));
  PetscCall(ExpressionCheck(level->comm, spec->gap));
  PetscCall(ExpressionCheck(level->comm, spec->gap_offset));
  PetscCall(ExpressionCheck(level->comm, spec->obstacle.gap));
  if (assembly->displacement) PetscCall(DeformedLevelDestroy(&moved));
  if (meshed && assembly->sums.points) PetscCall(PairPointsSetMortar(assembly->sums.points, level->dim, &surface));
  if (meshed) PetscCall(MortarSurfaceDestroy(&surface));
  PetscCall(FacetsDestroy(&mortar));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairAssemblyDestroy(PairAssembly *assembly)
{
  PetscFunctionBeginUser;
  PetscCall(MortarIntegralsDestroy(&assembly->sums));
  PetscCall(VecDestroy(&assembly->normals));
  PetscCall(VecDestroy(&assembly->directions));
  PetscCall(SideShapeDestroy(&assembly->shape));
  PetscCall(PetscFree(assembly->rises));
  PetscCall(FacetsDestroy(&assembly->nonmortar));
  PetscCall(PetscFree(assembly->status));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moves the points to the pair, with the facets of their side. Not collective. */
static void PairTakePoints_Private(PairAssembly *assembly, Pair pair)
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
static PetscErrorCode PairSetShares_Private(Level *level, Pair pair)
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

PetscErrorCode PairFindSliding(const Pair pair, const Support *support, PetscBool slides[])
{
  PetscFunctionBeginUser;
  PetscCall(SlidingNodesFind(pair->level, support, pair->M, pair->num, pair->nodes, pair->D, slides));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Redistributes removed rows and collects kept ones. Collective. */
static PetscErrorCode PairFinish_Private(Level *level, const Support *support, PairAssembly *assembly, Pair pair)
{
  MortarIntegrals *sums = &assembly->sums;

  PetscFunctionBeginUser;
  PetscCall(QuadraticBasisCreate(level, &sums->carrying.facets, sums->carrier, &pair->to_nodal, &pair->from_nodal));
  if (ScenePairHasFriction(pair->spec))
    PetscCall(SlidingNodesRemove(level, support, &sums->carrying.facets, sums, assembly->status));
  PetscCall(RedistributionApply(level, &sums->carrying.facets, assembly->status, sums, &pair->D_other));
  if (pair->spec->type == PAIR_TIED && sums->M)
    PetscCall(HeldRowsPass(level, support, &sums->carrying.facets, assembly->status, sums, pair));
  PetscCall(PairCollectNodes_Private(level, support, assembly, pair));
  PetscCall(PairSetShares_Private(level, pair));
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
  PairTakePoints_Private(assembly, pair);
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
    PetscCall(PairAssemblyCreate(scene, level, support, pairs[p], &assemblies[p]));
  }
  PetscCall(MultiplierStatusResolve(level, scene->num_pairs, assemblies));
  for (PetscInt p = 0; p < scene->num_pairs; p++)
    PetscCall(PairFinish_Private(level, support, &assemblies[p], pairs[p]));
  PetscCall(PetscFree(assemblies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairsSlideElsewhere(Level *level, const Support *support, PetscInt num, const Pair pairs[],
                                   PetscBool *elsewhere)
{
  PetscFunctionBeginUser;
  *elsewhere = PETSC_FALSE;
  for (PetscInt p = 0; p < num; p++) {
    const Pair pair = pairs[p];
    PetscBool *slides;

    if (!ScenePairHasFriction(pair->spec)) continue;
    PetscCall(PetscMalloc1(pair->num, &slides));
    PetscCall(PairFindSliding(pair, support, slides));
    for (PetscInt a = 0; a < pair->num; a++)
      if (slides[a] && !pair->slides[a]) *elsewhere = PETSC_TRUE;
    PetscCall(PetscFree(slides));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, elsewhere, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether two pairs have multipliers at the same nodes of this rank. */
static PetscBool PairIsAlike_Private(const Pair a, const Pair b)
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
    *same                 = (PetscBool)(*same && PairIsAlike_Private(pairs[p], fresh[p]));
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

PetscErrorCode PairDestroy(Pair *pair)
{
  PetscFunctionBeginUser;
  if (!*pair) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PairPointsDestroy(&(*pair)->points));
  PetscCall(MatDestroy(&(*pair)->M));
  PetscCall(MatDestroy(&(*pair)->arm));
  PetscCall(MatDestroy(&(*pair)->passed));
  PetscCall(MatDestroy(&(*pair)->D_other));
  PetscCall(MatDestroy(&(*pair)->to_nodal));
  PetscCall(MatDestroy(&(*pair)->from_nodal));
  PetscCall(PetscFree4((*pair)->partly_covered, (*pair)->fully_covered, (*pair)->overlap, (*pair)->cover));
  PetscCall(PetscFree((*pair)->share));
  PetscCall(PetscFree((*pair)->slides));
  PetscCall(PetscFree((*pair)->beyond));
  PetscCall(PetscFree((*pair)->boundary));
  PetscCall(PetscFree((*pair)->oblique));
  PetscCall(PetscFree5((*pair)->nodes, (*pair)->D, (*pair)->gap, (*pair)->normal, (*pair)->frame));
  PetscCall(PetscFree(*pair));
  PetscFunctionReturn(PETSC_SUCCESS);
}
