/* test_normalerrors.c -- errors of normals at nodes and on the next level, by hand: the largest of the facets around, times
   their size, too, and means between vertices. */
#include "solid_scene.h"
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

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  for (PetscInt dim = 2; dim <= 3; dim++) {
    for (PetscInt order = 1; order <= 2; order++) TestErrors(dim, order);
  }
  PetscCall(PetscFinalize());
  return 0;
}
