/* sidehanging.c -- normals and curvatures beside hanging nodes.

   Large and small facets around a node have no edge in common, and around a hanging node there are small ones
   alone. Yet both are facets of one smooth side. */
#include "base/compat.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "side/sidehanging.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* The node next to a corner on the edge that a node hangs on; the node itself where that is no end of it. */
static PetscInt SideHangingFindNext_Private(const Level *level, PetscInt node, PetscInt corner)
{
  const Hanging *hanging = &level->hanging;
  PetscInt       next    = node;
  PetscReal      most    = 0;
  PetscBool      ends    = PETSC_FALSE;

  for (PetscInt k = hanging->start[node]; k < hanging->start[node + 1]; k++) {
    if (hanging->node[k] == corner) {
      ends = PETSC_TRUE;
    } else if (hanging->weight[k] > most) {
      most = hanging->weight[k];
      next = hanging->node[k];
    }
  }
  return ends ? next : node;
}

void SideHangingSetCorners(const Level *level, const Facets *facets, PetscInt f, const PetscReal X[], PetscReal N[])
{
  const PetscInt  dim = level->dim, num = ElementNumNodes(facets->type[f]);
  const PetscInt *nodes = &facets->nodes[f * F];

  for (PetscInt i = 0; i < num; i++) {
    PetscReal Y[3 * F], M[3 * F] = {0};
    PetscBool any = PETSC_FALSE;

    for (PetscInt j = 0; j < num; j++) {
      const PetscInt next = SideHangingFindNext_Private(level, nodes[j], nodes[i]);

      for (PetscInt k = 0; k < dim; k++)
        Y[j * dim + k] = next != nodes[j] ? level->coords[next * dim + k] : X[j * dim + k];
      any = (PetscBool)(any || next != nodes[j]);
    }
    if (!any) continue;
    FrameAddFacetNormal(dim, num, Y, M);
    for (PetscInt k = 0; k < dim; k++) N[i * dim + k] = M[i * dim + k];
  }
}

/* What a node of a smooth patch has: its normal, its curvature, and 1. */
enum { NODE_CURVATURE = 3, NODE_KNOWN = NODE_CURVATURE + 9, NODE_VALUES };

/* Means over the corners at each node, but those at feature edges and those that hang. Collective.
   [out] means - ghosted, NODE_VALUES per node; owned by the caller */
static PetscErrorCode SideHangingGetNodes_Private(Level *level, const Facets *facets, const SideShape *shape,
                                                  Vec *means)
{
  const PetscInt dim = level->dim;
  PetscScalar   *a;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, NODE_VALUES, means));
  PetscCall(GhostedGetArray(*means, &a));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      const PetscInt node = facets->nodes[f * F + i], c = f * F + i;
      PetscScalar   *at = &a[node * NODE_VALUES];

      if (shape->ridge[c] != 0 || LevelNodeHangs(level, node)) continue;
      for (PetscInt k = 0; k < dim; k++) at[k] += shape->normal[c * dim + k];
      for (PetscInt k = 0; k < dim * dim; k++) at[NODE_CURVATURE + k] += shape->curvature[c * dim * dim + k];
      at[NODE_KNOWN] += 1;
    }
  }
  PetscCall(GhostedRestoreArray(*means, &a));
  PetscCall(LevelShareVec(*means, ADD_VALUES));
  PetscCall(GhostedGetArray(*means, &a));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    const PetscReal known = PetscRealPart(a[i * NODE_VALUES + NODE_KNOWN]);

    for (PetscInt k = 0; k < NODE_VALUES && known > 0; k++) a[i * NODE_VALUES + k] /= known;
  }
  PetscCall(GhostedRestoreArray(*means, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Shape at a corner that hangs: that of the nodes that it hangs on, if all belong to a smooth patch.
   [in] node - of corner c; a - values of local nodes */
static void SideHangingSetCorner_Private(const Level *level, PetscInt node, PetscInt c, const PetscScalar a[],
                                         SideShape *shape)
{
  const Hanging *hanging = &level->hanging;
  const PetscInt dim = level->dim, begin = hanging->start[node];
  const PetscInt num = hanging->start[node + 1] - begin, *on = &hanging->node[begin];
  PetscReal      normal[3] = {0}, curvature[9] = {0};

  for (PetscInt i = 0; i < num; i++) {
    const PetscScalar *at = &a[on[i] * NODE_VALUES];

    if (at[NODE_KNOWN] == 0) return;
    for (PetscInt k = 0; k < dim; k++) normal[k] += hanging->weight[begin + i] * PetscRealPart(at[k]);
    for (PetscInt k = 0; k < dim * dim; k++)
      curvature[k] += hanging->weight[begin + i] * PetscRealPart(at[NODE_CURVATURE + k]);
  }
  FrameNormalize(dim, normal);
  for (PetscInt k = 0; k < dim; k++) shape->normal[c * dim + k] = normal[k];
  for (PetscInt k = 0; k < dim * dim; k++) shape->curvature[c * dim * dim + k] = curvature[k];
}

PetscErrorCode SideHangingSetShape(Level *level, const Facets *facets, SideShape *shape)
{
  const PetscScalar *a;
  Vec                means;

  PetscFunctionBeginUser;
  if (!level->conforming) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SideHangingGetNodes_Private(level, facets, shape, &means));
  PetscCall(GhostedGetArrayRead(means, &a));
  for (PetscInt f = 0; f < facets->num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++)
      if (LevelNodeHangs(level, facets->nodes[f * F + i]) && shape->ridge[f * F + i] == 0)
        SideHangingSetCorner_Private(level, facets->nodes[f * F + i], f * F + i, a, shape);
  }
  PetscCall(GhostedRestoreArrayRead(means, &a));
  PetscCall(VecDestroy(&means));
  PetscFunctionReturn(PETSC_SUCCESS);
}
