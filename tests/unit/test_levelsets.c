/* test_levelsets.c -- integrals of functions that jump or bend where known functions are zero, by closed formulas. */
#include "base/compat.h"
#include "kernel/cubature.h"
#include <test.h>

enum { SIZE = 2 };

typedef enum {
  CIRCLE,  /* of radius R about C */
  BOWL,    /* 1 - r^2/R^2 where it is positive */
  CONE,    /* 1 - r/R where it is positive */
  HERTZ,   /* its root */
  CORNER,  /* x^2 + y^2 + z^2 < 1/4 */
  HALF,    /* x + 2 y > 1.3 */
  WEDGE,   /* x > 0.3 and y > 0.4 */
  LENS,    /* of two circles of radius 1/4 about (0.4, 0.5) and (0.6, 0.5) */
  TOUCH,   /* a circle of radius 1/4 about (0.25, 0.5) and the half x < 0.5: each touches a line x = const */
  KINK,    /* |x + 2 y - 1| */
  FAR,     /* x > 2 */
  OBLIQUE, /* |x + y - z| */
  CAP,     /* a disc by the function 1 - r/R, whose upper end is a cap of a part of the cell */
  BALL,    /* (1/4 - r^2)^1/2 about the origin, where it is real */
  CROSSED  /* y > (x - 0.3)^2 and y > (z - 0.3)^2, which touch in a point */
} Function;

static const PetscReal R = 0.28, C[2] = {0.41, 0.5}, CAP_R = 0.198;

/* The functions that are zero where it jumps or bends; returns their number. [out] f - [2] */
static PetscInt Switches(Function function, const PetscReal x[], PetscReal f[])
{
  const PetscReal r2 = PetscSqr(x[0] - C[0]) + PetscSqr(x[1] - C[1]);

  switch (function) {
  case CIRCLE:
  case BOWL:
  case HERTZ: f[0] = 1. - r2 / (R * R); return 1;
  case CONE: f[0] = 1. - PetscSqrtReal(r2) / R; return 1;
  case CORNER: f[0] = 0.25 - PetscSqr(x[0]) - PetscSqr(x[1]) - PetscSqr(x[2]); return 1;
  case HALF: f[0] = x[0] + 2. * x[1] - 1.3; return 1;
  case WEDGE:
    f[0] = x[0] - 0.3;
    f[1] = x[1] - 0.4;
    return 2;
  case LENS:
    f[0] = 0.0625 - PetscSqr(x[0] - 0.4) - PetscSqr(x[1] - 0.5);
    f[1] = 0.0625 - PetscSqr(x[0] - 0.6) - PetscSqr(x[1] - 0.5);
    return 2;
  case TOUCH:
    f[0] = 0.0625 - PetscSqr(x[0] - 0.25) - PetscSqr(x[1] - 0.5);
    f[1] = 0.5 - x[0];
    return 2;
  case KINK: f[0] = x[0] + 2. * x[1] - 1.; return 1;
  case FAR: f[0] = x[0] - 2.; return 1;
  case OBLIQUE: f[0] = x[0] + x[1] - x[2]; return 1;
  case CAP: f[0] = 1. - PetscSqrtReal(PetscSqr(x[0] - 0.968) + PetscSqr(x[1] - 0.3187)) / CAP_R; return 1;
  case BALL: f[0] = 0.25 - PetscSqr(x[0]) - PetscSqr(x[1]) - PetscSqr(x[2]); return 1;
  case CROSSED:
    f[0] = x[1] - PetscSqr(x[0] - 0.3);
    f[1] = x[1] - PetscSqr(x[2] - 0.3);
    return 2;
  }
  return 0;
}

static PetscErrorCode Value(void *ctx, const PetscReal xi[], PetscReal value[])
{
  const Function function = *(const Function *)ctx;
  PetscReal      f[2]     = {1., 1.};

  Switches(function, xi, f);
  value[0] = f[0] > 0. && f[1] > 0. ? 1. : 0.;
  if (function == BOWL || function == CONE) value[0] = PetscMax(f[0], 0.);
  if (function == HERTZ || function == BALL) value[0] = PetscSqrtReal(PetscMax(f[0], 0.));
  if (function == KINK || function == OBLIQUE) value[0] = PetscAbsReal(f[0]);
  value[1] = value[0] * xi[0];
  return PETSC_SUCCESS;
}

static PetscErrorCode Switch(void *ctx, PetscInt i, const PetscReal xi[], PetscReal *value)
{
  PetscReal f[2] = {0., 0.};

  Switches(*(const Function *)ctx, xi, f);
  *value = f[i];
  return PETSC_SUCCESS;
}

/* The integral and that of x times the function; the evaluations that they take. */
static void CheckIntegral(ElementType type, Function function, PetscReal total, PetscReal moment, PetscInt most)
{
  const PetscReal tolerance[SIZE] = {1e-12, 1e-12}, origin[3] = {0., 0., 0.};
  Cubature        cubature = {.type = type, .size = SIZE, .integrand = Value, .switches = Switch, .ctx = &function};
  PetscReal       value[SIZE], error, f[2];
  PetscBool       may;

  cubature.tolerance    = tolerance;
  cubature.num_switches = Switches(function, origin, f);
  cubature.budget       = 2000000;
  CHECK(!CubatureMayJump(&cubature, &may));
  CHECK(may);
  CHECK(!CubatureSwitches(&cubature, value, &error));
  CHECK(error <= 2.);
  CHECK(cubature.count < most);
  CHECK_NEAR(value[0], total, 1e-12);
  CHECK_NEAR(value[1], moment, 1e-12);
}

