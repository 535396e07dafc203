/* frictionsearch.c -- shortens Newton steps for contact with friction.

   With the limits G of the present pressures the energy J(y) = 1/2 y'A y - b'y + sum G |s| is convex. The
   decisions of a step are those of a proximal step y^ (eq. 16.4). At y^ J is smooth in all free unknowns.
   From there Newton's step d descends until slip reverses. The part alpha minimizes J(y^ + alpha d) [1].
   Where slip ends with it, the unit sticks next: else it might end each of the next steps, too.

   In space a step is too short where slip grows: the resistance to turning falls with its size, and the
   step has that of its begin. Then alpha is above 1.

   Where slip reverses at many units, that is one unit per step. Therefore the end of the step is tried, too,
   with no slip at the units where it reversed [2]. If its J is less, all these units stick next.

   References: [1] Graeser, Kornhuber, Multigrid methods for obstacle problems, 2009: truncated nonsmooth
   Newton methods. [2] Andrew, Gao, Scalable training of L1-regularized log-linear models, 2007: projection
   onto the orthant where |s| is smooth. */
#include "pdas/frictionimpl.h"

/* A step is changed if the slope of the energy at its end is above this part of the slope at its begin.
   BISECTIONS: their number for the part. DOUBLINGS: of a step that is too short, at most. */
static const PetscReal OVERSHOOT = 0.1;
/* Slip has ended if the step leaves this part of it. In a plane that is zero, as exactly as the part
   of the step is found. Where the step is long, slips of other nodes are small, too. In space it passes by
   zero. */
static const PetscReal SLIP_ENDS_PLANE = 1e-6, SLIP_ENDS_SPACE = 1e-2;
enum { BISECTIONS = 80, DOUBLINGS = 6 };

/* The tangents of one unit after the proximal step. [in] limit - G of its pressure */
static void FrictionSearchProject_Private(const FrictionUnits *units, const FrictionUnit *unit, PetscReal limit,
                                          PetscReal to[])
{
  PetscReal moved[FRICTION_TANGENTS], size = 0, slip;

  for (PetscInt i = 0; i < unit->num; i++) {
    const PetscInt at = unit->tangent[i];

    moved[i] = units->y[at] - unit->origin[i] + units->r[at] / unit->resistance;
    size += moved[i] * moved[i];
  }
  slip = PetscMax(PetscSqrtReal(size) - limit / unit->resistance, 0);
  for (PetscInt i = 0; i < unit->num; i++) {
    to[unit->tangent[i]] = unit->origin[i];
    if (unit->status == UNIT_SLIP) to[unit->tangent[i]] += slip * unit->direction[i];
    if (unit->status == UNIT_FREE) to[unit->tangent[i]] += moved[i];
  }
}

void FrictionUnitsProject(const FrictionUnits *units, PetscReal to[])
{
  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit  = &units->unit[a];
    const PetscInt      n     = unit->normal;
    const PetscReal     moved = units->y[n] + units->r[n] / unit->stiffness;

    to[n] = unit->closed ? unit->upper : PetscMin(moved, unit->upper);
    FrictionSearchProject_Private(
        units, unit, FrictionUnitLimit(unit, unit->closed ? unit->stiffness * (moved - unit->upper) : 0), to);
  }
}

/* sum of G d|s| / d alpha on this rank. */
static PetscReal FrictionSearchSlope_Private(const FrictionUnits *units, const PetscReal from[], PetscReal alpha)
{
  PetscReal slope = 0;

  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit = &units->unit[a];
    PetscReal           size = 0, along = 0;

    for (PetscInt i = 0; i < unit->num; i++) {
      const PetscInt  at = unit->tangent[i];
      const PetscReal d = units->y[at] - from[at], s = from[at] + alpha * d - unit->origin[i];

      size += s * s;
      along += s * d;
    }
    if (size > 0) slope += FrictionUnitLimit(unit, units->r[unit->normal]) * along / PetscSqrtReal(size);
  }
  return slope;
}

