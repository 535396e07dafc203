/* deformedlevel.c -- the level in the deformed configuration.

   Displacements are linear on facets of first order. So the curves over them (eq. 4.5) keep their rises and
   curvatures; computed anew, both would be those of the polygon. */
#include "base/compat.h"
#include "contact/contactfacet.h"
#include "contact/deformedlevel.h"
#include "contact/nodalnormals.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "level/ghosted.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* Rotates unit normals of a facet as the facet itself rotates.
   [in] before, after - nodes [n][dim]; [in,out] normals - [n][dim] */
static void DeformedLevelTurnNormals_Private(PetscInt dim, PetscInt n, const PetscReal before[],
                                             const PetscReal after[], PetscReal normals[])
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

/* Moves facets by a displacement: positions, normals, tree. Collective. [in] u - dim per node */
static PetscErrorCode DeformedLevelMove_Private(const Level *level, Vec u, MortarSurface *surface)
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
    DeformedLevelTurnNormals_Private(dim, n, before, X, &surface->normals[f * F * dim]);
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
    DeformedLevelTurnNormals_Private(dim, ElementNumNodes(assembly->nonmortar.type[f]), X[0], X[1],
                                     &assembly->shape.normal[f * F * dim]);
  }
  PetscCall(NodalNormalsCreate(moved, &assembly->nonmortar, &assembly->shape, &assembly->own[1]));
  if (surface) PetscCall(DeformedLevelMove_Private(level, assembly->displacement, surface));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode DeformedLevelDestroy(Level *moved)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(moved->coords));
  PetscFunctionReturn(PETSC_SUCCESS);
}
