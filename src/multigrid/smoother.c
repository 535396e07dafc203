/* smoother.c -- the smoother: blocks of couplings, or the diagonal.

   Where cells are much longer than wide, an error may vary slowly along the short edges. It may then be no
   smooth function on the coarser level [1]. Smoothing must then solve for the couplings along short edges, in
   lines and planes of nodes (blocksmoother.c). S_u is K without couplings between blocks: definite like K,
   with sparse factors. Nodes without block have their diagonal.

   These are couplings of displacements u. The unknowns are y, u = T y, and an unknown of the mortar side
   moves the nonmortar side as well. S = T'S_u T contains the stiffness of that side, and lines that continue
   across contact. The eigenvalues of S and T'K T are those of S_u and K.

   References: [1] Trottenberg, Oosterlee, Schueller, Multigrid, 2001, section 5.1. */
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "multigrid/bodysmoother.h"
#include "multigrid/blocksmoother.h"
#include "multigrid/dealtfactor.h"
#include "multigrid/envelopefactor.h"
#include "multigrid/galerkin.h"
#include "multigrid/patchsmoother.h"
#include "multigrid/smoother.h"
#include "multigrid/truncationupdate.h"

/* Limit of the diagonal that condensation adds, relative to the diagonal before it; equal sides: 1. */
static const PetscReal STIFF_SIDE = 2;
/* The same on levels of bisected cells, where the diagonal smooths a region alone. Iterations on the last
   mesh of `gears` with equal bodies, diagonal and blocks: 9 and 9; with one ten times stiffer 17 and 9. */
static const PetscReal STIFF_SIDE_HALVED = 10;
/* Name under which T'S_u T is composed with the shell that does without it. */
static const char CONDENSED[] = "MortiseSmootherCondensed";

/* Entries of S_u in one row of K: couplings within the block of the node, or its diagonal.
   [in] label - own nodes, then ghosts; [out] num - entries, 1 for the diagonal; [out] column, value - NULL to
   count only */
