/* nodalnormals.c -- nodal normals of the nonmortar side.

   Only facets of this contact side count, never other faces of the body. Where facets meet at a sharp edge,
   only those that face the partner count: a mean with the other ones would incline the contact force. */
#include "base/compat.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "contact/contactfacet.h"
#include "contact/nodalnormals.h"
#include "level/ghosted.h"

/* Facets of a smooth side deviate from the normal at their node by less than half of 44 degrees. */
static const PetscReal SMOOTH_NORMAL = 0.9271838545667874;

PetscErrorCode NodalNormalsShare(Level *level, Vec normals)
{
  const PetscInt dim = level->dim;
  PetscScalar   *na;

  PetscFunctionBeginUser;
  PetscCall(LevelShareVec(normals, ADD_VALUES));
  PetscCall(GhostedGetArray(normals, &na));
  for (PetscInt i = 0; i < level->num_nodes; i++) FrameNormalize(dim, &na[i * dim]);
  PetscCall(GhostedRestoreArray(normals, &na));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sums of the weighted normals of facets at their nodes, normalized; zero where there is none. Collective.
   [in] counts - which facets [facets->num], or NULL for all; [out] normals - ghosted */
static PetscErrorCode NodalNormalsSum_Private(Level *level, const Facets *facets, const PetscBool counts[], Vec normals)
{
  const PetscInt dim = level->dim;
  PetscReal      X[3 * ELEMENT_MAX_FACET_NODES], N[3 * ELEMENT_MAX_FACET_NODES];
  PetscScalar   *na;
  Vec            local;

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(normals, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &na));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * ELEMENT_MAX_FACET_NODES], n = ElementNumNodes(facets->type[f]);
    if (counts && !counts[f]) continue;
    ContactFacetCoordinates(level, facets, f, X);
    PetscCall(PetscArrayzero(N, n * dim));
    FrameAddFacetNormal(dim, n, X, N);
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt k = 0; k < dim; k++) na[nodes[i] * dim + k] += N[i * dim + k];
    }
  }
  PetscCall(VecRestoreArray(local, &na));
  PetscCall(VecGhostRestoreLocalForm(normals, &local));
  PetscCall(NodalNormalsShare(level, normals));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodalNormalsCreate(Level *level, const Facets *facets, const SideShape *shape, Vec *normals)
{
  const PetscInt dim = level->dim;
  PetscReal      X[3 * ELEMENT_MAX_FACET_NODES], N[3 * ELEMENT_MAX_FACET_NODES];
  PetscScalar   *na;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, dim, normals));
  PetscCall(GhostedGetArray(*normals, &na));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt n = ElementNumNodes(facets->type[f]), corner = f * ELEMENT_MAX_FACET_NODES;

    ContactFacetCoordinates(level, facets, f, X);
    PetscCall(PetscArrayzero(N, n * dim));
    FrameAddFacetNormal(dim, n, X, N);
    for (PetscInt i = 0; i < n; i++) { // at feature edges the patches' mean
      const PetscReal *add = shape->ridge[corner + i] == 0 ? &shape->normal[(corner + i) * dim] : &N[i * dim];

      for (PetscInt k = 0; k < dim; k++) na[facets->nodes[corner + i] * dim + k] += add[k];
    }
  }
  PetscCall(GhostedRestoreArray(*normals, &na));
  PetscCall(NodalNormalsShare(level, *normals));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Nodes without a direction get the mean of those of nodes that hang on them. */
