/* test_direction.c -- the direction of contact of two bodies near the place where they touch: the line of centres. */
#include "test.h"
#include "kernel/closest.h"
#include "kernel/direction.h"
#include "kernel/frame.h"
#include "uniform.h"

static const PetscReal EXACT = 1e-14;

/* A circle or sphere of a curvature at the point with a tilt of its normal from up, towards the second or third axis. */
static SurfacePoint Round(PetscInt dim, const PetscReal n[], PetscReal curvature)
{
  SurfacePoint at = {.normal = {0}};

  for (PetscInt k = 0; k < dim; ++k) at.normal[k] = n[k];
  for (PetscInt k = 0; k < dim * dim; ++k)
    at.curvature[k] = curvature * ((k / dim == k % dim ? 1 : 0) - n[k / dim] * n[k % dim]);
  return at;
}

/* Two circles that touch at the origin, seen from points above each other: exactly vertical up to the fourth order. Swapped, the
   opposite direction to the last digit. */
static void TestCircles(void)
{
  const PetscReal pairs[4][2] = {{1, 0.5}, {0.5, 3}, {2, -1}, {-0.3, 1}};

  for (PetscInt p = 0; p < 4; ++p) {
    const PetscReal    x = 1e-2, s = x * pairs[p][0], m = x * pairs[p][1];
    const PetscReal    n_s[2] = {-s, -PetscSqrtReal(1 - s * s)}, n_m[2] = {-m, PetscSqrtReal(1 - m * m)};
    const SurfacePoint upper = Round(2, n_s, pairs[p][0]), lower = Round(2, n_m, pairs[p][1]);
    PetscReal          n[2], swapped[2];

    DirectionOfContact(2, &upper, &lower, n);
    DirectionOfContact(2, &lower, &upper, swapped);
    for (PetscInt k = 0; k < 2; ++k) CHECK_NEAR(n[k], -swapped[k], EXACT);
    if (pairs[p][0] > 0 && pairs[p][1] > 0) {
      CHECK_NEAR(n[0], 0, x * x * x * x);
    } else { // one in the other: the flatter one's
      for (PetscInt k = 0; k < 2; ++k) CHECK_NEAR(n[k], pairs[p][0] > 0 ? -n_m[k] : n_s[k], EXACT);
    }
  }
}

/* A flat body decides alone, to the last digit, whichever role it has. */
static void TestFlat(void)
{
  for (PetscInt dim = 2; dim <= 3; ++dim) {
    const PetscReal    n_s[3] = {0.6, dim == 2 ? 0.8 : 0.48, 0.64}, n_m[3] = {-1, 0, 0};
    const SurfacePoint round = Round(dim, n_s, 2), flat = Round(dim, n_m, 0);
    PetscReal          n[3];

    DirectionOfContact(dim, &round, &flat, n);
    for (PetscInt k = 0; k < dim; ++k) CHECK(n[k] == -n_m[k]);
    DirectionOfContact(dim, &flat, &round, n);
    for (PetscInt k = 0; k < dim; ++k) CHECK_NEAR(n[k], n_m[k], EXACT);
  }
}

/* Two quadratic surfaces z = -x.S x/2 and z = x.S' x/2 with axes turned against each other: n_s = (-S t, -1),
   n_m = (S' t, ..) at t. The direction is down but for terms of the third order. */
static void TestTurnedCylinders(void)
{
  for (PetscInt turn = 1; turn <= 4; ++turn) {
    const PetscReal angle = 0.3 * (PetscReal)turn, c = PetscCosReal(angle), s = PetscSinReal(angle),
                    t[2] = {3e-3, -2e-3};
    const PetscReal S[4] = {1.1, 0, 0, 0.05}, A[4] = {0.7 * c * c, 0.7 * c * s, 0.7 * c * s, 0.7 * s * s};
    SurfacePoint    upper = {.normal = {0, 0, -1}}, lower = {.normal = {0, 0, 1}};
    PetscReal       n[3];

    for (PetscInt a = 0; a < 2; ++a) {
      for (PetscInt b = 0; b < 2; ++b) {
        upper.normal[a] += S[2 * a + b] * t[b];
        lower.normal[a] += A[2 * a + b] * t[b];
        upper.curvature[3 * a + b] = S[2 * a + b];
        lower.curvature[3 * a + b] = A[2 * a + b];
      }
    }
    FrameNormalize(3, upper.normal);
    FrameNormalize(3, lower.normal);
    DirectionOfContact(3, &upper, &lower, n);
    CHECK_NEAR(n[0], 0, 1e-6);
    CHECK_NEAR(n[1], 0, 1e-6);
  }
}

/* The nearest point of a facet: no point of a fine lattice is nearer, and inside the way there is across the facet. */
static void TestClosest(void)
{
  const ElementType types[4] = {ELEMENT_TRI3, ELEMENT_QUAD4, ELEMENT_TRI6, ELEMENT_QUAD9};

  for (PetscInt trial = 0; trial < 400; ++trial) {
    const ElementType type = types[trial % 4];
    const PetscInt    num = ElementNumNodes(type), fine = 40;
    PetscReal         X[3 * ELEMENT_MAX_FACET_NODES], x[3], eta[2], square;

    for (PetscInt i = 0; i < num; ++i) {
      const PetscReal *xi = ElementNode(type, i);
      X[3 * i]            = xi[0] + Uniform(-0.05, 0.05);
      X[3 * i + 1]        = xi[1] + Uniform(-0.05, 0.05);
      X[3 * i + 2]        = Uniform(-0.05, 0.05);
    }
    for (PetscInt k = 0; k < 3; ++k) x[k] = k < 2 ? Uniform(-0.5, 1.5) : Uniform(-0.5, 0.5);
    square = ClosestPointOnFacet(3, type, X, x, eta);
    CHECK(eta[0] > -1e-9 && eta[1] > -1e-9 && eta[0] < 1 + 1e-9 && eta[1] < 1 + 1e-9);
    for (PetscInt p = 0; p < (fine + 1) * (fine + 1); ++p) {
      const PetscReal at[2] = {(PetscReal)(p % (fine + 1)) / fine, (PetscReal)(p / (fine + 1)) / fine};
      PetscReal       phi[ELEMENT_MAX_NODES], distance = 0;

      if (ElementNumNodes(ElementLinear(type)) == 3 && at[0] + at[1] > 1) continue;
      ElementShape(type, at, phi, NULL);
      for (PetscInt k = 0; k < 3; ++k) {
        PetscReal y = -x[k];
        for (PetscInt i = 0; i < num; ++i) y += phi[i] * X[3 * i + k];
        distance += y * y;
      }
      CHECK(distance > square - 1e-12);
    }
  }
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestCircles();
  TestFlat();
  TestTurnedCylinders();
  TestClosest();
  PetscCall(PetscFinalize());
  return 0;
}
