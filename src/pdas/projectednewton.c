/* projectednewton.c -- two-metric projected Newton method, for problems on which the active set method
   cycles.

   On the bounded unknowns alone (all others eliminated) the problem is  phi(y) -> min,  y <= upper,  with
   gradient -r(y). Each step splits the unknowns into those at their bound, I = {y >= upper - eps, r > 0}, and
   the rest F. It takes the Newton step on F and the scaled gradient step on I, and projects:

       d_F = -phi_FF^-1 grad_F,   d_I = r_I / diag,   y(t) = min(y + t d, upper),

   with t halved until phi falls enough (eq. 10.2). The energy falls in every step, so no set returns for
   ever. Near the solution I is the active set, t = 1, and one more step is exact [1, section 3]. The systems
   are those of any active set. The energy of a quadratic follows from the forces at both ends, so no matrix
   is needed here.

   References: [1] Bertsekas, Projected Newton methods for optimization problems with simple constraints,
   1982. */
#include "pdas/pdasimpl.h"

/* Part of the predicted decrease that a step must reach. */
static const PetscReal SUFFICIENT = 1e-4;
/* Distance from the bound, relative to the largest unknown, within which an unknown may be fixed. */
static const PetscReal NEAR_BOUND = 1e-3;
/* At t = 2^-30 only roundoff is left of any decrease. */
static const PetscInt MAX_HALVINGS = 30;

PetscErrorCode ProjectedNewtonBegin(ProjectedNewton *newton, const ActiveSet *set, ActiveSolver solver,
                                    ActiveSolution *solution)
{
  PetscFunctionBeginUser;
  newton->on      = PETSC_TRUE;
  newton->settled = PETSC_FALSE;
  PetscCall(PetscMalloc3(set->n, &newton->y, set->n, &newton->r, set->n, &newton->d));
  PetscCall(PetscMalloc2(set->n, &newton->fixed, set->n, &newton->all));
  for (PetscInt i = 0; i < set->n; i++) {
    newton->y[i]   = PetscMin(solution->y[i], set->upper[i]);
    newton->all[i] = PETSC_TRUE;
  }
  PetscCall(solver->solve(solver, newton->all, newton->y, solution));
  PetscCall(PetscArraycpy(newton->r, solution->r, set->n));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProjectedNewtonEnd(ProjectedNewton *newton)
{
  PetscFunctionBeginUser;
  newton->on = PETSC_FALSE;
  PetscCall(PetscFree3(newton->y, newton->r, newton->d));
  PetscCall(PetscFree2(newton->fixed, newton->all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Splits into I (fixed) and F. The margin eps shrinks with the scaled, projected gradient, and vanishes at
   the solution. */
static PetscErrorCode ProjectedNewtonSplit_Private(ProjectedNewton *newton, const ActiveSet *set)
{
  PetscReal max[2] = {0, 0}, eps;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscReal step = PetscMin(newton->y[i] + newton->r[i] / set->diag[i], set->upper[i]) - newton->y[i];

    max[0] = PetscMax(max[0], PetscAbsReal(newton->y[i]));
    max[1] = PetscMax(max[1], PetscAbsReal(step));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, max, 2, MPIU_REAL, MPI_MAX, set->comm));
  eps = PetscMin(NEAR_BOUND * max[0], max[1]);
  for (PetscInt i = 0; i < set->n; i++) {
    newton->fixed[i] = (PetscBool)(newton->y[i] >= set->upper[i] - eps && newton->r[i] > 0);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves at y(t) = min(y + t d, upper), and tests whether phi fell enough: phi(y) - phi(y(t)) = (r +
   r(t)).(y(t) - y) / 2. */
static PetscErrorCode ProjectedNewtonTry_Private(ProjectedNewton *newton, const ActiveSet *set, ActiveSolver solver,
                                                 PetscReal t, PetscReal y[], ActiveSolution *solution,
                                                 PetscBool *accepted)
{
  PetscReal sum[2] = {0, 0}; /* decrease; its prediction */

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < set->n; i++) {
    y[i] = PetscMin(newton->y[i] + t * newton->d[i], set->upper[i]);
  }
  PetscCall(solver->solve(solver, newton->all, y, solution));
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscReal step = y[i] - newton->y[i];

    sum[0] += (newton->r[i] + solution->r[i]) * step / 2;
    sum[1] += newton->r[i] * (newton->fixed[i] ? step : t * newton->d[i]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPIU_REAL, MPI_SUM, set->comm));
  *accepted = (PetscBool)(sum[0] >= SUFFICIENT * sum[1]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The violation of the inequalities: the projected gradient, as forces. */
static PetscErrorCode ProjectedNewtonViolation_Private(const ProjectedNewton *newton, const ActiveSet *set,
                                                       PetscReal *violation)
{
  PetscReal sum = 0;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < set->n; i++)
    sum += PetscSqr(PetscMin(newton->r[i], set->diag[i] * (set->upper[i] - newton->y[i])));
  PetscCallMPI(MPI_Allreduce(&sum, violation, 1, MPIU_REAL, MPI_SUM, set->comm));
  *violation = PetscSqrtReal(*violation);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ProjectedNewtonStep(ProjectedNewton *newton, ActiveSet *set, ActiveSolver solver,
                                   ActiveSolution *solution, PetscInt *changed, PetscReal *violation)
{
  PetscBool  accepted = PETSC_FALSE;
  PetscInt   halvings, iterations;
  PetscReal *y;

  PetscFunctionBeginUser;
  if (solution->failure) PetscFunctionReturn(PETSC_SUCCESS); /* of ProjectedNewtonBegin() */
  PetscCall(ProjectedNewtonSplit_Private(newton, set));
  PetscCall(ActiveSetReplace(set, newton->fixed, changed));
  PetscCall(solver->solve(solver, newton->fixed, newton->y, solution));
  for (PetscInt i = 0; i < set->n; i++) {
    newton->d[i] = newton->fixed[i] ? newton->r[i] / set->diag[i] : solution->y[i] - newton->y[i];
  }
  PetscCall(PetscMalloc1(set->n, &y));
  iterations = solution->iterations;
  for (halvings = 0; halvings < MAX_HALVINGS && !accepted && !solution->failure; halvings++) {
    PetscCall(ProjectedNewtonTry_Private(newton, set, solver, PetscPowReal(0.5, (PetscReal)halvings), y, solution,
                                         &accepted));
    iterations += solution->iterations;
  }
  solution->iterations = iterations;
  PetscCall(PetscArraycpy(newton->y, y, set->n));
  PetscCall(PetscArraycpy(newton->r, solution->r, set->n));
  PetscCall(PetscFree(y));
  PetscCall(ProjectedNewtonViolation_Private(newton, set, violation));
  PetscCall(PetscInfo(solver->A,
                      "projected Newton: %" PetscInt_FMT " fixed, %" PetscInt_FMT " changed, t = 2^-%" PetscInt_FMT
                      ", projected gradient %g\n",
                      set->num_active, *changed, halvings - 1, (double)*violation));
  newton->settled = (PetscBool)(!*changed || !accepted);
  PetscFunctionReturn(PETSC_SUCCESS);
}
