/* obliqueholds.c -- nodes that a support holds along a part of their direction of contact.

   Where a smooth side crosses a plane of symmetry, the direction of contact lies in the plane. So the part
   across it is an error of facets, and is removed. Where a support holds the end of an inclined side, that
   part is real: the contact has its force, whether or not a support takes it from the mortar side as well. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "contact/slidingnodes.h"
#include "contact/obliqueholds.h"
#include "contact/obstacle.h"
#include "level/ghosted.h"

/* Parts of a direction below this one change forces by less than their thousandth. */
static const PetscReal OBLIQUE = 1e-3;
/* The part of a direction across a plane is real where neighbours have most of it. Where a smooth side
   crosses the plane, it changes from node to node by the turn of facets; an error is a small part of that. */
static const PetscReal STEADY = 0.5;

/* Whether a node is on the axis of revolution, which is no support. */
static PetscBool ObliqueHoldsOnAxis_Private(const Level *level, PetscInt i)
{
  return (PetscBool)(level->scene->model == MODEL_AXISYMMETRIC && level->coords[i * level->dim] == 0);
}

/* The part of the direction n along which node i is held, 0 if it is none to speak of.
   [out] across - direction of that part */
static PetscReal ObliqueHoldsPart_Private(const Level *level, const Support *support, PetscInt i, const PetscScalar n[],
                                          PetscReal across[])
{
  const PetscInt dim = level->dim;
  PetscReal      length;

  for (PetscInt k = 0; k < dim; k++) across[k] = 0;
  for (PetscInt j = 0; j < support->count[i] && support->count[i] < dim; j++) {
    const PetscReal *d   = &support->directions[(i * dim + j) * dim];
    PetscReal        dot = 0;

    for (PetscInt k = 0; k < dim; k++) dot += d[k] * PetscRealPart(n[k]);
    for (PetscInt k = 0; k < dim; k++) across[k] += dot * d[k];
  }
  length = VectorNorm(dim, across);
  if (length <= OBLIQUE || ObliqueHoldsOnAxis_Private(level, i)) return 0;
  for (PetscInt k = 0; k < dim; k++) across[k] /= length;
  return length;
}

/* Marks nodes whose neighbours have another part of their directions across the same plane. Collective.
   [out] turns - 1 or 0, ghosted, owned by the caller */
