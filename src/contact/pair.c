/* pair.c -- contact pairs: from sides to multipliers.

   Everything is computed once, in the reference configuration (the bodies move little). All pairs are integrated before
   any decides on its multipliers, since a node can serve several pairs but each of its directions only one. */
#include "base/compat.h"
#include "kernel/frame.h"
#include "contact/pair.h"
#include "contact/pairassembly.h"
#include "contact/smoothgap.h"
#include "contact/quadraticbasis.h"

/* Rows (n, t..): t is the held direction where there is one, so that held unknowns stay single. [out] Q - [dim][dim] */
static void PairSetFrame_Private(const Support *held, PetscInt node, const PetscReal n[], PetscReal Q[])
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

/* Fills the pair's plain arrays from the nodes that this rank owns. Collective. */
static PetscErrorCode PairCollectNodes_Private(Level *level, const Support *held, const PairDraft *draft, Pair pair)
{
  const PetscInt     dim      = level->dim;
  PetscInt           count[3] = {0, 0, 0};
  const PetscScalar *D, *G, *measure, *overlap, *N, *whole, *cut;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(draft->sums.D, &D));
  PetscCall(VecGetArrayRead(draft->sums.G, &G));
  PetscCall(VecGetArrayRead(draft->sums.measure, &measure));
  PetscCall(VecGetArrayRead(draft->sums.overlap, &overlap));
  PetscCall(VecGetArrayRead(draft->normals, &N));
  PetscCall(VecGetArrayRead(draft->sums.whole, &whole));
  PetscCall(VecGetArrayRead(draft->sums.cut, &cut));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    if (PetscRealPart(measure[i]) > 0) count[draft->fate[i]]++;
  }
  pair->num = count[NODE_KEPT];
  PetscCall(PetscMalloc5(pair->num, &pair->nodes, pair->num, &pair->D, pair->num, &pair->gap, pair->num * dim,
                         &pair->normal, pair->num * dim * dim, &pair->frame));
  PetscCall(PetscMalloc3(pair->num, &pair->cut, pair->num, &pair->whole, pair->num, &pair->overlap));
  for (PetscInt i = 0, k = 0; i < level->num_owned; i++) {
    if (draft->fate[i] != NODE_KEPT) continue;
    pair->nodes[k]   = i;
    pair->D[k]       = PetscRealPart(D[i]);
    pair->gap[k]     = PetscRealPart(G[i]) / pair->D[k];
    pair->overlap[k] = PetscRealPart(overlap[i]);
    for (PetscInt j = 0; j < dim; j++) pair->normal[k * dim + j] = PetscRealPart(N[i * dim + j]);
    pair->whole[k] = (PetscBool)(PetscRealPart(whole[i]) > 0);
    pair->cut[k]   = (PetscBool)(PetscRealPart(cut[i]) > 0);
    PairSetFrame_Private(held, i, &pair->normal[k * dim], &pair->frame[k * dim * dim]);
    k++;
  }
  PetscCall(VecRestoreArrayRead(draft->sums.cut, &cut));
  PetscCall(VecRestoreArrayRead(draft->sums.whole, &whole));
  PetscCall(VecRestoreArrayRead(draft->normals, &N));
  PetscCall(VecRestoreArrayRead(draft->sums.overlap, &overlap));
  PetscCall(VecRestoreArrayRead(draft->sums.measure, &measure));
  PetscCall(VecRestoreArrayRead(draft->sums.G, &G));
  PetscCall(VecRestoreArrayRead(draft->sums.D, &D));
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

