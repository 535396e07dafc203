/* test_supportsolid.c -- held directions in space: sides that meet in edges and corners, oblique planes, free components. */
#include "solid_scene.h"
#include "support/support.h"

enum { MAX_CONDITIONS = 6 };

/* One condition d . u = value on the nodes of a plane a . X = c of the box. */
typedef struct {
  PetscInt  axis;
  PetscReal c;    /* where the side is in the box */
  PetscReal d[3]; /* unit */
  PetscReal value;
} Condition;

static PetscReal Dot(const PetscReal a[], const PetscReal b[])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Every node holds exactly the directions that its sides' conditions span, at their values. [in] back - box coordinates from
   positions; rank - of so many conditions at a node */
static void CheckSupport(TestScene *t, const Condition conditions[], PetscInt num, const char back[])
{
  Mesh       mesh  = TestSceneMesh(t);
  Level     *level = MeshFinest(mesh);
  Expression inverse;
  Support    support;
  PetscReal  seen[4] = {0, 0, 0, 0};

  CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-back", back, 3, PETSC_FALSE, &inverse));
  CHECK(!SupportCreate(level, &t->scene, &support));
  for (PetscInt node = 0; node < level->num_nodes; ++node) {
    const PetscReal *Q = &support.directions[9 * node];
    PetscReal        X[3];
    PetscInt         met = 0;

    CHECK(!ExpressionEvaluate(inverse, 3, &level->coords[3 * node], X));
    for (PetscInt i = 0; i < num; ++i) {
      PetscReal share = 0, value = 0;

      if (PetscAbsReal(X[conditions[i].axis] - conditions[i].c) > 1e-12) continue;
      ++met;
      for (PetscInt k = 0; k < support.count[node]; ++k) {
        share += PetscSqr(Dot(conditions[i].d, &Q[3 * k]));
        value += Dot(conditions[i].d, &Q[3 * k]) * support.values[3 * node + k];
      }
      CHECK_NEAR(share, 1, 1e-14); // implied by what is held
      CHECK_NEAR(value, conditions[i].value, 1e-14);
    }
    CHECK(support.count[node] == PetscMin(met, 3));
    CHECK((support.side[node] == BOUNDARY_NONE) == (met == 0));
    for (PetscInt k = 0; k < 3 && met; ++k) {
      for (PetscInt l = 0; l < 3; ++l) CHECK_NEAR(Dot(&Q[3 * k], &Q[3 * l]), k == l, 1e-14);
    }
    if (node < level->num_owned) seen[support.count[node]] += 1;
  }
  for (PetscInt k = 0; k <= 3; ++k) CHECK(Total(seen[k]) > 0);
  CHECK(!SupportDestroy(&support));
  CHECK(!ExpressionDestroy(&inverse));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(t);
}

static void MakeBlock(TestScene *t, PetscBool simplex, PetscInt order, const char map[])
{
  SceneBody *body;

  SolidSceneInit(t);
  t->scene.refine = 1;
  body            = SolidSceneAddBox(t, "block", (PetscInt[]){2, 2, 2}, (PetscReal[]){0, 0, 0}, (PetscReal[]){1, 1, 1});
  body->simplex   = simplex;
  body->order     = order;
  if (map) CHECK(!ExpressionCreate(PETSC_COMM_WORLD, "-map", map, 3, PETSC_FALSE, &body->map));
}

/* Three planes of symmetry, and a punch on top. */
static void TestSymmetry(PetscBool simplex, PetscInt order)
{
  const Condition conditions[] = {
      {0, 0, {1, 0, 0}, 0}, {1, 0, {0, 1, 0}, 0}, {2, 0, {0, 0, 1}, 0}, {2, 1, {0, 0, 1}, -0.01}};
  TestScene t;

  MakeBlock(&t, simplex, order, NULL);
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_DISPLACEMENT, "top", "free,free,-0.01");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "left+front", NULL);
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "bottom", NULL);
  CheckSupport(&t, conditions, 4, "x, y, z");
}

/* A leaning block: sides at all angles but the right one, with a displacement that two oblique planes must follow. */
static void TestOblique(PetscBool simplex, PetscInt order)
{
  /* x = X + Y/2, y = Y, z = Z + X/4: planes X = x - y/2 = 0 and Z = z - x/4 + y/8 = 0 */
  const PetscReal left = PetscSqrtReal(1.25), bottom = PetscSqrtReal(1. / 16 + 1. / 64 + 1);
  const Condition conditions[] = {{0, 0, {1 / left, -0.5 / left, 0}, 0},
                                  {2, 0, {-0.25 / bottom, 0.125 / bottom, 1 / bottom}, 0},
                                  {1, 1, {0, 1, 0}, 0.02}};
  TestScene       t;

  MakeBlock(&t, simplex, order, "x+y/2, y, z+x/4");
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "left", NULL);
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_NORMAL, "bottom", NULL);
  TestSceneAddBoundary(&t.bodies[0], BOUNDARY_DISPLACEMENT, "back", "free,0.02,free");
  CheckSupport(&t, conditions, 3, "x-y/2, y, z-x/4+y/8");
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  CHECK(!UserErrorInitialize());
  for (PetscInt order = 1; order <= 2; ++order) {
    for (int simplex = 0; simplex < 2; ++simplex) {
      TestSymmetry(simplex ? PETSC_TRUE : PETSC_FALSE, order);
      TestOblique(simplex ? PETSC_TRUE : PETSC_FALSE, order);
    }
  }
  CHECK(!PetscFinalize());
  return 0;
}