static PetscErrorCode ObliqueHoldsFindTurns_Private(Level *level, const Support *support, const PairAssembly *assembly,
                                                    Vec *turns)
{
  enum { F = ELEMENT_MAX_FACET_NODES };
  const PetscInt     dim = level->dim;
  const PetscScalar *n;
  PetscScalar       *turn;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, turns));
  PetscCall(GhostedGetArrayRead(assembly->directions, &n));
  PetscCall(GhostedGetArray(*turns, &turn));
  for (PetscInt f = 0; f < assembly->nonmortar.num; f++) {
    const PetscInt *nodes = &assembly->nonmortar.nodes[f * F], num = ElementNumNodes(assembly->nonmortar.type[f]);

    for (PetscInt i = 0; i < num; i++) {
      PetscReal       across[3];
      const PetscReal part = ObliqueHoldsPart_Private(level, support, nodes[i], &n[nodes[i] * dim], across);

      for (PetscInt j = 0; j < num && part > 0; j++) {
        PetscReal other = 0;

        for (PetscInt k = 0; k < dim; k++) other += across[k] * PetscRealPart(n[nodes[j] * dim + k]);
        if (PetscAbsReal(other - part) > STEADY * part) turn[nodes[i]] = 1;
      }
    }
  }
  PetscCall(GhostedRestoreArray(*turns, &turn));
  PetscCall(GhostedRestoreArrayRead(assembly->directions, &n));
  PetscCall(LevelShareVec(*turns, MAX_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the obstacle is oblique to a direction that is held at node i. [in] n - direction of contact */
static PetscErrorCode ObliqueHoldsMeetObstacle_Private(const Level *level, const FacetPartner *partner, PetscInt i,
                                                       const PetscScalar n[], PetscReal size, const PetscReal across[],
                                                       PetscBool *oblique)
{
  SurfacePoint own = {.normal = {0}}, other;
  PetscBool    known;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < level->dim; k++) own.normal[k] = PetscRealPart(n[k]);
  PetscCall(
      ObstacleShape(&partner->spec->obstacle, level->dim, &level->coords[i * level->dim], &own, size, &other, &known));
  *oblique = (PetscBool)(known && PetscAbsReal(VectorDot(level->dim, other.normal, across)) > OBLIQUE);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks nodes of this rank, 1 or 0. Collective. [out] marks - ghosted, one per node, owned by the caller;
   [out] any - whether any rank may have one */
static PetscErrorCode ObliqueHoldsMark_Private(Level *level, const Support *support, const FacetPartner *partner,
                                               const PairAssembly *assembly, Vec *marks, PetscBool *any)
{
  const PetscInt     dim = level->dim;
  const PetscScalar *n, *D, *measure, *turn;
  PetscScalar       *mark;
  Vec                turns;
  PetscInt           num = 0, *nodes;
  PetscReal         *weights, *across;
  PetscBool         *oblique;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc4(level->num_owned, &nodes, level->num_owned, &weights, level->num_owned * dim, &across,
                         level->num_owned, &oblique));
  PetscCall(VecGetArrayRead(assembly->directions, &n));
  PetscCall(VecGetArrayRead(assembly->sums.D, &D));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    if (assembly->status[i] != NODE_KEPT) continue;
    if (ObliqueHoldsPart_Private(level, support, i, &n[i * dim], &across[num * dim]) == 0) continue;
    nodes[num]     = i;
    weights[num++] = PetscRealPart(D[i]);
  }
  PetscCall(VecRestoreArrayRead(assembly->sums.D, &D));
  *any = num ? PETSC_TRUE : PETSC_FALSE;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  if (*any && assembly->sums.M)
    PetscCall(SlidingNodesFindEver(level, support, assembly->sums.M, num, nodes, weights, oblique));
  PetscCall(ObliqueHoldsFindTurns_Private(level, support, assembly, &turns));
  PetscCall(LevelCreateVec(level, 1, marks));
  PetscCall(VecGetArray(*marks, &mark));
  PetscCall(VecGetArrayRead(turns, &turn));
  PetscCall(VecGetArrayRead(assembly->sums.measure, &measure));
  for (PetscInt a = 0; a < num; a++) {
    const PetscReal facets = PetscRealPart(measure[nodes[a]]) / SceneRing(level->scene, &level->coords[nodes[a] * dim]);
    const PetscReal size   = PetscPowReal(facets, 1. / (dim - 1));

    if (!assembly->sums.M)
      PetscCall(ObliqueHoldsMeetObstacle_Private(level, partner, nodes[a], &n[nodes[a] * dim], size, &across[a * dim],
                                                 &oblique[a]));
    mark[nodes[a]] = oblique[a] || PetscRealPart(turn[nodes[a]]) == 0 ? 1 : 0;
  }
  PetscCall(VecRestoreArrayRead(assembly->sums.measure, &measure));
  PetscCall(VecRestoreArrayRead(turns, &turn));
  PetscCall(VecRestoreArray(*marks, &mark));
  PetscCall(VecDestroy(&turns));
  PetscCall(VecRestoreArrayRead(assembly->directions, &n));
  PetscCall(PetscFree4(nodes, weights, across, oblique));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Clears the marks of nodes without a neighbour that keeps its multiplier. Collective.
   [in] facets - that carry the multipliers; [in,out] marks - ghosts included */
static PetscErrorCode ObliqueHoldsKeepLonely_Private(Level *level, const Facets *facets,
                                                     const MultiplierStatus status[], Vec marks)
{
  enum { F = ELEMENT_MAX_FACET_NODES };
  Vec          beside, local[2];
  PetscScalar *mark, *near;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, &beside));
  PetscCall(LevelShareVec(marks, INSERT_VALUES));
  PetscCall(VecGhostGetLocalForm(marks, &local[0]));
  PetscCall(VecGhostGetLocalForm(beside, &local[1]));
  PetscCall(VecGetArray(local[0], &mark));
  PetscCall(VecGetArray(local[1], &near));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * F], num = ElementNumNodes(facets->type[f]);
    PetscBool       kept = PETSC_FALSE;

    for (PetscInt i = 0; i < num; i++)
      kept = (PetscBool)(kept || (status[nodes[i]] == NODE_KEPT && PetscRealPart(mark[nodes[i]]) == 0));
    for (PetscInt i = 0; i < num && kept; i++) near[nodes[i]] = 1;
  }
  PetscCall(VecRestoreArray(local[1], &near));
  PetscCall(VecGhostRestoreLocalForm(beside, &local[1]));
  PetscCall(LevelShareVec(beside, MAX_VALUES));
  PetscCall(VecRestoreArray(local[0], &mark));
  PetscCall(VecGhostGetLocalForm(beside, &local[1]));
  PetscCall(VecPointwiseMult(local[0], local[0], local[1]));
  PetscCall(VecGhostRestoreLocalForm(beside, &local[1]));
  PetscCall(VecGhostRestoreLocalForm(marks, &local[0]));
  PetscCall(VecDestroy(&beside));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ObliqueHoldsFind(Level *level, const Support *support, const FacetPartner *partner,
                                const PairAssembly *assembly, PetscBool **oblique)
{
  Vec                marks;
  const PetscScalar *mark;
  PetscReal          most;
  PetscBool          any;

  PetscFunctionBeginUser;
  *oblique = NULL;
  PetscCall(ObliqueHoldsMark_Private(level, support, partner, assembly, &marks, &any));
  if (any) {
    PetscCall(ObliqueHoldsKeepLonely_Private(level, &assembly->sums.carrying.facets, assembly->status, marks));
    PetscCall(VecNorm(marks, NORM_INFINITY, &most));
    if (most > 0) {
      PetscCall(PetscMalloc1(level->num_nodes, oblique));
      PetscCall(GhostedGetArrayRead(marks, &mark));
      for (PetscInt i = 0; i < level->num_nodes; i++) (*oblique)[i] = (PetscBool)(PetscRealPart(mark[i]) > 0);
      PetscCall(GhostedRestoreArrayRead(marks, &mark));
    }
  }
  PetscCall(VecDestroy(&marks));
  PetscFunctionReturn(PETSC_SUCCESS);
}
