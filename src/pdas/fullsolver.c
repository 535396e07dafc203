/* fullsolver.c -- one linear system per active set at full size, by the user's KSP.

   Rows and columns of fixed unknowns are emptied and keep their diagonal A_ii (not 1: the spectrum stays).
   Size, layout and block structure never change, and a preconditioner sees a matrix like A:

       A^ d = f,   y = v + d,   A^ = M A M + (1 - M) diag(A),   f = M (b - A v),

   with M = 0 on fixed unknowns, 1 elsewhere, and v the prescribed values, 0 elsewhere. The near null space is
   emptied at fixed unknowns as well: its vectors must be rigid body modes of A^. */
#include "pdas/factorization.h"
#include "multigrid/multigrid.h"
#include "pdas/fullsolver.h"

/* Refinements after the first solve: each gains the digits of one solve. */
static const PetscInt FULL_REFINEMENTS = 8;
/* Iterations after which the recursive residual of conjugate gradients has drifted: they restart with the
   true one. */
static const PetscInt RESTART_ITERATIONS = 50;
/* Largest number of indefinite cycles in one system, after each of which steps are shortened. */
enum { MAX_STEP_REDUCTIONS = 3 };
/* Stagnation: a solve that leaves more than this part of the residual. */
static const PetscReal STAGNATION = 0.5;
/* Sets M. */
static PetscErrorCode FullSolverSetFree_Private(ActiveSolver solver, const PetscBool fixed[])
{
  FullSolver      *t   = solver->data;
  const ActiveSet *set = solver->set;
  PetscScalar     *free;

  PetscFunctionBeginUser;
  PetscCall(VecGetArray(t->free, &free));
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscScalar now = fixed[i] ? 0 : 1;

    if (free[set->dof[i] - set->dof_begin] != now) t->same = PETSC_FALSE;
    free[set->dof[i] - set->dof_begin] = now;
  }
  PetscCall(VecRestoreArray(t->free, &free));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &t->same, 1, MPIU_BOOL, MPI_LAND, set->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets M, y = v, and the last solution, emptied where fixed, as initial guess of d. */
