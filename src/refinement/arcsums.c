/* arcsums.c -- the offset of the middle of an edge, from those to the curves of the facets around. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "refinement/arcsums.h"

/* Places of values in the sums: products o_k o_l, o |o|^2, normals of flat sides. */
enum { SUM_PRODUCTS = 0, SUM_RIGHT = 9, SUM_PLANE = 12 };

/* Offsets belong to one patch if the smaller eigenvalue of their products is below this part of the larger
   one: their directions then differ by less than 0.006. Patches meet at 0.05 at least. */
static const PetscReal ONE_PATCH = 1e-5;
/* Square of the sine between a curved side and a flat one, at least: an edge of both is a feature edge. */
static const PetscReal LEAST_WITHIN = 0.25;

void ArcSumsAddOffset(PetscInt dim, const PetscReal offset[], PetscScalar sums[])
{
  const PetscReal square = VectorDot(dim, offset, offset);

  for (PetscInt k = 0; k < dim; k++) {
    for (PetscInt l = 0; l < dim; l++) sums[SUM_PRODUCTS + k * dim + l] += offset[k] * offset[l];
    sums[SUM_RIGHT + k] += offset[k] * square;
  }
}

void ArcSumsAddPlane(PetscInt dim, const PetscReal normal[], PetscScalar sums[])
{
  for (PetscInt k = 0; k < dim; k++) sums[SUM_PLANE + k] += normal[k];
}

/* The least x with o.x = |o|^2 for all offsets o. Returns whether there are such. */
static PetscBool ArcSumsSolve_Private(PetscInt dim, const PetscScalar sums[], PetscReal x[])
{
  PetscReal A[9], values[3], V[9], largest = 0;

  for (PetscInt k = 0; k < dim * dim; k++) A[k] = PetscRealPart(sums[SUM_PRODUCTS + k]);
  for (PetscInt k = 0; k < dim; k++) x[k] = 0;
  DenseEigen(dim, A, values, V);
  for (PetscInt i = 0; i < dim; i++) largest = PetscMax(largest, values[i]);
  for (PetscInt i = 0; i < dim; i++) {
    PetscReal part = 0;

    if (!(values[i] > ONE_PATCH * largest)) continue;
    for (PetscInt k = 0; k < dim; k++) part += V[k * dim + i] * PetscRealPart(sums[SUM_RIGHT + k]);
    for (PetscInt k = 0; k < dim; k++) x[k] += part / values[i] * V[k * dim + i];
  }
  return (PetscBool)(largest > 0);
}

PetscBool ArcSumsToOffset(PetscInt dim, const PetscScalar sums[], PetscReal offset[])
{
  PetscReal normal[3], along, square, within;

  if (!ArcSumsSolve_Private(dim, sums, offset)) return PETSC_FALSE;
  for (PetscInt k = 0; k < dim; k++) normal[k] = PetscRealPart(sums[SUM_PLANE + k]);
  FrameNormalize(dim, normal);
  square = VectorDot(dim, offset, offset);
  along  = VectorDot(dim, offset, normal);
  // within the flat side, the way to the curve is longer than along the curve's normal
  within = PetscMax(square - along * along, LEAST_WITHIN * square);
  for (PetscInt k = 0; k < dim; k++) offset[k] = square / within * (offset[k] - along * normal[k]);
  return PETSC_TRUE;
}