/* d J / d alpha. Collective. */
static PetscErrorCode FrictionSearchEnergy_Private(const FrictionUnits *units, const PetscReal from[],
                                                   const PetscReal slope[2], PetscReal alpha, PetscReal *change)
{
  const PetscReal own = FrictionSearchSlope_Private(units, from, alpha);

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(&own, change, 1, MPIU_REAL, MPI_SUM, units->comm));
  *change += (1 - alpha) * slope[0] + alpha * slope[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Change of sum G |s| between two values of y. Collective. */
static PetscErrorCode FrictionSearchWork_Private(const FrictionUnits *units, const PetscReal from[],
                                                 const PetscReal to[], PetscReal *work)
{
  PetscFunctionBeginUser;
  *work = 0;
  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit   = &units->unit[a];
    PetscReal           before = 0, after = 0;

    for (PetscInt i = 0; i < unit->num; i++) {
      before += PetscSqr(from[unit->tangent[i]] - unit->origin[i]);
      after += PetscSqr(to[unit->tangent[i]] - unit->origin[i]);
    }
    *work += FrictionUnitLimit(unit, units->r[unit->normal]) * (PetscSqrtReal(after) - PetscSqrtReal(before));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, work, 1, MPIU_REAL, MPI_SUM, units->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionUnitsClip(const FrictionUnits *units, const PetscReal from[], PetscReal to[], PetscReal *work)
{
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(to, units->y, units->n));
  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit  = &units->unit[a];
    PetscReal           along = 0;

    for (PetscInt i = 0; i < unit->num; i++)
      along += unit->direction[i] * (units->y[unit->tangent[i]] - unit->origin[i]);
    for (PetscInt i = 0; unit->status == UNIT_SLIP && along < 0 && i < unit->num; i++)
      to[unit->tangent[i]] = unit->origin[i];
  }
  PetscCall(FrictionSearchWork_Private(units, from, to, work));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionUnitsEnd(FrictionUnits *units, const PetscReal from[], PetscBool *all)
{
  PetscInt count[2] = {0, 0}; // units that slip, and of these those that end

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < units->num; a++) {
    FrictionUnit   *unit  = &units->unit[a];
    const PetscReal part  = unit->num > 1 ? SLIP_ENDS_SPACE : SLIP_ENDS_PLANE;
    PetscReal       begin = 0, end = 0;

    for (PetscInt i = 0; i < unit->num; i++) {
      begin += PetscSqr(from[unit->tangent[i]] - unit->origin[i]);
      end += PetscSqr(units->y[unit->tangent[i]] - unit->origin[i]);
    }
    unit->ended = (PetscBool)(unit->status == UNIT_SLIP && end <= PetscSqr(part) * begin);
    count[0] += unit->status == UNIT_SLIP ? 1 : 0;
    count[1] += unit->ended ? 1 : 0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 2, MPIU_INT, MPI_SUM, units->comm));
  *all = (PetscBool)(count[0] > 0 && count[1] == count[0]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionUnitsSearch(FrictionUnits *units, const PetscReal from[], const PetscReal slope[2],
                                   PetscReal *alpha, PetscReal *energy)
{
  PetscReal begin, end, inner = 0, outer, *to;

  PetscFunctionBeginUser;
  PetscCall(FrictionSearchEnergy_Private(units, from, slope, 0, &begin));
  outer = begin > 0 ? -1 : 1; // roundoff decides where a nearly singular system leads
  PetscCall(FrictionSearchEnergy_Private(units, from, slope, outer, &end));
  *alpha  = outer;
  *energy = 0;
  if (PetscAbsReal(end) <= OVERSHOOT * PetscAbsReal(begin)) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt k = 0; k < DOUBLINGS && outer > 0 && begin * end > 0; k++) {
    inner = outer;
    outer *= 2;
    PetscCall(FrictionSearchEnergy_Private(units, from, slope, outer, &end));
  }
  if (begin * end >= 0) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt k = 0; k < BISECTIONS; k++) {
    const PetscReal middle = (inner + outer) / 2;
    PetscReal       change;

    PetscCall(FrictionSearchEnergy_Private(units, from, slope, middle, &change));
    if (change * begin > 0)
      inner = middle;
    else
      outer = middle;
  }
  *alpha = outer;
  PetscCall(PetscMalloc1(units->n, &to));
  for (PetscInt i = 0; i < units->n; i++) to[i] = from[i] + outer * (units->y[i] - from[i]);
  PetscCall(FrictionSearchWork_Private(units, from, to, energy));
  *energy += outer * slope[0] + outer * outer * (slope[1] - slope[0]) / 2;
  PetscCall(PetscFree(to));
  PetscFunctionReturn(PETSC_SUCCESS);
}
