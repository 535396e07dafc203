/* envelopecompliance.c -- see the header.

   With A = L L' in each block, the part of a block in G is Y'Y, Y = L^-1 X' for the combinations that have
   entries in it. */
#include "base/compat.h"
#include <petscblaslapack.h>
#include "multigrid/envelopecompliance.h"

typedef struct {
  const EnvelopeParts *parts;
  Mat                  columns;   /* X' in rows of A */
  PetscInt            *mark;      /* of combinations: number in the block [rows of X] */
  PetscInt             num, *row; /* combinations with entries in some rows of A [num] */
  PetscReal           *sum;       /* [rows of X] */
  PetscInt64           entries;
  PetscInt            *i, *j;
  PetscScalar         *v; /* of G, to be summed up [entries] */
} Compliance;

/* Lists the combinations with entries in rows of A. */
static PetscErrorCode ComplianceList_Private(Compliance *c, PetscInt num, const PetscInt row[])
{
  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < c->num; k++) c->mark[c->row[k]] = -1;
  c->num = 0;
  for (PetscInt i = 0; i < num; i++) {
    PetscInt        n;
    const PetscInt *columns;

    PetscCall(MatGetRow(c->columns, row[i], &n, &columns, NULL));
    for (PetscInt k = 0; k < n; k++) {
      if (c->mark[columns[k]] >= 0) continue;
      c->mark[columns[k]] = c->num;
      c->row[c->num++]    = columns[k];
    }
    PetscCall(MatRestoreRow(c->columns, row[i], &n, &columns, NULL));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Blocks that X touches, entries of all their parts of G, and the work that these are. */
static PetscErrorCode ComplianceMeasure_Private(Compliance *c, PetscInt *num, PetscInt touched[], PetscReal *work)
{
  const EnvelopeParts *parts = c->parts;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < parts->num; b++) {
    const EnvelopeBlock *block = parts->block[b];
    const PetscReal      size  = (PetscReal)block->start[block->panels];

    PetscCall(ComplianceList_Private(c, block->num, block->row));
    if (!c->num) continue;
    touched[(*num)++] = b;
    c->entries += (PetscInt64)c->num * c->num;
    *work += c->num * (ENVELOPE_TILE * ENVELOPE_TILE * size + 0.5 * c->num * block->num);
  }
  for (PetscInt k = 0; k < parts->num_alone; k++) {
    PetscCall(ComplianceList_Private(c, 1, &parts->alone[k]));
    c->entries += (PetscInt64)c->num * c->num;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* X' in rows of A. [out] Y - of c->num combinations [c->num][size] */
static PetscErrorCode ComplianceGather_Private(const Compliance *c, PetscInt num, const PetscInt row[], PetscInt size,
                                               PetscReal Y[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(Y, (size_t)c->num * (size_t)size));
  for (PetscInt i = 0; i < num; i++) {
    PetscInt           n;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(c->columns, row[i], &n, &columns, &values));
    for (PetscInt k = 0; k < n; k++) Y[c->mark[columns[k]] * size + i] = PetscRealPart(values[k]);
    PetscCall(MatRestoreRow(c->columns, row[i], &n, &columns, &values));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Appends the part of rows of A to G, factor Y Y'. [in] size - of a row of Y; [in] Y - [c->num][size] */
static PetscErrorCode ComplianceAppend_Private(Compliance *c, PetscInt size, PetscReal factor, const PetscReal Y[])
{
  const PetscReal zero = 0;
  PetscBLASInt    num, length;

  PetscFunctionBeginUser;
  PetscCall(PetscBLASIntCast(c->num, &num));
  PetscCall(PetscBLASIntCast(size, &length));
  PetscCallBLAS("BLASgemm", BLASgemm_("T", "N", &num, &num, &length, &factor, Y, &length, Y, &length, &zero,
                                      &c->v[c->entries], &num));
  for (PetscInt a = 0; a < c->num; a++) {
    for (PetscInt b = 0; b < c->num; b++, c->entries++) {
      c->i[c->entries] = c->row[a];
      c->j[c->entries] = c->row[b];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The parts of all rows of A. [in] touched - [num] */
static PetscErrorCode ComplianceFill_Private(Compliance *c, PetscInt num, const PetscInt touched[])
{
  const EnvelopeParts *parts = c->parts;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(c->entries, &c->i, c->entries, &c->j, c->entries, &c->v));
  c->entries = 0;
  for (PetscInt t = 0; t < num; t++) {
    const EnvelopeBlock *block = parts->block[touched[t]];
    const PetscInt       size  = ENVELOPE_TILE * block->panels;
    PetscReal           *Y;

    PetscCall(ComplianceList_Private(c, block->num, block->row));
    PetscCall(PetscMalloc1((size_t)c->num * (size_t)size, &Y));
    PetscCall(ComplianceGather_Private(c, block->num, block->row, size, Y));
    for (PetscInt k = 0; k < c->num; k++) EnvelopeBlockForward(block, &Y[k * size]);
    PetscCall(ComplianceAppend_Private(c, size, 1 / parts->scale, Y));
    PetscCall(PetscFree(Y));
  }
  for (PetscInt k = 0; k < parts->num_alone; k++) {
    PetscCall(ComplianceList_Private(c, 1, &parts->alone[k]));
    if (!c->num) continue;
    PetscCall(ComplianceGather_Private(c, 1, &parts->alone[k], 1, c->sum));
    PetscCall(ComplianceAppend_Private(c, 1, parts->inverse[k], c->sum));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode EnvelopeComplianceCreate(const EnvelopeParts *parts, Mat X, Mat columns, PetscReal limit, PetscInt *num,
                                        PetscInt **touched, Mat *G)
{
  PetscInt   rows, own;
  PetscReal  work = 0;
  Compliance c    = {.parts = parts, .columns = columns};

  PetscFunctionBeginUser;
  *num = 0;
  *G   = NULL;
  PetscCall(MatGetSize(X, &rows, NULL));
  PetscCall(MatGetLocalSize(X, &own, NULL));
  PetscCall(PetscMalloc3(rows, &c.mark, rows, &c.row, rows, &c.sum));
  for (PetscInt k = 0; k < rows; k++) c.mark[k] = -1;
  PetscCall(PetscMalloc1(parts->num, touched));
  PetscCall(ComplianceMeasure_Private(&c, num, *touched, &work));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &work, 1, MPIU_REAL, MPI_SUM, PetscObjectComm((PetscObject)X)));
  if (work <= limit) {
    PetscCall(ComplianceFill_Private(&c, *num, *touched));
    PetscCall(MatCreate(PetscObjectComm((PetscObject)X), G));
    PetscCall(MatSetSizes(*G, own, own, rows, rows));
    PetscCall(MatSetType(*G, MATAIJ));
    PetscCall(MatSetPreallocationCOO(*G, c.entries, c.i, c.j));
    PetscCall(MatSetValuesCOO(*G, c.v, INSERT_VALUES));
    PetscCall(MatSetOption(*G, MAT_SPD, PETSC_TRUE));
    PetscCall(PetscFree3(c.i, c.j, c.v));
  }
  PetscCall(PetscFree3(c.mark, c.row, c.sum));
  PetscFunctionReturn(PETSC_SUCCESS);
}
