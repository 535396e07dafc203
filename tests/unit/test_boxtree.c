/* test_boxtree.c -- queries against looking at every box. */
#include "kernel/boxtree.h"
#include "base/compat.h"
#include <test.h>

#include "uniform.h"

enum { MAX_BOXES = 1000, NUM_QUERIES = 200, MAX_DIM = 3 };

/* Integers make boxes touch exactly; a size of 0 makes points. */
static void RandomBox(PetscInt dim, PetscInt span, PetscInt size, PetscReal box[])
{
  for (PetscInt k = 0; k < dim; k++) {
    box[k]       = PetscFloorReal(Uniform(0., span + 1.));
    box[dim + k] = box[k] + PetscFloorReal(Uniform(0., size + 1.));
  }
}

static PetscBool Meet(PetscInt dim, const PetscReal a[], const PetscReal b[])
{
  PetscBool meet = PETSC_TRUE;

  for (PetscInt k = 0; k < dim; k++) {
    if (!(a[k] <= b[dim + k] && b[k] <= a[dim + k])) meet = PETSC_FALSE;
  }
  return meet;
}

/* The hits must be those of the loop over all boxes, in its order. */
static void CheckQuery(BoxTree tree, PetscInt dim, PetscInt n, const PetscReal boxes[], const PetscReal query[])
{
  const PetscInt *hits;
  PetscInt        num_hits, expected = 0;

  PetscCallAbort(PETSC_COMM_SELF, BoxTreeQuery(tree, query, &num_hits, &hits));
  for (PetscInt i = 0; i < n; i++) {
    if (!Meet(dim, query, &boxes[2 * dim * i])) continue;
    CHECK(expected < num_hits);
    CHECK(hits[expected] == i);
    expected++;
  }
  CHECK(num_hits == expected);
}

/* The same with slabs: a box meets one where the corner that goes farthest either way does. */
static void CheckSlabs(BoxTree tree, PetscInt dim, PetscInt n, const PetscReal boxes[], const PetscReal query[])
{
  const PetscInt *hits;
  PetscInt        num_hits, expected = 0;
  BoxSlab         slabs[2];

  for (PetscInt s = 0; s < 2; s++) {
    for (PetscInt k = 0; k < dim; k++) slabs[s].direction[k] = PetscFloorReal(Uniform(-2., 3.));
    slabs[s].lower = PetscFloorReal(Uniform(-30., 30.));
    slabs[s].upper = slabs[s].lower + PetscFloorReal(Uniform(0., 20.));
  }
  PetscCallAbort(PETSC_COMM_SELF, BoxTreeQuerySlabs(tree, query, 2, slabs, &num_hits, &hits));
  for (PetscInt i = 0; i < n; i++) {
    PetscBool meet = Meet(dim, query, &boxes[2 * dim * i]);

    for (PetscInt s = 0; s < 2; s++) {
      PetscReal low = PETSC_MAX_REAL, high = PETSC_MIN_REAL;

      for (PetscInt corner = 0; corner < 1 << dim; corner++) {
        PetscReal x = 0.;

        for (PetscInt k = 0; k < dim; k++)
          x += slabs[s].direction[k] * boxes[2 * dim * i + (corner >> k & 1) * dim + k];
        low  = PetscMin(low, x);
        high = PetscMax(high, x);
      }
      if (low > slabs[s].upper || high < slabs[s].lower) meet = PETSC_FALSE;
    }
    if (!meet) continue;
    CHECK(expected < num_hits);
    CHECK(hits[expected] == i);
    expected++;
  }
  CHECK(num_hits == expected);
}

/* A cover holds every box, in no more boxes than were asked for, and halves as often as it may. */
static void CheckCover(BoxTree tree, PetscInt dim, PetscInt n, const PetscReal boxes[])
{
  for (PetscInt max = 1; max <= 40; max++) {
    const PetscReal *cover;
    PetscInt         num;

    PetscCallAbort(PETSC_COMM_SELF, BoxTreeGetCover(tree, max, &num, &cover));
    CHECK(num <= max && (num > 0) == (n > 0));
    CHECK(n < 17 * max / 2 || 2 * num > max);
    for (PetscInt i = 0; i < n; i++) {
      PetscBool held = PETSC_FALSE;

      for (PetscInt c = 0; c < num && !held; c++) {
        held = PETSC_TRUE;
        for (PetscInt k = 0; k < dim; k++) {
          if (boxes[2 * dim * i + k] < cover[2 * dim * c + k]) held = PETSC_FALSE;
          if (boxes[2 * dim * i + dim + k] > cover[2 * dim * c + dim + k]) held = PETSC_FALSE;
        }
      }
      CHECK(held);
    }
  }
}

/* [in] span, size - largest position and extent of the boxes */
static PetscErrorCode TestRandom(PetscInt dim, PetscInt n, PetscInt span, PetscInt size)
{
  static PetscReal boxes[MAX_BOXES * 2 * MAX_DIM];
  const PetscReal  everything[] = {-1e30, -1e30, -1e30, 1e30, 1e30, 1e30}, nothing[] = {-2., -2., -2., -1., -1., -1.};
  BoxTree          tree;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < n; i++) RandomBox(dim, span, size, &boxes[2 * dim * i]);
  PetscCall(BoxTreeCreate(dim, n, boxes, &tree));
  for (PetscInt q = 0; q < NUM_QUERIES; q++) {
    PetscReal query[2 * MAX_DIM];

    RandomBox(dim, span, q % 4, query);
    CheckQuery(tree, dim, n, boxes, query);
    CheckSlabs(tree, dim, n, boxes, query);
  }
  if (dim == 3) {
    CheckQuery(tree, dim, n, boxes, everything);
    CheckQuery(tree, dim, n, boxes, nothing);
  }
  CheckCover(tree, dim, n, boxes);
  PetscCall(BoxTreeDestroy(&tree));
  CHECK(!tree);
  PetscCall(BoxTreeDestroy(&tree)); /* twice is harmless */
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The boxes are copied: the caller's array may go. */
static PetscErrorCode TestCopy(void)
{
  PetscReal       box[] = {0., 0., 1., 1.}, query[] = {1., 1., 2., 2.};
  const PetscInt *hits;
  PetscInt        num_hits;
  BoxTree         tree;

  PetscFunctionBeginUser;
  PetscCall(BoxTreeCreate(2, 1, box, &tree));
  box[2] = 0.;
  PetscCall(BoxTreeQuery(tree, query, &num_hits, &hits));
  CHECK(num_hits == 1 && hits[0] == 0); /* they touch in a corner */
  PetscCall(BoxTreeDestroy(&tree));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  const PetscInt sizes[] = {0, 1, 2, 8, 9, 16, 17, 33, 100, MAX_BOXES};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (PetscInt dim = 1; dim <= MAX_DIM; dim++) {
    for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(sizes); i++) {
      PetscCall(TestRandom(dim, sizes[i], 20, 3)); /* many touch */
      PetscCall(TestRandom(dim, sizes[i], 20, 0)); /* points */
      PetscCall(TestRandom(dim, sizes[i], 0, 0));  /* all the same point */
      PetscCall(TestRandom(dim, sizes[i], 5, 20)); /* heavy overlap */
    }
  }
  PetscCall(TestCopy());
  PetscCall(PetscFinalize());
  return 0;
}
