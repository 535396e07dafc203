/* deformedgap.c -- a pair in the deformed configuration.

   The pair is searched and integrated with displaced nodes. Displacements are linear on facets of first
   order. So the curves over them (eq. 4.5) keep their rises and curvatures; computed anew, both would be
   those of the polygon. */
#include "base/compat.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "contact/deformedgap.h"
#include "contact/pairassembly.h"
#include "level/ghosted.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Rotates unit normals of a facet as the facet itself rotates.
   [in] before, after - nodes [n][dim]; [in,out] normals - [n][dim] */
static void DeformedGapTurnNormals_Private(PetscInt dim, PetscInt n, const PetscReal before[], const PetscReal after[],
                                           PetscReal normals[])
{
  PetscReal N[2][3 * F] = {{0}};

  FrameAddFacetNormal(dim, n, before, N[0]);
  FrameAddFacetNormal(dim, n, after, N[1]);
  for (PetscInt i = 0; i < n; i++) {
    if (VectorNorm(dim, &normals[i * dim]) == 0) continue;
    for (PetscInt j = 0; j < 2; j++) FrameNormalize(dim, &N[j][i * dim]);
    for (PetscInt k = 0; k < dim; k++) normals[i * dim + k] += N[1][i * dim + k] - N[0][i * dim + k];
    FrameNormalize(dim, &normals[i * dim]);
  }
}

PetscErrorCode MortarSurfaceFetch(Vec u, PetscInt dim, PetscInt num, const PetscInt nodes[], PetscReal values[])
{
  IS                 from;
  Vec                here;
  VecScatter         scatter;
  const PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(ISCreateBlock(PETSC_COMM_SELF, dim, num, nodes, PETSC_USE_POINTER, &from));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, num * dim, &here));
  PetscCall(VecScatterCreate(u, from, here, NULL, &scatter));
  PetscCall(VecScatterBegin(scatter, u, here, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, u, here, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(here, &value));
  for (PetscInt i = 0; i < num * dim; i++) values[i] = PetscRealPart(value[i]);
  PetscCall(VecRestoreArrayRead(here, &value));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCall(VecDestroy(&here));
  PetscCall(ISDestroy(&from));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moves facets by a displacement: positions, normals, tree. Collective. [in] u - dim per node */
static PetscErrorCode DeformedGapMove_Private(const Level *level, Vec u, MortarSurface *surface)
{
  const PetscInt dim = level->dim;
  PetscInt      *nodes, num = 0;
  PetscReal     *moves, before[3 * F];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(surface->num * F, &nodes, surface->num * F * dim, &moves));
  for (PetscInt f = 0; f < surface->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(surface->type[f]); i++) nodes[num++] = surface->nodes[f * F + i];
  }
  PetscCall(MortarSurfaceFetch(u, dim, num, nodes, moves));
  num = 0;
  for (PetscInt f = 0; f < surface->num; f++) {
    const PetscInt n = ElementNumNodes(surface->type[f]);
    PetscReal     *X = &surface->coords[f * F * dim];

    PetscCall(PetscArraycpy(before, X, n * dim));
    for (PetscInt i = 0; i < n * dim; i++) X[i] += moves[num + i];
    num += n * dim;
    DeformedGapTurnNormals_Private(dim, n, before, X, &surface->normals[f * F * dim]);
  }
  PetscCall(PetscFree2(nodes, moves));
  PetscCall(MortarSurfaceUpdateTree(dim, surface));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode DeformedLevelCreate(Level *level, PairAssembly *assembly, MortarSurface *surface, Level *moved)
{
  const PetscInt     dim = level->dim;
  PetscReal          X[2][3 * F];
  const PetscScalar *u;

  PetscFunctionBeginUser;
  *moved = *level;
  PetscCall(PetscMalloc1(level->num_nodes * dim, &moved->coords));
  PetscCall(GhostedGetArrayRead(assembly->displacement, &u));
  for (PetscInt i = 0; i < level->num_nodes * dim; i++) moved->coords[i] = level->coords[i] + PetscRealPart(u[i]);
  PetscCall(GhostedRestoreArrayRead(assembly->displacement, &u));
  PetscCall(NodalNormalsCreate(level, &assembly->nonmortar, &assembly->shape, &assembly->own[0]));
  for (PetscInt f = 0; f < assembly->nonmortar.num; f++) {
    ContactFacetCoordinates(level, &assembly->nonmortar, f, X[0]);
    ContactFacetCoordinates(moved, &assembly->nonmortar, f, X[1]);
    DeformedGapTurnNormals_Private(dim, ElementNumNodes(assembly->nonmortar.type[f]), X[0], X[1],
                                   &assembly->shape.normal[f * F * dim]);
  }
  PetscCall(NodalNormalsCreate(moved, &assembly->nonmortar, &assembly->shape, &assembly->own[1]));
  if (surface) PetscCall(DeformedGapMove_Private(level, assembly->displacement, surface));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode DeformedLevelDestroy(Level *moved)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(moved->coords));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Multipliers stay at the pair's nodes, as far as these are covered. Collective.
   [in,out] status - [num_nodes] */
