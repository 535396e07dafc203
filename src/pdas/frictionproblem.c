/* frictionproblem.c -- the reduced problem with friction: its data on the first rank, its forces, its residual. */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* What a rank sends of a unit. */
enum {
  SENT_NORMAL,
  SENT_TANGENT,
  SENT_UPPER = SENT_TANGENT + FRICTION_TANGENTS,
  SENT_COEFFICIENT,
  SENT_BOUND,
  SENT_ORIGIN,
  SENT_STIFFNESS = SENT_ORIGIN + FRICTION_TANGENTS,
  SENT_RESISTANCE,
  SENT_COUNT
};

/* Roundoff of a value, in units of the largest: it grows with the condition of S. */
static const PetscReal ROUNDOFF = 256 * PETSC_MACHINE_EPSILON;

/* The position of an unknown of this rank in the set. */
static PetscInt FrictionProblemFind_Private(const ActiveSet *set, PetscInt dof)
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
static PetscErrorCode FrictionProblemPack_Private(const ActiveSet *set, const FrictionLaw *law, PetscInt *num,
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
    for (PetscInt k = 0; k < FRICTION_TANGENTS && law->tangent[FRICTION_TANGENTS * a + k] >= 0; k++) {
      const PetscInt at = FrictionProblemFind_Private(set, law->tangent[FRICTION_TANGENTS * a + k]);

      s[SENT_TANGENT + k] = (PetscReal)(set->begin + at);
      s[SENT_ORIGIN + k]  = law->origin[FRICTION_TANGENTS * a + k];
      s[SENT_RESISTANCE]  = PetscMax(s[SENT_RESISTANCE], set->diag[at]);
    }
    a++;
  }
  PetscCheck(a == law->n, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A node with friction has no bound");
  PetscFunctionReturn(PETSC_SUCCESS);
}

static void FrictionProblemUnpack_Private(PetscInt num, const PetscReal sent[], FrictionUnit unit[])
{
  for (PetscInt a = 0; a < num; a++) {
    const PetscReal *s = &sent[SENT_COUNT * a];
    FrictionUnit    *u = &unit[a];

    *u = (FrictionUnit){.normal      = (PetscInt)s[SENT_NORMAL],
                        .upper       = s[SENT_UPPER],
                        .coefficient = s[SENT_COEFFICIENT],
                        .bound       = s[SENT_BOUND],
                        .stiffness   = s[SENT_STIFFNESS],
                        .resistance  = s[SENT_RESISTANCE]};
    for (PetscInt k = 0; k < FRICTION_TANGENTS && s[SENT_TANGENT + k] >= 0; k++) {
      u->tangent[u->num]  = (PetscInt)s[SENT_TANGENT + k];
      u->origin[u->num++] = s[SENT_ORIGIN + k];
    }
  }
}

