/* frictionsystem.c -- the semismooth Newton method for contact with friction [1, 2].

   A unit is open (r_n = 0) or closed (y_n = upper). Its tangents stick (s = 0) or slip along d = q^ / |q^|,
   q^ = r_t + k s. With w = G / |q^| < 1 the derivative of |q^| r_t = G q^ at the last iterate is

       r_t = G d + k w / (1 - w) (I - d d') s,     G = bound + coefficient r_n:

   along d the limit of the new pressure, across it a resistance to turning, which a plane does not have. As S
   y = g - r this is one linear system. k is the diagonal of A: there is no number to choose.

   References: [1] Hueeber, Stadler, Wohlmuth, A primal-dual active set algorithm for three-dimensional
   contact problems with Coulomb friction, 2008. [2] Gitterle, Popp, Gee, Wall, Finite deformation frictional
   mortar contact using a semi-smooth Newton method, 2010. */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* Shift of a singular system, as a part of the resistance. */
static const PetscReal SINGULAR_SHIFT = 1e-10;

/* Sets fixed unknowns in y, and lists free ones. */
static void FrictionSystemPrescribe_Private(FrictionProblem *problem)
{
  for (PetscInt i = 0; i < problem->units->n; i++) problem->place[i] = 0;
  for (PetscInt a = 0; a < problem->units->num; a++) {
    const FrictionUnit *unit = &problem->units->unit[a];

    if (unit->closed) problem->place[unit->normal] = -1;
    for (PetscInt i = 0; i < unit->num; i++)
      if (unit->status == UNIT_STICK) problem->place[unit->tangent[i]] = -1;
  }
  problem->num_free = 0;
  for (PetscInt i = 0; i < problem->units->n; i++)
    if (problem->place[i] == 0) problem->place[i] = problem->num_free++;
}

/* Rows of slipping tangents: minus coefficient d_i times the normal row, plus the resistance to turning. [in]
   row - of the reduced problem, a column of the symmetric S; [in,out] M - the system, column by column */
static void FrictionSystemAddSlip_Private(FrictionProblem *problem, const FrictionUnit *unit, PetscBool coupled)
{
  const PetscInt     N = problem->units->n, n = problem->num_free;
  const PetscScalar *normal = &problem->S[N * unit->normal];
  const PetscReal    mu     = coupled && unit->closed ? unit->coefficient : 0;

  for (PetscInt i = 0; i < unit->num; i++) {
    const PetscInt row = problem->place[unit->tangent[i]];

    for (PetscInt j = 0; mu > 0 && j < N; j++)
      if (problem->place[j] >= 0) problem->M[n * problem->place[j] + row] -= mu * unit->direction[i] * normal[j];
    for (PetscInt k = 0; k < unit->num; k++)
      problem->M[n * problem->place[unit->tangent[k]] + row] +=
          unit->turning * ((i == k ? 1 : 0) - unit->direction[i] * unit->direction[k]);
  }
}

/* The system of the decisions. [in] shift - part of the resistance, added for slipping units */
static void FrictionSystemAssemble_Private(FrictionProblem *problem, PetscBool coupled, PetscReal shift)
{
  const PetscInt N = problem->units->n, n = problem->num_free;

  for (PetscInt j = 0; j < N; j++) {
    if (problem->place[j] < 0) continue;
    for (PetscInt i = 0; i < N; i++)
      if (problem->place[i] >= 0) problem->M[n * problem->place[j] + problem->place[i]] = problem->S[N * j + i];
  }
  for (PetscInt a = 0; a < problem->units->num; a++) {
    const FrictionUnit *unit = &problem->units->unit[a];

    if (unit->status != UNIT_SLIP) continue;
    FrictionSystemAddSlip_Private(problem, unit, coupled);
    for (PetscInt i = 0; i < unit->num; i++)
      problem->M[(n + 1) * problem->place[unit->tangent[i]]] += shift * unit->resistance;
  }
}

/* Factors the linear system of the decisions. [in] coupled - whether limits follow the pressure (Newton's
   method) or are given (Tresca) */
