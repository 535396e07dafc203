/* support.c -- fixed directions of nodes, gathered from all boundaries of a body and made orthonormal.

   Only ranks with a facet of the side at a node know that the node lies on it. So flags are exchanged by a
   ghosted Vec. All else depends on the node's position and on the boundary alone: every rank that has a node
   finds the same. */
#include "base/compat.h"
#include "base/usererror.h"
#include "support/support.h"
#include "kernel/dense.h"
#include "kernel/vector.h"

enum { SUPPORT_SENTENCE = 1024 }; /* length of the sentence of a user error */

static const PetscReal FLAT_SHARE = 1e-6; /* a flat side stays this near its plane, over its length */
static const PetscReal PARALLEL_SINE =
    1e-5; /* two directions nearer than this are one; above what FLAT_SHARE leaves open */
static const PetscReal AXIS_COSINE = 1e-9; /* smaller components of a side's normal are round-off of a map */
static const PetscReal CONTRADICTION =
    1e-8; /* between two values for one direction, over the largest value of the scene */

/* A direction as a boundary gives it. */
typedef struct {
  PetscInt  node, boundary;
  PetscReal direction[3];
} GivenDirection;

/* Data collected boundary by boundary. */
typedef struct {
  Scene           scene;
  Level          *level;
  Support        *support;
  GivenDirection *given; /* boundary by boundary [num_given] */
  PetscInt        num_given, max_given;
  Vec             flags;          /* 1 on nodes of the present side */
  PetscReal       mismatch;       /* largest contradiction on this rank ... */
  PetscInt        node, boundary; /* ... and where: the local node, and the boundary that came second */
} Gather;

