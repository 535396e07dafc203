/* support.c -- fixed directions of nodes, gathered from all boundaries of a body and made orthonormal.

   Only ranks with a facet of the side at a node know that the node lies on the side, not all ranks with the
   node: flags travel through a ghosted Vec. All that follows depends on the node's position and on the
   boundary alone, so every rank that holds a node finds the same. */
#include "mesh/meshimpl.h"
#include "base/compat.h"
#include "base/usererror.h"
#include "mesh/support.h"
#include "kernel/dense.h"
#include "kernel/vector.h"

static const PetscReal FlatShare = 1e-6; /* a flat side stays this near its plane, over its length */
static const PetscReal ParallelSine =
    1e-5; /* two directions nearer than this are one; above what FlatShare leaves open */
static const PetscReal AxisCosine = 1e-9; /* smaller components of a side's normal are round-off of a map */
static const PetscReal Contradiction =
    1e-8; /* between two values for one direction, over the largest value of the scene */

/* What is gathered while boundary after boundary is read. */
typedef struct {
  Scene      scene;
  Level     *level;
  Support   *support;
  PetscInt  *sides;          /* the boundary of each direction [num_nodes][dim] */
  PetscReal *given;          /* the directions as boundaries give them [num_nodes][dim][dim] */
  Vec        flags;          /* 1 on nodes of the present side */
  PetscReal  mismatch;       /* largest contradiction on this rank ... */
  PetscInt   node, boundary; /* ... and where: the local node, and the boundary that came second */
} Gather;

/* Adds the condition direction . u = value at a node by Gram-Schmidt; one that is implied already is only compared. */
static void GatherHold_Private(Gather *gather, PetscInt node, PetscInt boundary, const PetscReal direction[],
                               PetscReal value)
{
  Support       *support = gather->support;
  const PetscInt dim     = support->dim;
  PetscReal     *Q = &support->directions[node * dim * dim], *values = &support->values[node * dim], r[3], rest = value,
            length;

  support->max_value = PetscMax(support->max_value, PetscAbsReal(value));
  for (PetscInt d = 0; d < dim; d++) r[d] = direction[d];
  for (PetscInt k = 0; k < support->count[node]; k++) {
    const PetscReal dot = VectorDot(dim, &Q[k * dim], direction);

    for (PetscInt d = 0; d < dim; d++) r[d] -= dot * Q[k * dim + d];
    rest -= dot * values[k];
  }
  length = VectorNorm(dim, r);
  if (length <= ParallelSine) {
    if (PetscAbsReal(rest) > gather->mismatch) {
      gather->mismatch = PetscAbsReal(rest);
      gather->node     = node;
      gather->boundary = boundary;
    }
    return;
  }
  gather->sides[node * dim + support->count[node]] = boundary;
  for (PetscInt d = 0; d < dim; d++) gather->given[(node * dim + support->count[node]) * dim + d] = direction[d];
  for (PetscInt d = 0; d < dim; d++) Q[support->count[node] * dim + d] = r[d] / length;
  values[support->count[node]++] = rest / length;
  if (support->side[node] == BOUNDARY_NONE) support->side[node] = boundary;
}

/* Flags the nodes of a side on all ranks that hold them. [out] local - form of gather->flags, to be restored by the
   caller */
