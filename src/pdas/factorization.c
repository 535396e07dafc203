/* factorization.c -- MUMPS, called directly.

   PETSc cannot pass an ordering to MUMPS' Cholesky factorization. With a Schur complement MUMPS itself offers
   minimum degree only, which in 3D costs twice the operations of nested dissection and a quarter more
   memory. */
#include <dmumps_c.h>
#include "base/threads.h"
#include "base/usererror.h"
#include "pdas/factorization.h"

/* Controls of MUMPS by the numbers of its manual. */
enum {
  ICNTL_PRINT   = 4,
  ICNTL_ORDER   = 7,
  ICNTL_ROOM    = 14,
  ICNTL_INPUT   = 18,
  ICNTL_SCHUR   = 19,
  ICNTL_REDUCED = 26,
  NUM_ICNTL     = 60
};
enum { NUM_CNTL = 15 };
/* Their values: a given ordering, minimum degree; central or distributed entries; S on the host. */
enum { ORDER_GIVEN = 1, ORDER_MINIMUM_DEGREE = 0, INPUT_CENTRAL = 0, INPUT_DISTRIBUTED = 3, SCHUR_ON_HOST = 1 };
enum { LAST_ORDER = 7 };
/* Largest number of doublings of the workspace; 100 percent. */
enum { MAX_DOUBLED = 5, WHOLE = 100 };
/* Index of INFO with the predicted memory of a rank, in millions of bytes. */
enum { ANALYSED_SIZE = 15 };
enum { JOB_BEGIN = -1, JOB_END = -2, JOB_ANALYSE = 1, JOB_FACTOR = 2, JOB_SOLVE = 3, SYMMETRIC_DEFINITE = 1 };

/* Operations of a factorization from which on the threads of a BLAS work more than they wait: some seconds of
   a processor. */
static const PetscReal MANY_OPERATIONS = 1e11;

struct _n_Factor {
  DMUMPS_STRUC_C id;
  MPI_Comm       comm;
  PetscMPIInt    rank, size;
  VecScatter     to_host;  /* of right-hand sides and solutions */
  Vec            host;     /* gathered vector on the first rank, empty elsewhere */
  PetscInt      *position; /* of every unknown among the pivots, on the first rank; only during the factorization */
};

/* The upper triangle of this rank's rows, counted from 1. Zeros of fixed unknowns do not count in a
   dissection; minimum degree has been seen to find orderings of twice the cost without them. [out] id - its
   entries are owned by the caller */
