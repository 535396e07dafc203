/* test_pieces.c -- bodies fall into pieces that hang together, in an order of their own, whoever holds which cells. */
#include "base/compat.h"
#include "support/components.h"
#include "mesh_scene.h"

/* A long strip, which has parts on all ranks, and a body of two squares from a file. */
int main(int argc, char **argv)
{
  const PetscInt  body[3]   = {0, 1, 1};
  const PetscReal box[3][4] = {{40, -2, 0, 3}, {1, 1, 0, 0}, {3, 1, -2, 0}}; // largest, smallest with the opposite sign
  const PetscInt  asked[3]  = {-1, 0, -1};
  PetscInt        found[3], count[3] = {0, 0, 0};
  TestScene       t;
  Mesh            mesh;
  Level          *level;
  Components      pieces;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestSceneInit(&t);
  TestSceneAddBox(&t, "strip", 60, 2, 0, -3, 40, -2);
  TestSceneAddFile(&t, "lids", MESHES "/../../hard/pieces.msh", NULL);
  mesh  = TestSceneMesh(&t);
  level = MeshFinest(mesh);
  CHECK(!ComponentsCreate(level, &pieces));
  CHECK(pieces.num == 3);
  CHECK(ComponentsOfBody(&pieces, 0) == 1 && ComponentsOfBody(&pieces, 1) == 2);
  for (PetscInt i = 0; i < 3; ++i) {
    CHECK(pieces.body[i] == body[i]);
    for (PetscInt k = 0; k < 2; ++k) {
      CHECK_NEAR(pieces.box[i * COMPONENT_BOX + k], box[i][k], 1e-14);
      CHECK_NEAR(pieces.box[i * COMPONENT_BOX + 3 + k], box[i][2 + k], 1e-14);
    }
    CHECK(pieces.box[i * COMPONENT_BOX + 2] == 0 && pieces.box[i * COMPONENT_BOX + 5] == 0);
  }
  for (PetscInt i = 0; i < level->num_nodes; ++i)
    CHECK(pieces.of_node[i] == (level->node_body[i] == 0 ? 0 : level->coords[2 * i] < 1.5 ? 1 : 2));
  for (PetscInt a = 0; a < level->num_owned; ++a) ++count[pieces.of_node[a]];
  CHECK(Total((PetscReal)count[0]) == 61 * 3 && Total((PetscReal)count[1]) == 25 && Total((PetscReal)count[2]) == 25);
  CHECK(!ComponentsOfGlobalNodes(level, &pieces, 3, asked, found));
  CHECK(found[0] == -1 && found[1] >= 0 && found[2] == -1);
  CHECK(!ComponentsDestroy(&pieces));
  CHECK(!MeshDestroy(&mesh));
  TestSceneFree(&t);
  PetscCall(PetscFinalize());
  return 0;
}