static PetscErrorCode FrictionSystemFactor_Private(FrictionProblem *problem, PetscBool coupled)
{
  PetscBLASInt size, info = 1;

  PetscFunctionBeginUser;
  FrictionSystemPrescribe_Private(problem);
  if (!problem->num_free) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscBLASIntCast(problem->num_free, &size));
  for (PetscInt k = 0; k < 2 && info; k++) { // singular if all units that hold a body slip: then shifted
    FrictionSystemAssemble_Private(problem, coupled, k ? SINGULAR_SHIFT : 0);
    PetscCallBLAS("LAPACKgetrf", LAPACKgetrf_(&size, &size, problem->M, &size, problem->pivot, &info));
  }
  PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_MAT_LU_ZRPVT, "The system of a Newton step is singular");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* x = M^-1 x, x of the free unknowns. */
static PetscErrorCode FrictionSystemSubstitute_Private(FrictionProblem *problem)
{
  PetscBLASInt size, one = 1, info;

  PetscFunctionBeginUser;
  if (!problem->num_free) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscBLASIntCast(problem->num_free, &size));
  PetscCallBLAS("LAPACKgetrs",
                LAPACKgetrs_("N", &size, &one, problem->M, &size, problem->pivot, problem->x, &size, &info));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionSystemSolve(FrictionProblem *problem)
{
  PetscReal *y = problem->units->y;

  PetscFunctionBeginUser;
  PetscCall(FrictionSystemFactor_Private(problem, PETSC_TRUE));
  FrictionUnitsPrescribe(problem->units);
  /* a Newton step from y: M dy = r - (r required by the law), with the forces r of y after prescription */
  PetscCall(FrictionProblemSetForces(problem));
  for (PetscInt i = 0; i < problem->units->n; i++)
    if (problem->place[i] >= 0) problem->x[problem->place[i]] = problem->units->r[i];
  for (PetscInt a = 0; a < problem->units->num; a++) {
    const FrictionUnit *unit  = &problem->units->unit[a];
    PetscReal           along = 0, limit;

    if (unit->status != UNIT_SLIP) continue;
    limit = unit->bound + (unit->closed ? unit->coefficient * problem->units->r[unit->normal] : 0);
    for (PetscInt i = 0; i < unit->num; i++) along += unit->direction[i] * (y[unit->tangent[i]] - unit->origin[i]);
    for (PetscInt i = 0; i < unit->num; i++) {
      const PetscReal across = y[unit->tangent[i]] - unit->origin[i] - along * unit->direction[i];

      problem->x[problem->place[unit->tangent[i]]] -= limit * unit->direction[i] + unit->turning * across;
    }
  }
  PetscCall(FrictionSystemSubstitute_Private(problem));
  for (PetscInt i = 0; i < problem->units->n; i++)
    if (problem->place[i] >= 0) y[i] += problem->x[problem->place[i]];
  PetscCall(FrictionProblemSetForces(problem));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionSystemFactorGiven(FrictionProblem *problem)
{
  return FrictionSystemFactor_Private(problem, PETSC_FALSE);
}

PetscErrorCode FrictionSystemGrow(FrictionProblem *problem, const PetscReal v[], PetscReal w[])
{
  const PetscInt N = problem->units->n;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(problem->x, problem->num_free));
  for (PetscInt a = 0; a < problem->units->num; a++) {
    const FrictionUnit *unit = &problem->units->unit[a];

    for (PetscInt i = 0; unit->status == UNIT_SLIP && i < unit->num; i++)
      problem->x[problem->place[unit->tangent[i]]] = -unit->direction[i] * v[a];
  }
  PetscCall(FrictionSystemSubstitute_Private(problem));
  for (PetscInt a = 0; a < problem->units->num; a++) {
    const FrictionUnit *unit = &problem->units->unit[a];

    w[a] = 0;
    for (PetscInt j = 0; unit->status == UNIT_SLIP && unit->closed && j < N; j++)
      if (problem->place[j] >= 0)
        w[a] -= unit->coefficient * problem->S[N * unit->normal + j] * problem->x[problem->place[j]];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
