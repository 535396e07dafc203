/* test_obstacle.c -- gaps of rigid obstacles: the ray ends on the surface, on the side that the body meets. */
#include "base/compat.h"
#include "kernel/frame.h"
#include "contact/obstacle.h"
#include "test.h"
#include "uniform.h"

enum { NUM_RAYS = 2000 };

static PetscReal Gap(const SceneObstacle *obstacle, PetscInt dim, const PetscReal x[], const PetscReal n[])
{
  PetscReal gap;
  CHECK(!ObstacleGap(obstacle, dim, x, n, &gap));
  return gap;
}

static void RandomUnit(PetscInt dim, PetscReal n[])
{
  do {
    for (PetscInt k = 0; k < dim; k++) n[k] = Uniform(-1, 1);
  } while (!(FrameNormalize(dim, n) > 0.1));
}

/* Distance of a point from an axis (from a point where the axis is zero), and its coordinate along it. */
static PetscReal Distance(PetscInt dim, const PetscReal point[], const PetscReal axis[], const PetscReal x[],
                          PetscReal *along)
{
  PetscReal square = 0;
  *along           = 0;
  for (PetscInt k = 0; k < dim; k++) *along += axis[k] * (x[k] - point[k]);
  for (PetscInt k = 0; k < dim; k++) square += PetscSqr(x[k] - point[k] - *along * axis[k]);
  return PetscSqrtReal(square);
}

/* Rays from points near a round surface towards it. x = s (out of the surface) with s = radius (1 + something
   small); the normal looks into the obstacle. A gap is open where the point is outside of it; it is the
   nearest crossing. */
static void TestRound(PetscInt dim, ObstacleKind kind, PetscReal radius)
{
  for (PetscInt ray = 0; ray < NUM_RAYS; ray++) {
    SceneObstacle   round = {.kind = kind, .radius = radius};
    PetscReal       out[3], tilt[3], n[3], x[3], end[3], along, distance, gap;
    const PetscReal depth = Uniform(-0.2, 0.2) * PetscAbsReal(radius), shift = Uniform(-3, 3);
    if (kind == OBSTACLE_CYLINDER) RandomUnit(dim, round.axis);
    do { // across the axis
      PetscReal part = 0;
      RandomUnit(dim, out);
      for (PetscInt k = 0; k < dim; k++) part += out[k] * round.axis[k];
      for (PetscInt k = 0; k < dim; k++) out[k] -= part * round.axis[k];
    } while (!(FrameNormalize(dim, out) > 0.1));
    RandomUnit(dim, tilt);
    for (PetscInt k = 0; k < dim; k++) {
      round.point[k] = Uniform(-5, 5);
      n[k]           = (radius > 0 ? -out[k] : out[k]) + 0.3 * tilt[k];
      x[k]           = round.point[k] + (PetscAbsReal(radius) + depth) * out[k] + shift * round.axis[k];
    }
    FrameNormalize(dim, n);
    gap = Gap(&round, dim, x, n);
    for (PetscInt k = 0; k < dim; k++) end[k] = x[k] + gap * n[k];
    distance = Distance(dim, round.point, round.axis, end, &along);
    CHECK_NEAR(distance, PetscAbsReal(radius), 1e-12 * PetscAbsReal(radius));
    CHECK((gap > 0) == (radius * depth > 0));
    CHECK(PetscAbsReal(gap) > PetscAbsReal(depth) - 1e-13 && PetscAbsReal(gap) < 1.2 * PetscAbsReal(depth) + 1e-13);
  }
}

/* Away from a ball, along a cylinder's axis, from outside of a hollow: what no ray meets and what it does. */
static void TestTurned(void)
{
  const PetscReal x[3] = {0, 0, 2}, up[3] = {0, 0, 1}, down[3] = {0, 0, -1}, beside[3] = {1, 0, 0};
  SceneObstacle   ball = {.kind = OBSTACLE_BALL, .radius = 1}, cylinder = {.kind = OBSTACLE_CYLINDER, .radius = 1};

  CHECK(Gap(&ball, 3, x, up) == PETSC_INFINITY);
  CHECK_NEAR(Gap(&ball, 3, x, down), 1, 1e-15);
  ball.radius = -3;
  CHECK_NEAR(Gap(&ball, 3, x, up), 1, 1e-15);
  CHECK_NEAR(Gap(&ball, 3, x, down), 5, 1e-15);
  ball.radius = -2;
  CHECK(Gap(&ball, 3, x, beside) == PETSC_INFINITY); // along the surface
  cylinder.axis[2] = 1;
  CHECK(Gap(&cylinder, 3, x, up) == PETSC_INFINITY);
  cylinder.axis[2] = 0;
  cylinder.axis[0] = 1;
  CHECK_NEAR(Gap(&cylinder, 3, x, down), 1, 1e-15);
  CHECK(Gap(&cylinder, 3, x, beside) == PETSC_INFINITY);
}

