/* multigrid.c -- truncated multigrid for the systems of active sets.

   Held unknowns, active ones and eliminated ones alike, are no part of a system:
       A^ = M A M + (1 - M) diag(A),   M = 0 where held, 1 elsewhere.
   A coarse correction that moved them would spoil them, so nothing is interpolated to them [1]: P^ = M P. The operator of the coarser level is
   then P^' A P^ = A_c + P'(M A M - A) P with A_c = P'A P, its own matrix, and what is added is nonzero near held unknowns only. A coarse
   unknown that moves next to nothing but held ones is itself held.

   PCMG cycles; here is what it works with. The type rides on PCSHELL, with public headers.

   References: [1] Kornhuber, Monotone multigrid methods for elliptic variational inequalities I, 1994; Graeser, Kornhuber,
               Multigrid methods for obstacle problems, 2009. */
#include <mortise/compat.h>
#include <mortise/fault.h>
#include "multigrid.h"
#include "strip.h"

static const char CONTEXT[] = "MortiseMultigrid"; /* name under which the context is composed */

/* Steps of the smoother, and the part of the spectrum that it is for. */
enum { SMOOTHING_STEPS = 3 };
static const PetscReal SMOOTHED_FROM = 0.1;
/* A coarse unknown is held if this part of what it moves, in squares, is free at most. */
static const PetscReal NEXT_TO_NOTHING = 1e-2;

/* One level with some of its unknowns held. */
typedef struct {
  Hierarchy hierarchy;     /* borrowed */
  Grid     *grid;          /* borrowed */
  Mat       change;        /* what truncation on finer levels adds to A, or NULL */
  Vec       free;          /* M: 1 where free, 0 where held */
  Vec       springs;       /* on the diagonal of A, or NULL; borrowed */
  PetscInt  num;           /* held unknowns of this rank */
  PetscInt  num_truncated; /* of these, not eliminated before */
  PetscInt *held;          /* counted from this rank's first [num] */
  Vec       diag;          /* of A + change, of A where held */
  Mat       A;             /* A^, a shell; on the coarsest level a matrix */
  Mat       P;             /* M P, a shell */
} Rung;

typedef struct {
  Hierarchy  hierarchy; /* borrowed */
  PetscInt   num;       /* levels */
  Rung      *rung;      /* coarse first */
  Mat        outer;     /* A^ of the finest level, for who iterates */
  PC         mg;
  PetscBool  ready; /* whether M was set before */
  SNES       snes;  /* borrowed, or NULL */
  IS         left;  /* unknowns that snes leaves, or NULL */
  VecScatter scatter;
  Vec        r, z; /* on all unknowns */
} Multigrid;

static PetscErrorCode Get_Private(PC pc, Multigrid **multigrid)
{
  PetscContainer container;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectQuery((PetscObject)pc, CONTEXT, (PetscObject *)&container));
  *multigrid = NULL;
  if (container) PetscCall(PetscContainerGetPointer(container, (void **)multigrid));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y := y + W x; W is nonzero in a few places */
