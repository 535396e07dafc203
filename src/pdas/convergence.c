/* convergence.c -- the convergence test of iterations with multigrid.

   At its target residual the iterate is evaluated. While it confirms the active set, the same iteration
   continues, and conjugate gradients keep their search directions (eq. 14.3). In the end forces and energy
   must be accurate (eq. 14.4). For stopping at the discretization error the energy of the error counts (eq.
   14.7). Multigrid cycles estimate it from any residual, |e|_A^2 ~ r'B r, a number that conjugate gradients
   compute anyway. The first one is the error of the coarser mesh. */
#include "base/compat.h"
#include "multigrid/eigenvalue.h"
#include "multigrid/multigrid.h"
#include "pdas/fullsolver.h"

/* The first evaluation is a little late, since a KSP measures residuals in its own norm; later ones know the
   ratio. */
static const PetscReal FIRST_EVALUATION = 0.5, NEXT_EVALUATION = 0.9;
/* Stagnation: the residual of the KSP fell by the first factor since the last evaluation, the true one by
   less than the second. */
static const PetscReal RECURSIVE_REDUCTION = 0.1, TRUE_REDUCTION = 0.5;
/* Part of rtol for the energy, which is an estimate. */
static const PetscReal ENERGY_PART = 0.02;

PetscErrorCode FullSolverUpdateRitz(FullSolver *t)
{
  PetscReal largest, smallest;
  PetscBool seen;

  PetscFunctionBeginUser;
  if (t->direct) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(EigenvalueGetRitz(t->ksp, &largest, &smallest, &seen));
  if (seen && smallest > 0 && (t->ritz == 0 || smallest < t->ritz)) t->ritz = smallest;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Negligible forces on free bounded unknowns, as parts of the largest on fixed ones: of the force, and of the
   force over the area. Areas of adapted meshes differ by factors of 1e4. The last part is also that of their
   work on the gaps in the work of all: where bodies hardly touch, wide gaps make it large. */
static const PetscReal NO_FORCE = 1e-8, FREE_PRESSURE = 3e-7;

/* Whether pressures and work of these forces are negligible. [in] roundoff - of forces */
static PetscErrorCode ConvergenceTestPressures_Private(ActiveSolver solver, PetscReal roundoff, PetscBool *forceless)
{
  const FullSolver  *t   = solver->data;
  const ActiveSet   *set = solver->set;
  const PetscScalar *r;
  PetscScalar        load;
  PetscReal          largest[2] = {0, 0}, work[2] = {0, 0}; /* of free ones, of fixed ones */

  PetscFunctionBeginUser;
  PetscCall(VecDot(solver->b, t->y, &load));
  PetscCall(VecGetArrayRead(t->r, &r));
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscReal force = PetscAbsScalar(r[set->dof[i] - set->dof_begin]);
    const PetscBool fixed = t->solution->fixed[i];

    if (set->area[i] <= 0 || set->upper[i] == PETSC_INFINITY || (!fixed && force <= roundoff)) continue;
    largest[fixed] = PetscMax(largest[fixed], force / set->area[i]);
    work[fixed] += force * PetscAbsReal(fixed ? set->upper[i] : set->upper[i] - t->solution->y[i]);
  }
  PetscCall(VecRestoreArrayRead(t->r, &r));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPIU_REAL, MPI_MAX, set->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, work, 2, MPIU_REAL, MPI_SUM, set->comm));
  work[1] += PetscAbsScalar(load);
  *forceless = (PetscBool)(largest[0] <= FREE_PRESSURE * largest[1] && work[0] <= FREE_PRESSURE * work[1]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether all forces on free bounded unknowns are negligible beside those on fixed ones, or roundoff: they
   would count as pressure or tension. */
static PetscErrorCode ConvergenceTestForces_Private(ActiveSolver solver, PetscBool *forceless)
{
  const FullSolver  *t   = solver->data;
  const ActiveSet   *set = solver->set;
  const PetscScalar *r;
  PetscReal          largest, max[3] = {0, 0, 0}; /* forces of free ones, of fixed ones; the stiffest of free ones */

  PetscFunctionBeginUser;
  PetscCall(VecNorm(t->y, NORM_INFINITY, &largest));
  PetscCall(VecGetArrayRead(t->r, &r));
  for (PetscInt i = 0; i < set->n; i++) {
    const int which = t->solution->fixed[i] ? 1 : 0;

    max[which] = PetscMax(max[which], PetscAbsScalar(r[set->dof[i] - set->dof_begin]));
    if (!t->solution->fixed[i]) max[2] = PetscMax(max[2], set->diag[i]);
  }
  PetscCall(VecRestoreArrayRead(t->r, &r));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, max, 3, MPIU_REAL, MPI_MAX, set->comm));
  max[2] *= FULLSOLVER_ROUNDING * largest;
  *forceless = (PetscBool)(max[0] <= PetscMax(PetscMax(NO_FORCE, solver->rtol) * max[1], max[2]));
  if (*forceless && set->area) PetscCall(ConvergenceTestPressures_Private(solver, max[2], forceless));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Computes y, its residual and their restriction to the bounded unknowns. [in] x - iterate of the KSP */
