/* frictioncoupling.c -- how much friction that becomes less at some nodes can add to friction at others, by
   the pressures (eq. 16.8b to 16.8e).

   With K and N of the dense system, all nodes closed, the changes of all pressures d and of friction satisfy

       d'K^-1 d <= d'K^-1 N (mu d - x),        K^-1 from the energy of the bodies,

   whatever nodes are open: at each node the changes of pressure and gap have no negative product. x >= 0 is
   what friction has less than its limit. The largest w.d for given x is that of an ellipsoid, and at most the
   sum of those of single nodes. */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* Tangential directions of a node: along its slip, and across in space. */
enum { ALONG, ACROSS, DIRECTIONS };

/* Matrices of the bound, column by column. */
typedef struct {
  PetscBLASInt n, m;                 /* units; tangents */
  PetscInt    *place;                /* of an unknown among the tangents, -1 of normals [units->n] */
  PetscReal   *slip;                 /* sizes, relative to the largest [n] */
  PetscScalar *T;                    /* tangents, then its factor [m][m] */
  PetscScalar *X;                    /* T^-1 times the columns of normals [n][m] */
  PetscScalar *K;                    /* pressing forces of normal displacements, tangents free [n][n] */
  PetscScalar *response[DIRECTIONS]; /* N: pressing forces of forces against slip, and across [n][n] */
  PetscScalar *E;                    /* the ellipsoid, then its factor [n][n] */
} FrictionCoupled;

static PetscErrorCode FrictionCoupledCreate_Private(const FrictionUnits *units, FrictionCoupled *t)
{
  PetscInt m = 0;
  size_t   n, num_tangents;

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(t, sizeof(*t)));
  PetscCall(PetscMalloc2(units->n, &t->place, units->num, &t->slip));
  for (PetscInt i = 0; i < units->n; i++) t->place[i] = -1;
  for (PetscInt a = 0; a < units->num; a++)
    for (PetscInt i = 0; i < units->unit[a].num; i++) t->place[units->unit[a].tangent[i]] = m++;
  PetscCall(PetscBLASIntCast(units->num, &t->n));
  PetscCall(PetscBLASIntCast(m, &t->m));
  n            = (size_t)t->n;
  num_tangents = (size_t)t->m;
  PetscCall(PetscMalloc3(num_tangents * num_tangents, &t->T, n * num_tangents, &t->X, n * n, &t->K));
  PetscCall(PetscCalloc3(n * n, &t->response[ALONG], n * n, &t->response[ACROSS], n * n, &t->E));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode FrictionCoupledDestroy_Private(FrictionCoupled *t)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(t->place, t->slip));
  PetscCall(PetscFree3(t->T, t->X, t->K));
  PetscCall(PetscFree3(t->response[ALONG], t->response[ACROSS], t->E));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* T, X, K from S. [out] known - whether T is positive definite */
static PetscErrorCode FrictionCoupledReduce_Private(const FrictionProblem *problem, FrictionCoupled *t,
                                                    PetscBool *known)
{
  const FrictionUnits *units = problem->units;
  const PetscScalar    one = 1, minus = -1;
  PetscBLASInt         info;

  PetscFunctionBeginUser;
  for (PetscInt j = 0; j < units->n; j++)
    for (PetscInt i = 0; i < units->n && t->place[j] >= 0; i++)
      if (t->place[i] >= 0) t->T[t->m * t->place[j] + t->place[i]] = problem->S[units->n * j + i];
  for (PetscInt a = 0; a < units->num; a++) {
    const PetscScalar *column = &problem->S[units->n * units->unit[a].normal];

    for (PetscInt i = 0; i < units->n; i++)
      if (t->place[i] >= 0) t->X[t->m * a + t->place[i]] = column[i];
    for (PetscInt b = 0; b < units->num; b++) t->K[t->n * a + b] = column[units->unit[b].normal];
  }
  /* K = S_nn - Y'Y with Y = L^-1 S_tn */
  PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &t->m, t->T, &t->m, &info));
  *known = (PetscBool)!info;
  if (info) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "N", "N", &t->m, &t->n, &one, t->T, &t->m, t->X, &t->m));
  PetscCallBLAS("BLASgemm",
                BLASgemm_("T", "N", &t->n, &t->n, &t->m, &minus, t->X, &t->m, t->X, &t->m, &one, t->K, &t->n));
  PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "T", "N", &t->m, &t->n, &one, t->T, &t->m, t->X, &t->m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Slip and the columns of N. */
static void FrictionCoupledRespond_Private(const FrictionUnits *units, FrictionCoupled *t)
{
  PetscReal largest = 0;

  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit                 = &units->unit[a];
    PetscReal           s[FRICTION_TANGENTS] = {0}, size = 0;

    for (PetscInt i = 0; i < unit->num; i++) {
      s[i] = units->y[unit->tangent[i]] - unit->origin[i];
      size += PetscSqr(s[i]);
    }
    t->slip[a] = PetscSqrtReal(size);
    largest    = PetscMax(largest, t->slip[a]);
    for (PetscInt b = 0; b < units->num && size > 0; b++) {
      PetscScalar x[FRICTION_TANGENTS] = {0};

      for (PetscInt i = 0; i < unit->num; i++) x[i] = t->X[t->m * b + t->place[unit->tangent[i]]];
      t->response[ALONG][t->n * a + b] = (s[0] * x[0] + s[1] * x[1]) / t->slip[a];
      if (unit->num > 1) t->response[ACROSS][t->n * a + b] = (s[0] * x[1] - s[1] * x[0]) / t->slip[a];
    }
  }
  for (PetscInt a = 0; a < units->num && largest > 0; a++) t->slip[a] /= largest;
}