static PetscErrorCode FactorizationCreateEntries_Private(Mat A, DMUMPS_STRUC_C *id)
{
  const PetscBool skip = (PetscBool)(id->icntl[ICNTL_ORDER - 1] == ORDER_GIVEN);
  PetscInt        begin, end;
  MUMPS_INT8      n = 0;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(A, &begin, &end));
  for (PetscInt pass = 0; pass < 2; pass++) {
    if (pass) PetscCall(PetscMalloc3(n, &id->irn_loc, n, &id->jcn_loc, n, &id->a_loc));
    id->nnz_loc = n;
    n           = 0;
    for (PetscInt row = begin; row < end; row++) {
      PetscInt           num;
      const PetscInt    *columns;
      const PetscScalar *values;

      PetscCall(MatGetRow(A, row, &num, &columns, &values));
      for (PetscInt c = 0; c < num; c++) {
        if (columns[c] < row || (skip && values[c] == 0)) continue;
        if (pass) {
          id->irn_loc[n] = (MUMPS_INT)row + 1;
          id->jcn_loc[n] = (MUMPS_INT)columns[c] + 1;
          id->a_loc[n]   = values[c];
        }
        n++;
      }
      PetscCall(MatRestoreRow(A, row, &num, &columns, &values));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What PETSc's options say. MUMPS would take another order for one that it does not know. Collective. */
static PetscErrorCode FactorizationSetControls_Private(MPI_Comm comm, const char prefix[], DMUMPS_STRUC_C *id)
{
  char option[64];

  PetscFunctionBeginUser;
  for (PetscInt i = 1; i <= NUM_ICNTL; i++) {
    PetscInt  value;
    PetscBool set;

    PetscCall(PetscSNPrintf(option, sizeof(option), "-mat_mumps_icntl_%" PetscInt_FMT, i));
    PetscCall(PetscOptionsGetInt(NULL, prefix, option, &value, &set));
    if (set && i == ICNTL_ORDER && (value < 0 || value > LAST_ORDER)) {
      PetscCall(UserErrorRaise(comm, "-%s%s %" PetscInt_FMT ": is not an ordering of MUMPS; must be 0 to %d",
                               prefix ? prefix : "", &option[1], value, LAST_ORDER));
    }
    if (set) id->icntl[i - 1] = (MUMPS_INT)value;
  }
  for (PetscInt i = 1; i <= NUM_CNTL; i++) {
    PetscCall(PetscSNPrintf(option, sizeof(option), "-mat_mumps_cntl_%" PetscInt_FMT, i));
    PetscCall(PetscOptionsGetReal(NULL, prefix, option, &id->cntl[i - 1], NULL));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FactorizationCheckInfo(MPI_Comm comm, PetscInt info)
{
  enum { REALS = -5, INTEGERS = -7, ALLOCATION = -13 };

  PetscFunctionBeginUser;
  PetscCheck(info != REALS && info != INTEGERS && info != ALLOCATION, comm, PETSC_ERR_MEM, "No memory for MUMPS");
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool FactorizationIsShort(PetscInt info)
{
  enum { INTEGERS = -8, REALS = -9, SEND_BUFFER = -17, RECEIVE_BUFFER = -20 };

  return (PetscBool)(info == INTEGERS || info == REALS || info == SEND_BUFFER || info == RECEIVE_BUFFER);
}

/* The error that INFOG(1) means. */
static MatFactorError FactorizationError_Private(MUMPS_INT info)
{
  enum { STRUCTURE = -6, ZERO_PIVOT = -10, NEGATIVE_PIVOT = -40 };
  static const MUMPS_INT memory[] = {-5, -7, -8, -9, -11, -13, -14, -15, -17, -18, -19, -20};

  if (info >= 0) return MAT_FACTOR_NOERROR;
  for (size_t i = 0; i < sizeof(memory) / sizeof(memory[0]); i++) {
    if (info == memory[i]) return MAT_FACTOR_OUTMEMORY;
  }
  if (info == STRUCTURE) return MAT_FACTOR_STRUCT_ZEROPIVOT;
  return info == ZERO_PIVOT || info == NEGATIVE_PIVOT ? MAT_FACTOR_NUMERIC_ZEROPIVOT : MAT_FACTOR_OTHER;
}

/* Factors. MUMPS allocates the workspace predicted by its analysis plus ICNTL(14) percent. If pivots or
   messages need more, it is doubled repeatedly. Lack of system memory is a separate error. Collective. */
static PetscErrorCode FactorizationCompute_Private(Factorization factor)
{
  DMUMPS_STRUC_C *id = &factor->id;
  PetscMPIInt     room;

  PetscFunctionBeginUser;
  id->job = JOB_FACTOR;
  for (int k = 0; k <= MAX_DOUBLED; k++) {
    dmumps_c(id);
    if (!FactorizationIsShort(id->infog[0])) break;
    room = id->icntl[ICNTL_ROOM - 1];
    PetscCallMPI(MPI_Bcast(&room, 1, MPI_INT, 0, factor->comm));
    id->icntl[ICNTL_ROOM - 1] = 2 * PetscMax(room, 0) + WHOLE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The ordering and the analysis. [in] C - [num] */
static PetscErrorCode FactorizationAnalyse_Private(Factorization factor, Mat A, PetscInt num, const PetscInt C[])
{
  DMUMPS_STRUC_C *id = &factor->id;

  PetscFunctionBeginUser;
  if (!factor->rank) {
    PetscCall(PetscMalloc3(id->n, &factor->position, id->n, &id->perm_in, num, &id->listvar_schur));
    for (PetscInt i = 0; i < num; i++) id->listvar_schur[i] = (MUMPS_INT)C[i] + 1;
  }
  if (id->icntl[ICNTL_ORDER - 1] == ORDER_GIVEN) {
    PetscCall(DissectionOrder(A, num, C, factor->position));
    for (PetscInt i = 0; i < id->n && !factor->rank; i++) id->perm_in[i] = (MUMPS_INT)factor->position[i];
  }
  id->size_schur = (MUMPS_INT)num;
  PetscCall(FactorizationCreateEntries_Private(A, id));
  if (factor->size == 1) { // MUMPS would collect distributed input in a second copy
    id->nnz = id->nnz_loc;
    id->irn = id->irn_loc;
    id->jcn = id->jcn_loc;
    id->a   = id->a_loc;
  }
  id->job = JOB_ANALYSE;
  dmumps_c(id);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Frees the matrix and its ordering, which solutions do not need. */
static PetscErrorCode FactorizationFreeMatrix_Private(Factorization factor)
{
  DMUMPS_STRUC_C *id = &factor->id;

  PetscFunctionBeginUser;
  PetscCall(PetscFree3(id->irn_loc, id->jcn_loc, id->a_loc));
  if (!factor->rank) PetscCall(PetscFree3(factor->position, id->perm_in, id->listvar_schur));
  id->schur = NULL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Starts MUMPS and sets its controls. [in] schur - whether some unknowns are last */
static PetscErrorCode FactorizationBegin_Private(Mat A, PetscBool schur, const char prefix[], Factorization *factor_out)
{
  const PetscInt  solid = 3;
  Factorization   factor;
  DMUMPS_STRUC_C *id;
  PetscInt        N, bs;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&factor));
  *factor_out  = factor;
  factor->comm = PetscObjectComm((PetscObject)A);
  PetscCallMPI(MPI_Comm_rank(factor->comm, &factor->rank));
  PetscCallMPI(MPI_Comm_size(factor->comm, &factor->size));
  PetscCall(MatGetSize(A, &N, NULL));
  PetscCall(MatGetBlockSize(A, &bs));
  id               = &factor->id;
  id->job          = JOB_BEGIN;
  id->par          = 1;
  id->sym          = SYMMETRIC_DEFINITE;
  id->comm_fortran = (MUMPS_INT)MPI_Comm_c2f(factor->comm);
  dmumps_c(id);
  PetscCall(FactorizationCheckInfo(factor->comm, id->infog[0]));
  id->n                      = (MUMPS_INT)N;
  id->icntl[ICNTL_PRINT - 1] = 0;
  id->icntl[ICNTL_ORDER - 1] = bs < solid ? ORDER_MINIMUM_DEGREE : ORDER_GIVEN;
  id->icntl[ICNTL_INPUT - 1] = factor->size == 1 ? INPUT_CENTRAL : INPUT_DISTRIBUTED;
  id->icntl[ICNTL_SCHUR - 1] = schur ? SCHUR_ON_HOST : 0;
  PetscCall(FactorizationSetControls_Private(factor->comm, prefix, id));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FactorizationCreate(Mat A, PetscInt num, const PetscInt C[], const char prefix[], PetscScalar S[],
                                   Factorization *factor_out, MatFactorError *error)
{
  Factorization   factor;
  DMUMPS_STRUC_C *id;
  Vec             v;

  PetscFunctionBeginUser;
  PetscCall(FactorizationBegin_Private(A, PETSC_TRUE, prefix, factor_out));
  factor = *factor_out;
  id     = &factor->id;
  PetscCall(MatCreateVecs(A, &v, NULL));
  PetscCall(VecScatterCreateToZero(v, &factor->to_host, &factor->host));
  PetscCall(VecDestroy(&v));
  PetscCall(FactorizationAnalyse_Private(factor, A, num, C));
  id->schur = S;
  ThreadsAllow((PetscBool)(factor->size == 1 && id->rinfog[0] >= MANY_OPERATIONS));
  if (id->infog[0] >= 0) PetscCall(FactorizationCompute_Private(factor));
  ThreadsAllow(PETSC_FALSE);
  PetscCall(PetscInfo(A, "MUMPS: status %d (%d), order %d, %g operations, %d MB\n", (int)id->infog[0],
                      (int)id->infog[1], (int)id->infog[6], (double)id->rinfog[0], (int)id->infog[18]));
  PetscCall(FactorizationFreeMatrix_Private(factor));
  PetscCall(FactorizationCheckInfo(factor->comm, id->infog[0]));
  *error = FactorizationError_Private(id->infog[0]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

void FactorizationFillSchur(PetscInt num, PetscScalar S[])
{
  PetscInt lower = 0, upper = 0;

  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt j = 0; j < i; j++) {
      lower += S[i * num + j] != 0;
      upper += S[j * num + i] != 0;
    }
  }
  for (PetscInt i = 0; i < num; i++)
    for (PetscInt j = 0; j < i; j++) S[i * num + j] = S[j * num + i] = lower >= upper ? S[i * num + j] : S[j * num + i];
}

PetscErrorCode FactorizationPredict(Mat A, PetscInt num, const PetscInt C[], const char prefix[],
                                    FactorizationCost *cost)
{
  const PetscReal megabyte = 1e6;
  Factorization   factor;
  DMUMPS_STRUC_C *id;

  PetscFunctionBeginUser;
  PetscCall(FactorizationBegin_Private(A, (PetscBool)(num > 0), prefix, &factor));
  id = &factor->id;
  PetscCall(FactorizationAnalyse_Private(factor, A, num, C));
  PetscCall(FactorizationFreeMatrix_Private(factor));
  PetscCall(FactorizationCheckInfo(factor->comm, id->infog[0]));
  cost->known      = (PetscBool)(id->infog[0] >= 0);
  cost->operations = id->rinfog[0];
  cost->bytes      = megabyte * (PetscReal)id->info[ANALYSED_SIZE - 1];
  if (!factor->rank) cost->bytes += (PetscReal)num * (PetscReal)num * (PetscReal)sizeof(PetscScalar);
  PetscCall(PetscInfo(A, "MUMPS predicts: status %d, %g operations, %g bytes on this rank\n", (int)id->infog[0],
                      (double)cost->operations, (double)cost->bytes));
  PetscCall(FactorizationDestroy(&factor));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FactorizationSolve(Factorization factor, Vec b, Vec x)
{
  DMUMPS_STRUC_C *id = &factor->id;

  PetscFunctionBeginUser;
  PetscCall(VecScatterBegin(factor->to_host, b, factor->host, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(factor->to_host, b, factor->host, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArray(factor->host, &id->rhs));
  id->job                      = JOB_SOLVE;
  id->icntl[ICNTL_REDUCED - 1] = 0; /* the unknowns of S come out as 0 */
  dmumps_c(id);
  PetscCall(VecRestoreArray(factor->host, &id->rhs));
  PetscCall(FactorizationCheckInfo(factor->comm, id->infog[0]));
  PetscCheck(id->infog[0] >= 0, factor->comm, PETSC_ERR_LIB, "MUMPS could not solve: INFOG(1) = %d, INFOG(2) = %d",
             (int)id->infog[0], (int)id->infog[1]);
  PetscCall(VecScatterBegin(factor->to_host, factor->host, x, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(factor->to_host, factor->host, x, INSERT_VALUES, SCATTER_REVERSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FactorizationDestroy(Factorization *factor)
{
  PetscFunctionBeginUser;
  if (!*factor) PetscFunctionReturn(PETSC_SUCCESS);
  (*factor)->id.job = JOB_END;
  dmumps_c(&(*factor)->id);
  PetscCall(VecScatterDestroy(&(*factor)->to_host));
  PetscCall(VecDestroy(&(*factor)->host));
  PetscCall(PetscFree(*factor));
  PetscFunctionReturn(PETSC_SUCCESS);
}
