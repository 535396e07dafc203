/* test_sidecorners.c -- angles of boxes at their vertices, and where sides end, by hand; in the plane and in space, with all cell types. */
#include "solid_scene.h"
#include "result/sidecorners.h"
#include <math.h>

static const PetscReal EXACT = 1e-12;

typedef struct {
  TestScene t;
  Mesh      mesh;
  Level    *level;
} Box;

/* A box of 3 x 3 (x 3) cells on [0,3]^dim, sheared so that its side at x = 0 is 45 degrees from the one at y = 0, and one beside it. */
static void BoxCreate(PetscInt dim, PetscBool simplex, PetscInt order, Box *box)
{
  const PetscReal lower[3] = {0, 0, 0}, upper[3] = {3, 3, 3}, beside[3] = {0, 3, 0}, behind[3] = {3, 4, 3};
  const PetscInt  faces[3] = {3, 3, 3};

  TestSceneInit(&box->t);
  if (dim == 3) SolidSceneInit(&box->t);
  SolidSceneAddBox(&box->t, "first", faces, lower, upper);
  SolidSceneAddBox(&box->t, "second", faces, beside, behind);
  TestSceneAddPair(&box->t, "joint", 0, dim == 2 ? "top" : "back", 1, dim == 2 ? "bottom" : "front");
  for (PetscInt b = 0; b < 2; b++) {
    box->t.bodies[b].simplex = simplex;
    box->t.bodies[b].order   = order;
    CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", dim == 2 ? "x+y,y" : "x+y,y,z", dim, PETSC_FALSE,
                            &box->t.bodies[b].map));
  }
  box->mesh  = TestSceneMesh(&box->t);
  box->level = MeshFinest(box->mesh);
}

static void BoxDestroy(Box *box)
{
  CHECK(!MeshDestroy(&box->mesh));
  TestSceneFree(&box->t);
}

/* Coordinates of a vertex before the shear, whole numbers. Middle nodes have none. */
static PetscBool BoxVertex(const Level *level, PetscInt node, PetscReal x[3])
{
  PetscBool whole = PETSC_TRUE;

  x[2] = 0;
  for (PetscInt k = 0; k < level->dim; k++) x[k] = level->coords[level->dim * node + k];
  x[0] -= x[1];
  for (PetscInt k = 0; k < 3; k++) {
    whole = (PetscBool)(whole && PetscAbsReal(x[k] - round(x[k])) < 1e-9);
    x[k]  = round(x[k]);
  }
  return whole;
}

/* The angle of the first body in units of pi: 2 within, 1 on sides, that of an edge on edges. At a corner half the solid angle
   is the excess of three dihedral angles, (sum - pi) / 2: those of z with x and with y are right ones. */
static PetscReal BoxAngle(PetscInt dim, const PetscReal x[3])
{
  const PetscBool at_x = (PetscBool)(x[0] == 0 || x[0] == 3), at_y = (PetscBool)(x[1] == 0 || x[1] == 3),
                  at_z = (PetscBool)(dim == 3 && (x[2] == 0 || x[2] == 3));
  const PetscReal edge = (x[0] == x[1]) ? 0.25 : 0.75;

  if (at_x && at_y) return at_z ? edge / 2 : edge;
  if ((at_x || at_y) && at_z) return 0.5;
  return at_x || at_y || at_z ? 1 : 2;
}

static void TestAngles(PetscInt dim, PetscBool simplex, PetscInt order)
{
  const PetscScalar *angle;
  PetscInt           found = 0;
  Vec                angles;
  Box                box;

  BoxCreate(dim, simplex, order, &box);
  CHECK(!SideCornersGetAngles(box.level, 0, &angles));
  CHECK(!VecGetArrayRead(angles, &angle));
  for (PetscInt a = 0; a < box.level->num_owned; a++) {
    PetscReal x[3];

    if (!BoxVertex(box.level, a, x)) continue;
    CHECK_NEAR(angle[a] / PETSC_PI, box.level->node_body[a] == 0 ? BoxAngle(dim, x) : 0, EXACT);
    found += box.level->node_body[a] == 0;
  }
  CHECK(!VecRestoreArrayRead(angles, &angle));
  CHECK_NEAR(Total(found), dim == 2 ? 16 : 64, 0);
  CHECK(!VecDestroy(&angles));
  BoxDestroy(&box);
}

/* The side at y = 3, of which vertices have places (x, z). Seen from outside, with z up, x falls: the boundary goes from (3,0) over (0,0), (0,3)
   and (3,3) back. The way leads from the vertex before to the one after. */
static void BoxWay(const PetscReal x[3], PetscReal way[3])
{
  const PetscBool side = (PetscBool)(x[0] == 0 || x[0] == 3), level = (PetscBool)(x[2] == 0 || x[2] == 3);

  way[0] = way[1] = way[2] = 0;
  if (level) way[0] = (x[2] == 0 ? -1 : 1) * (side ? 1 : 2);
  if (side) way[2] = (x[0] == 0 ? 1 : -1) * (level ? 1 : 2);
}

static void TestEnds(PetscInt dim, PetscBool simplex, PetscInt order)
{
  const PetscScalar *way;
  Facets             facets;
  Vec                ways;
  Box                box;

  BoxCreate(dim, simplex, order, &box);
  CHECK(!LevelGetFacets(box.level, &box.t.scene, 0, dim == 2 ? "top" : "back", &facets));
  CHECK(!SideCornersGetEnds(box.level, &facets, &ways));
  CHECK(!VecGetArrayRead(ways, &way));
  for (PetscInt a = 0; a < box.level->num_owned; a++) {
    PetscReal       x[3], expected[3] = {0, 0, 0};
    const PetscBool vertex = BoxVertex(box.level, a, x), on = (PetscBool)(box.level->node_body[a] == 0 && x[1] == 3);

    if (vertex && on && dim == 3) BoxWay(x, expected);
    if (vertex && on && dim == 2) expected[0] = x[0] == 0 ? 1 : x[0] == 3 ? -1 : 0;
    for (PetscInt k = 0; k < dim; k++) CHECK_NEAR(way[dim * a + k], expected[k], EXACT);
  }
  CHECK(!VecRestoreArrayRead(ways, &way));
  CHECK(!VecDestroy(&ways));
  CHECK(!FacetsDestroy(&facets));
  BoxDestroy(&box);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  for (PetscInt i = 0; i < 8; i++) {
    TestAngles(2 + i / 4, (PetscBool)(i / 2 % 2), 1 + i % 2);
    TestEnds(2 + i / 4, (PetscBool)(i / 2 % 2), 1 + i % 2);
  }
  PetscCall(PetscFinalize());
  return 0;
}