static PetscErrorCode ConvergenceEvaluate_Private(ActiveSolver solver, Vec x)
{
  FullSolver      *t        = solver->data;
  ActiveSolution  *solution = t->solution;
  const ActiveSet *set      = solver->set;
  PetscReal        size;
  PetscScalar     *y;

  PetscFunctionBeginUser;
  PetscCall(VecPointwiseMult(t->y, x, t->free)); // a preconditioner may have leaked into fixed unknowns
  PetscCall(VecGetArray(t->y, &y));
  for (PetscInt i = 0; i < set->n; i++)
    if (solution->fixed[i]) y[set->dof[i] - set->dof_begin] = solution->y[i];
  PetscCall(VecRestoreArray(t->y, &y));
  PetscCall(ActiveSolverResidual(solver, solution->fixed, t->y, t->r, t->rest, &size));
  PetscCall(MultigridAddWork(t->pc));
  solution->eta = size / (t->reference > 0 ? t->reference : t->first);
  PetscCall(ActiveSolverRestrict(solver, t->y, t->r, t->rest, solution));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FullSolverMeasure(ActiveSolver solver, Vec y, Vec work, PetscReal first, PetscReal *reference,
                                 PetscReal *energy)
{
  FullSolver *t = solver->data;
  PetscReal   forces, stored;
  PetscScalar square;

  PetscFunctionBeginUser;
  PetscCall(MultigridGetForces(t->pc, y, &forces, &stored));
  PetscCall(VecPointwiseMult(work, solver->diag, y));
  PetscCall(VecDot(work, y, &square));
  *reference =
      PetscMax(PetscMin(first, forces), FULLSOLVER_ROUNDING / solver->rtol * PetscSqrtReal(PetscRealPart(square)));
  if (energy)
    *energy =
        PetscMax(stored * PetscSqr(ENERGY_PART * solver->rtol), PetscSqr(FULLSOLVER_ROUNDING) * PetscRealPart(square));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* References of the final test. */
static PetscErrorCode ConvergenceMeasure_Private(ActiveSolver solver)
{
  FullSolver     *t    = solver->data;
  const PetscReal size = t->solution->eta * t->first;

  PetscFunctionBeginUser;
  PetscCall(FullSolverMeasure(solver, t->y, t->rest, t->first, &t->reference, &t->energy));
  t->solution->eta = size / t->reference;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the energy of the error is small enough. */
static PetscErrorCode ConvergenceTestEnergy_Private(FullSolver *t, PetscBool *settled)
{
  PetscReal error;

  PetscFunctionBeginUser;
  PetscCall(MultigridGetError(t->pc, &error));
  if (error < PETSC_MAX_REAL) PetscCall(FullSolverUpdateRitz(t));
  if (t->ritz > 0) error /= t->ritz;
  *settled = (PetscBool)(error <= t->energy);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether to evaluate an iterate; for stopping at the discretization error always.
   [out] error_reduction - whether the error has fallen as far as is asked for, which ends the iteration */
static PetscErrorCode ConvergenceIsDue_Private(ActiveSolver solver, PetscInt it, PetscReal norm, PetscBool *due,
                                               PetscBool *error_reduction)
{
  FullSolver     *t      = solver->data;
  const PetscBool last   = (PetscBool)(solver->target <= solver->rtol);
  PetscReal       square = 0;

  PetscFunctionBeginUser;
  *error_reduction = *due = (PetscBool)(norm == 0);
  if (it == 0 || *due) PetscFunctionReturn(PETSC_SUCCESS);
  if (solver->error_reduction > 0) {
    PetscCall(MultigridGetError(t->pc, &square));
    if (solver->first > 0)
      *error_reduction = (PetscBool)(square <= solver->error_reduction * solver->first);
    else
      solver->first = solver->energy_decrease + square; // the first cycle tells the initial error only
    *due = (PetscBool)(*error_reduction || !solver->all_digits);
  } else {
    *due = (PetscBool)(norm <= t->limit);
    if (*due && last && t->reference > 0) PetscCall(ConvergenceTestEnergy_Private(t, due));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether an evaluated iterate passes the final test. */
static PetscErrorCode ConvergenceTestFinal_Private(ActiveSolver solver, PetscBool *ends)
{
  FullSolver *t = solver->data;

  PetscFunctionBeginUser;
  *ends = PETSC_TRUE;
  if (t->reference == 0) { // later iterates are due only if this holds
    PetscCall(ConvergenceMeasure_Private(solver));
    PetscCall(ConvergenceTestEnergy_Private(t, ends));
  }
  if (*ends) *ends = (PetscBool)(t->solution->eta <= solver->target);
  if (*ends) PetscCall(ConvergenceTestForces_Private(solver, ends));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Evaluates an iterate. [in] error_reduction - of ConvergenceIsDue_Private(); [out] stop */
static PetscErrorCode ConvergenceTestIterate_Private(ActiveSolver solver, PetscReal norm, PetscBool error_reduction,
                                                     PetscBool *stop)
{
  FullSolver     *t        = solver->data;
  ActiveSolution *solution = t->solution;
  PetscBool       last = (PetscBool)(solver->target <= solver->rtol), holds = PETSC_FALSE, good = PETSC_FALSE;
  Vec             x;

  PetscFunctionBeginUser;
  PetscCall(KSPBuildSolution(t->ksp, NULL, &x));
  PetscCall(ConvergenceEvaluate_Private(solver, x));
  if (solver->error_reduction > 0) {
    if (solver->holds) PetscCall((*solver->holds)(solver, solution, &holds));
    *stop = t->done = (PetscBool)(error_reduction || (solver->holds && !holds));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (!last) {
    good = (PetscBool)(solution->eta <= solver->target);
    if (good && solver->holds) PetscCall((*solver->holds)(solver, solution, &holds)); // lowers the target where it does
    last = (PetscBool)(holds && solver->target <= solver->rtol); // the target may be reached already, at roundoff
    t->confirmed = (PetscBool)(t->confirmed || holds);
  }
  if (last) PetscCall(ConvergenceTestFinal_Private(solver, &good));
  *stop = t->done = (PetscBool)(good && (last || !holds));
  if (!good && norm <= RECURSIVE_REDUCTION * t->norm) {
    *stop     = (PetscBool)(solution->eta > TRUE_REDUCTION * t->before);
    t->before = solution->eta;
    t->norm   = norm;
  }
  t->limit = NEXT_EVALUATION * norm * PetscMin(1, solver->target / solution->eta);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Products with the matrix until the residual is small enough, at the rate so far; PETSC_MAX_REAL before an
   iterate has confirmed the set. [in] work - so far */
static PetscReal ConvergenceGetLeft_Private(const ActiveSolver solver, PetscReal norm, PetscReal work)
{
  const FullSolver *t   = solver->data;
  const PetscReal   end = t->limit * solver->rtol / solver->target;

  if (!t->confirmed || norm >= t->begun) return PETSC_MAX_REAL;
  return (work - t->work) * PetscLogReal(PetscMax(norm / end, 1)) / PetscLogReal(t->begun / norm);
}

/* The KSP's test. [in] ctx - ActiveSolver */
static PetscErrorCode ConvergenceTest_Private(KSP ksp, PetscInt it, PetscReal norm, KSPConvergedReason *reason,
                                              void *ctx)
{
  ActiveSolver solver = ctx;
  FullSolver  *t      = solver->data;
  Hierarchy    hierarchy;
  PetscInt     max_it;
  PetscBool    due, error_reduction, stop = PETSC_FALSE;

  PetscFunctionBeginUser;
  *reason = KSP_CONVERGED_ITERATING;
  if (PetscIsInfOrNanReal(norm)) {
    *reason = KSP_DIVERGED_NANORINF;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MultigridGetHierarchy(t->pc, &hierarchy));
  if (it == 0) t->begun = norm;
  if (it == 0) t->work = hierarchy->work;
  PetscCall(KSPGetTolerances(ksp, NULL, NULL, NULL, &max_it));
  PetscCall(ConvergenceIsDue_Private(solver, it, norm, &due, &error_reduction));
  if (due) PetscCall(ConvergenceTestIterate_Private(solver, norm, error_reduction, &stop));
  if (stop || norm == 0) {
    *reason = KSP_CONVERGED_RTOL;
  } else {
    PetscCall(HierarchyIsOver(hierarchy, ConvergenceGetLeft_Private(solver, norm, hierarchy->work), &t->over));
    if (t->over || it >= max_it) *reason = KSP_DIVERGED_ITS;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ConvergenceSetTest(ActiveSolver solver)
{
  FullSolver *t = solver->data;

  PetscFunctionBeginUser;
  PetscCall(KSPSetConvergenceTest(t->ksp, ConvergenceTest_Private, solver, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ConvergenceUnsetTest(FullSolver *t)
{
  void *own;

  PetscFunctionBeginUser;
  PetscCall(KSPConvergedDefaultCreate(&own));
  PetscCall(KSPSetConvergenceTest(t->ksp, KSPConvergedDefault, own, KSPConvergedDefaultDestroy));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ConvergenceBegin(ActiveSolver solver, PetscReal first, ActiveSolution *solution)
{
  FullSolver *t = solver->data;
  PetscReal   norm;

  PetscFunctionBeginUser;
  PetscCall(MultigridResetError(t->pc));
  PetscCall(VecNorm(t->f, NORM_2, &norm));
  if (!t->rest) PetscCall(VecDuplicate(t->f, &t->rest));
  t->first     = first;
  t->reference = 0;
  t->solution  = solution;
  t->limit     = FIRST_EVALUATION * solver->target * norm;
  if (solver->target <= solver->rtol) t->limit = PetscMin(t->limit, t->rtol * norm);
  t->before = t->norm = PETSC_MAX_REAL;
  t->done             = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ConvergenceFinish(ActiveSolver solver)
{
  FullSolver *t = solver->data;

  PetscFunctionBeginUser;
  if (!t->done) PetscCall(ConvergenceEvaluate_Private(solver, t->d));
  t->solution = NULL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ConvergenceSetErrorReduction(ActiveSolver solver, PetscReal error_reduction, PetscReal energy_decrease)
{
  PetscFunctionBeginUser;
  solver->error_reduction = error_reduction;
  solver->energy_decrease = energy_decrease;
  solver->rtol            = 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}
