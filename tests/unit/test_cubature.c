/* test_cubature.c -- integrals of functions with jumps, kinks and roots over reference cells, by closed formulas. */
#include "base/compat.h"
#include "kernel/cubature.h"
#include <test.h>

enum { SIZE = 3 };

typedef enum {
  LINE_JUMP,  /* beyond x = 0.997 */
  LINE_KINK,  /* |x - 0.7| */
  LINE_ROOT,  /* (1 - x)^1/2 */
  HALF_PLANE, /* x + 2 y > 1.3 */
  BESIDE,     /* x > 1 - 1e-15, a line of the boundary but for rounding: nothing */
  DISC,       /* of radius R about C */
  BOWL,       /* R^2 - r^2 where it is positive */
  HERTZ,      /* (1 - r^2/R^2)^1/2 where it is real */
  HALF_SPACE, /* x + 2 y + 0.7 z > 1.3 */
  SMOOTH      /* x^5 */
} Function;

static const PetscReal R = 0.28, C[2] = {0.41, 0.5};

static PetscErrorCode Value(void *ctx, const PetscReal xi[], PetscReal value[])
{
  const Function  function = *(const Function *)ctx;
  const PetscReal x = xi[0], y = xi[1], r2 = (x - C[0]) * (x - C[0]) + (y - C[1]) * (y - C[1]);
  PetscReal       f = 0.;

  switch (function) {
  case LINE_JUMP: f = x > 0.997 ? 1. : 0.; break;
  case LINE_KINK: f = PetscAbsReal(x - 0.7); break;
  case LINE_ROOT: f = PetscSqrtReal(1. - x); break;
  case HALF_PLANE: f = x + 2. * y > 1.3 ? 1. : 0.; break;
  case BESIDE: f = x > 1. - 1e-15 ? 1. : 0.; break;
  case DISC: f = r2 < R * R ? 1. : 0.; break;
  case BOWL: f = PetscMax(R * R - r2, 0.); break;
  case HERTZ: f = PetscSqrtReal(PetscMax(1. - r2 / (R * R), 0.)); break;
  case HALF_SPACE: f = x + 2. * y + 0.7 * xi[2] > 1.3 ? 1. : 0.; break;
  case SMOOTH: f = PetscPowRealInt(x, 5); break;
  }
  value[0] = f;
  value[1] = f * x;
  value[2] = f * (1. - x);
  return PETSC_SUCCESS;
}

static Cubature Make(ElementType type, Function *function, const PetscReal tolerance[])
{
  return (Cubature){.type      = type,
                    .size      = SIZE,
                    .integrand = Value,
                    .ctx       = function,
                    .tolerance = tolerance,
                    .inset     = 1e-13,
                    .pieces    = ElementDim(type) > 2 ? 2 : 8,
                    .budget    = 20000000};
}

/* The integral to ten times its tolerance, and the two parts of it that weights make. */
static void CheckIntegral(ElementType type, Function function, PetscReal expected)
{
  const PetscReal tolerance[SIZE] = {1e-11, 1e-11, 1e-11};
  Cubature        cubature        = Make(type, &function, tolerance);
  PetscReal       value[SIZE], error;

  CHECK(!CubatureAdaptive(&cubature, value, &error));
  CHECK(error <= 1.);
  CHECK_NEAR(value[0], expected, 1e-10);
  CHECK_NEAR(value[1] + value[2], value[0], 1e-10);
}

/* Rules are exact on polynomials, and the one with points at vertices sees what the other one does not. */
static void CheckRules(ElementType type, Function function, PetscReal gauss, PetscReal lobatto)
{
  Cubature  cubature = Make(type, &function, NULL);
  PetscReal value[SIZE];

  CHECK(!CubatureGauss(&cubature, 5, value));
  CHECK_NEAR(value[0], gauss, 1e-12);
  CHECK(!CubatureLobatto(&cubature, value));
  CHECK_NEAR(value[0], lobatto, 1e-12);
}

/* What the budget does not suffice for is told. */
static void CheckBudget(void)
{
  const PetscReal tolerance[SIZE] = {1e-12, 1e-12, 1e-12};
  Function        function        = DISC;
  Cubature        cubature        = Make(ELEMENT_QUAD4, &function, tolerance);
  PetscReal       value[SIZE], error;

  cubature.budget = 1000;
  CHECK(!CubatureAdaptive(&cubature, value, &error));
  CHECK(error > 1.);
  CHECK(PetscAbsReal(value[0] - PETSC_PI * R * R) <= error * tolerance[0]);
}

/* A plane is found by few points: nested lines take more than a million in space. */
static void CheckPlane(ElementType type, PetscReal expected)
{
  const PetscReal tolerance[SIZE] = {1e-11, 1e-11, 1e-11};
  Function        function        = HALF_SPACE;
  Cubature        cubature        = Make(type, &function, tolerance);
  PetscReal       value[SIZE], error;

  CHECK(!CubatureAdaptive(&cubature, value, &error));
  CHECK(error <= 1.);
  CHECK(cubature.count < 30000);
  CHECK_NEAR(value[0], expected, 1e-11);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  CheckIntegral(ELEMENT_LINE2, LINE_JUMP, 0.003);
  CheckIntegral(ELEMENT_LINE2, LINE_KINK, 0.29);
  CheckIntegral(ELEMENT_LINE2, LINE_ROOT, 2. / 3.);
  CheckIntegral(ELEMENT_QUAD4, HALF_PLANE, 0.6);
  CheckIntegral(ELEMENT_QUAD4, BESIDE, 0.);
  CheckIntegral(ELEMENT_QUAD4, DISC, PETSC_PI * R * R);
  CheckIntegral(ELEMENT_QUAD4, BOWL, 0.5 * PETSC_PI * R * R * R * R);
  CheckIntegral(ELEMENT_QUAD4, HERTZ, 2. / 3. * PETSC_PI * R * R);
  CheckIntegral(ELEMENT_TRI3, HALF_PLANE, 0.1225); /* corners (0, 1), (0, 0.65), (0.7, 0.3) */
  CheckIntegral(ELEMENT_HEX8, HALF_PLANE, 0.6);
  /* 1 - (1.3^3 - 0.3^3 - 0.6^3) / 6 / (2 0.7): the corner of the cube less what is beyond x = 1 and z = 1 */
  CheckIntegral(ELEMENT_HEX8, HALF_SPACE, 1. - (2.197 - 0.027 - 0.216) / 8.4);
  CheckPlane(ELEMENT_HEX8, 1. - (2.197 - 0.027 - 0.216) / 8.4);
  CheckPlane(ELEMENT_TET4, 0.35 * 0.7 * (0.7 / 1.3) / 6.); /* a corner, by the parts of its edges */
  CheckRules(ELEMENT_QUAD4, SMOOTH, 1. / 6., 1. / 6.);
  CheckRules(ELEMENT_TET4, SMOOTH, 1. / 336., 1. / 336.); /* 5! / 8! */
  CheckRules(ELEMENT_LINE2, LINE_JUMP, 0., 0.05 / 8.);
  CheckBudget();
  PetscCall(PetscFinalize());
  return 0;
}
