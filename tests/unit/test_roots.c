/* test_roots.c -- roots of polynomials whose roots are known. */
#include "kernel/roots.h"
#include <test.h>

#include "uniform.h"

enum { MAX_DEGREE = 4 };

/* c := scale prod (t - root_k), then multiplied with t^2 + 1 if there is room: no further real roots. Returns the degree. */
static PetscInt FromRoots(PetscInt num, const PetscReal root[], PetscReal scale, PetscReal c[])
{
  for (PetscInt k = 1; k <= MAX_DEGREE; k++) c[k] = 0.;
  c[0] = scale;
  for (PetscInt i = 0; i < num; i++) {
    for (PetscInt k = i + 1; k >= 0; k--) c[k] = (k > 0 ? c[k - 1] : 0.) - root[i] * c[k];
  }
  if (num + 2 > MAX_DEGREE) return num;
  for (PetscInt k = num + 2; k >= 2; k--) c[k] += c[k - 2];
  return num + 2;
}

/* Roots on and around [0,1], well apart: those inside come back in order, others do not. A degree that is too high changes
   nothing, exact zeros or roundoff. */
static void TestSimple(void)
{
  for (PetscInt trial = 0; trial < 20000; trial++) {
    const PetscInt num = trial % (MAX_DEGREE + 1);
    PetscReal      all[MAX_DEGREE], c[MAX_DEGREE + 1], found[MAX_DEGREE];
    PetscInt       degree, num_inside = 0, n;

    for (PetscInt i = 0; i < num; i++) all[i] = Uniform(0.02, 0.5) + (i > 0 ? all[i - 1] : -0.5);
    degree = FromRoots(num, all, Uniform(-2., 2.), c);
    if (degree + 1 <= MAX_DEGREE && trial % 3 == 1) c[++degree] = trial % 2 ? 0. : 1e-17;
    n = RootsInside(degree, c, found);
    for (PetscInt i = 0; i < num; i++) {
      if (PetscAbsReal(all[i]) < 1e-9 || PetscAbsReal(all[i] - 1.) < 1e-9) continue;
      if (all[i] > 0. && all[i] < 1.) {
        CHECK(num_inside < n);
        CHECK_NEAR(found[num_inside++], all[i], 1e-9);
      }
    }
    CHECK(n == num_inside);
  }
}

/* Places where the curve only touches zero, or is zero everywhere, are no roots; a threefold root is one. */
static void TestDegenerate(void)
{
  const PetscReal touching[] = {0.25, -1., 1.}, zero[] = {0., 0., 0.}, constant[] = {3.};
  const PetscReal ends[] = {0., 1., -1.}, threefold[] = {-0.125, 0.75, -1.5, 1.};
  PetscReal       found[3];

  CHECK(RootsInside(2, touching, found) == 0);
  CHECK(RootsInside(2, zero, found) == 0);
  CHECK(RootsInside(0, constant, found) == 0);
  CHECK(RootsInside(2, ends, found) == 0);
  CHECK(RootsInside(3, threefold, found) == 1);
  CHECK_NEAR(found[0], 0.5, 1e-5); /* a third of the digits */
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestSimple();
  TestDegenerate();
  PetscCall(PetscFinalize());
  return 0;
}
