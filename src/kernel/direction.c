/* direction.c -- the direction of contact between two curved surfaces.

   Two surfaces touch with the common normal n. At the distance t from there, n_s = n + S_s t and n_m = -n +
   S_m t. So n_s + n_m = (S_s + S_m) t lies in the plane across n_s - n_m, and n = n_s - S_s t. Nothing
   changes but a sign when the two change roles. */
#include "kernel/direction.h"
#include "kernel/frame.h"
#include "kernel/vector.h"

/* Curvatures below this share of the largest one count as zero. With a relative curvature below it one
   surface fits the other, and t is undetermined. */
static const PetscReal NONE = 1e-8;
/* Least ratio of the two relative curvatures at which one direction may act on the other. Then t is accurate
   in both, and errors of normals are amplified tenfold at most. */
static const PetscReal COUPLED = 0.01;

/* Shares of the two directions. */
typedef struct {
  PetscInt  num;
  PetscReal s[4], sum[4]; /* S_s, S_s + S_m in the tangent plane [num][num] */
  PetscReal d[4], k[2];   /* principal directions of the sum [num][num], relative curvatures */
} Relative;

/* [in] Q - frame whose rows behind the first one span the tangent plane [dim][dim] */
static void DirectionToPlane_Private(PetscInt dim, const PetscReal Q[], const PetscReal S[], PetscReal plane[])
{
  const PetscInt num = dim - 1;

  for (PetscInt a = 0; a < num * num; a++) {
    plane[a] = 0;
    for (PetscInt k = 0; k < dim * dim; k++)
      plane[a] += Q[(1 + a / num) * dim + k / dim] * Q[(1 + a % num) * dim + k % dim] * S[k];
  }
}

void DirectionTransportCurvature(PetscInt dim, const PetscReal S[], const PetscReal from[], const PetscReal to[],
                                 PetscReal turned[])
{
  const PetscReal cosine = VectorDot(dim, from, to);
  PetscReal       R[9], RS[9];

  for (PetscInt i = 0; i < dim; i++) { // of vectors across `from`
    const PetscReal part = (from[i] + to[i]) / (1 + cosine);

    for (PetscInt j = 0; j < dim; j++) R[i * dim + j] = (i == j ? 1 : 0) - part * to[j];
  }
  for (PetscInt i = 0; i < dim; i++)
    for (PetscInt j = 0; j < dim; j++) {
      RS[i * dim + j] = 0;
      for (PetscInt k = 0; k < dim; k++) RS[i * dim + j] += R[i * dim + k] * S[k * dim + j];
    }
  for (PetscInt i = 0; i < dim; i++)
    for (PetscInt j = 0; j < dim; j++) {
      turned[i * dim + j] = 0;
      for (PetscInt k = 0; k < dim; k++) turned[i * dim + j] += RS[i * dim + k] * R[j * dim + k];
    }
}

static void DirectionSetPrincipal_Private(Relative *r)
{
  if (r->num == 1) {
    r->d[0] = 1;
    r->k[0] = r->sum[0];
  } else {
    const PetscReal mean = 0.5 * (r->sum[0] + r->sum[3]), half = 0.5 * (r->sum[0] - r->sum[3]),
                    off    = 0.5 * (r->sum[1] + r->sum[2]);
    const PetscReal radius = PetscSqrtReal(half * half + off * off), angle = 0.5 * PetscAtan2Real(off, half);

    r->d[0] = r->d[3] = PetscCosReal(angle);
    r->d[1]           = PetscSinReal(angle);
    r->d[2]           = -r->d[1];
    r->k[0]           = mean + radius;
    r->k[1]           = mean - radius;
  }
}

/* d_i . S d_j */
static PetscReal DirectionComponent_Private(const Relative *r, const PetscReal S[], PetscInt i, PetscInt j)
{
  PetscReal sum = 0;

  for (PetscInt a = 0; a < r->num * r->num; a++)
    sum += r->d[i * r->num + a / r->num] * S[a] * r->d[j * r->num + a % r->num];
  return sum;
}

