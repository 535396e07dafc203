/* frictionsystem.c -- the semismooth Newton method for contact with friction [1, 2].

   A unit is open (r_n = 0) or closed (y_n = upper), and its tangents stick (s = 0) or slip along d = q^ / |q^|, q^ = r_t + k s. With
   w = G / |q^| < 1 the derivative of |q^| r_t = G q^ at the last iterate is

       r_t = G d + k w / (1 - w) (I - d d') s,     G = bound + coefficient r_n:

   along d the limit of the new pressure, across it a resistance to turning, which a plane does not have. As S y = g - r this is one linear
   system. k is the diagonal of A: there is no number to choose.

   References: [1] Hueeber, Stadler, Wohlmuth, A primal-dual active set algorithm for three-dimensional contact problems with Coulomb friction,
   2008. [2] Gitterle, Popp, Gee, Wall, Finite deformation frictional mortar contact using a semi-smooth Newton method, 2010. */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* Tolerances of ties, relative to the largest value and force, as of frictionless contact. */
static const PetscReal TIE_FRICTION = 1e-11;
/* G / |q^| counts as at most this: the resistance to turning stays finite where slip begins. */
static const PetscReal SLIP_BEGINS = 1 - 1e-8;
/* Power iteration: steps before the growth is measured, and over which it is. */
enum { RHO_FIRST = 30, RHO_STEPS = 60 };

/* Whether the unit is closed: what is closed opens below -tolerance, what is open closes beyond it. */
static PetscBool FrictionSystemIsClosed_Private(const FrictionUnit *unit, PetscReal test, const PetscReal tolerance[2])
{
  if (unit->closed) return (PetscBool)(test >= -tolerance[1]);
  return (PetscBool)(test > unit->stiffness * tolerance[0]);
}

/* Stick or slip from q^. [in] limit - G^ */
static UnitStatus FrictionSystemSlides_Private(FrictionUnit *unit, const PetscReal q[], PetscReal limit,
                                               const PetscReal tolerance[2])
{
  PetscReal size = 0, along = 0;

  for (PetscInt i = 0; i < unit->num; i++) size += q[i] * q[i];
  size = PetscSqrtReal(size);
  if (limit <= tolerance[1]) return UNIT_FREE;
  if (unit->status == UNIT_SLIP ? size < limit - unit->resistance * tolerance[0] : size <= limit + tolerance[1])
    return UNIT_STICK;
  for (PetscInt i = 0; i < unit->num; i++) along += unit->direction[i] * q[i];
  if (unit->status == UNIT_SLIP && along < 0)
    return UNIT_STICK; // it turns back: all units at once may do so to and fro
  for (PetscInt i = 0; i < unit->num; i++) unit->direction[i] = q[i] / size;
  const PetscReal w = PetscMin(limit / size, SLIP_BEGINS);
  unit->turning     = unit->resistance * w / (1 - w);
  return UNIT_SLIP;
}

void FrictionSystemDecide(FrictionProblem *problem, PetscInt *changed)
{
  const PetscReal *y = problem->y, *r = problem->r;
  PetscReal        tolerance[2] = {0, 0};

  *changed = 0;
  for (PetscInt i = 0; i < problem->N; i++) {
    tolerance[0] = PetscMax(tolerance[0], TIE_FRICTION * PetscAbsReal(y[i]));
    tolerance[1] = PetscMax(tolerance[1], TIE_FRICTION * PetscAbsReal(r[i]));
  }
  for (PetscInt a = 0; a < problem->num; a++) {
    FrictionUnit    *unit   = &problem->unit[a];
    const PetscReal  test   = r[unit->normal] + unit->stiffness * (y[unit->normal] - unit->upper);
    const PetscBool  closed = FrictionSystemIsClosed_Private(unit, test, tolerance);
    const UnitStatus before = unit->status;
    PetscReal        q[FRICTION_TANGENTS];

    for (PetscInt i = 0; i < unit->num; i++)
      q[i] = r[unit->tangent[i]] + unit->resistance * (y[unit->tangent[i]] - unit->origin[i]);
    if (unit->num)
      unit->status = FrictionSystemSlides_Private(unit, q, FrictionUnitLimit(unit, closed ? test : 0), tolerance);
    *changed += closed != unit->closed || before != unit->status ? 1 : 0;
    unit->closed = closed;
  }
}

/* Fixes what is fixed in y, and lists what is free. */
static void FrictionSystemPrescribe_Private(FrictionProblem *problem)
{
  for (PetscInt i = 0; i < problem->N; i++) problem->place[i] = 0;
  for (PetscInt a = 0; a < problem->num; a++) {
    const FrictionUnit *unit = &problem->unit[a];

    if (unit->closed) problem->place[unit->normal] = -1;
    for (PetscInt i = 0; i < unit->num; i++)
      if (unit->status == UNIT_STICK) problem->place[unit->tangent[i]] = -1;
  }
  problem->num_free = 0;
  for (PetscInt i = 0; i < problem->N; i++)
    if (problem->place[i] == 0) problem->place[i] = problem->num_free++;
}

/* Rows of tangents that slip: less coefficient d_i times the normal row, plus the resistance to turning. [in] row - of the reduced problem, a
   column of the symmetric S; [in,out] M - the system, column by column */
