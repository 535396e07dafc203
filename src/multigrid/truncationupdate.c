/* truncationupdate.c -- changes of a matrix by truncation: a list of entries, few compared with the
   matrix.

   M X M changes in the rows a of unknowns that change state, and in their columns. Let R take these rows from
   a vector, and W have all entries of the change in rows a, those in columns a halved. Then the change is R'W
   + W'R, and its coarse operator (R P)'(W P) + (W P)'(R P): no rows but these are multiplied. */
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "base/gather.h"
#include "multigrid/fewrows.h"
#include "multigrid/galerkin.h"
#include "multigrid/transposedproduct.h"
#include "multigrid/truncationupdate.h"

/* Entries of a matrix under assembly. */
typedef struct {
  PetscInt     num, max;
  PetscInt    *row, *column;
  PetscScalar *value;
} Entries;

/* M before and after at the columns of a matrix: those of this rank, and ghosts. */
typedef struct {
  PetscInt           begin, end, num_ghosts;
  const PetscInt    *ghosts;      /* ascending [num_ghosts] */
  const PetscScalar *was, *is;    /* [end - begin] */
  PetscScalar       *ghost_state; /* was + 2 is [num_ghosts] */
} States;

/* A term of the matrix. */
typedef struct {
  Mat       X;
  PetscReal factor;
  States    states;
} Term;
enum { TERMS = 3 };

