/* pairintegrals.c -- search and integrals of one pair, along its directions of contact. */
#include "base/compat.h"
#include "contact/contactnormal.h"
#include "contact/deformedlevel.h"
#include "contact/multiplierstatus.h"
#include "contact/nodalnormals.h"
#include "contact/obliqueholds.h"
#include "contact/pairintegrals.h"
#include "contact/reach.h"
#include "contact/smoothgap.h"

/* to := from, ghosts included. */
static PetscErrorCode PairIntegralsCopyGhosts_Private(Vec from, Vec to)
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
static PetscErrorCode PairIntegralsComputeFrom_Private(Level *level, const Support *support,
                                                       const FacetPartner *partner, const PetscBool oblique[], Vec own,
                                                       PairAssembly *assembly)
{
  PetscFunctionBeginUser;
  PetscCall(PairIntegralsCopyGhosts_Private(own, assembly->normals));
  PetscCall(ContactNormalSet(level, partner, &assembly->nonmortar, &assembly->shape, assembly->normals));
  if (assembly->directions) PetscCall(PairIntegralsCopyGhosts_Private(assembly->normals, assembly->directions));
  PetscCall(MultiplierStatusProjectNormals(level, support, oblique, assembly->normals));
  PetscCall(NodalNormalsConform(level, assembly->normals));
  PetscCall(MortarIntegralsCreate(level, partner, &assembly->nonmortar, assembly->normals, &assembly->sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Discards the integrals and computes them anew. Collective. */
static PetscErrorCode PairIntegralsComputeAgain_Private(Level *level, const Support *support,
                                                        const FacetPartner *partner, const PetscBool oblique[], Vec own,
                                                        PairAssembly *assembly)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&assembly->sums.M));
  PetscCall(MortarIntegralsDestroy(&assembly->sums));
  PetscCall(PairIntegralsComputeFrom_Private(level, support, partner, oblique, own, assembly));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Integrates and chooses the nodes with multipliers. Integrates again if facets at sharp edges do not face
   the partner, or if supports hold nodes obliquely, as the first integration shows.
   [in,out] oblique - of the pair: found, or with gap_only as it is */
static PetscErrorCode PairIntegralsComputeAlong_Private(Level *level, const Support *support,
                                                        const FacetPartner *partner, PetscBool **oblique,
                                                        PairAssembly *assembly)
{
  PetscBool changed;
  Vec       own;

  PetscFunctionBeginUser;
  if (!partner->gap_only) PetscCall(VecDuplicate(assembly->normals, &assembly->directions));
  PetscCall(VecDuplicate(assembly->normals, &own));
  PetscCall(PairIntegralsCopyGhosts_Private(assembly->normals, own));
  PetscCall(PairIntegralsComputeFrom_Private(level, support, partner, *oblique, own, assembly));
  PetscCall(NodalNormalsSharpen(level, &assembly->nonmortar, assembly->sums.covered, own, &changed));
  if (changed) PetscCall(PairIntegralsComputeAgain_Private(level, support, partner, *oblique, own, assembly));
  PetscCall(PetscMalloc1(level->num_nodes, &assembly->status));
  PetscCall(MultiplierStatusDecide(level, support, *oblique, assembly));
  if (!partner->gap_only && partner->spec->type == PAIR_CONTACT) {
    PetscCall(ObliqueHoldsFind(level, support, partner, assembly, oblique));
    if (*oblique) {
      PetscCall(PairIntegralsComputeAgain_Private(level, support, partner, *oblique, own, assembly));
      PetscCall(MultiplierStatusDecide(level, support, *oblique, assembly));
    }
  }
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscBool PairIntegralsIsPolygonal_Private(const Level *level, const SceneSide *side)
{
  return level->scene->bodies[side->body].polygonal;
}

/* Creates the mortar surface within reach. Its shape is computed for gaps, and for directions at a curved
   nonmortar side and at its edges; a flat nonmortar side alone determines the directions. Collective. */
static PetscErrorCode PairIntegralsCreateSurface_Private(Level *level, const Facets *mortar, PairAssembly *assembly,
                                                         Pair pair, MortarSurface *surface)
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
    PetscCall(SmoothGapCreate(level, pair->spec, mortar, &shape,
                              PairIntegralsIsPolygonal_Private(level, &pair->spec->mortar), &rises,
                              &pair->curve_error[1]));
  pair->smooth[1] = rises ? PETSC_TRUE : PETSC_FALSE;
  PetscCall(MortarSurfaceCreate(level, &assembly->nonmortar, mortar, curved || edge || rises ? &shape : NULL, rises,
                                pair->reach + assembly->motion, surface));
  surface->edged = edge_m;
  PetscCall(PetscFree(rises));
  PetscCall(SideShapeDestroy(&shape));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PairIntegralsCompute(Scene scene, Level *level, const Support *support, Pair pair,
                                    PairAssembly *assembly)
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
                            PairIntegralsIsPolygonal_Private(level, &spec->nonmortar), &assembly->rises,
                            &pair->curve_error[0]));
  if (spec->obstacle.kind == OBSTACLE_PLANE && !spec->gap) PetscCall(PetscFree(assembly->rises));
  if (!assembly->gap_only) {
    PetscCall(ReachChoose(spec, level, support, &assembly->nonmortar, meshed ? &mortar : NULL, &partner.reach));
    if (meshed) PetscCall(ReachWiden(spec, level, &assembly->nonmortar, &mortar, &partner.reach));
    pair->reach = partner.reach;
  }
  if (meshed) {
    PetscCall(PairIntegralsCreateSurface_Private(level, &mortar, assembly, pair, &surface));
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
  PetscCall(PairIntegralsComputeAlong_Private(at, support, &partner, &pair->oblique, assembly));
  PetscCall(ExpressionCheck(level->comm, spec->gap));
  PetscCall(ExpressionCheck(level->comm, spec->gap_offset));
  PetscCall(ExpressionCheck(level->comm, spec->obstacle.gap));
  if (assembly->displacement) PetscCall(DeformedLevelDestroy(&moved));
  if (meshed && assembly->sums.points) PetscCall(PairPointsSetMortar(assembly->sums.points, level->dim, &surface));
  if (meshed) PetscCall(MortarSurfaceDestroy(&surface));
  PetscCall(FacetsDestroy(&mortar));
  PetscFunctionReturn(PETSC_SUCCESS);
}
