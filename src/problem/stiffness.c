/* stiffness.c -- see the header.

   K takes more memory than anything else. An AIJ matrix would take three times as much, and iterations would
   need this form beside it for its faster products. Blocks that couple to unknowns of other ranks are stored
   separately, in full. */
#include "problem/stiffness.h"
#include "base/compat.h"

typedef struct {
  PetscInt        bs, begin; /* begin: this rank's first unknown */
  SymmetricBlocks own;
  PetscInt    *start, *column; /* blocks among ghosts, by rows [num+1], [start[num]]; NULL on one rank, as all below */
  PetscScalar *value;          /* [start[num]][bs][bs] */
  BlockRows    border;         /* rows that have such blocks */
  PetscInt     num_ghosts;
  PetscInt    *ghost;  /* global numbers of unknowns of other ranks, ascending [num_ghosts] */
  Vec          ghosts; /* their values */
  VecScatter   scatter;
  PetscInt     node, max, length; /* row that was asked for last, room, entries of each of its rows */
  PetscBool    written;           /* whether rows has them */
  PetscInt    *columns;           /* [length] */
  PetscScalar *rows;              /* [bs][length] */
} Stiffness;

typedef struct {
  Mat       K;
  PetscReal factor;
  float    *single; /* factor K of this rank, or NULL; blocks among ghosts are few */
  PetscBool some;   /* whether products are those of some rows alone */
  BlockRows rows;   /* these */
} Scaled;

/* y += factor V x for the blocks among ghosts. [in] rows - NULL for all */
static void StiffnessAddOthers_Private(const Stiffness *s, const BlockRows *rows, PetscReal factor,
                                       const PetscScalar x[], PetscScalar y[])
{
  const PetscInt bs = s->bs;

  if (!rows) rows = &s->border;
  for (PetscInt r = 0; r < rows->num; r++) {
    const PetscInt     i = rows->row[r];
    const PetscScalar *v = &s->value[(size_t)s->start[i] * (size_t)(bs * bs)];

    for (PetscInt j = s->start[i]; j < s->start[i + 1]; j++, v += bs * bs) {
      for (PetscInt k = 0; k < bs; k++)
        for (PetscInt l = 0; l < bs; l++) y[bs * i + k] += factor * v[bs * k + l] * x[bs * s->column[j] + l];
    }
  }
}