static PetscErrorCode TruncationUpdateAdd_Private(Entries *entries, PetscInt row, PetscInt column, PetscScalar value)
{
  PetscFunctionBeginUser;
  if (value == 0) PetscFunctionReturn(PETSC_SUCCESS);
  if (entries->num == entries->max) {
    entries->max = 2 * entries->max + 1024;
    PetscCall(PetscRealloc((size_t)entries->max * sizeof(PetscInt), &entries->row));
    PetscCall(PetscRealloc((size_t)entries->max * sizeof(PetscInt), &entries->column));
    PetscCall(PetscRealloc((size_t)entries->max * sizeof(PetscScalar), &entries->value));
  }
  entries->row[entries->num]     = row;
  entries->column[entries->num]  = column;
  entries->value[entries->num++] = value;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode EntriesDestroy_Private(Entries *entries)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(entries->row));
  PetscCall(PetscFree(entries->column));
  PetscCall(PetscFree(entries->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Collective. [in] X - whose columns are needed */
static PetscErrorCode TruncationUpdateBeginStates_Private(Mat X, Vec was, Vec is, States *states)
{
  const PetscScalar *a;
  Vec                both, ghosts;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(X, &states->begin, &states->end));
  PetscCall(MatGetGhosts(X, &states->num_ghosts, &states->ghosts));
  PetscCall(PetscMalloc1(states->num_ghosts, &states->ghost_state));
  PetscCall(VecDuplicate(was, &both));
  PetscCall(VecWAXPY(both, 2, is, was));
  PetscCall(GatherEntries(both, states->num_ghosts, states->ghosts, &ghosts));
  PetscCall(VecGetArrayRead(ghosts, &a));
  PetscCall(PetscArraycpy(states->ghost_state, a, states->num_ghosts));
  PetscCall(VecRestoreArrayRead(ghosts, &a));
  PetscCall(VecDestroy(&ghosts));
  PetscCall(VecDestroy(&both));
  PetscCall(VecGetArrayRead(was, &states->was));
  PetscCall(VecGetArrayRead(is, &states->is));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode TruncationUpdateEndStates_Private(Vec was, Vec is, States *states)
{
  PetscFunctionBeginUser;
  PetscCall(VecRestoreArrayRead(was, &states->was));
  PetscCall(VecRestoreArrayRead(is, &states->is));
  PetscCall(PetscFree(states->ghost_state));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* M of one column, before and after. */
static PetscErrorCode TruncationUpdateGetState_Private(const States *states, PetscInt column, PetscBool *was,
                                                       PetscBool *is)
{
  PetscInt at, state;

  PetscFunctionBeginUser;
  if (column >= states->begin && column < states->end) {
    *was = (PetscBool)(states->was[column - states->begin] != 0);
    *is  = (PetscBool)(states->is[column - states->begin] != 0);
  } else {
    PetscCall(PetscFindInt(column, states->num_ghosts, states->ghosts, &at));
    state = (PetscInt)PetscRealPart(states->ghost_state[at]);
    *was  = (PetscBool)(state % 2);
    *is   = (PetscBool)(state / 2);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the row of W of one term. */
static PetscErrorCode TruncationUpdateAddTerm_Private(const Term *term, PetscInt row, Entries *entries)
{
  const States      *states = &term->states;
  PetscInt           num;
  PetscBool          row_was, row_is;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  PetscCall(TruncationUpdateGetState_Private(states, row, &row_was, &row_is));
  PetscCall(MatGetRow(term->X, row, &num, &columns, &values));
  for (PetscInt j = 0; j < num; j++) {
    PetscBool was, is;
    PetscReal change;

    PetscCall(TruncationUpdateGetState_Private(states, columns[j], &was, &is));
    change = term->factor * ((row_is && is ? 1 : 0) - (row_was && was ? 1 : 0));
    PetscCall(TruncationUpdateAdd_Private(entries, row, columns[j], (was == is ? 1 : 0.5) * change * values[j]));
  }
  PetscCall(MatRestoreRow(term->X, row, &num, &columns, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The unknowns that change state. [out] rows - of this rank, owned by the caller [num] */
static PetscErrorCode TruncationUpdateListChanged_Private(const TruncationChange *change, PetscInt *num,
                                                          PetscInt **rows)
{
  const PetscScalar *was, *is;
  PetscInt           begin, end;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(change->is, &begin, &end));
  PetscCall(VecGetArrayRead(change->was, &was));
  PetscCall(VecGetArrayRead(change->is, &is));
  *num = 0;
  for (PetscInt i = 0; i < end - begin; i++) *num += (was[i] != 0) != (is[i] != 0);
  PetscCall(PetscMalloc1(*num, rows));
  *num = 0;
  for (PetscInt i = 0; i < end - begin; i++)
    if ((was[i] != 0) != (is[i] != 0)) (*rows)[(*num)++] = begin + i;
  PetscCall(VecRestoreArrayRead(change->is, &is));
  PetscCall(VecRestoreArrayRead(change->was, &was));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* W. [in] rows - that change state [num]; [out] W - these rows of the change, owned by the caller */
static PetscErrorCode TruncationUpdateCreateRows_Private(const Operator *op, const TruncationChange *change,
                                                         PetscInt num, const PetscInt rows[], Mat *W)
{
  Term terms[TERMS] = {
      {.X = op->K, .factor = 1 / op->stiffness}, {.X = op->Z, .factor = 1}, {.X = change->C, .factor = 1}};
  Entries  entries = {.num = 0};
  PetscInt n, own, *start;

  PetscFunctionBeginUser;
  for (int t = 0; t < TERMS; t++)
    if (terms[t].X)
      PetscCall(TruncationUpdateBeginStates_Private(terms[t].X, change->was, change->is, &terms[t].states));
  PetscCall(PetscMalloc1(num + 1, &start));
  start[0] = 0;
  for (PetscInt i = 0; i < num; i++) {
    for (int t = 0; t < TERMS; t++)
      if (terms[t].X) PetscCall(TruncationUpdateAddTerm_Private(&terms[t], rows[i], &entries));
    own = entries.num - start[i];
    PetscCall(CSRMatrixMergeRow(&own, &entries.column[start[i]], &entries.value[start[i]]));
    start[i + 1] = entries.num = start[i] + own;
  }
  for (int t = 0; t < TERMS; t++)
    if (terms[t].X) PetscCall(TruncationUpdateEndStates_Private(change->was, change->is, &terms[t].states));
  PetscCall(MatGetLocalSize(op->K, &n, NULL));
  PetscCall(CSRMatrixCreate(PetscObjectComm((PetscObject)op->K),
                            &(CSRRows){1, num, n, start, entries.column, entries.value}, W));
  PetscCall(PetscFree(start));
  PetscCall(EntriesDestroy_Private(&entries));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Unknowns of this rank that are columns of entries, on any rank. Collective. [in] like - a vector of the
   columns; [out] columns - owned by the caller */
static PetscErrorCode TruncationUpdateListColumns_Private(Mat W, Vec like, IS *columns)
{
  PetscInt           begin, end, *list, num = 0;
  const PetscScalar *met;
  Vec                marks;

  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(like, &marks));
  PetscCall(VecZeroEntries(marks));
  PetscCall(MatGetOwnershipRange(W, &begin, &end));
  for (PetscInt row = begin; row < end; row++) {
    PetscInt        size;
    const PetscInt *c;

    PetscCall(MatGetRow(W, row, &size, &c, NULL));
    for (PetscInt j = 0; j < size; j++) PetscCall(VecSetValue(marks, c[j], 1, INSERT_VALUES));
    PetscCall(MatRestoreRow(W, row, &size, &c, NULL));
  }
  PetscCall(VecAssemblyBegin(marks));
  PetscCall(VecAssemblyEnd(marks));
  PetscCall(VecGetOwnershipRange(marks, &begin, &end));
  PetscCall(PetscMalloc1(end - begin, &list));
  PetscCall(VecGetArrayRead(marks, &met));
  for (PetscInt i = 0; i < end - begin; i++)
    if (met[i] != 0) list[num++] = begin + i;
  PetscCall(VecRestoreArrayRead(marks, &met));
  PetscCall(VecDestroy(&marks));
  PetscCall(ISCreateGeneral(PetscObjectComm((PetscObject)W), num, list, PETSC_COPY_VALUES, columns));
  PetscCall(PetscFree(list));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* W P of the few rows of P that count. [out] WP - owned by the caller */
static PetscErrorCode TruncationUpdateMultiply_Private(Mat W, Mat P, Vec like, Mat *WP)
{
  PetscInt begin, end;
  IS       rows, columns;
  Mat      small, few;

  PetscFunctionBeginUser;
  PetscCall(TruncationUpdateListColumns_Private(W, like, &columns));
  PetscCall(MatGetOwnershipRange(W, &begin, &end));
  PetscCall(ISCreateStride(PetscObjectComm((PetscObject)W), end - begin, begin, 1, &rows));
  PetscCall(MatCreateSubMatrix(W, rows, columns, MAT_INITIAL_MATRIX, &small));
  PetscCall(MatCreateSubMatrix(P, columns, NULL, MAT_INITIAL_MATRIX, &few));
  PetscCall(MatMatMult(small, few, MAT_INITIAL_MATRIX, PETSC_DEFAULT, WP));
  PetscCall(MatProductClear(*WP)); // it would keep its factors
  PetscCall(MatDestroy(&small));
  PetscCall(MatDestroy(&few));
  PetscCall(ISDestroy(&rows));
  PetscCall(ISDestroy(&columns));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* (R P)'(W P) + (W P)'(R P). Collective. [out] product - owned by the caller */
static PetscErrorCode TruncationUpdateRestrictChanged_Private(const Operator *op, const TruncationChange *change, Mat P,
                                                              Mat *product)
{
  PetscInt num, begin, *rows, *all;
  Mat      W, WP, left, right;

  PetscFunctionBeginUser;
  PetscCall(TruncationUpdateListChanged_Private(change, &num, &rows));
  PetscCall(TruncationUpdateCreateRows_Private(op, change, num, rows, &W));
  PetscCall(TruncationUpdateMultiply_Private(W, P, change->is, &WP));
  PetscCall(MatGetOwnershipRange(WP, &begin, NULL));
  PetscCall(PetscMalloc1(num, &all));
  for (PetscInt i = 0; i < num; i++) all[i] = begin + i;
  const RowList of_P = {.from = P, .num = num, .row = rows}, of_WP = {.from = WP, .num = num, .row = all};

  PetscCall(FewRowsCreate(2, (RowList[]){of_P, of_WP}, &left));
  PetscCall(FewRowsCreate(2, (RowList[]){of_WP, of_P}, &right));
  PetscCall(TransposedProductCreate(left, right, product)); // both terms at once
  PetscCall(MatDestroy(&left));
  PetscCall(MatDestroy(&right));
  PetscCall(MatDestroy(&WP));
  PetscCall(MatDestroy(&W));
  PetscCall(PetscFree(rows));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rows of this rank that are not zero. Collective. */
static PetscErrorCode TruncationUpdateListRows_Private(Mat X, IS *rows)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  PetscCall(MatFindNonzeroRows(X, rows));
  if (*rows) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatGetOwnershipRange(X, &begin, &end)); // all rows
  PetscCall(ISCreateStride(PetscObjectComm((PetscObject)X), end - begin, begin, 1, rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds M X M of a matrix with few entries. */
static PetscErrorCode TruncationUpdateAddAll_Private(Mat X, Vec is, Entries *entries)
{
  States          states;
  IS              rows;
  PetscInt        listed;
  const PetscInt *list;

  PetscFunctionBeginUser;
  PetscCall(TruncationUpdateBeginStates_Private(X, is, is, &states));
  PetscCall(TruncationUpdateListRows_Private(X, &rows));
  PetscCall(ISGetLocalSize(rows, &listed));
  PetscCall(ISGetIndices(rows, &list));
  for (PetscInt i = 0; i < listed; i++) {
    const PetscInt     row = list[i];
    PetscInt           num;
    PetscBool          free;
    const PetscInt    *columns;
    const PetscScalar *values;

    if (states.is[row - states.begin] == 0) continue;
    PetscCall(MatGetRow(X, row, &num, &columns, &values));
    for (PetscInt j = 0; j < num; j++) {
      PetscCall(TruncationUpdateGetState_Private(&states, columns[j], &free, &free));
      if (free) PetscCall(TruncationUpdateAdd_Private(entries, row, columns[j], values[j]));
    }
    PetscCall(MatRestoreRow(X, row, &num, &columns, &values));
  }
  PetscCall(ISRestoreIndices(rows, &list));
  PetscCall(ISDestroy(&rows));
  PetscCall(TruncationUpdateEndStates_Private(is, is, &states));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds a diagonal. */
static PetscErrorCode TruncationUpdateAddDiagonal_Private(Vec W, Entries *entries)
{
  const PetscScalar *w;
  PetscInt           begin, end;

  PetscFunctionBeginUser;
  PetscCall(VecGetOwnershipRange(W, &begin, &end));
  PetscCall(VecGetArrayRead(W, &w));
  for (PetscInt i = begin; i < end; i++) PetscCall(TruncationUpdateAdd_Private(entries, i, i, w[i - begin]));
  PetscCall(VecRestoreArrayRead(W, &w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* P'M (dC + W) M P. [out] product - owned by the caller */
static PetscErrorCode TruncationUpdateRestrictAll_Private(const TruncationChange *change, Mat P, Mat *product)
{
  Entries  entries = {.num = 0};
  PetscInt n, N;
  IS       rows;
  Mat      all, small, few;

  PetscFunctionBeginUser;
  if (change->dC) PetscCall(TruncationUpdateAddAll_Private(change->dC, change->is, &entries));
  if (change->W) PetscCall(TruncationUpdateAddDiagonal_Private(change->W, &entries));
  PetscCall(VecGetLocalSize(change->is, &n));
  PetscCall(VecGetSize(change->is, &N));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)P), &all));
  PetscCall(MatSetSizes(all, n, n, N, N));
  PetscCall(MatSetType(all, MATAIJ));
  PetscCall(MatSetPreallocationCOO(all, entries.num, entries.row, entries.column));
  PetscCall(MatSetValuesCOO(all, entries.value, ADD_VALUES));
  PetscCall(EntriesDestroy_Private(&entries));
  PetscCall(TruncationUpdateListRows_Private(all, &rows)); // most rows are empty
  PetscCall(MatCreateSubMatrix(all, rows, rows, MAT_INITIAL_MATRIX, &small));
  PetscCall(MatCreateSubMatrix(P, rows, NULL, MAT_INITIAL_MATRIX, &few));
  PetscCall(GalerkinProduct(small, few, product));
  PetscCall(MatDestroy(&all));
  PetscCall(MatDestroy(&small));
  PetscCall(MatDestroy(&few));
  PetscCall(ISDestroy(&rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TruncationUpdateRestrict(const Operator *op, const TruncationChange *change, Mat P, Mat *product)
{
  Mat all;

  PetscFunctionBeginUser;
  PetscCall(TruncationUpdateRestrictChanged_Private(op, change, P, product));
  if (!change->dC && !change->W) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(TruncationUpdateRestrictAll_Private(change, P, &all));
  PetscCall(TruncationUpdateAdd(*product, all));
  PetscCall(MatDestroy(&all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the nonzeros of a matrix are among those of another of the same layout; columns ascend.
   Collective. */
static PetscErrorCode TruncationUpdateFits_Private(Mat few, Mat many, PetscBool *fits)
{
  PetscInt begin, end;

  PetscFunctionBeginUser;
  *fits = PETSC_TRUE;
  PetscCall(MatGetOwnershipRange(few, &begin, &end));
  for (PetscInt row = begin; row < end && *fits; row++) {
    PetscInt        num, room = 0, at = 0;
    const PetscInt *columns, *among = NULL;

    PetscCall(MatGetRow(few, row, &num, &columns, NULL));
    if (num) PetscCall(MatGetRow(many, row, &room, &among, NULL));
    for (PetscInt j = 0; j < num && *fits; j++) {
      while (at < room && among[at] < columns[j]) at++;
      *fits = (PetscBool)(at < room && among[at] == columns[j]);
    }
    if (num) PetscCall(MatRestoreRow(many, row, &room, &among, NULL));
    PetscCall(MatRestoreRow(few, row, &num, &columns, NULL));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, fits, 1, MPIU_BOOL, MPI_LAND, PetscObjectComm((PetscObject)few)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* sum := X, 0 where X has no entry, or sum += X; MatAXPY() would look up each entry.
   [in] X_columns, sum_columns - global columns of a block of ghosts, ascending, or both NULL */
static PetscErrorCode TruncationUpdateAddBlock_Private(Mat X, const PetscInt X_columns[], PetscBool add, Mat sum,
                                                       const PetscInt sum_columns[])
{
  PetscInt           n;
  const PetscInt    *start[2], *column[2];
  PetscBool          done[2];
  const PetscScalar *from;
  PetscScalar       *to;

  PetscFunctionBeginUser;
  PetscCall(MatGetRowIJ(X, 0, PETSC_FALSE, PETSC_FALSE, &n, &start[0], &column[0], &done[0]));
  PetscCall(MatGetRowIJ(sum, 0, PETSC_FALSE, PETSC_FALSE, &n, &start[1], &column[1], &done[1]));
  PetscCall(MatSeqAIJGetArrayRead(X, &from));
  PetscCall(MatSeqAIJGetArray(sum, &to));
  for (PetscInt row = 0; row < n; row++) {
    PetscInt at = start[0][row];

    for (PetscInt j = start[1][row]; j < start[1][row + 1]; j++) {
      const PetscBool in  = (PetscBool)(at < start[0][row + 1]);
      const PetscInt  one = !in ? -1 : X_columns ? X_columns[column[0][at]] : column[0][at];

      if (!in && add) break;
      if (!add) to[j] = 0;
      if (in && one == (sum_columns ? sum_columns[column[1][j]] : column[1][j])) to[j] += from[at++];
    }
  }
  PetscCall(MatSeqAIJRestoreArray(sum, &to));
  PetscCall(MatSeqAIJRestoreArrayRead(X, &from));
  PetscCall(MatRestoreRowIJ(sum, 0, PETSC_FALSE, PETSC_FALSE, &n, &start[1], &column[1], &done[1]));
  PetscCall(MatRestoreRowIJ(X, 0, PETSC_FALSE, PETSC_FALSE, &n, &start[0], &column[0], &done[0]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* sum := X, or sum += X. The nonzeros of X are among those of sum. Collective. */
static PetscErrorCode TruncationUpdateAddMatrix_Private(Mat X, PetscBool add, Mat sum)
{
  PetscBool       parallel;
  Mat             own[2], ghosts[2];
  const PetscInt *columns[2];

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)X, MATMPIAIJ, &parallel));
  if (parallel) {
    PetscCall(MatMPIAIJGetSeqAIJ(X, &own[0], &ghosts[0], &columns[0]));
    PetscCall(MatMPIAIJGetSeqAIJ(sum, &own[1], &ghosts[1], &columns[1]));
    PetscCall(TruncationUpdateAddBlock_Private(own[0], NULL, add, own[1], NULL));
    PetscCall(TruncationUpdateAddBlock_Private(ghosts[0], columns[0], add, ghosts[1], columns[1]));
    PetscCall(MatAssemblyBegin(sum, MAT_FINAL_ASSEMBLY)); // it has changed
    PetscCall(MatAssemblyEnd(sum, MAT_FINAL_ASSEMBLY));
  } else {
    PetscCall(TruncationUpdateAddBlock_Private(X, NULL, add, sum, NULL));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TruncationUpdateAdd(Mat sum, Mat X)
{
  PetscBool fits;

  PetscFunctionBeginUser;
  PetscCall(TruncationUpdateFits_Private(X, sum, &fits));
  if (fits)
    PetscCall(TruncationUpdateAddMatrix_Private(X, PETSC_TRUE, sum));
  else
    PetscCall(MatAXPY(sum, 1, X, DIFFERENT_NONZERO_PATTERN));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TruncationUpdateSum(Mat X, Mat change, Mat *sum)
{
  PetscBool fits = PETSC_FALSE;

  PetscFunctionBeginUser;
  if (*sum) fits = PETSC_TRUE;
  if (*sum && change) PetscCall(TruncationUpdateFits_Private(change, *sum, &fits));
  if (fits) {
    PetscCall(TruncationUpdateAddMatrix_Private(X, PETSC_FALSE, *sum));
  } else {
    PetscCall(MatDestroy(sum));
    PetscCall(MatDuplicate(X, MAT_COPY_VALUES, sum));
  }
  if (change) PetscCall(TruncationUpdateAdd(*sum, change));
  PetscFunctionReturn(PETSC_SUCCESS);
}
