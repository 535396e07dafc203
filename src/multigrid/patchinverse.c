/* patchinverse.c -- see the header.

   Products with inverses take most of the time of a smoother in patches. Single precision halves what they
   read, and registers take eight numbers at once. The whole square is stored, in panels of eight rows, column
   by column: half of it would need sums across a register.

   Cells that are translations of each other have the same matrix. Its inverse is stored once and then lies in
   the cache. Nanoseconds of a product: upper triangle in double precision, square in single, and the same for
   patches with one inverse, on a busy AMD EPYC: 8 unknowns 56, 31, 11; 24 unknowns 420, 300, 36; 81 unknowns
   6000, 3600, 450. */
#include "base/compat.h"
#include "kernel/wide.h"
#include "multigrid/patchinverse.h"
#include <petscblaslapack.h>

enum { PANEL = 8 };
/* Matrices that are compared. Boxes have one for nearly all patches. */
enum { NUM_SLOTS = 64 };
/* Largest difference between entries of equal matrices, whose diagonal is 1. */
static const PetscReal SAME_ENTRY = 1e-10;
/* Steps by which entries are rounded for the hash. */
static const PetscReal HASH_STEPS = 1 << 20;
/* Error of an inverse by rounding to single precision up to which it is stored so: a tenth of the least
   eigenvalue, which is about 1/5 (cells in space). */
static const PetscReal MAX_ROUNDING = 1e-2;
/* Rounding of a number in single precision. */
static const PetscReal SINGLE_ROUNDING = 6e-8;

struct _n_PatchInverse {
  PetscInt   references, num;
  float     *fp32; /* panels of rows, each by columns [panels][columns][PANEL]; NULL with fp64 */
  PetscReal *fp64; /* [num][num] */
};

struct _n_PatchInverses {
  PetscInt     largest;
  PetscInt     num[NUM_SLOTS];
  PetscReal   *matrix[NUM_SLOTS];
  PatchInverse inverse[NUM_SLOTS];
};

static PetscInt PatchInversePanels_Private(PetscInt num)
{
  return (num + PANEL - 1) / PANEL;
}

/* Columns with the one that makes their number even. */
static PetscInt PatchInverseColumns_Private(PetscInt num)
{
  return num + num % 2;
}

