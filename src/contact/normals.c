/* normals.c -- nodal normals of the nonmortar side.

   Only facets of this contact side count, never side faces of the body; nodes at its ends have one-sided normals. */
#include <mortise/compat.h>
#include <mortise/frame.h>
#include "integrals.h"

/* Unit normals of the nonmortar side at its nodes, zero elsewhere; held directions are projected out. Collective.
   [out] normals - ghosted, dim per node */
PetscErrorCode NodalNormalsCreate(Level *level, const Facets *facets, Vec *normals)
{
  const PetscInt dim = level->dim;
  PetscReal      X[3 * ELEMENT_MAX_FACET_NODES], N[3 * ELEMENT_MAX_FACET_NODES];
  PetscScalar   *na;
  Vec            local;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, dim, normals));
  PetscCall(VecGhostGetLocalForm(*normals, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArray(local, &na));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * ELEMENT_MAX_FACET_NODES], n = ElementNumNodes(facets->type[f]);
    FacetCoordinates(level, facets, f, X);
    PetscCall(PetscArrayzero(N, n * dim));
    FrameAddFacetNormal(dim, n, X, N);
    for (PetscInt i = 0; i < n; i++) {
      for (PetscInt k = 0; k < dim; k++) na[nodes[i] * dim + k] += N[i * dim + k];
    }
  }
  PetscCall(VecRestoreArray(local, &na));
  PetscCall(VecGhostRestoreLocalForm(*normals, &local));
  PetscCall(LevelShareVec(*normals, ADD_VALUES));
  PetscCall(VecGhostGetLocalForm(*normals, &local));
  PetscCall(VecGetArray(local, &na));
  for (PetscInt i = 0; i < level->num_nodes; i++) {
    PetscReal sum = 0;
    for (PetscInt k = 0; k < dim; k++) sum += PetscAbsScalar(na[i * dim + k]);
    if (sum > 0) FrameNormalize(dim, &na[i * dim]);
  }
  PetscCall(VecRestoreArray(local, &na));
  PetscCall(VecGhostRestoreLocalForm(*normals, &local));
  PetscFunctionReturn(PETSC_SUCCESS);
}
