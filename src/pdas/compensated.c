/* compensated.c -- the compensated residual b - A y, as if computed in twice the precision.

   Near a solution the terms of b - A y cancel to the last digits: ordinary arithmetic leaves roundoff only.
   Here the roundoff of every product and sum is carried along [1]. Then corrections by a factorization
   converge to the solution itself, not just to a small residual. The error bound holds however small it is.

   References: [1] Ogita, Rump, Oishi, Accurate sum and dot product, 2005 (algorithm Dot2; Dekker's
   product). */
#include "base/compat.h"
#include "base/gather.h"
#include "pdas/pdasimpl.h"
#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#endif

/* Splits a number of 53 bits into two of 26: 2^27 + 1. */
static const PetscReal SPLITTER = 134217729.;

/* x = high + low, each with half the digits. */
static void CompensatedSplit_Private(PetscReal x, PetscReal *high, PetscReal *low)
{
  const PetscReal c = SPLITTER * x;

  *high = c - (c - x);
  *low  = x - *high;
}

/* (sum, rest) -= a y; rest collects what sum cannot hold. */
static void CompensatedSubtract_Private(PetscReal a, PetscReal y, PetscReal *sum, PetscReal *rest)
{
  const PetscReal product = -a * y;
  PetscReal       ah, al, yh, yl, error, next, part;

  CompensatedSplit_Private(-a, &ah, &al);
  CompensatedSplit_Private(y, &yh, &yl);
  error = al * yl - (((product - ah * yh) - al * yh) - ah * yl);
  next  = *sum + product;
  part  = next - *sum;
  *rest += ((*sum - (next - part)) + (product - part)) + error;
  *sum = next;
}

/* The same for a row of num numbers. */
static void CompensatedRow_Private(PetscInt num, const PetscScalar a[], const PetscInt columns[], const PetscScalar y[],
                                   PetscReal *sum, PetscReal *rest)
{
  for (PetscInt k = 0; k < num; k++)
    CompensatedSubtract_Private(PetscRealPart(a[k]), PetscRealPart(y[columns[k]]), sum, rest);
}

#if defined(__x86_64__) && defined(__GNUC__)
/* The same with AVX2: four sums side by side, and rounding errors of products by a fused multiplication. The
   first sum has what is there already. */
__attribute__((target("avx2,fma"))) static void CompensatedRow_AVX2(PetscInt num, const PetscScalar a[],
                                                                    const PetscInt columns[], const PetscScalar y[],
                                                                    PetscReal *sum, PetscReal *rest)
{
  enum { LANES = 4 };
  const PetscInt whole = num - num % LANES;
  PetscReal      sums[LANES], rests[LANES];
  __m256d        s = _mm256_set_pd(0, 0, 0, *sum), r = _mm256_set_pd(0, 0, 0, *rest);

  for (PetscInt k = 0; k < whole; k += LANES) {
    const PetscInt *c = &columns[k];
    const __m256d   v = _mm256_loadu_pd(&a[k]), x = _mm256_set_pd(y[c[3]], y[c[2]], y[c[1]], y[c[0]]);
    const __m256d   product = _mm256_mul_pd(v, x), error = _mm256_fmsub_pd(v, x, product);
    const __m256d   next = _mm256_sub_pd(s, product), part = _mm256_sub_pd(s, next);
    const __m256d   lost = _mm256_sub_pd(_mm256_sub_pd(s, _mm256_add_pd(next, part)), _mm256_sub_pd(product, part));

    r = _mm256_add_pd(r, _mm256_sub_pd(lost, error));
    s = next;
  }
  _mm256_storeu_pd(sums, s);
  _mm256_storeu_pd(rests, r);
  *sum  = sums[0];
  *rest = rests[0] + rests[1] + rests[2] + rests[3];
  for (PetscInt l = 1; l < LANES; l++) CompensatedSubtract_Private(-1, sums[l], sum, rest);
  CompensatedRow_Private(num - whole, &a[whole], &columns[whole], y, sum, rest);
}

static PetscBool CompensatedHasAVX2_Private(void)
{
  return (PetscBool)(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"));
}
#else
#define CompensatedRow_AVX2          CompensatedRow_Private
#define CompensatedHasAVX2_Private() PETSC_FALSE
#endif

/* (sum, rest)_i -= (A y)_i for all rows of a matrix on one process. [in] y - a value for each column */
static PetscErrorCode CompensatedRows_Private(Mat A, Vec y, PetscReal sum[], PetscReal rest[])
{
  const PetscBool    fused = CompensatedHasAVX2_Private();
  const PetscInt    *ia, *ja;
  const PetscScalar *values, *x;
  PetscInt           n;
  PetscBool          done;

  PetscFunctionBeginUser;
  PetscCall(MatGetRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &n, &ia, &ja, &done));
  PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_SUP, "matrix without rows");
  PetscCall(MatSeqAIJGetArrayRead(A, &values));
  PetscCall(VecGetArrayRead(y, &x));
  for (PetscInt i = 0; i < n; i++) {
    const PetscInt k = ia[i], num = ia[i + 1] - ia[i];

    if (fused)
      CompensatedRow_AVX2(num, &values[k], &ja[k], x, &sum[i], &rest[i]);
    else
      CompensatedRow_Private(num, &values[k], &ja[k], x, &sum[i], &rest[i]);
  }
  PetscCall(VecRestoreArrayRead(y, &x));
  PetscCall(MatSeqAIJRestoreArrayRead(A, &values));
  PetscCall(MatRestoreRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &n, &ia, &ja, &done));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CompensatedResidual(Mat A, Vec b, Vec y, Vec r)
{
  Mat             Ad = A, Ao = NULL;
  const PetscInt *columns;
  PetscBool       shell, sequential;
  PetscInt        n, num;
  PetscScalar    *sum;
  PetscReal      *rest;
  Vec             own, others;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)A, MATSHELL, &shell));
  if (shell) { // products alone: an iteration with them stops long before roundoff matters
    PetscCall(MatMult(A, y, r));
    PetscCall(VecAYPX(r, -1, b));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscObjectTypeCompare((PetscObject)A, MATSEQAIJ, &sequential));
  if (!sequential) PetscCall(MatMPIAIJGetSeqAIJ(A, &Ad, &Ao, &columns));
  PetscCall(VecGetLocalSize(r, &n));
  PetscCall(PetscCalloc1(n, &rest));
  PetscCall(VecCopy(b, r));
  PetscCall(VecGetArray(r, &sum));
  PetscCall(MatCreateVecs(Ad, &own, NULL));
  PetscCall(VecGetLocalVectorRead(y, own));
  PetscCall(CompensatedRows_Private(Ad, own, sum, rest));
  PetscCall(VecRestoreLocalVectorRead(y, own));
  PetscCall(VecDestroy(&own));
  if (Ao) {
    PetscCall(MatGetLocalSize(Ao, NULL, &num));
    PetscCall(GatherEntries(y, num, columns, &others));
    PetscCall(CompensatedRows_Private(Ao, others, sum, rest));
    PetscCall(VecDestroy(&others));
  }
  for (PetscInt i = 0; i < n; i++) sum[i] += rest[i];
  PetscCall(VecRestoreArray(r, &sum));
  PetscCall(PetscFree(rest));
  PetscFunctionReturn(PETSC_SUCCESS);
}
