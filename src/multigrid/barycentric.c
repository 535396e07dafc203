/* barycentric.c -- a linear function at one place by its values at others.

   Of all ways to do that with weights that are not negative, the one with the least sum w d^2 uses the corners of the simplex around that place whose
   sphere has no other place in it: the function d^2, interpolated from the places, is the lower hull of a paraboloid [1]. That is a linear program in a few
   rows, here by the simplex method. Negative weights are columns of their own, at a higher price, and begin at what there is none of at a price that
   nobody pays.

   References: [1] Edelsbrunner, Algorithms in combinatorial geometry, 1987. */
#include "multigrid/barycentric.h"

enum { DIM_MAX = 3, ROWS = DIM_MAX + 1, PIVOTS = 60 }; // it is done after some ten

/* The price of a negative weight by that of a positive one, and of a row that no place serves by that of the farthest place. */
static const PetscReal LOATH = 4, NEVER = 1e5;
/* What is nothing beside 1 after some pivots. */
static const PetscReal NOTHING = 1e-9, LEFT = 1e-7;
/* Weights of more than this, absolute values summed up, make errors of the values larger than they were. */
static const PetscReal MUCH = 2;

typedef struct {
  PetscInt  rows, num;
  PetscReal T[ROWS][BARYCENTRIC_MAX]; /* columns of positive weights; those of negative ones have the other sign */
  PetscReal b[ROWS];                  /* absolute values of the weights in the basis */
  PetscReal cost[BARYCENTRIC_MAX];
  PetscInt  column[ROWS]; /* in the basis, -1 for none yet */
  PetscReal sign[ROWS];   /* of these weights */
} Tableau;

/* False where all places are one. */
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
  if (tableau->column[r] < 0) return NEVER;
  return (tableau->sign[r] > 0 ? 1 : LOATH) * tableau->cost[tableau->column[r]];
}

/* The column that saves most, and the row whose weight is the first to vanish for it. Returns whether there are both. */
static PetscBool BarycentricChoose_Private(const Tableau *tableau, PetscInt *row, PetscInt *column, PetscReal *sign)
{
  PetscReal most = NOTHING, least = 0;

  *row = *column = -1;
  *sign          = 1;
  for (PetscInt j = 0; j < tableau->num; j++) {
    PetscReal worth = 0;

    for (PetscInt r = 0; r < tableau->rows; r++) worth += BarycentricPrice_Private(tableau, r) * tableau->T[r][j];
    for (PetscInt k = 0; k < 2; k++) {
      const PetscReal saved = k ? -worth - LOATH * tableau->cost[j] : worth - tableau->cost[j];

      if (saved <= most) continue;
      most    = saved;
      *column = j;
      *sign   = k ? -1 : 1;
    }
  }
  if (*column < 0) return PETSC_FALSE;
  for (PetscInt r = 0; r < tableau->rows; r++) {
    const PetscReal t = *sign * tableau->T[r][*column];

    if (t <= NOTHING || (*row >= 0 && tableau->b[r] >= least * t)) continue;
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
  for (PetscInt k = 0; k < PIVOTS && BarycentricChoose_Private(&tableau, &row, &column, &sign); k++)
    BarycentricPivot_Private(&tableau, row, column, sign);
  for (PetscInt j = 0; j < num; j++) weight[j] = 0;
  for (PetscInt r = 0; r < tableau.rows; r++) {
    if (tableau.column[r] < 0 && tableau.b[r] > LEFT) return PETSC_FALSE;
    if (tableau.column[r] < 0) continue;
    weight[tableau.column[r]] += tableau.sign[r] * tableau.b[r];
    sum += tableau.b[r];
  }
  return (PetscBool)(sum <= MUCH);
}
