/* mglevel.c -- the operators of one level of truncated multigrid, and what held unknowns of finer levels make of them. */
#include "base/compat.h"
#include "multigrid/eigenvalue.h"
#include "multigrid/mglevel.h"
#include "multigrid/smoother.h"
#include "multigrid/truncationupdate.h"

/* A coarse unknown is held if this part of what it moves, in squares, is free at most. */
static const PetscReal NEXT_TO_NOTHING = 1e-2;

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

/* y = diag x where held */
static PetscErrorCode KeepDiagonal_Private(const Rung *rung, Vec x, Vec y)
{
  const PetscScalar *d, *xa;
  PetscScalar       *ya;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(rung->diag, &d));
  PetscCall(VecGetArrayRead(x, &xa));
  PetscCall(VecGetArray(y, &ya));
  for (PetscInt i = 0; i < rung->num; i++) ya[rung->held[i]] = d[rung->held[i]] * xa[rung->held[i]];
  PetscCall(VecRestoreArray(y, &ya));
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCall(VecRestoreArrayRead(rung->diag, &d));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y = A^ x for x that is 0 where held, but for the diagonal there */
static PetscErrorCode Mult_Rung(Mat A, Vec x, Vec y)
{
  Rung *rung;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &rung));
  PetscCall(MatMult(rung->grid->op.S, x, y));
  if (rung->grid->op.Z) PetscCall(MatMultAdd(rung->grid->op.Z, x, y, y));
  if (rung->springs) PetscCall(AddSprings_Private(rung->springs, x, y));
  if (rung->change) PetscCall(MatMultAdd(rung->change, x, y, y));
  rung->hierarchy->work += rung->grid->share;
  PetscCall(KeepDiagonal_Private(rung, x, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The same for an x that is 0 where active, whatever it is where unknowns were eliminated: to iterate with. */
static PetscErrorCode Mult_Outer(Mat A, Vec x, Vec y)
{
  Rung *rung;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &rung));
  PetscCall(MatMult(rung->grid->op.A, x, y));
  rung->hierarchy->work += rung->grid->share;
  PetscCall(KeepDiagonal_Private(rung, x, y));
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
  const Operator    *op = &rung->grid->op;
  const PetscScalar *f;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(rung->free, &n));
  PetscCall(VecGetArrayRead(rung->free, &f));
  rung->num = 0;
  for (PetscInt i = 0; i < n; i++) rung->num += f[i] == 0;
  rung->num_truncated = rung->num;
  PetscCall(PetscFree(rung->held));
  PetscCall(PetscMalloc1(rung->num + op->num_fixed, &rung->held));
  rung->num = 0;
  for (PetscInt i = 0; i < n; i++)
    if (f[i] == 0) rung->held[rung->num++] = i;
  for (PetscInt i = 0; i < op->num_fixed; i++) rung->held[rung->num++] = op->fixed[i];
  PetscCall(VecRestoreArrayRead(rung->free, &f));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* On a mesh, A^ is near that of a body held there, and has no larger eigenvalues. Where there is none, a few unknowns that
   are cut off may double them, near those that are: so that is where one looks. */
