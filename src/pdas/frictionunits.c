/* frictionunits.c -- units of contact with friction: their data, their decisions, and the residual of the
   law.

   Used for the reduced problem, with all units on one rank, and at full size, with each rank's own units.

   References: [1] Judice, Pires, A block principal pivoting algorithm for large-scale strictly monotone
   linear complementarity problems, 1994. */
#include "pdas/frictionimpl.h"

/* Tolerances of ties, relative to the largest value and force, as of frictionless contact. Where bodies move
   far a tie of values would be above the tolerance of the law: it takes at most TIE_PART of that. */
static const PetscReal TIE_FRICTION = 1e-11, TIE_PART = 0.5;
/* After SINGLE_STEPS steps in a row that do not descend, one unit at a time changes. Sets of changes may
   follow each other in a cycle [1]. */
enum { SINGLE_STEPS = 10 };
/* G / |q^| counts as at most this: the resistance to turning stays finite where slip begins. */
static const PetscReal SLIP_BEGINS = 1 - 1e-8;
/* Roundoff of a value, in units of the largest: with forces of A, and with those of S, where it grows with
   the condition. A body that is lifted has no other forces, and the certificate allows 64 epsilon. */
static const PetscReal ROUNDOFF_FULL = 16 * PETSC_MACHINE_EPSILON, ROUNDOFF_REDUCED = 256 * PETSC_MACHINE_EPSILON;
/* Slip below this part of force over stiffness has no direction of its own. */
static const PetscReal SLIP_DIRECTED = 1e-6;
/* Limits below this part of stiffness times displacement need not settle. */
static const PetscReal LIMIT_NOISE = 1e-6;
/* A limit above all forces. */
static const PetscReal ALL_STICKS = 1e30;
/* Limits have settled if their change is below this. */
static const PetscReal FIXED_POINT_RTOL = 1e-11;

/* Threshold of a given set, which has 1 and 0. */
static const PetscReal GIVEN_FROM = 0.5;

/* Numbers that a rank sends for each unit. */
enum {
  SENT_NORMAL,
  SENT_TANGENT,
  SENT_UPPER = SENT_TANGENT + FRICTION_TANGENTS,
  SENT_COEFFICIENT,
  SENT_BOUND,
  SENT_PLACE,
  SENT_ORIGIN,
  SENT_STIFFNESS = SENT_ORIGIN + FRICTION_TANGENTS,
  SENT_RESISTANCE,
  SENT_COUNT
};

