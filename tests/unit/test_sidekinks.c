/* test_sidekinks.c -- edges of less than 45 degrees between a cylinder and a chamfer of a file: normals of both parts, and the
   edge's kind. A fillet has none. */
#include "solid_scene.h"
#include "base/compat.h"
#include "kernel/frame.h"
#include "side/sideshape.h"

enum { F = ELEMENT_MAX_FACET_NODES, CHAMFER = 0, NARROW, FILLET, NUM_KINDS };

static const PetscReal SLOPE = 0.2; /* of the chamfer: 11 degrees */

/* How the radius of a side grows behind y = 0.5, where the cylinder ends. The chamfer is three facets wide or one, the fillet three. */
static const char *const Rise[NUM_KINDS] = {"0.2*(0.5-y)", "0.2*(0.5-y)", "sqrt(4-(y-0.5)^2)-2"};

static Mesh MakeMesh(PetscInt kind, TestScene *t)
{
  const PetscReal   lower[3] = {-0.6, -0.5, 1}, upper[3] = {0.6, kind == NARROW ? 2. / 3 : 1, 2};
  const PetscInt    faces[3] = {12, kind == NARROW ? 7 : 9, 1};
  const char *const angle    = "(x+0.04*sin(9*x+5*y))";
  char              radius[256], map[1024];
  Mesh              mesh;

  SolidSceneInit(t);
  SolidSceneAddBox(t, "part", faces, lower, upper)->simplex = PETSC_TRUE;
  (void)TestSceneAddPair(t, "outer", 0, "top", 0, "bottom");
  (void)snprintf(radius, sizeof(radius), "(z+(y<0.5?0:%s))", Rise[kind]);
  (void)snprintf(map, sizeof(map), "%s*sin%s, y, %s*cos%s", radius, angle, radius, angle);
  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", map, 3, PETSC_FALSE, &t->bodies[0].map));
  mesh = TestSceneMesh(t);
  CHECK(!ExpressionDestroy(&t->bodies[0].map));
  t->bodies[0].mesh_file = (char *)"part.msh"; // for all that the sides know
  return mesh;
}

/* The normal of the chamfer, or of the cylinder. */
static void PartNormal(PetscBool chamfer, PetscReal sign, const PetscReal x[3], PetscReal n[3])
{
  const PetscReal r = PetscSqrtReal(x[0] * x[0] + x[2] * x[2]);

  n[0] = sign * x[0] / r;
  n[1] = chamfer ? sign * SLOPE : 0;
  n[2] = sign * x[2] / r;
  (void)FrameNormalize(3, n);
}

/* All corners of a side. [in] sign - 1 of the outer side, -1 of the bore */
static void CheckSide(PetscInt kind, const char side[], PetscReal sign)
{
  PetscInt  kinks = 0;
  TestScene t;
  Mesh      mesh  = MakeMesh(kind, &t);
  Level    *level = MeshFinest(mesh);
  Facets    facets;
  SideShape shape;

  CHECK(!LevelGetFacets(level, &t.scene, 0, side, &facets));
  CHECK(!SideShapeCreate(level, &facets, NULL, &shape));
  for (PetscInt f = 0; f < facets.num; f++) {
    PetscReal most = 0;

    for (PetscInt i = 0; i < 3; i++) most = PetscMax(most, level->coords[3 * facets.nodes[f * F + i] + 1]);
    for (PetscInt i = 0; i < 3; i++) {
      const PetscReal *x       = &level->coords[3 * facets.nodes[f * F + i]];
      const PetscBool  chamfer = (PetscBool)(most > 0.5 + 1e-9);
      const PetscBool  at      = (PetscBool)(kind != FILLET && PetscAbsReal(x[1] - 0.5) < 1e-9);
      PetscReal        n[3];

      PartNormal(chamfer, sign, x, n);
      CHECK_NEAR(shape.ridge[f * F + i], at ? sign : 0, 0);
      kinks += at;
      for (PetscInt k = 0; k < 3 && kind != FILLET; k++)
        CHECK_NEAR(shape.normal[(f * F + i) * 3 + k], n[k], chamfer && kind == NARROW ? 0.05 : 1e-9);
    }
  }
  /* on either side 12 facets have two corners on the edge, 12 one */
  CHECK_NEAR(Total(kinks), kind == FILLET ? 0 : 72, 0);
  t.bodies[0].mesh_file = NULL;
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
  for (PetscInt kind = 0; kind < NUM_KINDS; kind++) {
    CheckSide(kind, "top", 1);
    CheckSide(kind, "bottom", -1);
  }
  PetscCall(PetscFinalize());
  return 0;
}