static PetscErrorCode GatherFlagSide_Private(Gather *gather, PetscInt body, const char side[], Vec *local)
{
  PetscScalar *flag;
  Facets       facets;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(gather->flags, local));
  PetscCall(VecSet(*local, 0));
  PetscCall(LevelGetFacets(gather->level, gather->scene, body, side, &facets));
  PetscCall(VecGetArray(*local, &flag));
  for (PetscInt f = 0; f < facets.num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); i++)
      flag[facets.nodes[f * ELEMENT_MAX_FACET_NODES + i]] = 1;
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
      if (!ExpressionIsFree(boundary->value, d)) GatherHold_Private(gather, node, b, axis, value[d]);
    }
  }
  PetscCall(VecRestoreArrayRead(local, &flag));
  PetscCall(VecGhostRestoreLocalForm(gather->flags, &local));
  PetscCall(ExpressionCheck(level->comm, boundary->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Unit normal of a flat side, along a Cartesian axis exactly where it is one but for round-off. Its sign means
   nothing to a displacement of zero, so axes are taken forward. */
static void NormalTidy_Private(PetscInt dim, PetscReal n[])
{
  PetscReal square = 0;
  PetscInt  along = -1, num = 0;

  for (PetscInt d = 0; d < dim; d++) {
    if (PetscAbsReal(n[d]) < AxisCosine) n[d] = 0;
    square += n[d] * n[d];
    if (n[d] != 0) along = d, ++num;
  }
  for (PetscInt d = 0; d < dim; d++) n[d] /= PetscSqrtReal(square);
  if (num == 1) n[along] = 1;
}

/* Adds the integrals of a facet's unit normal, and of 1. The curved facet counts: the triangle of its corners may be turned over in a flat side
   whose rim is curved. [in,out] sum - [dim + 1] */
static void FacetAddNormal_Private(const Level *level, const Facets *facets, PetscInt f, PetscReal sum[])
{
  const ElementType type   = (ElementType)facets->type[f];
  const PetscInt    degree = ElementOrder(type), dim = level->dim;
  PetscReal         X[ELEMENT_MAX_FACET_NODES * 3], xi[ELEMENT_MAX_POINTS * 2], weight[ELEMENT_MAX_POINTS];
  PetscReal         phi[ELEMENT_MAX_NODES], normal[3];
  const PetscInt    num = QuadratureRule(type, degree, xi, weight);

  for (PetscInt i = 0; i < ElementNumNodes(type); i++) {
    const PetscInt node = facets->nodes[f * ELEMENT_MAX_FACET_NODES + i];

    for (PetscInt d = 0; d < dim; d++) X[i * dim + d] = level->coords[node * dim + d];
  }
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
  if (size < (1 - FlatShare) * sum[level->dim] || range[0] + range[1] > FlatShare * extent) {
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
      if (PetscRealPart(flag[node]) != 0) GatherHold_Private(gather, node, b, n, 0);
    }
    PetscCall(VecRestoreArrayRead(local, &flag));
    PetscCall(VecGhostRestoreLocalForm(gather->flags, &local));
  }
  PetscCall(SideNamesDestroy(&names));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A ring does not move off its axis: e_r . u = 0 at nodes on it. They are told by their position, which is
   exact (LevelSetAxis). */
static void GatherAxis_Private(Gather *gather)
{
  const PetscInt  dim       = gather->level->dim;
  const PetscReal radius[3] = {1, 0, 0};

  if (gather->scene->model != MODEL_AXISYMMETRIC) return;
  for (PetscInt node = 0; node < gather->level->num_nodes; node++) {
    if (gather->level->coords[node * dim] == 0) GatherHold_Private(gather, node, BOUNDARY_AXIS, radius, 0);
  }
}

/* How a sentence names a boundary of a body. */
static void BoundaryShow_Private(const SceneBody *body, PetscInt boundary, char shown[MESH_SENTENCE])
{
  if (boundary == BOUNDARY_AXIS)
    snprintf(shown, MESH_SENTENCE, "on the axis of revolution");
  else
    snprintf(shown, MESH_SENTENCE, "on side '%s'", body->boundaries[boundary].side);
}

/* Two boundaries that want different values in one direction are a user error. */
static PetscErrorCode GatherCheck_Private(Gather *gather)
{
  char     sentence[MESH_SENTENCE] = "", first[MESH_SENTENCE], second[MESH_SENTENCE];
  Support *support                 = gather->support;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &support->max_value, 1, MPIU_REAL, MPIU_MAX, gather->level->comm));
  if (gather->mismatch > Contradiction * support->max_value) {
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

/* Frames of all fixed nodes; where every direction is fixed the Cartesian axes serve best. */
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

/* Whether more than one boundary fixes a node. */
static PetscBool GatherIsShared_Private(const Gather *gather, PetscInt node)
{
  const PetscInt *sides = &gather->sides[node * gather->support->dim];

  for (PetscInt k = 1; k < gather->support->count[node]; k++)
    if (sides[k] != sides[0]) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* Keeps the directions of nodes that several boundaries fix. */
static PetscErrorCode GatherShared_Private(const Gather *gather)
{
  Support       *support = gather->support;
  const PetscInt dim = support->dim, num = gather->level->num_nodes;

  PetscFunctionBeginUser;
  support->num_shared = 0;
  for (PetscInt node = 0; node < num; node++) support->num_shared += GatherIsShared_Private(gather, node);
  PetscCall(PetscCalloc1(support->num_shared, &support->shared));
  for (PetscInt node = 0, i = 0; node < num; node++) {
    SharedNode *shared = &support->shared[i];

    if (!GatherIsShared_Private(gather, node)) continue;
    shared->node = node;
    i++;
    for (PetscInt k = 0; k < support->count[node]; k++) {
      shared->side[k] = gather->sides[node * dim + k];
      PetscCall(PetscArraycpy(shared->direction[k], &gather->given[(node * dim + k) * dim], dim));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

void SupportSplitForce(const Support *support, const SharedNode *shared, const PetscReal force[], PetscReal parts[])
{
  const PetscInt dim = support->dim, count = support->count[shared->node];
  PetscReal      G[9]; // independent by more than ParallelSine, so it has its digits

  for (PetscInt i = 0; i < count; i++) {
    parts[i] = VectorDot(dim, shared->direction[i], force);
    for (PetscInt j = 0; j < count; j++) G[i * count + j] = VectorDot(dim, shared->direction[i], shared->direction[j]);
  }
  if (DenseCholesky(count, G)) DenseCholeskySolve(count, G, parts);
}

/* Boundary by boundary in the order typed, so that `side` names the first; contradictions are judged when the
   largest value of the scene is known. */
PetscErrorCode SupportCreate(Level *level, Scene scene, Support *support)
{
  const PetscInt num = level->num_nodes, dim = level->dim;
  Gather         gather = {.scene = scene, .level = level, .support = support};

  PetscFunctionBeginUser;
  support->dim       = dim;
  support->max_value = 0;
  PetscCall(PetscCalloc4(num, &support->count, num, &support->side, num * dim * dim, &support->directions, num * dim,
                         &support->values));
  PetscCall(PetscMalloc2(num * dim, &gather.sides, num * dim * dim, &gather.given));
  for (PetscInt i = 0; i < num; i++) support->side[i] = BOUNDARY_NONE;
  PetscCall(LevelCreateVec(level, 1, &gather.flags));
  for (PetscInt body = 0; body < scene->num_bodies; body++) {
    for (PetscInt b = 0; b < scene->bodies[body].num_boundaries; b++) {
      const BoundaryKind kind = scene->bodies[body].boundaries[b].kind;

      if (kind == BOUNDARY_DISPLACEMENT) PetscCall(GatherDisplacement_Private(&gather, body, b));
      if (kind == BOUNDARY_NORMAL) PetscCall(GatherNormal_Private(&gather, body, b));
    }
  }
  GatherAxis_Private(&gather);
  PetscCall(VecDestroy(&gather.flags));
  PetscCall(GatherCheck_Private(&gather));
  PetscCall(GatherShared_Private(&gather));
  PetscCall(PetscFree2(gather.sides, gather.given));
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
  PetscCall(PetscFree(support->shared));
  PetscCall(PetscFree4(support->count, support->side, support->directions, support->values));
  PetscFunctionReturn(PETSC_SUCCESS);
}
