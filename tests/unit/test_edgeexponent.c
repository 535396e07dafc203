/* test_edgeexponent.c -- the edge at the largest pressure: an end of one side, and what makes it no edge. */
#include "mesh/mesh.h"
#include "result/edgeexponent.h"
#include "kernel/wedge.h"
#include "test.h"
#include "two_boxes.h"

static const PetscReal SIZE = 0.25; /* of facets */

/* A punch on [-1,1] x [0,1] with a given map, on a block on [left,3] x [-1,0] that is twice as stiff. */
typedef struct {
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       pair;
  SceneBoundary   boundary;
  Mesh            mesh;
  VI              vi;
} Punch;

static void PunchBegin(Punch *c, const char map[], PetscReal left)
{
  const PetscReal young = 2000;

  CHECK(!SetTwoBoxes(&c->scene, c->bodies, &c->pair));
  CHECK(!ExpressionDestroy(&c->bodies[1].material.young));
  CHECK(!ConstantCreate("-young", 1, &young, &c->bodies[1].material.young));
  SetBox(&c->bodies[0], "punch", 8, 4, -1, 0, 1, 1);
  SetBox(&c->bodies[1], "block", (PetscInt)(4 * (3 - left)), 4, left, -1, 3, 0);
  if (map) CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", map, 2, PETSC_FALSE, &c->bodies[0].map));
  c->scene.quiet = PETSC_TRUE;
}

/* Data on a side of a body. */
static void PunchHold(Punch *c, PetscInt body, const char side[], BoundaryKind kind)
{
  const PetscReal pressure = 1;

  c->boundary = (SceneBoundary){kind, (char *)side, NULL};
  if (kind == BOUNDARY_PRESSURE) CHECK(!ConstantCreate("-bc", 1, &pressure, &c->boundary.value));
  c->bodies[body].boundaries     = &c->boundary;
  c->bodies[body].num_boundaries = 1;
}

static void PunchSetUp(Punch *c)
{
  CHECK(!MeshCreate(&c->scene, &c->mesh));
  CHECK(!MeshSetUp(c->mesh));
  CHECK(!VICreate(&c->scene, c->mesh, &c->vi));
}

/* The exponent if the largest pressure were at (x, 0). */
static PetscReal PunchExponent(Punch *c, PetscReal x)
{
  struct _n_Fields fields = {.vi = c->vi};
  const PairSum    sum    = {.max_pressure = 1, .max_pressure_at = {x, 0, 0}};
  PetscReal        exponent;

  CHECK(!EdgeExponentGet(&fields, 0, &sum, SIZE, &exponent));
  return exponent;
}

static void PunchEnd(Punch *c)
{
  CHECK(!VIDestroy(&c->vi));
  CHECK(!MeshDestroy(&c->mesh));
  CHECK(!ExpressionDestroy(&c->bodies[0].map));
  CHECK(!ExpressionDestroy(&c->pair.friction));
  CHECK(!DestroyTwoBoxes(c->bodies));
}

/* Both ends of the punch are edges of a right angle, and no other node is. The modulus is half of that of the partner. */
static void TestEnds(void)
{
  Punch c;

  PunchBegin(&c, NULL, -3);
  PunchSetUp(&c);
  CHECK_NEAR(PunchExponent(&c, -1), WedgeExponent(PETSC_PI / 2, 0.5), 1e-12);
  CHECK_NEAR(PunchExponent(&c, 1), WedgeExponent(PETSC_PI / 2, 0.5), 1e-12);
  CHECK(PunchExponent(&c, 0.75) == 0 && PunchExponent(&c, 0) == 0);
  PunchEnd(&c);
}

/* If the block has the multipliers, the largest pressure is at one of the two nodes beside the end of the punch. */
static void TestMortarEnds(void)
{
  Punch c;

  PunchBegin(&c, NULL, -3);
  c.pair.nonmortar = (SceneSide){.body = 1, .side = (char *)"top"};
  c.pair.mortar    = (SceneSide){.body = 0, .side = (char *)"bottom"};
  PunchSetUp(&c);
  CHECK_NEAR(PunchExponent(&c, 1), WedgeExponent(PETSC_PI / 2, 0.5), 1e-12);
  CHECK_NEAR(PunchExponent(&c, 1.25), WedgeExponent(PETSC_PI / 2, 0.5), 1e-12);
  CHECK_NEAR(PunchExponent(&c, 0.75), WedgeExponent(PETSC_PI / 2, 0.5), 1e-12);
  CHECK(PunchExponent(&c, 0.5) == 0 && PunchExponent(&c, 1.5) == 0);
  PunchEnd(&c);
}

/* A punch of 120 degrees at its edges, whose sides lean outwards, on a rigid plane: Williams' notch of 240 degrees, r^(0.615731 - 1). */
static void TestRigidPlane(void)
{
  Punch c;

  PunchBegin(&c, "x*(1+y/sqrt(3)),y", -3);
  c.pair.mortar   = (SceneSide){.body = -1};
  c.pair.obstacle = (SceneObstacle){.kind = OBSTACLE_PLANE, .normal = {0, 1, 0}};
  PunchSetUp(&c);
  CHECK_NEAR(PunchExponent(&c, 1), 1 - 0.615731, 1e-6);
  CHECK(PunchExponent(&c, 0) == 0);
  PunchEnd(&c);
}

/* Both sides end at x = -1: only the other end is an edge on a larger partner. */
static void TestCommonEnd(void)
{
  Punch c;

  PunchBegin(&c, NULL, -1);
  PunchSetUp(&c);
  CHECK(PunchExponent(&c, -1) == 0);
  CHECK(PunchExponent(&c, 1) > 0);
  PunchEnd(&c);
}

/* With friction, and where an edge or the partner beside it is held or loaded, the wedge is another one. */
static void TestOtherWedges(void)
{
  const PetscReal coefficient = 0.2;
  Punch           c;

  PunchBegin(&c, NULL, -3);
  CHECK(!ConstantCreate("-friction", 1, &coefficient, &c.pair.friction));
  PunchSetUp(&c);
  CHECK(PunchExponent(&c, 1) == 0);
  PunchEnd(&c);

  PunchBegin(&c, NULL, -3);
  PunchHold(&c, 0, "right", BOUNDARY_NORMAL);
  PunchSetUp(&c);
  CHECK(PunchExponent(&c, 1) == 0);
  CHECK(PunchExponent(&c, -1) > 0);
  PunchEnd(&c);

  PunchBegin(&c, NULL, -3);
  PunchHold(&c, 1, "top", BOUNDARY_PRESSURE);
  PunchSetUp(&c);
  CHECK(PunchExponent(&c, 1) == 0);
  PunchEnd(&c);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  TestEnds();
  TestMortarEnds();
  TestRigidPlane();
  TestCommonEnd();
  TestOtherWedges();
  PetscCall(PetscFinalize());
  return 0;
}
