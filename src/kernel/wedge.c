/* wedge.c -- an elastic wedge on an elastic half plane, without friction [1].

   Stresses behave as r^(s-1) with the smallest root s in (0, 1) of

     sin(pi s) (sin(2 s a) + s sin(2 a)) + 2 k cos(pi s) (sin(s a)^2 - s^2 sin(a)^2) = 0,

   with the angle a of the wedge and the ratio k of its contact modulus to that of the half plane. A rigid
   wedge has s = 1/2. On a rigid half plane s is that of a notch with twice the angle, whose faces are free
   [2]: 0.6157 at 120 degrees. A wedge of 90 degrees has 1 - s = 4 k / pi^2 for small k.

   References: [1] J. Dundurs, M.-S. Lee, Stress concentration at a sharp edge in contact problems, J.
   Elasticity 2 (1972).
               [2] M. L. Williams, Stress singularities resulting from various boundary conditions in angular
               corners of plates in
               extension, J. Appl. Mech. 19 (1952). */
#include "kernel/wedge.h"

/* The interval in which a root is searched, in steps with at most one root. Between END and 1 the exponent is
   zero within roundoff. */
static const PetscReal BEGIN = 0.4, END = 1 - 1e-6;
enum { STEPS = 64, HALVINGS = 50 };

static PetscReal WedgeEquation_Private(PetscReal a, PetscReal k, PetscReal s)
{
  const PetscReal wedge = PetscSinReal(2 * s * a) + s * PetscSinReal(2 * a);
  const PetscReal plane = PetscSqr(PetscSinReal(s * a)) - PetscSqr(s * PetscSinReal(a));

  return (PetscSinReal(PETSC_PI * s) * wedge + 2 * k * PetscCosReal(PETSC_PI * s) * plane) / (1 + k);
}

PetscReal WedgeExponent(PetscReal angle, PetscReal ratio)
{
  PetscReal low = BEGIN, high = BEGIN;

  for (PetscInt i = 1; i <= STEPS; i++) {
    low  = high;
    high = BEGIN + (END - BEGIN) * (PetscReal)i / STEPS;
    if (WedgeEquation_Private(angle, ratio, low) * WedgeEquation_Private(angle, ratio, high) > 0) continue;
    for (PetscInt j = 0; j < HALVINGS; j++) {
      const PetscReal middle = 0.5 * (low + high);

      if (WedgeEquation_Private(angle, ratio, low) * WedgeEquation_Private(angle, ratio, middle) > 0)
        low = middle;
      else
        high = middle;
    }
    return 1 - high;
  }
  return 0;
}
