/* envelopefactor.c -- see the header.

   Factors of the matrix without active unknowns are composed with it. Matrices of active sets have a
   reference to it, since PETSc gives their PC nothing but them. */
#include "base/compat.h"
#include "base/gather.h"
#include "multigrid/dealtrows.h"
#include "multigrid/envelopefactor.h"
#include "multigrid/graphcomponents.h"

/* Root mean square of the widths of rows up to which an envelope costs less than a sparse factor. */
static const PetscReal MAX_WIDTH = 400;

/* Names under which blocks and factors, and the matrix that keeps them, are composed with a matrix. */
static const char KEPT[] = "MortiseEnvelopeKept", BASE[] = "MortiseEnvelopeBase";

/* What a matrix keeps. */
typedef struct {
  PetscInt       bs;
  PetscReal     *label; /* [rows / bs] */
  EnvelopeParts *parts;
  PetscBool      wide; /* whether they are not worth it */
} Kept;

typedef struct {
  EnvelopeParts *parts;
  PetscBool      fresh; /* made before PETSc sets up the PC */
} Envelope;

static PetscErrorCode KeptDestroy_Private(ContainerArgument argument)
{
  Kept *kept = ContainerArgumentGet(argument);

  PetscFunctionBeginUser;
  PetscCall(EnvelopePartsDestroy(&kept->parts));
  PetscCall(PetscFree(kept->label));
  PetscCall(PetscFree(kept));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What S keeps, or NULL. */
static PetscErrorCode KeptGet_Private(Mat S, Kept **kept)
{
  PetscContainer container = NULL;

  PetscFunctionBeginUser;
  *kept = NULL;
  if (S) PetscCall(PetscObjectQuery((PetscObject)S, KEPT, (PetscObject *)&container));
  if (container) PetscCall(PetscContainerGetPointer(container, (void **)kept));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode RowsGet_Private(Mat S, EnvelopeRows *rows)
{
  PetscBool done;

  PetscFunctionBeginUser;
  PetscCall(MatGetRowIJ(S, 0, PETSC_FALSE, PETSC_FALSE, &rows->n, &rows->start, &rows->column, &done));
  PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A matrix without rows");
  PetscCall(MatSeqAIJGetArrayRead(S, &rows->value));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode RowsRestore_Private(Mat S, EnvelopeRows *rows)
{
  PetscBool done;

  PetscFunctionBeginUser;
  PetscCall(MatSeqAIJRestoreArrayRead(S, &rows->value));
  PetscCall(MatRestoreRowIJ(S, 0, PETSC_FALSE, PETSC_FALSE, &rows->n, &rows->start, &rows->column, &done));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in] kept - blocks; [in] base - the matrix with its factors, or NULL; [in] limited - whether the width is
   limited; [out] parts - NULL if it is exceeded */
static PetscErrorCode EnvelopeFactorCreate_Private(Mat S, const Kept *kept, Mat base, PetscBool limited,
                                                   EnvelopeParts **parts)
{
  const EnvelopeParts *from = base ? kept->parts : NULL;
  EnvelopeRows         own, others;

  PetscFunctionBeginUser;
  PetscCall(RowsGet_Private(S, &own));
  if (from) PetscCall(RowsGet_Private(base, &others));
  PetscCall(EnvelopePartsCreate(&own, kept->bs, kept->label, from ? &others : NULL, from, parts));
  if (limited && EnvelopePartsWork(*parts) > MAX_WIDTH * MAX_WIDTH * own.n)
    PetscCall(EnvelopePartsDestroy(parts));
  else
    PetscCall(EnvelopePartsFactor(&own, *parts));
  if (from) PetscCall(RowsRestore_Private(base, &others));
  PetscCall(RowsRestore_Private(S, &own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether S is the matrix that keeps factors, as before the first active set. */
static PetscErrorCode EnvelopeFactorTestSame_Private(Mat S, Mat base, PetscBool *same)
{
  EnvelopeRows own, others;

  PetscFunctionBeginUser;
  PetscCall(RowsGet_Private(S, &own));
  PetscCall(RowsGet_Private(base, &others));
  PetscCall(PetscArraycmp(own.start, others.start, own.n + 1, same));
  if (*same) PetscCall(PetscArraycmp(own.column, others.column, own.start[own.n], same));
  if (*same) PetscCall(PetscArraycmp(own.value, others.value, own.start[own.n], same));
  PetscCall(RowsRestore_Private(base, &others));
  PetscCall(RowsRestore_Private(S, &own));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Factors of S, kept if S keeps them.
   [out] parts - NULL where there are no blocks, or the width is exceeded */
static PetscErrorCode EnvelopeFactorProvide_Private(Mat S, PetscBool limited, EnvelopeParts **parts)
{
  Kept     *own, *kept;
  PetscBool same;
  Mat       base = NULL;

  PetscFunctionBeginUser;
  *parts = NULL;
  PetscCall(KeptGet_Private(S, &own));
  if (!own) PetscCall(PetscObjectQuery((PetscObject)S, BASE, (PetscObject *)&base));
  PetscCall(KeptGet_Private(own ? S : base, &kept));
  if (!kept || kept->wide) PetscFunctionReturn(PETSC_SUCCESS);
  same = (PetscBool)(own && own->parts);
  if (!own && kept->parts) PetscCall(EnvelopeFactorTestSame_Private(S, base, &same));
  if (!same) PetscCall(EnvelopeFactorCreate_Private(S, kept, base, limited, parts));
  if (same) *parts = kept->parts;
  if (!same && own) own->parts = *parts;
  if (own) own->wide = (PetscBool) !*parts;
  if ((same || own) && *parts) (*parts)->references++;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SetUp_Envelope(PC pc)
{
  Envelope *envelope;
  Mat       S;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &envelope));
  if (!envelope->fresh) {
    PetscCall(EnvelopePartsDestroy(&envelope->parts));
    PetscCall(PCGetOperators(pc, NULL, &S));
    PetscCall(EnvelopeFactorProvide_Private(S, PETSC_FALSE, &envelope->parts));
  }
  envelope->fresh = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Apply_Envelope(PC pc, Vec r, Vec z)
{
  Envelope          *envelope;
  const PetscScalar *ra;
  PetscScalar       *za;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &envelope));
  PetscCall(VecGetArrayRead(r, &ra));
  PetscCall(VecGetArrayWrite(z, &za));
  EnvelopePartsSolve(envelope->parts, ra, za);
  PetscCall(VecRestoreArrayWrite(z, &za));
  PetscCall(VecRestoreArrayRead(r, &ra));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy_Envelope(PC pc)
{
  Envelope *envelope;

  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(pc, &envelope));
  PetscCall(EnvelopePartsDestroy(&envelope->parts));
  PetscCall(PetscFree(envelope));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeFactorSetPC(PC pc, Mat S, PetscBool *done)
{
  Envelope      *envelope;
  EnvelopeParts *parts;

  PetscFunctionBeginUser;
  PetscCall(EnvelopeFactorProvide_Private(S, PETSC_TRUE, &parts));
  *done = (PetscBool)(parts != NULL);
  if (!parts) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscNew(&envelope));
  *envelope = (Envelope){.parts = parts, .fresh = PETSC_TRUE};
  PetscCall(PCSetType(pc, PCSHELL));
  PetscCall(PCShellSetContext(pc, envelope));
  PetscCall(PCShellSetSetUp(pc, SetUp_Envelope));
  PetscCall(PCShellSetApply(pc, Apply_Envelope));
  PetscCall(PCShellSetDestroy(pc, Destroy_Envelope));
  PetscCall(PCSetUp(pc)); // for S as it is
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeFactorKeep(Mat S, PetscInt bs, const PetscReal label[])
{
  PetscInt       n;
  Kept          *kept;
  PetscContainer container;

  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(S, &n, NULL));
  PetscCall(PetscNew(&kept));
  kept->bs = bs;
  PetscCall(PetscMalloc1(n / bs, &kept->label));
  PetscCall(PetscArraycpy(kept->label, label, n / bs));
  PetscCall(PetscContainerCreate(PETSC_COMM_SELF, &container));
  PetscCall(PetscContainerSetPointer(container, kept));
  PetscCall(PetscContainerSetCtxDestroy(container, KeptDestroy_Private));
  PetscCall(PetscObjectCompose((PetscObject)S, KEPT, (PetscObject)container));
  PetscCall(PetscContainerDestroy(&container));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeFactorKeepLike(Mat S, Mat other)
{
  Kept *kept;

  PetscFunctionBeginUser;
  PetscCall(KeptGet_Private(other, &kept));
  if (kept) PetscCall(EnvelopeFactorKeep(S, kept->bs, kept->label));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeFactorKeepRows(Mat S, IS rows, Mat own)
{
  PetscInt           n, num;
  PetscScalar       *label;
  const PetscInt    *row;
  const PetscScalar *labels;
  Kept              *kept;
  Mat                base;
  Vec                all, some;

  PetscFunctionBeginUser;
  PetscCall(EnvelopeFactorGetBase(S, &base));
  PetscCall(KeptGet_Private(base, &kept));
  if (!kept) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatCreateVecs(S, NULL, &all));
  PetscCall(VecGetLocalSize(all, &n));
  PetscCall(VecGetArrayWrite(all, &label));
  for (PetscInt i = 0; i < n; i++) label[i] = kept->label[i / kept->bs];
  PetscCall(VecRestoreArrayWrite(all, &label));
  PetscCall(ISGetLocalSize(rows, &num));
  PetscCall(ISGetIndices(rows, &row));
  PetscCall(GatherEntries(all, num, row, &some));
  PetscCall(ISRestoreIndices(rows, &row));
  PetscCall(VecGetArrayRead(some, &labels));
  PetscCall(EnvelopeFactorKeep(own, 1, labels));
  PetscCall(VecRestoreArrayRead(some, &labels));
  PetscCall(VecDestroy(&some));
  PetscCall(VecDestroy(&all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The rows of some blocks of rows. */
static PetscErrorCode EnvelopeFactorListRows_Private(IS blocks, PetscInt bs, IS *rows)
{
  PetscInt        num, *list;
  const PetscInt *block;

  PetscFunctionBeginUser;
  PetscCall(ISGetLocalSize(blocks, &num));
  PetscCall(ISGetIndices(blocks, &block));
  PetscCall(PetscMalloc1(num * bs, &list));
  for (PetscInt i = 0; i < num * bs; i++) list[i] = bs * block[i / bs] + i % bs;
  PetscCall(ISRestoreIndices(blocks, &block));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, num * bs, list, PETSC_OWN_POINTER, rows));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeFactorDeal(Mat S, IS *rows, Mat *own)
{
  PetscInt n;
  Kept    *kept;
  Vec      one; /* value for each label */
  IS       blocks;

  PetscFunctionBeginUser;
  PetscCall(KeptGet_Private(S, &kept));
  PetscCall(MatGetLocalSize(S, &n, NULL));
  PetscCall(VecCreateMPI(PetscObjectComm((PetscObject)S), n / kept->bs, PETSC_DETERMINE, &one));
  PetscCall(GraphComponentsDeal(one, kept->label, &blocks));
  PetscCall(EnvelopeFactorListRows_Private(blocks, kept->bs, rows));
  PetscCall(DealtRowsCreate(S, *rows, *rows, own));
  PetscCall(EnvelopeFactorKeepRows(S, *rows, *own));
  PetscCall(ISDestroy(&blocks));
  PetscCall(VecDestroy(&one));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeFactorGet(Mat S, EnvelopeParts **parts)
{
  PetscFunctionBeginUser;
  PetscCall(EnvelopeFactorProvide_Private(S, PETSC_TRUE, parts));
  if (*parts) (*parts)->references--; // S has another one
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeFactorSetBase(Mat S, Mat from)
{
  PetscFunctionBeginUser;
  PetscCall(PetscObjectCompose((PetscObject)S, BASE, (PetscObject)from));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeFactorGetBase(Mat S, Mat *base)
{
  Kept *kept;

  PetscFunctionBeginUser;
  PetscCall(KeptGet_Private(S, &kept));
  *base = S;
  if (!kept) PetscCall(PetscObjectQuery((PetscObject)S, BASE, (PetscObject *)base));
  PetscCall(KeptGet_Private(*base, &kept));
  if (!kept) *base = NULL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeFactorScale(Mat S, PetscReal factor)
{
  Kept *kept;

  PetscFunctionBeginUser;
  PetscCall(KeptGet_Private(S, &kept));
  if (!kept || !kept->parts) PetscFunctionReturn(PETSC_SUCCESS);
  EnvelopePartsScale(factor, kept->parts);
  PetscFunctionReturn(PETSC_SUCCESS);
}
