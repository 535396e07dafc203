/* arcnormals.c -- normals of smooth sides that a bisected level has at its nodes. */
#include "side/arcnormals.h"
#include "base/compat.h"
#include "kernel/vector.h"
#include "level/facets.h"
#include "level/ghosted.h"
#include "side/sidepatch.h"

enum { F = ELEMENT_MAX_FACET_NODES };

PetscBool ArcNormalsDiffer(PetscInt dim, const PetscReal a[], const PetscReal b[])
{
  PetscReal most = 0;

  for (PetscInt k = 0; k < dim; k++) most = PetscMax(most, PetscAbsReal(a[k] - b[k]));
  return (PetscBool)(most > FLAT_SIDE);
}

/* The one of a node's normals that is that of a facet's patch. Returns whether there is one.
   [in] all - of the node; unit - normal of the facet; [out] normal - [dim] */
static PetscBool ArcNormalsChoose_Private(PetscInt dim, const PetscScalar all[], const PetscReal unit[],
                                          PetscReal normal[])
{
  PetscReal most = SMOOTH_SIDE;

  for (PetscInt j = 0; j < LEVEL_ARC_NORMALS; j++) {
    PetscReal own[3], product;

    for (PetscInt k = 0; k < dim; k++) own[k] = PetscRealPart(all[j * dim + k]);
    product = VectorDot(dim, own, unit);
    if (product <= most) continue;
    most = product;
    for (PetscInt k = 0; k < dim; k++) normal[k] = own[k];
  }
  return (PetscBool)(most > SMOOTH_SIDE);
}

PetscErrorCode ArcNormalsTake(const Level *level, const Facets *facets, SideShape *shape)
{
  const PetscInt     dim = level->dim;
  const PetscScalar *a;

  PetscFunctionBeginUser;
  if (!level->arcs) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(GhostedGetArrayRead(level->arcs, &a));
  for (PetscInt f = 0; f < facets->num; f++) {
    PetscReal unit[3];

    (void)FacetGetMeasure(level, facets, f, unit);
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      const PetscInt node   = facets->nodes[f * F + i];
      PetscReal     *normal = &shape->normal[(f * F + i) * dim], known[3];

      if (ArcNormalsChoose_Private(dim, &a[node * LEVEL_ARC_NORMALS * dim], unit, known) &&
          ArcNormalsDiffer(dim, known, normal))
        PetscCall(PetscArraycpy(normal, known, dim));
    }
  }
  PetscCall(GhostedRestoreArrayRead(level->arcs, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}
