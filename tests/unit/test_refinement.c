/* test_refinement.c -- refined meshes, against those of PETSc's own transform. */
#include "bodies/bodylist.h"
#include "bodies/plexlist.h"
#include "refinement/refinement.h"
#include <petscdmplextransform.h>
#include <petscsf.h>
#include "shuffled_boxes.h"

/* Boxes of two types of cells, made on the first rank and distributed, with a label on some points. */
static void MakeMesh(PetscInt dim, DM *dm)
{
  BodyList         lists[2] = {{.dim = dim}, {.dim = dim}};
  Numbering        numbering;
  PetscPartitioner partitioner;
  PetscMPIInt      rank;
  PetscInt         begin, end;
  DM               parts;

  CHECK(!MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (!rank) MakeShuffledBoxes(dim, lists);
  CHECK(!NumberingCreate(2, lists, &numbering));
  CHECK(!PlexCreate(PETSC_COMM_WORLD, dim, lists, &numbering, dm));
  CHECK(!NumberingDestroy(&numbering));
  for (int k = 0; k < 2; ++k) CHECK(!BodyListDestroy(&lists[k]));
  CHECK(!DMPlexGetPartitioner(*dm, &partitioner));
  CHECK(!PetscPartitionerSetType(partitioner, PETSCPARTITIONERSIMPLE));
  CHECK(!DMPlexDistribute(*dm, 0, NULL, &parts));
  if (parts) {
    CHECK(!DMDestroy(dm));
    *dm = parts;
  }
  CHECK(!DMCreateLabel(*dm, "some"));
  CHECK(!DMPlexGetChart(*dm, &begin, &end));
  for (PetscInt p = begin; p < end; ++p)
    if (p % 5) CHECK(!DMSetLabelValue(*dm, "some", p, p % 5));
}

static void CheckSameLabel(DM a, DM b)
{
  for (PetscInt value = 1; value < 5; ++value) {
    IS        is[2];
    PetscBool same = PETSC_FALSE;

    CHECK(!DMGetStratumIS(a, "some", value, &is[0]));
    CHECK(!DMGetStratumIS(b, "some", value, &is[1]));
    if (is[0] && is[1]) CHECK(!ISEqualUnsorted(is[0], is[1], &same));
    CHECK(same || (!is[0] && !is[1]));
    for (int k = 0; k < 2; ++k) CHECK(!ISDestroy(&is[k]));
  }
}

static void CheckSameShared(DM a, DM b)
{
  PetscInt           roots[2], leaves[2];
  const PetscInt    *point[2];
  const PetscSFNode *node[2];
  DM                 dm[2] = {a, b};

  for (int k = 0; k < 2; ++k) {
    PetscSF sf;

    CHECK(!DMGetPointSF(dm[k], &sf));
    CHECK(!PetscSFGetGraph(sf, &roots[k], &leaves[k], &point[k], &node[k]));
  }
  CHECK(roots[0] == roots[1] && leaves[0] == leaves[1]);
  for (PetscInt i = 0; i < leaves[0]; ++i) {
    CHECK((point[0] ? point[0][i] : i) == (point[1] ? point[1][i] : i));
    CHECK(node[0][i].rank == node[1][i].rank && node[0][i].index == node[1][i].index);
  }
}

static void CheckSamePositions(DM a, DM b)
{
  DM                 dm[2] = {a, b};
  const PetscScalar *x[2];
  PetscInt           size[2];
  Vec                v[2];

  for (int k = 0; k < 2; ++k) {
    CHECK(!DMGetCoordinatesLocal(dm[k], &v[k]));
    CHECK(!VecGetLocalSize(v[k], &size[k]));
    CHECK(!VecGetArrayRead(v[k], &x[k]));
  }
  CHECK(size[0] == size[1]);
  for (PetscInt i = 0; i < size[0]; ++i) CHECK_NEAR(PetscRealPart(x[0][i]), PetscRealPart(x[1][i]), 1e-15);
  for (int k = 0; k < 2; ++k) CHECK(!VecRestoreArrayRead(v[k], &x[k]));
}

/* The origin of every fine point. */
static void CheckSources(const Refinement *refinement, DMPlexTransform transform, DM fine)
{
  PetscInt begin, end;

  CHECK(!DMPlexGetChart(fine, &begin, &end));
  for (PetscInt p = begin; p < end; ++p) {
    DMPolytopeType source, type;
    PetscInt       point, replica;
    PetscBool      vertex;

    CHECK(!DMPlexTransformGetSourcePoint(transform, p, &source, &type, &point, &replica));
    CHECK(RefinementGetSource(refinement, p, &vertex) == point);
    CHECK(vertex == (source == DM_POLYTOPE_POINT ? PETSC_TRUE : PETSC_FALSE));
  }
}

/* Twice: the second time, points have what the first refinement gave them. */
static void TestRefine(PetscInt dim)
{
  DM coarse;

  MakeMesh(dim, &coarse);
  for (int times = 0; times < 2; ++times) {
    DMPlexTransform transform;
    Refinement      refinement;
    DM              fine, expected;

    CHECK(!DMPlexTransformCreate(PETSC_COMM_WORLD, &transform));
    CHECK(!DMPlexTransformSetDM(transform, coarse));
    CHECK(!DMPlexTransformSetType(transform, DMPLEXREFINEREGULAR));
    CHECK(!DMPlexTransformSetUp(transform));
    CHECK(!DMPlexTransformApply(transform, coarse, &expected));
    CHECK(!RefinementCreate(coarse, &refinement, &fine));
    CheckSame(expected, fine);
    CheckSameLabel(expected, fine);
    CheckSameShared(expected, fine);
    CheckSamePositions(expected, fine);
    CheckSources(&refinement, transform, fine);
    CHECK(!DMPlexCheckSymmetry(fine));
    CHECK(!DMPlexTransformDestroy(&transform));
    CHECK(!DMDestroy(&expected));
    CHECK(!DMDestroy(&coarse));
    coarse = fine;
  }
  CHECK(!DMDestroy(&coarse));
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  TestRefine(2);
  TestRefine(3);
  CHECK(!PetscFinalize());
  return 0;
}