/* The nonmortar body's share in the direction d_i; inside says whether it needed no clipping.
   [in] size - of curvatures */
static PetscReal DirectionWeight_Private(const Relative *r, PetscInt i, PetscReal size, PetscBool *inside)
{
  const PetscReal own = DirectionComponent_Private(r, r->s, i, i), other = r->k[i] - own;

  *inside = PETSC_FALSE;
  if (PetscAbsReal(own) <= NONE * size) return 0;       // flat: its own normal
  if (PetscAbsReal(r->k[i]) <= NONE * size) return 0.5; // one fits the other: roundoff must not decide
  if (r->k[i] < 0) return PetscAbsReal(own) <= PetscAbsReal(other) ? 0 : 1;
  *inside = (PetscBool)(own >= 0 && other >= 0);
  return PetscMax(0, PetscMin(1, own / r->k[i]));
}

/* The largest entry of a matrix. */
static PetscReal DirectionLargestEntry_Private(PetscInt num, const PetscReal A[])
{
  PetscReal most = 0;

  for (PetscInt k = 0; k < num; k++) most = PetscMax(most, PetscAbsReal(A[k]));
  return most;
}

void DirectionOfContact(PetscInt dim, const SurfacePoint *nonmortar, const SurfacePoint *mortar, PetscReal n[])
{
  Relative  r = {.num = dim - 1};
  PetscReal mean[3], Q[9], tilt[2] = {0, 0}, w[2], change[2], m[4], size, S[9], back[3];
  PetscBool inside[2] = {PETSC_FALSE, PETSC_FALSE};

  if (DirectionLargestEntry_Private(dim * dim, mortar->curvature) == 0 &&
      DirectionLargestEntry_Private(dim * dim, nonmortar->curvature) > 0) {
    for (PetscInt k = 0; k < dim; k++) n[k] = -mortar->normal[k]; // in all directions, to the last digit
    return;
  }
  for (PetscInt k = 0; k < dim; k++) mean[k] = nonmortar->normal[k] - mortar->normal[k];
  FrameNormalize(dim, mean);
  FrameFromNormal(dim, mean, Q);
  DirectionTransportCurvature(dim, nonmortar->curvature, nonmortar->normal, mean, S);
  DirectionToPlane_Private(dim, Q, S, r.s);
  for (PetscInt k = 0; k < dim; k++) back[k] = -mean[k];
  DirectionTransportCurvature(dim, mortar->curvature, mortar->normal, back, S);
  DirectionToPlane_Private(dim, Q, S, m);
  for (PetscInt a = 0; a < r.num * r.num; a++) r.sum[a] = r.s[a] + m[a];
  DirectionSetPrincipal_Private(&r);
  size = DirectionLargestEntry_Private(r.num * r.num, r.s) + DirectionLargestEntry_Private(r.num * r.num, m);
  for (PetscInt i = 0; i < r.num; i++) {
    for (PetscInt a = 0; a < r.num; a++) {
      for (PetscInt k = 0; k < dim; k++)
        tilt[i] += r.d[i * r.num + a] * Q[(1 + a) * dim + k] * (nonmortar->normal[k] + mortar->normal[k]);
    }
    w[i]      = DirectionWeight_Private(&r, i, size, &inside[i]);
    change[i] = w[i] * tilt[i];
  }
  if (inside[0] && inside[1] && r.k[1] >= COUPLED * r.k[0]) {
    change[0] += DirectionComponent_Private(&r, r.s, 0, 1) / r.k[1] * tilt[1];
    change[1] += DirectionComponent_Private(&r, r.s, 1, 0) / r.k[0] * tilt[0];
  }
  for (PetscInt k = 0; k < dim; k++) {
    n[k] = nonmortar->normal[k];
    for (PetscInt i = 0; i < r.num; i++) {
      for (PetscInt a = 0; a < r.num; a++) n[k] -= change[i] * r.d[i * r.num + a] * Q[(1 + a) * dim + k];
    }
  }
  FrameNormalize(dim, n);
}
