/* small_problem.h -- inequalities of up to ten unknowns: made at random, solved by a SNES, and by trying every active set. */
#ifndef SMALL_PROBLEM_H
#define SMALL_PROBLEM_H

#include "pdas/pdas.h"
#include "test.h"

enum { MAX = 10 }; /* unknowns */

/* min 1/2 y'A y - b'y, y <= upper; PETSC_INFINITY for no bound. */
typedef struct {
  PetscInt  n;
  PetscReal A[MAX * MAX], b[MAX], upper[MAX];
} Problem;

/* How to solve, and what came out. */
typedef struct {
  MPI_Comm            comm;
  const char         *type, *start;
  PetscReal           c;
  PetscBool           reduce;
  PetscInt            max_it;
  const PetscReal    *previous; /* set to begin with, or NULL [n] */
  PetscReal           y[MAX];   /* the same on all ranks */
  PetscBool           active[MAX];
  SNESConvergedReason reason;
  PetscInt            iterations, changed[64], num_active, monitored;
  PetscBool           safeguarded, reduced;
  PetscReal           residual;
} Run;

static Run RunDefault(void)
{
  return (Run){.comm = PETSC_COMM_WORLD, .type = SNESPDAS, .start = "empty", .c = 1, .max_it = 60};
}

static PetscErrorCode Function(SNES snes, Vec y, Vec f, void *ctx)
{
  Mat A;

  PetscFunctionBeginUser;
  PetscCall(SNESGetJacobian(snes, &A, NULL, NULL, NULL));
  PetscCall(MatMult(A, y, f));
  PetscCall(VecAXPY(f, -1, (Vec)ctx));
  PetscFunctionReturn(0);
}

static PetscErrorCode Jacobian(SNES snes, Vec y, Mat A, Mat P, void *ctx)
{
  (void)snes, (void)y, (void)A, (void)P, (void)ctx;
  return 0;
}

static PetscErrorCode Count(SNES snes, PetscInt it, PetscReal norm, void *ctx)
{
  PetscInt now;

  PetscFunctionBeginUser;
  PetscCall(SNESGetIterationNumber(snes, &now));
  CHECK(now == it && norm >= 0);
  ++*(PetscInt *)ctx;
  PetscFunctionReturn(0);
}

/* The entries of a small vector on all ranks. */
static PetscErrorCode RedundantSolve(Vec v, PetscReal values[])
{
  VecScatter         scatter;
  Vec                all;
  PetscInt           n;
  const PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(VecGetSize(v, &n));
  PetscCall(VecScatterCreateToAll(v, &scatter, &all));
  PetscCall(VecScatterBegin(scatter, v, all, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, v, all, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(all, &a));
  for (PetscInt i = 0; i < n; i++) values[i] = a[i];
  PetscCall(VecRestoreArrayRead(all, &a));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCall(VecDestroy(&all));
  PetscFunctionReturn(0);
}

/* Matrix, right-hand side, bounds as PETSc objects. */
static PetscErrorCode Build(MPI_Comm comm, const Problem *p, Mat *A, Vec *b, Vec *lower, Vec *upper)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(comm, PETSC_DECIDE, PETSC_DECIDE, p->n, p->n, p->n, NULL, p->n, NULL, A));
  PetscCall(MatCreateVecs(*A, b, upper));
  PetscCall(VecDuplicate(*b, lower));
  PetscCall(VecSet(*lower, PETSC_NINFINITY));
  PetscCall(MatGetOwnershipRange(*A, &begin, &end));
  for (PetscInt i = begin; i < end; i++) {
    for (PetscInt j = 0; j < p->n; j++) PetscCall(MatSetValue(*A, i, j, p->A[i * p->n + j], INSERT_VALUES));
    PetscCall(VecSetValue(*b, i, p->b[i], INSERT_VALUES));
    PetscCall(VecSetValue(*upper, i, p->upper[i], INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatSetOption(*A, MAT_SPD, PETSC_TRUE));
  PetscCall(VecAssemblyBegin(*b));
  PetscCall(VecAssemblyEnd(*b));
  PetscCall(VecAssemblyBegin(*upper));
  PetscCall(VecAssemblyEnd(*upper));
  PetscFunctionReturn(0);
}

static PetscErrorCode SetOptions(const Run *run)
{
  char text[64];

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsSetValue(NULL, "-snes_pdas_start", run->start));
  PetscCall(PetscOptionsSetValue(NULL, "-snes_pdas_reduce", run->reduce ? "true" : "false"));
  PetscCall(PetscSNPrintf(text, sizeof(text), "%.17g", (double)run->c));
  PetscCall(PetscOptionsSetValue(NULL, "-snes_pdas_c", text));
  PetscCall(PetscSNPrintf(text, sizeof(text), "%" PetscInt_FMT, run->max_it));
  PetscCall(PetscOptionsSetValue(NULL, "-snes_max_it", text));
  PetscFunctionReturn(0);
}

