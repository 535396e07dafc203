/* frictionkrylov.c -- Newton steps for contact with friction at full size.

   The accuracy of a linear system is that which the step needs (frictionlinear.c). A step that is too long is
   shortened (frictionsearch.c). */
#include "pdas/frictionlinear.h"
#include "pdas/fullsolver.h"

/* Reduction of the residual by a linear system: FIRST_FORCING at first; TIGHTER times that after steps that
   do not descend, at least TIGHT_FORCING. Once decisions hold: LAST_FORCING of the tolerance, at least
   LEAST_FORCING. */
static const PetscReal FIRST_FORCING = 1e-2, TIGHTER = 0.1, TIGHT_FORCING = 1e-5, LAST_FORCING = 0.2,
                       LEAST_FORCING = 1e-9;
/* A system leaves at most this part of the residual before it. */
static const PetscReal BELOW_BEFORE = 0.1;
/* Tolerance of coarser levels: their solution is only an initial guess. */
static const PetscReal LEVEL_RTOL = 1e-5;
/* The law's residual may have this part of the tolerance of systems: the error in the energy norm is
   larger. */
static const PetscReal LAW_PART = 0.1;
/* rho hardly depends on the mesh. It is that of the coarser mesh under three conditions: RHO_NODES nodes
   slip there or it is small, it is not within RHO_NEAR of 1, and less than RHO_CHANGES of the nodes changed
   what they do since. */
enum { RHO_NODES = 80 };
static const PetscReal RHO_NEAR = 0.3, RHO_CHANGES = 0.15;
/* How far it is from that of the finer mesh, as a part of itself: where RHO_NODES nodes slip up to 0.21, and
   where few do as far as it is large. */
static const PetscReal RHO_COARSER = 0.25, RHO_FEW_NODES = 1;
/* Accuracy of the systems for rho. On the coarser mesh, where steps are cheap, it settles at LEVEL_SETTLES
   of the error; where few nodes slip at all of it, beside which RHO_FEW_NODES is large. The error of an image
   has RHO_CORRECTION as an accuracy; beside RHO_COARSER it is small. */
static const PetscReal RHO_RTOL = 1e-2, LEVEL_SETTLES = 0.2, RHO_CORRECTION = 0.3;

/* The system without contact is solved roughly first, and more exactly where gaps open. */
static const PetscReal OPENS_ROUGHLY = 0.5, OPENS_RTOL = 1e-4;

typedef struct {
  FrictionLinear linear;
  Vec            y, r;  /* all unknowns; b - A y */
  Vec            begin; /* y at the begin of the step */
  PetscReal     *from;  /* the same of the set [n] */
  Vec            f, d;  /* right-hand side and solution of a step */
  PetscBool     *all;   /* true [n] */
  PetscReal      forcing, reference;
  PetscReal      size;    /* of the law's forces */
  PetscReal      last;    /* residual after the last step */
  PetscReal      ratio;   /* residual after the last step over the one before it */
  PetscBool      told;    /* decisions are set in the cycle */
  PetscBool      same;    /* decisions are the initial ones, unchanged */
  PetscBool      turns;   /* units have two tangents: slip may turn */
  PetscInt       changes; /* of decisions since the initial ones */
} Krylov;

/* Tolerance of the law's residual, relative to the forces. */
static PetscReal FrictionKrylovTolerance_Private(const ActiveSolver solver)
{
  return PetscMax(FRICTION_RTOL, solver->rtol > LEVEL_RTOL ? solver->rtol : LAW_PART * solver->rtol);
}

/* Forces of y, and the residuals of all equations: of the law, and of equations without a unit. [out] size -
   of the forces; [out] done - whether the residuals are small enough */
