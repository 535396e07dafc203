/* conennls.c -- the rank with the most promising row tells it to all. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "rigid/conennls.h"

/* An eigenvalue of C'C, the square of a ratio of lengths, counts as 0 below this part of the largest. */
static const PetscReal RANK_TOLERANCE = 1e-12;
/* Parts of a motion that are rounding. */
static const PetscReal NEGLIGIBLE = 1e-9;
/* Rows of a basis, of length 1, are not divided by less: rows of C that are small, but not rounding, leave motions known to 1e-6 only. */
static const PetscReal PIVOT = 1e-4;

/* The best row of this rank: its price, with the sign that it has to enter with. */
static PetscReal Best_Private(const Cone *cone, const NNLS *nnls, PetscInt *row, PetscReal *sign)
{
  PetscReal best = 0;

  *row  = -1;
  *sign = 1;
  for (PetscInt r = 0; r < cone->num; r++) {
    const PetscReal price = NNLSPrice(nnls, &cone->rows[r * cone->m]);
    const PetscBool back  = (PetscBool)(cone->both && cone->both[r] && price < 0);

    if ((back ? -price : price) <= best) continue;
    best  = back ? -price : price;
    *row  = r;
    *sign = back ? -1 : 1;
  }
  return best;
}

PetscErrorCode ConeSolve(const Cone *cone, PetscReal tolerance, NNLS *nnls, PetscReal weight[])
{
  PetscReal  *told, sign;
  PetscInt    row, begin;
  PetscMPIInt rank;
  struct {
    double price;
    int    rank;
  } best;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(cone->comm, &rank));
  PetscCallMPI(MPI_Scan(&cone->num, &begin, 1, MPIU_INT, MPI_SUM, cone->comm));
  begin -= cone->num;
  PetscCall(PetscMalloc1(cone->m + 2, &told)); // the row as it enters, its sign, its global number
  for (;;) {
    best.price = (double)Best_Private(cone, nnls, &row, &sign);
    best.rank  = rank;
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE_INT, MPI_MAXLOC, cone->comm));
    if (!(best.price > tolerance)) break;
    if (rank == best.rank) {
      for (PetscInt k = 0; k < cone->m; k++) told[k] = sign * cone->rows[row * cone->m + k];
      told[cone->m]     = sign;
      told[cone->m + 1] = (PetscReal)(begin + row);
    }
    PetscCallMPI(MPI_Bcast(told, (PetscMPIInt)(cone->m + 2), MPIU_REAL, best.rank, cone->comm));
    /* rows of either sign carry theirs in their name: 2 row, 2 row + 1 for the opposite direction */
    if (!NNLSEnter(nnls, 2 * (PetscInt)told[cone->m + 1] + (told[cone->m] < 0 ? 1 : 0), told)) break;
  }
  PetscCall(PetscFree(told));
  for (PetscInt r = 0; r < cone->num && weight; r++) weight[r] = 0;
  for (PetscInt j = 0; j < nnls->num && weight; j++) {
    row = nnls->name[j] / 2 - begin;
    if (row >= 0 && row < cone->num) weight[row] += nnls->name[j] % 2 ? -nnls->weight[j] : nnls->weight[j];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gauss and Jordan on the rows of a basis, so that each has a column of its own. [in,out] rows - independent [n][m] */
static void Reduce_Private(PetscInt n, PetscInt m, PetscReal rows[])
{
  PetscInt done = 0;

  for (PetscInt column = 0; column < m && done < n; column++) {
    PetscInt best = done;

    for (PetscInt i = done; i < n; i++)
      if (PetscAbsReal(rows[i * m + column]) > PetscAbsReal(rows[best * m + column])) best = i;
    if (PetscAbsReal(rows[best * m + column]) < PIVOT) continue;
    for (PetscInt k = m - 1; k >= 0; k--) {
      const PetscReal swap = rows[best * m + k];

      rows[best * m + k] = rows[done * m + k];
      rows[done * m + k] = swap;
    }
    for (PetscInt k = m - 1; k >= 0; k--) rows[done * m + k] /= rows[done * m + column];
    for (PetscInt i = 0; i < n; i++) {
      const PetscReal part = rows[i * m + column];

      for (PetscInt k = 0; k < m && i != done; k++) rows[i * m + k] -= part * rows[done * m + k];
    }
    done++;
  }
  for (PetscInt i = 0; i < n * m; i++)
    if (PetscAbsReal(rows[i]) < NEGLIGIBLE) rows[i] = 0;
}

PetscErrorCode ConeKernel(const Cone *cone, const PetscBool take[], PetscInt *dim, PetscReal kernel[])
{
  const PetscInt m = cone->m;
  PetscReal     *gram, *values, *V, largest = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(m * m, &gram, m, &values, m * m, &V));
  for (PetscInt r = 0; r < cone->num; r++) {
    const PetscReal *row = &cone->rows[r * m];

    if (take && !take[r]) continue;
    for (PetscInt i = 0; i < m * m; i++) gram[i] += row[i / m] * row[i % m];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, gram, (PetscMPIInt)(m * m), MPIU_REAL, MPI_SUM, cone->comm));
  DenseEigen(m, gram, values, V);
  *dim = 0;
  for (PetscInt i = 0; i < m; i++) largest = PetscMax(largest, values[i]);
  for (PetscInt i = 0; i < m; i++) {
    if (values[i] > RANK_TOLERANCE * largest) continue;
    for (PetscInt k = 0; k < m; k++) kernel[*dim * m + k] = V[k * m + i];
    (*dim)++;
  }
  Reduce_Private(*dim, m, kernel);
  PetscCall(PetscFree3(gram, values, V));
  PetscFunctionReturn(PETSC_SUCCESS);
}
