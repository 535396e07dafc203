/* frictionarnoldi.c -- the spectral radius of a linear map, one number per unit, by Arnoldi's method
   (eq. 16.6). */
#include "pdas/frictionimpl.h"
#include <petscblaslapack.h>

/* Numbers of steps: RHO_FIRST suffice if rho is tiny, RHO_FEW if it is small or settled; RHO_STEPS is the
   limit. It has settled if RHO_CALM steps in a row (eigenvalues come in pairs) change it by less than
   RHO_SETTLES of itself or RHO_DISTANT of its distance from 1. What matters is whether it is below 1. */
enum { RHO_FIRST = 3, RHO_FEW = 6, RHO_CALM = 2, RHO_STEPS = 24 };
static const PetscReal RHO_TINY = 1e-3, RHO_SETTLES = 0.005, RHO_DISTANT = 0.01;

/* The rest of rho is that of a geometric series, times RHO_REST: changes fall more slowly than those of a
   series, by up to 1.7 times. Its ratio is that of RHO_WINDOW changes to as many before, at most RHO_RATIO.
   It is RHO_EARLY where there are fewer. */
enum { RHO_WINDOW = 3 };
static const PetscReal RHO_RATIO = 0.5, RHO_EARLY = 0.33, RHO_REST = 2;

/* The first vector is smooth: the limits. Parts of it follow the direction of slip and the place of the node,
   as noise. So it is in no invariant subspace, such as those of symmetric scenes, and it is the same for any
   order of the unknowns. */
static const PetscReal SEED_ALONG = 0.5, SEED_ANY = 0.01;
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

/* rho = max |eigenvalue of H|. [in] H - column by column [size][RHO_STEPS] */
static PetscErrorCode FrictionArnoldiLargest_Private(PetscInt size, const PetscScalar H[], PetscReal *rho)
{
  PetscScalar  copy[RHO_STEPS * RHO_STEPS], real[RHO_STEPS], imaginary[RHO_STEPS], work[8 * RHO_STEPS], none;
  PetscBLASInt n = (PetscBLASInt)size, lead = RHO_STEPS, length = 8 * RHO_STEPS, one = 1, info;

  PetscFunctionBeginUser;
  *rho = 0;
  PetscCall(PetscArraycpy(copy, H, size * RHO_STEPS));
  PetscCallBLAS("LAPACKgeev", LAPACKgeev_("N", "N", &n, copy, &lead, real, imaginary, &none, &one, &none, &one, work,
                                          &length, &info));
  PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACKgeev failed with %d", (int)info);
  for (PetscInt i = 0; i < size; i++) *rho = PetscMax(*rho, PetscSqrtReal(PetscSqr(real[i]) + PetscSqr(imaginary[i])));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* How far rho may be from its limit. [in] found - after each step [size] */
static PetscReal FrictionArnoldiRest_Private(PetscInt size, const PetscReal found[])
{
  const PetscInt at = size - 1, before = at - RHO_WINDOW, first = before - RHO_WINDOW;
  PetscReal      last, ratio = RHO_EARLY, changes = 0;

  for (PetscInt i = PetscMax(at - 1, 0); i <= at; i++)
    changes = PetscMax(changes, PetscAbsReal(found[i] - (i ? found[i - 1] : 0)));
  last = PetscAbsReal(found[at] - (before < 0 ? 0 : found[before]));
  if (first >= 0) {
    const PetscReal earlier = PetscAbsReal(found[before] - found[first]);

    ratio = last < RHO_RATIO * earlier ? last / earlier : RHO_RATIO;
  }
  return PetscMax(changes, RHO_REST * last * ratio / (1 - ratio));
}

PetscErrorCode FrictionSpectralRadius(FrictionMethod method, FrictionMap map, PetscReal rtol, PetscReal part,
                                      PetscReal most, FrictionReport *report)
{
  const PetscInt num                      = method->units.num;
  PetscScalar    H[RHO_STEPS * RHO_STEPS] = {0};
  PetscReal     *basis[RHO_STEPS + 1], *values, h[RHO_STEPS + 1];
  PetscReal      rho = 0, found[RHO_STEPS], largest = 0;
  PetscInt       k = 0, calm = 0;
  PetscBool      settled = PETSC_FALSE;

  PetscFunctionBeginUser;
  report->rho_error = 0;
  PetscCall(PetscCalloc1((RHO_STEPS + 1) * num, &values));
  for (PetscInt j = 0; j <= RHO_STEPS; j++) basis[j] = &values[j * num];
  FrictionArnoldiSetSeed_Private(&method->units, basis[0]);
  PetscCall(FrictionArnoldiOrthogonalize_Private(method, 0, basis, basis[0], h));
  for (; k < RHO_STEPS && h[k] > RHO_INVARIANT * rho && !settled; k++) {
    const PetscReal before = rho;
    PetscReal       change, image = 0;

    PetscCall((*map)(method, basis[k], basis[k + 1]));
    PetscCall(FrictionArnoldiOrthogonalize_Private(method, k + 1, basis, basis[k + 1], h));
    for (PetscInt i = 0; i < PetscMin(k + 2, RHO_STEPS); i++) H[RHO_STEPS * k + i] = h[i];
    for (PetscInt i = 0; i < k + 2; i++) image += PetscSqr(h[i]);
    largest = PetscMax(largest, PetscSqrtReal(image));
    PetscCall(FrictionArnoldiLargest_Private(k + 1, H, &rho));
    found[k]          = rho;
    report->rho_error = FrictionArnoldiRest_Private(k + 1, found);
    change            = PetscAbsReal(rho - before);
    calm              = change < part * PetscMax(RHO_SETTLES * rho, RHO_DISTANT * PetscAbsReal(1 - rho)) ? calm + 1 : 0;
    settled           = (PetscBool)(rho > most || (k + 1 >= RHO_FIRST && rho < part * RHO_TINY) ||
                          (k + 1 >= RHO_FEW && (rho < part * RHO_SMALL || calm >= RHO_CALM)));
  }
  if (k < RHO_STEPS && !settled) report->rho_error = 0;                                     // the subspace is invariant
  if (rtol > 0) report->rho_error = PetscMax(report->rho_error + rtol * largest, RHO_TINY); // the map is inexact
  report->rho = rho;
  PetscCall(PetscFree(values));
  PetscFunctionReturn(PETSC_SUCCESS);
}
