/* test_skeleton.c -- facets and edges between cells and vertices, against those that PETSc finds. */
#include "bodies/bodylist.h"
#include "bodies/plexlist.h"
#include "shuffled_boxes.h"

static void TestInterpolate(PetscInt dim)
{
  BodyList  lists[2];
  Numbering numbering;
  DM        dm, cells, whole;

  MakeShuffledBoxes(dim, lists);
  CHECK(!NumberingCreate(2, lists, &numbering));
  CHECK(!PlexCreate(PETSC_COMM_SELF, dim, lists, &numbering, &dm));
  CHECK(!DMPlexCheckSymmetry(dm));
  CHECK(!DMPlexCheckSkeleton(dm, 0));
  CHECK(!DMPlexCheckFaces(dm, 0));
  CHECK(!DMPlexUninterpolate(dm, &cells));
  CHECK(!DMPlexInterpolate(cells, &whole));
  CheckSame(dm, whole);
  CHECK(!DMDestroy(&whole));
  CHECK(!DMDestroy(&cells));
  CHECK(!DMDestroy(&dm));
  CHECK(!NumberingDestroy(&numbering));
  for (int k = 0; k < 2; ++k) CHECK(!BodyListDestroy(&lists[k]));
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  TestInterpolate(2);
  TestInterpolate(3);
  CHECK(!PetscFinalize());
  return 0;
}
