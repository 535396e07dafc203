/* basisghosts.c -- see the header.

   With T = (1 + E_0)(1 + E_1) a row of T x that another rank owns depends on rows of E_0 and E_1 there. They
   are copied once. x of all that they depend on is then one message, and T'y one in return. Factor by factor,
   with a product of PETSc for each, there would be up to four beside that of K.

   T x takes the place of x: it differs in few entries, and a copy is another pass over the memory. */
#include "problem/basisghosts.h"
#include "base/compat.h"
#include "base/gather.h"

/* Rows of a factor E. Places are those of unknowns of this rank, then of ghosts. */
typedef struct {
  PetscInt     num, *row;      /* places [num] */
  PetscInt    *start, *column; /* places; [num+1], [start[num]] */
  PetscScalar *value;          /* [start[num]] */
  PetscScalar *change;         /* of a product [num] */
  PetscScalar *before;         /* x in these places [num] */
} FactorRows;

struct _n_BasisGhosts {
  PetscInt     references;
  PetscInt     n, begin, N;    /* unknowns of this rank, the first of them, all */
  PetscInt     num, of_K;      /* ghosts: those of K come first */
  PetscInt    *ghost;          /* global numbers [num] */
  PetscInt    *sorted, *which; /* the same, ascending, and their indices in ghost; while rows are made [num] */
  FactorRows   rows[BASIS_FACTORS];
  PetscScalar *x;    /* of ghosts [num]; NULL on one process, as all below */
  Vec          from; /* the same */
  VecScatter   scatter;
  PetscScalar *force;           /* what T' adds to ghosts [num] */
  PetscInt     num_back, *back; /* ghosts to which it may add, from 0 [num_back] */
  Vec          to;              /* force of these [num_back] */
  VecScatter   backward;
};

/* Appends rows of a matrix.
   [in] first - number of the first one on this rank; [in] place - of each row [num] */
static PetscErrorCode FactorRowsAdd_Private(Mat E, PetscInt first, PetscInt num, const PetscInt place[],
                                            FactorRows *rows)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt     at = rows->start[rows->num];
    PetscInt           size;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(E, first + i, &size, &columns, &values));
    PetscCall(PetscArraycpy(&rows->column[at], columns, size));
    PetscCall(PetscArraycpy(&rows->value[at], values, size));
    rows->row[rows->num++] = place[i];
    rows->start[rows->num] = at + size;
    PetscCall(MatRestoreRow(E, first + i, &size, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The ghosts at which E has rows. Collective.
   [out] rows, places - of these rows in factor->few, and of the ghosts; owned by the caller [num] */
static PetscErrorCode FactorRowsList_Private(const BasisGhosts g, const BasisFactor *factor, PetscInt *num,
                                             PetscInt **rows, PetscInt **places)
{
  PetscInt           begin, few;
  const PetscInt    *row;
  PetscScalar       *a;
  const PetscScalar *b;
  Vec                numbers, there;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(factor->few, &numbers, NULL));
  PetscCall(MatGetOwnershipRange(factor->few, &begin, NULL));
  PetscCall(ISGetLocalSize(factor->rows, &few));
  PetscCall(ISGetIndices(factor->rows, &row));
  PetscCall(VecGetArray(numbers, &a));
  for (PetscInt i = 0; i < few; i++) a[row[i]] = (PetscScalar)(begin + i + 1); // 0: no row
  PetscCall(VecRestoreArray(numbers, &a));
  PetscCall(ISRestoreIndices(factor->rows, &row));
  PetscCall(GatherEntries(numbers, g->num, g->ghost, &there));
  PetscCall(PetscMalloc1(g->num, rows));
  PetscCall(PetscMalloc1(g->num, places));
  *num = 0;
  PetscCall(VecGetArrayRead(there, &b));
  for (PetscInt i = 0; i < g->num; i++) {
    if (b[i] == 0) continue;
    (*rows)[*num]       = (PetscInt)PetscRealPart(b[i]) - 1;
    (*places)[(*num)++] = g->n + i;
  }
  PetscCall(VecRestoreArrayRead(there, &b));
  PetscCall(VecDestroy(&there));
  PetscCall(VecDestroy(&numbers));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows of E of other ranks. Collective.
   [in] rows - in few [num]; [out] there - with all columns, owned by the caller */
static PetscErrorCode FactorRowsFetch_Private(Mat few, PetscInt num, const PetscInt rows[], Mat **there)
{
  PetscInt N;
  IS       some, columns;

  PetscFunctionBeginUser;
  PetscCall(MatGetSize(few, NULL, &N));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, rows, PETSC_USE_POINTER, &some));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, N, 0, 1, &columns));
  PetscCall(ISSetIdentity(columns));
  PetscCall(MatCreateSubMatrices(few, 1, &some, &columns, MAT_INITIAL_MATRIX, there));
  PetscCall(ISDestroy(&some));
  PetscCall(ISDestroy(&columns));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows of E at own unknowns and at the ghosts that are known. */
