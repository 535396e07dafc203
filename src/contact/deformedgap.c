/* deformedgap.c -- gaps of a pair that is searched and integrated with displaced nodes. */
#include "base/compat.h"
#include "contact/deformedgap.h"
#include "contact/pairintegrals.h"
#include "level/ghosted.h"

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
  PetscCall(PairIntegralsCompute(scene, pair->level, support, &moved, &assembly));
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