static PetscErrorCode DeformedGapKeepNodes_Private(Pair pair, MultiplierStatus status[])
{
  Level             *level = pair->level;
  PetscScalar       *mark;
  const PetscScalar *kept;
  Vec                marks;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, &marks));
  PetscCall(VecGetArray(marks, &mark));
  for (PetscInt k = 0; k < pair->num; k++) mark[pair->nodes[k]] = 1;
  PetscCall(VecRestoreArray(marks, &mark));
  PetscCall(LevelShareVec(marks, INSERT_VALUES));
  PetscCall(GhostedGetArrayRead(marks, &kept));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    if (status[i] == NODE_KEPT && PetscRealPart(kept[i]) == 0) status[i] = NODE_REMOVED;
  }
  PetscCall(GhostedRestoreArrayRead(marks, &kept));
  PetscCall(VecDestroy(&marks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The angle between two unit vectors, accurate where it is small. */
static PetscReal DeformedGapAngle_Private(PetscInt dim, const PetscScalar a[], const PetscScalar b[])
{
  PetscReal apart = 0, along = 0;

  for (PetscInt k = 0; k < dim; k++) {
    apart += PetscSqr(PetscRealPart(a[k] - b[k]));
    along += PetscSqr(PetscRealPart(a[k] + b[k]));
  }
  return 2 * PetscAtan2Real(PetscSqrtReal(apart), PetscSqrtReal(along));
}

/* Turns of the nodes' normals. Not collective. */
static PetscErrorCode DeformedGapTakeTurns_Private(const Pair pair, const PairAssembly *assembly, PetscReal turn[])
{
  const PetscInt     dim = pair->level->dim;
  const PetscScalar *n[2];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < 2; i++) PetscCall(VecGetArrayRead(assembly->own[i], &n[i]));
  for (PetscInt k = 0; k < pair->num; k++)
    turn[k] = DeformedGapAngle_Private(dim, &n[0][pair->nodes[k] * dim], &n[1][pair->nodes[k] * dim]);
  for (PetscInt i = 0; i < 2; i++) PetscCall(VecRestoreArrayRead(assembly->own[i], &n[i]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gaps of the geometry, with a displacement or without. Collective.
   [in] u - or NULL; [out] gap - NAN where no partner faces the node any more [pair->num]; [out] turn - or
   NULL */
static PetscErrorCode DeformedGapOfGeometry_Private(Scene scene, const Support *support, Pair pair, Vec u,
                                                    PetscReal gap[], PetscReal turn[])
{
  ScenePair          spec     = *pair->spec;
  struct _n_Pair     moved    = {.spec = &spec, .level = pair->level, .reach = pair->reach, .oblique = pair->oblique};
  PairAssembly       assembly = {.gap_only = PETSC_TRUE, .displacement = u};
  const PetscScalar *D, *G;
  PetscReal          most;

  PetscFunctionBeginUser;
  spec.gap = spec.gap_offset = NULL;
  if (u) PetscCall(VecNorm(u, NORM_INFINITY, &most));
  if (u) assembly.motion = 2 * PetscSqrtReal((PetscReal)pair->level->dim) * most;
  PetscCall(PairAssemblyCreate(scene, pair->level, support, &moved, &assembly));
  PetscCall(DeformedGapKeepNodes_Private(pair, assembly.status));
  PetscCall(RedistributionApply(pair->level, &assembly.sums.carrying.facets, assembly.status, &assembly.sums,
                                &moved.D_other));
  PetscCall(VecGetArrayRead(assembly.sums.D, &D));
  PetscCall(VecGetArrayRead(assembly.sums.G, &G));
  for (PetscInt k = 0; k < pair->num; k++) {
    const PetscInt i = pair->nodes[k];

    gap[k] = assembly.status[i] == NODE_KEPT ? PetscRealPart(G[i]) / PetscRealPart(D[i]) : NAN;
  }
  PetscCall(VecRestoreArrayRead(assembly.sums.G, &G));
  PetscCall(VecRestoreArrayRead(assembly.sums.D, &D));
  if (u && turn) PetscCall(DeformedGapTakeTurns_Private(pair, &assembly, turn));
  PetscCall(VecDestroy(&assembly.own[0]));
  PetscCall(VecDestroy(&assembly.own[1]));
  PetscCall(MatDestroy(&moved.D_other));
  PetscCall(MatDestroy(&assembly.sums.M));
  PetscCall(PairAssemblyDestroy(&assembly));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode DeformedGapMeasure(Scene scene, const Support *support, Pair pair, Vec u, PetscReal gap[],
                                  PetscReal turn[])
{
  PetscReal *before;

  PetscFunctionBeginUser;
  PetscCall(DeformedGapOfGeometry_Private(scene, support, pair, u, gap, turn));
  if (!pair->spec->gap && !pair->spec->gap_offset) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(pair->num, &before));
  PetscCall(DeformedGapOfGeometry_Private(scene, support, pair, NULL, before, NULL));
  for (PetscInt k = 0; k < pair->num; k++) gap[k] += pair->gap[k] - before[k];
  PetscCall(PetscFree(before));
  PetscFunctionReturn(PETSC_SUCCESS);
}
