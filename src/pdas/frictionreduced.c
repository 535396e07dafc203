/* frictionreduced.c -- Newton steps for contact with friction on the reduced problem.

   The reduced problem is solved on the first rank. Then the other unknowns follow from it, and the forces
   from A itself. The residual of the law with these forces is corrected by the same factors (iterative
   refinement). */
#include "pdas/frictionimpl.h"

enum { FRICTION_REFINEMENTS = 2 };

typedef struct {
  PetscMPIInt     rank;
  FrictionProblem problem;
  PetscReal       rtol;      /* of the law: residual over forces that may be left */
  PetscReal      *from, *to; /* y at the begin and the end of a step; on the first rank [n] */
} Reduced;

/* Slope of the energy without friction between t->from and t->to, with the forces of y: -r (to - from)
   without the contact forces. */
static PetscReal FrictionReducedSlope_Private(const Reduced *t)
{
  const FrictionUnits *units = t->problem.units;
  PetscReal            slope = 0;

  for (PetscInt i = 0; i < units->n; i++) slope -= units->r[i] * (t->to[i] - t->from[i]);
  for (PetscInt a = 0; a < units->num; a++) {
    const PetscInt n = units->unit[a].normal;

    if (units->unit[a].closed) slope += units->r[n] * (t->to[n] - t->from[n]);
  }
  return slope;
}

/* Slopes of the energy without friction at t->from and at t->to, where y and the forces are left. */
static PetscErrorCode FrictionReducedSlopes_Private(Reduced *t, PetscReal slope[2])
{
  FrictionUnits *units = t->problem.units;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(units->y, t->from, units->n));
  PetscCall(FrictionProblemSetForces(&t->problem));
  slope[0] = FrictionReducedSlope_Private(t);
  PetscCall(PetscArraycpy(units->y, t->to, units->n));
  PetscCall(FrictionProblemSetForces(&t->problem));
  slope[1] = FrictionReducedSlope_Private(t);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes the end of the step, t->to, in place of its part, if it leaves less of the law's residual: the
   part is that of an energy with the limits of the end, which may differ much from those of the part.
   [in,out] step - residual of the end */
