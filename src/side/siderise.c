/* siderise.c -- how far a side is above one of its facets (eqs. 4.5, 4.5a). */
#include "base/compat.h"
#include "kernel/arc.h"
#include "kernel/rise.h"
#include "kernel/vector.h"
#include "side/sideshape.h"

enum { F = ELEMENT_MAX_FACET_NODES };

PetscErrorCode SideShapeMove(PetscInt dim, PetscInt from, PetscInt to, SideShape *shape)
{
  const PetscInt vector = F * dim, matrix = F * dim * dim;

  PetscFunctionBeginUser;
  PetscCall(PetscArraymove(&shape->normal[to * vector], &shape->normal[from * vector], vector));
  PetscCall(PetscArraymove(&shape->curvature[to * matrix], &shape->curvature[from * matrix], matrix));
  PetscCall(PetscArraymove(&shape->known[to * F], &shape->known[from * F], F));
  PetscCall(PetscArraymove(&shape->smooth[to * F], &shape->smooth[from * F], F));
  PetscCall(PetscArraymove(&shape->ridge[to * F], &shape->ridge[from * F], F));
  if (shape->quadric) shape->quadric[to] = shape->quadric[from];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool SideShapeIsKnown(const SideShape *shape, PetscInt f, ElementType type)
{
  for (PetscInt i = 0; i < ElementNumNodes(type); i++)
    if (!shape->known[f * F + i]) return PETSC_FALSE;
  return PETSC_TRUE;
}

void SideShapeGetRise(const SideShape *shape, PetscInt f, ElementType type, const PetscReal X[], PetscReal rise[])
{
  const PetscInt dim    = ElementDim(type) + 1;
  RiseFacet      facet  = {.X = X, .normal = &shape->normal[f * F * dim]};
  PetscBool      smooth = PETSC_TRUE;

  for (PetscInt k = 0; k < RISE_TERMS * dim; k++) rise[k] = 0;
  if (ElementOrder(type) == 1 && !ArcBulge(type, X, facet.normal, &shape->smooth[f * F], rise)) return;
  if (!SideShapeIsKnown(shape, f, type)) return;
  for (PetscInt i = 0; i < ElementNumNodes(type); i++) smooth = (PetscBool)(smooth && shape->smooth[f * F + i]);
  if (smooth) facet.curvature = &shape->curvature[f * F * dim * dim];
  if (shape->quadric && VectorNorm(3, &shape->quadric[f].c[QUADRIC_LINEAR]) > 0) facet.quadric = &shape->quadric[f];
  RiseComplete(type, &facet, rise);
}
