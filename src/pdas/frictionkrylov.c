/* frictionkrylov.c -- Newton steps for contact with friction at full size: GMRES, preconditioned by truncated multigrid.

   The system of frictionsystem.c with the other unknowns in it. Where a unit slips, its tangential rows have the resistance to turning, and
   less coefficient times its normal row: neither is in the multigrid cycle. The second term makes the system unsymmetric, but is no larger
   than friction is. The first one is large where slip has just begun: there the cycle leaves the tangents out, and they are solved by
   themselves. Systems are solved as far as a step needs. */
#include "pdas/fullsolver.h"
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* Residual of the law, relative to the forces, that a solution may have. */
static const PetscReal FRICTION_RTOL = 1e-10;
/* Reduction of the residual by a system: at first; where steps do not descend, down to; where decisions hold, to this part of the tolerance, down
   to. */
static const PetscReal FIRST_FORCING = 1e-2, TIGHTER = 0.1, TIGHT_FORCING = 1e-5, LAST_FORCING = 0.2,
                       LEAST_FORCING = 1e-9;
/* A resistance to turning above this part of the stiffness is not for the cycle. */
static const PetscReal STIFF_TURNING = 2;
/* Steps in a row that leave more than this part of the residual, before the method gives up. */
enum { PATIENCE = 20 };
static const PetscReal DESCENT = 0.9;
enum { GMRES_RESTART = 30, GMRES_MAX_IT = 150 };
/* Coarser levels, whose solution is only a start, need no rho: it costs as much as two steps. */
static const PetscReal LEVEL_RTOL = 1e-5;
/* Arnoldi's method for rho: number of steps, and the accuracy of their systems. It ends after the first number where rho is tiny, after the second
   where it is small or a step adds little, and after the third. */
enum { RHO_FIRST = 3, RHO_FEW = 6, RHO_STEPS = 24 };
static const PetscReal RHO_RTOL = 1e-2, RHO_TINY = 0.02, RHO_SMALL = 0.15, RHO_SETTLES = 0.005;

typedef struct {
  KSP        ksp;          /* of Newton's systems; its matrix and preconditioner are shells */
  Mat        A;            /* of the last step, see Multiply_Krylov() */
  Vec        y, r;         /* all unknowns; b - A y */
  Vec        f, d;         /* right-hand side and solution of a step */
  PetscBool *all;          /* true [n] */
  PetscBool *fixed, *left; /* unknowns that the step fixes; that the cycle leaves out [n] */
  PetscBool  coupled;      /* whether limits follow the pressure */
  PetscReal  forcing, least, reference;
  PetscInt   waiting; /* steps since the last that descended */
  PetscBool  begun;   /* units have decided */
  PetscBool  same;    /* as they were given, and have not changed since */
} Krylov;

/* The position of an unknown of the set in arrays of vectors. */
static PetscInt FrictionKrylovAt_Private(FrictionMethod method, PetscInt i)
{
  return method->pdas->set.dof[i] - method->pdas->set.dof_begin;
}

/* turning (1 - d d') s of a unit that slips */
static void FrictionKrylovTurn_Private(const FrictionUnit *unit, const PetscReal s[], PetscReal force[])
{
  PetscReal along = 0;

  for (PetscInt i = 0; i < unit->num; i++) along += unit->direction[i] * s[i];
  for (PetscInt i = 0; i < unit->num; i++) force[i] = unit->turning * (s[i] - along * unit->direction[i]);
}