PetscErrorCode PatchInversesCreate(PetscInt largest, PatchInverses *inverses)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(inverses));
  (*inverses)->largest = largest;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PatchInversesDestroy(PatchInverses *inverses)
{
  PetscFunctionBeginUser;
  for (PetscInt s = 0; s < NUM_SLOTS; s++) {
    PetscCall(PetscFree((*inverses)->matrix[s]));
    PetscCall(PatchInverseDestroy(&(*inverses)->inverse[s]));
  }
  PetscCall(PetscFree(*inverses));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PatchInverseDestroy(PatchInverse *inverse)
{
  PetscFunctionBeginUser;
  if (!*inverse || --(*inverse)->references) {
    *inverse = NULL;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscFree((*inverse)->fp32));
  PetscCall(PetscFree((*inverse)->fp64));
  PetscCall(PetscFree(*inverse));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PatchInverse PatchInverseReference(PatchInverse inverse)
{
  inverse->references++;
  return inverse;
}

/* A number that equal matrices share, up to roundoff. */
static PetscInt PatchInversesHash_Private(PetscInt num, const PetscReal A[])
{
  uint64_t hash = (uint64_t)num; // products of unsigned numbers may exceed their range

  for (PetscInt i = 0; i < num; i++) hash = 31 * hash + (uint64_t)(PetscInt64)PetscFloorReal(A[i] * HASH_STEPS + 0.5);
  return (PetscInt)(hash % NUM_SLOTS);
}

static PetscBool PatchInversesAreSame_Private(PetscInt num, const PetscReal A[], const PetscReal B[])
{
  for (PetscInt i = 0; i < num * num; i++)
    if (PetscAbsReal(A[i] - B[i]) > SAME_ENTRY) return PETSC_FALSE;
  return PETSC_TRUE;
}

/* A := A^-1, or the inverse of its diagonal. [in] diag - of A, 0 at rows to be omitted */
static PetscErrorCode PatchInverseInvert_Private(PetscInt num, const PetscReal diag[], PetscReal A[])
{
  PetscBLASInt n, info;

  PetscFunctionBeginUser;
  PetscCall(PetscBLASIntCast(num, &n));
  for (PetscInt i = 0; i < num; i++)
    if (diag[i] == 0) A[i * num + i] = 1;
  PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &n, A, &n, &info)); // by columns: the upper half of rows
  if (!info) PetscCallBLAS("LAPACKpotri", LAPACKpotri_("L", &n, A, &n, &info));
  for (PetscInt i = 0; i < num; i++) {
    if (info) PetscCall(PetscArrayzero(&A[i * num + i], num - i));
    if (info && diag[i] > 0) A[i * num + i] = 1 / diag[i];
    if (diag[i] == 0) A[i * num + i] = 0;
    for (PetscInt j = i; j < num; j++) A[j * num + i] = A[i * num + j];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* [in] A - the inverse [num][num] */
static PetscErrorCode PatchInverseStore_Private(PetscInt num, const PetscReal A[], PatchInverse *inverse)
{
  const PetscInt columns = PatchInverseColumns_Private(num);
  PetscReal      largest = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(inverse));
  (*inverse)->references = 1;
  (*inverse)->num        = num;
  for (PetscInt i = 0; i < num * num; i++) largest = PetscMax(largest, PetscAbsReal(A[i]));
  if (largest * PetscSqrtReal((PetscReal)num) * SINGLE_ROUNDING > MAX_ROUNDING) {
    PetscCall(PetscMalloc1(num * num, &(*inverse)->fp64));
    PetscCall(PetscArraycpy((*inverse)->fp64, A, num * num));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscCalloc1(PANEL * PatchInversePanels_Private(num) * columns, &(*inverse)->fp32));
  for (PetscInt i = 0; i < num; i++)
    for (PetscInt j = 0; j < num; j++)
      (*inverse)->fp32[(i / PANEL * columns + j) * PANEL + i % PANEL] = (float)A[i * num + j];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode PatchInversesGet(PatchInverses inverses, PetscInt num, PetscReal A[], PatchInverse *inverse)
{
  const PetscInt slot = PatchInversesHash_Private(num, A);
  PatchInverse  *like = &inverses->inverse[slot];
  PetscReal     *diag;

  PetscFunctionBeginUser;
  if (!*like || inverses->num[slot] != num || !PatchInversesAreSame_Private(num, A, inverses->matrix[slot])) {
    if (!inverses->matrix[slot])
      PetscCall(PetscMalloc1(inverses->largest * inverses->largest, &inverses->matrix[slot]));
    PetscCall(PetscArraycpy(inverses->matrix[slot], A, num * num));
    inverses->num[slot] = num;
    PetscCall(PetscMalloc1(num, &diag));
    for (PetscInt i = 0; i < num; i++) diag[i] = A[i * num + i];
    PetscCall(PatchInverseInvert_Private(num, diag, A));
    PetscCall(PetscFree(diag));
    PetscCall(PatchInverseDestroy(like));
    PetscCall(PatchInverseStore_Private(num, A, like));
  }
  *inverse = PatchInverseReference(*like);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* y = A x by panels. Two columns at once: their sums do not wait for each other. */
static inline void PatchInverseMultiply_Private(PetscInt panels, PetscInt columns, const float *restrict a,
                                                const float *restrict x, float *restrict y)
{
  for (PetscInt p = 0; p < panels; p++) {
    float even[PANEL] = {0}, odd[PANEL] = {0};

    for (PetscInt j = 0; j < columns; j += 2) {
      for (PetscInt i = 0; i < PANEL; i++) even[i] += a[i] * x[j];
      for (PetscInt i = 0; i < PANEL; i++) odd[i] += a[PANEL + i] * x[j + 1];
      a += 2 * PANEL;
    }
    for (PetscInt i = 0; i < PANEL; i++) y[PANEL * p + i] = even[i] + odd[i];
  }
}

/* The same in double precision. */
static void PatchInverseMultiplyDouble_Private(const struct _n_PatchInverse *inverse, const PetscInt node[],
                                               PetscInt dim, const PetscReal r[], PetscReal z[])
{
  const PetscInt num = inverse->num;

  for (PetscInt i = 0; i < num; i++) {
    PetscReal sum = 0;

    for (PetscInt j = 0; j < num; j++) sum += inverse->fp64[i * num + j] * r[dim * node[j / dim] + j % dim];
    z[dim * node[i / dim] + i % dim] += sum;
  }
}

PetscInt PatchInverseWork(PetscInt num)
{
  return PatchInverseColumns_Private(num) + PANEL * PatchInversePanels_Private(num);
}

MORTISE_WIDE void PatchInverseAdd(const GraphPatches *patches, const PatchInverse inverse[], PetscInt dim,
                                  const PetscReal r[], PetscReal z[], float work[])
{
  for (PetscInt p = 0; p < patches->num; p++) {
    const struct _n_PatchInverse *own   = inverse[p];
    const PetscInt               *nodes = &patches->node[patches->start[p]], n = own->num / dim;
    float                        *x = work, *y = &work[PatchInverseColumns_Private(own->num)];

    if (own->fp64) {
      PatchInverseMultiplyDouble_Private(own, nodes, dim, r, z);
      continue;
    }
    y[-1] = 0; // of the column that is none
    for (PetscInt i = 0; i < n; i++)
      for (PetscInt k = 0; k < dim; k++) x[dim * i + k] = (float)r[dim * nodes[i] + k];
    PatchInverseMultiply_Private(PatchInversePanels_Private(own->num), PatchInverseColumns_Private(own->num), own->fp32,
                                 x, y);
    for (PetscInt i = 0; i < n; i++)
      for (PetscInt k = 0; k < dim; k++) z[dim * nodes[i] + k] += (PetscReal)y[dim * i + k];
  }
}