/* D, M and G along the directions of contact that follow from the side's own normals. */
static PetscErrorCode PairIntegrateFrom_Private(Level *level, const Support *held, const FacetPartner *partner, Vec own,
                                                PairDraft *draft)
{
  PetscFunctionBeginUser;
  PetscCall(PairCopyGhosts_Private(own, draft->normals));
  PetscCall(ContactNormalsSet(level, partner, &draft->nonmortar, &draft->shape, draft->normals));
  PetscCall(NormalsProject(level, held, draft->normals));
  PetscCall(IntegralsCreate(level, partner, &draft->nonmortar, draft->normals, &draft->sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Once more where sharp edges show only then which of their facets see a partner. */
static PetscErrorCode PairIntegrateAlong_Private(Level *level, const Support *held, const FacetPartner *partner,
                                                 PairDraft *draft)
{
  PetscBool changed;
  Vec       own;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(draft->normals, &own));
  PetscCall(PairCopyGhosts_Private(draft->normals, own));
  PetscCall(PairIntegrateFrom_Private(level, held, partner, own, draft));
  PetscCall(NodalNormalsSharpen(level, &draft->nonmortar, draft->sums.covered, own, &changed));
  if (changed) {
    PetscCall(MatDestroy(&draft->sums.M));
    PetscCall(IntegralsDestroy(&draft->sums));
    PetscCall(PairIntegrateFrom_Private(level, held, partner, own, draft));
  }
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscBool PairIsPolygonal_Private(const Level *level, const SceneSide *side)
{
  return level->scene->bodies[side->body].polygonal;
}

/* The mortar facets in reach, with their shape where it is asked for: by gaps, and by directions where the nonmortar side is curved. A flat
   one decides alone, and before a flat mortar side nodes are where they are: the straight facets between them move as those of the other
   side do. Collective. */
static PetscErrorCode PairCreateSurface_Private(Level *level, const Facets *mortar, PairDraft *draft, Pair pair,
                                                MortarSurface *surface)
{
  PetscBool  curved, curved_m;
  SideShape  shape;
  PetscReal *rise = NULL;

  PetscFunctionBeginUser;
  PetscCall(SideShapeCreate(level, mortar, &shape));
  PetscCall(SideShapeIsCurved(level, &draft->nonmortar, &draft->shape, &curved));
  PetscCall(SideShapeIsCurved(level, mortar, &shape, &curved_m));
  if (!curved_m) PetscCall(PetscFree(draft->rise));
  PetscCall(RiseCreate(level, pair->spec, mortar, &shape, PairIsPolygonal_Private(level, &pair->spec->mortar), &rise,
                       &pair->left[1]));
  pair->smooth[1] = rise ? PETSC_TRUE : PETSC_FALSE;
  PetscCall(
      MortarSurfaceCreate(level, &draft->nonmortar, mortar, curved || rise ? &shape : NULL, pair->reach, surface));
  if (rise) PetscCall(RiseCreateMortar(level->dim, surface));
  PetscCall(PetscFree(rise));
  PetscCall(SideShapeDestroy(&shape));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Searches and integrates one pair. Collective. */
static PetscErrorCode PairIntegrate_Private(Scene scene, Level *level, const Support *held, Pair pair, PairDraft *draft)
{
  const ScenePair *spec   = pair->spec;
  const PetscBool  meshed = (PetscBool)(spec->mortar.body >= 0);
  Facets           mortar = {0, NULL, NULL, NULL};
  MortarSurface    surface;
  FacetPartner     partner = {.scene = scene, .spec = spec, .mortar = NULL, .dim = level->dim};

  PetscFunctionBeginUser;
  draft->spec = spec;
  PetscCall(LevelGetFacets(level, scene, spec->nonmortar.body, spec->nonmortar.side, &draft->nonmortar));
  if (meshed) PetscCall(LevelGetFacets(level, scene, spec->mortar.body, spec->mortar.side, &mortar));
  PetscCall(SideShapeCreate(level, &draft->nonmortar, &draft->shape));
  PetscCall(RiseCreate(level, spec, &draft->nonmortar, &draft->shape, PairIsPolygonal_Private(level, &spec->nonmortar),
                       &draft->rise, &pair->left[0]));
  if (spec->obstacle.kind == OBSTACLE_PLANE) PetscCall(PetscFree(draft->rise));
  PetscCall(ReachChoose(spec, level, held, &draft->nonmortar, meshed ? &mortar : NULL, &partner.reach));
  if (meshed) PetscCall(ReachWiden(spec, level, &draft->nonmortar, &mortar, &partner.reach));
  pair->reach = partner.reach;
  if (meshed) {
    PetscCall(PairCreateSurface_Private(level, &mortar, draft, pair, &surface));
    partner.mortar = &surface;
  }
  pair->smooth[0]            = draft->rise ? PETSC_TRUE : PETSC_FALSE;
  partner.rise               = draft->rise;
  pair->num_facets_nonmortar = draft->nonmortar.num;
  pair->num_facets_mortar    = mortar.num;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &pair->num_facets_nonmortar, 1, MPIU_INT, MPI_SUM, level->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &pair->num_facets_mortar, 1, MPIU_INT, MPI_SUM, level->comm));
  PetscCall(NodalNormalsCreate(level, &draft->nonmortar, &draft->shape, &draft->normals));
  PetscCall(PairIntegrateAlong_Private(level, held, &partner, draft));
  PetscCall(ExpressionCheck(level->comm, spec->gap));
  PetscCall(ExpressionCheck(level->comm, spec->gap_offset));
  PetscCall(ExpressionCheck(level->comm, spec->obstacle.gap));
  PetscCall(PetscMalloc1(level->num_nodes, &draft->fate));
  PetscCall(FatesDecide(level, held, draft));
  if (meshed) PetscCall(MortarSurfaceDestroy(&surface));
  PetscCall(FacetsDestroy(&mortar));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Spreads what is removed and collects what is kept. Collective. */
static PetscErrorCode PairFinish_Private(Level *level, const Support *held, PairDraft *draft, Pair pair)
{
  Integrals *sums = &draft->sums;

  PetscFunctionBeginUser;
  PetscCall(ShiftCreate(level, &draft->nonmortar, sums->carrier, &pair->shift, &pair->unshift));
  PetscCall(SpreadRemovedRows(level, &draft->nonmortar, draft->fate, sums, &pair->chain));
  PetscCall(PairCollectNodes_Private(level, held, draft, pair));
  pair->M        = sums->M;
  pair->arm      = sums->arm;
  sums->arm      = NULL;
  pair->num_ends = sums->num_ends;
  pair->ends     = sums->ends;
  sums->ends     = NULL;
  PetscCall(IntegralsDestroy(sums));
  PetscCall(VecDestroy(&draft->normals));
  PetscCall(SideShapeDestroy(&draft->shape));
  PetscCall(PetscFree(draft->rise));
  PetscCall(FacetsDestroy(&draft->nonmortar));
  PetscCall(PetscFree(draft->fate));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairsCreate(Scene scene, Level *level, const Support *held, Pair pairs[])
{
  PairDraft *drafts;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(scene->num_pairs, &drafts));
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    PetscCall(PetscNew(&pairs[p]));
    pairs[p]->spec  = &scene->pairs[p];
    pairs[p]->level = level;
    PetscCall(PairIntegrate_Private(scene, level, held, pairs[p], &drafts[p]));
  }
  PetscCall(FatesSettle(level, scene->num_pairs, drafts));
  for (PetscInt p = 0; p < scene->num_pairs; p++) PetscCall(PairFinish_Private(level, held, &drafts[p], pairs[p]));
  PetscCall(PetscFree(drafts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairDestroy(Pair *pair)
{
  PetscFunctionBeginUser;
  if (!*pair) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatDestroy(&(*pair)->M));
  PetscCall(MatDestroy(&(*pair)->arm));
  PetscCall(MatDestroy(&(*pair)->chain));
  PetscCall(MatDestroy(&(*pair)->shift));
  PetscCall(MatDestroy(&(*pair)->unshift));
  PetscCall(PetscFree3((*pair)->cut, (*pair)->whole, (*pair)->overlap));
  PetscCall(PetscFree((*pair)->ends));
  PetscCall(PetscFree5((*pair)->nodes, (*pair)->D, (*pair)->gap, (*pair)->normal, (*pair)->frame));
  PetscCall(PetscFree(*pair));
  PetscFunctionReturn(PETSC_SUCCESS);
}