static PetscErrorCode SetLargest_Private(Rung *rung)
{
  PetscReal there;
  Vec       seed, b;

  PetscFunctionBeginUser;
  rung->largest = rung->grid->largest;
  if (!rung->grid->nodes || !rung->change) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDuplicate(rung->free, &seed));
  PetscCall(VecDuplicate(rung->free, &b));
  PetscCall(EigenvalueSeed(seed));
  PetscCall(MatMult(rung->change, seed, b));
  PetscCall(VecPointwiseMult(b, b, rung->free));
  PetscCall(VecNorm(b, NORM_INFINITY, &there));
  if (there > 0) {
    PetscCall(EigenvalueLargest(rung->A, NULL, b, &there));
    rung->largest = PetscMax(rung->largest, there);
  }
  PetscCall(VecDestroy(&seed));
  PetscCall(VecDestroy(&b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RungsHold(PetscInt num, Rung rungs[], Vec free)
{
  Mat dC = NULL, strip = NULL;
  Vec is;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(free, &is));
  PetscCall(VecCopy(free, is));
  for (PetscInt l = num - 1; l >= 0; l--) {
    Rung *rung = &rungs[l];

    if (l)
      PetscCall(
          StripCreate(&rung->grid->op, rung->change, dC, rung->free, is, rung->ready ? NULL : rung->springs, &strip));
    if (rung->change && dC) PetscCall(MatAXPY(rung->change, 1, dC, DIFFERENT_NONZERO_PATTERN));
    if (dC && !rung->change) PetscCall(PetscObjectReference((PetscObject)dC));
    if (dC && !rung->change) rung->change = dC;
    PetscCall(MatDestroy(&dC));
    PetscCall(VecCopy(is, rung->free));
    PetscCall(VecDestroy(&is));
    PetscCall(List_Private(rung));
    PetscCall(SetDiagonal_Private(rung));
    PetscCall(SmootherHold(rung->grid->S, rung->change, rung->num, rung->held, &rung->S));
    rung->ready = PETSC_TRUE;
    if (!l) break;
    PetscCall(SetLargest_Private(rung));
    PetscCall(StripRestrict(strip, rung->grid->P, &dC));
    PetscCall(MatDestroy(&strip));
    PetscCall(VecDuplicate(rungs[l - 1].free, &is));
    PetscCall(HoldCoarser_Private(rung, is));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Without a mesh two displacements of a coarse node may move the same unknown after the other one was cut off: what tells them apart is any resistance. */
static PetscErrorCode Stiffen_Private(Mat A)
{
  static const PetscReal A_LITTLE = 1e-10;
  Vec                    diag;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(A, &diag, NULL));
  PetscCall(MatGetDiagonal(A, diag));
  PetscCall(VecScale(diag, A_LITTLE));
  PetscCall(MatDiagonalSet(A, diag, ADD_VALUES));
  PetscCall(VecDestroy(&diag));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RungAssemble(Rung *rung)
{
  PetscInt *rows, begin;

  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&rung->A));
  PetscCall(MatDuplicate(rung->grid->op.A, MAT_COPY_VALUES, &rung->A));
  if (rung->change) PetscCall(MatAXPY(rung->A, 1, rung->change, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatGetOwnershipRange(rung->A, &begin, NULL));
  PetscCall(PetscMalloc1(rung->num, &rows));
  for (PetscInt i = 0; i < rung->num_truncated; i++) rows[i] = begin + rung->held[i];
  PetscCall(MatZeroRowsColumns(rung->A, rung->num_truncated, rows, 1, NULL, NULL));
  PetscCall(PetscFree(rows));
  if (rung->grid->nodes) PetscCall(Stiffen_Private(rung->A));
  PetscCall(MatSetOption(rung->A, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Shells on a level above the coarsest. */
static PetscErrorCode CreateShells_Private(Rung *rung)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)rung->grid->op.A);
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

PetscErrorCode RungCreateOuter(Rung *rung, Mat *A)
{
  PetscInt n;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(rung->grid->op.A, &n, NULL));
  PetscCall(
      MatCreateShell(PetscObjectComm((PetscObject)rung->grid->op.A), n, n, PETSC_DETERMINE, PETSC_DETERMINE, rung, A));
  PetscCall(MatShellSetOperation(*A, MATOP_MULT, (void (*)(void))Mult_Outer));
  PetscCall(MatShellSetOperation(*A, MATOP_GET_DIAGONAL, (void (*)(void))GetDiagonal_Rung));
  PetscCall(MatSetOption(*A, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RungCreate(Hierarchy hierarchy, PetscInt l, Rung *rung)
{
  PetscFunctionBeginUser;
  rung->hierarchy = hierarchy;
  rung->grid      = &hierarchy->grid[l];
  rung->largest   = rung->grid->largest;
  rung->springs   = rung->grid->op.W;
  PetscCall(VecDuplicate(rung->grid->diag, &rung->diag));
  PetscCall(VecDuplicate(rung->grid->diag, &rung->free));
  PetscCall(VecSet(rung->free, 1));
  PetscCall(SmootherHold(rung->grid->S, NULL, 0, NULL, &rung->S));
  if (l) PetscCall(CreateShells_Private(rung));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode RungDestroy(Rung *rung)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&rung->change));
  PetscCall(MatDestroy(&rung->A));
  PetscCall(MatDestroy(&rung->P));
  PetscCall(MatDestroy(&rung->S));
  PetscCall(VecDestroy(&rung->diag));
  PetscCall(VecDestroy(&rung->free));
  PetscCall(PetscFree(rung->held));
  PetscFunctionReturn(PETSC_SUCCESS);
}
