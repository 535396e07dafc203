/* test_wedge.c -- exponents of the pressure at an edge that are known. */
#include "kernel/wedge.h"
#include <test.h>

static const PetscReal DEGREE = PETSC_PI / 180;

/* A rigid wedge of any angle is a punch: r^-1/2. */
static void TestRigidWedge(void)
{
  for (PetscInt angle = 30; angle < 180; angle += 30) CHECK_NEAR(WedgeExponent(angle * DEGREE, 1e9), 0.5, 1e-5);
}

/* On a rigid half plane: Williams' notches of 2 a with free faces, sin(2 s a) = -s sin(2 a), with s = 0.615731 at 240 and 0.544484 at 270 degrees. */
static void TestRigidPlane(void)
{
  CHECK_NEAR(WedgeExponent(120 * DEGREE, 1e-12), 1 - 0.615731, 1e-6);
  CHECK_NEAR(WedgeExponent(135 * DEGREE, 1e-12), 1 - 0.544484, 1e-6);
  for (PetscInt angle = 15; angle <= 90; angle += 15) CHECK_NEAR(WedgeExponent(angle * DEGREE, 1e-12), 0, 1e-6);
}

/* A right angle: the exponent grows with the stiffness of the wedge, from 4 k / pi^2. An acute angle has none until the wedge is
   stiffer. */
static void TestRightAngle(void)
{
  PetscReal before = 0;

  for (PetscReal k = 1e-4; k < 1e4; k *= 2) {
    const PetscReal e = WedgeExponent(90 * DEGREE, k);

    CHECK(e > before);
    before = e;
    if (k < 1e-2) CHECK_NEAR(e, 4 * k / PetscSqr(PETSC_PI), PetscSqr(k));
  }
  CHECK(WedgeExponent(60 * DEGREE, 1) == 0);
  CHECK(WedgeExponent(60 * DEGREE, 10) > 0.2);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestRigidWedge();
  TestRigidPlane();
  TestRightAngle();
  PetscCall(PetscFinalize());
  return 0;
}
