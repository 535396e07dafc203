/* frictionanderson.c -- Anderson's acceleration of the fixed point iteration over Tresca's problems [1].

   x is the vector of limits, g(x) that of limits from the pressures with them, and f = g(x) - x. The next x
   is g of that combination of the last iterates, with weights of sum 1, whose combination of f is least.
   Where the iteration alone converges slowly, or alternates, few iterates suffice.

   References: [1] Walker, Ni, Anderson acceleration for fixed-point iterations, 2011. */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* Eigenvalues of the normal equations below this part of the largest are omitted. */
static const PetscReal DEPENDENT = 1e-12;

PetscErrorCode FrictionAndersonCreate(PetscInt num, FrictionAnderson *anderson)
{
  PetscFunctionBeginUser;
  *anderson = (FrictionAnderson){.num = num};
  PetscCall(PetscCalloc1(2 * (ANDERSON_DEPTH + 1) * num, &anderson->values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionAndersonDestroy(FrictionAnderson *anderson)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(anderson->values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* g, or f, of the iterate that is `age` older than the last one. */
static PetscReal *FrictionAndersonGet_Private(const FrictionAnderson *anderson, PetscInt age, PetscBool f)
{
  const PetscInt slot = (anderson->count - 1 - age) % (ANDERSON_DEPTH + 1);

  return &anderson->values[(2 * slot + (f ? 1 : 0)) * anderson->num];
}

/* Least squares of f - sum c_j (f - f_j), by normal equations and their eigenvectors. [out] c - [depth] */
static PetscErrorCode FrictionAndersonWeigh_Private(MPI_Comm comm, const FrictionAnderson *anderson, PetscInt depth,
                                                    PetscReal c[])
{
  const PetscReal *last = FrictionAndersonGet_Private(anderson, 0, PETSC_TRUE);
  PetscScalar      A[ANDERSON_DEPTH * ANDERSON_DEPTH + ANDERSON_DEPTH] = {0}, eigenvalue[ANDERSON_DEPTH],
                                                  work[8 * ANDERSON_DEPTH], *b = &A[depth * depth];
  PetscBLASInt n = (PetscBLASInt)depth, length = 8 * ANDERSON_DEPTH, info;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < depth; i++) {
    const PetscReal *fi = FrictionAndersonGet_Private(anderson, i + 1, PETSC_TRUE);

    for (PetscInt a = 0; a < anderson->num; a++) b[i] += (last[a] - fi[a]) * last[a];
    for (PetscInt j = 0; j < depth; j++) {
      const PetscReal *fj = FrictionAndersonGet_Private(anderson, j + 1, PETSC_TRUE);

      for (PetscInt a = 0; a < anderson->num; a++) A[depth * i + j] += (last[a] - fi[a]) * (last[a] - fj[a]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, A, (PetscMPIInt)(depth * depth + depth), MPIU_SCALAR, MPI_SUM, comm));
  for (PetscInt i = 0; i < depth; i++) c[i] = 0;
  PetscCallBLAS("LAPACKsyev", LAPACKsyev_("V", "U", &n, A, &n, eigenvalue, work, &length, &info));
  for (PetscInt k = 0; k < depth && !info; k++) {
    PetscReal part = 0;

    if (!(eigenvalue[k] > DEPENDENT * eigenvalue[depth - 1])) continue;
    for (PetscInt i = 0; i < depth; i++) part += A[depth * k + i] * b[i] / eigenvalue[k];
    for (PetscInt i = 0; i < depth; i++) c[i] += part * A[depth * k + i];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionAndersonApply(MPI_Comm comm, FrictionAnderson *anderson, const PetscReal x[], PetscReal g[])
{
  PetscInt   depth;
  PetscReal *g0, *f0, c[ANDERSON_DEPTH];

  PetscFunctionBeginUser;
  depth = PetscMin(anderson->count, ANDERSON_DEPTH);
  anderson->count++;
  g0 = FrictionAndersonGet_Private(anderson, 0, PETSC_FALSE);
  f0 = FrictionAndersonGet_Private(anderson, 0, PETSC_TRUE);
  for (PetscInt a = 0; a < anderson->num; a++) {
    g0[a] = g[a];
    f0[a] = g[a] - x[a];
  }
  if (!depth) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FrictionAndersonWeigh_Private(comm, anderson, depth, c));
  for (PetscInt j = 0; j < depth; j++) {
    const PetscReal *gj = FrictionAndersonGet_Private(anderson, j + 1, PETSC_FALSE);

    for (PetscInt a = 0; a < anderson->num; a++) g[a] -= c[j] * (g0[a] - gj[a]);
  }
  for (PetscInt a = 0; a < anderson->num; a++) g[a] = PetscMax(g[a], 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}
