/* test_support.c -- held directions at sides and corners, axis-aligned and inclined. */
#include "mesh_scene.h"
#include "support/support.h"

/* What every node of a mesh must look like; x is its position. */
typedef void (*ExpectFn)(const PetscReal x[2], PetscInt count, const PetscReal Q[4], const PetscReal values[2],
                         PetscInt side);

/* Builds the supports of a scene and shows them node by node, ghosts too. */
static void CheckNodes(TestScene *t, ExpectFn expect, PetscReal max_value)
{
  Mesh     mesh  = TestSceneMesh(t);
  Level   *level = MeshFinest(mesh);
  Support  support;
  PetscInt held = 0;

  CHECK(!SupportCreate(level, &t->scene, &support));
  CHECK_NEAR(support.max_value, max_value, 1e-15);
  for (PetscInt i = 0; i < level->num_nodes; ++i) {
    const PetscReal *Q = &support.directions[4 * i];

    expect(&level->coords[2 * i], support.count[i], Q, &support.values[2 * i], support.side[i]);
    if (!support.count[i]) continue;
    held++;
    CHECK_NEAR(Q[0] * Q[0] + Q[1] * Q[1], 1, 1e-15);
    CHECK_NEAR(Q[2] * Q[2] + Q[3] * Q[3], 1, 1e-15);
    CHECK_NEAR(Q[0] * Q[2] + Q[1] * Q[3], 0, 1e-15);
  }
  CHECK(Total(held) > 0);
  CHECK(!SupportDestroy(&support));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(t);
}

/* left: u_x = y, bottom: u_y = 0 as normal, right: both given, top: nothing. */
static void ExpectBox(const PetscReal x[2], PetscInt count, const PetscReal Q[4], const PetscReal values[2],
                      PetscInt side)
{
  if (x[0] == 1) {
    CHECK(count == 2 && Q[0] == 1 && Q[1] == 0 && Q[2] == 0 && Q[3] == 1);
    CHECK(values[0] == 3 * x[1] && values[1] == -4 * x[1]);
    CHECK(side == 1);
  } else if (x[0] == 0 && x[1] == 0) {
    CHECK(count == 2 && values[0] == 0 && values[1] == 0 && side == 0);
  } else if (x[0] == 0) {
    CHECK(count == 1 && Q[0] == 1 && Q[1] == 0 && values[0] == x[1] && side == 0);
  } else if (x[1] == 0) {
    CHECK(count == 1 && Q[0] == 0 && Q[1] == 1 && values[0] == 0 && side == 2);
  } else {
    CHECK(count == 0 && side == -1);
  }
}

static void TestBox(void)
{
  TestScene t;

  TestSceneInit(&t);
  t.scene.refine = 2;
  TestSceneAddBox(&t, "box", 2, 1, 0, 0, 1, 1);
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_DISPLACEMENT, "left", "y,free");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_DISPLACEMENT, "right", "3*y,-4*y");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "bottom", NULL);
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_PRESSURE, "top", "1"); // holds nothing
  CheckNodes(&t, ExpectBox, 4);
}

/* A box turned by 30 degrees: bottom and left held normally, joined; the corner is fixed altogether. */
static void ExpectTurned(const PetscReal x[2], PetscInt count, const PetscReal Q[4], const PetscReal values[2],
                         PetscInt side)
{
  const PetscReal c = PetscSqrtReal(0.75), s = 0.5, a = c * x[0] + s * x[1], b = -s * x[0] + c * x[1];

  CHECK(values[0] == 0 && values[1] == 0);
  CHECK(side == (count ? 0 : -1));
  if (PetscAbsReal(a) < 1e-12 && PetscAbsReal(b) < 1e-12) {
    CHECK(count == 2 && Q[0] == 1 && Q[3] == 1);
  } else if (PetscAbsReal(a) < 1e-12) { // left
    CHECK(count == 1);
    CHECK_NEAR(PetscAbsReal(Q[0] * c + Q[1] * s), 1, 1e-14);
  } else if (PetscAbsReal(b) < 1e-12) { // bottom
    CHECK(count == 1);
    CHECK_NEAR(PetscAbsReal(-Q[0] * s + Q[1] * c), 1, 1e-14);
  } else {
    CHECK(count == 0);
  }
}

static void TestTurned(void)
{
  TestScene t;

  TestSceneInit(&t);
  t.scene.refine = 1;
  TestSceneAddBox(&t, "turned", 3, 3, 0, 0, 1, 1);
  TestSceneSetMap(&t.bodies[0], "sqrt(0.75)*x-0.5*y, 0.5*x+sqrt(0.75)*y");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "left+bottom", NULL);
  CheckNodes(&t, ExpectTurned, 0);
}

/* The foot of a wedge slides on a slope of 45 degrees while u_x = 0.1 is given: u_y follows. */
static void ExpectSlope(const PetscReal x[2], PetscInt count, const PetscReal Q[4], const PetscReal values[2],
                        PetscInt side)
{
  const PetscBool left  = x[0] < 1e-12 ? PETSC_TRUE : PETSC_FALSE,
                  slope = x[1] - x[0] < 1e-12 ? PETSC_TRUE : PETSC_FALSE;

  if (left && slope) {
    CHECK(count == 2 && side == 0);
    CHECK_NEAR(values[0], 0.1, 1e-15);
    CHECK_NEAR(values[1], 0.1, 1e-15);
  } else if (left) {
    CHECK(count == 1 && Q[0] == 1 && values[0] == 0.1);
  } else if (slope) {
    CHECK(count == 1 && values[0] == 0);
    CHECK_NEAR(Q[0] + Q[1], 0, 1e-15);
  }
}

static void TestSlope(void)
{
  TestScene t;

  TestSceneInit(&t);
  TestSceneAddBox(&t, "wedge", 4, 2, 0, 0, 1, 1);
  TestSceneSetMap(&t.bodies[0], "x, x+y");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_DISPLACEMENT, "left", "0.1,free");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "bottom", NULL);
  CheckNodes(&t, ExpectSlope, 0.1);
}

/* Axes come out exact where a map leaves round-off: a quarter ring held on its two symmetry planes. */
static void ExpectRing(const PetscReal x[2], PetscInt count, const PetscReal Q[4], const PetscReal values[2],
                       PetscInt side)
{
  CHECK(values[0] == 0);
  if (PetscAbsReal(x[1]) < 1e-12)
    CHECK(count == 1 && Q[0] == 0 && Q[1] == 1 && side == 0);
  else if (PetscAbsReal(x[0]) < 1e-12)
    CHECK(count == 1 && Q[0] == 1 && Q[1] == 0 && side == 1);
  else
    CHECK(count == 0);
}

static void TestRing(void)
{
  TestScene t;

  TestSceneInit(&t);
  t.scene.refine = 1;
  TestSceneAddBox(&t, "ring", 2, 4, 1, 0, 2, PETSC_PI / 2);
  TestSceneSetMap(&t.bodies[0], "x*cos(y), x*sin(y)");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "bottom", NULL);
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "top", NULL);
  CheckNodes(&t, ExpectRing, 0);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  TestBox();
  TestTurned();
  TestSlope();
  TestRing();
  CHECK(!PetscFinalize());
  return 0;
}
