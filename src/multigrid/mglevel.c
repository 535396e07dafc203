/* mglevel.c -- the operators of one level of truncated multigrid, with fixed unknowns of finer levels. */
#include "base/compat.h"
#include "multigrid/eigenvalue.h"
#include "multigrid/mglevel.h"
#include "multigrid/smoother.h"
#include "multigrid/truncationupdate.h"

/* y := y + W x; W is nonzero in a few places */
static PetscErrorCode MGLevelAddRegularization_Private(Vec W, Vec x, Vec y)
{
  const PetscScalar *w, *xa;
  PetscScalar       *ya;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(x, &n));
  PetscCall(VecGetArrayRead(W, &w));
  PetscCall(VecGetArrayRead(x, &xa));
  PetscCall(VecGetArray(y, &ya));
  for (PetscInt i = 0; i < n; i++) ya[i] += w[i] * xa[i];
  PetscCall(VecRestoreArray(y, &ya));
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCall(VecRestoreArrayRead(W, &w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y = diag x where fixed */
static PetscErrorCode MGLevelMultFixed_Private(const MGLevel *level, Vec x, Vec y)
{
  const PetscScalar *d, *xa;
  PetscScalar       *ya;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(level->diag, &d));
  PetscCall(VecGetArrayRead(x, &xa));
  PetscCall(VecGetArray(y, &ya));
  for (PetscInt i = 0; i < level->num; i++) ya[level->fixed[i]] = d[level->fixed[i]] * xa[level->fixed[i]];
  PetscCall(VecRestoreArray(y, &ya));
  PetscCall(VecRestoreArrayRead(x, &xa));
  PetscCall(VecRestoreArrayRead(level->diag, &d));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y = A^ x for x that is 0 where fixed, but for the diagonal there; within the region, or everywhere for x
   that is 0 outside of it */
static PetscErrorCode Mult_MGLevel(Mat A, Vec x, Vec y)
{
  MGLevel *level;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &level));
  PetscCall(MatMult(level->base->op.S, x, y));
  if (level->W) PetscCall(MGLevelAddRegularization_Private(level->W, x, y));
  if (level->change) PetscCall(MatMultAdd(level->change, x, y, y));
  level->hierarchy->work += level->base->share * level->base->part;
  PetscCall(MGLevelMultFixed_Private(level, x, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The same for an x that is 0 where active, and arbitrary where the operator fixes unknowns. */
static PetscErrorCode MultOperator_MGLevel(Mat A, Vec x, Vec y)
{
  MGLevel *level;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &level));
  PetscCall(MatMult(level->base->op.A, x, y));
  level->hierarchy->work += level->base->share;
  PetscCall(MGLevelMultFixed_Private(level, x, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode GetDiagonal_MGLevel(Mat A, Vec diag)
{
  MGLevel *level;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(A, &level));
  PetscCall(VecCopy(level->diag, diag));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* z = diag^-1 r in the region, 0 outside of it */
static PetscErrorCode Apply_MGLevel(PC pc, Vec r, Vec z)
{
  MGLevel           *level;
  const PetscScalar *in, *d, *ra;
  PetscScalar       *za;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &level));
  PetscCall(VecGetLocalSize(r, &n));
  PetscCall(VecGetArrayRead(level->base->region, &in));
  PetscCall(VecGetArrayRead(level->diag, &d));
  PetscCall(VecGetArrayRead(r, &ra));
  PetscCall(VecGetArrayWrite(z, &za));
  for (PetscInt i = 0; i < n; i++) za[i] = in[i] == 0 ? 0 : ra[i] / d[i];
  PetscCall(VecRestoreArrayWrite(z, &za));
  PetscCall(VecRestoreArrayRead(r, &ra));
  PetscCall(VecRestoreArrayRead(level->diag, &d));
  PetscCall(VecRestoreArrayRead(level->base->region, &in));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y = M P x */
static PetscErrorCode Interpolate_MGLevel(Mat P, Vec x, Vec y)
{
  MGLevel     *level;
  PetscScalar *ya;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(P, &level));
  PetscCall(MatMult(level->base->P, x, y));
  PetscCall(VecGetArray(y, &ya));
  for (PetscInt i = 0; i < level->num; i++) ya[level->fixed[i]] = 0;
  PetscCall(VecRestoreArray(y, &ya));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* z = y + M (P x + Q v), v of the last restriction. PETSc would keep a vector for M P x. */
static PetscErrorCode InterpolateAdd_MGLevel(Mat P, Vec x, Vec y, Vec z)
{
  MGLevel           *level;
  const PetscScalar *ya;
  PetscScalar       *za, *fixed;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(P, &level));
  PetscCall(PetscMalloc1(level->num, &fixed));
  PetscCall(VecGetArrayRead(y, &ya));
  for (PetscInt i = 0; i < level->num; i++) fixed[i] = ya[level->fixed[i]];
  PetscCall(VecRestoreArrayRead(y, &ya));
  PetscCall(MatMultAdd(level->base->P, x, y, z));
  if (level->wave) PetscCall(MatMultAdd(level->base->op.waves, level->wave, z, z));
  PetscCall(VecGetArray(z, &za));
  for (PetscInt i = 0; i < level->num; i++) za[level->fixed[i]] = fixed[i];
  PetscCall(VecRestoreArray(z, &za));
  PetscCall(PetscFree(fixed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* x = P'y for y that is 0 where fixed, as residuals of A^ are; v = (Q'A Q)^-1 Q'y with the waves Q */
static PetscErrorCode Restrict_MGLevel(Mat P, Vec y, Vec x)
{
  MGLevel *level;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(P, &level));
  PetscCall(MatMultTranspose(level->base->P, y, x));
  if (!level->wave) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatMultTranspose(level->base->op.waves, y, level->wave_force));
  PetscCall(PCApply(level->base->wave_solve, level->wave_force, level->wave));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The diagonal of A^. */
static PetscErrorCode MGLevelSetDiagonal_Private(MGLevel *level)
{
  const PetscScalar *own;
  PetscScalar       *diag;

  PetscFunctionBeginUser;
  if (level->change) {
    PetscCall(MatGetDiagonal(level->change, level->diag));
    PetscCall(VecAXPY(level->diag, 1, level->base->diag));
  } else {
    PetscCall(VecCopy(level->base->diag, level->diag));
  }
  PetscCall(VecGetArray(level->diag, &diag));
  PetscCall(VecGetArrayRead(level->base->diag, &own));
  for (PetscInt i = 0; i < level->num; i++) diag[level->fixed[i]] = own[level->fixed[i]];
  PetscCall(VecRestoreArrayRead(level->base->diag, &own));
  PetscCall(VecRestoreArray(level->diag, &diag));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* M of the coarser level: a coarse unknown whose prolongation is mostly fixed is fixed. [out] free - on the
   coarser level */
static PetscErrorCode MGLevelSetFreeCoarser_Private(const MGLevel *fine, Vec free)
{
  const PetscScalar *all, *gone;
  PetscScalar       *f;
  PetscInt           begin, n;
  Vec                fixed;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(fine->base->weight, &fixed));
  PetscCall(VecZeroEntries(fixed));
  PetscCall(MatGetOwnershipRange(fine->base->P, &begin, NULL));
  for (PetscInt i = 0; i < fine->num_truncated; i++) {
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(fine->base->P, begin + fine->fixed[i], &num, &columns, &values));
    for (PetscInt j = 0; j < num; j++) PetscCall(VecSetValue(fixed, columns[j], values[j] * values[j], ADD_VALUES));
    PetscCall(MatRestoreRow(fine->base->P, begin + fine->fixed[i], &num, &columns, &values));
  }
  PetscCall(VecAssemblyBegin(fixed));
  PetscCall(VecAssemblyEnd(fixed));
  PetscCall(VecGetLocalSize(fixed, &n));
  PetscCall(VecGetArrayRead(fine->base->weight, &all));
  PetscCall(VecGetArrayRead(fixed, &gone));
  PetscCall(VecGetArray(free, &f));
  for (PetscInt i = 0; i < n; i++) {
    const PetscReal left = PetscRealPart(all[i] - gone[i]);

    f[i] = PetscRealPart(gone[i]) > 0 && left <= OPERATOR_MIN_FREE * PetscRealPart(all[i]) ? 0 : 1;
  }
  PetscCall(VecRestoreArray(free, &f));
  PetscCall(VecRestoreArrayRead(fixed, &gone));
  PetscCall(VecRestoreArrayRead(fine->base->weight, &all));
  PetscCall(VecDestroy(&fixed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Lists fixed unknowns, those of the operator last. */
static PetscErrorCode MGLevelListFixed_Private(MGLevel *level)
{
  const Operator    *op = &level->base->op;
  const PetscScalar *f;
  PetscInt           n;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(level->free, &n));
  PetscCall(VecGetArrayRead(level->free, &f));
  level->num = 0;
  for (PetscInt i = 0; i < n; i++) level->num += f[i] == 0;
  level->num_truncated = level->num;
  PetscCall(PetscFree(level->fixed));
  PetscCall(PetscMalloc1(level->num + op->num_fixed, &level->fixed));
  level->num = 0;
  for (PetscInt i = 0; i < n; i++)
    if (f[i] == 0) level->fixed[level->num++] = i;
  for (PetscInt i = 0; i < op->num_fixed; i++) level->fixed[level->num++] = op->fixed[i];
  PetscCall(VecRestoreArrayRead(level->free, &f));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* On a mesh, A^ is close to the matrix of a supported body and has no larger eigenvalues. On levels of nodes
   truncation may double them near fixed unknowns: the estimate starts there. */
static PetscErrorCode MGLevelSetLargest_Private(MGLevel *level)
{
  PetscReal there;
  Vec       seed, b;

  PetscFunctionBeginUser;
  level->largest = level->base->largest;
  if (!level->base->nodes || !level->change) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecDuplicate(level->free, &seed));
  PetscCall(VecDuplicate(level->free, &b));
  PetscCall(EigenvalueSeed(seed));
  PetscCall(MatMult(level->change, seed, b));
  PetscCall(VecPointwiseMult(b, b, level->free));
  PetscCall(VecNorm(b, NORM_INFINITY, &there));
  if (there > 0) {
    PetscCall(EigenvalueLargest(level->A, NULL, b, &there));
    level->largest = PetscMax(level->largest, there);
  }
  PetscCall(VecDestroy(&seed));
  PetscCall(VecDestroy(&b));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* dC = more - change on the finest level. [out] dC - NULL if that is 0; owned by the caller */
static PetscErrorCode MGLevelChangeFinest_Private(const MGLevel *level, Mat more, Mat *dC)
{
  *dC = NULL;
  PetscFunctionBeginUser;
  if (!more && !level->change) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatDuplicate(more ? more : level->change, MAT_COPY_VALUES, dC));
  if (!more) PetscCall(MatScale(*dC, -1));
  if (more && level->change) PetscCall(MatAXPY(*dC, -1, level->change, DIFFERENT_NONZERO_PATTERN));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The change of the coarser level.
   [in] dC - of this one, or NULL; [in] is - M from now on; [out] coarser - owned by the caller */
static PetscErrorCode MGLevelRestrictChange_Private(const MGLevel *level, Mat dC, Vec is, Mat *coarser)
{
  const TruncationChange change = {
      .C = level->change, .dC = dC, .was = level->free, .is = is, .W = level->ready ? NULL : level->W};

  PetscFunctionBeginUser;
  PetscCall(TruncationUpdateRestrict(&level->base->op, &change, level->base->P, coarser));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MGLevelSetFree(PetscInt num, MGLevel levels[], Vec free, Mat more)
{
  Mat dC = NULL, coarser = NULL;
  Vec is;

  PetscFunctionBeginUser;
  PetscCall(MGLevelChangeFinest_Private(&levels[num - 1], more, &dC));
  PetscCall(VecDuplicate(free, &is));
  PetscCall(VecCopy(free, is));
  for (PetscInt l = num - 1; l >= 0; l--) {
    MGLevel *level = &levels[l];

    if (l) PetscCall(MGLevelRestrictChange_Private(level, dC, is, &coarser));
    if (level->change && dC) PetscCall(TruncationUpdateAdd(level->change, dC));
    if (dC && !level->change) PetscCall(PetscObjectReference((PetscObject)dC));
    if (dC && !level->change) level->change = dC;
    if (l == num - 1 && !more) PetscCall(MatDestroy(&level->change)); // it is 0
    PetscCall(MatDestroy(&dC));
    PetscCall(VecCopy(is, level->free));
    PetscCall(VecDestroy(&is));
    PetscCall(MGLevelListFixed_Private(level));
    PetscCall(MGLevelSetDiagonal_Private(level));
    PetscCall(SmootherSetFixed(&level->base->op, level->base->S, level->change, level->num, level->fixed, &level->S));
    level->ready = PETSC_TRUE;
    if (!l) break;
    PetscCall(MGLevelSetLargest_Private(level));
    dC = coarser;
    PetscCall(VecDuplicate(levels[l - 1].free, &is));
    PetscCall(MGLevelSetFreeCoarser_Private(level, is));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* On levels of nodes two displacements of a coarse node may become dependent after truncation: a small
   diagonal term keeps the matrix definite. */
static PetscErrorCode MGLevelStiffen_Private(Mat A)
{
  static const PetscReal DIAGONAL_SHIFT = 1e-10;
  Vec                    diag;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(A, &diag, NULL));
  PetscCall(MatGetDiagonal(A, diag));
  PetscCall(VecScale(diag, DIAGONAL_SHIFT));
  PetscCall(MatDiagonalSet(A, diag, ADD_VALUES));
  PetscCall(VecDestroy(&diag));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MGLevelAssemble(MGLevel *level)
{
  PetscInt *rows, begin;

  PetscFunctionBeginUser;
  PetscCall(TruncationUpdateSum(level->base->op.A, level->change, &level->A));
  PetscCall(MatGetOwnershipRange(level->A, &begin, NULL));
  PetscCall(PetscMalloc1(level->num, &rows));
  for (PetscInt i = 0; i < level->num_truncated; i++) rows[i] = begin + level->fixed[i];
  PetscCall(MatZeroRowsColumns(level->A, level->num_truncated, rows, 1, NULL, NULL));
  PetscCall(PetscFree(rows));
  if (level->base->nodes) PetscCall(MGLevelStiffen_Private(level->A));
  PetscCall(MatSetOption(level->A, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Shells on levels above the coarsest. */
static PetscErrorCode MGLevelCreateShells_Private(MGLevel *level)
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)level->base->op.A);
  PetscInt       n, coarse;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(level->base->P, &n, &coarse));
  PetscCall(MatCreateShell(comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, level, &level->A));
  PetscCall(MatShellSetOperation(level->A, MATOP_MULT, (void (*)(void))Mult_MGLevel));
  PetscCall(MatShellSetOperation(level->A, MATOP_GET_DIAGONAL, (void (*)(void))GetDiagonal_MGLevel));
  PetscCall(MatSetOption(level->A, MAT_SPD, PETSC_TRUE));
  PetscCall(MatCreateShell(comm, n, coarse, PETSC_DETERMINE, PETSC_DETERMINE, level, &level->P));
  PetscCall(MatShellSetOperation(level->P, MATOP_MULT, (void (*)(void))Interpolate_MGLevel));
  PetscCall(MatShellSetOperation(level->P, MATOP_MULT_ADD, (void (*)(void))InterpolateAdd_MGLevel));
  PetscCall(MatShellSetOperation(level->P, MATOP_MULT_TRANSPOSE, (void (*)(void))Restrict_MGLevel));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MGLevelCreateOperator(MGLevel *level, Mat *A)
{
  PetscInt n;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(level->base->op.A, &n, NULL));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)level->base->op.A), n, n, PETSC_DETERMINE, PETSC_DETERMINE,
                           level, A));
  PetscCall(MatShellSetOperation(*A, MATOP_MULT, (void (*)(void))MultOperator_MGLevel));
  PetscCall(MatShellSetOperation(*A, MATOP_GET_DIAGONAL, (void (*)(void))GetDiagonal_MGLevel));
  PetscCall(MatSetOption(*A, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MGLevelSetPC(MGLevel *level, PC pc)
{
  PetscFunctionBeginUser;
  if (!level->base->region) {
    PetscCall(SmootherSetPC(pc, level->S));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetName(pc, "diagonal in a region"));
  PetscCall(PCShellSetContext(pc, level));
  PetscCall(PCShellSetApply(pc, Apply_MGLevel));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MGLevelCreate(Hierarchy hierarchy, PetscInt l, MGLevel *level)
{
  PetscFunctionBeginUser;
  level->hierarchy = hierarchy;
  level->base      = &hierarchy->level[l];
  level->largest   = level->base->largest;
  level->W         = level->base->op.W;
  PetscCall(VecDuplicate(level->base->diag, &level->diag));
  PetscCall(VecDuplicate(level->base->diag, &level->free));
  PetscCall(VecSet(level->free, 1));
  PetscCall(SmootherSetFixed(&level->base->op, level->base->S, NULL, 0, NULL, &level->S));
  if (l) PetscCall(MGLevelCreateShells_Private(level));
  if (!level->base->wave_solve) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatCreateVecs(level->base->op.waves, &level->wave, NULL));
  PetscCall(VecDuplicate(level->wave, &level->wave_force));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MGLevelDestroy(MGLevel *level)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&level->change));
  PetscCall(MatDestroy(&level->A));
  PetscCall(MatDestroy(&level->P));
  PetscCall(MatDestroy(&level->S));
  PetscCall(VecDestroy(&level->wave));
  PetscCall(VecDestroy(&level->wave_force));
  PetscCall(VecDestroy(&level->diag));
  PetscCall(VecDestroy(&level->free));
  PetscCall(PetscFree(level->fixed));
  PetscFunctionReturn(PETSC_SUCCESS);
}
