/* roots.c -- real roots of a polynomial between 0 and 1, from those of its derivative.

   Between neighbouring roots of its derivative a polynomial is monotone: it has one root there or none, by
   its signs at the ends. No division by a leading coefficient: where the higher ones are roundoff the result
   is that of the lower degree. */
#include "kernel/roots.h"

/* Bisection alone needs as many steps as a number has binary digits. */
enum { MAX_STEPS = 100 };

static PetscReal RootsValue_Private(PetscInt degree, const PetscReal c[], PetscReal t)
{
  PetscReal value = c[degree];

  for (PetscInt k = degree - 1; k >= 0; k--) value = value * t + c[k];
  return value;
}

/* The root between two places where the signs differ: Newton's method, or halving where that would leave the
   bracket.
   [in] d - coefficients of the derivative [degree] */
static PetscReal RootsBracketed_Private(PetscInt degree, const PetscReal c[], const PetscReal d[], PetscReal low,
                                        PetscReal high)
{
  const PetscBool negative = RootsValue_Private(degree, c, low) < 0. ? PETSC_TRUE : PETSC_FALSE;
  PetscReal       t        = 0.5 * (low + high);

  for (PetscInt step = 0; step < MAX_STEPS; step++) {
    const PetscReal value = RootsValue_Private(degree, c, t), before = t;

    if ((value < 0.) == negative)
      low = t;
    else
      high = t;
    t -= value / RootsValue_Private(degree - 1, d, t);
    if (!(t > low && t < high)) t = 0.5 * (low + high);
    if (PetscAbsReal(t - before) <= PETSC_MACHINE_EPSILON * t) break;
  }
  return t;
}

PetscInt RootsInside(PetscInt degree, const PetscReal c[], PetscReal roots[])
{
  PetscReal d[ROOTS_MAX_DEGREE], ends[ROOTS_MAX_DEGREE + 1];
  PetscInt  num_ends, num = 0;

  if (degree < 1) return 0;
  for (PetscInt k = 0; k < degree; k++) d[k] = (k + 1) * c[k + 1];
  ends[0]        = 0.;
  num_ends       = 1 + RootsInside(degree - 1, d, &ends[1]);
  ends[num_ends] = 1.;
  for (PetscInt i = 0; i < num_ends; i++) {
    const PetscReal low = RootsValue_Private(degree, c, ends[i]), high = RootsValue_Private(degree, c, ends[i + 1]);
    PetscReal       t;

    if ((low < 0.) == (high < 0.)) continue;
    t = RootsBracketed_Private(degree, c, d, ends[i], ends[i + 1]);
    if (t > 0. && t < 1.) roots[num++] = t;
  }
  return num;
}
