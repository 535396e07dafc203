/* dealtfactor.c -- see the header.

   Rows that entries connect go to one rank. Matrices of active sets have the same rows on each rank as their
   base: then most blocks keep their factors, as on one process. A set that connects rows of two ranks deals
   those of the base anew. */
#include "base/compat.h"
#include "multigrid/dealtfactor.h"
#include "multigrid/dealtrows.h"
#include "multigrid/envelopefactor.h"
#include "multigrid/ghostexchange.h"
#include "multigrid/graphcomponents.h"

/* Name under which rows are composed with the matrix that has them, and name of the PC. */
static const char DEAL[] = "MortiseDeal", NAME[] = "blocks of each rank";

/* Which rank has which rows. */
typedef struct {
  IS         rows;    /* of this rank, ascending */
  VecScatter scatter; /* from all rows to these */
  PetscReal *rank;    /* [rows of S on this rank] */
  Mat        own;     /* these rows of S */
} Deal;

typedef struct {
  VecScatter           scatter;
  Vec                  r, z; /* in the rows of this rank */
  PC                   inner;
  DealtFactorConfigure configure; /* NULL once inner has a type */
  Mat                  base;      /* keeps the factors of blocks that have not changed, or NULL */
} DealtFactor;

static PetscErrorCode DealDestroy_Private(ContainerArgument argument)
{
  Deal *deal = ContainerArgumentGet(argument);

  PetscFunctionBeginUser;
  PetscCall(ISDestroy(&deal->rows));
  PetscCall(VecScatterDestroy(&deal->scatter));
  PetscCall(PetscFree(deal->rank));
  PetscCall(MatDestroy(&deal->own));
  PetscCall(PetscFree(deal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The deal of S, or NULL. */
static PetscErrorCode DealGet_Private(Mat S, Deal **deal)
{
  PetscContainer container = NULL;

  PetscFunctionBeginUser;
  *deal = NULL;
  if (S) PetscCall(PetscObjectQuery((PetscObject)S, DEAL, (PetscObject *)&container));
  if (container) PetscCall(PetscContainerGetPointer(container, (void **)deal));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Rows and columns of S. */
static PetscErrorCode DealGetRows_Private(const Deal *deal, Mat S, Mat *own)
{
  PetscFunctionBeginUser;
  PetscCall(DealtRowsCreate(S, deal->rows, deal->rows, own));
  PetscCall(MatSetOption(*own, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rank of each row of S on this rank. */
static PetscErrorCode DealSetRanks_Private(Mat S, Deal *deal)
{
  PetscMPIInt        me;
  PetscInt           n, num;
  const PetscScalar *ranks;
  Vec                all, some;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PetscObjectComm((PetscObject)S), &me));
  PetscCall(ISGetLocalSize(deal->rows, &num));
  PetscCall(MatCreateVecs(S, &all, NULL));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, num, &some));
  PetscCall(VecSet(some, me));
  PetscCall(VecScatterCreate(all, deal->rows, some, NULL, &deal->scatter));
  PetscCall(VecScatterBegin(deal->scatter, some, all, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(deal->scatter, some, all, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecGetLocalSize(all, &n));
  PetscCall(PetscMalloc1(n, &deal->rank));
  PetscCall(VecGetArrayRead(all, &ranks));
  for (PetscInt i = 0; i < n; i++) deal->rank[i] = PetscRealPart(ranks[i]);
  PetscCall(VecRestoreArrayRead(all, &ranks));
  PetscCall(VecDestroy(&all));
  PetscCall(VecDestroy(&some));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Deals the rows of S, which keeps them. [in] graph - connects rows of one rank */
static PetscErrorCode DealCreate_Private(Mat S, Mat graph, Deal **deal)
{
  PetscContainer container;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(deal));
  PetscCall(GraphComponentsGather(graph, &(*deal)->rows));
  PetscCall(DealSetRanks_Private(S, *deal));
  PetscCall(DealGetRows_Private(*deal, S, &(*deal)->own));
  PetscCall(EnvelopeFactorKeepRows(S, (*deal)->rows, (*deal)->own));
  PetscCall(PetscContainerCreate(PETSC_COMM_SELF, &container));
  PetscCall(PetscContainerSetPointer(container, *deal));
  PetscCall(PetscContainerSetCtxDestroy(container, DealDestroy_Private));
  PetscCall(PetscObjectCompose((PetscObject)S, DEAL, (PetscObject)container));
  PetscCall(PetscContainerDestroy(&container));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether entries of a part of S connect rows of one rank alone. [in] rank - of the rows; [in] others - of
   the columns */
static PetscErrorCode DealTestPart_Private(Mat part, const PetscReal rank[], const PetscReal others[], PetscBool *holds)
{
  PetscInt           n;
  PetscBool          done;
  const PetscInt    *start, *column;
  const PetscScalar *value;

  PetscFunctionBeginUser;
  PetscCall(MatGetRowIJ(part, 0, PETSC_FALSE, PETSC_FALSE, &n, &start, &column, &done));
  PetscCall(MatSeqAIJGetArrayRead(part, &value));
  for (PetscInt i = 0; i < n; i++)
    for (PetscInt k = start[i]; k < start[i + 1]; k++)
      if (rank[i] != others[column[k]] && value[k] != 0) *holds = PETSC_FALSE;
  PetscCall(MatSeqAIJRestoreArrayRead(part, &value));
  PetscCall(MatRestoreRowIJ(part, 0, PETSC_FALSE, PETSC_FALSE, &n, &start, &column, &done));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether S connects no rows of two ranks. */
static PetscErrorCode DealHolds_Private(const Deal *deal, Mat S, PetscBool *holds)
{
  PetscReal      *rank;
  Mat             own, others;
  const PetscInt *columns;
  GhostExchange   ghosts;

  PetscFunctionBeginUser;
  *holds = PETSC_TRUE;
  PetscCall(GhostExchangeCreate(S, 1, &ghosts));
  PetscCall(PetscMalloc1(ghosts.n + ghosts.num, &rank));
  PetscCall(PetscArraycpy(rank, deal->rank, ghosts.n));
  PetscCall(GhostExchangeUpdate(&ghosts, rank));
  PetscCall(MatMPIAIJGetSeqAIJ(S, &own, &others, &columns));
  PetscCall(DealTestPart_Private(own, rank, rank, holds));
  PetscCall(DealTestPart_Private(others, rank, &rank[ghosts.n], holds));
  PetscCall(PetscFree(rank));
  PetscCall(GhostExchangeDestroy(&ghosts));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, holds, 1, MPIU_BOOL, MPI_LAND, PetscObjectComm((PetscObject)S)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Deals the rows of the base of S so that S connects none of two ranks. [out] deal - in the place of the one
   before */
static PetscErrorCode DealRenew_Private(Mat S, Mat base, Deal **deal)
{
  Mat both;

  PetscFunctionBeginUser;
  PetscCall(MatDuplicate(S, MAT_COPY_VALUES, &both));
  PetscCall(MatAXPY(both, 1, base, DIFFERENT_NONZERO_PATTERN));
  PetscCall(DealCreate_Private(base, both, deal));
  PetscCall(MatDestroy(&both));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rows of this rank, and S there. [out] deal - borrowed; [out] own - owned by the caller */
static PetscErrorCode DealProvide_Private(Mat S, Deal **deal, Mat *own)
{
  PetscBool same = PETSC_TRUE, holds = PETSC_TRUE;
  Mat       base;

  PetscFunctionBeginUser;
  PetscCall(EnvelopeFactorGetBase(S, &base));
  PetscCall(DealGet_Private(base, deal));
  if (!*deal) PetscCall(DealCreate_Private(base ? base : S, base ? base : S, deal));
  if (base && base != S) PetscCall(MatEqual(S, base, &same));
  if (!same) PetscCall(DealHolds_Private(*deal, S, &holds));
  if (!holds) PetscCall(DealRenew_Private(S, base, deal));
  if (same) {
    PetscCall(PetscObjectReference((PetscObject)(*deal)->own));
    *own = (*deal)->own;
  } else {
    PetscCall(DealGetRows_Private(*deal, S, own));
    PetscCall(EnvelopeFactorSetBase(*own, (*deal)->own));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* No other rank waits for this one here. */
static PetscErrorCode SetUp_DealtFactor(PC pc)
{
  DealtFactor   *dealt;
  EnvelopeParts *parts;
  PCFailedReason failed;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &dealt));
  if (dealt->base) PetscCall(EnvelopeFactorGet(dealt->base, &parts)); // none yet if rows were dealt anew
  if (dealt->configure) PetscCall(dealt->configure(dealt->inner));
  dealt->configure = NULL;
  PetscCall(PCSetUp(dealt->inner));
  PetscCall(PCGetFailedReason(dealt->inner, &failed));
  PetscCall(PCSetFailedReason(pc, failed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Apply_DealtFactor(PC pc, Vec r, Vec z)
{
  DealtFactor *dealt;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &dealt));
  PetscCall(VecScatterBegin(dealt->scatter, r, dealt->r, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(dealt->scatter, r, dealt->r, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(PCApply(dealt->inner, dealt->r, dealt->z));
  PetscCall(VecScatterBegin(dealt->scatter, dealt->z, z, INSERT_VALUES, SCATTER_REVERSE));
  PetscCall(VecScatterEnd(dealt->scatter, dealt->z, z, INSERT_VALUES, SCATTER_REVERSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_DealtFactor(PC pc)
{
  DealtFactor *dealt;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &dealt));
  PetscCall(VecScatterDestroy(&dealt->scatter));
  PetscCall(VecDestroy(&dealt->r));
  PetscCall(VecDestroy(&dealt->z));
  PetscCall(PCDestroy(&dealt->inner));
  PetscCall(MatDestroy(&dealt->base));
  PetscCall(PetscFree(dealt));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode DealtFactorSetPC(PC pc, Mat S, DealtFactorConfigure configure)
{
  Deal        *deal;
  DealtFactor *dealt;
  Mat          own;

  PetscFunctionBeginUser;
  PetscCall(DealProvide_Private(S, &deal, &own));
  PetscCall(PetscNew(&dealt));
  PetscCall(PetscObjectReference((PetscObject)deal->scatter));
  dealt->scatter   = deal->scatter;
  dealt->configure = configure;
  if (own != deal->own) {
    PetscCall(PetscObjectReference((PetscObject)deal->own));
    dealt->base = deal->own;
  }
  PetscCall(MatCreateVecs(own, &dealt->z, &dealt->r));
  PetscCall(PCCreate(PETSC_COMM_SELF, &dealt->inner));
  PetscCall(PCSetOperators(dealt->inner, own, own));
  PetscCall(MatDestroy(&own));
  PetscCall(PCSetType(pc, PCNONE)); // destroys a factor from before
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetName(pc, NAME));
  PetscCall(PCShellSetContext(pc, dealt));
  PetscCall(PCShellSetSetUp(pc, SetUp_DealtFactor));
  PetscCall(PCShellSetApply(pc, Apply_DealtFactor));
  PetscCall(PCShellSetDestroy(pc, Destroy_DealtFactor));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode DealtFactorIs(PC pc, PetscBool *dealt)
{
  const char *name = NULL;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCSHELL, dealt));
  if (*dealt) PetscCall(PCShellGetName(pc, &name));
  if (*dealt) PetscCall(PetscStrcmp(name, NAME, dealt));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode DealtFactorScale(Mat S, PetscReal factor)
{
  Deal *deal;

  PetscFunctionBeginUser;
  PetscCall(DealGet_Private(S, &deal));
  if (!deal) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatScale(deal->own, factor));
  PetscCall(EnvelopeFactorScale(deal->own, factor));
  PetscFunctionReturn(PETSC_SUCCESS);
}
