/* truncated.c -- one linear system per active set, at full size, by whatever KSP the user chose.

   The rows and columns of fixed unknowns are emptied and keep only their own diagonal A_ii (not 1: the spectrum stays
   what it was), so size, layout and block structure never change and a preconditioner sees a matrix like A:
       A^ d = f,   y = v + d,   A^ = M A M + (1 - M) diag(A),   f = M (b - A v),
   with M = 0 on fixed unknowns, 1 elsewhere, and v the prescribed values, 0 elsewhere. Near null vectors are emptied at
   fixed unknowns as well: what a preconditioner takes for a rigid motion must be one of A^. */
#include "active.h"
#include "factor.h"
#include "multigrid.h"

/* Solves on the residual after the first: each gains the digits of one solve; what does not get there in so many will
   not. */
static const PetscInt MAX_REFINEMENTS = 8;
/* A solve that leaves more than this part of the residual is no progress. */
static const PetscReal STALLED = 0.5;
/* What rounding leaves of the forces that displacements alone would need. */
static const PetscReal ROUNDING = 16 * PETSC_MACHINE_EPSILON;

typedef struct {
  KSP       ksp;    /* referenced: a SNES destroys its own before what was kept with it */
  PC        pc;     /* of it */
  Mat       A;      /* A^ */
  Vec       free;   /* M */
  Vec       y, r;   /* the solution; b - A y */
  Vec       f, d;   /* M r; correction, A^^-1 f */
  PetscBool same;   /* M is what A^ was made for */
  PetscBool direct; /* the KSP only applies its preconditioner */
  PetscBool shell;  /* A^ is the preconditioner's own: no copy of A */
  PetscReal rtol;   /* of the KSP, for the last solve of an inequality */
  PetscReal ritz;   /* the smallest Ritz value of all systems, 0 if there is none */
} Truncated;

/* M, the last solution emptied where fixed as first guess d, and y = v. */
static PetscErrorCode Prescribe_Private(ActiveSolver solver, const PetscBool fixed[], const PetscReal value[],
                                        ActiveSolution *solution)
{
  Truncated       *t   = solver->data;
  const ActiveSet *set = solver->set;
  PetscScalar     *free, *y;

  PetscFunctionBeginUser;
  PetscCall(VecGetArray(t->free, &free));
  for (PetscInt i = 0; i < set->n; i++) {
    const PetscScalar now = fixed[i] ? 0 : 1;

    if (free[set->dof[i] - set->dof_begin] != now) t->same = PETSC_FALSE;
    free[set->dof[i] - set->dof_begin] = now;
  }
  PetscCall(VecRestoreArray(t->free, &free));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &t->same, 1, MPIU_BOOL, MPI_LAND, set->comm));
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

