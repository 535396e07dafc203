/* hiddencontact.c -- a rigid obstacle that enters a facet between its points.

   An obstacle may be narrower than the distance of quadrature points. Then no point detects it, and the
   estimated error of a solution without contact is zero. The least gap is searched for by values alone,
   because the gap may be any formula. */
#include "result/hiddencontact.h"
#include "base/compat.h"
#include "contact/obstacle.h"
#include "kernel/rise.h"
#include "kernel/frame.h"
#include "kernel/vector.h"

enum {
  LATTICE_LINE = 16, /* parts of a line */
  LATTICE_FACE = 6,  /* of the edges of a face */
  HALVINGS     = 20  /* of a step downhill, and of the interval that holds the end of what is penetrated */
};

/* Whether a point belongs to the reference cell. */
static PetscBool FacetHas_Private(ElementType type, const PetscReal xi[])
{
  if (ElementLinear(type) == ELEMENT_TRI3 && xi[0] + xi[1] > 1) return PETSC_FALSE;
  for (PetscInt k = 0; k < ElementDim(type); k++)
    if (xi[k] < 0 || xi[k] > 1) return PETSC_FALSE;
  return PETSC_TRUE;
}

/* d = [u].n - g; far below zero outside of the facet. [out] x - [dim], or NULL */
static PetscErrorCode FacetDepth_Private(const ObstacleFacet *facet, const PetscReal xi[], PetscReal x[],
                                         PetscReal *depth)
{
  const PetscInt dim = facet->dim;
  PetscReal      phi[ELEMENT_MAX_NODES], at[3] = {0, 0, 0}, u[3] = {0, 0, 0}, n[3] = {0, 0, 0}, gap, offset = 0;
  PetscReal      rise[3] = {0, 0, 0};

  PetscFunctionBeginUser;
  *depth = PETSC_MIN_REAL;
  if (!FacetHas_Private(facet->type, xi)) PetscFunctionReturn(PETSC_SUCCESS);
  ElementShape(facet->type, xi, phi, NULL);
  for (PetscInt i = 0; i < ElementNumNodes(facet->type) * dim; i++) {
    at[i % dim] += phi[i / dim] * facet->X[i];
    u[i % dim] += phi[i / dim] * facet->u[i];
    n[i % dim] += phi[i / dim] * facet->normal[i];
  }
  FrameNormalize(dim, n);
  if (facet->rise) RiseAt(facet->type, facet->rise, xi, rise);
  for (PetscInt k = 0; k < dim; k++) at[k] += rise[k];
  if (facet->spec->gap)
    PetscCall(ExpressionEvaluate(facet->spec->gap, dim, at, &gap));
  else
    PetscCall(ObstacleGap(&facet->spec->obstacle, dim, at, n, &gap));
  if (facet->spec->gap_offset) PetscCall(ExpressionEvaluate(facet->spec->gap_offset, dim, at, &offset));
  if (x) PetscCall(PetscArraycpy(x, at, dim));
  *depth = VectorDot(dim, u, n) - gap - offset;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The deepest point of a lattice. [out] xi; [out] step - of the lattice */
static PetscErrorCode FacetSearch_Private(const ObstacleFacet *facet, PetscReal xi[], PetscReal *step, PetscReal *depth)
{
  const PetscInt inner = facet->dim - 1, parts = inner == 1 ? LATTICE_LINE : LATTICE_FACE;

  PetscFunctionBeginUser;
  *step  = (PetscReal)1 / parts;
  *depth = PETSC_MIN_REAL;
  xi[0] = xi[1] = 0;
  for (PetscInt j = 0; j <= (inner == 1 ? 0 : parts); j++) {
    for (PetscInt i = 0; i <= parts; i++) {
      const PetscReal at[2] = {*step * i, *step * j};
      PetscReal       here;

      PetscCall(FacetDepth_Private(facet, at, NULL, &here));
      if (here <= *depth) continue;
      *depth = here;
      xi[0]  = at[0];
      xi[1]  = at[1];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Descends to a deeper point, by steps of decreasing size. [in,out] xi, depth */
static PetscErrorCode FacetDescend_Private(const ObstacleFacet *facet, PetscReal step, PetscReal xi[], PetscReal *depth)
{
  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < HALVINGS; k++) {
    const PetscReal before = *depth;

    for (PetscInt way = 0; way < 2 * (facet->dim - 1); way++) {
      PetscReal at[2] = {xi[0], xi[1]}, here;

      at[way / 2] += way % 2 ? step : -step;
      PetscCall(FacetDepth_Private(facet, at, NULL, &here));
      if (here <= *depth) continue;
      *depth = here;
      xi[0]  = at[0];
      xi[1]  = at[1];
    }
    if (*depth == before) step /= 2;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The distance from a place of penetration to its end, along an axis of the reference cell. */
static PetscErrorCode FacetReach_Private(const ObstacleFacet *facet, const PetscReal xi[], PetscInt axis,
                                         PetscReal sense, PetscReal *reach)
{
  PetscReal low = 0, high = 1;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < HALVINGS; k++) {
    const PetscReal middle = (low + high) / 2;
    PetscReal       at[2]  = {xi[0], xi[1]}, here;

    at[axis] += sense * middle;
    PetscCall(FacetDepth_Private(facet, at, NULL, &here));
    if (here > 0)
      low = middle;
    else
      high = middle;
  }
  *reach = low;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode HiddenContactFind(const ObstacleFacet *facet, PetscReal x[], PetscReal *depth, PetscReal *squared,
                                 PetscReal *width)
{
  PetscReal xi[2], step, measure, shape = 1, phi[ELEMENT_MAX_NODES], at[3];

  PetscFunctionBeginUser;
  *squared = *width = 0;
  PetscCall(FacetSearch_Private(facet, xi, &step, depth));
  PetscCall(FacetDescend_Private(facet, step, xi, depth));
  if (!(*depth > 0)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FacetDepth_Private(facet, xi, x, depth));
  measure = ElementSurface(facet->type, facet->X, xi, at, phi, NULL);
  for (PetscInt k = 0; k < facet->dim - 1; k++) {
    PetscReal left, right;

    PetscCall(FacetReach_Private(facet, xi, k, -1, &left));
    PetscCall(FacetReach_Private(facet, xi, k, 1, &right));
    measure *= left + right;
    shape *= 8. / 15; // the mean of (1 - t^2)^2
  }
  *squared = PetscSqr(*depth) * shape * measure;
  *width   = PetscPowReal(measure, 1. / (facet->dim - 1));
  PetscFunctionReturn(PETSC_SUCCESS);
}
