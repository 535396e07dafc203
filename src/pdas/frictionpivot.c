/* frictionpivot.c -- the reduced problem in a plane by complementary pivoting (Lemke's method) [1, 2]
   (eq. 16.5).

   With y = F (g - r), F = S^-1, and forces r of contact, p along normals and beta+ - beta- along tangents,
   the law is a linear complementarity problem w = M z + q, w >= 0, z >= 0, w.z = 0 of

       w = (gap - y_n,  lambda - s,  lambda + s,  G - beta+ - beta-),   z = (p, beta+, beta-, lambda).

   z.M z = r.F r + mu lambda p >= 0, so M is copositive, and pivoting finds a solution for every coefficient
   [2]. It takes some pivots for each node, each of them a pass over M: as much as dozens of Newton steps, but
   never a cycle. It is for problems where Newton's steps do not descend, such as those of several solutions.

   References: [1] Cottle, Pang, Stone, The linear complementarity problem, 1992. [2] Stewart, Trinkle, An
   implicit time-stepping scheme for rigid body dynamics with inelastic collisions and Coulomb friction,
   1996. */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* Largest numbers of units, if pivoting is the first way that is tried, and the last one: pivots take half a
   second, and some seconds. */
enum { FIRST_PIVOTED = 300, LAST_PIVOTED = 500 };
/* Pivots for each row before the method gives up. */
enum { PIVOTS_PER_ROW = 20 };
/* Elements below this part of the largest in their column are no pivots. */
static const PetscReal LEAST_PIVOT = 1e-9;
/* Rows whose ratios differ by this part tie; the largest pivot is taken of them. */
static const PetscReal PIVOT_TIES = 1e-12;
/* Parts of the first value of the covering variable. Below the first it is roundoff, and pivoting ends. Where
   roundoff ends pivoting, it is zero below the second one: the last pressures may be that small. */
static const PetscReal COVER_ENDS = 8 * PETSC_MACHINE_EPSILON, COVER_SMALL = 1e-11;
/* Variation of the covering vector: symmetric scenes have no ties then. */
static const PetscReal COVER_VARIES = 0.1;

/* Rows of one unit. */
enum { ROW_NORMAL, ROW_PLUS, ROW_MINUS, ROW_LIMIT, ROWS };

/* w = T (nonbasic variables) + q. Variables 0 .. L-1 are w, L .. 2L-1 are z, 2L covers. */
typedef struct {
  PetscInt   L, *basic, *free; /* rows; variables of rows [L] and columns [L+1] */
  PetscInt  *first;            /* row of each unit [num] */
  PetscReal *T, *q;            /* [L][L+1], [L] */
  PetscReal *F, *y;            /* S^-1, F g [n][n], [n] */
} Pivoting;

/* F and y = F g. [out] done - whether S is positive definite */
static PetscErrorCode FrictionPivotInvert_Private(const FrictionProblem *problem, Pivoting *t, PetscBool *done)
{
  const PetscInt n = problem->units->n;
  PetscBLASInt   N, info;

  PetscFunctionBeginUser;
  PetscCall(PetscBLASIntCast(n, &N));
  PetscCall(PetscArraycpy(t->F, problem->S, n * n));
  PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &N, t->F, &N, &info));
  if (!info) PetscCallBLAS("LAPACKpotri", LAPACKpotri_("L", &N, t->F, &N, &info));
  *done = (PetscBool)!info;
  for (PetscInt j = 0; j < n; j++)
    for (PetscInt i = j + 1; i < n; i++) t->F[n * i + j] = t->F[n * j + i];
  for (PetscInt i = 0; i < n; i++) {
    t->y[i] = 0;
    for (PetscInt j = 0; j < n; j++) t->y[i] += t->F[n * i + j] * problem->g[j];
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Entries of row `sign` times unknown i of y, scaled to a diagonal of one. */
static void FrictionPivotSetForces_Private(const FrictionUnits *units, Pivoting *t, PetscInt row, PetscInt i,
                                           PetscReal sign)
{
  const PetscInt n = units->n;

  for (PetscInt a = 0; a < units->num; a++) {
    const PetscInt  j = units->unit[a].normal, column = t->first[a];
    const PetscReal scale = sign / PetscSqrtReal(t->F[(n + 1) * i]);

    t->T[row * (t->L + 1) + column] = scale * t->F[n * i + j] / PetscSqrtReal(t->F[(n + 1) * j]);
    if (!units->unit[a].num) continue;
    const PetscInt k = units->unit[a].tangent[0];

    t->T[row * (t->L + 1) + column + ROW_PLUS]  = scale * t->F[n * i + k] / PetscSqrtReal(t->F[(n + 1) * k]);
    t->T[row * (t->L + 1) + column + ROW_MINUS] = -t->T[row * (t->L + 1) + column + ROW_PLUS];
  }
}

/* M, q and the covering vector. Lengths are divided by the square root of the flexibility, and forces
   multiplied by it. */
static void FrictionPivotAssemble_Private(const FrictionUnits *units, Pivoting *t)
{
  const PetscInt n = units->n, L = t->L;

  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit = &units->unit[a];
    const PetscInt      row = t->first[a], i = unit->normal;
    const PetscReal     normal = PetscSqrtReal(t->F[(n + 1) * i]);

    FrictionPivotSetForces_Private(units, t, row, i, 1);
    t->q[row] = (unit->upper - t->y[i]) / normal;
    if (!unit->num) continue;
    const PetscInt  k       = unit->tangent[0];
    const PetscReal tangent = PetscSqrtReal(t->F[(n + 1) * k]);

    FrictionPivotSetForces_Private(units, t, row + ROW_PLUS, k, 1);
    FrictionPivotSetForces_Private(units, t, row + ROW_MINUS, k, -1);
    t->q[row + ROW_PLUS]  = (unit->origin[0] - t->y[k]) / tangent;
    t->q[row + ROW_MINUS] = -t->q[row + ROW_PLUS];
    const PetscReal even  = 1 / PetscSqrtReal(1 + unit->coefficient); // scales its row and column

    t->q[row + ROW_LIMIT]                               = even * unit->bound * tangent;
    t->T[(row + ROW_PLUS) * (L + 1) + row + ROW_LIMIT]  = even;
    t->T[(row + ROW_MINUS) * (L + 1) + row + ROW_LIMIT] = even;
    t->T[(row + ROW_LIMIT) * (L + 1) + row]             = even * unit->coefficient * tangent / normal;
    t->T[(row + ROW_LIMIT) * (L + 1) + row + ROW_PLUS]  = -even;
    t->T[(row + ROW_LIMIT) * (L + 1) + row + ROW_MINUS] = -even;
  }
  for (PetscInt r = 0; r < L; r++) {
    t->T[r * (L + 1) + L] = 1 + COVER_VARIES * PetscSinReal((PetscReal)r);
    t->basic[r]           = r;
    t->free[r]            = L + r;
  }
  t->free[L] = 2 * L;
}