static PetscErrorCode FrictionKrylovEvaluate_Private(FrictionMethod method, FrictionStep *step)
{
  const ActiveSolver solver = method->solver;
  Krylov            *t      = method->data;
  const PetscReal    rtol   = FrictionKrylovTolerance_Private(solver);
  PetscReal          rest, law, forces, reference = t->reference;
  PetscBool          suffices;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolverResidual(solver, t->all, t->y, t->r, t->f, &rest));
  PetscCall(ActiveSetGather(solver->set, t->r, method->units.r));
  PetscCall(ActiveSetGather(solver->set, t->y, method->units.y));
  PetscCall(FrictionUnitsResidual(&method->units, PetscMax(FRICTION_RTOL, solver->rtol), &law, &forces));
  PetscCall(FrictionUnitsResidual(&method->units, rtol, &law, &step->size));
  t->size = step->size;
  if (rest <= solver->rtol * reference)
    PetscCall(FullSolverMeasure(solver, t->y, t->f, t->reference, &reference, NULL));
  PetscCall(ActiveSolverSuffices(solver, t->y, rest, PetscMax(forces, reference), &suffices));
  step->residual = PetscSqrtReal(rest * rest + law * law);
  step->done     = (PetscBool)(suffices && law <= rtol * step->size);
  step->size     = PetscMax(forces, t->reference);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the unknowns that the decisions fix. */
static PetscErrorCode FrictionKrylovPrescribe_Private(FrictionMethod method)
{
  Krylov *t = method->data;

  PetscFunctionBeginUser;
  FrictionUnitsPrescribe(&method->units);
  PetscCall(ActiveSetScatter(method->solver->set, method->units.y, t->y));
  FrictionUnitsMark(&method->units, t->linear.fixed);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* t->f = the residual of the law and of the other equations at y, for the decisions. */
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
    const PetscReal     pressing = PetscRealPart(f[FrictionLinearAt(&t->linear, unit->normal)]);
    const PetscReal     limit    = unit->bound + (unit->closed ? unit->coefficient * pressing : 0);
    PetscReal           s[FRICTION_TANGENTS], force[FRICTION_TANGENTS];

    if (unit->status != UNIT_SLIP) continue;
    for (PetscInt i = 0; i < unit->num; i++) s[i] = method->units.y[unit->tangent[i]] - unit->origin[i];
    FrictionUnitTurn(unit, s, force);
    for (PetscInt i = 0; i < unit->num; i++)
      f[FrictionLinearAt(&t->linear, unit->tangent[i])] -= limit * unit->direction[i] + force[i];
  }
  for (PetscInt i = 0; i < method->units.n; i++)
    if (t->linear.fixed[i]) f[FrictionLinearAt(&t->linear, i)] = 0;
  PetscCall(VecRestoreArray(t->f, &f));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Accuracy of the next system. It is higher if steps do not descend, since they may be too inexact. If
   decisions hold it is that of the tolerance: in a plane the system is then the law itself. In space slip
   turns, and it is that which Newton's method can use. Without contact there may be no force as reference. */
static PetscReal FrictionKrylovForce_Private(FrictionMethod method, PetscReal rtol, PetscReal residual,
                                             const FrictionReport *count, const FrictionStep *step)
{
  Krylov   *t = method->data;
  PetscReal end;

  if (method->units.waiting > 1) t->forcing = PetscMax(TIGHTER * t->forcing, TIGHT_FORCING);
  if (step->changed || residual == 0) return t->forcing;
  if (!step->closed && !count->slipping && !count->sticking) return LEAST_FORCING;
  end = PetscMax(LAST_FORCING * rtol * t->size / residual, LEAST_FORCING);
  return PetscMin(t->forcing, t->turns && count->slipping ? PetscMax(end, PetscSqr(t->ratio)) : end);
}

