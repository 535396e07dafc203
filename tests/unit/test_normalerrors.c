/* test_normalerrors.c -- errors of normals at nodes and on the next level, by hand: the largest of the facets around, times
   their size, too, and means between vertices. On nearly flat strips they stay angles. */
#include "solid_scene.h"
#include "base/compat.h"
#include "side/normalerrors.h"

enum { F = ELEMENT_MAX_FACET_NODES, FIELDS = LEVEL_NORMAL_ERRORS };

static const PetscReal EXACT = 1e-13;

/* A box with cells of 0.5 x 1 (x 0.25), refined once or not. */
static Mesh MakeMesh(PetscInt dim, PetscInt order, PetscInt levels, TestScene *t)
{
  const PetscReal lower[3] = {0, 0, 0}, upper[3] = {2, 2, 0.5};
  const PetscInt  faces[3] = {4, 2, 2};
  SceneBody      *body;

  TestSceneInit(t);
  if (dim == 3) SolidSceneInit(t);
  body            = SolidSceneAddBox(t, "box", faces, lower, upper);
  body->order     = order;
  t->scene.refine = levels - 1;
  (void)TestSceneAddPair(t, "pair", 0, "right", 0, "left");
  return TestSceneMesh(t);
}

/* The error at a vertex of the side at x = 2: any function that is linear along y and z. */
static PetscReal VertexError(PetscInt dim, const PetscReal x[])
{
  return 0.01 * (1 + x[1]) * (dim == 3 ? 1 + 2 * x[2] : 1);
}

/* The error at any node: it falls to 0 over the cells of length 0.5 behind the side. */
static PetscReal NodeError(PetscInt dim, const PetscReal x[])
{
  return PetscMax(0, (x[0] - 1.5) / 0.5) * VertexError(dim, x);
}

static void CheckLevel(const Level *level, PetscReal size, PetscReal tolerance)
{
  const PetscScalar *errors;
  Vec                local;

  CHECK(level->normal_errors);
  CHECK(!VecGhostGetLocalForm(level->normal_errors, &local));
  CHECK(!VecGetArrayRead(local, &errors));
  for (PetscInt a = 0; a < level->num_nodes; a++) {
    const PetscReal expected = NodeError(level->dim, &level->coords[level->dim * a]);

    CHECK_NEAR(errors[a * FIELDS], expected, tolerance);
    CHECK_NEAR(errors[a * FIELDS + 1], expected * size, tolerance);
  }
  CHECK(!VecRestoreArrayRead(local, &errors));
  CHECK(!VecGhostRestoreLocalForm(level->normal_errors, &local));
}

/* Facets of 1 (x 0.25): their longest edge is 1. */
static void TestErrors(PetscInt dim, PetscInt order)
{
  TestScene t;
  Mesh      mesh   = MakeMesh(dim, order, 2, &t);
  Level    *coarse = &mesh->levels[mesh->num_levels - 2];
  Facets    facets;
  SideShape shape;

  CHECK(!LevelGetFacets(coarse, &t.scene, 0, "right", &facets));
  CHECK(!SideShapeCreate(coarse, &facets, NULL, &shape));
  CHECK(!LevelAddNormalErrors(coarse, &facets, &shape));
  CHECK(!coarse->normal_errors); /* a plane has none */
  for (PetscInt f = 0; f < facets.num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(ElementLinear(facets.type[f])); i++) {
      const PetscReal *x = &coarse->coords[dim * facets.nodes[f * F + i]];

      /* where facets meet, the corner that is first in its facet tells less */
      shape.error[f * F + i] = VertexError(dim, x) * (i == 0 && x[1] == 1 ? 0.5 : 1);
    }
  }
  CHECK(!LevelAddNormalErrors(coarse, &facets, &shape));
  CheckLevel(coarse, 1, EXACT);
  CHECK(!LevelFollowNormalErrors(coarse, MeshFinest(mesh)));
  CheckLevel(MeshFinest(mesh), 1, EXACT);
  CHECK(!SideShapeDestroy(&shape));
  CHECK(!FacetsDestroy(&facets));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

/* The largest error that a side of order 2 from a file tells, with heights of 1e-4 and a strip of 0.001 between
   facets of 1. Slopes are up to 0.3 on the strip, 2e-4 elsewhere. */
static PetscReal StripError(PetscInt dim, PetscBool simplex)
{
  const PetscReal lower[3] = {0, dim == 3 ? 0 : -1, -1}, upper[3] = {12, dim == 3 ? 3 : 0, 0};
  const PetscInt  faces[3] = {12, dim == 3 ? 3 : 1, 1};
  TestScene       t;
  Mesh            mesh;
  Level          *level;
  Facets          facets;
  SideShape       shape;
  PetscReal       error;

  TestSceneInit(&t);
  if (dim == 3) SolidSceneInit(&t);
  SolidSceneAddBox(&t, "strip", faces, lower, upper)->simplex = simplex;
  t.bodies[0].order                                           = 2;
  (void)TestSceneAddPair(&t, "pair", 0, "top", 0, "bottom");
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map",
                          dim == 3 ? "x<5?x:(x<6?5+0.001*(x-5):x-0.999),y+0.03*sin(3*x+8*y),z+1e-4*sin(9*x)"
                                   : "x<5?x:(x<6?5+0.001*(x-5):x-0.999),y+1e-4*sin(9*x)",
                          dim, PETSC_FALSE, &t.bodies[0].map));
  mesh  = TestSceneMesh(&t);
  level = MeshFinest(mesh);
  CHECK(!ExpressionDestroy(&t.bodies[0].map));
  t.bodies[0].mesh_file = (char *)"strip.msh"; // for all that the side knows
  CHECK(!LevelGetFacets(level, &t.scene, 0, "top", &facets));
  CHECK(!SideShapeCreate(level, &facets, NULL, &shape));
  CHECK(!LevelAddNormalErrors(level, &facets, &shape));
  CHECK(!VecNorm(level->normal_errors, NORM_INFINITY, &error));
  t.bodies[0].mesh_file = NULL;
  CHECK(!SideShapeDestroy(&shape));
  CHECK(!FacetsDestroy(&facets));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
  return error;
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  for (PetscInt dim = 2; dim <= 3; dim++) {
    for (PetscInt order = 1; order <= 2; order++) TestErrors(dim, order);
    for (PetscInt simplex = 0; simplex < dim - 1; simplex++) {
      const PetscReal error = StripError(dim, (PetscBool)simplex);

      CHECK(error > 0 && error < 0.5);
    }
  }
  PetscCall(PetscFinalize());
  return 0;
}
