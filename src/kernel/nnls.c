/* nnls.c -- the active set method of Lawson and Hanson.

   Weights of the present columns are those of the least squares problem without signs, by orthogonalisation.
   If a weight would be negative, the step ends at the first weight that becomes zero, and its column leaves.

   References: [1] Lawson, Hanson, Solving Least Squares Problems, 1974, algorithm NNLS (23.10). */
#include "base/compat.h"
#include "kernel/nnls.h"
#include "kernel/vector.h"

/* A column counts as a combination of the others if its part orthogonal to them is below this share of its
   length. */
static const PetscReal DEPENDENT_COLUMN = 1e-13;
/* Limit of steps per component, reached only in a cycle caused by roundoff: two or three are usual. */
enum { MAX_STEPS = 1000 };

PetscErrorCode NNLSCreate(PetscInt m, const PetscReal target[], NNLS *nnls)
{
  PetscFunctionBeginUser;
  nnls->m   = m;
  nnls->num = nnls->steps = 0;
  PetscCall(PetscMalloc6(m, &nnls->name, m * m, &nnls->column, m, &nnls->weight, m, &nnls->target, m, &nnls->residual,
                         2 * m * m + m, &nnls->work));
  for (PetscInt i = 0; i < m; i++) nnls->target[i] = nnls->residual[i] = target[i];
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NNLSDestroy(NNLS *nnls)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree6(nnls->name, nnls->column, nnls->weight, nnls->target, nnls->residual, nnls->work));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Best weights z without regard to signs: Gram and Schmidt, twice against rounding. Returns whether the
   columns are independent. [out] z - [num] */
static PetscBool NNLSLeastSquares_Private(const NNLS *nnls, PetscReal z[])
{
  const PetscInt m = nnls->m, num = nnls->num;
  PetscReal     *Q = nnls->work, *R = Q + m * m;

  for (PetscInt j = 0; j < num; j++) {
    PetscReal      *q      = &Q[j * m];
    const PetscReal before = VectorNorm(m, &nnls->column[j * m]);

    for (PetscInt i = 0; i < m; i++) q[i] = nnls->column[j * m + i];
    for (PetscInt k = 0; k < num; k++) R[j * m + k] = 0;
    for (int twice = 0; twice < 2; twice++) {
      for (PetscInt k = 0; k < j; k++) {
        const PetscReal part = VectorDot(m, &Q[k * m], q);

        R[j * m + k] += part;
        for (PetscInt i = 0; i < m; i++) q[i] -= part * Q[k * m + i];
      }
    }
    R[j * m + j] = VectorNorm(m, q);
    if (!(R[j * m + j] > DEPENDENT_COLUMN * before)) return PETSC_FALSE;
    for (PetscInt i = 0; i < m; i++) q[i] /= R[j * m + j];
  }
  for (PetscInt j = num - 1; j >= 0; j--) {
    z[j] = VectorDot(m, &Q[j * m], nnls->target);
    for (PetscInt k = j + 1; k < num; k++) z[j] -= R[k * m + j] * z[k];
    z[j] /= R[j * m + j];
  }
  return PETSC_TRUE;
}

/* Column j leaves; the last one takes its place. */
static void NNLSRemoveColumn_Private(NNLS *nnls, PetscInt j)
{
  const PetscInt last = --nnls->num;

  nnls->name[j]   = nnls->name[last];
  nnls->weight[j] = nnls->weight[last];
  for (PetscInt i = 0; i < nnls->m; i++) nnls->column[j * nnls->m + i] = nnls->column[last * nnls->m + i];
}

/* Towards z as far as no weight becomes negative, and without those that became zero. Returns whether z was
   reached. */
static PetscBool NNLSStepTowards_Private(NNLS *nnls, const PetscReal z[])
{
  PetscReal length = 1;
  PetscInt  first  = -1;

  for (PetscInt j = 0; j < nnls->num; j++) {
    if (z[j] > 0 || nnls->weight[j] > length * (nnls->weight[j] - z[j])) continue;
    length = nnls->weight[j] / (nnls->weight[j] - z[j]);
    first  = j;
  }
  for (PetscInt j = 0; j < nnls->num; j++) nnls->weight[j] += length * (z[j] - nnls->weight[j]);
  if (first < 0) return PETSC_TRUE;
  nnls->weight[first] = 0;
  for (PetscInt j = nnls->num - 1; j >= 0; j--)
    if (!(nnls->weight[j] > 0)) NNLSRemoveColumn_Private(nnls, j);
  return PETSC_FALSE;
}

static void NNLSSetResidual_Private(NNLS *nnls)
{
  for (PetscInt i = 0; i < nnls->m; i++) nnls->residual[i] = nnls->target[i];
  for (PetscInt j = 0; j < nnls->num; j++) {
    for (PetscInt i = 0; i < nnls->m; i++) nnls->residual[i] -= nnls->weight[j] * nnls->column[j * nnls->m + i];
  }
}

PetscReal NNLSPrice(const NNLS *nnls, const PetscReal column[])
{
  const PetscReal square = VectorDot(nnls->m, column, column);

  return square > 0 ? VectorDot(nnls->m, column, nnls->residual) / PetscSqrtReal(square) : 0;
}

PetscBool NNLSEnter(NNLS *nnls, PetscInt name, const PetscReal column[])
{
  const PetscInt m = nnls->m;
  PetscReal     *z = nnls->work + 2 * m * m;

  if (nnls->num == m || ++nnls->steps > MAX_STEPS * m)
    return PETSC_FALSE; // the present columns span everything: the residual is roundoff
  nnls->name[nnls->num]   = name;
  nnls->weight[nnls->num] = 0;
  for (PetscInt i = 0; i < m; i++) nnls->column[nnls->num * m + i] = column[i];
  nnls->num++;
  if (!NNLSLeastSquares_Private(nnls, z) || !(z[nnls->num - 1] > 0)) {
    nnls->num--;
    return PETSC_FALSE;
  }
  while (!NNLSStepTowards_Private(nnls, z) && nnls->num > 0 && NNLSLeastSquares_Private(nnls, z)) {}
  NNLSSetResidual_Private(nnls);
  return PETSC_TRUE;
}