/* y = factor K x of the columns of this rank. [in] scaled - how */
static PetscErrorCode StiffnessMultOwn_Private(const Stiffness *s, const Scaled *scaled, const PetscScalar x[],
                                               PetscScalar y[])
{
  PetscFunctionBeginUser;
  if (scaled->some)
    SymmetricBlocksMultRows(&s->own, &scaled->rows, scaled->factor, scaled->single, x, y);
  else if (scaled->single)
    SymmetricBlocksMultSingle(&s->own, scaled->single, x, y);
  else
    SymmetricBlocksMult(&s->own, scaled->factor, x, y);
  PetscCall(PetscLogFlops(2.0 * (s->own.start[s->own.num] + s->own.num) * s->bs * s->bs));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds the columns of ghosts. */
static PetscErrorCode StiffnessMultOthers_Private(const Stiffness *s, const Scaled *scaled, const PetscScalar x[],
                                                  PetscScalar y[])
{
  PetscFunctionBeginUser;
  StiffnessAddOthers_Private(s, scaled->some ? &scaled->rows : NULL, scaled->factor, x, y);
  PetscCall(PetscLogFlops(2.0 * s->start[s->own.num] * s->bs * s->bs));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y = factor K x. [in] scaled - how */
static PetscErrorCode StiffnessMult_Private(const Scaled *scaled, Vec x, Vec y)
{
  Stiffness         *s;
  const PetscScalar *xa;
  PetscScalar       *ya;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(scaled->K, &s));
  if (s->ghosts) PetscCall(VecScatterBegin(s->scatter, x, s->ghosts, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(x, &xa));
  PetscCall(VecGetArrayWrite(y, &ya));
  PetscCall(StiffnessMultOwn_Private(s, scaled, xa, ya));
  PetscCall(VecRestoreArrayRead(x, &xa));
  if (s->ghosts) {
    PetscCall(VecScatterEnd(s->scatter, x, s->ghosts, INSERT_VALUES, SCATTER_FORWARD));
    PetscCall(VecGetArrayRead(s->ghosts, &xa));
    PetscCall(StiffnessMultOthers_Private(s, scaled, xa, ya));
    PetscCall(VecRestoreArrayRead(s->ghosts, &xa));
  }
  PetscCall(VecRestoreArrayWrite(y, &ya));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StiffnessMultLocal(Mat S, const PetscScalar own[], const PetscScalar others[], PetscScalar y[])
{
  Scaled    *scaled;
  Stiffness *s;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &scaled));
  PetscCall(MatShellGetContext(scaled->K, &s));
  PetscCall(StiffnessMultOwn_Private(s, scaled, own, y));
  if (s->ghosts) PetscCall(StiffnessMultOthers_Private(s, scaled, others, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MatMult_Stiffness(Mat K, Vec x, Vec y)
{
  PetscFunctionBeginUser;
  PetscCall(StiffnessMult_Private(&(Scaled){.K = K, .factor = 1}, x, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MatMult_Scaled(Mat S, Vec x, Vec y)
{
  Scaled *scaled;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &scaled));
  PetscCall(StiffnessMult_Private(scaled, x, y));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Blocks of a node among ghosts that come before its own ones. */
static PetscInt StiffnessGetBelow_Private(const Stiffness *s, PetscInt begin, PetscInt end)
{
  PetscInt below = begin;

  while (below < end && s->ghost[s->bs * s->column[below]] < s->begin) below++;
  return below - begin;
}

/* Columns of the rows of a node, on all ranks. */
static PetscErrorCode StiffnessSetColumns_Private(Stiffness *s, PetscInt node)
{
  const SymmetricBlocks *own = &s->own;
  const PetscInt         bs = s->bs, mine = bs * (own->start[node + 1] - own->start[node]);
  const PetscInt         begin = s->start ? s->start[node] : 0, end = s->start ? s->start[node + 1] : 0;
  const PetscInt         below = StiffnessGetBelow_Private(s, begin, end);
  PetscInt               at;

  PetscFunctionBeginUser;
  s->node    = node;
  s->written = PETSC_FALSE;
  s->length  = mine + bs * (end - begin);
  if (s->length > s->max) {
    s->max = 2 * s->length;
    PetscCall(PetscRealloc((size_t)s->max * sizeof(PetscInt), &s->columns));
    PetscCall(PetscRealloc((size_t)s->max * bs * sizeof(PetscScalar), &s->rows));
  }
  for (PetscInt j = begin; j < end; j++) {
    at = bs * (j - begin) + (j - begin < below ? 0 : mine);
    for (PetscInt l = 0; l < bs; l++) s->columns[at + l] = s->ghost[bs * s->column[j]] + l;
  }
  at = bs * below;
  for (PetscInt j = own->start[node]; j < own->start[node + 1]; j++)
    for (PetscInt l = 0; l < bs; l++) s->columns[at++] = s->begin + bs * own->column[j] + l;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Values of these rows. Blocks left of the diagonal lie in other rows: collecting them costs more than the
   columns. */
static void StiffnessSetValues_Private(Stiffness *s)
{
  const PetscInt bs = s->bs, begin = s->start ? s->start[s->node] : 0, end = s->start ? s->start[s->node + 1] : 0;
  const PetscInt below = StiffnessGetBelow_Private(s, begin, end), mine = s->length - bs * (end - begin);

  for (PetscInt j = begin; j < end; j++) {
    const PetscInt at = bs * (j - begin) + (j - begin < below ? 0 : mine);

    for (PetscInt kl = 0; kl < bs * bs; kl++)
      s->rows[kl / bs * s->length + at + kl % bs] = s->value[(size_t)j * bs * bs + kl];
  }
  SymmetricBlocksGetRow(&s->own, s->node, s->length, &s->rows[bs * below]);
  s->written = PETSC_TRUE;
}

static PetscErrorCode MatGetRow_Stiffness(Mat K, PetscInt row, PetscInt *num, PetscInt **columns, PetscScalar **values)
{
  Stiffness *s;
  PetscInt   node;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(K, &s));
  node = (row - s->begin) / s->bs;
  if (node != s->node) PetscCall(StiffnessSetColumns_Private(s, node));
  if (values && !s->written) StiffnessSetValues_Private(s);
  if (num) *num = s->length;
  if (columns) *columns = s->columns;
  if (values) *values = &s->rows[(row - s->begin) % s->bs * s->length];
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MatGetGhosts_Stiffness(Mat K, PetscInt *num, const PetscInt *ghosts[])
{
  Stiffness *s;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(K, &s));
  if (num) *num = s->num_ghosts;
  if (ghosts) *ghosts = s->ghost;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MatGetDiagonal_Stiffness(Mat K, Vec diagonal)
{
  Stiffness   *s;
  PetscScalar *d;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(K, &s));
  PetscCall(VecGetArrayWrite(diagonal, &d));
  for (PetscInt i = 0; i < s->own.num; i++) {
    for (PetscInt k = 0; k < s->bs; k++)
      d[s->bs * i + k] = s->own.value[((size_t)s->own.first[i] * s->bs + k) * s->bs + k];
  }
  PetscCall(VecRestoreArrayWrite(diagonal, &d));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The infinity norm. */
static PetscErrorCode MatNorm_Stiffness(Mat K, NormType type, PetscReal *norm)
{
  Stiffness *s;

  PetscFunctionBeginUser;
  PetscCheck(type == NORM_INFINITY, PetscObjectComm((PetscObject)K), PETSC_ERR_SUP, "Another norm of a stiffness");
  PetscCall(MatShellGetContext(K, &s));
  *norm = 0;
  for (PetscInt i = 0; i < s->own.num; i++) {
    PetscCall(StiffnessSetColumns_Private(s, i));
    StiffnessSetValues_Private(s);
    for (PetscInt k = 0; k < s->bs; k++) {
      PetscReal sum = 0;

      for (PetscInt j = 0; j < s->length; j++) sum += PetscAbsScalar(s->rows[k * s->length + j]);
      *norm = PetscMax(*norm, sum);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, norm, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)K)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Entries of both triangles on all ranks. */
static PetscErrorCode MatGetInfo_Stiffness(Mat K, MatInfoType type, MatInfo *info)
{
  Stiffness *s;

  PetscFunctionBeginUser;
  (void)type;
  PetscCall(MatShellGetContext(K, &s));
  *info         = (MatInfo){.block_size = s->bs};
  info->nz_used = (PetscLogDouble)(s->own.start[s->own.num] + (s->start ? s->start[s->own.num] : 0)) * s->bs * s->bs;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &info->nz_used, 1, MPI_DOUBLE, MPI_SUM, PetscObjectComm((PetscObject)K)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* An AIJ matrix with room for it. */
static PetscErrorCode StiffnessCreateMatrix_Private(Mat K, const Stiffness *s, Mat *A)
{
  const PetscInt n = s->own.num;
  PetscInt      *same, *other;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(n, &same, n, &other));
  for (PetscInt i = 0; i < n; i++) same[i] = s->own.start[i + 1] - s->own.start[i];
  for (PetscInt i = 0; i < n && s->start; i++) other[i] = s->start[i + 1] - s->start[i];
  PetscCall(MatCreate(PetscObjectComm((PetscObject)K), A));
  PetscCall(MatSetSizes(*A, s->bs * n, s->bs * n, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetBlockSize(*A, s->bs));
  PetscCall(MatSetType(*A, MATAIJ));
  PetscCall(MatXAIJSetPreallocation(*A, s->bs, same, other, NULL, NULL));
  PetscCall(PetscFree2(same, other));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MatConvert_Stiffness(Mat K, MatType type, MatReuse reuse, Mat *A)
{
  Stiffness *s;

  PetscFunctionBeginUser;
  (void)type;
  PetscCheck(reuse == MAT_INITIAL_MATRIX, PetscObjectComm((PetscObject)K), PETSC_ERR_SUP, "A stiffness stays");
  PetscCall(MatShellGetContext(K, &s));
  PetscCall(StiffnessCreateMatrix_Private(K, s, A));
  for (PetscInt i = 0; i < s->own.num; i++) {
    PetscCall(StiffnessSetColumns_Private(s, i));
    StiffnessSetValues_Private(s);
    for (PetscInt k = 0; k < s->bs; k++) {
      const PetscInt row = s->begin + s->bs * i + k;

      PetscCall(MatSetValues(*A, 1, &row, s->length, s->columns, &s->rows[k * s->length], INSERT_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatSetOption(*A, MAT_SYMMETRIC, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MatDestroy_Stiffness(Mat K)
{
  Stiffness *s;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(K, &s));
  PetscCall(SymmetricBlocksDestroy(&s->own));
  PetscCall(PetscFree(s->start));
  PetscCall(PetscFree(s->column));
  PetscCall(PetscFree(s->value));
  PetscCall(PetscFree(s->border.row));
  PetscCall(PetscFree(s->ghost));
  PetscCall(VecDestroy(&s->ghosts));
  PetscCall(VecScatterDestroy(&s->scatter));
  PetscCall(PetscFree(s->columns));
  PetscCall(PetscFree(s->rows));
  PetscCall(PetscFree(s));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode MatDestroy_Scaled(Mat S)
{
  Scaled *scaled;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &scaled));
  PetscCall(MatDestroy(&scaled->K));
  PetscCall(PetscFree(scaled->single));
  PetscCall(PetscFree(scaled->rows.row));
  PetscCall(PetscFree(scaled));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in] s - own.num and bs */
static PetscErrorCode StiffnessCreateShell_Private(MPI_Comm comm, Stiffness *s, Mat *K)
{
  static const struct {
    MatOperation operation;
    void (*apply)(void);
  } known[]                              = {{MATOP_MULT, (void (*)(void))MatMult_Stiffness},
                                            {MATOP_MULT_TRANSPOSE, (void (*)(void))MatMult_Stiffness},
                                            {MATOP_GET_ROW, (void (*)(void))MatGetRow_Stiffness},
                                            {MATOP_GET_GHOSTS, (void (*)(void))MatGetGhosts_Stiffness},
                                            {MATOP_GET_DIAGONAL, (void (*)(void))MatGetDiagonal_Stiffness},
                                            {MATOP_NORM, (void (*)(void))MatNorm_Stiffness},
                                            {MATOP_GETINFO, (void (*)(void))MatGetInfo_Stiffness},
                                            {MATOP_DESTROY, (void (*)(void))MatDestroy_Stiffness}};
  static const char *const conversions[] = {"MatConvert_shell_aij_C", "MatConvert_shell_seqaij_C",
                                            "MatConvert_shell_mpiaij_C"};
  const PetscInt           n             = s->bs * s->own.num;

  PetscFunctionBeginUser;
  s->node = -1;
  PetscCall(SymmetricBlocksShare(&s->own));
  PetscCall(MatCreateShell(comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, s, K));
  PetscCall(MatSetBlockSize(*K, s->bs));
  PetscCall(MatGetOwnershipRange(*K, &s->begin, NULL));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(known); i++)
    PetscCall(MatShellSetOperation(*K, known[i].operation, known[i].apply));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(conversions); i++)
    PetscCall(PetscObjectComposeFunction((PetscObject)*K, conversions[i], MatConvert_Stiffness));
  PetscCall(MatSetOption(*K, MAT_SYMMETRIC, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Creates the scatter of the ghosts. [in,out] others - taken over */
static PetscErrorCode StiffnessSetGhosts_Private(MPI_Comm comm, GhostBlocks *others, Stiffness *s)
{
  const PetscInt n = s->bs * s->own.num;
  IS             from;
  Vec            x;

  PetscFunctionBeginUser;
  s->start  = others->start;
  s->column = others->column;
  s->value  = others->value;
  PetscCall(PetscMalloc1(s->own.num, &s->border.row));
  for (PetscInt i = 0; i < s->own.num; i++)
    if (s->start[i] < s->start[i + 1]) s->border.row[s->border.num++] = i;
  PetscCall(VecCreateMPIWithArray(comm, s->bs, n, PETSC_DETERMINE, NULL, &x));
  PetscCall(ISCreateBlock(PETSC_COMM_SELF, s->bs, others->num, others->node, PETSC_COPY_VALUES, &from));
  s->num_ghosts = s->bs * others->num;
  PetscCall(PetscMalloc1(s->num_ghosts, &s->ghost));
  for (PetscInt i = 0; i < s->num_ghosts; i++) s->ghost[i] = s->bs * others->node[i / s->bs] + i % s->bs;
  PetscCall(PetscFree(others->node));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, s->num_ghosts, &s->ghosts));
  PetscCall(VecScatterCreate(x, from, s->ghosts, NULL, &s->scatter));
  PetscCall(ISDestroy(&from));
  PetscCall(VecDestroy(&x));
  *others = (GhostBlocks){.num = 0};
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StiffnessCreate(MPI_Comm comm, SymmetricBlocks *blocks, GhostBlocks *others, Mat *K)
{
  Stiffness *s;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->bs   = blocks->bs;
  s->own  = *blocks;
  *blocks = (SymmetricBlocks){.bs = 0};
  if (others) PetscCall(StiffnessSetGhosts_Private(comm, others, s));
  PetscCall(StiffnessCreateShell_Private(comm, s, K));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Which blocks a matrix has.
   [out] start, column - by block rows; owned by the caller [num+1], [start[num]] */
static PetscErrorCode StiffnessListBlocks_Private(Mat A, PetscInt bs, PetscInt num, PetscInt **start, PetscInt **column)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num + 1, start));
  (*start)[0] = 0;
  for (int pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(PetscMalloc1((*start)[num], column));
    for (PetscInt i = 0; i < num; i++) {
      const PetscInt *columns;
      PetscInt        size;

      PetscCall(MatGetRow(A, bs * i, &size, &columns, NULL));
      (*start)[i + 1] = (*start)[i] + size / bs;
      for (PetscInt j = 0; j < size && pass; j += bs) (*column)[(*start)[i] + j / bs] = columns[j] / bs;
      PetscCall(MatRestoreRow(A, bs * i, &size, &columns, NULL));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Copies values of the blocks of each row from one of them on.
   [in] diagonal - the first block of each row; NULL for all [num] */
static PetscErrorCode StiffnessCopyBlocks_Private(Mat A, PetscInt bs, PetscInt num, const PetscInt start[],
                                                  const PetscInt diagonal[], PetscScalar value[])
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt skip = diagonal ? bs * (diagonal[i] - start[i]) : 0;
    PetscInt       size = 0;

    for (PetscInt k = 0; k < bs; k++) {
      const PetscScalar *values;

      PetscCall(MatGetRow(A, bs * i + k, &size, NULL, &values));
      for (PetscInt j = 0; j < size - skip; j++) value[(j / bs * bs + k) * bs + j % bs] = values[skip + j];
      PetscCall(MatRestoreRow(A, bs * i + k, NULL, NULL, &values));
    }
    value += bs * (size - skip);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Blocks among ghosts. [in] ghost - global numbers of their unknowns, the columns of A */
static PetscErrorCode StiffnessCopyGhosts_Private(Mat A, PetscInt bs, PetscInt num, const PetscInt ghost[],
                                                  GhostBlocks *others)
{
  PetscFunctionBeginUser;
  PetscCall(StiffnessListBlocks_Private(A, bs, num, &others->start, &others->column));
  PetscCall(PetscMalloc1((size_t)others->start[num] * (size_t)(bs * bs), &others->value));
  PetscCall(StiffnessCopyBlocks_Private(A, bs, num, others->start, NULL, others->value));
  PetscCall(MatGetSize(A, NULL, &others->num));
  others->num /= bs;
  PetscCall(PetscMalloc1(others->num, &others->node));
  for (PetscInt i = 0; i < others->num; i++) others->node[i] = ghost[bs * i] / bs;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StiffnessCreateOfMatrix(Mat A, Mat *K)
{
  GhostBlocks     others;
  SymmetricBlocks blocks;
  Mat             own = A, far;
  PetscBool       sequential;
  const PetscInt *ghost;
  PetscInt        n, bs, *start, *column;

  PetscFunctionBeginUser;
  PetscCall(MatGetBlockSize(A, &bs));
  PetscCall(MatGetLocalSize(A, &n, NULL));
  n /= bs;
  PetscCall(PetscObjectTypeCompare((PetscObject)A, MATSEQAIJ, &sequential));
  if (!sequential) PetscCall(MatMPIAIJGetSeqAIJ(A, &own, &far, &ghost));
  PetscCall(StiffnessListBlocks_Private(own, bs, n, &start, &column));
  PetscCall(SymmetricBlocksCreate(bs, n, start, column, &blocks));
  PetscCall(StiffnessCopyBlocks_Private(own, bs, n, start, blocks.diagonal, blocks.value));
  if (!sequential) PetscCall(StiffnessCopyGhosts_Private(far, bs, n, ghost, &others));
  PetscCall(StiffnessCreate(PetscObjectComm((PetscObject)A), &blocks, sequential ? NULL : &others, K));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StiffnessCreateScaled(Mat K, PetscReal factor, Mat *S)
{
  Scaled  *scaled;
  PetscInt n, bs;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&scaled));
  PetscCall(PetscObjectReference((PetscObject)K));
  *scaled = (Scaled){.K = K, .factor = factor};
  PetscCall(MatGetLocalSize(K, &n, NULL));
  PetscCall(MatGetBlockSize(K, &bs));
  PetscCall(MatCreateShell(PetscObjectComm((PetscObject)K), n, n, PETSC_DETERMINE, PETSC_DETERMINE, scaled, S));
  PetscCall(MatSetBlockSize(*S, bs));
  PetscCall(MatShellSetOperation(*S, MATOP_MULT, (void (*)(void))MatMult_Scaled));
  PetscCall(MatShellSetOperation(*S, MATOP_DESTROY, (void (*)(void))MatDestroy_Scaled));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StiffnessCreateSingle(Mat K, PetscReal factor, Mat *S)
{
  Scaled    *scaled;
  Stiffness *s;

  PetscFunctionBeginUser;
  PetscCall(StiffnessCreateScaled(K, factor, S));
  PetscCall(MatShellGetContext(*S, &scaled));
  PetscCall(MatShellGetContext(K, &s));
  PetscCall(SymmetricBlocksCreateSingle(&s->own, factor, &scaled->single));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a row is in a region or couples to it. [in] own, others - of unknowns of this rank and of ghosts */
static PetscBool StiffnessMeets_Private(const Stiffness *s, PetscInt i, const PetscScalar own[],
                                        const PetscScalar others[])
{
  for (PetscInt j = s->own.start[i]; j < s->own.start[i + 1]; j++)
    if (own[s->bs * s->own.column[j]] != 0) return PETSC_TRUE;
  for (PetscInt j = s->start ? s->start[i] : 0; j < (s->start ? s->start[i + 1] : 0); j++)
    if (others[s->bs * s->column[j]] != 0) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* Lists the rows of a region and those that couple to it. [out] read - blocks that a product with them
   reads */
static PetscErrorCode StiffnessListRows_Private(Stiffness *s, Vec region, BlockRows *rows, PetscReal *read)
{
  const PetscScalar *own, *others = NULL;

  PetscFunctionBeginUser;
  if (s->ghosts) PetscCall(VecScatterBegin(s->scatter, region, s->ghosts, INSERT_VALUES, SCATTER_FORWARD));
  if (s->ghosts) PetscCall(VecScatterEnd(s->scatter, region, s->ghosts, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArrayRead(region, &own));
  if (s->ghosts) PetscCall(VecGetArrayRead(s->ghosts, &others));
  PetscCall(PetscMalloc1(s->own.num, &rows->row));
  for (PetscInt i = 0; i < s->own.num; i++) {
    if (!StiffnessMeets_Private(s, i, own, others)) continue;
    rows->row[rows->num++] = i;
    *read += (PetscReal)(s->own.start[i + 1] - s->own.start[i] + (s->start ? s->start[i + 1] - s->start[i] : 0));
  }
  if (s->ghosts) PetscCall(VecRestoreArrayRead(s->ghosts, &others));
  PetscCall(VecRestoreArrayRead(region, &own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StiffnessRestrict(Mat S, Vec region, PetscReal *part)
{
  Scaled    *scaled;
  Stiffness *s;
  PetscReal  read = 0;
  MatInfo    all;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &scaled));
  PetscCall(MatShellGetContext(scaled->K, &s));
  PetscCall(PetscFree(scaled->rows.row));
  scaled->rows.num = 0;
  scaled->some     = (PetscBool)(region != NULL);
  *part            = 1;
  if (!region) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(StiffnessListRows_Private(s, region, &scaled->rows, &read));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &read, 1, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)S)));
  PetscCall(MatGetInfo(scaled->K, MAT_GLOBAL_SUM, &all));
  *part = read * s->bs * s->bs / all.nz_used;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StiffnessGetBlocks(Mat K, const SymmetricBlocks **blocks, GhostBlocks *others)
{
  Stiffness *s;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(K, &s));
  *blocks = &s->own;
  *others = (GhostBlocks){.num = s->num_ghosts / s->bs, .start = s->start, .column = s->column, .value = s->value};
  PetscFunctionReturn(PETSC_SUCCESS);
}