static PetscErrorCode FullSolverPrescribe_Private(ActiveSolver solver, const PetscBool fixed[], const PetscReal value[],
                                                  ActiveSolution *solution)
{
  FullSolver      *t   = solver->data;
  const ActiveSet *set = solver->set;
  PetscScalar     *y;

  PetscFunctionBeginUser;
  PetscCall(FullSolverSetFree_Private(solver, fixed));
  PetscCall(VecPointwiseMult(t->d, t->y, t->free));
  PetscCall(VecSet(t->y, 0));
  PetscCall(VecGetArray(t->y, &y));
  for (PetscInt i = 0; i < set->n; i++) {
    solution->fixed[i] = fixed[i];
    if (fixed[i]) y[set->dof[i] - set->dof_begin] = solution->y[i] = value[i];
  }
  PetscCall(VecRestoreArray(t->y, &y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Near null space of A^: that of A, emptied where fixed and orthonormalized. */
static PetscErrorCode FullSolverNearNullSpace_Private(ActiveSolver solver)
{
  static const PetscReal DEPENDENT_MODE = 1e-8; /* length after projection below which a mode is dependent */
  FullSolver            *t              = solver->data;
  MatNullSpace           space;
  const Vec             *vecs;
  Vec                   *own;
  PetscInt               n, kept = 0;

  PetscFunctionBeginUser;
  PetscCall(MatGetNearNullSpace(solver->A, &space));
  if (!space) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatNullSpaceGetVecs(space, NULL, &n, &vecs));
  PetscCall(VecDuplicateVecs(t->y, n, &own));
  for (PetscInt i = 0; i < n; i++) {
    PetscReal norm;

    PetscCall(VecPointwiseMult(own[kept], vecs[i], t->free));
    for (PetscInt j = 0; j < kept; j++) {
      PetscScalar dot;

      PetscCall(VecDot(own[kept], own[j], &dot));
      PetscCall(VecAXPY(own[kept], -dot, own[j]));
    }
    PetscCall(VecNormalize(own[kept], &norm));
    if (norm > DEPENDENT_MODE) kept++;
  }
  PetscCall(MatNullSpaceCreate(PetscObjectComm((PetscObject)solver->A), PETSC_FALSE, kept, own, &space));
  PetscCall(MatSetNearNullSpace(t->A, space));
  PetscCall(MatNullSpaceDestroy(&space));
  PetscCall(VecDestroyVecs(n, &own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A^ for the present M. Scaling by M from both sides empties rows and columns without communication and
   without changing the pattern; A is not written to. */
static PetscErrorCode FullSolverSetMatrix_Private(ActiveSolver solver)
{
  FullSolver *t = solver->data;

  PetscFunctionBeginUser;
  PetscCall(MatCopy(solver->A, t->A, SAME_NONZERO_PATTERN));
  PetscCall(MatDiagonalScale(t->A, t->free, t->free));
  PetscCall(VecPointwiseMult(t->f, t->free, solver->diag));
  PetscCall(VecAYPX(t->f, -1, solver->diag));
  PetscCall(MatDiagonalSet(t->A, t->f, ADD_VALUES));
  PetscCall(MatSetOption(t->A, MAT_SPD, PETSC_TRUE));
  PetscCall(FullSolverNearNullSpace_Private(solver));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A^ for the present M, a copy or the operator of multigrid. */
static PetscErrorCode FullSolverUpdateMatrix_Private(ActiveSolver solver, Mat more)
{
  FullSolver *t = solver->data;

  PetscFunctionBeginUser;
  if (t->same) PetscFunctionReturn(PETSC_SUCCESS);
  if (t->shell)
    PetscCall(MultigridSetFree(t->pc, t->free, more));
  else
    PetscCall(FullSolverSetMatrix_Private(solver));
  PetscCall(KSPSetOperators(t->ksp, t->A, t->A));
  t->same = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FullSolverSetFixed(ActiveSolver solver, const PetscBool fixed[], Mat more)
{
  FullSolver *t = solver->data;

  PetscFunctionBeginUser;
  PetscCall(FullSolverSetFree_Private(solver, fixed));
  if (more) t->same = PETSC_FALSE;
  PetscCall(FullSolverUpdateMatrix_Private(solver, more));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* d = A^^-1 f; iterative solvers may begin at d. */
static PetscErrorCode FullSolverCorrect_Private(ActiveSolver solver, PetscBool guess, ActiveSolution *solution)
{
  FullSolver        *t = solver->data;
  KSPConvergedReason reason;
  PCFailedReason     failed;
  PetscInt           its;
  int                error;

  PetscFunctionBeginUser;
  PetscCall(KSPSetInitialGuessNonzero(t->ksp, guess));
  for (PetscInt k = 0;; k++) {
    PetscCall(KSPSolve(t->ksp, t->f, t->d));
    PetscCall(KSPGetIterationNumber(t->ksp, &its));
    solution->iterations += its;
    PetscCall(KSPGetConvergedReason(t->ksp, &reason));
    if (reason != KSP_DIVERGED_INDEFINITE_PC || !t->asked || k == MAX_STEP_REDUCTIONS) break;
    PetscCall(MultigridShortenSteps(t->pc));
    PetscCall(MultigridResetError(t->pc));
  }
  PetscCall(FullSolverUpdateRitz(t));
  if (reason >= 0) PetscFunctionReturn(PETSC_SUCCESS);
  if (t->over) {
    solution->failure = FAILURE_COST;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(MumpsMemoryCheck(t->ksp));
  PetscCall(PCGetFailedReason(t->pc, &failed));
  error = (int)failed;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &error, 1, MPI_INT, MPI_MAX, solver->set->comm));
  /* the first members of PCFailedReason are those of MatFactorError */
  solution->failure = error > 0 ? ActiveSolverFailureOfFactor((MatFactorError)error) : FAILURE_ITERATIVE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Tolerance of a KSP without multigrid: a little smaller than necessary, since it measures residuals in its
   own norm. */
static PetscErrorCode FullSolverTolerance_Private(ActiveSolver solver)
{
  static const PetscReal KSP_MARGIN = 0.5;
  FullSolver            *t          = solver->data;
  const PetscReal        rtol       = solver->target > solver->rtol ? KSP_MARGIN * solver->target : t->rtol;

  PetscFunctionBeginUser;
  PetscCall(KSPSetTolerances(t->ksp, rtol, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One call of the KSP, and the residual after it. [in] k - calls before, for the same set; [in] first - |f|_D
   before all of them; [out] done - whether the residual is small enough or minimal */
static PetscErrorCode FullSolverCallKSP_Private(ActiveSolver solver, PetscInt k, PetscReal first,
                                                ActiveSolution *solution, PetscBool *done)
{
  FullSolver *t = solver->data;
  PetscReal   size;

  PetscFunctionBeginUser;
  PetscCall(t->asked ? ConvergenceBegin(solver, first, solution) : FullSolverTolerance_Private(solver));
  PetscCall(FullSolverCorrect_Private(solver, (PetscBool)(t->asked || (k == 0 && !t->direct)), solution));
  if (solution->failure) PetscFunctionReturn(PETSC_SUCCESS);
  if (t->asked) {
    PetscCall(ConvergenceFinish(solver));
    *done = (PetscBool)(t->done && (k || solution->iterations <= RESTART_ITERATIONS));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(VecPointwiseMult(t->d, t->d, t->free)); /* a preconditioner may have leaked into fixed unknowns */
  PetscCall(VecAXPY(t->y, 1, t->d));
  PetscCall(ActiveSolverResidual(solver, solution->fixed, t->y, t->r, t->f, &size));
  solution->eta = size / first;
  /* a direct solver reaches roundoff for one more substitution */
  *done = (PetscBool)(solution->eta <= solver->target && (!t->direct || k));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Solve_FullSolver(ActiveSolver solver, const PetscBool fixed[], const PetscReal value[],
                                       ActiveSolution *solution)
{
  FullSolver *t = solver->data;
  Hierarchy   hierarchy;
  PetscReal   first;
  PetscBool   done = PETSC_FALSE, suffices;

  PetscFunctionBeginUser;
  solution->iterations = 0;
  solution->eta        = 0;
  t->confirmed         = PETSC_FALSE;
  PetscCall(FullSolverPrescribe_Private(solver, fixed, value, solution));
  PetscCall(FullSolverUpdateMatrix_Private(solver, NULL));
  PetscCall(ActiveSolverResidual(solver, fixed, t->y, t->r, t->f, &first));
  if (t->shell) {
    PetscCall(MultigridAddWork(t->pc));
    PetscCall(MultigridGetHierarchy(t->pc, &hierarchy));
    hierarchy->num_systems++;
  }
  for (PetscInt k = 0; k <= FULL_REFINEMENTS && first > 0 && !done; k++) {
    const PetscReal before = k ? solution->eta : PETSC_MAX_REAL;

    PetscCall(FullSolverCallKSP_Private(solver, k, first, solution, &done));
    if (solution->failure) { // a failed solution is no initial guess
      PetscCall(VecZeroEntries(t->y));
      t->ritz = 0;
      PetscFunctionReturn(PETSC_SUCCESS);
    }
    if (!(solution->eta <= STAGNATION * before)) break;
  }
  if (!(solution->eta <= solver->target)) {
    PetscCall(ActiveSolverSuffices(solver, t->y, solution->eta * first, first, &suffices));
    if (!suffices) solution->failure = solver->factored ? FAILURE_RESIDUAL : FAILURE_ITERATIVE;
  }
  PetscCall(ActiveSolverRestrict(solver, t->y, t->r, t->asked && first > 0 ? t->rest : t->f, solution));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Correct_FullSolver(ActiveSolver solver, Vec f, Vec d, PetscReal *alpha)
{
  FullSolver *t = solver->data;

  PetscFunctionBeginUser;
  PetscCall(KSPSetUp(t->ksp));
  PetscCall(PCApply(t->pc, f, d));
  PetscCall(VecPointwiseMult(d, d, t->free));
  *alpha = solver->factored ? 1 : t->ritz;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Load_FullSolver(ActiveSolver solver, Vec b, Vec y)
{
  FullSolver *t = solver->data;

  PetscFunctionBeginUser;
  solver->b = b;
  PetscCall(VecCopy(y, t->y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The last solve has computed y. */
static PetscErrorCode Finish_FullSolver(ActiveSolver solver, ActiveSolution *solution, Vec y)
{
  FullSolver *t = solver->data;

  PetscFunctionBeginUser;
  (void)solution;
  PetscCall(VecCopy(t->y, y));
  PetscCall(VecDestroy(&t->rest)); // room for the error bound; the next system makes another one
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_FullSolver(ActiveSolver solver)
{
  FullSolver *t = solver->data;

  PetscFunctionBeginUser;
  PetscCall(KSPSetTolerances(t->ksp, t->rtol, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPSetInitialGuessNonzero(t->ksp, PETSC_FALSE)); // the KSP may serve others afterwards
  if (t->asked) PetscCall(ConvergenceUnsetTest(t));
  PetscCall(KSPDestroy(&t->ksp));
  PetscCall(MatDestroy(&t->A));
  PetscCall(VecDestroy(&t->free));
  PetscCall(VecDestroy(&t->y));
  PetscCall(VecDestroy(&t->r));
  PetscCall(VecDestroy(&t->f));
  PetscCall(VecDestroy(&t->d));
  PetscCall(VecDestroy(&t->rest));
  PetscCall(PetscFree(t));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FullSolverCreate(const ActiveSet *set, Mat A, Vec b, Vec y, KSP ksp, PetscReal rtol,
                                ActiveSolver *solver)
{
  FullSolver *t;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolverCreate(set, A, b, rtol, solver));
  PetscCall(PetscNew(&t));
  PetscCall(PetscObjectReference((PetscObject)ksp));
  t->ksp = ksp;
  PetscCall(PetscObjectTypeCompare((PetscObject)ksp, KSPPREONLY, &t->direct));
  /* an interpolation for another set need not even be definite for this one */
  PetscCall(KSPGetPC(ksp, &t->pc));
  PetscCall(PetscObjectTypeCompareAny((PetscObject)t->pc, &(*solver)->factored, PCCHOLESKY, PCLU, ""));
  PetscCall(PCGAMGSetReuseInterpolation(t->pc, PETSC_FALSE));
  PetscCall(KSPSetComputeSingularValues(ksp, (PetscBool)!t->direct));
  PetscCall(PetscObjectTypeCompare((PetscObject)t->pc, PCTRUNCATEDMG, &t->shell));
  PetscCall(KSPGetTolerances(ksp, &t->rtol, NULL, NULL, NULL));
  t->asked           = (PetscBool)(t->shell && !t->direct);
  (*solver)->inexact = t->shell;
  if (t->shell) {
    PetscCall(MultigridGetOperator(t->pc, &t->A));
    PetscCall(PetscObjectReference((PetscObject)t->A));
  } else {
    PetscCall(MatDuplicate(A, MAT_DO_NOT_COPY_VALUES, &t->A));
  }
  PetscCall(VecDuplicate(b, &t->y));
  PetscCall(VecCopy(y, t->y));
  PetscCall(VecDuplicate(b, &t->free));
  PetscCall(VecSet(t->free, 1));
  PetscCall(VecDuplicate(b, &t->r));
  PetscCall(VecDuplicate(b, &t->f));
  PetscCall(VecDuplicate(b, &t->d));
  (*solver)->data = t;
  if (t->asked) PetscCall(ConvergenceSetTest(*solver));
  (*solver)->solve   = Solve_FullSolver;
  (*solver)->load    = Load_FullSolver;
  (*solver)->finish  = Finish_FullSolver;
  (*solver)->correct = Correct_FullSolver;
  (*solver)->destroy = Destroy_FullSolver;
  PetscFunctionReturn(PETSC_SUCCESS);
}