static PetscErrorCode NodalNormalsFill_Private(Level *level, Vec normals)
{
  const PetscInt dim     = level->dim;
  const Hanging *hanging = &level->hanging;
  PetscScalar   *na, *ma;
  Vec            means, local[2];

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(normals, &means));
  PetscCall(VecGhostGetLocalForm(normals, &local[0]));
  PetscCall(VecGhostGetLocalForm(means, &local[1]));
  PetscCall(VecZeroEntries(local[1]));
  PetscCall(VecGetArray(local[0], &na));
  PetscCall(VecGetArray(local[1], &ma));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    for (PetscInt k = hanging->start[i]; k < hanging->start[i + 1]; k++)
      for (PetscInt d = 0; d < dim; d++) ma[hanging->node[k] * dim + d] += na[i * dim + d];
  }
  PetscCall(VecRestoreArray(local[1], &ma));
  PetscCall(NodalNormalsShare(level, means));
  PetscCall(VecGetArray(local[1], &ma));
  for (PetscInt i = 0; i < level->num_nodes; i++)
    if (VectorDot(dim, &na[i * dim], &na[i * dim]) == 0) PetscCall(PetscArraycpy(&na[i * dim], &ma[i * dim], dim));
  PetscCall(VecRestoreArray(local[1], &ma));
  PetscCall(VecRestoreArray(local[0], &na));
  PetscCall(VecGhostRestoreLocalForm(means, &local[1]));
  PetscCall(VecGhostRestoreLocalForm(normals, &local[0]));
  PetscCall(VecDestroy(&means));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodalNormalsConform(Level *level, Vec normals)
{
  PetscScalar *na;

  PetscFunctionBeginUser;
  if (!level->conforming) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(NodalNormalsFill_Private(level, normals));
  PetscCall(LevelConform(level, level->dim, normals));
  PetscCall(GhostedGetArray(normals, &na));
  for (PetscInt i = 0; i < level->num_nodes; i++)
    if (LevelNodeHangs(level, i)) FrameNormalize(level->dim, &na[i * level->dim]);
  PetscCall(GhostedRestoreArray(normals, &na));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks nodes with a facet that deviates from their normal by more than facets of a smooth side. Collective.
   [out] sharp - ghosted, one per node, 1 or 0 */
static PetscErrorCode NodalNormalsFindSharp_Private(Level *level, const Facets *facets, Vec normals, Vec sharp)
{
  const PetscInt     dim = level->dim;
  PetscReal          X[3 * ELEMENT_MAX_FACET_NODES], N[3 * ELEMENT_MAX_FACET_NODES];
  const PetscScalar *na;
  PetscScalar       *mark;
  Vec                local[2];

  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(normals, &local[0]));
  PetscCall(VecGhostGetLocalForm(sharp, &local[1]));
  PetscCall(VecZeroEntries(local[1]));
  PetscCall(VecGetArrayRead(local[0], &na));
  PetscCall(VecGetArray(local[1], &mark));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * ELEMENT_MAX_FACET_NODES], n = ElementNumNodes(facets->type[f]);
    ContactFacetCoordinates(level, facets, f, X);
    PetscCall(PetscArrayzero(N, n * dim));
    FrameAddFacetNormal(dim, n, X, N);
    for (PetscInt i = 0; i < n; i++) {
      PetscReal dot = 0;
      FrameNormalize(dim, &N[i * dim]);
      for (PetscInt k = 0; k < dim; k++) dot += N[i * dim + k] * na[nodes[i] * dim + k];
      if (dot < SMOOTH_NORMAL) mark[nodes[i]] = 1;
    }
  }
  PetscCall(VecRestoreArray(local[1], &mark));
  PetscCall(VecRestoreArrayRead(local[0], &na));
  PetscCall(VecGhostRestoreLocalForm(sharp, &local[1]));
  PetscCall(VecGhostRestoreLocalForm(normals, &local[0]));
  PetscCall(LevelShareVec(sharp, MAX_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Replaces the normals of marked nodes by those of facets that face the partner, where there are such. */
static PetscErrorCode NodalNormalsTakeSeeing_Private(const Level *level, Vec sharp, Vec seeing, Vec normals)
{
  const PetscInt     dim = level->dim;
  const PetscScalar *mark, *see;
  PetscScalar       *na;

  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(sharp, &mark));
  PetscCall(GhostedGetArrayRead(seeing, &see));
  PetscCall(GhostedGetArray(normals, &na));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    PetscReal size = 0;
    for (PetscInt k = 0; k < dim; k++) size += PetscAbsScalar(see[i * dim + k]);
    if (mark[i] > 0 && size > 0) PetscCall(PetscArraycpy(&na[i * dim], &see[i * dim], dim));
  }
  PetscCall(GhostedRestoreArray(normals, &na));
  PetscCall(GhostedRestoreArrayRead(seeing, &see));
  PetscCall(GhostedRestoreArrayRead(sharp, &mark));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodalNormalsSharpen(Level *level, const Facets *facets, const PetscBool sees[], Vec normals,
                                   PetscBool *changed)
{
  PetscReal most;
  Vec       sharp, seeing;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, &sharp));
  PetscCall(NodalNormalsFindSharp_Private(level, facets, normals, sharp));
  PetscCall(VecNorm(sharp, NORM_INFINITY, &most));
  *changed = (PetscBool)(most > 0);
  if (*changed) {
    PetscCall(VecDuplicate(normals, &seeing));
    PetscCall(NodalNormalsSum_Private(level, facets, sees, seeing));
    PetscCall(NodalNormalsTakeSeeing_Private(level, sharp, seeing, normals));
    PetscCall(VecDestroy(&seeing));
  }
  PetscCall(VecDestroy(&sharp));
  PetscFunctionReturn(PETSC_SUCCESS);
}