/* The variables of row r and column c change places. */
static void FrictionPivotExchange_Private(Pivoting *t, PetscInt r, PetscInt c)
{
  const PetscInt  width = t->L + 1, name = t->basic[r];
  PetscReal      *row     = &t->T[r * width];
  const PetscReal inverse = 1 / row[c];

  row[c] = -1;
  for (PetscInt j = 0; j < width; j++) row[j] *= -inverse;
  t->q[r] *= -inverse;
  for (PetscInt i = 0; i < t->L; i++) {
    PetscReal      *other  = &t->T[i * width];
    const PetscReal factor = other[c];

    if (i == r || factor == 0) continue;
    other[c] = 0;
    for (PetscInt j = 0; j < width; j++) other[j] += factor * row[j];
    t->q[i] += factor * t->q[r];
  }
  t->basic[r] = t->free[c];
  t->free[c]  = name;
}

/* The row that reaches zero first if the variable of column c grows; -1 for none. The covering variable is
   preferred. */
static PetscInt FrictionPivotChooseRow_Private(const Pivoting *t, PetscInt c)
{
  PetscReal largest = 0, least = PETSC_MAX_REAL, best = 0;
  PetscInt  chosen = -1;

  for (PetscInt i = 0; i < t->L; i++) largest = PetscMax(largest, PetscAbsReal(t->T[i * (t->L + 1) + c]));
  for (PetscInt i = 0; i < t->L; i++) {
    const PetscReal pivot = -t->T[i * (t->L + 1) + c];

    if (pivot > LEAST_PIVOT * largest) least = PetscMin(least, PetscMax(t->q[i], 0) / pivot);
  }
  for (PetscInt i = 0; i < t->L; i++) {
    const PetscReal pivot = -t->T[i * (t->L + 1) + c];

    if (!(pivot > LEAST_PIVOT * largest) || PetscMax(t->q[i], 0) / pivot > (1 + PIVOT_TIES) * least) continue;
    if (t->basic[i] == 2 * t->L) return i;
    if (pivot <= best) continue;
    best   = pivot;
    chosen = i;
  }
  return chosen;
}

/* The covering variable. */
static PetscReal FrictionPivotGetCover_Private(const Pivoting *t)
{
  PetscInt i = 0;

  while (i < t->L && t->basic[i] != 2 * t->L) i++;
  return i < t->L ? t->q[i] : 0;
}