/* Slope of the energy without friction along t->d: -r d without the contact forces. */
static PetscErrorCode FrictionKrylovSlope_Private(FrictionMethod method, Vec r, PetscReal *slope)
{
  Krylov            *t = method->data;
  const PetscScalar *force, *d;
  PetscReal          taken = 0;
  PetscScalar        work;

  PetscFunctionBeginUser;
  PetscCall(VecDot(r, t->d, &work));
  PetscCall(VecGetArrayRead(r, &force));
  PetscCall(VecGetArrayRead(t->d, &d));
  for (PetscInt a = 0; a < method->units.num; a++) {
    const PetscInt at = FrictionLinearAt(&t->linear, method->units.unit[a].normal);

    if (method->units.unit[a].closed) taken += PetscRealPart(force[at] * d[at]);
  }
  PetscCall(VecRestoreArrayRead(t->d, &d));
  PetscCall(VecRestoreArrayRead(r, &force));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &taken, 1, MPIU_REAL, MPI_SUM, method->units.comm));
  *slope = taken - PetscRealPart(work);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets y to the end of the step without the slip that turned back, if its energy is not above `energy`, that
   of the part. Both are differences to t->begin, where the forces are t->f. [out] taken */
static PetscErrorCode FrictionKrylovClip_Private(FrictionMethod method, PetscReal energy, PetscBool *taken)
{
  const ActiveSet *set = method->solver->set;
  Krylov          *t   = method->data;
  PetscReal       *to, slope[2], work;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(method->units.n, &to));
  PetscCall(FrictionUnitsClip(&method->units, t->from, to, &work));
  PetscCall(ActiveSetScatter(set, to, t->y));
  PetscCall(PetscFree(to));
  PetscCall(VecWAXPY(t->d, -1, t->begin, t->y));
  PetscCall(MatMult(method->solver->A, t->y, t->r));
  PetscCall(VecAYPX(t->r, -1, method->solver->b));
  PetscCall(FrictionKrylovSlope_Private(method, t->f, &slope[0]));
  PetscCall(FrictionKrylovSlope_Private(method, t->r, &slope[1]));
  *taken = (PetscBool)((slope[0] + slope[1]) / 2 + work <= energy);
  if (*taken) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ActiveSetScatter(set, method->units.y, t->y));
  PetscCall(VecWAXPY(t->d, -1, t->begin, t->y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Shortens the step from t->from if it is too long: to its end without the slip that turned back, or to the
   part with the least energy, whichever has less. */
static PetscErrorCode FrictionKrylovSearch_Private(FrictionMethod method, FrictionStep *step)
{
  Krylov   *t = method->data;
  PetscReal slope[2], alpha, energy;
  PetscBool clipped = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetScatter(method->solver->set, t->from, t->begin));
  PetscCall(VecWAXPY(t->d, -1, t->begin, t->y));
  PetscCall(MatMult(method->solver->A, t->begin, t->f));
  PetscCall(VecAYPX(t->f, -1, method->solver->b));
  PetscCall(FrictionKrylovSlope_Private(method, t->f, &slope[0]));
  PetscCall(FrictionKrylovSlope_Private(method, t->r, &slope[1]));
  PetscCall(FrictionUnitsSearch(&method->units, t->from, slope, &alpha, &energy));
  if (alpha == 1) PetscFunctionReturn(PETSC_SUCCESS);
  if (alpha > 0) PetscCall(FrictionKrylovClip_Private(method, energy, &clipped));
  PetscCall(PetscInfo(t->linear.ksp, "step shortened to %g%s\n", (double)alpha, clipped ? " or clipped" : ""));
  if (!clipped) PetscCall(VecWAXPY(t->y, alpha, t->d, t->begin));
  PetscCall(FrictionKrylovEvaluate_Private(method, step));
  if (clipped || alpha < 1) PetscCall(FrictionUnitsEnd(&method->units, t->from, &step->turned));
  step->shortened = PETSC_TRUE;
  step->done      = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Makes the decisions, and sets them in the cycle. [in] residual - at y;
   [out] forcing - accuracy of the system of these decisions */
static PetscErrorCode FrictionKrylovDecide_Private(FrictionMethod method, PetscReal residual, FrictionStep *step,
                                                   PetscReal *forcing)
{
  const PetscReal rtol = FrictionKrylovTolerance_Private(method->solver);
  Krylov         *t    = method->data;
  FrictionReport  count;

  PetscFunctionBeginUser;
  if (!method->decided) PetscCall(FrictionUnitsDecide(&method->units, &step->changed));
  PetscCall(FrictionUnitsCount(&method->units, &count, &step->closed));
  *forcing = method->decided ? t->forcing : FrictionKrylovForce_Private(method, rtol, residual, &count, step);
  PetscCall(VecCopy(t->y, t->begin));
  FrictionUnitsProject(&method->units, t->from);
  PetscCall(FrictionKrylovPrescribe_Private(method));
  if (step->changed || !t->told) PetscCall(FrictionLinearTell(&t->linear));
  t->same = (PetscBool)(t->same && !step->changed);
  t->changes += step->changed;
  t->told         = PETSC_TRUE;
  method->decided = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reduction of the residual of a system. Where decisions move stiff nodes it begins far above the residual
   before them, and must come below that. Collective. [in] before - that residual; [in] forcing - reduction
   otherwise */
static PetscErrorCode FrictionKrylovReduction_Private(FrictionMethod method, PetscReal before, PetscReal *forcing)
{
  Krylov     *t = method->data;
  PetscScalar square;

  PetscFunctionBeginUser;
  PetscCall(VecPointwiseDivide(t->d, t->f, method->solver->diag));
  PetscCall(VecDot(t->f, t->d, &square));
  if (PetscRealPart(square) > 0)
    *forcing =
        PetscMin(*forcing, PetscMax(BELOW_BEFORE * before / PetscSqrtReal(PetscRealPart(square)), LEAST_FORCING));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves the system of the decisions. [in] before - the residual before it; [in] forcing - its accuracy;
   [in,out] step */
static PetscErrorCode FrictionKrylovSolve_Private(FrictionMethod method, PetscReal before, PetscReal forcing,
                                                  FrictionStep *step)
{
  Krylov *t = method->data;

  PetscFunctionBeginUser;
  PetscCall(FrictionKrylovLoad_Private(method));
  PetscCall(FrictionKrylovReduction_Private(method, before, &forcing));
  t->linear.coupled = PETSC_TRUE;
  PetscCall(FrictionLinearSolve(&t->linear, forcing, t->f, t->d, &step->iterations));
  PetscCall(VecAXPY(t->y, 1, t->d));
  PetscCall(FrictionKrylovEvaluate_Private(method, step));
  if (!step->done) PetscCall(FrictionKrylovSearch_Private(method, step));
  t->ratio = before > 0 ? step->residual / before : 1;
  t->last  = step->residual;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves the same system to the tolerance if its inexact solution confirms the decisions: it is then the law
   itself. Slip in space may turn, and that is another system. [in,out] step */
static PetscErrorCode FrictionKrylovConfirm_Private(FrictionMethod method, FrictionStep *step)
{
  const PetscReal rtol = FrictionKrylovTolerance_Private(method->solver);
  Krylov         *t    = method->data;
  FrictionReport  count;
  FrictionStep    confirmed = {.changed = 0};
  PetscReal       forcing;

  PetscFunctionBeginUser;
  if (step->done || step->shortened) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FrictionUnitsCount(&method->units, &count, &confirmed.closed));
  if (t->turns && count.slipping) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FrictionUnitsCompare(&method->units, &confirmed.changed));
  if (confirmed.changed) PetscFunctionReturn(PETSC_SUCCESS);
  forcing = FrictionKrylovForce_Private(method, rtol, step->residual, &count, &confirmed);
  PetscCall(FrictionKrylovSolve_Private(method, step->residual, forcing, step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the decisions in the system and in its cycle. */
static PetscErrorCode FrictionKrylovTell_Private(FrictionMethod method)
{
  Krylov *t = method->data;

  PetscFunctionBeginUser;
  FrictionUnitsMark(&method->units, t->linear.fixed);
  PetscCall(FrictionLinearTell(&t->linear));
  t->told = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Proximal steps before the decisions. Not without displacements, since they carry loads only a few cells
   far. Not after a step that did not descend: in slender bodies they may lead away from the solution. If they
   do not descend, as where they lead to another one of several solutions, they are taken back. */
static PetscErrorCode FrictionKrylovSettle_Private(FrictionMethod method)
{
  Krylov      *t = method->data;
  FrictionStep after;
  PetscReal    largest;

  PetscFunctionBeginUser;
  PetscCall(VecNorm(t->y, NORM_INFINITY, &largest));
  if (method->plain || method->decided || method->units.waiting || largest == 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecCopy(t->y, t->d));
  PetscCall(FrictionProximalApply(&t->linear, &method->units, t->y, t->r, t->begin, t->f));
  PetscCall(FrictionKrylovEvaluate_Private(method, &after));
  if (after.residual < t->last) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecCopy(t->d, t->y));
  PetscCall(FrictionKrylovEvaluate_Private(method, &after));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Step_Krylov(FrictionMethod method, FrictionStep *step)
{
  FrictionStep before;
  PetscReal    forcing = FIRST_FORCING;

  PetscFunctionBeginUser;
  PetscCall(FrictionKrylovSettle_Private(method));
  PetscCall(FrictionKrylovEvaluate_Private(method, &before));
  PetscCall(FrictionKrylovDecide_Private(method, before.residual, step, &forcing));
  PetscCall(FrictionKrylovSolve_Private(method, before.residual, forcing, step));
  PetscCall(FrictionKrylovConfirm_Private(method, step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Get_Krylov(FrictionMethod method, Vec y)
{
  Krylov *t = method->data;

  PetscFunctionBeginUser;
  PetscCall(VecCopy(t->y, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Set_Krylov(FrictionMethod method, Vec y)
{
  Krylov      *t = method->data;
  FrictionStep now;

  PetscFunctionBeginUser;
  PetscCall(VecCopy(y, t->y));
  PetscCall(FrictionKrylovEvaluate_Private(method, &now));
  t->last         = now.residual;
  t->told         = PETSC_FALSE; // the cycle may have had another set
  t->same         = PETSC_FALSE;
  method->decided = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Restart_Krylov(FrictionMethod method)
{
  Krylov *t = method->data;

  PetscFunctionBeginUser;
  t->forcing = FIRST_FORCING;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether all gaps are open where contact and friction have no forces: y + d, A d = r. [in] rtol */
static PetscErrorCode FrictionKrylovOpens_Private(FrictionMethod method, PetscReal rtol, PetscBool *opens)
{
  Krylov  *t          = method->data;
  PetscInt iterations = 0;

  PetscFunctionBeginUser;
  PetscCall(FrictionLinearSolve(&t->linear, rtol, t->r, t->d, &iterations));
  PetscCall(VecAXPY(t->d, 1, t->y));
  PetscCall(ActiveSetGather(method->solver->set, t->d, t->from));
  PetscCall(FrictionUnitsAreOpen(&method->units, t->from, opens));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Opens_Krylov(FrictionMethod method, PetscBool *opens)
{
  FrictionUnits *units = &method->units;
  FrictionUnit  *kept;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(units->num, &kept));
  PetscCall(PetscArraycpy(kept, units->unit, units->num));
  FrictionUnitsForget(units);
  PetscCall(FrictionKrylovTell_Private(method));
  PetscCall(FrictionKrylovOpens_Private(method, OPENS_ROUGHLY, opens));
  if (*opens) PetscCall(FrictionKrylovOpens_Private(method, OPENS_RTOL, opens));
  PetscCall(PetscArraycpy(units->unit, kept, units->num));
  PetscCall(FrictionKrylovTell_Private(method));
  PetscCall(PetscFree(kept));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Forces -d v at the tangents of units that slip. [in] v - [num] */
static PetscErrorCode FrictionKrylovPush_Private(FrictionMethod method, const PetscReal v[], Vec forces)
{
  Krylov      *t = method->data;
  PetscScalar *f;

  PetscFunctionBeginUser;
  PetscCall(VecZeroEntries(forces));
  PetscCall(VecGetArray(forces, &f));
  for (PetscInt a = 0; a < method->units.num; a++) {
    const FrictionUnit *unit = &method->units.unit[a];

    for (PetscInt i = 0; unit->status == UNIT_SLIP && i < unit->num; i++)
      f[FrictionLinearAt(&t->linear, unit->tangent[i])] = -unit->direction[i] * v[a];
  }
  PetscCall(VecRestoreArray(forces, &f));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Coefficient times change of r_n at the units that slip. [in] d - change of y; [in,out] work - scratch;
   [out] w - [num] */
static PetscErrorCode FrictionKrylovPress_Private(FrictionMethod method, Vec d, Vec work, PetscReal w[])
{
  Krylov            *t = method->data;
  const PetscScalar *force;

  PetscFunctionBeginUser;
  PetscCall(MatMult(method->solver->A, d, work));
  PetscCall(VecGetArrayRead(work, &force));
  for (PetscInt a = 0; a < method->units.num; a++) {
    const FrictionUnit *unit = &method->units.unit[a];

    w[a] = unit->status == UNIT_SLIP && unit->closed
               ? -unit->coefficient * PetscRealPart(force[FrictionLinearAt(&t->linear, unit->normal)])
               : 0;
  }
  PetscCall(VecRestoreArrayRead(work, &force));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* w = coefficient d r_n / d G v at the units that slip. [in] v - [num]; [out] w - [num] */
static PetscErrorCode FrictionKrylovGrow_Private(FrictionMethod method, const PetscReal v[], PetscReal w[])
{
  Krylov  *t          = method->data;
  PetscInt iterations = 0;

  PetscFunctionBeginUser;
  PetscCall(FrictionKrylovPush_Private(method, v, t->f));
  PetscCall(FrictionLinearSolve(&t->linear, RHO_RTOL, t->f, t->d, &iterations));
  PetscCall(FrictionKrylovPress_Private(method, t->d, t->f, w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The error of the last image: what is left of its system is solved. [in] v, [out] w - as before */
static PetscErrorCode FrictionKrylovCorrect_Private(FrictionMethod method, const PetscReal v[], PetscReal w[])
{
  Krylov  *t          = method->data;
  PetscInt iterations = 0;

  PetscFunctionBeginUser;
  PetscCall(FrictionKrylovPush_Private(method, v, t->f));
  PetscCall(MatMult(t->linear.A, t->d, t->begin)); // no step follows
  PetscCall(VecAXPY(t->f, -1, t->begin));
  PetscCall(FrictionLinearSolve(&t->linear, RHO_CORRECTION, t->f, t->begin, &iterations));
  PetscCall(FrictionKrylovPress_Private(method, t->begin, t->f, w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* rho of the report: that of before if decisions are the same, that of the coarser mesh, or its own. */
static PetscErrorCode FrictionKrylovReport_Private(FrictionMethod method, FrictionReport *report)
{
  const PDAS           *pdas    = method->pdas;
  Krylov               *t       = method->data;
  const FrictionReport *coarser = &pdas->coarser;
  const PetscBool       level   = (PetscBool)(method->solver->rtol > LEVEL_RTOL);
  const PetscBool       few     = (PetscBool)(report->slipping < RHO_NODES);

  PetscFunctionBeginUser;
  if (pdas->rho_skipped || (t->same && report->rho > 0)) PetscFunctionReturn(PETSC_SUCCESS);
  report->coarser = (PetscBool)(coarser->rho > 0 && (coarser->slipping >= RHO_NODES || coarser->rho < RHO_SMALL) &&
                                PetscAbsReal(coarser->rho - 1) > RHO_NEAR &&
                                (PetscReal)t->changes < RHO_CHANGES * (PetscReal)(report->slipping + report->sticking));
  if (report->coarser) {
    report->rho = coarser->rho;
    report->rho_error =
        coarser->rho_error + (coarser->slipping < RHO_NODES ? RHO_FEW_NODES : RHO_COARSER) * coarser->rho;
    report->others = PETSC_FALSE;
  } else {
    t->linear.coupled = PETSC_FALSE;
    PetscCall(FrictionSpectralRadius(method, FrictionKrylovGrow_Private, level ? NULL : FrictionKrylovCorrect_Private,
                                     level && !few ? LEVEL_SETTLES : 1, level && few ? RHO_SMALL : PETSC_MAX_REAL,
                                     report));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Finish_Krylov(FrictionMethod method, Vec y)
{
  PDAS           *pdas   = method->pdas;
  Krylov         *t      = method->data;
  FrictionReport *report = &pdas->friction_report;
  PetscInt        closed;

  PetscFunctionBeginUser;
  report->coupling = report->turning = PETSC_MAX_REAL;
  PetscCall(VecCopy(t->y, y));
  FrictionUnitsMark(&method->units, pdas->set.active);
  PetscCall(FrictionUnitsCount(&method->units, report, &closed));
  if (!pdas->converged) PetscFunctionReturn(PETSC_SUCCESS);
  if (!t->told) PetscCall(FrictionKrylovTell_Private(method));
  PetscCall(FrictionKrylovReport_Private(method, report));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Krylov(FrictionMethod method)
{
  Krylov *t = method->data;

  PetscFunctionBeginUser;
  PetscCall(FrictionLinearDestroy(&t->linear));
  PetscCall(VecDestroy(&t->y));
  PetscCall(VecDestroy(&t->r));
  PetscCall(VecDestroy(&t->begin));
  PetscCall(VecDestroy(&t->f));
  PetscCall(VecDestroy(&t->d));
  PetscCall(PetscFree2(t->all, t->from));
  PetscCall(PetscFree(t));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Initial decisions from a given set. */
static PetscErrorCode FrictionKrylovBegin_Private(FrictionMethod method, Vec set)
{
  Krylov    *t = method->data;
  PetscReal *given;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(method->units.n, &given));
  PetscCall(ActiveSetGather(method->solver->set, set, given));
  FrictionUnitsBegin(&method->units, given);
  t->same         = PETSC_TRUE;
  method->decided = PETSC_TRUE;
  PetscCall(PetscFree(given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionKrylovCreate(FrictionMethod method, Vec y)
{
  const ActiveSet *set = &method->pdas->set;
  Krylov          *t;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&t));
  method->data    = t;
  method->restart = Restart_Krylov;
  method->step    = Step_Krylov;
  method->get     = Get_Krylov;
  method->set     = Set_Krylov;
  method->finish  = Finish_Krylov;
  method->destroy = Destroy_Krylov;
  method->opens   = Opens_Krylov;
  PetscCall(FrictionUnitsCreate(set, method->pdas->law, &method->units));
  PetscCall(VecDuplicate(y, &t->y));
  PetscCall(VecDuplicate(y, &t->r));
  PetscCall(VecDuplicate(y, &t->begin));
  PetscCall(VecDuplicate(y, &t->f));
  PetscCall(VecDuplicate(y, &t->d));
  PetscCall(PetscMalloc2(set->n, &t->all, set->n, &t->from));
  for (PetscInt i = 0; i < set->n; i++) t->all[i] = PETSC_TRUE;
  for (PetscInt a = 0; a < method->units.num; a++) t->turns = (PetscBool)(t->turns || method->units.unit[a].num > 1);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &t->turns, 1, MPIU_BOOL, MPI_LOR, set->comm));
  PetscCall(VecZeroEntries(t->y));
  PetscCall(ActiveSolverResidual(method->solver, t->all, t->y, t->r, t->f, &t->reference));
  PetscCall(FrictionLinearCreate(method->solver, &method->units, &t->linear));
  PetscCall(Set_Krylov(method, y));
  if (method->pdas->previous) PetscCall(FrictionKrylovBegin_Private(method, method->pdas->previous));
  PetscFunctionReturn(PETSC_SUCCESS);
}