/* The factor of E = K - (N mu K + K mu N') / 2. [out] known - whether that is positive definite */
static PetscErrorCode FrictionCoupledFactor_Private(const FrictionUnits *units, FrictionCoupled *t, PetscBool *known)
{
  const PetscScalar half = -0.5, one = 1;
  PetscScalar      *weighted;
  PetscBLASInt      info;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)t->n * (size_t)t->n, &weighted));
  for (PetscInt a = 0; a < units->num; a++) {
    PetscCall(PetscArraycpy(&t->E[t->n * a], &t->K[t->n * a], t->n));
    for (PetscInt b = 0; b < units->num; b++)
      weighted[t->n * a + b] = units->unit[a].coefficient * t->response[ALONG][t->n * a + b];
  }
  PetscCallBLAS("BLASgemm",
                BLASgemm_("N", "N", &t->n, &t->n, &t->n, &half, weighted, &t->n, t->K, &t->n, &one, t->E, &t->n));
  PetscCallBLAS("BLASgemm",
                BLASgemm_("N", "T", &t->n, &t->n, &t->n, &half, t->K, &t->n, weighted, &t->n, &one, t->E, &t->n));
  PetscCallBLAS("LAPACKpotrf", LAPACKpotrf_("L", &t->n, t->E, &t->n, &info));
  *known = (PetscBool)!info;
  PetscCall(PetscFree(weighted));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* u = L^-1 K w with E = L L', of the ellipsoid. [out] u - [n] */
static PetscErrorCode FrictionCoupledWeigh_Private(const FrictionUnits *units, const FrictionCoupled *t,
                                                   PetscScalar u[])
{
  const PetscScalar  one = 1, zero = 0;
  const PetscBLASInt step = 1;
  PetscScalar       *w;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(t->n, &w));
  for (PetscInt a = 0; a < units->num; a++) w[a] = units->unit[a].coefficient * t->slip[a];
  PetscCallBLAS("BLASgemv", BLASgemv_("N", &t->n, &t->n, &one, t->K, &t->n, w, &step, &zero, u, &step));
  PetscCallBLAS("BLAStrsm", BLAStrsm_("L", "L", "N", "N", &t->n, &step, &one, t->E, &t->n, u, &t->n));
  PetscCall(PetscFree(w));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest gain of a direction. [in] u - of FrictionCoupledWeigh_Private() */
static PetscErrorCode FrictionCoupledGain_Private(const FrictionUnits *units, FrictionCoupled *t, const PetscScalar u[],
                                                  int direction, PetscReal *most)
{
  const PetscScalar one   = 1;
  PetscReal         whole = 0;

  PetscFunctionBeginUser;
  PetscCallBLAS("BLAStrsm",
                BLAStrsm_("L", "L", "N", "N", &t->n, &t->n, &one, t->E, &t->n, t->response[direction], &t->n));
  for (PetscInt b = 0; b < units->num; b++) whole += PetscSqr(PetscRealPart(u[b]));
  *most = 0;
  for (PetscInt a = 0; a < units->num; a++) {
    const PetscScalar *column = &t->response[direction][t->n * a];
    PetscReal          along = 0, size = 0, gain;

    if (units->unit[a].num <= direction || whole == 0) continue;
    for (PetscInt b = 0; b < units->num; b++) {
      along += PetscRealPart(u[b] * column[b]);
      size += PetscSqr(PetscRealPart(column[b]));
    }
    gain  = PetscSqrtReal(whole * size) + (direction == ALONG ? -along : PetscAbsReal(along));
    *most = PetscMax(*most, t->slip[a] > 0 ? gain / 2 / t->slip[a] : PETSC_MAX_REAL);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionCoupling(const FrictionProblem *problem, FrictionReport *report)
{
  const FrictionUnits *units = problem->units;
  FrictionCoupled      t;
  PetscScalar         *u;
  PetscBool            known = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(FrictionCoupledCreate_Private(units, &t));
  PetscCall(PetscMalloc1(units->num, &u));
  PetscCall(FrictionCoupledReduce_Private(problem, &t, &known));
  if (known) FrictionCoupledRespond_Private(units, &t);
  if (known) PetscCall(FrictionCoupledFactor_Private(units, &t, &known));
  if (known) {
    PetscCall(FrictionCoupledWeigh_Private(units, &t, u));
    PetscCall(FrictionCoupledGain_Private(units, &t, u, ALONG, &report->coupling));
    PetscCall(FrictionCoupledGain_Private(units, &t, u, ACROSS, &report->turning));
  }
  PetscCall(PetscFree(u));
  PetscCall(FrictionCoupledDestroy_Private(&t));
  PetscFunctionReturn(PETSC_SUCCESS);
}
