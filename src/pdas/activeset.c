/* activeset.c -- the bounded unknowns, the active set test, and hashes of sets.

   References: [1] Hueber, Wohlmuth, A primal-dual active set strategy for non-linear multibody contact, 2005.
   [2] Steele, Lea, Flood, Fast splittable pseudorandom number generators, 2014 (the mixing function). */
#include "pdas/pdasimpl.h"

/* Tolerance of ties relative to the scale of the values: a bound that is just touched, a force that just
   vanishes. Without it exact ties cycle by roundoff. */
static const PetscReal TIE = 1e-11;
/* Tolerance of ties relative to the residual of an inexact solve. Not all that the residual may hide: a wrong
   decision is repeated with more accuracy, an undecided one costs another system later. */
static const PetscReal TIE_PER_RESIDUAL = 0.1;
/* Roundoff of a value, in units of the largest unknown: it grows with the condition of the Schur complement,
   a few hundred on fine meshes. Roundoff of a force, in units of the diagonal times the largest unknown. */
static const PetscReal NOISE_VALUE = 1024 * PETSC_MACHINE_EPSILON;
static const PetscReal NOISE_FORCE = 64 * PETSC_MACHINE_EPSILON;

/* Marks the tangents of this rank. [out] tangent - [size], owned by the caller */
static PetscErrorCode ActiveSetMarkTangents_Private(const FrictionLaw *law, PetscInt begin, PetscInt size,
                                                    PetscBool **tangent)
{
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(size, tangent));
  for (PetscInt i = 0; law && i < FRICTION_TANGENTS * law->n; i++)
    if (law->tangent[i] >= 0) (*tangent)[law->tangent[i] - begin] = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSetCreate(Vec upper, Mat A, ActiveSet *set)
{
  return ActiveSetCreateWithTangents(upper, A, NULL, set);
}

