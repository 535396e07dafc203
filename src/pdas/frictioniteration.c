/* frictioniteration.c -- contact with friction: Newton steps on the reduced problem, sweeps where they do not descend.

   The reduced problem is solved on the first rank. Then the other unknowns follow from it, and the forces from A itself: what these leave of
   the law is corrected by the same factors, as iterative refinement. */
#include "pdas/frictionimpl.h"

/* Residual of the law, relative to the forces, that a solution may have. */
static const PetscReal FRICTION_RTOL = 1e-10;
/* Newton steps in a row that need not descend; a step that does leaves this part of the residual. */
enum { PATIENCE = 6 };
static const PetscReal DESCENT = 0.9;
/* Sweeps at the first time, twice as many at the next. */
enum { FIRST_SWEEPS = 20, MAX_SWEEPS = 5000, FRICTION_REFINEMENTS = 2 };

#define FAILURE_FRICTION                                                                                               \
  "contact with friction did not converge: take smaller -load_steps; the coefficient may be so large that there are "  \
  "several solutions, or none"

#define FAILURE_FIXED_POINT                                                                                            \
  "the fixed point iteration over Tresca's friction does not converge, as for a large coefficient"
/* Limits below this part of stiffness times displacement need not settle. */
static const PetscReal LIMIT_NOISE = 1e-6;
/* A limit that no force exceeds. */
static const PetscReal ALL_STICKS = 1e30;
/* Change of the limits at which it ends. */
static const PetscReal FIXED_POINT_RTOL = 1e-11;

/* What decides on the next step; of the first rank. */
typedef struct {
  PetscReal *best; /* y with the least residual so far [N] */
  PetscReal  least;
  PetscInt   waiting, sweeps, all_sweeps;
} Descent;

/* Values that all ranks have of a step. */
enum { STEP_RESIDUAL, STEP_SIZE, STEP_CHANGED, STEP_CLOSED, STEP_DONE, STEP_SWEEPS, STEP_COUNT };

/* Takes the best iterate, and improves it by sweeps. */
static PetscErrorCode FrictionIterationSweep_Private(FrictionProblem *problem, Descent *descent)
{
  PetscReal size;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(problem->y, descent->best, problem->N));
  PetscCall(FrictionProblemSetForces(problem));
  descent->sweeps = descent->sweeps ? PetscMin(2 * descent->sweeps, MAX_SWEEPS) : FIRST_SWEEPS;
  descent->all_sweeps += descent->sweeps;
  PetscCall(FrictionSweep(problem, descent->sweeps));
  FrictionProblemResidual(problem, &descent->least, &size);
  PetscCall(PetscArraycpy(descent->best, problem->y, problem->N));
  descent->waiting = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One step on the first rank. [out] step - [STEP_COUNT] */
