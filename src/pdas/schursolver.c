/* schursolver.c -- the Schur complement: all active sets by one factorization.

   With C the bounded unknowns and I the others, (A y - b)_I = 0 leaves

       S y_C - g = -r_C,    S = A_CC - A_CI A_II^-1 A_IC,    g = b_C - A_CI A_II^-1 b_I,

   a small dense problem with the same solutions and forces for every set. MUMPS computes S while it factors
   A_II. Each set then costs a dense Cholesky factorization of S_FF, F = C without the set, on the first rank.
   The full solution is recovered once, at the end, by substitutions with A_II.

   S is stored on the first rank alone; all ranks factor A_II (factorization.h). */
#include "pdas/pdasimpl.h"
#include "pdas/factorization.h"

/* A pivot below this part of the diagonal of A, times the number of unknowns, is zero up to roundoff. */
static const PetscReal SINGULAR = 8 * PETSC_MACHINE_EPSILON;
/* Refinements: one reaches roundoff; two that do not mean another cause. */
static const PetscInt SCHUR_REFINEMENTS = 2;

typedef struct {
  Factorization F;       /* of A_II */
  Vec           r, f, d; /* residual; the same without fixed rows; correction */
  PetscReal     size;    /* max |A_II^-1 b_I|: size of the displacements */
  PetscMPIInt   rank;
  PetscMPIInt  *counts, *offsets; /* bounded unknowns of each rank; on the first rank only, as all below */
  Mat           S, L;             /* dense; L with L L' = S_FF, NULL if F is empty */
  Vec           g, y, r_C;        /* the small problem; values and forces of all bounded unknowns */
  PetscReal    *diag;             /* of A [N] */
  PetscBool    *fixed;            /* [N] */
  IS            free;             /* F */
} SchurSolver;