/* A ray that passes a ball or cylinder by sees it go on from its outline: the gap has no jump there. */
static void TestPassing(ObstacleKind kind)
{
  SceneObstacle   round  = {.kind = kind, .radius = 1};
  const PetscReal n[3]   = {0, 0, -1};
  PetscReal       before = -1;

  if (kind == OBSTACLE_CYLINDER) round.axis[1] = 1;
  for (PetscInt i = 0; i <= 2000; i++) {
    const PetscReal x[3] = {i * 1e-3, 0, 2}, gap = Gap(&round, 3, x, n);
    CHECK(gap >= 1 - 1e-15 && gap <= 4); // 2 at the outline, then slowly more
    CHECK(i == 0 || PetscAbsReal(gap - before) < 0.05);
    before = gap;
  }
}

/* The point is on the plane, and on the paraboloid s = -r^2 / (2 R). */
static void TestPlaneAndParabola(PetscInt dim)
{
  for (PetscInt ray = 0; ray < NUM_RAYS; ray++) {
    SceneObstacle   plane = {.kind = OBSTACLE_PLANE}, parabola = {.kind = OBSTACLE_PARABOLA, .radius = Uniform(1, 2)};
    PetscReal       n[3], x[3], end[3], tilt[3], along, distance, gap;
    const PetscReal height = Uniform(-0.1, 0.5);
    RandomUnit(dim, plane.normal);
    RandomUnit(dim, tilt);
    if (ray % 2) parabola.radius = -parabola.radius;
    for (PetscInt k = 0; k < dim; k++) {
      parabola.normal[k] = plane.normal[k];
      parabola.point[k] = plane.point[k] = Uniform(-5, 5);
      n[k]                               = -plane.normal[k] + 0.3 * tilt[k];
      x[k]                               = plane.point[k] + height * plane.normal[k] + Uniform(-0.1, 0.1);
    }
    FrameNormalize(dim, n);
    gap = Gap(&plane, dim, x, n);
    for (PetscInt k = 0; k < dim; k++) end[k] = x[k] + gap * n[k];
    Distance(dim, plane.point, plane.normal, x, &along);
    CHECK((gap > 0) == (along > 0));
    Distance(dim, plane.point, plane.normal, end, &along);
    CHECK_NEAR(along, 0, 1e-13);
    gap = Gap(&parabola, dim, x, n);
    for (PetscInt k = 0; k < dim; k++) end[k] = x[k] + gap * n[k];
    distance = Distance(dim, parabola.point, parabola.normal, x, &along);
    CHECK((gap > 0) == (along > -distance * distance / (2 * parabola.radius)));
    distance = Distance(dim, parabola.point, parabola.normal, end, &along);
    CHECK_NEAR(along, -distance * distance / (2 * parabola.radius), 1e-12);
    for (PetscInt k = 0; k < dim; k++) n[k] = -n[k];
    CHECK(Gap(&plane, dim, x, n) == PETSC_INFINITY && Gap(&parabola, dim, x, n) == PETSC_INFINITY);
  }
}

/* A formula is the gap itself, in all coordinates. */
static PetscErrorCode TestExpression(void)
{
  const PetscReal x[3] = {1, 2, 3}, n[3] = {0, 0, 1};
  SceneObstacle   obstacle = {.kind = OBSTACLE_EXPRESSION};

  PetscFunctionBeginUser;
  PetscCall(ExpressionCreate(PETSC_COMM_WORLD, "-gap", "x+10*y+100*z", 1, PETSC_FALSE, &obstacle.gap));
  CHECK_NEAR(Gap(&obstacle, 3, x, n), 321, 1e-12);
  PetscCall(ExpressionDestroy(&obstacle.gap));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (PetscInt dim = 2; dim <= 3; dim++) {
    TestRound(dim, OBSTACLE_BALL, 2);
    TestRound(dim, OBSTACLE_BALL, -2);
    TestPlaneAndParabola(dim);
  }
  TestRound(3, OBSTACLE_CYLINDER, 2);
  TestRound(3, OBSTACLE_CYLINDER, -2);
  TestTurned();
  TestPassing(OBSTACLE_BALL);
  TestPassing(OBSTACLE_CYLINDER);
  PetscCall(TestExpression());
  PetscCall(PetscFinalize());
  return 0;
}