static PetscErrorCode AddSprings_Private(Vec springs, Vec x, Vec y)
{
  const PetscScalar *w, *xa;
  PetscScalar       *ya;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(x, &n));
  PetscCall(VecGetArrayRead(springs, &w));
  PetscCall(VecGetArrayRead(x, &xa));
  PetscCall(VecGetArray(y, &ya));
  for (PetscInt i = 0; i < n; i++) ya[i] += w[i] * xa[i];
  PetscCall(VecRestoreArray(y, &ya));
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCall(VecRestoreArrayRead(springs, &w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y = A^ x for x that is 0 where held, but for the diagonal there */
static PetscErrorCode Mult_Rung(Mat A, Vec x, Vec y)
{
  Rung              *rung;
  const PetscScalar *d, *xa;
  PetscScalar       *ya;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &rung));
  PetscCall(MatMult(rung->grid->vi->K, x, y));
  PetscCall(VecScale(y, 1 / rung->grid->vi->stiffness));
  if (rung->grid->vi->Z) PetscCall(MatMultAdd(rung->grid->vi->Z, x, y, y));
  if (rung->springs) PetscCall(AddSprings_Private(rung->springs, x, y));
  if (rung->change) PetscCall(MatMultAdd(rung->change, x, y, y));
  rung->hierarchy->work += rung->grid->share;
  PetscCall(VecGetArrayRead(rung->diag, &d));
  PetscCall(VecGetArrayRead(x, &xa));
  PetscCall(VecGetArray(y, &ya));
  for (PetscInt i = 0; i < rung->num; i++) ya[rung->held[i]] = d[rung->held[i]] * xa[rung->held[i]];
  PetscCall(VecRestoreArray(y, &ya));
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCall(VecRestoreArrayRead(rung->diag, &d));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The same for an x that is 0 where active, whatever it is where unknowns were eliminated: to iterate with. */
static PetscErrorCode Mult_Outer(Mat A, Vec x, Vec y)
{
  Rung              *rung;
  const PetscScalar *d, *xa;
  PetscScalar       *ya;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &rung));
  PetscCall(MatMult(rung->grid->A, x, y));
  rung->hierarchy->work += rung->grid->share;
  PetscCall(VecGetArrayRead(rung->diag, &d));
  PetscCall(VecGetArrayRead(x, &xa));
  PetscCall(VecGetArray(y, &ya));
  for (PetscInt i = 0; i < rung->num; i++) ya[rung->held[i]] = d[rung->held[i]] * xa[rung->held[i]];
  PetscCall(VecRestoreArray(y, &ya));
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCall(VecRestoreArrayRead(rung->diag, &d));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode GetDiagonal_Rung(Mat A, Vec diag)
{
  Rung *rung;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &rung));
  PetscCall(VecCopy(rung->diag, diag));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y = M P x */
static PetscErrorCode Interpolate_Rung(Mat P, Vec x, Vec y)
{
  Rung        *rung;
  PetscScalar *ya;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(P, &rung));
  PetscCall(MatMult(rung->grid->P, x, y));
  PetscCall(VecGetArray(y, &ya));
  for (PetscInt i = 0; i < rung->num; i++) ya[rung->held[i]] = 0;
  PetscCall(VecRestoreArray(y, &ya));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* x = P'y for y that is 0 where held, as residuals of A^ are */