PetscErrorCode FrictionProblemCreate(const ActiveSet *set, const FrictionLaw *law, PetscScalar S[],
                                     FrictionProblem *problem)
{
  PetscMPIInt rank, size, length, *counts = NULL, *offsets = NULL;
  PetscInt    num;
  PetscReal  *sent, *all = NULL;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(problem, sizeof(*problem)));
  PetscCallMPI(MPI_Comm_rank(set->comm, &rank));
  PetscCallMPI(MPI_Comm_size(set->comm, &size));
  PetscCall(FrictionProblemPack_Private(set, law, &num, &sent));
  PetscCall(PetscMPIIntCast(SENT_COUNT * num, &length));
  if (!rank) PetscCall(PetscMalloc2(size, &counts, size, &offsets));
  PetscCallMPI(MPI_Gather(&length, 1, MPI_INT, counts, 1, MPI_INT, 0, set->comm));
  if (!rank) {
    PetscMPIInt sum = 0;

    for (PetscMPIInt p = 0; p < size; sum += counts[p++]) offsets[p] = sum;
    problem->num = sum / SENT_COUNT;
    PetscCall(PetscMalloc1(sum, &all));
  }
  PetscCallMPI(MPI_Gatherv(sent, length, MPIU_REAL, all, counts, offsets, MPIU_REAL, 0, set->comm));
  if (!rank) {
    const PetscInt N = set->N;

    problem->N = N;
    problem->S = S;
    PetscCall(PetscMalloc1(problem->num, &problem->unit));
    FrictionProblemUnpack_Private(problem->num, all, problem->unit);
    PetscCall(PetscMalloc4(N, &problem->g, N, &problem->y, N, &problem->r, N, &problem->place));
    PetscCall(PetscMalloc3(N * N, &problem->M, N, &problem->pivot, N, &problem->x));
  }
  PetscCall(PetscFree2(counts, offsets));
  PetscCall(PetscFree(all));
  PetscCall(PetscFree(sent));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionProblemDestroy(FrictionProblem *problem)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(problem->unit));
  PetscCall(PetscFree4(problem->g, problem->y, problem->r, problem->place));
  PetscCall(PetscFree3(problem->M, problem->pivot, problem->x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionProblemSetForces(FrictionProblem *problem)
{
  const PetscScalar one = 1, minus = -1;
  PetscBLASInt      N, step        = 1;

  PetscFunctionBeginUser;
  PetscCall(PetscBLASIntCast(problem->N, &N));
  PetscCall(PetscArraycpy(problem->r, problem->g, problem->N));
  PetscCallBLAS("BLASgemv", BLASgemv_("N", &N, &N, &minus, problem->S, &N, problem->y, &step, &one, problem->r, &step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionProblemAddProduct(FrictionProblem *problem)
{
  const PetscScalar plus = 1;
  PetscBLASInt      N, step = 1;

  PetscFunctionBeginUser;
  PetscCall(PetscBLASIntCast(problem->N, &N));
  PetscCallBLAS("BLASgemv", BLASgemv_("N", &N, &N, &plus, problem->S, &N, problem->y, &step, &plus, problem->g, &step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Square of what a unit's law is off by, in the norm of diag(A)^-1: the distance to where one step along the forces, and back onto bound and
   cone, would lead. */
static PetscReal FrictionUnitResidual_Private(const FrictionUnit *unit, const PetscReal y[], const PetscReal r[])
{
  const PetscReal k = unit->stiffness, pressing = r[unit->normal], limit = FrictionUnitLimit(unit, pressing);
  const PetscReal miss = PetscMax(-pressing, k * (y[unit->normal] - unit->upper));
  PetscReal       sum = miss * miss / k, z[FRICTION_TANGENTS], size = 0, kept;

  if (!unit->num) return sum;
  for (PetscInt i = 0; i < unit->num; i++) {
    z[i] = unit->resistance * (y[unit->tangent[i]] - unit->origin[i]) + r[unit->tangent[i]];
    size += z[i] * z[i];
  }
  size = PetscSqrtReal(size);
  kept = size > limit ? 1 - limit / size : 0;
  for (PetscInt i = 0; i < unit->num; i++) {
    const PetscReal off = unit->resistance * (y[unit->tangent[i]] - unit->origin[i]) - kept * z[i];

    sum += off * off / unit->resistance;
  }
  return sum;
}

void FrictionProblemResidual(const FrictionProblem *problem, PetscReal *residual, PetscReal *size)
{
  PetscReal sum = 0, forces = 0, stiff = 0, largest = 0;

  for (PetscInt a = 0; a < problem->num; a++) {
    const FrictionUnit *unit = &problem->unit[a];

    sum += FrictionUnitResidual_Private(unit, problem->y, problem->r);
    forces += PetscSqr(problem->r[unit->normal]) / unit->stiffness;
    stiff += unit->stiffness;
    for (PetscInt i = 0; i < unit->num; i++) forces += PetscSqr(problem->r[unit->tangent[i]]) / unit->resistance;
  }
  for (PetscInt i = 0; i < problem->N; i++) largest = PetscMax(largest, PetscAbsReal(problem->y[i]));
  *residual = PetscSqrtReal(sum);
  *size     = PetscSqrtReal(forces) + ROUNDOFF / 1e-10 * PetscSqrtReal(stiff) * largest;
}