static PetscErrorCode FrictionIterationStep_Private(FrictionProblem *problem, Descent *descent, PetscReal step[])
{
  PetscInt  changed, closed = 0;
  PetscBool singular;

  PetscFunctionBeginUser;
  FrictionSystemDecide(problem, &changed);
  PetscCall(FrictionSystemSolve(problem, &singular));
  FrictionProblemResidual(problem, &step[STEP_RESIDUAL], &step[STEP_SIZE]);
  for (PetscInt a = 0; a < problem->num; a++) closed += problem->unit[a].closed ? 1 : 0;
  step[STEP_CHANGED] = (PetscReal)changed;
  step[STEP_CLOSED]  = (PetscReal)closed;
  step[STEP_DONE]    = !singular && step[STEP_RESIDUAL] <= FRICTION_RTOL * step[STEP_SIZE] ? 1 : 0;
  if (step[STEP_DONE] == 0) {
    if (!singular && step[STEP_RESIDUAL] < DESCENT * descent->least) {
      descent->least   = step[STEP_RESIDUAL];
      descent->waiting = 0;
      PetscCall(PetscArraycpy(descent->best, problem->y, problem->N));
    } else if (singular || ++descent->waiting >= PATIENCE) {
      PetscCall(FrictionIterationSweep_Private(problem, descent));
    }
  }
  step[STEP_SWEEPS] = (PetscReal)descent->all_sweeps;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Newton steps until the law holds. Collective. */
static PetscErrorCode FrictionIterationNewton_Private(SNES snes, PDAS *pdas, PetscMPIInt rank, FrictionProblem *problem)
{
  Descent   descent          = {.least = PETSC_MAX_REAL};
  PetscReal step[STEP_COUNT] = {0};

  PetscFunctionBeginUser;
  if (!rank) {
    PetscCall(PetscMalloc1(problem->N, &descent.best));
    PetscCall(PetscArraycpy(descent.best, problem->y, problem->N));
    FrictionProblemResidual(problem, &descent.least, &step[STEP_SIZE]);
  }
  while (!pdas->converged && pdas->iterations < pdas->max_it) {
    if (!rank) PetscCall(FrictionIterationStep_Private(problem, &descent, step));
    PetscCallMPI(MPI_Bcast(step, STEP_COUNT, MPIU_REAL, 0, pdas->set.comm));
    pdas->converged                   = (PetscBool)(step[STEP_DONE] > 0);
    pdas->changed[pdas->iterations++] = (PetscInt)step[STEP_CHANGED];
    pdas->linear_iterations++;
    pdas->num_active  = (PetscInt)step[STEP_CLOSED];
    pdas->safeguarded = (PetscBool)(step[STEP_SWEEPS] > 0);
    pdas->residual    = step[STEP_SIZE] > 0 ? step[STEP_RESIDUAL] / step[STEP_SIZE] : 0;
    PetscCall(SNESSetIterationNumber(snes, pdas->iterations));
    PetscCall(SNESSetFunctionNorm(snes, step[STEP_RESIDUAL]));
    PetscCall(SNESMonitor(snes, pdas->iterations, step[STEP_RESIDUAL]));
  }
  pdas->friction_report.sweeps = (PetscInt)step[STEP_SWEEPS];
  if (!pdas->converged) pdas->failure = pdas->fixed_point ? FAILURE_FIXED_POINT : FAILURE_FRICTION;
  PetscCall(PetscFree(descent.best));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gives every unit the limit that its present force makes, as Tresca's. [in] mu - coefficients [num]; [in,out] given - the part of the limits that is
   their own [num]; [out] change - largest change of a limit, relative to the largest limit */
static void FrictionIterationFreeze_Private(FrictionProblem *problem, const PetscReal mu[], const PetscReal given[],
                                            PetscReal *change)
{
  PetscReal largest = 0, most = 0, moved = 0, stiffest = 0;

  for (PetscInt i = 0; i < problem->N; i++) moved = PetscMax(moved, PetscAbsReal(problem->y[i]));
  for (PetscInt a = 0; a < problem->num; a++) {
    FrictionUnit   *unit  = &problem->unit[a];
    const PetscReal limit = given[a] + mu[a] * PetscMax(problem->r[unit->normal], 0);

    most        = PetscMax(most, PetscAbsReal(limit - unit->bound));
    largest     = PetscMax(largest, limit);
    stiffest    = PetscMax(stiffest, unit->stiffness);
    unit->bound = limit;
  }
  largest = PetscMax(largest, LIMIT_NOISE * stiffest * moved); // sides that are apart have limits of roundoff
  *change = largest > 0 ? most / largest : 0;
}

/* The other way to a solution: Tresca problems, whose limits follow the pressures of the last one. Collective. */
static PetscErrorCode FrictionIterationFixedPoint_Private(SNES snes, PDAS *pdas, PetscMPIInt rank,
                                                          FrictionProblem *problem)
{
  PetscReal *mu = NULL, *given = NULL, change = 1;

  PetscFunctionBeginUser;
  if (!rank) {
    PetscCall(PetscMalloc2(problem->num, &mu, problem->num, &given));
    for (PetscInt a = 0; a < problem->num; a++) {
      mu[a]                        = problem->unit[a].coefficient;
      given[a]                     = problem->unit[a].bound;
      problem->unit[a].coefficient = 0;
      if (mu[a] > 0) problem->unit[a].bound = ALL_STICKS; // friction alone may hold a body
    }
  }
  while (pdas->iterations < pdas->max_it && !pdas->failure) {
    pdas->converged = PETSC_FALSE;
    PetscCall(FrictionIterationNewton_Private(snes, pdas, rank, problem));
    if (!rank) FrictionIterationFreeze_Private(problem, mu, given, &change);
    PetscCallMPI(MPI_Bcast(&change, 1, MPIU_REAL, 0, pdas->set.comm));
    if (change <= FIXED_POINT_RTOL) break;
  }
  if (!(change <= FIXED_POINT_RTOL)) pdas->converged = PETSC_FALSE;
  if (!pdas->converged && !pdas->failure) pdas->failure = FAILURE_FIXED_POINT;
  PetscCall(PetscFree2(mu, given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All unknowns from those of the reduced problem. Collective. [out] y; solution - forces of A itself */
static PetscErrorCode FrictionIterationExpand_Private(PDAS *pdas, ActiveSolver solver, const FrictionProblem *problem,
                                                      ActiveSolution *solution, Vec y)
{
  const ActiveSet *set = &pdas->set;
  PetscBool       *all;
  PetscReal       *value;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(set->n, &all, set->n, &value));
  for (PetscInt i = 0; i < set->n; i++) all[i] = PETSC_TRUE;
  PetscCall(SchurSolverScatter(solver, problem->y, value));
  PetscCall(solver->solve(solver, all, value, solution));
  PetscCall(solver->finish(solver, solution, y));
  PetscCall(PetscFree2(all, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Expands, and corrects what the forces of A leave of the law. Collective. [out] y */
static PetscErrorCode FrictionIterationFinish_Private(PDAS *pdas, ActiveSolver solver, PetscMPIInt rank,
                                                      FrictionProblem *problem, Vec y)
{
  ActiveSolution solution;
  PetscBool      singular;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolutionCreate(&pdas->set, &solution));
  for (PetscInt k = 0; k <= FRICTION_REFINEMENTS && !solution.failure; k++) {
    PetscCall(FrictionIterationExpand_Private(pdas, solver, problem, &solution, y));
    PetscCall(SchurSolverGather(solver, solution.r, rank ? NULL : problem->r));
    if (rank || k == FRICTION_REFINEMENTS) continue;
    for (PetscInt i = 0; i < problem->N; i++) problem->g[i] = problem->r[i]; // g = r + S y with the r of A
    PetscCall(FrictionProblemAddProduct(problem));
    PetscCall(FrictionSystemSolve(problem, &singular));
  }
  if (solution.failure) {
    pdas->failure   = solution.failure;
    pdas->converged = PETSC_FALSE;
  }
  PetscCall(ActiveSolutionDestroy(&solution));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks what is closed and what sticks, and counts. Collective. */
static PetscErrorCode FrictionIterationReport_Private(PDAS *pdas, ActiveSolver solver, PetscMPIInt rank,
                                                      FrictionProblem *problem)
{
  FrictionReport *report = &pdas->friction_report;
  PetscReal      *fixed = NULL, *own, count[3] = {0, 0, 0};

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(pdas->set.n, &own));
  if (!rank) {
    PetscCall(PetscCalloc1(problem->N, &fixed));
    for (PetscInt a = 0; a < problem->num; a++) {
      const FrictionUnit *unit = &problem->unit[a];

      fixed[unit->normal] = unit->closed ? 1 : 0;
      for (PetscInt i = 0; i < unit->num; i++) fixed[unit->tangent[i]] = unit->status == UNIT_STICK ? 1 : 0;
      count[0] += unit->num && unit->status == UNIT_SLIP ? 1 : 0;
      count[1] += unit->num && unit->status == UNIT_STICK ? 1 : 0;
    }
    PetscCall(FrictionSystemGetRho(problem, &count[2]));
  }
  PetscCall(SchurSolverScatter(solver, fixed, own));
  for (PetscInt i = 0; i < pdas->set.n; i++) pdas->set.active[i] = (PetscBool)(own[i] > 0);
  PetscCallMPI(MPI_Bcast(count, 3, MPIU_REAL, 0, pdas->set.comm));
  report->slipping = (PetscInt)count[0];
  report->sticking = (PetscInt)count[1];
  report->rho      = count[2];
  PetscCall(PetscFree(fixed));
  PetscCall(PetscFree(own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionIterate(SNES snes, PDAS *pdas, ActiveSolver solver, Vec y)
{
  FrictionProblem problem;
  PetscScalar    *S = NULL;
  PetscReal      *own, *g = NULL;
  PetscMPIInt     rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(pdas->set.comm, &rank));
  PetscCall(SchurSolverGetReduced(solver, &S, &g));
  PetscCall(FrictionProblemCreate(&pdas->set, pdas->law, S, &problem));
  PetscCall(PetscMalloc1(pdas->set.n, &own));
  PetscCall(ActiveSetGather(&pdas->set, y, own));
  PetscCall(SchurSolverGather(solver, own, rank ? NULL : problem.y));
  PetscCall(PetscFree(own));
  if (!rank) {
    PetscCall(PetscArraycpy(problem.g, g, problem.N));
    PetscCall(FrictionProblemSetForces(&problem));
  }
  if (pdas->fixed_point)
    PetscCall(FrictionIterationFixedPoint_Private(snes, pdas, rank, &problem));
  else
    PetscCall(FrictionIterationNewton_Private(snes, pdas, rank, &problem));
  PetscCall(FrictionIterationFinish_Private(pdas, solver, rank, &problem, y));
  PetscCall(FrictionIterationReport_Private(pdas, solver, rank, &problem));
  PetscCall(FrictionProblemDestroy(&problem));
  PetscFunctionReturn(PETSC_SUCCESS);
}
