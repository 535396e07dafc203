/* test_patchinverse.c -- inverses of the matrices of patches: products, equal matrices, omitted and stiff unknowns. */
#include "base/compat.h"
#include "multigrid/patchinverse.h"
#include "test.h"

enum { MOST = 81 };

/* 1/2 on the diagonal, and a nearly singular part: (1/2 + stiff) v v' of a vector v of length 1, scaled to a diagonal of 1. */
static void SetMatrix(PetscInt num, PetscReal stiff, PetscReal A[])
{
  PetscReal v[MOST], root[MOST], length = 0;

  for (PetscInt i = 0; i < num; i++) v[i] = PetscSinReal((PetscReal)(3 * i + 1));
  for (PetscInt i = 0; i < num; i++) length += PetscSqr(v[i]);
  for (PetscInt i = 0; i < num; i++) root[i] = 1 / PetscSqrtReal(0.5 + stiff * PetscSqr(v[i]) / length);
  for (PetscInt i = 0; i < num; i++)
    for (PetscInt j = 0; j < num; j++)
      A[i * num + j] = root[i] * root[j] * ((i == j ? 0.5 : 0) + stiff * v[i] * v[j] / length);
}

/* The largest entry of A z - r where z = A^-1 r, for two patches that share their last node.
   [in] omitted - an unknown, or -1 */
static PetscReal Error(PatchInverse inverse, PetscInt dim, PetscInt num, const PetscReal A[], PetscInt omitted)
{
  const PetscInt     n           = num / dim;
  PetscInt           start[3]    = {0, n, 2 * n}, node[2 * MOST];
  PetscReal          r[2 * MOST] = {0}, z[2 * MOST] = {0}, off = 0;
  float              work[2 * MOST + 16];
  GraphPatches       patches = {.num = 1, .start = start, .node = node};
  const PatchInverse both[2] = {inverse, inverse};

  CHECK(PatchInverseWork(num) <= 2 * MOST + 16);
  for (PetscInt i = 0; i < n; i++) node[i] = n - 1 - i;
  for (PetscInt i = 0; i < n; i++) node[n + i] = n + i;
  for (PetscInt i = 0; i < num; i++) r[i] = PetscCosReal((PetscReal)(5 * i));
  PatchInverseAdd(&patches, both, dim, r, z, work);
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt at  = dim * node[i / dim] + i % dim;
    PetscReal      sum = -r[at];

    for (PetscInt j = 0; j < num; j++) sum += A[i * num + j] * z[dim * node[j / dim] + j % dim];
    if (i == omitted) CHECK(z[at] == 0);
    if (i != omitted) off = PetscMax(off, PetscAbsReal(sum));
  }
  patches.num = 2; // the second one adds to other nodes, the first one the same again
  PatchInverseAdd(&patches, both, dim, r, z, work);
  for (PetscInt i = num; i < 2 * num; i++) CHECK(z[i] == 0);
  return off;
}

static void TestSize(PetscInt dim, PetscInt n)
{
  const PetscInt num = dim * n;
  PetscReal      A[MOST * MOST], copy[MOST * MOST];
  PatchInverse   inverse, again, other;
  PatchInverses  inverses;

  CHECK(!PatchInversesCreate(MOST, &inverses));
  SetMatrix(num, 100, A);
  CHECK(!PetscArraycpy(copy, A, num * num));
  CHECK(!PatchInversesGet(inverses, num, copy, &inverse));
  CHECK(Error(inverse, dim, num, A, -1) < 1e-4);
  CHECK(!PetscArraycpy(copy, A, num * num));
  copy[num] = copy[1] = A[1] * (1 + 1e-13); // equal up to roundoff
  CHECK(!PatchInversesGet(inverses, num, copy, &again));
  CHECK(again == inverse);
  CHECK(!PetscArraycpy(copy, A, num * num));
  for (PetscInt j = 0; j < num; j++) A[num + j] = A[j * num + 1] = copy[num + j] = copy[j * num + 1] = 0;
  CHECK(!PatchInversesGet(inverses, num, copy, &other));
  CHECK(other != inverse);
  CHECK(Error(other, dim, num, A, 1) < 1e-4);
  CHECK(!PatchInversesDestroy(&inverses));
  CHECK(!PatchInverseDestroy(&again));
  SetMatrix(num, 100, A);
  CHECK(Error(inverse, dim, num, A, -1) < 1e-4); // still there
  CHECK(!PatchInverseDestroy(&inverse));
  CHECK(!PatchInverseDestroy(&other));
}

/* Single precision would spoil these: sums of stiff unknowns cancel. */
static void TestStiff(void)
{
  PetscReal     A[24 * 24], copy[24 * 24];
  PatchInverse  inverse;
  PatchInverses inverses;

  CHECK(!PatchInversesCreate(24, &inverses));
  SetMatrix(24, 1e7, A);
  CHECK(!PetscArraycpy(copy, A, 24 * 24));
  CHECK(!PatchInversesGet(inverses, 24, copy, &inverse));
  CHECK(Error(inverse, 3, 24, A, -1) < 1e-6);
  CHECK(!PatchInverseDestroy(&inverse));
  for (PetscInt i = 0; i < 4; i++) A[i] = copy[i] = i % 3 ? 2 : 1; // indefinite: of its diagonal
  CHECK(!PatchInversesGet(inverses, 2, copy, &inverse));
  A[1] = A[2] = 0;
  CHECK(Error(inverse, 2, 2, A, -1) < 1e-6);
  CHECK(!PatchInverseDestroy(&inverse));
  CHECK(!PatchInversesDestroy(&inverses));
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL));
  TestSize(2, 1);
  TestSize(2, 4);
  TestSize(2, 9);
  TestSize(3, 5);
  TestSize(3, 8);
  TestSize(3, 27);
  TestStiff();
  CHECK(!PetscFinalize());
  return 0;
}
