/* frictionreduced.c -- Newton steps for contact with friction on the reduced problem, sweeps where they do not descend.

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

typedef struct {
  PetscMPIInt     rank;
  FrictionProblem problem;
  /* what decides on the next step; of the first rank */
  PetscReal *best; /* y with the least residual so far, or after the last sweeps [n] */
  PetscReal  least;
  PetscInt   waiting, sweeps, all_sweeps;
} Reduced;

/* Takes the best iterate, and improves it by sweeps. */
static PetscErrorCode FrictionReducedSweep_Private(Reduced *t)
{
  FrictionUnits *units = t->problem.units;
  PetscReal      size;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(units->y, t->best, units->n));
  if (!t->sweeps)
    FrictionUnitsReturn(units); // where all slip, a body may have gone so far that no sweeps bring it back
  PetscCall(FrictionProblemSetForces(&t->problem));
  t->sweeps = t->sweeps ? PetscMin(2 * t->sweeps, MAX_SWEEPS) : FIRST_SWEEPS;
  t->all_sweeps += t->sweeps;
  PetscCall(FrictionSweep(&t->problem, t->sweeps));
  PetscCall(FrictionUnitsResidual(units, &t->least, &size));
  PetscCall(PetscArraycpy(t->best, units->y, units->n));
  t->waiting = 0;
  FrictionUnitsForget(units); // what slips would seem to turn back from a direction of steps that were given up
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One step on the first rank. */
static PetscErrorCode FrictionReducedStepFirst_Private(Reduced *t, FrictionStep *step)
{
  FrictionUnits *units = t->problem.units;
  FrictionReport count;
  PetscBool      singular;

  PetscFunctionBeginUser;
  PetscCall(FrictionUnitsDecide(units, &step->changed));
  PetscCall(FrictionSystemSolve(&t->problem, &singular));
  PetscCall(FrictionUnitsResidual(units, &step->residual, &step->size));
  PetscCall(FrictionUnitsCount(units, &count, &step->closed));
  step->done = (PetscBool)(!singular && step->residual <= FRICTION_RTOL * step->size);
  if (!step->done) {
    if (!singular && step->residual < DESCENT * t->least) {
      t->least   = step->residual;
      t->waiting = 0;
      if (!t->sweeps) PetscCall(PetscArraycpy(t->best, units->y, units->n)); // sweeps go on from where they were
    } else if (singular || ++t->waiting >= PATIENCE) {
      PetscCall(FrictionReducedSweep_Private(t));
    }
  }
  step->iterations = 1;
  step->sweeps     = t->all_sweeps;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Step_Reduced(FrictionMethod method, FrictionStep *step)
{
  Reduced *t = method->data;

  PetscFunctionBeginUser;
  if (!t->rank) PetscCall(FrictionReducedStepFirst_Private(t, step));
  PetscCallMPI(MPI_Bcast(step, sizeof(*step), MPI_BYTE, 0, method->pdas->set.comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Restart_Reduced(FrictionMethod method)
{
  Reduced  *t = method->data;
  PetscReal size;

  PetscFunctionBeginUser;
  if (t->rank) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscArraycpy(t->best, method->units.y, method->units.n));
  PetscCall(FrictionUnitsResidual(&method->units, &t->least, &size));
  t->waiting = t->sweeps = t->all_sweeps = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All unknowns from those of the reduced problem. Collective. [out] y; solution - forces of A itself */
static PetscErrorCode FrictionReducedExpand_Private(PDAS *pdas, ActiveSolver solver, const FrictionProblem *problem,
                                                    ActiveSolution *solution, Vec y)
{
  const ActiveSet *set = &pdas->set;
  PetscBool       *all;
  PetscReal       *value;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(set->n, &all, set->n, &value));
  for (PetscInt i = 0; i < set->n; i++) all[i] = PETSC_TRUE;
  PetscCall(SchurSolverScatter(solver, problem->units->y, value));
  PetscCall(solver->solve(solver, all, value, solution));
  PetscCall(solver->finish(solver, solution, y));
  PetscCall(PetscFree2(all, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Expands, and corrects what the forces of A leave of the law. Collective. [out] y */
static PetscErrorCode FrictionReducedRefine_Private(PDAS *pdas, ActiveSolver solver, PetscMPIInt rank,
                                                    FrictionProblem *problem, Vec y)
{
  ActiveSolution solution;
  PetscBool      singular;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolutionCreate(&pdas->set, &solution));
  for (PetscInt k = 0; k <= FRICTION_REFINEMENTS && !solution.failure; k++) {
    PetscCall(FrictionReducedExpand_Private(pdas, solver, problem, &solution, y));
    PetscCall(SchurSolverGather(solver, solution.r, rank ? NULL : problem->units->r));
    if (rank || k == FRICTION_REFINEMENTS) continue;
    for (PetscInt i = 0; i < problem->units->n; i++)
      problem->g[i] = problem->units->r[i]; // g = r + S y with the r of A
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
static PetscErrorCode FrictionReducedReport_Private(FrictionMethod method)
{
  Reduced        *t      = method->data;
  PDAS           *pdas   = method->pdas;
  FrictionReport *report = &pdas->friction_report;
  PetscInt        closed;
  PetscBool      *mark = NULL;
  PetscReal      *all  = NULL, *own;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(pdas->set.n, &own));
  if (!t->rank) {
    PetscCall(PetscMalloc2(method->units.n, &all, method->units.n, &mark));
    FrictionUnitsMark(&method->units, mark);
    for (PetscInt i = 0; i < method->units.n; i++) all[i] = mark[i] ? 1 : 0;
    PetscCall(FrictionUnitsCount(&method->units, report, &closed));
    PetscCall(FrictionSystemGetRho(&t->problem, &report->rho));
  }
  PetscCall(SchurSolverScatter(method->solver, all, own));
  for (PetscInt i = 0; i < pdas->set.n; i++) pdas->set.active[i] = (PetscBool)(own[i] > 0);
  PetscCallMPI(MPI_Bcast(report, sizeof(*report), MPI_BYTE, 0, pdas->set.comm));
  PetscCall(PetscFree2(all, mark));
  PetscCall(PetscFree(own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Finish_Reduced(FrictionMethod method, Vec y)
{
  Reduced *t = method->data;

  PetscFunctionBeginUser;
  PetscCall(FrictionReducedRefine_Private(method->pdas, method->solver, t->rank, &t->problem, y));
  PetscCall(FrictionReducedReport_Private(method));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Reduced(FrictionMethod method)
{
  Reduced *t = method->data;

  PetscFunctionBeginUser;
  PetscCall(FrictionProblemDestroy(&t->problem));
  PetscCall(PetscFree(t->best));
  PetscCall(PetscFree(t));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionReducedCreate(FrictionMethod method, Vec y)
{
  const ActiveSet   *set    = &method->pdas->set;
  const ActiveSolver solver = method->solver;
  Reduced           *t;
  PetscScalar       *S = NULL;
  PetscReal         *own, *g = NULL;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&t));
  method->data    = t;
  method->restart = Restart_Reduced;
  method->step    = Step_Reduced;
  method->finish  = Finish_Reduced;
  method->destroy = Destroy_Reduced;
  PetscCallMPI(MPI_Comm_rank(set->comm, &t->rank));
  PetscCall(FrictionUnitsGather(set, method->pdas->law, &method->units));
  PetscCall(SchurSolverGetReduced(solver, &S, &g));
  PetscCall(FrictionProblemCreate(&method->units, S, &t->problem));
  PetscCall(PetscMalloc1(method->units.n, &t->best));
  PetscCall(PetscMalloc1(set->n, &own));
  PetscCall(ActiveSetGather(set, y, own));
  PetscCall(SchurSolverGather(solver, own, t->rank ? NULL : method->units.y));
  PetscCall(PetscFree(own));
  if (!t->rank) {
    PetscCall(PetscArraycpy(t->problem.g, g, method->units.n));
    PetscCall(FrictionProblemSetForces(&t->problem));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
