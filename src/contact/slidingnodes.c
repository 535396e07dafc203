/* slidingnodes.c -- see the header.

   A support fixes such a node along its partner. The node has no unknown there on which friction could act.
   Without it, the resultant of friction would lack the node's part of the side. */
#include "base/compat.h"
#include "contact/slidingnodes.h"
#include "kernel/vector.h"
#include "level/ghosted.h"

/* Displacements below this part of the largest prescribed one are roundoff, and so are such parts of D. */
static const PetscReal STUCK = 1e-9;

/* M times the values of one component at the mortar side. [in,out] component - owned nodes [num_owned] */
static PetscErrorCode SlidingNodesAverage_Private(Level *level, Mat M, PetscReal component[])
{
  Vec                own, sums;
  const PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, &own));
  PetscCall(VecDuplicate(own, &sums));
  PetscCall(VecPlaceArray(own, component));
  PetscCall(MatMult(M, own, sums));
  PetscCall(VecResetArray(own));
  PetscCall(VecGetArrayRead(sums, &value));
  PetscCall(PetscArraycpy(component, value, level->num_owned));
  PetscCall(VecRestoreArrayRead(sums, &value));
  PetscCall(VecDestroy(&sums));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What supports prescribe at the mortar side, by component. Collective.
   [out] moved - M times the displacements [dim][num_owned];
   [out] held - M times sum d d' over the held directions d, lower triangle [dim][dim][num_owned] */
