/* truncationupdate.c -- changes of a matrix by truncation: a list of entries, few compared with the
   matrix. */
#include "base/compat.h"
#include "multigrid/galerkin.h"
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

static PetscErrorCode TruncationUpdateAdd_Private(Entries *entries, PetscInt row, PetscInt column, PetscScalar value)
{
  PetscFunctionBeginUser;
  if (value == 0) PetscFunctionReturn(PETSC_SUCCESS);
  if (entries->num == entries->max) {
    entries->max = 2 * entries->max + 1024;
    PetscCall(PetscRealloc(entries->max * sizeof(PetscInt), &entries->row));
    PetscCall(PetscRealloc(entries->max * sizeof(PetscInt), &entries->column));
    PetscCall(PetscRealloc(entries->max * sizeof(PetscScalar), &entries->value));
  }
  entries->row[entries->num]     = row;
  entries->column[entries->num]  = column;
  entries->value[entries->num++] = value;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Collective. [in] X - whose columns are needed */
static PetscErrorCode TruncationUpdateBeginStates_Private(Mat X, Vec was, Vec is, States *states)
{
  const PetscScalar *a;
  Vec                both, ghosts;
  IS                 which;
  VecScatter         scatter;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(X, &states->begin, &states->end));
  PetscCall(MatGetGhosts(X, &states->num_ghosts, &states->ghosts));
  PetscCall(PetscMalloc1(states->num_ghosts, &states->ghost_state));
  PetscCall(VecDuplicate(was, &both));
  PetscCall(VecWAXPY(both, 2, is, was));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, states->num_ghosts, &ghosts));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, states->num_ghosts, states->ghosts, PETSC_COPY_VALUES, &which));
  PetscCall(VecScatterCreate(both, which, ghosts, NULL, &scatter));
  PetscCall(VecScatterBegin(scatter, both, ghosts, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(scatter, both, ghosts, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(ghosts, &a));
  PetscCall(PetscArraycpy(states->ghost_state, a, states->num_ghosts));
  PetscCall(VecRestoreArrayRead(ghosts, &a));
  PetscCall(VecScatterDestroy(&scatter));
  PetscCall(ISDestroy(&which));
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

/* Adds the change of M (factor X) M. */
static PetscErrorCode TruncationUpdateAddChanged_Private(Mat X, PetscReal factor, Vec was, Vec is, Entries *entries)
{
  States states;

  PetscFunctionBeginUser;
  PetscCall(TruncationUpdateBeginStates_Private(X, was, is, &states));
  for (PetscInt row = states.begin; row < states.end; row++) {
    const PetscBool row_was = (PetscBool)(states.was[row - states.begin] != 0),
                    row_is  = (PetscBool)(states.is[row - states.begin] != 0);
    PetscInt           num;
    const PetscInt    *columns;
    const PetscScalar *values;

    if (row_was == row_is) continue;
    PetscCall(MatGetRow(X, row, &num, &columns, &values));
    for (PetscInt j = 0; j < num; j++) {
      PetscBool column_was, column_is;
      PetscReal change;

      PetscCall(TruncationUpdateGetState_Private(&states, columns[j], &column_was, &column_is));
      change = factor * ((row_is && column_is ? 1 : 0) - (row_was && column_was ? 1 : 0));
      PetscCall(TruncationUpdateAdd_Private(entries, row, columns[j], change * values[j]));
      if (column_was == column_is) PetscCall(TruncationUpdateAdd_Private(entries, columns[j], row, change * values[j]));
    }
    PetscCall(MatRestoreRow(X, row, &num, &columns, &values));
  }
  PetscCall(TruncationUpdateEndStates_Private(was, is, &states));
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

PetscErrorCode TruncationUpdateCreate(const Operator *op, Mat C, Mat dC, Vec was, Vec is, Vec W, Mat *update)
{
  Entries  entries = {.num = 0};
  PetscInt n, N;

  PetscFunctionBeginUser;
  PetscCall(TruncationUpdateAddChanged_Private(op->K, 1 / op->stiffness, was, is, &entries));
  if (op->Z) PetscCall(TruncationUpdateAddChanged_Private(op->Z, 1, was, is, &entries));
  if (C) PetscCall(TruncationUpdateAddChanged_Private(C, 1, was, is, &entries));
  if (dC) PetscCall(TruncationUpdateAddAll_Private(dC, is, &entries));
  if (W) PetscCall(TruncationUpdateAddDiagonal_Private(W, &entries));
  PetscCall(MatGetLocalSize(op->K, &n, NULL));
  PetscCall(MatGetSize(op->K, &N, NULL));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)op->K), update));
  PetscCall(MatSetSizes(*update, n, n, N, N));
  PetscCall(MatSetType(*update, MATAIJ));
  PetscCall(MatSetPreallocationCOO(*update, entries.num, entries.row, entries.column));
  PetscCall(MatSetValuesCOO(*update, entries.value, ADD_VALUES));
  PetscCall(PetscFree(entries.row));
  PetscCall(PetscFree(entries.column));
  PetscCall(PetscFree(entries.value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TruncationUpdateRestrict(Mat update, Mat P, Mat *product)
{
  IS  is;
  Mat small, few;

  PetscFunctionBeginUser; /* most rows are empty: only the others, which are the columns as well */
  PetscCall(TruncationUpdateListRows_Private(update, &is));
  PetscCall(MatCreateSubMatrix(update, is, is, MAT_INITIAL_MATRIX, &small));
  PetscCall(MatCreateSubMatrix(P, is, NULL, MAT_INITIAL_MATRIX, &few));
  PetscCall(GalerkinProduct(small, few, product));
  PetscCall(MatDestroy(&small));
  PetscCall(MatDestroy(&few));
  PetscCall(ISDestroy(&is));
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