/* The position of an unknown of this rank in the set. */
static PetscInt FrictionUnitsFind_Private(const ActiveSet *set, PetscInt dof)
{
  PetscInt low = 0, high = set->n - 1;

  while (low < high) {
    const PetscInt middle = (low + high) / 2;

    if (set->dof[middle] < dof)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/* The units of this rank as numbers. [out] sent - [num][SENT_COUNT], owned by the caller */
static PetscErrorCode FrictionUnitsPack_Private(const ActiveSet *set, const FrictionLaw *law, PetscInt *num,
                                                PetscReal **sent)
{
  PetscInt a = 0;

  PetscFunctionBeginUser;
  *num = 0;
  PetscCall(PetscCalloc1(SENT_COUNT * set->n, sent));
  for (PetscInt i = 0; i < set->n; i++) {
    PetscReal *s = &(*sent)[SENT_COUNT * *num];

    if (set->upper[i] >= PETSC_INFINITY) continue;
    s[SENT_NORMAL]    = (PetscReal)(set->begin + i);
    s[SENT_UPPER]     = set->upper[i];
    s[SENT_STIFFNESS] = set->diag[i];
    for (PetscInt k = 0; k < FRICTION_TANGENTS; k++) s[SENT_TANGENT + k] = -1;
    ++*num;
    if (a == law->n || law->normal[a] != set->dof[i]) continue;
    s[SENT_COEFFICIENT] = law->coefficient[a];
    s[SENT_BOUND]       = law->bound[a];
    s[SENT_PLACE]       = law->place[a];
    for (PetscInt k = 0; k < FRICTION_TANGENTS && law->tangent[FRICTION_TANGENTS * a + k] >= 0; k++) {
      const PetscInt at = FrictionUnitsFind_Private(set, law->tangent[FRICTION_TANGENTS * a + k]);

      s[SENT_TANGENT + k] = (PetscReal)(set->begin + at);
      s[SENT_ORIGIN + k]  = law->origin[FRICTION_TANGENTS * a + k];
      s[SENT_RESISTANCE]  = PetscMax(s[SENT_RESISTANCE], set->diag[at]);
    }
    a++;
  }
  PetscCheck(a == law->n, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A node with friction has no bound");
  PetscFunctionReturn(PETSC_SUCCESS);
}

static void FrictionUnitsUnpack_Private(PetscInt num, PetscInt begin, const PetscReal sent[], FrictionUnit unit[])
{
  for (PetscInt a = 0; a < num; a++) {
    const PetscReal *s = &sent[SENT_COUNT * a];
    FrictionUnit    *u = &unit[a];

    *u = (FrictionUnit){.normal      = (PetscInt)s[SENT_NORMAL] - begin,
                        .upper       = s[SENT_UPPER],
                        .coefficient = s[SENT_COEFFICIENT],
                        .bound       = s[SENT_BOUND],
                        .place       = s[SENT_PLACE],
                        .stiffness   = s[SENT_STIFFNESS],
                        .resistance  = s[SENT_RESISTANCE]};
    for (PetscInt k = 0; k < FRICTION_TANGENTS && s[SENT_TANGENT + k] >= 0; k++) {
      u->tangent[u->num]  = (PetscInt)s[SENT_TANGENT + k] - begin;
      u->origin[u->num++] = s[SENT_ORIGIN + k];
    }
  }
}

PetscErrorCode FrictionUnitsCreate(const ActiveSet *set, const FrictionLaw *law, FrictionUnits *units)
{
  PetscReal *sent;

  PetscFunctionBeginUser;
  *units = (FrictionUnits){.comm = set->comm, .n = set->n, .roundoff = ROUNDOFF_FULL};
  PetscCall(FrictionUnitsPack_Private(set, law, &units->num, &sent));
  PetscCall(PetscMalloc1(units->num, &units->unit));
  FrictionUnitsUnpack_Private(units->num, set->begin, sent, units->unit);
  PetscCall(PetscFree(sent));
  PetscCall(PetscCalloc2(units->n, &units->y, units->n, &units->r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionUnitsGather(const ActiveSet *set, const FrictionLaw *law, FrictionUnits *units)
{
  PetscMPIInt rank, size, length, *counts = NULL, *offsets = NULL;
  PetscInt    num;
  PetscReal  *sent, *all = NULL;

  PetscFunctionBeginUser;
  *units = (FrictionUnits){.comm = PETSC_COMM_SELF, .roundoff = ROUNDOFF_REDUCED};
  PetscCallMPI(MPI_Comm_rank(set->comm, &rank));
  PetscCallMPI(MPI_Comm_size(set->comm, &size));
  PetscCall(FrictionUnitsPack_Private(set, law, &num, &sent));
  PetscCall(PetscMPIIntCast(SENT_COUNT * num, &length));
  if (!rank) PetscCall(PetscMalloc2(size, &counts, size, &offsets));
  PetscCallMPI(MPI_Gather(&length, 1, MPI_INT, counts, 1, MPI_INT, 0, set->comm));
  if (!rank) {
    PetscMPIInt sum = 0;

    for (PetscMPIInt p = 0; p < size; sum += counts[p++]) offsets[p] = sum;
    units->num = sum / SENT_COUNT;
    PetscCall(PetscMalloc1(sum, &all));
  }
  PetscCallMPI(MPI_Gatherv(sent, length, MPIU_REAL, all, counts, offsets, MPIU_REAL, 0, set->comm));
  if (!rank) {
    units->n = set->N;
    PetscCall(PetscMalloc1(units->num, &units->unit));
    FrictionUnitsUnpack_Private(units->num, 0, all, units->unit);
    PetscCall(PetscCalloc2(units->n, &units->y, units->n, &units->r));
  }
  PetscCall(PetscFree2(counts, offsets));
  PetscCall(PetscFree(all));
  PetscCall(PetscFree(sent));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionUnitsDestroy(FrictionUnits *units)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(units->unit));
  PetscCall(PetscFree2(units->y, units->r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the unit is closed: a closed one opens below -tolerance, an open one closes above tolerance. */
static PetscBool FrictionUnitsIsClosed_Private(const FrictionUnit *unit, PetscReal test, const PetscReal tolerance[2])
{
  if (unit->closed) return (PetscBool)(test >= -tolerance[1]);
  return (PetscBool)(test > unit->stiffness * tolerance[0]);
}

/* Stick or slip from q^. [in] limit - G^ */
static UnitStatus FrictionUnitsSlides_Private(FrictionUnit *unit, const PetscReal q[], PetscReal limit,
                                              const PetscReal tolerance[2])
{
  const PetscBool ended = unit->ended;
  PetscReal       size  = 0;

  for (PetscInt i = 0; i < unit->num; i++) size += q[i] * q[i];
  size        = PetscSqrtReal(size);
  unit->ended = PETSC_FALSE;
  if (limit <= tolerance[1]) return UNIT_FREE;
  if (ended) return UNIT_STICK;
  if (unit->status == UNIT_SLIP ? size < limit - unit->resistance * tolerance[0] : size <= limit + tolerance[1])
    return UNIT_STICK;
  for (PetscInt i = 0; i < unit->num; i++) unit->direction[i] = q[i] / size;
  const PetscReal w = PetscMin(limit / size, SLIP_BEGINS);
  unit->turning     = unit->resistance * w / (1 - w);
  return UNIT_SLIP;
}

/* Squared residual of a unit's law in the norm of diag(A)^-1: length of a step along the forces, projected
   onto bound and cone. */
static PetscReal FrictionUnitsResidual_Private(const FrictionUnit *unit, const PetscReal y[], const PetscReal r[])
{
  const PetscReal k = unit->stiffness, pressing = r[unit->normal], limit = FrictionUnitLimit(unit, pressing);
  const PetscReal miss = PetscMax(-pressing, k * (y[unit->normal] - unit->upper));
  PetscReal       sum = miss * miss / k, z[FRICTION_TANGENTS], size = 0;

  if (!unit->num) return sum;
  for (PetscInt i = 0; i < unit->num; i++) {
    z[i] = unit->resistance * (y[unit->tangent[i]] - unit->origin[i]) + r[unit->tangent[i]];
    size += z[i] * z[i];
  }
  size = PetscSqrtReal(size);
  for (PetscInt i = 0; i < unit->num; i++) { // without the difference of two long ways of slip
    const PetscReal off = size > limit ? limit * z[i] / size - r[unit->tangent[i]]
                                       : unit->resistance * (y[unit->tangent[i]] - unit->origin[i]);

    sum += off * off / unit->resistance;
  }
  return sum;
}

/* What a unit would do; returns whether that is something else than before. [in,out] unit */
static PetscBool FrictionUnitsDecideOne_Private(const FrictionUnits *units, const PetscReal tolerance[2],
                                                FrictionUnit *unit)
{
  const PetscReal *y = units->y, *r = units->r;
  const PetscReal  test   = r[unit->normal] + unit->stiffness * (y[unit->normal] - unit->upper);
  const PetscBool  closed = FrictionUnitsIsClosed_Private(unit, test, tolerance), was = unit->closed;
  const UnitStatus before = unit->status;
  PetscReal        q[FRICTION_TANGENTS];

  for (PetscInt i = 0; i < unit->num; i++)
    q[i] = r[unit->tangent[i]] + unit->resistance * (y[unit->tangent[i]] - unit->origin[i]);
  if (unit->num)
    unit->status = FrictionUnitsSlides_Private(unit, q, FrictionUnitLimit(unit, closed ? test : 0), tolerance);
  unit->closed = closed;
  return (PetscBool)(closed != was || before != unit->status);
}

/* Makes the change where the law's residual is largest; all others keep what they do. Collective.
   [out] changed - on this rank */
static PetscErrorCode FrictionUnitsChangeOne_Private(FrictionUnits *units, const PetscReal tolerance[2],
                                                     PetscInt *changed)
{
  PetscReal largest, own = -1;
  PetscInt  worst = -1;

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < units->num; a++) {
    FrictionUnit    next = units->unit[a];
    const PetscReal off  = FrictionUnitsResidual_Private(&next, units->y, units->r);

    if (!FrictionUnitsDecideOne_Private(units, tolerance, &next)) {
      units->unit[a] = next; // its direction of slip may turn
    } else if (off > own) {
      own   = off;
      worst = a;
    }
  }
  PetscCallMPI(MPI_Allreduce(&own, &largest, 1, MPIU_REAL, MPI_MAX, units->comm));
  *changed = worst >= 0 && own == largest ? 1 : 0;
  if (*changed) (void)FrictionUnitsDecideOne_Private(units, tolerance, &units->unit[worst]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Collective. [out] tolerance - of values and of forces */
static PetscErrorCode FrictionUnitsGetTolerance_Private(const FrictionUnits *units, PetscReal tolerance[2])
{
  PetscReal most[3] = {0, 0, 0}, residual, size; // value, force, stiffness

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < units->n; i++) {
    most[0] = PetscMax(most[0], TIE_FRICTION * PetscAbsReal(units->y[i]));
    most[1] = PetscMax(most[1], TIE_FRICTION * PetscAbsReal(units->r[i]));
  }
  for (PetscInt a = 0; a < units->num; a++)
    most[2] = PetscMax(most[2], PetscMax(units->unit[a].stiffness, units->unit[a].resistance));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 3, MPIU_REAL, MPI_MAX, units->comm));
  PetscCall(FrictionUnitsResidual(units, 1, &residual, &size));
  tolerance[0] = PetscMin(most[0], TIE_PART * FRICTION_RTOL * size / PetscSqrtReal(most[2]));
  tolerance[1] = most[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionUnitsCompare(const FrictionUnits *units, PetscInt *changed)
{
  PetscReal tolerance[2];

  PetscFunctionBeginUser;
  PetscCall(FrictionUnitsGetTolerance_Private(units, tolerance));
  *changed = 0;
  for (PetscInt a = 0; a < units->num; a++) {
    FrictionUnit next = units->unit[a];

    *changed += FrictionUnitsDecideOne_Private(units, tolerance, &next) ? 1 : 0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, changed, 1, MPIU_INT, MPI_SUM, units->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionUnitsDecide(FrictionUnits *units, PetscInt *changed)
{
  PetscReal tolerance[2];

  PetscFunctionBeginUser;
  PetscCall(FrictionUnitsGetTolerance_Private(units, tolerance));
  *changed = 0;
  if (units->waiting >= SINGLE_STEPS) {
    PetscCall(FrictionUnitsChangeOne_Private(units, tolerance, changed));
  } else {
    for (PetscInt a = 0; a < units->num; a++)
      *changed += FrictionUnitsDecideOne_Private(units, tolerance, &units->unit[a]) ? 1 : 0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, changed, 1, MPIU_INT, MPI_SUM, units->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void FrictionUnitsForget(FrictionUnits *units)
{
  for (PetscInt a = 0; a < units->num; a++) {
    units->unit[a].closed = units->unit[a].ended = PETSC_FALSE;
    units->unit[a].status                        = UNIT_FREE;
  }
}

/* Turns slip into the direction of the force where it is roundoff, or what systems leave. After a load that
   turned back, nodes are at their limits without slip. Returns its size. [in,out] s - [num] */
static PetscReal FrictionUnitsFollowForce_Private(const FrictionUnit *unit, const PetscReal r[], PetscReal s[])
{
  PetscReal size = 0, force = 0;

  for (PetscInt i = 0; i < unit->num; i++) {
    size += s[i] * s[i];
    force += PetscSqr(r[unit->tangent[i]]);
  }
  size  = PetscSqrtReal(size);
  force = PetscSqrtReal(force);
  if (unit->resistance * size < SLIP_DIRECTED * force)
    for (PetscInt i = 0; i < unit->num; i++) s[i] = size * r[unit->tangent[i]] / force;
  return size;
}

void FrictionUnitsBegin(FrictionUnits *units, const PetscReal given[])
{
  for (PetscInt a = 0; a < units->num; a++) {
    FrictionUnit *unit = &units->unit[a];
    PetscReal     s[FRICTION_TANGENTS], limit, size;
    PetscBool     sticks = PETSC_TRUE;

    unit->closed = (PetscBool)(given[unit->normal] > GIVEN_FROM);
    limit        = unit->closed ? FrictionUnitLimit(unit, units->r[unit->normal]) : unit->bound;
    for (PetscInt i = 0; i < unit->num; i++) {
      s[i]   = units->y[unit->tangent[i]] - unit->origin[i];
      sticks = (PetscBool)(sticks && given[unit->tangent[i]] > GIVEN_FROM);
    }
    size         = FrictionUnitsFollowForce_Private(unit, units->r, s);
    unit->status = limit > 0 || (unit->closed && unit->coefficient > 0) ? UNIT_STICK : UNIT_FREE;
    if (unit->status == UNIT_FREE || sticks || size == 0) continue;
    unit->status  = UNIT_SLIP;
    unit->turning = limit / size;
    for (PetscInt i = 0; i < unit->num; i++) unit->direction[i] = s[i] / size;
  }
}

void FrictionUnitsPrescribe(FrictionUnits *units)
{
  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit = &units->unit[a];

    if (unit->closed) units->y[unit->normal] = unit->upper;
    for (PetscInt i = 0; i < unit->num && unit->status == UNIT_STICK; i++) units->y[unit->tangent[i]] = unit->origin[i];
  }
}

void FrictionUnitsMark(const FrictionUnits *units, PetscBool fixed[])
{
  for (PetscInt i = 0; i < units->n; i++) fixed[i] = PETSC_FALSE;
  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit = &units->unit[a];

    fixed[unit->normal] = unit->closed;
    for (PetscInt i = 0; i < unit->num; i++) fixed[unit->tangent[i]] = (PetscBool)(unit->status == UNIT_STICK);
  }
}

PetscErrorCode FrictionUnitsResidual(const FrictionUnits *units, PetscReal rtol, PetscReal *residual, PetscReal *size)
{
  PetscReal sum[3] = {0, 0, 0}, largest = 0;

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit = &units->unit[a];

    sum[0] += FrictionUnitsResidual_Private(unit, units->y, units->r);
    sum[1] += PetscSqr(units->r[unit->normal]) / unit->stiffness;
    sum[2] += unit->stiffness;
    for (PetscInt i = 0; i < unit->num; i++) sum[1] += PetscSqr(units->r[unit->tangent[i]]) / unit->resistance;
  }
  for (PetscInt i = 0; i < units->n; i++) largest = PetscMax(largest, PetscAbsReal(units->y[i]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPIU_REAL, MPI_SUM, units->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPI_MAX, units->comm));
  *residual = PetscSqrtReal(sum[0]);
  *size     = PetscSqrtReal(sum[1]) + units->roundoff / rtol * PetscSqrtReal(sum[2]) * largest;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionUnitsCount(const FrictionUnits *units, FrictionReport *report, PetscInt *closed)
{
  PetscInt count[3] = {0, 0, 0};

  PetscFunctionBeginUser;
  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit = &units->unit[a];

    count[0] += unit->num && unit->status == UNIT_SLIP ? 1 : 0;
    count[1] += unit->num && unit->status == UNIT_STICK ? 1 : 0;
    count[2] += unit->closed ? 1 : 0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 3, MPIU_INT, MPI_SUM, units->comm));
  report->slipping = count[0];
  report->sticking = count[1];
  *closed          = count[2];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionUnitsBeginFixedPoint(FrictionUnits *units, PetscReal **mu, PetscReal **given)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(units->num, mu));
  PetscCall(PetscMalloc1(units->num, given));
  for (PetscInt a = 0; a < units->num; a++) {
    FrictionUnit *unit = &units->unit[a];

    (*mu)[a]          = unit->coefficient;
    (*given)[a]       = unit->bound;
    unit->coefficient = 0;
    if ((*mu)[a] > 0) unit->bound = ALL_STICKS; // friction alone may hold a body
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionUnitsFreeze(FrictionUnits *units, const PetscReal mu[], const PetscReal given[],
                                   FrictionAnderson *anderson, PetscBool *settled)
{
  PetscReal *x, *g;
  PetscReal  most[4] = {0, 0, 0, 0}; // change of a limit; limit, displacement, stiffness

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(units->num, &x, units->num, &g));
  for (PetscInt i = 0; i < units->n; i++) most[2] = PetscMax(most[2], PetscAbsReal(units->y[i]));
  for (PetscInt a = 0; a < units->num; a++) {
    FrictionUnit   *unit  = &units->unit[a];
    const PetscReal limit = given[a] + (unit->closed ? mu[a] * PetscMax(units->r[unit->normal], 0) : 0);

    most[0] = PetscMax(most[0], PetscAbsReal(limit - unit->bound));
    most[1] = PetscMax(most[1], limit);
    most[3] = PetscMax(most[3], unit->stiffness);
    x[a]    = unit->bound;
    g[a]    = limit;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 4, MPIU_REAL, MPI_MAX, units->comm));
  most[1]  = PetscMax(most[1], LIMIT_NOISE * most[2] * most[3]); // open units have limits of the size of roundoff
  *settled = (PetscBool)(most[0] <= FIXED_POINT_RTOL * most[1]);
  if (anderson && !*settled) PetscCall(FrictionAndersonApply(units->comm, anderson, x, g));
  for (PetscInt a = 0; a < units->num; a++) units->unit[a].bound = g[a];
  PetscCall(PetscFree2(x, g));
  PetscFunctionReturn(PETSC_SUCCESS);
}