/* Stores a direction for the split of reactions. */
static PetscErrorCode GatherKeep_Private(Gather *gather, PetscInt node, PetscInt boundary, const PetscReal direction[])
{
  GivenDirection *given;

  PetscFunctionBeginUser;
  if (gather->num_given == gather->max_given) {
    gather->max_given = 2 * gather->max_given + 64;
    PetscCall(PetscRealloc(sizeof(*gather->given) * gather->max_given, &gather->given));
  }
  given  = &gather->given[gather->num_given++];
  *given = (GivenDirection){.node = node, .boundary = boundary};
  PetscCall(PetscArraycpy(given->direction, direction, gather->support->dim));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the condition direction . u = value at a node by Gram-Schmidt; one that is implied already is only
   compared. */
static PetscErrorCode GatherHold_Private(Gather *gather, PetscInt node, PetscInt boundary, const PetscReal direction[],
                                         PetscReal value)
{
  Support       *support = gather->support;
  const PetscInt dim     = support->dim;
  PetscReal     *Q = &support->directions[node * dim * dim], *values = &support->values[node * dim], r[3], rest = value,
            length;

  PetscFunctionBeginUser;
  support->max_value = PetscMax(support->max_value, PetscAbsReal(value));
  for (PetscInt d = 0; d < dim; d++) r[d] = direction[d];
  for (PetscInt k = 0; k < support->count[node]; k++) {
    const PetscReal dot = VectorDot(dim, &Q[k * dim], direction);

    for (PetscInt d = 0; d < dim; d++) r[d] -= dot * Q[k * dim + d];
    rest -= dot * values[k];
  }
  length = VectorNorm(dim, r);
  if (length <= PARALLEL_SINE) {
    if (PetscAbsReal(rest) > gather->mismatch) {
      gather->mismatch = PetscAbsReal(rest);
      gather->node     = node;
      gather->boundary = boundary;
    }
    if (boundary != BOUNDARY_AXIS) PetscCall(GatherKeep_Private(gather, node, boundary, direction));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(GatherKeep_Private(gather, node, boundary, direction));
  for (PetscInt d = 0; d < dim; d++) Q[support->count[node] * dim + d] = r[d] / length;
  values[support->count[node]++] = rest / length;
  if (support->side[node] == BOUNDARY_NONE) support->side[node] = boundary;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Flags the nodes of a side on all ranks that hold them. In place of a node that hangs it flags those that it
   hangs on. Its displacement is theirs, and they lie on the side as well.
   [out] local - form of gather->flags, to be restored by the caller */
static PetscErrorCode GatherFlagSide_Private(Gather *gather, PetscInt body, const char side[], Vec *local)
{
  const Hanging *hanging = &gather->level->hanging;
  PetscScalar   *flag;
  Facets         facets;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(gather->flags, local));
  PetscCall(VecSet(*local, 0));
  PetscCall(LevelGetFacets(gather->level, gather->scene, body, side, &facets));
  PetscCall(VecGetArray(*local, &flag));
  for (PetscInt f = 0; f < facets.num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); i++) {
      const PetscInt node = facets.nodes[f * ELEMENT_MAX_FACET_NODES + i];

      if (!LevelNodeHangs(gather->level, node)) flag[node] = 1;
      for (PetscInt k = hanging->start ? hanging->start[node] : 0; hanging->start && k < hanging->start[node + 1]; k++)
        flag[hanging->node[k]] = 1;
    }
  }
  PetscCall(VecRestoreArray(*local, &flag));
  PetscCall(FacetsDestroy(&facets));
  PetscCall(LevelShareVec(gather->flags, MAX_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* e_d . u = value_d for every component that is not free. */
static PetscErrorCode GatherDisplacement_Private(Gather *gather, PetscInt body, PetscInt b)
{
  const SceneBoundary *boundary = &gather->scene->bodies[body].boundaries[b];
  const Level         *level    = gather->level;
  const PetscScalar   *flag;
  Vec                  local;

  PetscFunctionBeginUser;
  PetscCall(GatherFlagSide_Private(gather, body, boundary->side, &local));
  PetscCall(VecGetArrayRead(local, &flag));
  for (PetscInt node = 0; node < level->num_nodes; node++) {
    PetscReal value[3];

    if (PetscRealPart(flag[node]) == 0) continue;
    PetscCall(ExpressionEvaluate(boundary->value, level->dim, &level->coords[node * level->dim], value));
    for (PetscInt d = 0; d < level->dim; d++) {
      PetscReal axis[3] = {0, 0, 0};

      axis[d] = 1;
      if (!ExpressionIsFree(boundary->value, d)) PetscCall(GatherHold_Private(gather, node, b, axis, value[d]));
    }
  }
  PetscCall(VecRestoreArrayRead(local, &flag));
  PetscCall(VecGhostRestoreLocalForm(gather->flags, &local));
  PetscCall(ExpressionCheck(level->comm, boundary->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Unit normal of a flat side, along a Cartesian axis exactly where it is one but for round-off. A
   displacement of zero does not depend on its sign, so axes are positive. */
static void NormalTidy_Private(PetscInt dim, PetscReal n[])
{
  PetscReal square = 0;
  PetscInt  along = -1, num = 0;

  for (PetscInt d = 0; d < dim; d++) {
    if (PetscAbsReal(n[d]) < AXIS_COSINE) n[d] = 0;
    square += n[d] * n[d];
    if (n[d] != 0) along = d, ++num;
  }
  for (PetscInt d = 0; d < dim; d++) n[d] /= PetscSqrtReal(square);
  if (num == 1) n[along] = 1;
}

/* Adds the integrals of a facet's unit normal, and of 1. They are over the curved facet: in a flat side with
   a curved rim the triangle of its corners may be inverted. [in,out] sum - [dim + 1] */
static void FacetAddNormal_Private(const Level *level, const Facets *facets, PetscInt f, PetscReal sum[])
{
  const ElementType type   = (ElementType)facets->type[f];
  const PetscInt    degree = ElementOrder(type), dim = level->dim;
  PetscReal         X[ELEMENT_MAX_FACET_NODES * 3], xi[ELEMENT_MAX_POINTS * 2], weight[ELEMENT_MAX_POINTS];
  PetscReal         phi[ELEMENT_MAX_NODES], normal[3];
  const PetscInt    num = QuadratureRule(type, degree, xi, weight);

  VectorGather(dim, ElementNumNodes(type), &facets->nodes[f * ELEMENT_MAX_FACET_NODES], level->coords, X);
  for (PetscInt q = 0; q < num; q++) {
    const PetscReal area = weight[q] * ElementSurface(type, X, &xi[q * (dim - 1)], NULL, phi, normal);

    for (PetscInt d = 0; d < dim; d++) sum[d] += area * normal[d];
    sum[dim] += area;
  }
}

/* The normal of a side, or a user error if the side is not flat. [out] n - unit [dim] */
static PetscErrorCode SideGetNormal_Private(Gather *gather, PetscInt body, const char side[], PetscReal n[])
{
  const Level *level  = gather->level;
  PetscReal    sum[4] = {0, 0, 0, 0}, range[2] = {-PETSC_MAX_REAL, -PETSC_MAX_REAL}, size = 0,
            extent; /* of normals and sizes; -lowest, highest */
  Facets facets;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(gather->level, gather->scene, body, side, &facets));
  for (PetscInt f = 0; f < facets.num; f++) FacetAddNormal_Private(level, &facets, f, sum);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 4, MPIU_REAL, MPIU_SUM, level->comm));
  for (PetscInt d = 0; d < level->dim; d++) size += PetscSqr(sum[d]);
  size   = PetscSqrtReal(size);
  extent = level->dim == 2 ? sum[level->dim] : PetscSqrtReal(sum[level->dim]);
  for (PetscInt d = 0; d < level->dim; d++) n[d] = size > 0 ? sum[d] / size : 0;
  for (PetscInt f = 0; f < facets.num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); i++) {
      PetscReal height = 0;

      for (PetscInt d = 0; d < level->dim; d++)
        height += n[d] * level->coords[facets.nodes[f * ELEMENT_MAX_FACET_NODES + i] * level->dim + d];
      range[0] = PetscMax(range[0], -height);
      range[1] = PetscMax(range[1], height);
    }
  }
  PetscCall(FacetsDestroy(&facets));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, range, 2, MPIU_REAL, MPIU_MAX, level->comm));
  if (size < (1 - FLAT_SHARE) * sum[level->dim] || range[0] + range[1] > FLAT_SHARE * extent) {
    const char *name = gather->scene->bodies[body].name;

    PetscCall(UserErrorRaise(
        level->comm,
        "-%s_bc_normal: side '%s' of body '%s' is not flat (it leaves its mean plane by %.3g over a length of %.3g); "
        "normal displacement can be fixed on flat sides only",
        name, side, name, (double)(range[0] + range[1]), (double)extent));
  }
  NormalTidy_Private(level->dim, n);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sides joined with '+' are flat one by one. */