static PetscErrorCode SlidingNodesGetMortar_Private(Level *level, const Support *support, Mat M, PetscReal moved[],
                                                    PetscReal held[])
{
  const PetscInt dim = support->dim, n = level->num_owned;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < n; i++)
    for (PetscInt j = 0; j < support->count[i]; j++) {
      const PetscReal *d = &support->directions[(i * dim + j) * dim];

      for (PetscInt k = 0; k < dim; k++) {
        moved[k * n + i] += support->values[i * dim + j] * d[k];
        for (PetscInt l = 0; l <= k; l++) held[(k * dim + l) * n + i] += d[k] * d[l];
      }
    }
  for (PetscInt k = 0; k < dim; k++) {
    PetscCall(SlidingNodesAverage_Private(level, M, &moved[k * n]));
    for (PetscInt l = 0; l <= k; l++) PetscCall(SlidingNodesAverage_Private(level, M, &held[(k * dim + l) * n]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a node slides along its held direction j. [in] n - owned nodes; [in] moved, held - or NULL */
static PetscBool SlidingNodesSlides_Private(const Support *support, PetscInt n, PetscInt i, PetscInt j, PetscReal D,
                                            const PetscReal moved[], const PetscReal held[])
{
  const PetscInt   dim   = support->dim;
  const PetscReal *d     = &support->directions[(i * dim + j) * dim];
  PetscReal        given = 0, share = 0;

  if (held) {
    for (PetscInt k = 0; k < dim; k++) {
      given += d[k] * moved[k * n + i];
      for (PetscInt l = 0; l <= k; l++) share += (l < k ? 2 : 1) * d[k] * held[(k * dim + l) * n + i] * d[l];
    }
    if (PetscAbsReal(share) <= STUCK * D) return PETSC_TRUE;
    given /= share;
  }
  return (PetscBool)(PetscAbsReal(support->values[i * dim + j] - given) > STUCK * support->max_value);
}

PetscErrorCode SlidingNodesFind(Level *level, const Support *support, Mat M, PetscInt num, const PetscInt nodes[],
                                const PetscReal D[], PetscBool slides[])
{
  const PetscInt dim = level->dim, n = level->num_owned;
  PetscReal     *moved = NULL, *held = NULL;
  PetscBool      any = PETSC_FALSE;

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < num; a++) {
    slides[a] = PETSC_FALSE;
    any       = (PetscBool)(any || support->count[nodes[a]]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  if (M) {
    PetscCall(PetscCalloc2(dim * n, &moved, dim * dim * n, &held));
    PetscCall(SlidingNodesGetMortar_Private(level, support, M, moved, held));
  }
  for (PetscInt a = 0; a < num; a++)
    for (PetscInt j = 0; j < support->count[nodes[a]]; j++)
      if (SlidingNodesSlides_Private(support, n, nodes[a], j, D[a], moved, held)) slides[a] = PETSC_TRUE;
  PetscCall(PetscFree2(moved, held));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a held node of any rank does not slide. Collective. */
static PetscErrorCode SlidingNodesRests_Private(const Level *level, const Support *support, PetscInt num,
                                                const PetscInt nodes[], const PetscBool slides[], PetscBool *rests)
{
  PetscFunctionBeginUser;
  *rests = PETSC_FALSE;
  for (PetscInt a = 0; a < num; a++) *rests = (PetscBool)(*rests || (support->count[nodes[a]] && !slides[a]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, rests, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SlidingNodesFindEver(Level *level, const Support *support, Mat M, PetscInt num, const PetscInt nodes[],
                                    const PetscReal D[], PetscBool slides[])
{
  const Scene       scene   = level->scene;
  const SceneSteps *steps   = &scene->steps;
  const PetscReal   now     = scene->time;
  const int         changed = scene->changed;
  PetscBool        *then, rests;

  PetscFunctionBeginUser;
  PetscCall(SlidingNodesFind(level, support, M, num, nodes, D, slides));
  PetscCall(PetscMalloc1(num, &then));
  PetscCall(SlidingNodesRests_Private(level, support, num, nodes, slides, &rests));
  for (PetscInt k = 0; k < steps->num_past + steps->num && rests; k++) {
    Support other;

    PetscCall(SceneSetTime(scene, k < steps->num_past ? steps->past[k] : steps->t[k - steps->num_past]));
    PetscCall(SupportCreate(level, scene, &other));
    PetscCall(SlidingNodesFind(level, &other, M, num, nodes, D, then));
    PetscCall(SupportDestroy(&other));
    for (PetscInt a = 0; a < num; a++) slides[a] = (PetscBool)(slides[a] || then[a]);
    PetscCall(SlidingNodesRests_Private(level, support, num, nodes, slides, &rests));
  }
  if (scene->time != now) PetscCall(SceneSetTime(scene, now));
  scene->changed = changed;
  PetscCall(PetscFree(then));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks the nodes by 1 in a vector. [out] marks - ghosted, owned by the caller; [out] any - on any rank */
static PetscErrorCode SlidingNodesMark_Private(Level *level, const Support *support, const MortarIntegrals *sums,
                                               const MultiplierStatus status[], Vec *marks, PetscBool *any)
{
  PetscInt           num = 0, *nodes;
  PetscReal         *weights;
  PetscBool         *slides;
  PetscScalar       *mark;
  const PetscScalar *D;

  PetscFunctionBeginUser;
  *any = PETSC_FALSE;
  PetscCall(PetscMalloc3(level->num_owned, &nodes, level->num_owned, &weights, level->num_owned, &slides));
  PetscCall(VecGetArrayRead(sums->D, &D));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    if (status[i] != NODE_KEPT || !support->count[i]) continue;
    nodes[num]     = i;
    weights[num++] = PetscRealPart(D[i]);
  }
  PetscCall(VecRestoreArrayRead(sums->D, &D));
  PetscCall(SlidingNodesFindEver(level, support, sums->M, num, nodes, weights, slides));
  PetscCall(LevelCreateVec(level, 1, marks));
  PetscCall(VecGetArray(*marks, &mark));
  for (PetscInt a = 0; a < num; a++) {
    mark[nodes[a]] = slides[a] ? 1 : 0;
    *any           = (PetscBool)(*any || slides[a]);
  }
  PetscCall(VecRestoreArray(*marks, &mark));
  PetscCall(PetscFree3(nodes, weights, slides));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marked nodes count as removed. [in] marks - owned values count; [in,out] status - [num_nodes] */
static PetscErrorCode SlidingNodesSplit_Private(Level *level, Vec marks, MultiplierStatus status[])
{
  const PetscScalar *mark;

  PetscFunctionBeginUser;
  PetscCall(VecGhostUpdateBegin(marks, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(marks, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(GhostedGetArrayRead(marks, &mark));
  for (PetscInt i = 0; i < level->num_nodes; i++)
    if (PetscRealPart(mark[i]) > 0) status[i] = NODE_REMOVED;
  PetscCall(GhostedRestoreArrayRead(marks, &mark));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SlidingNodesRemove(Level *level, const Support *support, const Facets *facets,
                                  const MortarIntegrals *sums, MultiplierStatus status[])
{
  MultiplierStatus *split;
  PetscBool         any;
  Mat               W = NULL;
  Vec               marks, ones, taken;

  PetscFunctionBeginUser;
  PetscCall(SlidingNodesMark_Private(level, support, sums, status, &marks, &any));
  if (any) {
    PetscCall(PetscMalloc1(level->num_nodes, &split));
    PetscCall(PetscArraycpy(split, status, level->num_nodes));
    PetscCall(SlidingNodesSplit_Private(level, marks, split));
    PetscCall(RedistributionWeights(level, facets, split, sums, &W));
    PetscCall(PetscFree(split));
  }
  if (W) { // columns of nodes without a path are empty
    PetscCall(MatCreateVecs(W, &taken, &ones));
    PetscCall(VecSet(ones, 1));
    PetscCall(MatMultTranspose(W, ones, taken));
    PetscCall(VecPointwiseMult(marks, marks, taken));
    PetscCall(SlidingNodesSplit_Private(level, marks, status));
    PetscCall(VecDestroy(&ones));
    PetscCall(VecDestroy(&taken));
    PetscCall(MatDestroy(&W));
  }
  PetscCall(VecDestroy(&marks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SlidingNodesOfPair(const Pair pair, const Support *support, PetscBool slides[])
{
  PetscFunctionBeginUser;
  PetscCall(SlidingNodesFind(pair->level, support, pair->M, pair->num, pair->nodes, pair->D, slides));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SlidingNodesElsewhere(Level *level, const Support *support, PetscInt num, const Pair pairs[],
                                     PetscBool *elsewhere)
{
  PetscFunctionBeginUser;
  *elsewhere = PETSC_FALSE;
  for (PetscInt p = 0; p < num; p++) {
    const Pair pair = pairs[p];
    PetscBool *slides;

    if (!ScenePairHasFriction(pair->spec)) continue;
    PetscCall(PetscMalloc1(pair->num, &slides));
    PetscCall(SlidingNodesOfPair(pair, support, slides));
    for (PetscInt a = 0; a < pair->num; a++)
      if (slides[a] && !pair->slides[a]) *elsewhere = PETSC_TRUE;
    PetscCall(PetscFree(slides));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, elsewhere, 1, MPIU_BOOL, MPI_LOR, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}