/* Pivots until the covering variable is zero. [out] done */
static void FrictionPivotRun_Private(Pivoting *t, PetscBool *done)
{
  const PetscInt L   = t->L;
  PetscInt       row = -1, column = L;
  PetscReal      first = 0;

  for (PetscInt i = 0; i < L; i++) {
    const PetscReal cover = -t->q[i] / t->T[i * (L + 1) + L];

    if (!(cover > first)) continue;
    first = cover;
    row   = i;
  }
  *done = (PetscBool)(row < 0);
  for (PetscInt k = 0; row >= 0 && k < PIVOTS_PER_ROW * L && !*done; k++) { // row -1: a ray
    PetscInt next;

    FrictionPivotExchange_Private(t, row, column);
    *done = (PetscBool)(FrictionPivotGetCover_Private(t) <= COVER_ENDS * first);
    next  = (t->free[column] + L) % (2 * L); // the partner of the variable that left
    if (*done) continue;
    for (column = 0; t->free[column] != next;) column++;
    row = FrictionPivotChooseRow_Private(t, column);
  }
  *done = (PetscBool)(*done || FrictionPivotGetCover_Private(t) <= COVER_SMALL * first);
}

/* The unit and the row in it that variable z is of. */
static PetscInt FrictionPivotFind_Private(const FrictionUnits *units, const Pivoting *t, PetscInt z, PetscInt *kind)
{
  PetscInt a = 0;

  while (a + 1 < units->num && t->first[a + 1] <= z - t->L) a++;
  *kind = z - t->L - t->first[a];
  return a;
}

/* y of the forces that were found. */
static void FrictionPivotGet_Private(const FrictionUnits *units, const Pivoting *t)
{
  const PetscInt n = units->n;

  for (PetscInt i = 0; i < n; i++) units->y[i] = t->y[i];
  for (PetscInt r = 0; r < t->L; r++) {
    PetscInt a, kind, j;

    if (t->basic[r] < t->L || t->basic[r] == 2 * t->L) continue;
    a = FrictionPivotFind_Private(units, t, t->basic[r], &kind);
    if (kind == ROW_LIMIT) continue;
    j                     = kind == ROW_NORMAL ? units->unit[a].normal : units->unit[a].tangent[0];
    const PetscReal force = (kind == ROW_MINUS ? -1 : 1) * t->q[r] / PetscSqrtReal(t->F[(n + 1) * j]);

    for (PetscInt i = 0; i < n; i++) units->y[i] -= t->F[n * i + j] * force;
  }
}

/* The decisions of the basis: p > 0 is contact, and lambda > 0 is slip. Where p is a small part of the
   tangential force they would not follow from values and forces. */
static void FrictionPivotDecide_Private(FrictionUnits *units, const Pivoting *t)
{
  FrictionUnitsForget(units);
  for (PetscInt r = 0; r < t->L; r++) {
    PetscInt      kind;
    FrictionUnit *unit;

    if (t->basic[r] < t->L || t->basic[r] == 2 * t->L) continue;
    unit = &units->unit[FrictionPivotFind_Private(units, t, t->basic[r], &kind)];
    if (kind == ROW_NORMAL) unit->closed = PETSC_TRUE;
    if (kind == ROW_LIMIT) unit->status = UNIT_SLIP;
    if (kind == ROW_PLUS) unit->direction[0] = 1;
    if (kind == ROW_MINUS) unit->direction[0] = -1;
  }
  for (PetscInt a = 0; a < units->num; a++) {
    FrictionUnit *unit = &units->unit[a];

    unit->turning = 0;
    if (unit->num && unit->status == UNIT_FREE && (unit->closed || unit->bound > 0)) unit->status = UNIT_STICK;
  }
}

PetscErrorCode FrictionProblemPivot(FrictionProblem *problem, PetscBool last, PetscBool *done)
{
  FrictionUnits *units = problem->units;
  Pivoting       t     = {.L = 0};

  PetscFunctionBeginUser;
  *done = PETSC_FALSE;
  for (PetscInt a = 0; a < units->num; a++)
    if (units->unit[a].num > 1) PetscFunctionReturn(PETSC_SUCCESS); // cones of space are not linear
  if (units->num > LAST_PIVOTED || (units->num > FIRST_PIVOTED) != last) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(units->num, &t.first));
  for (PetscInt a = 0; a < units->num; a++) {
    t.first[a] = t.L;
    t.L += units->unit[a].num ? ROWS : 1;
  }
  PetscCall(PetscCalloc2(t.L * (t.L + 1), &t.T, t.L, &t.q));
  PetscCall(PetscMalloc2(t.L, &t.basic, t.L + 1, &t.free));
  PetscCall(PetscMalloc2(units->n * units->n, &t.F, units->n, &t.y));
  PetscCall(FrictionPivotInvert_Private(problem, &t, done));
  if (*done) {
    FrictionPivotAssemble_Private(units, &t);
    FrictionPivotRun_Private(&t, done);
  }
  if (*done) {
    FrictionPivotGet_Private(units, &t);
    PetscCall(FrictionProblemSetForces(problem));
    FrictionPivotDecide_Private(units, &t);
  }
  PetscCall(PetscFree(t.first));
  PetscCall(PetscFree2(t.T, t.q));
  PetscCall(PetscFree2(t.basic, t.free));
  PetscCall(PetscFree2(t.F, t.y));
  PetscFunctionReturn(PETSC_SUCCESS);
}
