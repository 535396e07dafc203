/* uniform.h -- repeatable random numbers for unit tests: the same on every machine, so that a failure can be looked at. */
#ifndef MORTISE_UNIFORM_H
#define MORTISE_UNIFORM_H

#include <petscsys.h>
#include <stdint.h>

/* The next number of Marsaglia's xorshift generator, in [a,b). */
static inline PetscReal Uniform(PetscReal a, PetscReal b)
{
  static uint64_t state = 88172645463325252u;

  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return a + (b - a) * (PetscReal)(state >> 11) * 0x1p-53;
}

#endif
