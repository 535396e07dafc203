/* frictionarnoldi.c -- the spectral radius of a linear map, one number per unit, by Arnoldi's method, and
   what its eigenvalues tell of other solutions (eq. 16.6). */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* Numbers of steps. After RHO_FIRST steps rho has settled in two cases. Its error is below RHO_ACCURATE of
   it, and below RHO_SIDE of its distance from 1. Or both together are below RHO_TINY. */
enum { RHO_FIRST = 3, RHO_STEPS = 24 };
static const PetscReal RHO_TINY = 1e-3, RHO_ACCURATE = 0.25, RHO_SIDE = 0.5;

/* The first vector is smooth: the limits. Parts of it follow the direction of slip and the place of the node,
   as noise. So it is in no invariant subspace, such as those of symmetric scenes, and it is the same for any
   order of the unknowns. */
static const PetscReal SEED_ALONG = 0.5, SEED_ANY = 0.01;
/* Of the errors of images one is computed, with an error itself; others may be larger: it counts RHO_INEXACT
   times. */
static const PetscReal RHO_INEXACT = 2;
/* The subspace is invariant if this part of its last image is left. */
static const PetscReal RHO_INVARIANT = 1e-12;

/* [out] seed - the first vector, 0 where the map is 0 [num] */
static void FrictionArnoldiSetSeed_Private(const FrictionUnits *units, PetscReal seed[])
{
  for (PetscInt a = 0; a < units->num; a++) {
    const FrictionUnit *unit = &units->unit[a];

    if (unit->status != UNIT_SLIP || !unit->closed) continue;
    seed[a] = FrictionUnitLimit(unit, units->r[unit->normal]) *
              (1 + SEED_ALONG * unit->direction[0] + SEED_ANY * PetscSinReal(unit->place));
  }
}

/* Orthogonalizes v against older vectors, and scales it to 1. [out] h - coefficients, then the length of the
   rest [k + 1] */
static PetscErrorCode FrictionArnoldiOrthogonalize_Private(FrictionMethod method, PetscInt k, PetscReal *basis[],
                                                           PetscReal v[], PetscReal h[])
{
  const PetscInt num = method->units.num;

  PetscFunctionBeginUser;
  for (PetscInt j = 0; j <= k; j++) {
    h[j] = 0;
    for (PetscInt a = 0; a < num; a++) h[j] += v[a] * (j < k ? basis[j][a] : v[a]);
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &h[j], 1, MPIU_REAL, MPI_SUM, method->units.comm));
    for (PetscInt a = 0; a < num && j < k; a++) v[a] -= h[j] * basis[j][a];
  }
  h[k] = PetscSqrtReal(h[k]);
  for (PetscInt a = 0; a < num && h[k] > 0; a++) v[a] /= h[k];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* An eigenvalue of H. Of a conjugate pair the one with the positive imaginary part. */
typedef struct {
  PetscReal real, imaginary;
  PetscReal last;      /* size of the last component of its right vector of length 1 */
  PetscReal condition; /* 1 / |y'x|, of its left and right vectors of length 1 */
} Eigenvalue;

static PetscReal EigenvalueSize_Private(const Eigenvalue *e)
{
  return PetscSqrtReal(PetscSqr(e->real) + PetscSqr(e->imaginary));
}

/* The eigenvalue whose vectors are in columns i of right and left, and i + 1 if it has an imaginary part. */
static Eigenvalue EigenvalueGet_Private(PetscInt size, PetscInt i, PetscReal real, PetscReal imaginary,
                                        const PetscReal right[], const PetscReal left[])
{
  const PetscReal *x[2]       = {&right[i * RHO_STEPS], imaginary != 0 ? &right[(i + 1) * RHO_STEPS] : NULL};
  const PetscReal *y[2]       = {&left[i * RHO_STEPS], imaginary != 0 ? &left[(i + 1) * RHO_STEPS] : NULL};
  PetscReal        product[2] = {0};

  for (PetscInt k = 0; k < size; k++) {
    product[0] += y[0][k] * x[0][k] + (x[1] ? y[1][k] * x[1][k] : 0);
    product[1] += x[1] ? y[0][k] * x[1][k] - y[1][k] * x[0][k] : 0;
  }
  return (Eigenvalue){.real      = real,
                      .imaginary = imaginary,
                      .last      = PetscSqrtReal(PetscSqr(x[0][size - 1]) + (x[1] ? PetscSqr(x[1][size - 1]) : 0)),
                      .condition = 1 / PetscSqrtReal(PetscSqr(product[0]) + PetscSqr(product[1]))};
}

