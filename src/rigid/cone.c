/* cone.c -- least squares over distributed rows: the rank with the best next row broadcasts it.

   Projection: with s = q - target the problem is to find the shortest s with row.s <= bound - row.target =:
   h. Let r be the residual of min | sum_i y_i (row_i, -h_i) - (0, .., 0, 1) |, y >= 0. The solution is s_k =
   r_k / r_(m+1) up to sign [1, 23.27].

   References: [1] Lawson, Hanson, Solving Least Squares Problems, 1974, problem LDP. */
#include "base/compat.h"
#include "kernel/dense.h"
#include "rigid/cone.h"

/* Eigenvalues of C'C below this part of the largest count as 0. They are squares of ratios of lengths. */
static const PetscReal CONE_RANK = 1e-12;
/* Entries of a kernel below this are roundoff. */
static const PetscReal CONE_NEGLIGIBLE = 1e-9;
/* Smallest pivot of a basis of rows of length 1. Small rows of C above roundoff determine motions to 1e-6
   only. */
static const PetscReal CONE_PIVOT = 1e-4;
/* Projection: rows enter while the residual along them exceeds this; its last component is between 0 and
   1. */
static const PetscReal CONE_PRICE = 1e-14;

/* The largest reduced cost of the rows of this rank.
   [out] row - of it, -1 for none; [out] sign - of its weight */
static PetscReal ConeFindBestRow_Private(const Cone *cone, const NNLS *nnls, PetscInt *row, PetscReal *sign)
{
  PetscReal best = 0;

  *row  = -1;
  *sign = 1;
  for (PetscInt r = 0; r < cone->num; r++) {
    const PetscReal price = NNLSPrice(nnls, &cone->rows[r * cone->m]);
    const PetscBool back  = (PetscBool)(cone->equality && cone->equality[r] && price < 0);

    if ((back ? -price : price) <= best) continue;
    best  = back ? -price : price;
    *row  = r;
    *sign = back ? -1 : 1;
  }
  return best;
}

PetscErrorCode ConeSolve(const Cone *cone, PetscReal tolerance, NNLS *nnls, PetscReal weight[])
{
  PetscReal  *entering, sign;
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
  PetscCall(PetscMalloc1(cone->m + 2, &entering)); // the row times its sign, the sign, its global number
  for (;;) {
    best.price = (double)ConeFindBestRow_Private(cone, nnls, &row, &sign);
    best.rank  = rank;
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE_INT, MPI_MAXLOC, cone->comm));
    if (!(best.price > tolerance)) break;
    if (rank == best.rank) {
      for (PetscInt k = 0; k < cone->m; k++) entering[k] = sign * cone->rows[row * cone->m + k];
      entering[cone->m]     = sign;
      entering[cone->m + 1] = (PetscReal)(begin + row);
    }
    PetscCallMPI(MPI_Bcast(entering, (PetscMPIInt)(cone->m + 2), MPIU_REAL, best.rank, cone->comm));
    /* the name of a row holds its sign: 2 row, or 2 row + 1 for the opposite direction */
    if (!NNLSEnter(nnls, 2 * (PetscInt)entering[cone->m + 1] + (entering[cone->m] < 0 ? 1 : 0), entering)) break;
  }
  PetscCall(PetscFree(entering));
  for (PetscInt r = 0; r < cone->num && weight; r++) weight[r] = 0;
  for (PetscInt j = 0; j < nnls->num && weight; j++) {
    row = nnls->name[j] / 2 - begin;
    if (row >= 0 && row < cone->num) weight[row] += nnls->name[j] % 2 ? -nnls->weight[j] : nnls->weight[j];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Gauss-Jordan elimination: each row of a basis gets a pivot column of its own.
   [in,out] rows - independent [n][m] */
static void ConeReduceBasis_Private(PetscInt n, PetscInt m, PetscReal rows[])
{
  PetscInt done = 0;

  for (PetscInt column = 0; column < m && done < n; column++) {
    PetscInt best = done;

    for (PetscInt i = done; i < n; i++)
      if (PetscAbsReal(rows[i * m + column]) > PetscAbsReal(rows[best * m + column])) best = i;
    if (PetscAbsReal(rows[best * m + column]) < CONE_PIVOT) continue;
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
    if (PetscAbsReal(rows[i]) < CONE_NEGLIGIBLE) rows[i] = 0;
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
    if (values[i] > CONE_RANK * largest) continue;
    for (PetscInt k = 0; k < m; k++) kernel[*dim * m + k] = V[k * m + i];
    (*dim)++;
  }
  ConeReduceBasis_Private(*dim, m, kernel);
  PetscCall(PetscFree3(gram, values, V));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ConeProject(const Cone *cone, const PetscReal bound[], const PetscReal target[], PetscReal q[])
{
  const PetscInt m = cone->m, n = m + 1;
  PetscReal     *rows, *unit, size = 0;
  Cone           lifted = {.comm = cone->comm, .num = cone->num, .m = n, .equality = cone->equality};
  NNLS           nnls;

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < m; k++) size = PetscMax(size, PetscAbsReal(target[k]));
  if (size <= 0) size = 1;
  PetscCall(PetscCalloc2(cone->num * n, &rows, n, &unit));
  for (PetscInt r = 0; r < cone->num; r++) {
    PetscReal excess = -bound[r] / size; // of the target over the bound, in units of the target

    for (PetscInt k = 0; k < m; k++) {
      rows[r * n + k] = -cone->rows[r * m + k];
      excess += cone->rows[r * m + k] * target[k] / size;
    }
    rows[r * n + m] = excess;
  }
  unit[m]     = 1;
  lifted.rows = rows;
  PetscCall(NNLSCreate(n, unit, &nnls));
  PetscCall(ConeSolve(&lifted, CONE_PRICE, &nnls, NULL));
  for (PetscInt k = 0; k < m; k++) q[k] = target[k] - size * nnls.residual[k] / nnls.residual[m];
  PetscCall(NNLSDestroy(&nnls));
  PetscCall(PetscFree2(rows, unit));
  PetscFunctionReturn(PETSC_SUCCESS);
}