/* The matrix of a step: z = A x; where a unit slips  z_t += turning (1 - d d') x_t - coefficient d z_n;  the diagonal where unknowns are fixed. */
static PetscErrorCode Multiply_Krylov(Mat A, Vec x, Vec z)
{
  FrictionMethod     method;
  Krylov            *t;
  const PetscScalar *from;
  PetscScalar       *to;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &method));
  t = method->data;
  PetscCall(MatMult(method->solver->A, x, z));
  PetscCall(VecGetArrayRead(x, &from));
  PetscCall(VecGetArray(z, &to));
  for (PetscInt a = 0; a < method->units.num; a++) {
    const FrictionUnit *unit = &method->units.unit[a];
    const PetscReal     mu   = t->coupled && unit->closed ? unit->coefficient : 0;
    PetscReal           s[FRICTION_TANGENTS], force[FRICTION_TANGENTS];

    if (unit->status != UNIT_SLIP) continue;
    for (PetscInt i = 0; i < unit->num; i++)
      s[i] = PetscRealPart(from[FrictionKrylovAt_Private(method, unit->tangent[i])]);
    FrictionKrylovTurn_Private(unit, s, force);
    for (PetscInt i = 0; i < unit->num; i++)
      to[FrictionKrylovAt_Private(method, unit->tangent[i])] +=
          force[i] - mu * unit->direction[i] * to[FrictionKrylovAt_Private(method, unit->normal)];
  }
  for (PetscInt i = 0; i < method->units.n; i++) {
    const PetscInt at = FrictionKrylovAt_Private(method, i);

    if (t->fixed[i]) to[at] = method->pdas->set.diag[i] * from[at];
  }
  PetscCall(VecRestoreArray(z, &to));
  PetscCall(VecRestoreArrayRead(x, &from));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* x = (k + turning (1 - d d'))^-1 f of a unit, k the stiffness: along d and across it. */
static void FrictionKrylovSolveUnit_Private(const FrictionUnit *unit, const PetscReal f[], PetscReal x[])
{
  PetscReal along = 0;

  for (PetscInt i = 0; i < unit->num; i++) along += unit->direction[i] * f[i];
  for (PetscInt i = 0; i < unit->num; i++)
    x[i] = along * unit->direction[i] / unit->resistance +
           (f[i] - along * unit->direction[i]) / (unit->resistance + unit->turning);
}

/* A cycle, and by themselves the tangents that it leaves out. */
static PetscErrorCode Precondition_Krylov(PC pc, Vec r, Vec z)
{
  FrictionMethod     method;
  Krylov            *t;
  const PetscScalar *from;
  PetscScalar       *to;
  PetscReal          alpha;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &method));
  t = method->data;
  PetscCall(VecCopy(r, t->r));
  PetscCall(VecGetArray(t->r, &to));
  for (PetscInt i = 0; i < method->units.n; i++)
    if (t->left[i]) to[FrictionKrylovAt_Private(method, i)] = 0;
  PetscCall(VecRestoreArray(t->r, &to));
  PetscCall((*method->solver->correct)(method->solver, t->r, z, &alpha));
  PetscCall(VecGetArrayRead(r, &from));
  PetscCall(VecGetArray(z, &to));
  for (PetscInt a = 0; a < method->units.num; a++) {
    const FrictionUnit *unit = &method->units.unit[a];
    PetscReal           f[FRICTION_TANGENTS], x[FRICTION_TANGENTS];

    if (unit->status != UNIT_SLIP || !t->left[unit->tangent[0]]) continue;
    for (PetscInt i = 0; i < unit->num; i++)
      f[i] = PetscRealPart(from[FrictionKrylovAt_Private(method, unit->tangent[i])]);
    FrictionKrylovSolveUnit_Private(unit, f, x);
    for (PetscInt i = 0; i < unit->num; i++) to[FrictionKrylovAt_Private(method, unit->tangent[i])] = x[i];
  }
  PetscCall(VecRestoreArray(z, &to));
  PetscCall(VecRestoreArrayRead(r, &from));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Forces of y, and what is left of all equations: of those that no unit owns, and of the law. [out] size - of the forces; [out] done - whether
   that is small enough */
static PetscErrorCode FrictionKrylovEvaluate_Private(FrictionMethod method, FrictionStep *step)
{
  const ActiveSolver solver = method->solver;
  Krylov            *t      = method->data;
  PetscReal          rest, law;
  PetscBool          suffices;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolverResidual(solver, t->all, t->y, t->r, t->f, &rest));
  PetscCall(ActiveSetGather(solver->set, t->r, method->units.r));
  PetscCall(ActiveSetGather(solver->set, t->y, method->units.y));
  PetscCall(FrictionUnitsResidual(&method->units, &law, &step->size));
  PetscCall(ActiveSolverSuffices(solver, t->y, rest, PetscMax(step->size, t->reference), &suffices));
  step->residual = PetscSqrtReal(rest * rest + law * law);
  step->done     = (PetscBool)(suffices && law <= PetscMax(FRICTION_RTOL, solver->rtol) * step->size);
  step->size     = PetscMax(step->size, t->reference);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Fixes what the decisions fix, and tells the cycle. */
static PetscErrorCode FrictionKrylovPrescribe_Private(FrictionMethod method)
{
  Krylov *t = method->data;

  PetscFunctionBeginUser;
  FrictionUnitsPrescribe(&method->units);
  PetscCall(ActiveSetScatter(method->solver->set, method->units.y, t->y));
  FrictionUnitsMark(&method->units, t->fixed);
  PetscCall(PetscArraycpy(t->left, t->fixed, method->units.n));
  for (PetscInt a = 0; a < method->units.num; a++) {
    const FrictionUnit *unit = &method->units.unit[a];

    if (unit->status != UNIT_SLIP || unit->num < 2 || !(unit->turning > STIFF_TURNING * unit->resistance)) continue;
    for (PetscInt i = 0; i < unit->num; i++) t->left[unit->tangent[i]] = PETSC_TRUE;
  }
  PetscCall(FullSolverSetFixed(method->solver, t->left));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* t->f = what the decisions leave of the law and of the other equations at y. */
static PetscErrorCode FrictionKrylovLoad_Private(FrictionMethod method)
{
  Krylov      *t = method->data;
  PetscScalar *f;

  PetscFunctionBeginUser;
  PetscCall(MatMult(method->solver->A, t->y, t->f));
  PetscCall(VecAYPX(t->f, -1, method->solver->b));
  PetscCall(VecGetArray(t->f, &f));
  for (PetscInt a = 0; a < method->units.num; a++) {
    const FrictionUnit *unit     = &method->units.unit[a];
    const PetscReal     pressing = PetscRealPart(f[FrictionKrylovAt_Private(method, unit->normal)]);
    const PetscReal     limit    = unit->bound + (unit->closed ? unit->coefficient * pressing : 0);
    PetscReal           s[FRICTION_TANGENTS], force[FRICTION_TANGENTS];

    if (unit->status != UNIT_SLIP) continue;
    for (PetscInt i = 0; i < unit->num; i++) s[i] = method->units.y[unit->tangent[i]] - unit->origin[i];
    FrictionKrylovTurn_Private(unit, s, force);
    for (PetscInt i = 0; i < unit->num; i++)
      f[FrictionKrylovAt_Private(method, unit->tangent[i])] -= limit * unit->direction[i] + force[i];
  }
  for (PetscInt i = 0; i < method->units.n; i++)
    if (t->fixed[i]) f[FrictionKrylovAt_Private(method, i)] = 0;
  PetscCall(VecRestoreArray(t->f, &f));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* d of f, to the accuracy rtol. [in,out] iterations - are added */
static PetscErrorCode FrictionKrylovSolve_Private(FrictionMethod method, PetscReal rtol, PetscInt *iterations)
{
  Krylov  *t = method->data;
  PetscInt its;

  PetscFunctionBeginUser;
  PetscCall(KSPSetTolerances(t->ksp, rtol, PETSC_DEFAULT, PETSC_DEFAULT, GMRES_MAX_IT));
  PetscCall(KSPSolve(t->ksp, t->f, t->d));
  PetscCall(KSPGetIterationNumber(t->ksp, &its));
  *iterations += its;
  PetscCall(
      PetscInfo(t->ksp, "system of a Newton step: reduced by %g in %" PetscInt_FMT " iterations\n", (double)rtol, its));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How far the next system is to be solved: further where steps stop to descend, for they may be too inexact; to the end where decisions hold. */
static void FrictionKrylovForce_Private(Krylov *t, PetscReal rtol, const FrictionStep *before, PetscInt changed)
{
  if (t->waiting > 1) t->forcing = PetscMax(TIGHTER * t->forcing, TIGHT_FORCING);
  if (!changed && before->residual > 0)
    t->forcing = PetscMin(t->forcing, PetscMax(LAST_FORCING * rtol * before->size / before->residual, LEAST_FORCING));
}

static PetscErrorCode Step_Krylov(FrictionMethod method, FrictionStep *step)
{
  const PetscReal rtol = PetscMax(FRICTION_RTOL, method->solver->rtol);
  Krylov         *t    = method->data;
  FrictionStep    before;
  FrictionReport  count;

  PetscFunctionBeginUser;
  PetscCall(FrictionKrylovEvaluate_Private(method, &before));
  if (t->begun) PetscCall(FrictionUnitsDecide(&method->units, &step->changed));
  PetscCall(FrictionUnitsCount(&method->units, &count, &step->closed));
  if (t->begun) FrictionKrylovForce_Private(t, rtol, &before, step->changed);
  t->same  = (PetscBool)(t->same && !step->changed);
  t->begun = PETSC_TRUE;
  PetscCall(FrictionKrylovPrescribe_Private(method));
  PetscCall(FrictionKrylovLoad_Private(method));
  t->coupled = PETSC_TRUE;
  PetscCall(FrictionKrylovSolve_Private(method, t->forcing, &step->iterations));
  PetscCall(VecAXPY(t->y, 1, t->d));
  PetscCall(FrictionKrylovEvaluate_Private(method, step));
  t->waiting = step->residual < DESCENT * t->least ? 0 : t->waiting + 1;
  t->least   = PetscMin(t->least, step->residual);
  if (!step->done && t->waiting >= PATIENCE) method->pdas->failure = FAILURE_FRICTION;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Restart_Krylov(FrictionMethod method)
{
  Krylov *t = method->data;

  PetscFunctionBeginUser;
  t->least   = PETSC_MAX_REAL;
  t->forcing = FIRST_FORCING;
  t->waiting = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* w = coefficient d r_n / d G v at the units that slip. [in] v - [num]; [out] w - [num] */
static PetscErrorCode FrictionKrylovGrow_Private(FrictionMethod method, const PetscReal v[], PetscReal w[])
{
  Krylov            *t = method->data;
  PetscScalar       *f;
  const PetscScalar *force;
  PetscInt           iterations = 0;

  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(t->f));
  PetscCall(VecGetArray(t->f, &f));
  for (PetscInt a = 0; a < method->units.num; a++) {
    const FrictionUnit *unit = &method->units.unit[a];

    for (PetscInt i = 0; unit->status == UNIT_SLIP && i < unit->num; i++)
      f[FrictionKrylovAt_Private(method, unit->tangent[i])] = -unit->direction[i] * v[a];
  }
  PetscCall(VecRestoreArray(t->f, &f));
  PetscCall(FrictionKrylovSolve_Private(method, RHO_RTOL, &iterations));
  PetscCall(MatMult(method->solver->A, t->d, t->f));
  PetscCall(VecGetArrayRead(t->f, &force));
  for (PetscInt a = 0; a < method->units.num; a++) {
    const FrictionUnit *unit = &method->units.unit[a];

    w[a] = unit->status == UNIT_SLIP && unit->closed
               ? -unit->coefficient * PetscRealPart(force[FrictionKrylovAt_Private(method, unit->normal)])
               : 0;
  }
  PetscCall(VecRestoreArrayRead(t->f, &force));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Removes the parts of v along older vectors, and scales it to 1. [out] h - those parts, then the length of the rest [k + 1] */
static PetscErrorCode FrictionKrylovOrthogonalize_Private(FrictionMethod method, PetscInt k, PetscReal *basis[],
                                                          PetscReal v[], PetscReal h[])
{
  const PetscInt num = method->units.num;

  PetscFunctionBeginUser;
  for (PetscInt j = 0; j <= k; j++) {
    h[j] = 0;
    for (PetscInt a = 0; a < num; a++) h[j] += v[a] * (j < k ? basis[j][a] : v[a]);
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &h[j], 1, MPIU_REAL, MPI_SUM, method->units.comm));
    for (PetscInt a = 0; a < num && j < k; a++) v[a] -= h[j] * basis[j][a];
  }
  h[k] = PetscSqrtReal(h[k]);
  for (PetscInt a = 0; a < num && h[k] > 0; a++) v[a] /= h[k];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* rho = max |eigenvalue of H|. [in] H - of Arnoldi's method, column by column [size][RHO_STEPS] */
static PetscErrorCode FrictionKrylovLargest_Private(PetscInt size, const PetscScalar H[], PetscReal *rho)
{
  PetscScalar  copy[RHO_STEPS * RHO_STEPS], real[RHO_STEPS], imaginary[RHO_STEPS], work[8 * RHO_STEPS], none;
  PetscBLASInt n = (PetscBLASInt)size, lead = RHO_STEPS, length = 8 * RHO_STEPS, one = 1, info;

  PetscFunctionBeginUser;
  *rho = 0;
  PetscCall(PetscArraycpy(copy, H, size * RHO_STEPS));
  PetscCallBLAS("LAPACKgeev", LAPACKgeev_("N", "N", &n, copy, &lead, real, imaginary, &none, &one, &none, &one, work,
                                          &length, &info));
  for (PetscInt i = 0; i < size && !info; i++)
    *rho = PetscMax(*rho, PetscSqrtReal(PetscSqr(real[i]) + PetscSqr(imaginary[i])));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Arnoldi's method for G -> coefficient r_n(G). */
static PetscErrorCode FrictionKrylovGetRho_Private(FrictionMethod method, PetscReal *rho)
{
  const PetscInt num                      = method->units.num;
  Krylov        *t                        = method->data;
  PetscScalar    H[RHO_STEPS * RHO_STEPS] = {0};
  PetscReal     *basis[RHO_STEPS + 1], *values, h[RHO_STEPS + 1];
  PetscReal      before  = 0;
  PetscBool      settled = PETSC_FALSE;

  PetscFunctionBeginUser;
  *rho = 0;
  if (method->solver->rtol > LEVEL_RTOL) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1((RHO_STEPS + 1) * num, &values));
  for (PetscInt j = 0; j <= RHO_STEPS; j++) basis[j] = &values[j * num];
  for (PetscInt a = 0; a < num; a++) {
    const FrictionUnit *unit = &method->units.unit[a];

    if (unit->status == UNIT_SLIP && unit->closed && unit->coefficient > 0)
      basis[0][a] = 1 + 0.5 * PetscSinReal((PetscReal)unit->normal); // in no invariant subspace
  }
  t->coupled = PETSC_FALSE;
  PetscCall(FrictionKrylovOrthogonalize_Private(method, 0, basis, basis[0], h));
  for (PetscInt k = 0; k < RHO_STEPS && h[k] > 0 && !settled; k++) {
    PetscCall(FrictionKrylovGrow_Private(method, basis[k], basis[k + 1]));
    PetscCall(FrictionKrylovOrthogonalize_Private(method, k + 1, basis, basis[k + 1], h));
    for (PetscInt i = 0; i < PetscMin(k + 2, RHO_STEPS); i++) H[RHO_STEPS * k + i] = h[i];
    PetscCall(FrictionKrylovLargest_Private(k + 1, H, rho));
    PetscCall(PetscInfo(t->ksp, "rho %g\n", (double)*rho));
    settled = (PetscBool)((k + 1 >= RHO_FIRST && *rho < RHO_TINY) || (k + 1 >= RHO_FEW && *rho < RHO_SMALL) ||
                          (k + 1 >= RHO_FEW && PetscAbsReal(*rho - before) < RHO_SETTLES * *rho));
    before  = *rho;
  }
  PetscCall(PetscFree(values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Finish_Krylov(FrictionMethod method, Vec y)
{
  PDAS           *pdas   = method->pdas;
  Krylov         *t      = method->data;
  FrictionReport *report = &pdas->friction_report;
  PetscInt        closed;

  PetscFunctionBeginUser;
  PetscCall(VecCopy(t->y, y));
  FrictionUnitsMark(&method->units, pdas->set.active);
  PetscCall(FrictionUnitsCount(&method->units, report, &closed));
  if (pdas->converged && !(t->same && report->rho > 0)) PetscCall(FrictionKrylovGetRho_Private(method, &report->rho));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Krylov(FrictionMethod method)
{
  Krylov *t = method->data;

  PetscFunctionBeginUser;
  PetscCall(KSPDestroy(&t->ksp));
  PetscCall(MatDestroy(&t->A));
  PetscCall(VecDestroy(&t->y));
  PetscCall(VecDestroy(&t->r));
  PetscCall(VecDestroy(&t->f));
  PetscCall(VecDestroy(&t->d));
  PetscCall(PetscFree3(t->all, t->fixed, t->left));
  PetscCall(PetscFree(t));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* First decisions from a given set: what is closed there is closed, and slips the way it has moved unless its tangents are in the set too. */
static PetscErrorCode FrictionKrylovBegin_Private(FrictionMethod method, Vec set)
{
  Krylov    *t = method->data;
  PetscReal *given;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(method->units.n, &given));
  PetscCall(ActiveSetGather(method->solver->set, set, given));
  for (PetscInt a = 0; a < method->units.num; a++) {
    FrictionUnit *unit = &method->units.unit[a];
    PetscReal     s[FRICTION_TANGENTS], size = 0, limit;
    PetscBool     sticks = PETSC_TRUE;

    unit->closed = (PetscBool)(given[unit->normal] > 0.5);
    limit        = unit->closed ? FrictionUnitLimit(unit, method->units.r[unit->normal]) : unit->bound;
    for (PetscInt i = 0; i < unit->num; i++) {
      s[i]   = method->units.y[unit->tangent[i]] - unit->origin[i];
      sticks = (PetscBool)(sticks && given[unit->tangent[i]] > 0.5);
      size += s[i] * s[i];
    }
    size         = PetscSqrtReal(size);
    unit->status = limit > 0 || (unit->closed && unit->coefficient > 0) ? UNIT_STICK : UNIT_FREE;
    if (unit->status == UNIT_FREE || sticks || size == 0) continue;
    unit->status  = UNIT_SLIP;
    unit->turning = limit / size;
    for (PetscInt i = 0; i < unit->num; i++) unit->direction[i] = s[i] / size;
  }
  t->begun = PETSC_FALSE;
  t->same  = PETSC_TRUE;
  PetscCall(PetscFree(given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* GMRES with both shells. */
static PetscErrorCode FrictionKrylovSetKSP_Private(FrictionMethod method)
{
  Krylov     *t = method->data;
  PetscInt    n, N;
  const char *prefix;
  PC          pc;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(t->y, &n));
  PetscCall(VecGetSize(t->y, &N));
  PetscCall(MatCreateShell(method->pdas->set.comm, n, n, N, N, method, &t->A));
  PetscCall(MatShellSetOperation(t->A, MATOP_MULT, (void (*)(void))Multiply_Krylov));
  PetscCall(KSPCreate(method->pdas->set.comm, &t->ksp));
  PetscCall(KSPGetOptionsPrefix(((FullSolver *)method->solver->data)->ksp, &prefix));
  PetscCall(KSPSetOptionsPrefix(t->ksp, prefix));
  PetscCall(KSPSetFromOptions(t->ksp)); // monitors and views; types are set after it, since no other ones fit
  PetscCall(KSPSetType(t->ksp, KSPGMRES));
  PetscCall(KSPGMRESSetRestart(t->ksp, GMRES_RESTART));
  PetscCall(KSPSetOperators(t->ksp, t->A, t->A));
  PetscCall(KSPGetPC(t->ksp, &pc));
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetContext(pc, method));
  PetscCall(PCShellSetApply(pc, Precondition_Krylov));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionKrylovCreate(FrictionMethod method, Vec y)
{
  const ActiveSet *set = &method->pdas->set;
  Krylov          *t;
  FrictionStep     first;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&t));
  method->data    = t;
  method->restart = Restart_Krylov;
  method->step    = Step_Krylov;
  method->finish  = Finish_Krylov;
  method->destroy = Destroy_Krylov;
  PetscCall(FrictionUnitsCreate(set, method->pdas->law, &method->units));
  PetscCall(VecDuplicate(y, &t->y));
  PetscCall(VecDuplicate(y, &t->r));
  PetscCall(VecDuplicate(y, &t->f));
  PetscCall(VecDuplicate(y, &t->d));
  PetscCall(PetscMalloc3(set->n, &t->all, set->n, &t->fixed, set->n, &t->left));
  for (PetscInt i = 0; i < set->n; i++) t->all[i] = PETSC_TRUE;
  PetscCall(VecZeroEntries(t->y));
  PetscCall(ActiveSolverResidual(method->solver, t->all, t->y, t->r, t->f, &t->reference));
  PetscCall(VecCopy(y, t->y));
  PetscCall(FrictionKrylovSetKSP_Private(method));
  PetscCall(FrictionKrylovEvaluate_Private(method, &first));
  t->begun = PETSC_TRUE;
  if (method->pdas->previous) PetscCall(FrictionKrylovBegin_Private(method, method->pdas->previous));
  PetscFunctionReturn(PETSC_SUCCESS);
}
