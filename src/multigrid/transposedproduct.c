/* transposedproduct.c -- see the header.

   Most columns are empty. Each rank multiplies its own rows without them, and entries are added where they
   belong. MatTransposeMatMult() visits all columns, and on several ranks it merges rows entry by entry. */
#include "base/compat.h"
#include "base/csrmatrix.h"
#include "multigrid/transposedproduct.h"

/* Filled of this rank without empty columns. */
typedef struct {
  Mat          A;            /* of this process */
  PetscInt     num, *number; /* global numbers of its columns, ascending on one process [num] */
  PetscInt    *start, *column;
  PetscScalar *value;
} Filled;

/* Columns of X by places: those of this rank, then ghosts. */
typedef struct {
  PetscInt        begin, n, num;
  const PetscInt *ghost; /* ascending [num] */
} Places;

static PetscErrorCode PlacesFind_Private(const Places *places, PetscInt column, PetscInt *place)
{
  PetscFunctionBeginUser;
  *place = column - places->begin;
  if (*place >= 0 && *place < places->n) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscFindInt(column, places->num, places->ghost, place));
  *place += places->n;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Copies the rows of this rank, with columns by places. [out] met - places that occur [n + num] */
static PetscErrorCode FilledCopy_Private(Mat X, const Places *places, Filled *rows, PetscInt met[])
{
  PetscInt           begin, end, num = 0, size;
  const PetscInt    *columns;
  const PetscScalar *values;
  MatInfo            info;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(X, &begin, &end));
  PetscCall(MatGetInfo(X, MAT_LOCAL, &info));
  PetscCall(PetscMalloc3(end - begin + 1, &rows->start, (PetscInt)info.nz_used, &rows->column, (PetscInt)info.nz_used,
                         &rows->value));
  rows->start[0] = 0;
  for (PetscInt row = begin; row < end; row++) {
    PetscCall(MatGetRow(X, row, &size, &columns, &values));
    for (PetscInt k = 0; k < size; k++, num++) {
      PetscCall(PlacesFind_Private(places, columns[k], &rows->column[num]));
      rows->value[num]       = values[k];
      met[rows->column[num]] = 1;
    }
    PetscCall(MatRestoreRow(X, row, &size, &columns, &values));
    rows->start[row - begin + 1] = num;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [out] rows - to be released by FilledDestroy_Private() */
static PetscErrorCode FilledCreate_Private(Mat X, Filled *rows)
{
  Places      places = {.num = 0};
  PetscInt   *place, m;
  PetscMPIInt size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)X), &size));
  PetscCall(MatGetOwnershipRangeColumn(X, &places.begin, NULL));
  PetscCall(MatGetLocalSize(X, &m, &places.n));
  if (size > 1) PetscCall(MatGetGhosts(X, &places.num, &places.ghost));
  PetscCall(PetscCalloc1(places.n + places.num, &place));
  PetscCall(FilledCopy_Private(X, &places, rows, place));
  rows->num = 0;
  for (PetscInt j = 0; j < places.n + places.num; j++) rows->num += place[j];
  PetscCall(PetscMalloc1(rows->num, &rows->number));
  rows->num = 0;
  for (PetscInt j = 0; j < places.n + places.num; j++) {
    if (!place[j]) continue;
    rows->number[rows->num] = j < places.n ? places.begin + j : places.ghost[j - places.n];
    place[j]                = rows->num++;
  }
  for (PetscInt k = 0; k < rows->start[m]; k++) rows->column[k] = place[rows->column[k]];
  PetscCall(PetscFree(place));
  PetscCall(
      CSRMatrixCreate(PETSC_COMM_SELF, &(CSRRows){1, m, rows->num, rows->start, rows->column, rows->value}, &rows->A));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode FilledDestroy_Private(Filled *rows)
{
  PetscFunctionBeginUser;
  PetscCall(MatDestroy(&rows->A));
  PetscCall(PetscFree(rows->number));
  PetscCall(PetscFree3(rows->start, rows->column, rows->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All rows of a product on one process, most of them empty.
   [in] few - the other rows; [in] number - of them, ascending [few->m];
   [out] product - owned by the caller */
static PetscErrorCode TransposedProductSpread_Private(MPI_Comm comm, PetscInt m, const CSRRows *few,
                                                      const PetscInt number[], Mat *product)
{
  CSRRows  all = *few;
  PetscInt at  = 0;

  PetscFunctionBeginUser;
  all.m = m;
  PetscCall(PetscMalloc1(m + 1, &all.start));
  all.start[0] = 0;
  for (PetscInt i = 0; i < m; i++) {
    if (at < few->m && number[at] == i) at++;
    all.start[i + 1] = few->start[at];
  }
  PetscCall(CSRMatrixCreate(comm, &all, product));
  PetscCall(PetscFree(all.start));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The sum over ranks of products. [in] number - of the rows [few->m]; [out] product - owned by the caller */
static PetscErrorCode TransposedProductSum_Private(MPI_Comm comm, PetscInt m, const CSRRows *few,
                                                   const PetscInt number[], Mat *product)
{
  PetscInt *row;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(few->start[few->m], &row));
  for (PetscInt i = 0; i < few->m; i++)
    for (PetscInt k = few->start[i]; k < few->start[i + 1]; k++) row[k] = number[i];
  PetscCall(MatCreate(comm, product));
  PetscCall(MatSetSizes(*product, m, few->n, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*product, MATAIJ));
  PetscCall(MatSetPreallocationCOO(*product, few->start[few->m], row, few->column));
  PetscCall(MatSetValuesCOO(*product, few->value, INSERT_VALUES));
  PetscCall(PetscFree(row));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in] local - L'R of this process without empty rows and columns; [out] product - owned by the caller */
static PetscErrorCode TransposedProductExpand_Private(Mat L, Mat R, const Filled *left, const Filled *right, Mat local,
                                                      Mat *product)
{
  const MPI_Comm     comm = PetscObjectComm((PetscObject)L);
  PetscInt           m;
  CSRRows            few = {.bs = 1};
  PetscMPIInt        size;
  PetscBool          done;
  const PetscInt    *start, *column;
  const PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(MatGetLocalSize(L, NULL, &m));
  PetscCall(MatGetLocalSize(R, NULL, &few.n));
  PetscCall(MatGetRowIJ(local, 0, PETSC_FALSE, PETSC_FALSE, &few.m, &start, &column, &done));
  PetscCall(MatSeqAIJGetArrayRead(local, &value));
  few.start = (PetscInt *)start;    // not changed where columns ascend,
  few.value = (PetscScalar *)value; // as they do here, and by MatSetValuesCOO()
  PetscCall(PetscMalloc1(start[few.m], &few.column));
  for (PetscInt k = 0; k < start[few.m]; k++) few.column[k] = right->number[column[k]];
  if (size == 1)
    PetscCall(TransposedProductSpread_Private(comm, m, &few, left->number, product));
  else
    PetscCall(TransposedProductSum_Private(comm, m, &few, left->number, product));
  PetscCall(PetscFree(few.column));
  PetscCall(MatSeqAIJRestoreArrayRead(local, &value));
  PetscCall(MatRestoreRowIJ(local, 0, PETSC_FALSE, PETSC_FALSE, &few.m, &start, &column, &done));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode TransposedProductCreate(Mat L, Mat R, Mat *product)
{
  PetscInt bs[2];
  Filled   left, right;
  Mat      local;

  PetscFunctionBeginUser;
  PetscCall(FilledCreate_Private(L, &left));
  PetscCall(FilledCreate_Private(R, &right));
  PetscCall(MatTransposeMatMult(left.A, right.A, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &local));
  PetscCall(TransposedProductExpand_Private(L, R, &left, &right, local, product));
  PetscCall(MatDestroy(&local));
  PetscCall(FilledDestroy_Private(&left));
  PetscCall(FilledDestroy_Private(&right));
  PetscCall(MatGetBlockSizes(L, NULL, &bs[0]));
  PetscCall(MatGetBlockSizes(R, NULL, &bs[1]));
  PetscCall(MatSetBlockSizes(*product, bs[0], bs[1]));
  PetscFunctionReturn(PETSC_SUCCESS);
}