static PetscErrorCode Solve(const Problem *p, Run *run)
{
  SNES            snes;
  KSP             ksp;
  PC              pc;
  Mat             A;
  Vec             b, y, f, lower, upper, active;
  PetscReal       flags[MAX];
  PetscBool       pdas;
  const PetscInt *changed;

  PetscFunctionBeginUser;
  PetscCall(Build(run->comm, p, &A, &b, &lower, &upper));
  PetscCall(VecDuplicate(b, &y));
  PetscCall(VecDuplicate(b, &f));
  PetscCall(VecZeroEntries(y));
  PetscCall(SetOptions(run));
  PetscCall(SNESCreate(run->comm, &snes));
  PetscCall(SNESSetFunction(snes, f, Function, b));
  PetscCall(SNESSetJacobian(snes, A, A, Jacobian, NULL));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  PetscCall(SNESSetType(snes, run->type));
  PetscCall(SNESSetFromOptions(snes));
  PetscCall(SNESVISetVariableBounds(snes, lower, upper));
  if (run->previous) {
    PetscCall(VecDuplicate(b, &active));
    for (PetscInt i = 0; i < p->n; i++) PetscCall(VecSetValue(active, i, run->previous[i], INSERT_VALUES));
    PetscCall(VecAssemblyBegin(active));
    PetscCall(VecAssemblyEnd(active));
    PetscCall(PDASSetStart(snes, active));
    PetscCall(VecDestroy(&active));
  }
  run->monitored = 0;
  PetscCall(SNESMonitorSet(snes, Count, &run->monitored, NULL));
  PetscCall(SNESSolve(snes, NULL, y));
  PetscCall(SNESGetConvergedReason(snes, &run->reason));
  PetscCall(RedundantSolve(y, run->y));
  PetscCall(PetscStrcmp(run->type, SNESPDAS, &pdas));
  if (pdas) {
    PetscCall(PDASGetHistory(snes, &run->iterations, &run->num_active, &changed, &run->safeguarded));
    PetscCall(PDASGetLinear(snes, NULL, &run->residual, &run->reduced));
    PetscCall(PDASGetActive(snes, &active));
    PetscCall(RedundantSolve(active, flags));
    for (PetscInt i = 0; i < p->n; i++) run->active[i] = (PetscBool)(flags[i] > 0.5);
    for (PetscInt i = 0; i < run->iterations; i++) run->changed[i] = changed[i];
  }
  PetscCall(SNESDestroy(&snes));
  PetscCall(MatDestroy(&A));
  PetscCall(VecDestroy(&b));
  PetscCall(VecDestroy(&y));
  PetscCall(VecDestroy(&f));
  PetscCall(VecDestroy(&lower));
  PetscCall(VecDestroy(&upper));
  PetscFunctionReturn(0);
}

/* Solves B x = c in place by elimination with pivoting; B is of shape [n][n]. */
static void Eliminate(PetscInt n, PetscReal B[], PetscReal c[])
{
  for (PetscInt k = 0; k < n; k++) {
    PetscInt p = k;

    for (PetscInt i = k + 1; i < n; i++) {
      if (PetscAbsReal(B[i * n + k]) > PetscAbsReal(B[p * n + k])) p = i;
    }
    for (PetscInt j = 0; j < n; j++) {
      const PetscReal swap = B[k * n + j];

      B[k * n + j] = B[p * n + j];
      B[p * n + j] = swap;
    }
    {
      const PetscReal swap = c[k];

      c[k] = c[p];
      c[p] = swap;
    }
    for (PetscInt i = k + 1; i < n; i++) {
      const PetscReal m = B[i * n + k] / B[k * n + k];

      for (PetscInt j = k; j < n; j++) B[i * n + j] -= m * B[k * n + j];
      c[i] -= m * c[k];
    }
  }
  for (PetscInt i = n - 1; i >= 0; i--) {
    for (PetscInt j = i + 1; j < n; j++) c[i] -= B[i * n + j] * c[j];
    c[i] /= B[i * n + i];
  }
}

