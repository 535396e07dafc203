/* quadric.c -- points of a quadric near a curve. */
#include "kernel/quadric.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "kernel/vector.h"

/* An arc is on the quadric up to this share of its rise; it is not its curve if it is farther than half of
   it. */
static const PetscReal ON_ARC = 1e-4, OFF_ARC = 0.5;

enum { STEPS = 6 }; /* towards the nearest point of the quadric, from close to it */

void QuadricMonomials(const PetscReal x[3], PetscReal m[])
{
  PetscInt n = QUADRIC_SQUARE;

  m[0] = 1;
  for (PetscInt i = 0; i < 3; i++) {
    m[QUADRIC_LINEAR + i] = x[i];
    for (PetscInt j = i; j < 3; j++) m[n++] = x[i] * x[j];
  }
}

PetscReal QuadricValue(const PetscReal c[], const PetscReal x[3], PetscReal gradient[3])
{
  PetscReal m[QUADRIC_MONOMIALS], value = 0;
  PetscInt  n = QUADRIC_SQUARE;

  QuadricMonomials(x, m);
  for (PetscInt k = 0; k < QUADRIC_MONOMIALS; k++) value += c[k] * m[k];
  for (PetscInt i = 0; i < 3; i++) gradient[i] = c[QUADRIC_LINEAR + i];
  for (PetscInt i = 0; i < 3; i++) {
    for (PetscInt j = i; j < 3; j++, n++) {
      gradient[i] += c[n] * x[j];
      gradient[j] += c[n] * x[i];
    }
  }
  return value;
}

PetscBool QuadricTakeArc(const Quadric *quadric, const PetscReal x0[3], const PetscReal x1[3], PetscReal offset[3],
                         PetscReal normal[3])
{
  const PetscReal rise = VectorNorm(3, offset);
  PetscReal       x[3], middle[3], way[3], gradient[3];

  if (!quadric || !(rise > 0) || VectorNorm(3, &quadric->c[QUADRIC_LINEAR]) == 0) return PETSC_FALSE;
  for (PetscInt k = 0; k < 3; k++) {
    middle[k] = (x0[k] + x1[k]) / 2 - quadric->origin[k];
    x[k]      = middle[k] + offset[k];
  }
  for (PetscInt step = 0; step < STEPS; step++) {
    const PetscReal value = QuadricValue(quadric->c, x, gradient), square = VectorDot(3, gradient, gradient);
    PetscReal       along = -value;

    if (!(square > 0)) return PETSC_FALSE;
    for (PetscInt k = 0; k < 3; k++) along += (x[k] - middle[k]) * gradient[k];
    for (PetscInt k = 0; k < 3; k++) x[k] = middle[k] + along / square * gradient[k];
  }
  for (PetscInt k = 0; k < 3; k++) way[k] = x[k] - middle[k] - offset[k];
  if (!(VectorNorm(3, way) > ON_ARC * rise && VectorNorm(3, way) < OFF_ARC * rise)) return PETSC_FALSE;
  for (PetscInt k = 0; k < 3; k++) offset[k] += way[k];
  for (PetscInt k = 0; k < 3 && normal; k++) normal[k] = gradient[k];
  if (normal) (void)FrameNormalize(3, normal);
  return PETSC_TRUE;
}