static PetscErrorCode FrictionReducedCompare_Private(Reduced *t, FrictionStep *step)
{
  FrictionUnits *units = t->problem.units;
  FrictionStep   part  = *step;

  PetscFunctionBeginUser;
  PetscCall(FrictionUnitsResidual(units, t->rtol, &part.residual, &part.size));
  step->shortened = (PetscBool)(part.residual <= step->residual);
  if (step->shortened) {
    step->residual = part.residual;
    step->size     = part.size;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  for (PetscInt a = 0; a < units->num; a++) units->unit[a].ended = PETSC_FALSE;
  step->turned = PETSC_FALSE;
  PetscCall(PetscArraycpy(units->y, t->to, units->n));
  PetscCall(FrictionProblemSetForces(&t->problem));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Changes the step from t->from if it is too long or too short: to its end without the slip that turned back,
   or to the part with the least energy, whichever has less. [in,out] step - residual */
static PetscErrorCode FrictionReducedSearch_Private(Reduced *t, FrictionStep *step)
{
  FrictionUnits *units = t->problem.units;
  PetscReal      slope[2], alpha, energy, work, *part, *whole;
  PetscBool      clipped;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(t->to, units->y, units->n));
  PetscCall(FrictionReducedSlopes_Private(t, slope));
  PetscCall(FrictionUnitsSearch(units, t->from, slope, &alpha, &energy));
  if (alpha == 1) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc2(units->n, &part, units->n, &whole));
  PetscCall(PetscArraycpy(whole, units->y, units->n));
  for (PetscInt i = 0; i < units->n; i++) part[i] = t->from[i] + alpha * (t->to[i] - t->from[i]);
  PetscCall(FrictionUnitsClip(units, t->from, t->to, &work));
  PetscCall(FrictionReducedSlopes_Private(t, slope));
  clipped = (PetscBool)(alpha > 0 && (slope[0] + slope[1]) / 2 + work <= energy);
  if (!clipped) {
    PetscCall(PetscArraycpy(units->y, part, units->n));
    PetscCall(FrictionProblemSetForces(&t->problem));
  }
  if (clipped || alpha < 1) PetscCall(FrictionUnitsEnd(units, t->from, &step->turned));
  PetscCall(PetscArraycpy(t->to, whole, units->n));
  PetscCall(PetscFree2(part, whole));
  if (alpha > 1) step->residual = PETSC_MAX_REAL;
  PetscCall(FrictionReducedCompare_Private(t, step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One step on the first rank. */
static PetscErrorCode FrictionReducedStepFirst_Private(FrictionMethod method, FrictionStep *step)
{
  Reduced       *t     = method->data;
  FrictionUnits *units = t->problem.units;
  FrictionReport count;

  PetscFunctionBeginUser;
  if (!method->plain && !method->decided) PetscCall(FrictionProblemSweep(&t->problem));
  if (!method->decided) PetscCall(FrictionUnitsDecide(units, &step->changed));
  FrictionUnitsProject(units, t->from);
  PetscCall(FrictionSystemSolve(&t->problem));
  PetscCall(FrictionUnitsResidual(units, t->rtol, &step->residual, &step->size));
  PetscCall(FrictionUnitsCount(units, &count, &step->closed));
  step->done       = (PetscBool)(step->residual <= t->rtol * step->size);
  step->iterations = 1;
  if (step->done) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FrictionReducedSearch_Private(t, step));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Step_Reduced(FrictionMethod method, FrictionStep *step)
{
  Reduced *t = method->data;

  PetscFunctionBeginUser;
  if (!t->rank) PetscCall(FrictionReducedStepFirst_Private(method, step));
  method->decided = PETSC_FALSE;
  PetscCallMPI(MPI_Bcast(step, sizeof(*step), MPI_BYTE, 0, method->pdas->set.comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Pivot_Reduced(FrictionMethod method, PetscBool last, PetscBool *done)
{
  Reduced *t = method->data;

  PetscFunctionBeginUser;
  *done = PETSC_FALSE;
  if (!t->rank) PetscCall(FrictionProblemPivot(&t->problem, last, done));
  PetscCallMPI(MPI_Bcast(done, 1, MPIU_BOOL, 0, method->pdas->set.comm));
  method->decided = *done;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Set_Reduced(FrictionMethod method, Vec y)
{
  const ActiveSet *set = &method->pdas->set;
  Reduced         *t   = method->data;
  PetscReal       *own;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(set->n, &own));
  PetscCall(ActiveSetGather(set, y, own));
  PetscCall(SchurSolverGather(method->solver, own, t->rank ? NULL : method->units.y));
  PetscCall(PetscFree(own));
  if (!t->rank) PetscCall(FrictionProblemSetForces(&t->problem));
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

static PetscErrorCode Get_Reduced(FrictionMethod method, Vec y)
{
  Reduced       *t = method->data;
  ActiveSolution solution;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolutionCreate(&method->pdas->set, &solution));
  PetscCall(FrictionReducedExpand_Private(method->pdas, method->solver, &t->problem, &solution, y));
  PetscCall(ActiveSolutionDestroy(&solution));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Computes all unknowns, and corrects the residual of the law with the forces of A. Collective. [out] y */
static PetscErrorCode FrictionReducedRefine_Private(PDAS *pdas, ActiveSolver solver, PetscMPIInt rank,
                                                    FrictionProblem *problem, Vec y)
{
  ActiveSolution solution;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolutionCreate(&pdas->set, &solution));
  for (PetscInt k = 0; k <= FRICTION_REFINEMENTS && !solution.failure; k++) {
    PetscCall(FrictionReducedExpand_Private(pdas, solver, problem, &solution, y));
    PetscCall(SchurSolverGather(solver, solution.r, rank ? NULL : problem->units->r));
    if (rank || k == FRICTION_REFINEMENTS) continue;
    for (PetscInt i = 0; i < problem->units->n; i++)
      problem->g[i] = problem->units->r[i]; // g = r + S y with the r of A
    PetscCall(FrictionProblemAddProduct(problem));
    PetscCall(FrictionSystemSolve(problem));
  }
  if (solution.failure) {
    pdas->failure   = solution.failure;
    pdas->converged = PETSC_FALSE;
  }
  PetscCall(ActiveSolutionDestroy(&solution));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode FrictionReducedGrow_Private(FrictionMethod method, const PetscReal v[], PetscReal w[])
{
  Reduced *t = method->data;

  return FrictionSystemGrow(&t->problem, v, w);
}

static PetscErrorCode Opens_Reduced(FrictionMethod method, PetscBool *opens)
{
  Reduced *t = method->data;

  PetscFunctionBeginUser;
  if (!t->rank) PetscCall(FrictionProblemOpens(&t->problem, opens));
  PetscCallMPI(MPI_Bcast(opens, 1, MPIU_BOOL, 0, method->pdas->set.comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks closed and sticking unknowns, and counts them. Collective. */
static PetscErrorCode FrictionReducedReport_Private(FrictionMethod method)
{
  Reduced        *t      = method->data;
  PDAS           *pdas   = method->pdas;
  FrictionReport *report = &pdas->friction_report;
  PetscInt        closed;
  PetscBool      *mark = NULL;
  PetscReal      *all  = NULL, *own;

  PetscFunctionBeginUser;
  report->coupling = report->turning = PETSC_MAX_REAL;
  PetscCall(PetscMalloc1(pdas->set.n, &own));
  if (!t->rank) {
    PetscCall(PetscMalloc2(method->units.n, &all, method->units.n, &mark));
    FrictionUnitsMark(&method->units, mark);
    for (PetscInt i = 0; i < method->units.n; i++) all[i] = mark[i] ? 1 : 0;
    PetscCall(FrictionUnitsCount(&method->units, report, &closed));
    PetscCall(FrictionSystemFactorGiven(&t->problem));
    PetscCall(FrictionSpectralRadius(method, FrictionReducedGrow_Private, NULL, 0, PETSC_MAX_REAL, report));
    report->coarser = PETSC_FALSE;
    if (pdas->coupling_needed) PetscCall(FrictionCoupling(&t->problem, report));
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
  PetscCall(PetscFree2(t->from, t->to));
  PetscCall(PetscFree(t));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Initial decisions from a given set. Not without displacements: then it is a guess of what touches. [in] y -
   initial guess */
static PetscErrorCode FrictionReducedBegin_Private(FrictionMethod method, Vec set, Vec y)
{
  const ActiveSet *bounded = &method->pdas->set;
  Reduced         *t       = method->data;
  PetscReal       *own, *given = NULL, largest;

  PetscFunctionBeginUser;
  PetscCall(VecNorm(y, NORM_INFINITY, &largest));
  if (largest == 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(bounded->n, &own));
  if (!t->rank) PetscCall(PetscMalloc1(method->units.n, &given));
  PetscCall(ActiveSetGather(bounded, set, own));
  PetscCall(SchurSolverGather(method->solver, own, given));
  if (!t->rank) FrictionUnitsBegin(&method->units, given);
  method->decided = PETSC_TRUE;
  PetscCall(PetscFree(own));
  PetscCall(PetscFree(given));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionReducedCreate(FrictionMethod method, Vec y)
{
  const ActiveSet   *set    = &method->pdas->set;
  const ActiveSolver solver = method->solver;
  Reduced           *t;
  PetscScalar       *S = NULL;
  PetscReal         *g = NULL;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&t));
  t->rtol         = PetscMax(FRICTION_RTOL, method->rtol);
  method->data    = t;
  method->step    = Step_Reduced;
  method->pivot   = Pivot_Reduced;
  method->get     = Get_Reduced;
  method->set     = Set_Reduced;
  method->finish  = Finish_Reduced;
  method->destroy = Destroy_Reduced;
  method->opens   = Opens_Reduced;
  PetscCallMPI(MPI_Comm_rank(set->comm, &t->rank));
  PetscCall(FrictionUnitsGather(set, method->pdas->law, &method->units));
  PetscCall(SchurSolverGetReduced(solver, &S, &g));
  PetscCall(FrictionProblemCreate(&method->units, S, &t->problem));
  PetscCall(PetscMalloc2(method->units.n, &t->from, method->units.n, &t->to));
  if (!t->rank) PetscCall(PetscArraycpy(t->problem.g, g, method->units.n));
  PetscCall(Set_Reduced(method, y));
  if (method->pdas->previous) PetscCall(FrictionReducedBegin_Private(method, method->pdas->previous, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}