static void FrictionSystemAddSlip_Private(FrictionProblem *problem, const FrictionUnit *unit, PetscBool coupled)
{
  const PetscInt     N = problem->N, n = problem->num_free;
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

PetscErrorCode FrictionSystemFactor(FrictionProblem *problem, PetscBool coupled, PetscBool *singular)
{
  const PetscInt N = problem->N;
  PetscInt       n;
  PetscBLASInt   size, info;

  PetscFunctionBeginUser;
  FrictionSystemPrescribe_Private(problem);
  n         = problem->num_free;
  *singular = PETSC_FALSE;
  if (!n) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt j = 0; j < N; j++) {
    if (problem->place[j] < 0) continue;
    for (PetscInt i = 0; i < N; i++)
      if (problem->place[i] >= 0) problem->M[n * problem->place[j] + problem->place[i]] = problem->S[N * j + i];
  }
  for (PetscInt a = 0; a < problem->num; a++)
    if (problem->unit[a].status == UNIT_SLIP) FrictionSystemAddSlip_Private(problem, &problem->unit[a], coupled);
  PetscCall(PetscBLASIntCast(n, &size));
  PetscCallBLAS("LAPACKgetrf", LAPACKgetrf_(&size, &size, problem->M, &size, problem->pivot, &info));
  *singular = (PetscBool)(info != 0);
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

PetscErrorCode FrictionSystemSolve(FrictionProblem *problem, PetscBool *singular)
{
  PetscReal *y = problem->y;

  PetscFunctionBeginUser;
  PetscCall(FrictionSystemFactor(problem, PETSC_TRUE, singular));
  if (*singular) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt a = 0; a < problem->num; a++) {
    const FrictionUnit *unit = &problem->unit[a];

    if (unit->closed) y[unit->normal] = unit->upper;
    for (PetscInt i = 0; i < unit->num; i++)
      if (unit->status == UNIT_STICK) y[unit->tangent[i]] = unit->origin[i];
  }
  /* a Newton step from y: M dy = r - (what the law wants of it), with the forces r of y after prescription */
  PetscCall(FrictionProblemSetForces(problem));
  for (PetscInt i = 0; i < problem->N; i++)
    if (problem->place[i] >= 0) problem->x[problem->place[i]] = problem->r[i];
  for (PetscInt a = 0; a < problem->num; a++) {
    const FrictionUnit *unit  = &problem->unit[a];
    PetscReal           along = 0, limit;

    if (unit->status != UNIT_SLIP) continue;
    limit = unit->bound + (unit->closed ? unit->coefficient * problem->r[unit->normal] : 0);
    for (PetscInt i = 0; i < unit->num; i++) along += unit->direction[i] * (y[unit->tangent[i]] - unit->origin[i]);
    for (PetscInt i = 0; i < unit->num; i++) {
      const PetscReal across = y[unit->tangent[i]] - unit->origin[i] - along * unit->direction[i];

      problem->x[problem->place[unit->tangent[i]]] -= limit * unit->direction[i] + unit->turning * across;
    }
  }
  PetscCall(FrictionSystemSubstitute_Private(problem));
  for (PetscInt i = 0; i < problem->N; i++)
    if (problem->place[i] >= 0) y[i] += problem->x[problem->place[i]];
  PetscCall(FrictionProblemSetForces(problem));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* v := coefficient d r_n / d G v at the units that slip, by the factors of given limits; scaled to 1. [in,out] v - [num]; [out] growth */
static PetscErrorCode FrictionSystemGrow_Private(FrictionProblem *problem, PetscReal v[], PetscReal *growth)
{
  const PetscInt N      = problem->N;
  PetscReal      before = 0, after = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(problem->x, problem->num_free));
  for (PetscInt a = 0; a < problem->num; a++) {
    const FrictionUnit *unit = &problem->unit[a];

    before += v[a] * v[a];
    for (PetscInt i = 0; unit->status == UNIT_SLIP && i < unit->num; i++)
      problem->x[problem->place[unit->tangent[i]]] = -unit->direction[i] * v[a];
  }
  PetscCall(FrictionSystemSubstitute_Private(problem));
  for (PetscInt a = 0; a < problem->num; a++) {
    const FrictionUnit *unit  = &problem->unit[a];
    PetscReal           force = 0;

    if (unit->status != UNIT_SLIP || !unit->closed) continue;
    for (PetscInt j = 0; j < N; j++)
      if (problem->place[j] >= 0) force -= problem->S[N * unit->normal + j] * problem->x[problem->place[j]];
    v[a] = unit->coefficient * force;
    after += v[a] * v[a];
  }
  *growth = before > 0 ? PetscSqrtReal(after / before) : 0;
  for (PetscInt a = 0; a < problem->num && after > 0; a++) v[a] /= PetscSqrtReal(after);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionSystemGetRho(FrictionProblem *problem, PetscReal *rho)
{
  PetscReal *v, sum = 0, growth = 0;
  PetscInt   slipping = 0;
  PetscBool  singular;

  PetscFunctionBeginUser;
  *rho = 0;
  PetscCall(PetscCalloc1(problem->num, &v));
  for (PetscInt a = 0; a < problem->num; a++) {
    const FrictionUnit *unit = &problem->unit[a];

    if (unit->status == UNIT_SLIP && unit->closed && unit->coefficient > 0)
      v[a] = 1 + 0.5 * PetscSinReal(a); // in no invariant subspace
    slipping += v[a] > 0 ? 1 : 0;
  }
  PetscCall(FrictionSystemFactor(problem, PETSC_FALSE, &singular));
  if (slipping && !singular) {
    for (PetscInt k = 0; k < RHO_FIRST + RHO_STEPS; k++) {
      PetscCall(FrictionSystemGrow_Private(problem, v, &growth));
      if (growth == 0) break;
      if (k >= RHO_FIRST) sum += PetscLogReal(growth);
    }
    *rho = growth > 0 ? PetscExpReal(sum / RHO_STEPS) : 0;
  }
  PetscCall(PetscFree(v));
  PetscFunctionReturn(PETSC_SUCCESS);
}