/* How much the best of all 2^n active sets violates the inequalities, and its solution. */
static PetscReal BruteForce(const Problem *p, PetscReal best[])
{
  const PetscInt n     = p->n;
  PetscReal      least = PETSC_MAX_REAL;

  for (PetscInt set = 0; set < (1 << n); set++) {
    PetscReal B[MAX * MAX], y[MAX], worst = 0;
    PetscBool possible = PETSC_TRUE;

    for (PetscInt i = 0; i < n; i++) {
      const PetscBool fixed = (PetscBool)((set >> i) & 1);

      if (fixed && p->upper[i] >= PETSC_INFINITY) possible = PETSC_FALSE;
      for (PetscInt j = 0; j < n; j++) B[i * n + j] = fixed ? (PetscReal)(i == j) : p->A[i * n + j];
      y[i] = fixed ? p->upper[i] : p->b[i];
    }
    if (!possible) continue;
    Eliminate(n, B, y);
    for (PetscInt i = 0; i < n; i++) {
      PetscReal r = p->b[i];

      for (PetscInt j = 0; j < n; j++) r -= p->A[i * n + j] * y[j];
      if ((set >> i) & 1)
        worst = PetscMax(worst, -r / p->A[i * n + i]);
      else
        worst = PetscMax(worst, y[i] - p->upper[i]);
    }
    if (worst >= least) continue;
    least = worst;
    for (PetscInt i = 0; i < n; i++) best[i] = y[i];
  }
  return least;
}

/* A = G'G + shift, with bounds, by the seed: few directions and small shifts make the nasty ones. */
static PetscErrorCode RandomProblem(PetscInt seed, Problem *p)
{
  PetscRandom random;
  PetscReal   G[MAX * MAX], value;
  PetscInt    n;

  PetscFunctionBeginUser;
  PetscCall(PetscRandomCreate(PETSC_COMM_SELF, &random));
  PetscCall(PetscRandomSetSeed(random, (unsigned long)seed));
  PetscCall(PetscRandomSeed(random));
  PetscCall(PetscRandomGetValue(random, &value));
  n    = 2 + (PetscInt)(value * (MAX - 2.001)); /* one less than MAX: there is room for Extend() */
  p->n = n;
  PetscCall(PetscRandomSetInterval(random, -1, 1));
  for (PetscInt i = 0; i < n * n; i++) PetscCall(PetscRandomGetValue(random, &G[i]));
  for (PetscInt i = 0; i < n; i++) {
    for (PetscInt j = 0; j < n; j++) {
      p->A[i * n + j] = i == j ? (seed % 3 == 0 ? 1 : seed % 3 == 1 ? 1e-2 : 1e-4) : 0;
      for (PetscInt k = 0; k < n; k++) p->A[i * n + j] += G[k * n + i] * G[k * n + j];
    }
    PetscCall(PetscRandomGetValue(random, &p->b[i]));
    PetscCall(PetscRandomGetValue(random, &p->upper[i]));
    if (seed % 5 == 0) p->upper[i] = 0;
    if (seed % 4 == 0 && i % 3 == 1) p->upper[i] = PETSC_INFINITY;
  }
  PetscCall(PetscRandomDestroy(&random));
  PetscFunctionReturn(0);
}

/* The same problem with one unknown more, without bound, whose elimination gives the problem back: [1 w'; w A + ww'].
   */
static void Extend(Problem *p)
{
  const Problem  q = *p;
  const PetscInt n = q.n + 1;

  p->n = n;
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal wi = i ? 0.3 * (PetscReal)(i % 3) : 1;

    for (PetscInt j = 0; j < n; j++) {
      const PetscReal wj = j ? 0.3 * (PetscReal)(j % 3) : 1;

      p->A[i * n + j] = wi * wj + (i && j ? q.A[(i - 1) * q.n + j - 1] : 0);
    }
    p->b[i]     = 0.7 * wi + (i ? q.b[i - 1] : 0);
    p->upper[i] = i ? q.upper[i - 1] : PETSC_INFINITY;
  }
}

#endif