PetscErrorCode ActiveSetCreateWithTangents(Vec upper, Mat A, const FrictionLaw *law, ActiveSet *set)
{
  const PetscScalar *u, *d;
  Vec                diag;
  PetscInt           size, i;
  PetscBool         *tangent;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(set, sizeof(*set)));
  PetscCall(PetscObjectGetComm((PetscObject)upper, &set->comm));
  PetscCall(VecDuplicate(upper, &diag));
  PetscCall(MatGetDiagonal(A, diag));
  PetscCall(VecGetLocalSize(upper, &size));
  PetscCall(VecGetOwnershipRange(upper, &set->dof_begin, NULL));
  PetscCall(VecGetArrayRead(upper, &u));
  PetscCall(VecGetArrayRead(diag, &d));
  PetscCall(ActiveSetMarkTangents_Private(law, set->dof_begin, size, &tangent));
  for (i = 0; i < size; i++) set->n += u[i] < PETSC_INFINITY || tangent[i];
  PetscCall(PetscMalloc3(set->n, &set->dof, set->n, &set->upper, set->n, &set->diag));
  PetscCall(PetscCalloc1(set->n, &set->active));
  for (i = 0, set->n = 0; i < size; i++) {
    if (u[i] >= PETSC_INFINITY && !tangent[i]) continue;
    set->dof[set->n]    = set->dof_begin + i;
    set->upper[set->n]  = u[i];
    set->diag[set->n++] = d[i];
  }
  PetscCall(VecRestoreArrayRead(diag, &d));
  PetscCall(VecRestoreArrayRead(upper, &u));
  PetscCall(VecDestroy(&diag));
  PetscCall(PetscFree(tangent));
  PetscCallMPI(MPI_Scan(&set->n, &set->begin, 1, MPIU_INT, MPI_SUM, set->comm));
  set->begin -= set->n;
  PetscCallMPI(MPI_Allreduce(&set->n, &set->N, 1, MPIU_INT, MPI_SUM, set->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSetSetAreas(ActiveSet *set, Vec areas)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(set->n + 1, &set->area)); // also on ranks without bounded unknowns: it is no NULL there
  PetscCall(ActiveSetGather(set, areas, set->area));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSetDestroy(ActiveSet *set)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree3(set->dof, set->upper, set->diag));
  PetscCall(PetscFree(set->active));
  PetscCall(PetscFree(set->area));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSetGather(const ActiveSet *set, Vec v, PetscReal values[])
{
  const PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(v, &a));
  for (PetscInt i = 0; i < set->n; i++) values[i] = PetscRealPart(a[set->dof[i] - set->dof_begin]);
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSetScatter(const ActiveSet *set, const PetscReal values[], Vec v)
{
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(VecGetArray(v, &a));
  for (PetscInt i = 0; i < set->n; i++) a[set->dof[i] - set->dof_begin] = values[i];
  PetscCall(VecRestoreArray(v, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSetReplace(ActiveSet *set, const PetscBool next[], PetscInt *changed)
{
  PetscInt count[2] = {0, 0};

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < set->n; i++) {
    count[0] += set->active[i] != next[i];
    count[1] += next[i] ? 1 : 0;
    set->active[i] = next[i];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 2, MPIU_INT, MPI_SUM, set->comm));
  *changed        = count[0];
  set->num_active = count[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Tolerances: [0] for values, [1] for forces. Distant bounds do not count: a wide gap elsewhere must not blur
   the test where bodies touch. A negative bound counts, since y must reach it. */
static PetscErrorCode ActiveSetTolerances_Private(const ActiveSet *set, const ActiveSolution *s, PetscReal tol[2])
{
  const PetscReal tau = PetscMax(TIE, TIE_PER_RESIDUAL * s->eta);

  PetscFunctionBeginUser;
  tol[0] = tol[1] = 0;
  for (PetscInt i = 0; i < set->n; i++) {
    tol[0] = PetscMax(tol[0], PetscMax(PetscAbsReal(s->y[i]), -set->upper[i]));
    if (set->active[i]) tol[1] = PetscMax(tol[1], PetscAbsReal(s->r[i]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, tol, 2, MPIU_REAL, MPI_MAX, set->comm));
  tol[0] = PetscMax(tau * tol[0], NOISE_VALUE * s->size);
  tol[1] = tau * tol[1];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The active set test of eq. 10.1 in units of force. One of the two terms is exactly zero, so the sign does
   not depend on c. The tolerance must scale with c in the same way. [in] tol - of
   ActiveSetTolerances_Private() */
static PetscBool ActiveSetDecide_Private(const ActiveSet *set, const ActiveSolution *s, PetscReal c,
                                         const PetscReal tol[2], PetscInt i)
{
  const PetscReal stiffness = c * set->diag[i];
  const PetscReal test      = s->r[i] + stiffness * (s->y[i] - set->upper[i]);

  if (set->active[i]) return (PetscBool)(test >= -PetscMax(tol[1], NOISE_FORCE * set->diag[i] * s->size));
  return (PetscBool)(test > stiffness * tol[0]);
}

PetscErrorCode ActiveSetHolds(const ActiveSet *set, const ActiveSolution *s, PetscReal c, PetscBool *holds)
{
  PetscReal tol[2];

  PetscFunctionBeginUser;
  PetscCall(ActiveSetTolerances_Private(set, s, tol));
  *holds = PETSC_TRUE;
  for (PetscInt i = 0; i < set->n && *holds; i++)
    *holds = (PetscBool)(ActiveSetDecide_Private(set, s, c, tol, i) == set->active[i]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, holds, 1, MPIU_BOOL, MPI_LAND, set->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSetUpdate(ActiveSet *set, const ActiveSolution *s, PetscReal c, PetscInt *changed,
                               PetscReal *violation)
{
  PetscReal  tol[2], sum = 0;
  PetscBool *next;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetTolerances_Private(set, s, tol));
  PetscCall(PetscMalloc1(set->n, &next));
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscReal wrong = set->active[i] ? -s->r[i] : set->diag[i] * (s->y[i] - set->upper[i]);

    next[i] = ActiveSetDecide_Private(set, s, c, tol, i);
    if (wrong > 0) sum += PetscSqr(wrong);
  }
  PetscCallMPI(MPI_Allreduce(&sum, violation, 1, MPIU_REAL, MPI_SUM, set->comm));
  *violation = PetscSqrtReal(*violation);
  PetscCall(ActiveSetReplace(set, next, changed));
  PetscCall(PetscInfo(NULL,
                      "%" PetscInt_FMT " active, %" PetscInt_FMT
                      " changed; into the set beyond %g, out of it below -%g, linear residual %g\n",
                      set->num_active, *changed, (double)tol[0], (double)tol[1], (double)s->eta));
  PetscCall(PetscFree(next));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Mixes 64 bits so that sums of mixed numbers distinguish sets [2]. */
static uint64_t ActiveSetMix_Private(uint64_t z)
{
  z *= 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

PetscErrorCode ActiveSetAll(const ActiveSet *set, PetscInt **C)
{
  PetscMPIInt size, n, *counts, *offsets;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(set->comm, &size));
  PetscCall(PetscMPIIntCast(set->n, &n));
  PetscCall(PetscMalloc2(size, &counts, size, &offsets));
  PetscCallMPI(MPI_Allgather(&n, 1, MPI_INT, counts, 1, MPI_INT, set->comm));
  for (PetscMPIInt r = 0, sum = 0; r < size; sum += counts[r++]) offsets[r] = sum;
  PetscCall(PetscMalloc1(set->N, C));
  PetscCallMPI(MPI_Allgatherv(set->dof, n, MPIU_INT, *C, counts, offsets, MPIU_INT, set->comm));
  PetscCall(PetscFree2(counts, offsets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSetHash(const ActiveSet *set, uint64_t *hash)
{
  uint64_t sum = 0;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < set->n; i++) {
    if (set->active[i]) sum += ActiveSetMix_Private((uint64_t)(set->begin + i + 1));
  }
  PetscCallMPI(MPI_Allreduce(&sum, hash, 1, MPI_UINT64_T, MPI_SUM, set->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSolutionCreate(const ActiveSet *set, ActiveSolution *solution)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(solution, sizeof(*solution)));
  PetscCall(PetscCalloc3(set->n, &solution->fixed, set->n, &solution->y, set->n, &solution->r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ActiveSolutionDestroy(ActiveSolution *solution)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree3(solution->fixed, solution->y, solution->r));
  PetscFunctionReturn(PETSC_SUCCESS);
}