static PetscErrorCode GatherNormal_Private(Gather *gather, PetscInt body, PetscInt b)
{
  SideNames names = {0, NULL};

  PetscFunctionBeginUser;
  PetscCall(SideNamesAdd(&names, gather->scene->bodies[body].boundaries[b].side));
  for (PetscInt s = 0; s < names.num; s++) {
    const PetscScalar *flag;
    PetscReal          n[3];
    Vec                local;

    PetscCall(SideGetNormal_Private(gather, body, names.name[s], n));
    PetscCall(GatherFlagSide_Private(gather, body, names.name[s], &local));
    PetscCall(VecGetArrayRead(local, &flag));
    for (PetscInt node = 0; node < gather->level->num_nodes; node++) {
      if (PetscRealPart(flag[node]) != 0) PetscCall(GatherHold_Private(gather, node, b, n, 0));
    }
    PetscCall(VecRestoreArrayRead(local, &flag));
    PetscCall(VecGhostRestoreLocalForm(gather->flags, &local));
  }
  PetscCall(SideNamesDestroy(&names));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A ring does not move off its axis: e_r . u = 0 at nodes on it. They are recognized by their position, which
   is exact (LevelSetAxis). */
static PetscErrorCode GatherAxis_Private(Gather *gather)
{
  const PetscInt  dim       = gather->level->dim;
  const PetscReal radius[3] = {1, 0, 0};

  PetscFunctionBeginUser;
  if (gather->scene->model != MODEL_AXISYMMETRIC) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt node = 0; node < gather->level->num_nodes; node++) {
    if (gather->level->coords[node * dim] == 0) PetscCall(GatherHold_Private(gather, node, BOUNDARY_AXIS, radius, 0));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A boundary of a body as a part of a sentence. */
static void BoundaryShow_Private(const SceneBody *body, PetscInt boundary, char shown[SUPPORT_SENTENCE])
{
  if (boundary == BOUNDARY_AXIS)
    snprintf(shown, SUPPORT_SENTENCE, "on the axis of revolution");
  else
    snprintf(shown, SUPPORT_SENTENCE, "on side '%s'", body->boundaries[boundary].side);
}

/* Raises the user error of two boundaries with different values in one direction. */
static PetscErrorCode GatherCheck_Private(Gather *gather)
{
  char     sentence[SUPPORT_SENTENCE] = "", first[SUPPORT_SENTENCE], second[SUPPORT_SENTENCE];
  Support *support                    = gather->support;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &support->max_value, 1, MPIU_REAL, MPIU_MAX, gather->level->comm));
  if (gather->mismatch > CONTRADICTION * support->max_value) {
    const PetscReal *x     = &gather->level->coords[gather->node * support->dim];
    const SceneBody *body  = &gather->scene->bodies[gather->level->node_body[gather->node]];
    char             z[32] = "";

    if (support->dim == 3) snprintf(z, sizeof(z), ", %g", (double)x[2]);
    BoundaryShow_Private(body, support->side[gather->node], first);
    BoundaryShow_Private(body, gather->boundary, second);
    snprintf(sentence, sizeof(sentence),
             "body '%.200s': the displacements given %.300s and %.300s contradict each other at (%g, %g%s), by %g; "
             "make them agree there or set a component free",
             body->name, first, second, (double)x[0], (double)x[1], z, (double)gather->mismatch);
  }
  PetscCall(UserErrorCheck(gather->level->comm, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the Cartesian axis that the directions so far span least, until they are a frame. */
static void FrameComplete_Private(PetscInt dim, PetscInt count, PetscReal Q[])
{
  for (; count < dim; count++) {
    PetscReal best[3] = {0, 0, 0}, longest = 0;

    for (PetscInt c = 0; c < dim; c++) {
      PetscReal r[3] = {0, 0, 0}, square;

      r[c] = 1;
      for (PetscInt k = 0; k < count; k++) {
        for (PetscInt d = 0; d < dim; d++) r[d] -= Q[k * dim + c] * Q[k * dim + d];
      }
      square = VectorDot(dim, r, r);
      if (square <= longest) continue;
      longest = square;
      for (PetscInt d = 0; d < dim; d++) best[d] = r[d] / PetscSqrtReal(square);
    }
    for (PetscInt d = 0; d < dim; d++) Q[count * dim + d] = best[d];
  }
}

/* Frames of all fixed nodes; where every direction is fixed these are the Cartesian axes. */
static void SupportFinish_Private(const Level *level, Support *support)
{
  const PetscInt dim = support->dim;

  for (PetscInt node = 0; node < level->num_nodes; node++) {
    PetscReal *Q = &support->directions[node * dim * dim], *values = &support->values[node * dim], u[3] = {0, 0, 0};

    if (!support->count[node]) continue;
    if (support->count[node] < dim) {
      FrameComplete_Private(dim, support->count[node], Q);
      continue;
    }
    for (PetscInt k = 0; k < dim; k++) {
      for (PetscInt d = 0; d < dim; d++) u[d] += Q[k * dim + d] * values[k];
    }
    for (PetscInt k = 0; k < dim; k++) {
      values[k] = u[k];
      for (PetscInt d = 0; d < dim; d++) Q[k * dim + d] = k == d;
    }
  }
}

/* Adds a direction to those that a boundary fixes at a node, unless it does so already. */
static void SharedSideAdd_Private(SharedSide *side, PetscInt dim, const PetscReal direction[])
{
  PetscReal r[3] = {0, 0, 0}, length;

  for (PetscInt d = 0; d < dim; d++) r[d] = direction[d];
  for (PetscInt k = 0; k < side->count; k++) {
    const PetscReal dot = VectorDot(dim, side->direction[k], direction);

    for (PetscInt d = 0; d < dim; d++) r[d] -= dot * side->direction[k][d];
  }
  length = VectorNorm(dim, r);
  if (length <= PARALLEL_SINE) return;
  for (PetscInt d = 0; d < dim; d++) side->direction[side->count][d] = r[d] / length;
  side->count++;
}

/* Adds one node, if several boundaries fix it.
   [in] given - its directions, boundary by boundary [num]; [in,out] sides - begin of its entries, then their
   end */
static void GatherSharedNode_Private(const Gather *gather, PetscInt num, const GivenDirection *given[],
                                     SharedSide **sides)
{
  Support    *support = gather->support;
  SharedNode *shared  = &support->shared[support->num_shared];
  SharedSide *side    = *sides;
  PetscInt    count   = 0;

  if (!num || given[0]->boundary == given[num - 1]->boundary) return;
  *shared = (SharedNode){.node = given[0]->node, .side = side};
  for (PetscInt i = 0; i < num; i++) {
    if (!shared->num || side[shared->num - 1].boundary != given[i]->boundary)
      side[shared->num++] = (SharedSide){.boundary = given[i]->boundary};
    SharedSideAdd_Private(&side[shared->num - 1], support->dim, given[i]->direction);
  }
  for (PetscInt i = 0; i < shared->num; i++) count += side[i].count;
  shared->ambiguous = (PetscBool)(count > support->count[shared->node]);
  support->num_shared++;
  *sides += shared->num;
}

/* Keeps the directions of nodes that several boundaries fix. */
static PetscErrorCode GatherShared_Private(const Gather *gather)
{
  Support               *support = gather->support;
  const PetscInt         num     = gather->level->num_nodes;
  const GivenDirection **sorted;
  SharedSide            *next;
  PetscInt              *start;

  PetscFunctionBeginUser;
  support->num_shared = 0;
  PetscCall(PetscCalloc2(num + 2, &start, gather->num_given, &sorted));
  for (PetscInt i = 0; i < gather->num_given; i++) start[gather->given[i].node + 2]++;
  for (PetscInt node = 0; node < num; node++) start[node + 2] += start[node + 1];
  for (PetscInt i = 0; i < gather->num_given; i++) sorted[start[gather->given[i].node + 1]++] = &gather->given[i];
  PetscCall(PetscMalloc2(gather->num_given, &support->shared, gather->num_given, &support->sides));
  next = support->sides;
  for (PetscInt node = 0; node < num; node++)
    GatherSharedNode_Private(gather, start[node + 1] - start[node], &sorted[start[node]], &next);
  PetscCall(PetscFree2(start, sorted));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The part of a vector in the directions of a side. */
static void SharedSideProject_Private(const SharedSide *side, PetscInt dim, const PetscReal v[], PetscReal part[])
{
  for (PetscInt d = 0; d < dim; d++) part[d] = 0;
  for (PetscInt k = 0; k < side->count; k++) {
    const PetscReal dot = VectorDot(dim, side->direction[k], v);

    for (PetscInt d = 0; d < dim; d++) part[d] += dot * side->direction[k][d];
  }
}

void SupportSplitForce(const Support *support, const SharedNode *shared, const PetscReal force[], PetscReal parts[],
                       PetscReal rests[])
{
  const PetscInt   dim = support->dim, count = support->count[shared->node];
  const PetscReal *Q    = &support->directions[shared->node * dim * dim]; // its first ones are a basis
  PetscReal        S[9] = {0}, rest[3], in_frame[3] = {0, 0, 0}, mu[3] = {0, 0, 0};

  for (PetscInt d = 0; d < dim; d++) rest[d] = force[d];
  for (PetscInt i = 0; i < shared->num; i++) {
    PetscReal projected[3];

    SharedSideProject_Private(&shared->side[i], dim, &parts[i * dim], projected);
    for (PetscInt d = 0; d < dim; d++) {
      parts[i * dim + d] = projected[d];
      rest[d] -= projected[d];
    }
    for (PetscInt k = 0; k < count; k++) {
      SharedSideProject_Private(&shared->side[i], dim, &Q[k * dim], projected);
      for (PetscInt l = 0; l < count; l++) S[k * count + l] += VectorDot(dim, &Q[l * dim], projected);
    }
  }
  for (PetscInt k = 0; k < count; k++) in_frame[k] = VectorDot(dim, &Q[k * dim], rest);
  if (DenseCholesky(count, S)) DenseCholeskySolve(count, S, in_frame); // sides differ by more than PARALLEL_SINE
  for (PetscInt k = 0; k < count; k++) {
    for (PetscInt d = 0; d < dim; d++) mu[d] += in_frame[k] * Q[k * dim + d];
  }
  for (PetscInt i = 0; i < shared->num; i++) {
    SharedSideProject_Private(&shared->side[i], dim, mu, &rests[i * dim]);
    for (PetscInt d = 0; d < dim; d++) parts[i * dim + d] += rests[i * dim + d];
  }
}

/* Boundary by boundary in the order typed, so that `side` names the first; contradictions are detected when
   the largest value of the scene is known. */
PetscErrorCode SupportCreate(Level *level, Scene scene, Support *support)
{
  const PetscInt num = level->num_nodes, dim = level->dim;
  Gather         gather = {.scene = scene, .level = level, .support = support};

  PetscFunctionBeginUser;
  support->dim       = dim;
  support->max_value = 0;
  PetscCall(PetscCalloc4(num, &support->count, num, &support->side, num * dim * dim, &support->directions, num * dim,
                         &support->values));
  for (PetscInt i = 0; i < num; i++) support->side[i] = BOUNDARY_NONE;
  PetscCall(LevelCreateVec(level, 1, &gather.flags));
  for (PetscInt body = 0; body < scene->num_bodies; body++) {
    for (PetscInt b = 0; b < scene->bodies[body].num_boundaries; b++) {
      const BoundaryKind kind = scene->bodies[body].boundaries[b].kind;

      if (kind == BOUNDARY_DISPLACEMENT) PetscCall(GatherDisplacement_Private(&gather, body, b));
      if (kind == BOUNDARY_NORMAL) PetscCall(GatherNormal_Private(&gather, body, b));
    }
  }
  PetscCall(GatherAxis_Private(&gather));
  PetscCall(VecDestroy(&gather.flags));
  PetscCall(GatherCheck_Private(&gather));
  PetscCall(GatherShared_Private(&gather));
  PetscCall(PetscFree(gather.given));
  SupportFinish_Private(level, support);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SupportUpdate(Level *level, Scene scene, Support *support)
{
  PetscFunctionBeginUser;
  PetscCall(SupportDestroy(support));
  PetscCall(SupportCreate(level, scene, support));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SupportDestroy(Support *support)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(support->shared, support->sides));
  PetscCall(PetscFree4(support->count, support->side, support->directions, support->values));
  PetscFunctionReturn(PETSC_SUCCESS);
}
