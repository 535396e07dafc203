/* test_rigid.c -- which rigid modes supports leave to a body. */
#include "base/compat.h"
#include "support/rigidmodes.h"
#include "mesh_scene.h"
#include "solid_scene.h"

/* Every motion leaves held directions alone, and they are orthonormal. */
static void CheckLeft(const Level *level, const Support *support, const RigidModes *modes)
{
  for (PetscInt k = 0; k < modes->num; ++k) {
    const PetscReal *motion = &modes->mode[k * RIGID_COMPONENTS];

    for (PetscInt l = 0; l <= k; ++l) {
      PetscReal dot = 0;

      for (PetscInt i = 0; i < RIGID_COMPONENTS; ++i) dot += motion[i] * modes->mode[l * RIGID_COMPONENTS + i];
      CHECK_NEAR(dot, k == l, 1e-14);
    }
    for (PetscInt a = 0; a < level->num_owned; ++a) {
      PetscReal u[3];

      RigidModesAt(3, modes->frames, motion, &level->coords[3 * a], u);
      for (PetscInt j = 0; j < support->count[a]; ++j) {
        const PetscReal *d = &support->directions[9 * a + 3 * j];

        CHECK_NEAR(d[0] * u[0] + d[1] * u[1] + d[2] * u[2], 0, 1e-13);
      }
    }
  }
}

/* A block with the displacements of some sides given; sides[i] = NULL ends the list, expected modes are left. */
static void TestBlock(const char *const sides[], const char *const values[], PetscInt expected)
{
  const PetscInt  faces[3] = {2, 3, 2};
  const PetscReal lower[3] = {5, 0, -1}, upper[3] = {6, 2, 1};
  TestScene       t;
  SceneBody      *body;
  Mesh            mesh;
  Support         support;
  RigidModes      modes;

  SolidSceneInit(&t);
  body = SolidSceneAddBox(&t, "block", faces, lower, upper);
  for (PetscInt i = 0; sides[i]; ++i)
    TestSceneAddBoundary(body, values[i] ? BOUNDARY_DISPLACEMENT : BOUNDARY_NORMAL, sides[i], values[i]);
  mesh = TestSceneMesh(&t);
  CHECK(!SupportCreate(MeshFinest(mesh), &t.scene, &support));
  CHECK(!RigidModesCreate(MeshFinest(mesh), &support, 1, &modes));
  CHECK(modes.num == expected && modes.floating[0] == (expected > 0));
  CheckLeft(MeshFinest(mesh), &support, &modes);
  CHECK(!RigidModesDestroy(&modes));
  CHECK(!SupportDestroy(&support));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  /* Cases: nothing; flat sides in all three directions; in two, so that it slides; one side in z alone, which leaves the plane; two
     opposite ones twice, which leaves y; the lower side in x and y, which leaves z and turns about axes in that side; z on the left
     beside, which leaves the turn about their common edge; and on the right, which leaves none; one side altogether. */
  TestBlock((const char *[]){NULL}, NULL, 6);
  TestBlock((const char *[]){"left", "front", "bottom", NULL}, (const char *[]){NULL, NULL, NULL}, 0);
  TestBlock((const char *[]){"left", "front", NULL}, (const char *[]){NULL, NULL}, 1);
  TestBlock((const char *[]){"bottom", NULL}, (const char *[]){NULL}, 3);
  TestBlock((const char *[]){"bottom", "top", "left", "right", NULL}, (const char *[]){NULL, NULL, NULL, NULL}, 1);
  TestBlock((const char *[]){"bottom", NULL}, (const char *[]){"0, 0, free"}, 3);
  TestBlock((const char *[]){"bottom", "left", NULL}, (const char *[]){"0, 0, free", "free, free, 0"}, 1);
  TestBlock((const char *[]){"bottom", "left+right", NULL}, (const char *[]){"0, 0, free", "free, free, 0"}, 0);
  TestBlock((const char *[]){"back", NULL}, (const char *[]){"0, 0, 0"}, 0);
  PetscCall(PetscFinalize());
  return 0;
}