static PetscErrorCode Restrict_Rung(Mat P, Vec y, Vec x)
{
  Rung *rung;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(P, &rung));
  PetscCall(MatMultTranspose(rung->grid->P, y, x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The diagonal that goes with change and held. */
static PetscErrorCode SetDiagonal_Private(Rung *rung)
{
  const PetscScalar *own;
  PetscScalar       *diag;

  PetscFunctionBeginUser;
  if (rung->change) {
    PetscCall(MatGetDiagonal(rung->change, rung->diag));
    PetscCall(VecAXPY(rung->diag, 1, rung->grid->diag));
  } else {
    PetscCall(VecCopy(rung->grid->diag, rung->diag));
  }
  PetscCall(VecGetArray(rung->diag, &diag));
  PetscCall(VecGetArrayRead(rung->grid->diag, &own));
  for (PetscInt i = 0; i < rung->num; i++) diag[rung->held[i]] = own[rung->held[i]];
  PetscCall(VecRestoreArrayRead(rung->grid->diag, &own));
  PetscCall(VecRestoreArray(rung->diag, &diag));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* M of the coarser level: what moves next to nothing that is free is held. [out] free - on the coarser level */
static PetscErrorCode HoldCoarser_Private(const Rung *fine, Vec free)
{
  const PetscScalar *all, *gone;
  PetscScalar       *f;
  PetscInt           begin, n;
  Vec                held;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(fine->grid->weight, &held));
  PetscCall(VecZeroEntries(held));
  PetscCall(MatGetOwnershipRange(fine->grid->P, &begin, NULL));
  for (PetscInt i = 0; i < fine->num_truncated; i++) {
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(fine->grid->P, begin + fine->held[i], &num, &columns, &values));
    for (PetscInt j = 0; j < num; j++) PetscCall(VecSetValue(held, columns[j], values[j] * values[j], ADD_VALUES));
    PetscCall(MatRestoreRow(fine->grid->P, begin + fine->held[i], &num, &columns, &values));
  }
  PetscCall(VecAssemblyBegin(held));
  PetscCall(VecAssemblyEnd(held));
  PetscCall(VecGetLocalSize(held, &n));
  PetscCall(VecGetArrayRead(fine->grid->weight, &all));
  PetscCall(VecGetArrayRead(held, &gone));
  PetscCall(VecGetArray(free, &f));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal left = PetscRealPart(all[i] - gone[i]);

    f[i] = PetscRealPart(gone[i]) > 0 && left <= NEXT_TO_NOTHING * PetscRealPart(all[i]) ? 0 : 1;
  }
  PetscCall(VecRestoreArray(free, &f));
  PetscCall(VecRestoreArrayRead(held, &gone));
  PetscCall(VecRestoreArrayRead(fine->grid->weight, &all));
  PetscCall(VecDestroy(&held));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Lists what is held, and last what was eliminated before. */
static PetscErrorCode List_Private(Rung *rung)
{
  const VI           vi = rung->grid->vi;
  const PetscScalar *f;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(rung->free, &n));
  PetscCall(VecGetArrayRead(rung->free, &f));
  rung->num = 0;
  for (PetscInt i = 0; i < n; i++) rung->num += f[i] == 0;
  rung->num_truncated = rung->num;
  PetscCall(PetscFree(rung->held));
  PetscCall(PetscMalloc1(rung->num + vi->num_fixed, &rung->held));
  rung->num = 0;
  for (PetscInt i = 0; i < n; i++)
    if (f[i] == 0) rung->held[rung->num++] = i;
  for (PetscInt i = 0; i < vi->num_fixed; i++) rung->held[rung->num++] = vi->fixed_local[i];
  PetscCall(VecRestoreArrayRead(rung->free, &f));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What is held on the finest level, carried to all coarser ones; only what has changed since the last time is worked on.
   [in] free - M of the finest level */
static PetscErrorCode Descend_Private(Multigrid *multigrid, Vec free)
{
  Mat dC = NULL, strip;
  Vec is;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(free, &is));
  PetscCall(VecCopy(free, is));
  for (PetscInt l = multigrid->num - 1; l >= 0; l--) {
    Rung *rung = &multigrid->rung[l];

    if (l)
      PetscCall(StripCreate(rung->grid->vi, rung->change, dC, rung->free, is, multigrid->ready ? NULL : rung->springs,
                            &strip));
    if (rung->change) PetscCall(MatAXPY(rung->change, 1, dC, DIFFERENT_NONZERO_PATTERN));
    if (dC && !rung->change) PetscCall(PetscObjectReference((PetscObject)dC));
    if (dC && !rung->change) rung->change = dC;
    PetscCall(MatDestroy(&dC));
    PetscCall(VecCopy(is, rung->free));
    PetscCall(VecDestroy(&is));
    PetscCall(List_Private(rung));
    PetscCall(SetDiagonal_Private(rung));
    if (!l) break;
    PetscCall(StripRestrict(strip, rung->grid->P, &dC));
    PetscCall(MatDestroy(&strip));
    PetscCall(VecDuplicate(multigrid->rung[l - 1].free, &is));
    PetscCall(HoldCoarser_Private(rung, is));
  }
  multigrid->ready = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The coarsest matrix, which is factored. */
static PetscErrorCode SetCoarsest_Private(Multigrid *multigrid)
{
  Rung     *rung = &multigrid->rung[0];
  KSP       ksp;
  PetscInt *rows, begin;

  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&rung->A));
  PetscCall(MatDuplicate(rung->grid->A, MAT_COPY_VALUES, &rung->A));
  if (rung->change) PetscCall(MatAXPY(rung->A, 1, rung->change, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatGetOwnershipRange(rung->A, &begin, NULL));
  PetscCall(PetscMalloc1(rung->num, &rows));
  for (PetscInt i = 0; i < rung->num_truncated; i++) rows[i] = begin + rung->held[i];
  PetscCall(MatZeroRowsColumns(rung->A, rung->num_truncated, rows, 1, NULL, NULL));
  PetscCall(PetscFree(rows));
  PetscCall(MatSetOption(rung->A, MAT_SPD, PETSC_TRUE));
  PetscCall(PCMGGetCoarseSolve(multigrid->mg, &ksp));
  PetscCall(KSPSetOperators(ksp, rung->A, rung->A));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Held unknowns of the finest level are those with 0; the rest follows. */
static PetscErrorCode Hold_Private(Multigrid *multigrid, Vec free)
{
  PetscFunctionBeginUser;
  PetscCall(Descend_Private(multigrid, free));
  for (PetscInt l = 1; l < multigrid->num; l++) { // what smoothers keep of their matrix is out of date
    PetscCall(MatAssemblyBegin(multigrid->rung[l].A, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(multigrid->rung[l].A, MAT_FINAL_ASSEMBLY));
  }
  PetscCall(SetCoarsest_Private(multigrid));
  PetscCall(PCSetUp(multigrid->mg));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridSetFree(PC pc, Vec free)
{
  Multigrid *multigrid;

  PetscFunctionBeginUser;
  PetscCall(Get_Private(pc, &multigrid));
  if (multigrid) PetscCall(Hold_Private(multigrid, free));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridGetOperator(PC pc, Mat *A)
{
  Multigrid *multigrid;

  PetscFunctionBeginUser;
  PetscCall(Get_Private(pc, &multigrid));
  *A = multigrid->outer;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Shells on one level above the coarsest. */
static PetscErrorCode RungCreate_Private(Rung *rung)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)rung->grid->A);
  PetscInt       n, coarse;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(rung->grid->P, &n, &coarse));
  PetscCall(MatCreateShell(comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, rung, &rung->A));
  PetscCall(MatShellSetOperation(rung->A, MATOP_MULT, (void (*)(void))Mult_Rung));
  PetscCall(MatShellSetOperation(rung->A, MATOP_GET_DIAGONAL, (void (*)(void))GetDiagonal_Rung));
  PetscCall(MatSetOption(rung->A, MAT_SPD, PETSC_TRUE));
  PetscCall(MatCreateShell(comm, n, coarse, PETSC_DETERMINE, PETSC_DETERMINE, rung, &rung->P));
  PetscCall(MatShellSetOperation(rung->P, MATOP_MULT, (void (*)(void))Interpolate_Rung));
  PetscCall(MatShellSetOperation(rung->P, MATOP_MULT_TRANSPOSE, (void (*)(void))Restrict_Rung));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A^ of the finest level. */
static PetscErrorCode OuterCreate_Private(Multigrid *multigrid)
{
  Rung    *finest = &multigrid->rung[multigrid->num - 1];
  PetscInt n;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(finest->grid->A, &n, NULL));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)finest->grid->A), n, n, PETSC_DETERMINE, PETSC_DETERMINE,
                           finest, &multigrid->outer));
  PetscCall(MatShellSetOperation(multigrid->outer, MATOP_MULT, (void (*)(void))Mult_Outer));
  PetscCall(MatShellSetOperation(multigrid->outer, MATOP_GET_DIAGONAL, (void (*)(void))GetDiagonal_Rung));
  PetscCall(MatSetOption(multigrid->outer, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Smoothers, transfers, the coarsest solver, and what the user says of them. */
static PetscErrorCode Configure_Private(PC pc, Multigrid *multigrid)
{
  const char *prefix;
  KSP         ksp;
  PC          inner;

  PetscFunctionBeginUser;
  PetscCall(PCGetOptionsPrefix(pc, &prefix));
  PetscCall(PCCreate(PetscObjectComm((PetscObject)pc), &multigrid->mg));
  PetscCall(PCSetOptionsPrefix(multigrid->mg, prefix));
  PetscCall(PCSetType(multigrid->mg, PCMG));
  PetscCall(PCMGSetLevels(multigrid->mg, multigrid->num, NULL));
  for (PetscInt l = 1; l < multigrid->num; l++) {
    const PetscReal largest = multigrid->rung[l].grid->largest;

    PetscCall(PCMGSetInterpolation(multigrid->mg, l, multigrid->rung[l].P));
    PetscCall(PCMGGetSmoother(multigrid->mg, l, &ksp));
    PetscCall(KSPSetOperators(ksp, multigrid->rung[l].A, multigrid->rung[l].A));
    PetscCall(KSPSetType(ksp, KSPCHEBYSHEV));
    PetscCall(KSPChebyshevSetEigenvalues(ksp, largest, SMOOTHED_FROM * largest));
    PetscCall(KSPSetNormType(ksp, KSP_NORM_NONE));
    PetscCall(KSPSetTolerances(ksp, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, SMOOTHING_STEPS));
    PetscCall(KSPGetPC(ksp, &inner));
    PetscCall(PCSetType(inner, PCJACOBI));
    PetscCall(KSPSetFromOptions(ksp));
  }
  PetscCall(PCMGGetCoarseSolve(multigrid->mg, &ksp));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPGetPC(ksp, &inner));
  PetscCall(PCSetType(inner, PCCHOLESKY));
  PetscCall(PCFactorSetMatSolverType(inner, MATSOLVERMUMPS));
  PetscCall(KSPSetFromOptions(ksp));
  PetscCall(
      PCSetOperators(multigrid->mg, multigrid->rung[multigrid->num - 1].A, multigrid->rung[multigrid->num - 1].A));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Clear_Private(Multigrid *multigrid)
{
  PetscFunctionBeginUser;
  PetscCall(PCDestroy(&multigrid->mg));
  PetscCall(MatDestroy(&multigrid->outer));
  for (PetscInt l = 0; l < multigrid->num; l++) {
    Rung *rung = &multigrid->rung[l];

    PetscCall(MatDestroy(&rung->change));
    PetscCall(MatDestroy(&rung->A));
    PetscCall(MatDestroy(&rung->P));
    PetscCall(VecDestroy(&rung->diag));
    PetscCall(VecDestroy(&rung->free));
    PetscCall(PetscFree(rung->held));
  }
  PetscCall(PetscFree(multigrid->rung));
  PetscCall(ISDestroy(&multigrid->left));
  PetscCall(VecScatterDestroy(&multigrid->scatter));
  PetscCall(VecDestroy(&multigrid->r));
  PetscCall(VecDestroy(&multigrid->z));
  multigrid->num   = 0;
  multigrid->ready = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridSetHierarchy(PC pc, Hierarchy hierarchy, PetscInt finest, SNES snes)
{
  Multigrid *multigrid;

  PetscFunctionBeginUser;
  PetscCall(Get_Private(pc, &multigrid));
  if (!multigrid) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(Clear_Private(multigrid));
  multigrid->hierarchy = hierarchy;
  multigrid->num       = finest + 1;
  multigrid->snes      = snes;
  PetscCall(PetscCalloc1(multigrid->num, &multigrid->rung));
  for (PetscInt l = 0; l < multigrid->num; l++) {
    Rung *rung = &multigrid->rung[l];

    rung->hierarchy = hierarchy;
    rung->grid      = &hierarchy->grid[l];
    rung->springs   = l + 1 == hierarchy->num ? hierarchy->springs : NULL;
    PetscCall(VecDuplicate(rung->grid->diag, &rung->diag));
    PetscCall(VecDuplicate(rung->grid->diag, &rung->free));
    PetscCall(VecSet(rung->free, 1));
    if (l) PetscCall(RungCreate_Private(rung));
  }
  PetscCall(VecDuplicate(multigrid->rung[finest].diag, &multigrid->r));
  PetscCall(VecDuplicate(multigrid->r, &multigrid->z));
  PetscCall(OuterCreate_Private(multigrid));
  PetscCall(Configure_Private(pc, multigrid));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* With `vinewtonrsls`: its matrix is that of the unknowns it leaves, so these are the free ones. */
static PetscErrorCode SetUp_Multigrid(PC pc)
{
  Multigrid *multigrid;
  Vec        reduced;
  Mat        A;

  PetscFunctionBeginUser;
  PetscCall(Get_Private(pc, &multigrid));
  if (!multigrid->num) {
    PetscCall(FaultRaise(PetscObjectComm((PetscObject)pc),
                         "-pc_type %s: needs a mesh that was refined, by -dm_refine 1 or more", PCTRUNCATEDMG));
  }
  if (!multigrid->snes) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ISDestroy(&multigrid->left));
  PetscCall(VecScatterDestroy(&multigrid->scatter));
  PetscCall(SNESVIGetInactiveSet(multigrid->snes, &multigrid->left));
  PetscCall(PetscObjectReference((PetscObject)multigrid->left));
  PetscCall(PCGetOperators(pc, &A, NULL));
  PetscCall(MatCreateVecs(A, &reduced, NULL));
  PetscCall(VecScatterCreate(multigrid->r, multigrid->left, reduced, NULL, &multigrid->scatter));
  PetscCall(VecZeroEntries(multigrid->r));
  PetscCall(VecSet(reduced, 1));
  PetscCall(VecScatterBegin(multigrid->scatter, reduced, multigrid->r, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(multigrid->scatter, reduced, multigrid->r, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecDestroy(&reduced));
  PetscCall(Hold_Private(multigrid, multigrid->r));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* z = cycle of r; eliminated unknowns, which couple to nothing, by themselves. [in] r - is spoilt */
static PetscErrorCode Cycle_Private(Multigrid *multigrid, Vec r, Vec z)
{
  const VI     vi = multigrid->rung[multigrid->num - 1].grid->vi;
  PetscScalar *ra, *za, *alone;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(vi->num_fixed, &alone));
  PetscCall(VecGetArray(r, &ra));
  for (PetscInt i = 0; i < vi->num_fixed; i++) alone[i] = ra[vi->fixed_local[i]];
  for (PetscInt i = 0; i < vi->num_fixed; i++) ra[vi->fixed_local[i]] = 0;
  PetscCall(VecRestoreArray(r, &ra));
  PetscCall(PCApply(multigrid->mg, r, z));
  PetscCall(VecGetArray(z, &za));
  for (PetscInt i = 0; i < vi->num_fixed; i++) za[vi->fixed_local[i]] = alone[i];
  PetscCall(VecRestoreArray(z, &za));
  PetscCall(PetscFree(alone));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Apply_Multigrid(PC pc, Vec r, Vec z)
{
  Multigrid *multigrid;

  PetscFunctionBeginUser;
  PetscCall(Get_Private(pc, &multigrid));
  if (!multigrid->snes) {
    PetscCall(VecCopy(r, multigrid->r));
    PetscCall(Cycle_Private(multigrid, multigrid->r, z));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(VecZeroEntries(multigrid->r));
  PetscCall(VecScatterBegin(multigrid->scatter, r, multigrid->r, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(multigrid->scatter, r, multigrid->r, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(Cycle_Private(multigrid, multigrid->r, multigrid->z));
  PetscCall(VecScatterBegin(multigrid->scatter, multigrid->z, z, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(multigrid->scatter, multigrid->z, z, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Private(void *ctx)
{
  PetscFunctionBeginUser;
  PetscCall(Clear_Private(ctx));
  PetscCall(PetscFree(ctx));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode PCCreate_Multigrid(PC pc)
{
  Multigrid     *multigrid;
  PetscContainer container;

  PetscFunctionBeginUser;
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetSetUp(pc, SetUp_Multigrid));
  PetscCall(PCShellSetApply(pc, Apply_Multigrid));
  PetscCall(PetscObjectChangeTypeName((PetscObject)pc, PCTRUNCATEDMG));
  PetscCall(PetscNew(&multigrid));
  PetscCall(PetscContainerCreate(PetscObjectComm((PetscObject)pc), &container));
  PetscCall(PetscContainerSetPointer(container, multigrid));
  PetscCall(PetscContainerSetUserDestroy(container, Destroy_Private));
  PetscCall(PetscObjectCompose((PetscObject)pc, CONTEXT, (PetscObject)container));
  PetscCall(PetscContainerDestroy(&container));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MultigridRegister(void)
{
  PetscFunctionBeginUser;
  PetscCall(PCRegister(PCTRUNCATEDMG, PCCreate_Multigrid));
  PetscFunctionReturn(PETSC_SUCCESS);
}