/* A^ gets the near null space of A, emptied where fixed and made orthonormal again. */
static PetscErrorCode NearNullSpace_Private(ActiveSolver solver)
{
  static const PetscReal DEPENDENT = 1e-8; /* shorter than this after projection: nothing of the motion is left */
  Truncated             *t         = solver->data;
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
    if (norm > DEPENDENT) kept++;
  }
  PetscCall(MatNullSpaceCreate(PetscObjectComm((PetscObject)solver->A), PETSC_FALSE, kept, own, &space));
  PetscCall(MatSetNearNullSpace(t->A, space));
  PetscCall(MatNullSpaceDestroy(&space));
  PetscCall(VecDestroyVecs(n, &own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A^ for the present M. Scaling by M from both sides empties rows and columns without talking to other ranks about them
   and without touching the pattern; A itself is never written to. */
static PetscErrorCode Copy_Private(ActiveSolver solver)
{
  Truncated *t = solver->data;

  PetscFunctionBeginUser;
  PetscCall(MatCopy(solver->A, t->A, SAME_NONZERO_PATTERN));
  PetscCall(MatDiagonalScale(t->A, t->free, t->free));
  PetscCall(VecPointwiseMult(t->f, t->free, solver->diag));
  PetscCall(VecAYPX(t->f, -1, solver->diag));
  PetscCall(MatDiagonalSet(t->A, t->f, ADD_VALUES));
  PetscCall(MatSetOption(t->A, MAT_SPD, PETSC_TRUE));
  PetscCall(NearNullSpace_Private(solver));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A^ for the present M, by whatever makes it. */
static PetscErrorCode Matrix_Private(ActiveSolver solver)
{
  Truncated *t = solver->data;

  PetscFunctionBeginUser;
  if (t->same) PetscFunctionReturn(PETSC_SUCCESS);
  if (t->shell)
    PetscCall(MultigridSetFree(t->pc, t->free));
  else
    PetscCall(Copy_Private(solver));
  PetscCall(KSPSetOperators(t->ksp, t->A, t->A));
  t->same = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How small the eigenvalues of B A^ are: what an iteration has seen of them, from above. */
static PetscErrorCode Ritz_Private(Truncated *t)
{
  PetscReal largest, smallest;

  PetscFunctionBeginUser;
  if (t->direct) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(KSPComputeExtremeSingularValues(t->ksp, &largest, &smallest));
  if (smallest > 0 && (t->ritz == 0 || smallest < t->ritz)) t->ritz = smallest;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* d = A^^-1 f; iterative solvers may begin at d. */
static PetscErrorCode Correct_Private(ActiveSolver solver, PetscBool guess, ActiveSolution *solution)
{
  Truncated         *t = solver->data;
  KSPConvergedReason reason;
  PCFailedReason     failed;
  PetscInt           its;
  int                error;

  PetscFunctionBeginUser;
  PetscCall(KSPSetInitialGuessNonzero(t->ksp, guess));
  if (t->shell) PetscCall(MultigridWatch(t->pc));
  PetscCall(KSPSolve(t->ksp, t->f, t->d));
  PetscCall(KSPGetIterationNumber(t->ksp, &its));
  solution->iterations += its;
  PetscCall(KSPGetConvergedReason(t->ksp, &reason));
  if (its > 0) PetscCall(Ritz_Private(t));
  if (reason >= 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(FactorCheckMemory(t->ksp));
  PetscCall(PCGetFailedReason(t->pc, &failed));
  error = (int)failed;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &error, 1, MPI_INT, MPI_MAX, solver->set->comm));
  /* the first members of PCFailedReason are those of MatFactorError */
  solution->failure = error > 0 ? ActiveFailureOfFactor((MatFactorError)error) : FAILURE_ITERATIVE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether no free unknown with a bound has a force beside those of fixed ones, or rounding: it would count as pressure or tension. */
static PetscErrorCode Forceless_Private(ActiveSolver solver, const PetscBool fixed[], PetscBool *forceless)
{
  static const PetscReal NO_FORCE = 1e-8;
  const Truncated       *t        = solver->data;
  const ActiveSet       *set      = solver->set;
  const PetscScalar     *r;
  PetscReal largest, max[3] = {0, 0, 0}; /* forces of free ones, of fixed ones; the stiffest of free ones */

  PetscFunctionBeginUser;
  PetscCall(VecNorm(t->y, NORM_INFINITY, &largest));
  PetscCall(VecGetArrayRead(t->r, &r));
  for (PetscInt i = 0; i < set->n; i++) {
    const int which = fixed[i] ? 1 : 0;

    max[which] = PetscMax(max[which], PetscAbsScalar(r[set->dof[i] - set->dof_begin]));
    if (!fixed[i]) max[2] = PetscMax(max[2], set->diag[i]);
  }
  PetscCall(VecRestoreArrayRead(t->r, &r));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, max, 3, MPIU_REAL, MPI_MAX, set->comm));
  *forceless = (PetscBool)(max[0] <= PetscMax(PetscMax(NO_FORCE, solver->rtol) * max[1], ROUNDING * max[2] * largest));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How far the KSP goes: a little further than it has to, since it measures residuals in its own way.
   [in] k - solves before, for the same set; [in] left - part of the residual that they should have left */
static PetscErrorCode Tolerance_Private(ActiveSolver solver, PetscInt k, PetscReal left)
{
  static const PetscReal FURTHER = 0.5, A_LITTLE = 0.05;
  Truncated             *t    = solver->data;
  PetscReal              rtol = t->rtol;

  PetscFunctionBeginUser;
  if (solver->target > solver->rtol) rtol = FURTHER * solver->target;
  if (solver->inexact && k) rtol = PetscMax(t->rtol, PetscMin(A_LITTLE, FURTHER * left));
  PetscCall(KSPSetTolerances(t->ksp, rtol, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the solution is what multigrid is asked for in the end. The residual has to be small beside the forces in the bodies: supports
   that move a body far make a large first residual of next to no force; and the error beside the solution in the norm of energy, since
   residuals say little of errors that are smooth. What rounding leaves is small in any case.
   [in] size - of the residual; [in,out] eta - the same by the first one, and by the forces; [out] left - part of it that may be left */
static PetscErrorCode Exact_Private(ActiveSolver solver, PetscReal first, PetscReal size, PetscReal *eta,
                                    PetscReal *left, PetscBool *exact)
{
  static const PetscReal PART = 0.5; /* of rtol, for the energy: what is said of it is an estimate */
  Truncated             *t    = solver->data;
  PetscReal              forces, energy, error;
  PetscScalar            square;

  PetscFunctionBeginUser;
  PetscCall(MultigridForces(t->pc, t->y, &forces, &energy));
  PetscCall(MultigridGetError(t->pc, &error));
  PetscCall(VecPointwiseMult(t->d, solver->diag, t->y));
  PetscCall(VecDot(t->d, t->y, &square));
  *eta   = size / PetscMax(PetscMin(first, forces), ROUNDING / solver->rtol * PetscSqrtReal(PetscRealPart(square)));
  *left  = solver->rtol / *eta;
  *exact = (PetscBool)(*eta <= solver->rtol);
  if (t->ritz > 0) error /= t->ritz;
  energy *= PetscSqr(PART * solver->rtol);
  PetscCall(
      PetscInfo(t->ksp, "energy of the error %g, asked %g, eta %g\n", (double)error, (double)energy, (double)*eta));
  if (error > energy) {
    if (error < PETSC_MAX_REAL) *left = PetscMin(*left, PetscSqrtReal(energy / error));
    *exact = PETSC_FALSE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Solve_Truncated(ActiveSolver solver, const PetscBool fixed[], const PetscReal value[],
                                      ActiveSolution *solution)
{
  Truncated      *t    = solver->data;
  const PetscBool last = (PetscBool)(solver->target <= solver->rtol);
  PetscReal       first, size = 0, left = 1;
  PetscBool       done = PETSC_FALSE, suffices;

  PetscFunctionBeginUser;
  solution->iterations = 0;
  solution->eta        = 0;
  PetscCall(Prescribe_Private(solver, fixed, value, solution));
  PetscCall(Matrix_Private(solver));
  PetscCall(ActiveSolverResidual(solver, fixed, t->y, t->r, t->f, &first));
  for (PetscInt k = 0; k <= MAX_REFINEMENTS && first > 0 && !done; k++) {
    const PetscReal before = k ? solution->eta : PETSC_MAX_REAL;

    PetscCall(Tolerance_Private(solver, k, left));
    PetscCall(Correct_Private(solver, (PetscBool)(k == 0 && !t->direct), solution));
    if (solution->failure) { // nothing of it is worth to begin with
      PetscCall(VecZeroEntries(t->y));
      t->ritz = 0;
      PetscFunctionReturn(PETSC_SUCCESS);
    }
    PetscCall(VecPointwiseMult(t->d, t->d, t->free)); /* a preconditioner may have leaked into fixed unknowns */
    PetscCall(VecAXPY(t->y, 1, t->d));
    PetscCall(ActiveSolverResidual(solver, fixed, t->y, t->r, t->f, &size));
    solution->eta = size / first;
    left          = solver->target / solution->eta;
    /* a direct solver gets to roundoff, not just below a tolerance, for the price of one more substitution */
    done = (PetscBool)(solution->eta <= solver->target && (!t->direct || k));
    if (solver->enough > 0) break;
    if (t->shell && last) PetscCall(Exact_Private(solver, first, size, &solution->eta, &left, &done));
    if (done && last) PetscCall(Forceless_Private(solver, fixed, &done));
    if (!(solution->eta <= STALLED * before)) break;
  }
  if (!(solution->eta <= solver->target)) {
    PetscCall(ActiveSolverSuffices(solver, t->y, size, size / solution->eta, &suffices));
    if (!suffices) solution->failure = solver->factored ? FAILURE_RESIDUAL : FAILURE_ITERATIVE;
  }
  PetscCall(ActiveSolverRestrict(solver, t->y, t->r, t->f, solution));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Correct_Truncated(ActiveSolver solver, Vec f, Vec d, PetscReal *alpha)
{
  Truncated *t = solver->data;

  PetscFunctionBeginUser;
  PetscCall(KSPSetUp(t->ksp));
  PetscCall(PCApply(t->pc, f, d));
  PetscCall(VecPointwiseMult(d, d, t->free));
  *alpha = solver->factored ? 1 : t->ritz;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Load_Truncated(ActiveSolver solver, Vec b, Vec y)
{
  Truncated *t = solver->data;

  PetscFunctionBeginUser;
  solver->b = b;
  PetscCall(VecCopy(y, t->y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The last solve has it all. */
static PetscErrorCode Finish_Truncated(ActiveSolver solver, ActiveSolution *solution, Vec y)
{
  Truncated *t = solver->data;

  PetscFunctionBeginUser;
  (void)solution;
  PetscCall(VecCopy(t->y, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Truncated(ActiveSolver solver)
{
  Truncated *t = solver->data;

  PetscFunctionBeginUser;
  PetscCall(KSPSetTolerances(t->ksp, t->rtol, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPSetInitialGuessNonzero(t->ksp, PETSC_FALSE)); // others may use it afterwards
  PetscCall(KSPDestroy(&t->ksp));
  PetscCall(MatDestroy(&t->A));
  PetscCall(VecDestroy(&t->free));
  PetscCall(VecDestroy(&t->y));
  PetscCall(VecDestroy(&t->r));
  PetscCall(VecDestroy(&t->f));
  PetscCall(VecDestroy(&t->d));
  PetscCall(PetscFree(t));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TruncatedCreate(const ActiveSet *set, Mat A, Vec b, Vec y, KSP ksp, PetscReal rtol, ActiveSolver *solver)
{
  Truncated *t;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolverCreate(set, A, b, rtol, solver));
  PetscCall(PetscNew(&t));
  PetscCall(PetscObjectReference((PetscObject)ksp));
  t->ksp = ksp;
  PetscCall(PetscObjectTypeCompare((PetscObject)ksp, KSPPREONLY, &t->direct));
  /* an interpolation made for another set is not a preconditioner for this one: it need not even be definite */
  PetscCall(KSPGetPC(ksp, &t->pc));
  PetscCall(PetscObjectTypeCompareAny((PetscObject)t->pc, &(*solver)->factored, PCCHOLESKY, PCLU, ""));
  PetscCall(PCGAMGSetReuseInterpolation(t->pc, PETSC_FALSE));
  PetscCall(KSPSetComputeSingularValues(ksp, (PetscBool)!t->direct));
  PetscCall(PetscObjectTypeCompare((PetscObject)t->pc, PCTRUNCATEDMG, &t->shell));
  PetscCall(KSPGetTolerances(ksp, &t->rtol, NULL, NULL, NULL));
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
  (*solver)->data    = t;
  (*solver)->solve   = Solve_Truncated;
  (*solver)->load    = Load_Truncated;
  (*solver)->finish  = Finish_Truncated;
  (*solver)->correct = Correct_Truncated;
  (*solver)->destroy = Destroy_Truncated;
  PetscFunctionReturn(PETSC_SUCCESS);
}
