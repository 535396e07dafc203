/* vector.h -- short vectors, inline: a call of BLAS would cost more than the sum of two or three products. */
#ifndef MORTISE_VECTOR_H
#define MORTISE_VECTOR_H

#include <petscsys.h>

/* [in] a, b - [n] */
static inline PetscReal VectorDot(PetscInt n, const PetscReal a[], const PetscReal b[])
{
  PetscReal sum = 0;

  for (PetscInt i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

static inline PetscReal VectorNorm(PetscInt n, const PetscReal a[])
{
  return PetscSqrtReal(VectorDot(n, a, a));
}

static inline PetscReal VectorDistance(PetscInt n, const PetscReal a[], const PetscReal b[])
{
  PetscReal sum = 0;

  for (PetscInt i = 0; i < n; i++) sum += PetscSqr(a[i] - b[i]);
  return PetscSqrtReal(sum);
}

/* a x b of plane vectors: positive if b points to the left of a. */
static inline PetscReal VectorCrossPlane(const PetscReal a[], const PetscReal b[])
{
  return a[0] * b[1] - a[1] * b[0];
}

/* [in] a, b - [3]; [out] c - a x b [3] */
static inline void VectorCross(const PetscReal a[], const PetscReal b[], PetscReal c[])
{
  for (PetscInt k = 0; k < 3; k++) {
    const PetscInt l = (k + 1) % 3, m = (k + 2) % 3;

    c[k] = a[l] * b[m] - a[m] * b[l];
  }
}

/* The determinant a.(b x c). */
static inline PetscReal VectorTriple(const PetscReal a[], const PetscReal b[], const PetscReal c[])
{
  PetscReal cross[3];

  VectorCross(b, c, cross);
  return VectorDot(3, a, cross);
}

/* Rows of a table. [in] rows - [num]; [in] table - [..][n]; [out] values - [num][n] */
static inline void VectorGather(PetscInt n, PetscInt num, const PetscInt rows[], const PetscReal table[],
                                PetscReal values[])
{
  for (PetscInt i = 0; i < num; i++)
    for (PetscInt k = 0; k < n; k++) values[i * n + k] = table[rows[i] * n + k];
}

#endif
