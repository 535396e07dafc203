/* test_affine.c -- linear functions at one place by values at others: whatever the places, and of the nearest ones. */
#include "multigrid/barycentric.h"
#include "test.h"

enum { DIM_MAX = 3 };

/* Weights of absolute values summed up; that they give linear functions, with no more than dim + 1 of them. */
static PetscReal Judge(PetscInt dim, PetscInt num, const PetscReal d[], const PetscReal w[])
{
  PetscReal sum = 0, size = 0, at[DIM_MAX] = {0};
  PetscInt  used = 0;

  for (PetscInt j = 0; j < num; j++) {
    used += w[j] != 0;
    sum += w[j];
    size += PetscAbsReal(w[j]);
    for (PetscInt k = 0; k < dim; k++) at[k] += w[j] * d[j * dim + k];
  }
  CHECK_NEAR(sum, 1, 1e-12);
  for (PetscInt k = 0; k < dim; k++) CHECK_NEAR(at[k], 0, 1e-12);
  CHECK(used <= dim + 1);
  return size;
}

/* Of four corners of a square and a fifth one nearby the triangle with the fifth is chosen, as Delaunay's circles say. */
static void TestNearest(void)
{
  const PetscReal d[] = {-1, -1, 1, -1, 1, 1, -1, 1, 0.2, 0.3};
  PetscReal       w[5];

  CHECK(BarycentricWeights(2, 5, d, w));
  CHECK_NEAR(Judge(2, 5, d, w), 1, 1e-12);
  CHECK(w[4] > 0.5 && w[0] > 0 && w[2] == 0);
}

/* The middle of two places is halves of both, whatever else there is. */
static void TestMiddle(void)
{
  const PetscReal d[] = {-0.5, 0, 0, 0.5, 0, 0, 0, 2, 0, 0, -1, 2, 0, -1, -2};
  PetscReal       w[5];

  CHECK(BarycentricWeights(3, 5, d, w));
  CHECK_NEAR(Judge(3, 5, d, w), 1, 1e-12);
  CHECK_NEAR(w[0], 0.5, 1e-12);
  CHECK_NEAR(w[1], 0.5, 1e-12);
}

/* A little outside of all places weights are negative, far outside there are none. Nor are there any where
   places lie in a plane and this one does not. */
static void TestOutside(void)
{
  const PetscReal flat[] = {0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
  PetscReal       d[]    = {0.1, 0, 0.1, 1, 0.6, 0.4}, w[4];

  CHECK(BarycentricWeights(2, 3, d, w));
  CHECK(Judge(2, 3, d, w) > 1);
  for (PetscInt j = 0; j < 3; j++) d[2 * j] += 5;
  CHECK(!BarycentricWeights(2, 3, d, w));
  CHECK(!BarycentricWeights(3, 4, flat, w));
  CHECK(!BarycentricWeights(2, 0, NULL, w));
}

/* Places all around, on a lattice, of which many are on one circle: rounding must not decide whether there is an end. */
static void TestLattice(void)
{
  PetscReal d[BARYCENTRIC_MAX * 3], w[BARYCENTRIC_MAX];
  PetscInt  num = 0;

  for (PetscInt i = 0; i < 27; i++) {
    d[num * 3]     = (PetscReal)(i % 3) - 0.5;
    d[num * 3 + 1] = (PetscReal)(i / 3 % 3) - 0.5;
    d[num * 3 + 2] = (PetscReal)(i / 9) - 0.5;
    num++;
  }
  CHECK(BarycentricWeights(3, num, d, w));
  CHECK_NEAR(Judge(3, num, d, w), 1, 1e-12);
  for (PetscInt j = 0; j < num; j++) CHECK(w[j] == 0 || (PetscAbsReal(d[j * 3]) < 1 && PetscAbsReal(d[j * 3 + 1]) < 1));
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  TestNearest();
  TestMiddle();
  TestOutside();
  TestLattice();
  PetscCall(PetscFinalize());
  return 0;
}