static PetscErrorCode SmootherGetRow_Private(const Operator *op, const GhostExchange *ghosts, const PetscReal label[],
                                             PetscInt row, PetscInt *num, PetscInt column[], PetscScalar value[])
{
  const PetscInt     dim = op->dim, global = dim * ghosts->begin + row;
  PetscInt           length, at, others = 0;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  *num = 0;
  PetscCall(MatGetRow(op->K, global, &length, &columns, value ? &values : NULL));
  for (PetscInt j = 0; j < length; j++) {
    PetscCall(GhostExchangeFind(ghosts, columns[j] / dim, &at));
    if (label[at] != label[row / dim]) continue;
    others += at != row / dim;
    if (column) column[*num] = columns[j];
    if (value) value[*num] = values[j] / op->stiffness;
    ++*num;
  }
  if (!others) *num = 1;
  PetscCall(MatRestoreRow(op->K, global, &length, &columns, value ? &values : NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* S_u. [in] label - own nodes, then ghosts */
static PetscErrorCode SmootherCreateBlocks_Private(const Operator *op, const GhostExchange *ghosts,
                                                   const PetscReal label[], Mat *S)
{
  const PetscInt     n = op->dim * ghosts->n;
  PetscInt          *start, *column, num = 0;
  PetscScalar       *value;
  const PetscScalar *diagonal;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n + 1, &start));
  start[0] = 0;
  for (PetscInt i = 0; i < n; i++) {
    if (i % op->dim == 0)
      PetscCall(SmootherGetRow_Private(op, ghosts, label, i, &num, NULL, NULL)); // K has full blocks
    start[i + 1] = start[i] + num;
  }
  PetscCall(PetscMalloc2(start[n], &column, start[n], &value));
  PetscCall(VecGetArrayRead(op->diagonal, &diagonal));
  for (PetscInt i = 0; i < n; i++) {
    column[start[i]] = op->dim * ghosts->begin + i;
    value[start[i]]  = diagonal[i] / op->stiffness;
    if (start[i + 1] > start[i] + 1)
      PetscCall(SmootherGetRow_Private(op, ghosts, label, i, &num, &column[start[i]], &value[start[i]]));
  }
  PetscCall(VecRestoreArrayRead(op->diagonal, &diagonal));
  PetscCall(CSRMatrixCreate(PetscObjectComm((PetscObject)op->K), &(CSRRows){op->dim, n, n, start, column, value}, S));
  PetscCall(PetscFree(start));
  PetscCall(PetscFree2(column, value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a nonmortar side is much stiffer than its mortar side. */
static PetscErrorCode SmootherFindStiffSide_Private(const Operator *op, PetscBool *weighs)
{
  const PetscReal    limit = op->halvings ? STIFF_SIDE_HALVED : STIFF_SIDE;
  PetscInt           n;
  const PetscScalar *z, *k;
  PetscBool         *excluded; /* unknowns of the nonmortar side and fixed ones */
  Vec                diag;

  PetscFunctionBeginUser;
  *weighs = PETSC_FALSE;
  if (!op->Z) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecGetLocalSize(op->diagonal, &n));
  PetscCall(PetscCalloc1(n, &excluded));
  for (PetscInt i = 0; i < op->num_constrained; i++) excluded[op->constrained[i]] = PETSC_TRUE;
  for (PetscInt i = 0; i < op->num_fixed; i++) excluded[op->fixed[i]] = PETSC_TRUE;
  PetscCall(MatCreateVecs(op->Z, &diag, NULL));
  PetscCall(MatGetDiagonal(op->Z, diag));
  PetscCall(VecGetArrayRead(diag, &z));
  PetscCall(VecGetArrayRead(op->diagonal, &k));
  for (PetscInt i = 0; i < n; i++)
    if (!excluded[i] && PetscRealPart(z[i]) > limit * PetscRealPart(k[i]) / op->stiffness) *weighs = PETSC_TRUE;
  PetscCall(VecRestoreArrayRead(diag, &z));
  PetscCall(VecRestoreArrayRead(op->diagonal, &k));
  PetscCall(VecDestroy(&diag));
  PetscCall(PetscFree(excluded));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the diagonal of Z to S. */
static PetscErrorCode SmootherAddDiagonal_Private(const Operator *op, Mat S)
{
  Vec more, zero;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(op->K, &more, &zero));
  PetscCall(MatGetDiagonal(op->Z, more));
  PetscCall(VecZeroEntries(zero));
  PetscCall(VecPointwiseMax(more, more, zero));
  PetscCall(MatDiagonalSet(S, more, ADD_VALUES));
  PetscCall(VecDestroy(&more));
  PetscCall(VecDestroy(&zero));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* T'S_u T without fixed unknowns; not if it would be dense, as few nodes of one side face many of the other.
   [in] blocks - S_u; [out] S - keeps its factors */
static PetscErrorCode SmootherCondense_Private(const Operator *op, Mat blocks, Mat *S)
{
  MatInfo   mine, whole;
  PetscInt  begin, *rows;
  PetscBool dense = PETSC_FALSE;

  PetscFunctionBeginUser;
  if (op->T) {
    PetscCall(GalerkinProduct(blocks, op->T, S));
    PetscCall(MatGetInfo(*S, MAT_GLOBAL_SUM, &mine));
    PetscCall(MatGetInfo(op->K, MAT_GLOBAL_SUM, &whole));
    dense = (PetscBool)(mine.nz_used > whole.nz_used);
    if (dense) PetscCall(MatDestroy(S));
  }
  if (!op->T || dense) PetscCall(MatDuplicate(blocks, MAT_COPY_VALUES, S));
  if (dense) PetscCall(SmootherAddDiagonal_Private(op, *S));
  PetscCall(MatGetOwnershipRange(*S, &begin, NULL));
  PetscCall(PetscMalloc1(op->num_fixed, &rows));
  for (PetscInt i = 0; i < op->num_fixed; i++) rows[i] = begin + op->fixed[i];
  PetscCall(MatZeroRowsColumns(*S, op->num_fixed, rows, 1, NULL, NULL));
  PetscCall(PetscFree(rows));
  PetscCall(MatSetOption(*S, MAT_SPD, PETSC_TRUE));
  PetscCall(EnvelopeFactorKeepLike(*S, blocks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* S from S_u. On the finest level active sets change S body by body, where that costs less. */
static PetscErrorCode SmootherCreateFromBlocks_Private(const Operator *op, PetscBool finest, Mat blocks, Mat *S)
{
  PetscFunctionBeginUser;
  *S = NULL;
  if (finest && op->T && !op->slips) PetscCall(BodySmootherCreateOfBlocks(op, blocks, S));
  if (!*S) PetscCall(SmootherCondense_Private(op, blocks, S));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherDependsOnFinest(const Operator *op, PetscBool *depends)
{
  PetscFunctionBeginUser;
  PetscCall(SmootherFindStiffSide_Private(op, depends));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, depends, 1, MPIU_BOOL, MPI_LOR, PetscObjectComm((PetscObject)op->K)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Searches for blocks. [in] wanted - even if cells are not long; [in,out] round - as of SmootherCreate();
   [out] blocks - S_u, or NULL */
static PetscErrorCode SmootherFindBlocks_Private(const Operator *op, PetscBool wanted, PetscBool *round, Mat *blocks)
{
  PetscReal    *label;
  PetscBool     found;
  GhostExchange ghosts;

  PetscFunctionBeginUser;
  *blocks = NULL;
  if (*round && !wanted) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(GhostExchangeCreate(op->K, op->dim, &ghosts));
  PetscCall(PetscMalloc1(ghosts.n + ghosts.num, &label));
  PetscCall(BlockSmootherLabel(op, &ghosts, wanted, label, &found, round));
  if (found) PetscCall(SmootherCreateBlocks_Private(op, &ghosts, label, blocks));
  if (found) PetscCall(EnvelopeFactorKeep(*blocks, op->dim, label));
  PetscCall(PetscFree(label));
  PetscCall(GhostExchangeDestroy(&ghosts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherCreate(const Operator *op, PetscBool finest, PetscBool single, PetscBool *round, Mat *S)
{
  PetscBool weighs;
  Mat       blocks;

  PetscFunctionBeginUser;
  *S = NULL;
  if (op->tight) {
    PetscCall(PatchSmootherCreate(op, S));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(SmootherDependsOnFinest(op, &weighs));
  PetscCall(SmootherFindBlocks_Private(op, (PetscBool)(weighs && !finest), round, &blocks));
  if (blocks)
    PetscCall(SmootherCreateFromBlocks_Private(op, finest, blocks, S));
  else if (finest && op->T && (weighs || single))
    PetscCall(BodySmootherCreate(op, S));
  PetscCall(MatDestroy(&blocks));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Constrains S body by body. [in,out] from - T'S_u T if that costs less, or A changes otherwise; [out] S */
static PetscErrorCode SmootherConstrain_Private(const Operator *op, Mat change, PetscInt num, const PetscInt fixed[],
                                                Mat *from, Mat *S)
{
  PetscBool done;
  Mat       blocks, condensed;

  PetscFunctionBeginUser;
  PetscCall(BodySmootherGetBlocks(*from, &blocks));
  done = (PetscBool) !(blocks && change);
  if (done) PetscCall(BodySmootherSetFixed(*from, num, fixed, &done));
  if (done) {
    PetscCall(MatDestroy(S));
    PetscCall(PetscObjectReference((PetscObject)*from));
    *S = *from;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscObjectQuery((PetscObject)*from, CONDENSED, (PetscObject *)&condensed));
  if (!condensed) {
    PetscCall(SmootherCondense_Private(op, blocks, &condensed));
    PetscCall(PetscObjectCompose((PetscObject)*from, CONDENSED, (PetscObject)condensed));
    PetscCall(PetscObjectDereference((PetscObject)condensed));
  }
  if (*S == *from) PetscCall(MatDestroy(S));
  *from = condensed;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherSetFixed(const Operator *op, Mat from, Mat change, PetscInt num, const PetscInt fixed[], Mat *S)
{
  PetscInt  begin, *rows;
  PetscBool by_body, patches;

  PetscFunctionBeginUser;
  if (!from) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PatchSmootherIs(from, &patches, NULL));
  if (patches) {
    PetscCall(MatDestroy(S));
    PetscCall(PatchSmootherSetFixed(from, change, num, fixed, S));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(BodySmootherIs(from, &by_body));
  if (by_body) {
    const Mat shell = from;

    PetscCall(SmootherConstrain_Private(op, change, num, fixed, &from, S));
    if (from == shell) PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(TruncationUpdateSum(from, change, S));
  PetscCall(MatGetOwnershipRange(*S, &begin, NULL));
  PetscCall(PetscMalloc1(num, &rows));
  for (PetscInt i = 0; i < num; i++) rows[i] = begin + fixed[i];
  PetscCall(MatZeroRowsColumns(*S, num, rows, 1, NULL, NULL));
  PetscCall(PetscFree(rows));
  PetscCall(MatSetOption(*S, MAT_SPD, PETSC_TRUE));
  PetscCall(EnvelopeFactorSetBase(*S, from));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherScale(Mat S, PetscReal factor)
{
  PetscBool by_body, patches;
  Mat       blocks = NULL;

  PetscFunctionBeginUser;
  PetscCall(PatchSmootherIs(S, &patches, NULL));
  if (patches) {
    PetscCall(PatchSmootherScale(S, factor));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(BodySmootherIs(S, &by_body));
  PetscCall(MatScale(S, by_body ? 1 / factor : factor));
  if (by_body) PetscCall(BodySmootherGetBlocks(S, &blocks));
  if (blocks) PetscCall(MatScale(blocks, factor)); // the shell has its factors from before
  if (!by_body) PetscCall(EnvelopeFactorScale(S, factor));
  if (!by_body) PetscCall(DealtFactorScale(S, factor));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Lines and narrow planes within their envelope. CHOLMOD is fast for the dense parts of the factors of wide
   planes; for a rank without rows it reports an error. */
static PetscErrorCode SmootherConfigureFactor_Private(PC pc)
{
  PetscInt  n;
  PetscBool available, done;
  Mat       S;

  PetscFunctionBeginUser;
  PetscCall(PCGetOperators(pc, NULL, &S));
  PetscCall(PCSetType(pc, PCNONE)); // forgets the package: rows may have gone to another rank
  PetscCall(EnvelopeFactorSetPC(pc, S, &done));
  if (done) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(MatGetFactorAvailable(S, MATSOLVERCHOLMOD, MAT_FACTOR_CHOLESKY, &available));
  PetscCall(MatGetSize(S, &n, NULL));
  available = (PetscBool)(available && n > 0);
  if (available) PetscCall(PCFactorSetMatSolverType(pc, MATSOLVERCHOLMOD));
  PetscCall(PCFactorSetMatOrderingType(pc, available ? MATORDERINGEXTERNAL : MATORDERINGQMD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherSetPC(PC pc, Mat S)
{
  PetscMPIInt size;
  PetscBool   by_body = PETSC_FALSE;

  PetscFunctionBeginUser;
  if (S) PetscCall(BodySmootherIs(S, &by_body));
  if (!S || by_body) {
    PetscCall(PCSetType(pc, by_body ? PCMAT : PCJACOBI));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)S), &size));
  if (size > 1)
    PetscCall(DealtFactorSetPC(pc, S, SmootherConfigureFactor_Private));
  else
    PetscCall(SmootherConfigureFactor_Private(pc));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SmootherRenew(PC pc)
{
  Mat       A, S;
  PetscBool dealt, shell, by_body;

  PetscFunctionBeginUser;
  PetscCall(PCGetOperators(pc, &A, &S));
  PetscCall(DealtFactorIs(pc, &dealt));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCMAT, &shell));
  PetscCall(BodySmootherIs(S, &by_body));
  if (!dealt && shell == by_body) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscObjectReference((PetscObject)A));
  PetscCall(PetscObjectReference((PetscObject)S));
  PetscCall(PCReset(pc));
  PetscCall(PCSetOperators(pc, A, S));
  PetscCall(SmootherSetPC(pc, S));
  PetscCall(MatDestroy(&A));
  PetscCall(MatDestroy(&S));
  PetscFunctionReturn(PETSC_SUCCESS);
}
