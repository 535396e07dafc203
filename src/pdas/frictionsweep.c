/* frictionsweep.c -- nonlinear Gauss-Seidel, where Newton's method does not descend.

   A unit in turn takes the step that minimizes along its own diagonal,  y_n := min(y_n + r_n / k, upper)  and then, with the limit G of the
   force that is there now,  s := (1 - G / |z|)_+ z / k,  z = k s + r_t.  With given limits the energy falls in every step (Glowinski 1984);
   with limits that follow the pressure the sweeps are those of nonsmooth contact dynamics (Jean 1999). */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* y_i += step, and all forces with it. */
static PetscErrorCode FrictionSweepMove_Private(FrictionProblem *problem, PetscInt i, PetscReal step)
{
  const PetscScalar minus = -step;
  PetscBLASInt      N, one = 1;

  PetscFunctionBeginUser;
  if (step == 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscBLASIntCast(problem->units->n, &N));
  problem->units->y[i] += step;
  PetscCallBLAS("BLASaxpy", BLASaxpy_(&N, &minus, &problem->S[problem->units->n * i], &one, problem->units->r, &one));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest eigenvalue of the unit's tangential block. */
static PetscReal FrictionSweepStiffness_Private(const FrictionProblem *problem, const FrictionUnit *unit)
{
  const PetscInt  N = problem->units->n, i = unit->tangent[0], j = unit->tangent[unit->num - 1];
  const PetscReal a = problem->S[N * i + i], b = problem->S[N * j + j], c = problem->S[N * i + j];

  if (unit->num == 1) return a;
  return (a + b) / 2 + PetscSqrtReal(PetscSqr((a - b) / 2) + c * c);
}

/* One unit. */
static PetscErrorCode FrictionSweepUnit_Private(FrictionProblem *problem, const FrictionUnit *unit)
{
  const PetscInt  n = unit->normal;
  const PetscReal k = problem->S[problem->units->n * n + n];
  PetscReal       z[FRICTION_TANGENTS], size = 0, limit, kept, stiffness;

  PetscFunctionBeginUser;
  PetscCall(FrictionSweepMove_Private(
      problem, n, PetscMin(problem->units->y[n] + problem->units->r[n] / k, unit->upper) - problem->units->y[n]));
  if (!unit->num) PetscFunctionReturn(PETSC_SUCCESS);
  stiffness = FrictionSweepStiffness_Private(problem, unit);
  limit     = FrictionUnitLimit(unit, problem->units->r[n]);
  for (PetscInt i = 0; i < unit->num; i++) {
    z[i] = stiffness * (problem->units->y[unit->tangent[i]] - unit->origin[i]) + problem->units->r[unit->tangent[i]];
    size += z[i] * z[i];
  }
  size = PetscSqrtReal(size);
  kept = size > limit ? (1 - limit / size) / stiffness : 0;
  for (PetscInt i = 0; i < unit->num; i++)
    PetscCall(FrictionSweepMove_Private(problem, unit->tangent[i],
                                        unit->origin[i] + kept * z[i] - problem->units->y[unit->tangent[i]]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionSweep(FrictionProblem *problem, PetscInt sweeps)
{
  PetscFunctionBeginUser;
  for (PetscInt s = 0; s < sweeps; s++)
    for (PetscInt a = 0; a < problem->units->num; a++)
      PetscCall(FrictionSweepUnit_Private(problem, &problem->units->unit[a]));
  PetscCall(FrictionProblemSetForces(problem)); // without the roundoff of all those steps
  PetscFunctionReturn(PETSC_SUCCESS);
}
