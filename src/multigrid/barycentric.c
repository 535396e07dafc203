/* barycentric.c -- interpolation of a linear function from scattered points.

   The nonnegative weights with the least sum w d^2 are those of the Delaunay simplex around the target. For
   the interpolant of d^2 is the lower hull of a paraboloid [1]. This is a linear program with few rows,
   solved by the simplex method. Negative weights are separate columns at a higher cost. The initial basis
   consists of artificial columns at the cost ARTIFICIAL_COST.

   References: [1] Edelsbrunner, Algorithms in combinatorial geometry, 1987. */
#include "multigrid/barycentric.h"

enum { DIM_MAX = 3, ROWS = DIM_MAX + 1, MAX_PIVOTS = 60 }; // about ten pivots are usual

/* Cost of a negative weight relative to a positive one; cost of an artificial column relative to the farthest
   point. */
static const PetscReal NEGATIVE_COST = 4, ARTIFICIAL_COST = 1e5;
/* Tolerances for a zero of order 1: during the pivots, and for the weights of artificial columns. */
static const PetscReal PIVOT_ZERO = 1e-9, WEIGHT_ZERO = 1e-7;
/* Limit for the sum of absolute weights: beyond it errors of the values are amplified. */
static const PetscReal MAX_WEIGHT_SUM = 2;

typedef struct {
  PetscInt  rows, num;
  PetscReal T[ROWS][BARYCENTRIC_MAX]; /* columns of positive weights; negative ones have the opposite sign */
  PetscReal b[ROWS];                  /* absolute weights of the basis */
  PetscReal cost[BARYCENTRIC_MAX];
  PetscInt  column[ROWS]; /* of the basis, -1 for artificial ones */
  PetscReal sign[ROWS];   /* of the weights */
} Tableau;

/* Returns false if all points coincide. */
static PetscBool BarycentricBegin_Private(PetscInt dim, PetscInt num, const PetscReal d[], Tableau *tableau)
{
  PetscReal farthest = 0;

  tableau->rows = dim + 1;
  tableau->num  = num;
  for (PetscInt j = 0; j < num; j++) {
    tableau->cost[j] = 0;
    for (PetscInt k = 0; k < dim; k++) tableau->cost[j] += PetscSqr(d[j * dim + k]);
    farthest = PetscMax(farthest, tableau->cost[j]);
  }
  if (farthest == 0) return PETSC_FALSE;
  for (PetscInt j = 0; j < num; j++) {
    tableau->cost[j] /= farthest;
    tableau->T[0][j] = 1;
    for (PetscInt k = 0; k < dim; k++) tableau->T[k + 1][j] = d[j * dim + k] / PetscSqrtReal(farthest);
  }
  for (PetscInt r = 0; r < tableau->rows; r++) {
    tableau->b[r]      = r ? 0 : 1;
    tableau->column[r] = -1;
    tableau->sign[r]   = 1;
  }
  return PETSC_TRUE;
}

static PetscReal BarycentricPrice_Private(const Tableau *tableau, PetscInt r)
{
  if (tableau->column[r] < 0) return ARTIFICIAL_COST;
  return (tableau->sign[r] > 0 ? 1 : NEGATIVE_COST) * tableau->cost[tableau->column[r]];
}

/* Chooses the column that reduces the cost most and the row that leaves the basis. Returns whether both
   exist. */
static PetscBool BarycentricChoose_Private(const Tableau *tableau, PetscInt *row, PetscInt *column, PetscReal *sign)
{
  PetscReal most = PIVOT_ZERO, least = 0;

  *row = *column = -1;
  *sign          = 1;
  for (PetscInt j = 0; j < tableau->num; j++) {
    PetscReal worth = 0;

    for (PetscInt r = 0; r < tableau->rows; r++) worth += BarycentricPrice_Private(tableau, r) * tableau->T[r][j];
    for (PetscInt k = 0; k < 2; k++) {
      const PetscReal saved = k ? -worth - NEGATIVE_COST * tableau->cost[j] : worth - tableau->cost[j];

      if (saved <= most) continue;
      most    = saved;
      *column = j;
      *sign   = k ? -1 : 1;
    }
  }
  if (*column < 0) return PETSC_FALSE;
  for (PetscInt r = 0; r < tableau->rows; r++) {
    const PetscReal t = *sign * tableau->T[r][*column];

    if (t <= PIVOT_ZERO || (*row >= 0 && tableau->b[r] >= least * t)) continue;
    least = tableau->b[r] / t;
    *row  = r;
  }
  return (PetscBool)(*row >= 0);
}

static void BarycentricPivot_Private(Tableau *tableau, PetscInt row, PetscInt column, PetscReal sign)
{
  const PetscReal pivot = sign * tableau->T[row][column];

  for (PetscInt j = 0; j < tableau->num; j++) tableau->T[row][j] /= pivot;
  tableau->b[row] /= pivot;
  for (PetscInt r = 0; r < tableau->rows; r++) {
    const PetscReal t = sign * tableau->T[r][column];

    if (r == row) continue;
    for (PetscInt j = 0; j < tableau->num; j++) tableau->T[r][j] -= t * tableau->T[row][j];
    tableau->b[r] = PetscMax(tableau->b[r] - t * tableau->b[row], 0);
  }
  tableau->column[row] = column;
  tableau->sign[row]   = sign;
}

PetscBool BarycentricWeights(PetscInt dim, PetscInt num, const PetscReal d[], PetscReal weight[])
{
  Tableau   tableau;
  PetscInt  row, column;
  PetscReal sign, sum = 0;

  if (!BarycentricBegin_Private(dim, num, d, &tableau)) return PETSC_FALSE;
  for (PetscInt k = 0; k < MAX_PIVOTS && BarycentricChoose_Private(&tableau, &row, &column, &sign); k++)
    BarycentricPivot_Private(&tableau, row, column, sign);
  for (PetscInt j = 0; j < num; j++) weight[j] = 0;
  for (PetscInt r = 0; r < tableau.rows; r++) {
    if (tableau.column[r] < 0 && tableau.b[r] > WEIGHT_ZERO) return PETSC_FALSE;
    if (tableau.column[r] < 0) continue;
    weight[tableau.column[r]] += tableau.sign[r] * tableau.b[r];
    sum += tableau.b[r];
  }
  return (PetscBool)(sum <= MAX_WEIGHT_SUM);
}