static PetscErrorCode FactorRowsCreate_Private(const BasisGhosts g, PetscBool others, const BasisFactor *factor,
                                               FactorRows *rows)
{
  PetscInt        num, all, begin, met = 0, *list = NULL, *places = NULL;
  const PetscInt *place;
  Mat            *there = NULL;
  MatInfo         info;
  size_t          entries;

  PetscFunctionBeginUser;
  PetscCall(MatGetInfo(factor->few, MAT_LOCAL, &info));
  entries = (size_t)info.nz_used;
  PetscCall(MatGetSize(factor->few, &all, NULL));
  if (others && all) {
    PetscCall(FactorRowsList_Private(g, factor, &met, &list, &places));
    PetscCall(FactorRowsFetch_Private(factor->few, met, list, &there));
    PetscCall(MatGetInfo(there[0], MAT_LOCAL, &info));
    entries += (size_t)info.nz_used;
  }
  PetscCall(ISGetLocalSize(factor->rows, &num));
  PetscCall(PetscMalloc4(num + met, &rows->row, num + met + 1, &rows->start, num + met, &rows->change, num + met,
                         &rows->before));
  PetscCall(PetscMalloc2(entries, &rows->column, entries, &rows->value));
  rows->start[0] = 0;
  PetscCall(MatGetOwnershipRange(factor->few, &begin, NULL));
  PetscCall(ISGetIndices(factor->rows, &place));
  PetscCall(FactorRowsAdd_Private(factor->few, begin, num, place, rows));
  PetscCall(ISRestoreIndices(factor->rows, &place));
  if (there) PetscCall(FactorRowsAdd_Private(there[0], 0, met, places, rows));
  if (there) PetscCall(MatDestroySubMatrices(1, &there));
  PetscCall(PetscFree(list));
  PetscCall(PetscFree(places));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends ghosts. [in] more - ascending [num] */
static PetscErrorCode BasisGhostsAppend_Private(BasisGhosts g, PetscInt num, const PetscInt more[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscRealloc((size_t)(g->num + num) * sizeof(PetscInt), &g->ghost));
  PetscCall(PetscRealloc((size_t)(g->num + num) * sizeof(PetscInt), &g->sorted));
  PetscCall(PetscRealloc((size_t)(g->num + num) * sizeof(PetscInt), &g->which));
  PetscCall(PetscArraycpy(&g->ghost[g->num], more, num));
  g->num += num;
  PetscCall(PetscArraycpy(g->sorted, g->ghost, g->num));
  for (PetscInt i = 0; i < g->num; i++) g->which[i] = i;
  PetscCall(PetscSortIntWithArray(g->num, g->sorted, g->which));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The place of an unknown, or -1. */
static PetscErrorCode BasisGhostsFind_Private(const BasisGhosts g, PetscInt unknown, PetscInt *place)
{
  PetscInt at;

  PetscFunctionBeginUser;
  *place = unknown - g->begin;
  if (*place >= 0 && *place < g->n) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscFindInt(unknown, g->num, g->sorted, &at));
  *place = at < 0 ? -1 : g->n + g->which[at];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends the ghosts on which rows depend, and sets places of columns. */
static PetscErrorCode BasisGhostsSetColumns_Private(BasisGhosts g, FactorRows *rows)
{
  const PetscInt entries = rows->start[rows->num];
  PetscInt      *more, num = 0, place;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(entries, &more));
  for (PetscInt j = 0; j < entries; j++) {
    PetscCall(BasisGhostsFind_Private(g, rows->column[j], &place));
    if (place < 0) more[num++] = rows->column[j];
  }
  PetscCall(PetscSortRemoveDupsInt(&num, more));
  PetscCall(BasisGhostsAppend_Private(g, num, more));
  PetscCall(PetscFree(more));
  for (PetscInt j = 0; j < entries; j++) PetscCall(BasisGhostsFind_Private(g, rows->column[j], &rows->column[j]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Lists the ghosts to which T' adds something of own rows. */
static PetscErrorCode BasisGhostsListBack_Private(BasisGhosts g)
{
  PetscBool *meets;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(g->n + g->num, &meets));
  for (PetscInt i = 0; i < g->n; i++) meets[i] = PETSC_TRUE;
  for (int f = 0; f < BASIS_FACTORS; f++) {
    const FactorRows *rows = &g->rows[f];

    for (PetscInt i = 0; i < rows->num; i++)
      for (PetscInt j = rows->start[i]; j < rows->start[i + 1] && meets[rows->row[i]]; j++)
        meets[rows->column[j]] = PETSC_TRUE;
  }
  PetscCall(PetscMalloc1(g->num, &g->back));
  for (PetscInt i = 0; i < g->num; i++)
    if (meets[g->n + i]) g->back[g->num_back++] = i;
  PetscCall(PetscFree(meets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The exchange of some ghosts. [in] some - of ghosts, or NULL for the first [num]; [out] values - of these */
static PetscErrorCode BasisGhostsConnect_Private(const BasisGhosts g, Vec x, PetscInt num, const PetscInt some[],
                                                 Vec values, VecScatter *scatter)
{
  PetscInt *number;
  IS        from;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, &number));
  for (PetscInt i = 0; i < num; i++) number[i] = g->ghost[some ? some[i] : i];
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num, number, PETSC_OWN_POINTER, &from));
  PetscCall(VecScatterCreate(x, from, values, NULL, scatter));
  PetscCall(ISDestroy(&from));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisGhostsCreate(Mat K, const BasisFactor factors[], BasisGhosts *ghosts)
{
  BasisGhosts     g;
  PetscMPIInt     size;
  const PetscInt *ghost;
  Vec             x;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&g));
  g->references = 1;
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)K), &size));
  PetscCall(MatGetLocalSize(K, &g->n, NULL));
  PetscCall(MatGetSize(K, &g->N, NULL));
  PetscCall(MatGetOwnershipRange(K, &g->begin, NULL));
  if (size > 1) {
    PetscCall(MatGetGhosts(K, &g->of_K, &ghost));
    PetscCall(BasisGhostsAppend_Private(g, g->of_K, ghost));
  }
  for (int f = 0; f < BASIS_FACTORS; f++) {
    PetscCall(FactorRowsCreate_Private(g, (PetscBool)(size > 1), &factors[f], &g->rows[f]));
    PetscCall(BasisGhostsSetColumns_Private(g, &g->rows[f]));
  }
  PetscCall(PetscFree(g->sorted));
  PetscCall(PetscFree(g->which));
  *ghosts = g;
  if (size == 1) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(g->num, &g->x));
  PetscCall(BasisGhostsListBack_Private(g));
  PetscCall(PetscCalloc1(g->num, &g->force));
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, g->num, g->x, &g->from));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, g->num_back, &g->to));
  PetscCall(VecCreateMPIWithArray(PetscObjectComm((PetscObject)K), 1, g->n, g->N, NULL, &x));
  PetscCall(BasisGhostsConnect_Private(g, x, g->num, NULL, g->from, &g->scatter));
  PetscCall(BasisGhostsConnect_Private(g, x, g->num_back, g->back, g->to, &g->backward));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void BasisGhostsReference(BasisGhosts ghosts)
{
  ghosts->references++;
}

