/* test_rigid.c -- which supports leave a body a rigid motion. */
#include <mortise/compat.h>
#include <mortise/rigid.h>
#include "mesh_scene.h"
#include "solid_scene.h"

/* A block with the displacements of some sides given; sides[i] = NULL ends the list. */
static void TestBlock(const char *const sides[], const char *const values[], PetscBool expected)
{
  const PetscInt  faces[3] = {2, 3, 2};
  const PetscReal lower[3] = {5, 0, -1}, upper[3] = {6, 2, 1};
  TestScene       t;
  SceneBody      *body;
  Mesh            mesh;
  Support         support;
  PetscBool       floating;

  SolidSceneInit(&t);
  body = SolidSceneAddBox(&t, "block", faces, lower, upper);
  for (PetscInt i = 0; sides[i]; ++i)
    TestSceneAddBoundary(body, values[i] ? BOUNDARY_DISPLACEMENT : BOUNDARY_NORMAL, sides[i], values[i]);
  mesh = TestSceneMesh(&t);
  CHECK(!SupportCreate(MeshFinest(mesh), &t.scene, &support));
  CHECK(!BodiesFloating(MeshFinest(mesh), &support, 1, &floating));
  CHECK(floating == expected);
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
  TestBlock((const char *[]){NULL}, NULL, PETSC_TRUE);
  TestBlock((const char *[]){"left", "front", "bottom", NULL}, (const char *[]){NULL, NULL, NULL}, PETSC_FALSE);
  TestBlock((const char *[]){"left", "front", NULL}, (const char *[]){NULL, NULL}, PETSC_TRUE);
  TestBlock((const char *[]){"bottom", NULL}, (const char *[]){NULL}, PETSC_TRUE);
  TestBlock((const char *[]){"bottom", "top", "left", "right", NULL}, (const char *[]){NULL, NULL, NULL, NULL},
            PETSC_TRUE);
  TestBlock((const char *[]){"bottom", NULL}, (const char *[]){"0, 0, free"}, PETSC_TRUE);
  TestBlock((const char *[]){"bottom", "left", NULL}, (const char *[]){"0, 0, free", "free, free, 0"}, PETSC_TRUE);
  TestBlock((const char *[]){"bottom", "left+right", NULL}, (const char *[]){"0, 0, free", "free, free, 0"},
            PETSC_FALSE);
  TestBlock((const char *[]){"back", NULL}, (const char *[]){"0, 0, 0"}, PETSC_FALSE);
  PetscCall(PetscFinalize());
  return 0;
}