/* [in] H - column by column [size][RHO_STEPS]; [out] values - [num] */
static PetscErrorCode FrictionArnoldiSolve_Private(PetscInt size, const PetscScalar H[], PetscInt *num,
                                                   Eigenvalue values[])
{
  enum { ALL = RHO_STEPS * RHO_STEPS };
  PetscScalar  copy[ALL], left[ALL], right[ALL], real[RHO_STEPS], imaginary[RHO_STEPS], work[8 * RHO_STEPS];
  PetscBLASInt n = (PetscBLASInt)size, lead = RHO_STEPS, length = 8 * RHO_STEPS, info;

  PetscFunctionBeginUser;
  *num = 0;
  PetscCall(PetscArraycpy(copy, H, size * RHO_STEPS));
  PetscCallBLAS("LAPACKgeev", LAPACKgeev_("V", "V", &n, copy, &lead, real, imaginary, left, &lead, right, &lead, work,
                                          &length, &info));
  PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACKgeev failed with %d", (int)info);
  for (PetscInt i = 0; i < size; i += imaginary[i] != 0 ? 2 : 1)
    values[(*num)++] = EigenvalueGet_Private(size, i, real[i], imaginary[i], right, left);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* rho and its error from all eigenvalues. An eigenvalue of H is one of M + E with |E| = rest last + inexact,
   and to first order as far from one of M as condition |E| (eq. 16.6a).
   [in] rest - part of the last image outside of the subspace; [in] inexact - error of images */
static void FrictionArnoldiJudge_Private(PetscInt num, const Eigenvalue values[], PetscReal rest, PetscReal inexact,
                                         FrictionReport *report)
{
  PetscInt above = 0;

  report->rho = report->rho_error = 0;
  report->others                  = PETSC_FALSE;
  for (PetscInt i = 0; i < num; i++) {
    const Eigenvalue *e     = &values[i];
    const PetscReal   size  = EigenvalueSize_Private(e);
    const PetscReal   error = e->condition * (rest * e->last + inexact);

    if (size > report->rho) {
      report->rho       = size;
      report->rho_error = error;
    }
    if (e->imaginary == 0 && e->real - error > 1) above++;
  }
  report->others = (PetscBool)(above % 2);
}

/* Whether rho has settled, without the error of images. */
static PetscBool FrictionArnoldiSettles_Private(const FrictionReport *report, PetscReal part)
{
  const PetscReal rho = report->rho, error = report->rho_error;

  return (PetscBool)(error < part * PetscMin(RHO_ACCURATE * rho, RHO_SIDE * PetscAbsReal(1 - rho)) ||
                     rho + error < part * RHO_TINY);
}

/* The error of all images: that of the last one times the root of their number. [in,out] basis - the last
   vector is lost */
static PetscErrorCode FrictionArnoldiMeasure_Private(FrictionMethod method, FrictionMap correct, PetscInt k,
                                                     PetscReal *basis[], PetscReal *error)
{
  PetscReal *rest = basis[RHO_STEPS];

  PetscFunctionBeginUser;
  PetscCall((*correct)(method, basis[k - 1], rest));
  *error = 0;
  for (PetscInt a = 0; a < method->units.num; a++) *error += PetscSqr(rest[a]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, error, 1, MPIU_REAL, MPI_SUM, method->units.comm));
  *error = RHO_INEXACT * PetscSqrtReal(*error * (PetscReal)k);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode FrictionSpectralRadius(FrictionMethod method, FrictionMap map, FrictionMap correct, PetscReal part,
                                      PetscReal most, FrictionReport *report)
{
  const PetscInt num                      = method->units.num;
  PetscScalar    H[RHO_STEPS * RHO_STEPS] = {0};
  PetscReal     *basis[RHO_STEPS + 1], *values, h[RHO_STEPS + 1], inexact = 0;
  Eigenvalue     eigenvalues[RHO_STEPS];
  PetscInt       k = 0, found = 0;
  PetscBool      settled = PETSC_FALSE;

  PetscFunctionBeginUser;
  FrictionArnoldiJudge_Private(0, NULL, 0, 0, report);
  PetscCall(PetscCalloc1((RHO_STEPS + 1) * num, &values));
  for (PetscInt j = 0; j <= RHO_STEPS; j++) basis[j] = &values[j * num];
  FrictionArnoldiSetSeed_Private(&method->units, basis[0]);
  PetscCall(FrictionArnoldiOrthogonalize_Private(method, 0, basis, basis[0], h));
  for (; k < RHO_STEPS && h[k] > RHO_INVARIANT * report->rho && !settled; k++) {
    PetscCall((*map)(method, basis[k], basis[k + 1]));
    PetscCall(FrictionArnoldiOrthogonalize_Private(method, k + 1, basis, basis[k + 1], h));
    for (PetscInt i = 0; i < PetscMin(k + 2, RHO_STEPS); i++) H[RHO_STEPS * k + i] = h[i];
    PetscCall(FrictionArnoldiSolve_Private(k + 1, H, &found, eigenvalues));
    FrictionArnoldiJudge_Private(found, eigenvalues, h[k + 1], 0, report);
    settled = (PetscBool)(report->rho > most || (k + 1 >= RHO_FIRST && FrictionArnoldiSettles_Private(report, part)));
  }
  if (k && correct) PetscCall(FrictionArnoldiMeasure_Private(method, correct, k, basis, &inexact));
  FrictionArnoldiJudge_Private(found, eigenvalues, k ? h[k] : 0, inexact, report);
  PetscCall(PetscFree(values));
  PetscFunctionReturn(PETSC_SUCCESS);
}