/* What the budget does not suffice for is told, and a function that is zero nowhere in the cell is no jump. */
static void CheckEnds(void)
{
  const PetscReal tolerance[SIZE] = {1e-12, 1e-12};
  Function        function        = HERTZ;
  Cubature  cubature = {.type = ELEMENT_QUAD4, .size = SIZE, .integrand = Value, .switches = Switch, .ctx = &function};
  PetscReal value[SIZE], error;
  PetscBool may;

  cubature.tolerance    = tolerance;
  cubature.num_switches = 1;
  cubature.budget       = 1000;
  CHECK(!CubatureSwitches(&cubature, value, &error));
  CHECK(error > 1.);
  CHECK(PetscAbsReal(value[0] - 2. / 3. * PETSC_PI * R * R) <= error * tolerance[0]);
  function = FAR;
  CHECK(!CubatureMayJump(&cubature, &may));
  CHECK(!may);
}

/* A disc up to the chord x = 1, at a distance d from its centre. */
static void CheckCap(void)
{
  const PetscReal d = 1. - 0.968, half = PetscSqrtReal(CAP_R * CAP_R - d * d);
  const PetscReal area = CAP_R * CAP_R * (PETSC_PI - PetscAcosReal(d / CAP_R)) + d * half;

  CheckIntegral(ELEMENT_QUAD4, CAP, area, 0.968 * area - 2. / 3. * half * half * half, 60000);
}

/* The mean of 1 - max(a^2, b^2), and with a + 0.3, for a and b from -0.3 to 0.7. There b^2 < a^2 on 2 |a|,
   and on a + 0.3 beyond a = 0.3. */
static void CheckCrossed(void)
{
  const PetscReal p = 0.7, q = 0.3, p4 = p * p * p * p, q4 = q * q * q * q;
  const PetscReal most  = 2. * (q4 + (p4 - q4) / 4. + q * (p * p * p - q * q * q) / 3.);
  const PetscReal first = 2. / 15. * (p4 * p - q4 * q) + q * (p4 - q4) / 4. + p * p * p * (p * p - q * q) / 6.;

  CheckIntegral(ELEMENT_HEX8, CROSSED, 1. - most, 0.5 - q * most - first, 400000);
}

int main(int argc, char **argv)
{
  const PetscReal disc = PETSC_PI * R * R, lens = 0.125 * PetscAcosReal(0.4) - 0.1 * PetscSqrtReal(0.21);

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  CheckIntegral(ELEMENT_QUAD4, CIRCLE, disc, C[0] * disc, 50000);
  CheckIntegral(ELEMENT_QUAD4, BOWL, disc / 2., C[0] * disc / 2., 50000);
  CheckIntegral(ELEMENT_QUAD4, CONE, disc / 3., C[0] * disc / 3., 120000);
  CheckIntegral(ELEMENT_QUAD4, HERTZ, 2. / 3. * disc, C[0] * 2. / 3. * disc, 50000);
  CheckIntegral(ELEMENT_QUAD4, HALF, 0.6, 0.6 * 0.5 + 1. / 24., 3000);
  CheckIntegral(ELEMENT_QUAD4, WEDGE, 0.42, 0.42 * 0.65, 3000);
  CheckIntegral(ELEMENT_QUAD4, LENS, lens, 0.5 * lens, 60000);
  CheckIntegral(ELEMENT_QUAD4, TOUCH, PETSC_PI / 16., PETSC_PI / 64., 60000);
  CheckIntegral(ELEMENT_QUAD4, KINK, 2. / 3., 0.375, 3000);
  CheckIntegral(ELEMENT_TRI3, HALF, 0.1225, 0.1225 * 0.7 / 3., 3000); /* corners (0, 1), (0, 0.65), (0.7, 0.3) */
  CheckIntegral(ELEMENT_TRI3, WEDGE, 0.045, 0.045 * 0.4, 3000);       /* corners (0.3, 0.4), (0.6, 0.4), (0.3, 0.7) */
  CheckIntegral(ELEMENT_HEX8, CORNER, PETSC_PI / 48., PETSC_PI / 256., 600000);
  CheckIntegral(ELEMENT_TET4, CORNER, PETSC_PI / 48., PETSC_PI / 256., 110000);
  CheckIntegral(ELEMENT_HEX8, CIRCLE, disc, C[0] * disc, 1200000);
  CheckIntegral(ELEMENT_HEX8, WEDGE, 0.42, 0.42 * 0.65, 20000);
  CheckIntegral(ELEMENT_TET4, WEDGE, 0.0045, 0.0045 * 0.375, 20000); /* 0.3^3/6 about (0.375, 0.475, 0.075) */
  CheckIntegral(ELEMENT_HEX8, OBLIQUE, 7. / 12., 0.35, 20000);
  CheckIntegral(ELEMENT_HEX8, BALL, PETSC_PI * PETSC_PI / 512., PETSC_PI / 960., 900000);
  CheckIntegral(ELEMENT_TET4, BALL, PETSC_PI * PETSC_PI / 512., PETSC_PI / 960., 1500000);
  CheckCap();
  CheckCrossed();
  CheckEnds();
  PetscCall(PetscFinalize());
  return 0;
}