PetscErrorCode BasisGhostsDestroy(BasisGhosts *ghosts)
{
  BasisGhosts g = *ghosts;

  PetscFunctionBeginUser;
  *ghosts = NULL;
  if (!g || --g->references) PetscFunctionReturn(PETSC_SUCCESS);
  for (int f = 0; f < BASIS_FACTORS; f++) {
    PetscCall(PetscFree4(g->rows[f].row, g->rows[f].start, g->rows[f].change, g->rows[f].before));
    PetscCall(PetscFree2(g->rows[f].column, g->rows[f].value));
  }
  PetscCall(VecDestroy(&g->from));
  PetscCall(VecScatterDestroy(&g->scatter));
  PetscCall(VecDestroy(&g->to));
  PetscCall(VecScatterDestroy(&g->backward));
  PetscCall(PetscFree(g->ghost));
  PetscCall(PetscFree(g->back));
  PetscCall(PetscFree(g->force));
  PetscCall(PetscFree(g->x));
  PetscCall(PetscFree(g));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Collective. */
static PetscErrorCode BasisGhostsGet_Private(BasisGhosts g, Vec x)
{
  PetscFunctionBeginUser;
  if (!g->scatter) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecScatterBegin(g->scatter, x, g->from, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(g->scatter, x, g->from, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The value at a place. [in] own - of x [n] */
static inline PetscScalar *BasisGhostsAt_Private(const BasisGhosts g, PetscScalar own[], PetscInt place)
{
  return place < g->n ? &own[place] : &g->x[place - g->n];
}

PetscErrorCode BasisGhostsMult(BasisGhosts g, Vec x, const PetscScalar **own, const PetscScalar **others)
{
  PetscScalar *a;

  PetscFunctionBeginUser;
  PetscCall(BasisGhostsGet_Private(g, x));
  PetscCall(VecGetArrayRead(x, own));
  a = (PetscScalar *)*own;
  for (int f = BASIS_FACTORS - 1; f >= 0; f--) {
    const FactorRows *rows = &g->rows[f];

    for (PetscInt i = 0; i < rows->num; i++) {
      PetscScalar sum = 0;

      for (PetscInt j = rows->start[i]; j < rows->start[i + 1]; j++)
        sum += rows->value[j] * *BasisGhostsAt_Private(g, a, rows->column[j]);
      rows->change[i] = sum;
    }
    for (PetscInt i = 0; i < rows->num; i++) {
      PetscScalar *at = BasisGhostsAt_Private(g, a, rows->row[i]);

      rows->before[i] = *at;
      *at += rows->change[i];
    }
    PetscCall(PetscLogFlops(2.0 * rows->start[rows->num] + rows->num));
  }
  *others = g->x;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisGhostsRestore(BasisGhosts g, Vec x, const PetscScalar **own)
{
  PetscScalar *a = (PetscScalar *)*own;

  PetscFunctionBeginUser;
  for (int f = 0; f < BASIS_FACTORS; f++)
    for (PetscInt i = 0; i < g->rows[f].num; i++)
      *BasisGhostsAt_Private(g, a, g->rows[f].row[i]) = g->rows[f].before[i];
  PetscCall(VecRestoreArrayRead(x, own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y <- (1 + E)'y of the rows here. [in,out] own - [n]; [in,out] force - at ghosts */
static void BasisGhostsAddTranspose_Private(const BasisGhosts g, const FactorRows *rows, PetscScalar own[])
{
  for (PetscInt i = 0; i < rows->num; i++)
    rows->change[i] = rows->row[i] < g->n ? own[rows->row[i]] : g->force[rows->row[i] - g->n];
  for (PetscInt i = 0; i < rows->num; i++) {
    if (rows->change[i] == 0) continue;
    for (PetscInt j = rows->start[i]; j < rows->start[i + 1]; j++) {
      const PetscInt to = rows->column[j];

      *(to < g->n ? &own[to] : &g->force[to - g->n]) += rows->value[j] * rows->change[i];
    }
  }
}

PetscErrorCode BasisGhostsMultTranspose(BasisGhosts g, Vec y)
{
  PetscScalar *own, *to;

  PetscFunctionBeginUser;
  if (g->scatter) PetscCall(PetscArrayzero(g->force, g->num));
  PetscCall(VecGetArray(y, &own));
  for (int f = 0; f < BASIS_FACTORS; f++) {
    BasisGhostsAddTranspose_Private(g, &g->rows[f], own);
    PetscCall(PetscLogFlops(2.0 * g->rows[f].start[g->rows[f].num]));
  }
  PetscCall(VecRestoreArray(y, &own));
  if (!g->scatter) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(VecGetArrayWrite(g->to, &to));
  for (PetscInt i = 0; i < g->num_back; i++) to[i] = g->force[g->back[i]];
  PetscCall(VecRestoreArrayWrite(g->to, &to));
  PetscCall(VecScatterBegin(g->backward, g->to, y, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(g->backward, g->to, y, ADD_VALUES, SCATTER_REVERSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BasisGhostsReach(BasisGhosts g, Vec region)
{
  PetscScalar *own;

  PetscFunctionBeginUser;
  PetscCall(BasisGhostsGet_Private(g, region));
  PetscCall(VecGetArray(region, &own));
  for (int f = BASIS_FACTORS - 1; f >= 0; f--) {
    const FactorRows *rows = &g->rows[f];

    for (PetscInt i = 0; i < rows->num; i++) {
      rows->change[i] = *BasisGhostsAt_Private(g, own, rows->row[i]);
      for (PetscInt j = rows->start[i]; j < rows->start[i + 1]; j++)
        if (*BasisGhostsAt_Private(g, own, rows->column[j]) != 0) rows->change[i] = 1;
    }
    for (PetscInt i = 0; i < rows->num; i++) *BasisGhostsAt_Private(g, own, rows->row[i]) = rows->change[i];
  }
  PetscCall(VecRestoreArray(region, &own));
  PetscFunctionReturn(PETSC_SUCCESS);
}