PetscErrorCode SchurSolverGather(ActiveSolver solver, const PetscReal own[], PetscReal all[])
{
  const SchurSolver *t = solver->data;
  PetscMPIInt        n;

  PetscFunctionBeginUser;
  PetscCall(PetscMPIIntCast(solver->set->n, &n));
  PetscCallMPI(MPI_Gatherv(own, n, MPIU_REAL, all, t->counts, t->offsets, MPIU_REAL, 0, solver->set->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SchurSolverScatter(ActiveSolver solver, const PetscReal all[], PetscReal own[])
{
  const SchurSolver *t = solver->data;
  PetscMPIInt        n;

  PetscFunctionBeginUser;
  PetscCall(PetscMPIIntCast(solver->set->n, &n));
  PetscCallMPI(MPI_Scatterv(all, t->counts, t->offsets, MPIU_REAL, own, n, MPIU_REAL, 0, solver->set->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The same with vectors of the first rank. [in] all - NULL on other ranks */
static PetscErrorCode SchurSolverToFirst_Private(ActiveSolver solver, const PetscReal own[], Vec all)
{
  PetscScalar *a = NULL;

  PetscFunctionBeginUser;
  if (all) PetscCall(VecGetArray(all, &a));
  PetscCall(SchurSolverGather(solver, own, a));
  if (all) PetscCall(VecRestoreArray(all, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SchurSolverFromFirst_Private(ActiveSolver solver, Vec all, PetscReal own[])
{
  const PetscScalar *a = NULL;

  PetscFunctionBeginUser;
  if (all) PetscCall(VecGetArrayRead(all, &a));
  PetscCall(SchurSolverScatter(solver, a, own));
  if (all) PetscCall(VecRestoreArrayRead(all, &a));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets F from t->fixed, and L. [out] definite - whether S_FF is positive definite beyond roundoff. First rank
   only. */
static PetscErrorCode SchurSolverDenseFactor_Private(SchurSolver *t, PetscInt N, PetscBool *definite)
{
  const PetscScalar *l;
  PetscErrorCode     error;
  PetscInt          *F, n = 0;

  PetscFunctionBeginUser;
  PetscCall(ISDestroy(&t->free));
  PetscCall(MatDestroy(&t->L));
  PetscCall(PetscMalloc1(N, &F));
  for (PetscInt i = 0; i < N; i++) {
    if (!t->fixed[i]) F[n++] = i;
  }
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, n, F, PETSC_COPY_VALUES, &t->free));
  *definite = PETSC_TRUE;
  if (n) {
    PetscCall(MatCreateSubMatrix(t->S, t->free, t->free, MAT_INITIAL_MATRIX, &t->L));
    PetscCall(MatSetOption(t->L, MAT_SPD, PETSC_TRUE));
    /* PETSc treats a pivot that is not positive as an error; here it is an answer */
    PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
    error = MatCholeskyFactor(t->L, NULL, NULL);
    PetscCall(PetscPopErrorHandler());
    *definite = (PetscBool)!error;
    PetscCall(MatDenseGetArrayRead(t->L, &l));
    for (PetscInt k = 0; k < n && *definite; k++) {
      if (!(PetscSqr(PetscRealPart(l[k * n + k])) > SINGULAR * (PetscReal)N * t->diag[F[k]])) *definite = PETSC_FALSE;
    }
    PetscCall(MatDenseRestoreArrayRead(t->L, &l));
  }
  PetscCall(PetscFree(F));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* w_F = S_FF^-1 w_F, 0 elsewhere. First rank only. */
static PetscErrorCode SchurSolverDenseSolve_Private(SchurSolver *t, Vec w)
{
  Vec from, to;

  PetscFunctionBeginUser;
  if (t->L) {
    PetscCall(MatCreateVecs(t->L, &from, &to));
    PetscCall(VecISCopy(w, t->free, SCATTER_REVERSE, from));
    PetscCall(MatSolve(t->L, from, to));
  }
  PetscCall(VecZeroEntries(w));
  if (t->L) {
    PetscCall(VecISCopy(w, t->free, SCATTER_FORWARD, to));
    PetscCall(VecDestroy(&from));
    PetscCall(VecDestroy(&to));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* t->y_F and t->r_C from t->fixed and t->y, which is 0 on F. First rank only. */
static PetscErrorCode SchurSolverDenseSystem_Private(SchurSolver *t, PetscInt N, PetscBool *definite, PetscReal *max)
{
  PetscFunctionBeginUser;
  PetscCall(SchurSolverDenseFactor_Private(t, N, definite));
  if (!*definite) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatMult(t->S, t->y, t->r_C));
  PetscCall(VecAYPX(t->r_C, -1, t->g));
  PetscCall(SchurSolverDenseSolve_Private(t, t->r_C));
  PetscCall(VecAXPY(t->y, 1, t->r_C));
  PetscCall(MatMult(t->S, t->y, t->r_C));
  PetscCall(VecAYPX(t->r_C, -1, t->g));
  PetscCall(VecISSet(t->r_C, t->free, 0));
  PetscCall(VecNorm(t->y, NORM_INFINITY, max));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Solve_SchurSolver(ActiveSolver solver, const PetscBool fixed[], const PetscReal value[],
                                        ActiveSolution *solution)
{
  SchurSolver     *t        = solver->data;
  const ActiveSet *set      = solver->set;
  PetscBool        definite = PETSC_TRUE;
  PetscReal        max      = 0;
  PetscMPIInt      n;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < set->n; i++) {
    solution->fixed[i] = fixed[i];
    solution->y[i]     = fixed[i] ? value[i] : 0;
  }
  PetscCall(PetscMPIIntCast(set->n, &n));
  PetscCall(SchurSolverToFirst_Private(solver, solution->y, t->y));
  PetscCallMPI(MPI_Gatherv(fixed, n, MPIU_BOOL, t->fixed, t->counts, t->offsets, MPIU_BOOL, 0, set->comm));
  if (!t->rank) PetscCall(SchurSolverDenseSystem_Private(t, set->N, &definite, &max));
  PetscCallMPI(MPI_Bcast(&definite, 1, MPIU_BOOL, 0, set->comm));
  PetscCallMPI(MPI_Bcast(&max, 1, MPIU_REAL, 0, set->comm));
  PetscCall(SchurSolverFromFirst_Private(solver, t->y, solution->y));
  PetscCall(SchurSolverFromFirst_Private(solver, t->r_C, solution->r));
  solution->size       = PetscMax(t->size, max);
  solution->eta        = 0;
  solution->norm       = 0;
  solution->iterations = 1;
  if (!definite) solution->failure = FAILURE_SINGULAR;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* By blocks: I, then F by S, then I again; t->r is overwritten. */
static PetscErrorCode Correct_SchurSolver(ActiveSolver solver, Vec f, Vec d, PetscReal *alpha)
{
  SchurSolver *t = solver->data;
  PetscReal   *z;
  Vec          y;

  PetscFunctionBeginUser;
  *alpha = 1;
  PetscCall(PetscMalloc1(solver->set->n, &z));
  PetscCall(VecDuplicate(d, &y));
  PetscCall(VecZeroEntries(y));
  PetscCall(FactorizationSolve(t->F, f, d));
  PetscCall(MatMult(solver->A, d, t->r));
  PetscCall(VecAYPX(t->r, -1, f));
  PetscCall(ActiveSetGather(solver->set, t->r, z));
  PetscCall(SchurSolverToFirst_Private(solver, z, t->r_C));
  if (!t->rank) PetscCall(SchurSolverDenseSolve_Private(t, t->r_C));
  PetscCall(SchurSolverFromFirst_Private(solver, t->r_C, z));
  PetscCall(ActiveSetScatter(solver->set, z, y));
  PetscCall(MatMult(solver->A, y, t->r));
  PetscCall(VecAYPX(t->r, -1, f));
  PetscCall(FactorizationSolve(t->F, t->r, d));
  PetscCall(VecAXPY(d, 1, y));
  PetscCall(VecDestroy(&y));
  PetscCall(PetscFree(z));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Without d_I = A_II^-1 (f_I - A_IF z), z = S_FF^-1 w_F, w = f_C - A_CI A_II^-1 f_I:
   |d|_A^2 = f_I.A_II^-1 f_I + w_F.z,  A_CF d = S_CF z - w where f = 0. */
static PetscErrorCode Measure_SchurSolver(ActiveSolver solver, Vec f, PetscReal *square, PetscReal felt[])
{
  SchurSolver *t = solver->data;
  PetscScalar  inner, outer = 0;
  Vec          z;

  PetscFunctionBeginUser;
  PetscCall(FactorizationSolve(t->F, f, t->d));
  PetscCall(VecDot(f, t->d, &inner));
  PetscCall(MatMult(solver->A, t->d, t->r));
  PetscCall(VecAYPX(t->r, -1, f));
  PetscCall(ActiveSetGather(solver->set, t->r, felt));
  PetscCall(SchurSolverToFirst_Private(solver, felt, t->r_C));
  if (!t->rank) {
    PetscCall(VecDuplicate(t->r_C, &z));
    PetscCall(VecCopy(t->r_C, z));
    PetscCall(SchurSolverDenseSolve_Private(t, z));
    PetscCall(VecDot(t->r_C, z, &outer));
    PetscCall(MatMult(t->S, z, t->y));
    PetscCall(VecAYPX(t->r_C, -1, t->y));
    PetscCall(VecDestroy(&z));
  }
  PetscCallMPI(MPI_Bcast(&outer, 1, MPIU_SCALAR, 0, solver->set->comm));
  PetscCall(SchurSolverFromFirst_Private(solver, t->r_C, felt));
  *square = PetscRealPart(inner + outer);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y_I = A_II^-1 (b_I - A_IC y_C), then corrections down to roundoff with A itself, from which the forces
   come. */
static PetscErrorCode Finish_SchurSolver(ActiveSolver solver, ActiveSolution *solution, Vec y)
{
  SchurSolver *t = solver->data;
  PetscReal   *v, reference, size, alpha;
  PetscBool    suffices;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(solver->set->n, &v));
  for (PetscInt i = 0; i < solver->set->n; i++) v[i] = solution->fixed[i] ? solution->y[i] : 0;
  PetscCall(VecZeroEntries(y));
  PetscCall(ActiveSetScatter(solver->set, v, y));
  PetscCall(PetscFree(v));
  PetscCall(ActiveSolverResidual(solver, solution->fixed, y, t->r, t->f, &reference));
  PetscCall(ActiveSetScatter(solver->set, solution->y, y));
  PetscCall(ActiveSolverResidual(solver, solution->fixed, y, t->r, t->f, &size));
  PetscCall(FactorizationSolve(t->F, t->f, t->d));
  for (PetscInt k = 0;; k++) {
    PetscCall(VecAXPY(y, 1, t->d));
    PetscCall(ActiveSolverResidual(solver, solution->fixed, y, t->r, t->f, &size));
    solution->eta = reference > 0 ? size / reference : 0;
    if (k == SCHUR_REFINEMENTS || (k && solution->eta <= solver->rtol)) break;
    PetscCall(Correct_SchurSolver(solver, t->f, t->d, &alpha));
  }
  PetscCall(ActiveSolverSuffices(solver, y, size, reference, &suffices));
  if (!suffices) solution->failure = FAILURE_RESIDUAL;
  PetscCall(ActiveSolverRestrict(solver, y, t->r, t->f, solution));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SchurSolverGetReduced(ActiveSolver solver, PetscScalar **S, PetscReal **g)
{
  SchurSolver *t = solver->data;

  PetscFunctionBeginUser;
  if (t->rank) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatDenseGetArray(t->S, S)); // stays where it is as long as the solver lives
  PetscCall(MatDenseRestoreArray(t->S, NULL));
  PetscCall(VecGetArray(t->g, g));
  PetscCall(VecRestoreArray(t->g, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_SchurSolver(ActiveSolver solver)
{
  SchurSolver *t = solver->data;

  PetscFunctionBeginUser;
  PetscCall(FactorizationDestroy(&t->F));
  PetscCall(VecDestroy(&t->r));
  PetscCall(VecDestroy(&t->f));
  PetscCall(VecDestroy(&t->d));
  PetscCall(PetscFree2(t->counts, t->offsets));
  PetscCall(MatDestroy(&t->S));
  PetscCall(MatDestroy(&t->L));
  PetscCall(VecDestroy(&t->g));
  PetscCall(VecDestroy(&t->y));
  PetscCall(VecDestroy(&t->r_C));
  PetscCall(PetscFree2(t->diag, t->fixed));
  PetscCall(ISDestroy(&t->free));
  PetscCall(PetscFree(t));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Allocates on the first rank, and gathers the number of bounded unknowns of each rank. */
static PetscErrorCode SchurSolverAllocate_Private(ActiveSolver solver)
{
  SchurSolver   *t = solver->data;
  const PetscInt N = solver->set->N;
  PetscMPIInt    size, n;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(solver->set->comm, &t->rank));
  PetscCallMPI(MPI_Comm_size(solver->set->comm, &size));
  if (!t->rank) {
    PetscCall(PetscMalloc2(size, &t->counts, size, &t->offsets));
    PetscCall(MatCreateSeqDense(PETSC_COMM_SELF, N, N, NULL, &t->S));
    PetscCall(MatCreateVecs(t->S, &t->y, &t->g));
    PetscCall(VecDuplicate(t->y, &t->r_C));
    PetscCall(PetscMalloc2(N, &t->diag, N, &t->fixed));
  }
  PetscCall(PetscMPIIntCast(solver->set->n, &n));
  PetscCallMPI(MPI_Gather(&n, 1, MPI_INT, t->counts, 1, MPI_INT, 0, solver->set->comm));
  for (PetscMPIInt p = 0, offset = 0; p < size && !t->rank; offset += t->counts[p++]) t->offsets[p] = offset;
  PetscCall(VecDuplicate(solver->b, &t->r));
  PetscCall(VecDuplicate(solver->b, &t->f));
  PetscCall(VecDuplicate(solver->b, &t->d));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Factors A_II and gets S. */
static PetscErrorCode SchurSolverFactor_Private(ActiveSolver solver, const char prefix[], MatFactorError *error)
{
  SchurSolver   *t = solver->data;
  const PetscInt N = solver->set->N;
  PetscInt      *C;
  PetscScalar   *S = NULL;

  PetscFunctionBeginUser;
  PetscCall(ActiveSetAll(solver->set, &C));
  if (!t->rank) PetscCall(MatDenseGetArray(t->S, &S));
  PetscCall(FactorizationCreate(solver->A, N, C, prefix, S, &t->F, error));
  if (!t->rank && !*error) FactorizationFillSchur(N, S);
  if (!t->rank) PetscCall(MatDenseRestoreArray(t->S, &S));
  PetscCall(PetscFree(C));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* g = b_C - A_CI A_II^-1 b_I */
static PetscErrorCode Load_SchurSolver(ActiveSolver solver, Vec b, Vec y)
{
  SchurSolver *t = solver->data;
  PetscReal   *g;

  PetscFunctionBeginUser;
  (void)y;
  solver->b = b;
  PetscCall(FactorizationSolve(t->F, b, t->d));
  PetscCall(VecNorm(t->d, NORM_INFINITY, &t->size));
  PetscCall(MatMult(solver->A, t->d, t->r));
  PetscCall(VecAYPX(t->r, -1, b));
  PetscCall(PetscMalloc1(solver->set->n, &g));
  PetscCall(ActiveSetGather(solver->set, t->r, g));
  PetscCall(SchurSolverToFirst_Private(solver, g, t->g));
  PetscCall(PetscFree(g));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SchurSolverCreate(const ActiveSet *set, Mat A, Vec b, const char prefix[], PetscReal rtol,
                                 ActiveSolver *solver, const char **failure)
{
  SchurSolver   *t;
  PetscMPIInt    n;
  MatFactorError error;

  PetscFunctionBeginUser;
  PetscCall(ActiveSolverCreate(set, A, b, rtol, solver));
  PetscCall(PetscNew(&t));
  (*solver)->data     = t;
  (*solver)->factored = PETSC_TRUE;
  (*solver)->solve    = Solve_SchurSolver;
  (*solver)->load     = Load_SchurSolver;
  (*solver)->finish   = Finish_SchurSolver;
  (*solver)->correct  = Correct_SchurSolver;
  (*solver)->measure  = Measure_SchurSolver;
  (*solver)->destroy  = Destroy_SchurSolver;
  PetscCall(SchurSolverAllocate_Private(*solver));
  PetscCall(PetscMPIIntCast(set->n, &n));
  PetscCallMPI(MPI_Gatherv(set->diag, n, MPIU_REAL, t->diag, t->counts, t->offsets, MPIU_REAL, 0, set->comm));
  PetscCall(SchurSolverFactor_Private(*solver, prefix, &error));
  *failure = ActiveSolverFailureOfFactor(error);
  if (*failure) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(Load_SchurSolver(*solver, b, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}
