/* boxtree.c -- a balanced tree over boxes, halved at the median centre of the widest direction.

   The tree is implicit. The boxes are permuted so that every node is a range [begin, end), halved in the
   middle. Node k has its children at 2k + 1 and 2k + 2. Only the bounds of the nodes are stored. Halving by
   count keeps the tree shallow whatever the grading of a mesh: a query takes O(log n) plus its hits.

   Reference:
     [1] C. Ericson, Real-Time Collision Detection (2005), sections 6.2 and 6.6. */
#include "kernel/boxtree.h"
#include "base/compat.h"

enum { LEAF_SIZE = 8, MAX_DIM = 3 };

struct _n_BoxTree {
  PetscInt   dim, n;
  PetscInt  *order;  /* index of the box at each place [n] */
  PetscReal *boxes;  /* by original index [n][2][dim] */
  PetscReal *bounds; /* of the nodes [num_nodes][2][dim] */
  PetscInt  *hits;   /* of the last query [n] */
};

/* Compares (twice) the centres of two boxes; the index breaks ties, so that equal centres have an order,
   too. */
static PetscBool BoxTreeIsBefore_Private(BoxTree tree, PetscInt axis, PetscInt a, PetscInt b)
{
  const PetscReal *A = &tree->boxes[2 * a * tree->dim + axis], *B = &tree->boxes[2 * b * tree->dim + axis];
  const PetscReal  centre_a = A[0] + A[tree->dim], centre_b = B[0] + B[tree->dim];

  return centre_a < centre_b || (centre_a == centre_b && a < b) ? PETSC_TRUE : PETSC_FALSE;
}

/* Partially sorts order[begin..end) along the axis: the box at middle is in its place, smaller ones are
   before it, larger ones behind it. Hoare's selection, linear time on average. */
static void BoxTreeSelect_Private(BoxTree tree, PetscInt axis, PetscInt begin, PetscInt middle, PetscInt end)
{
  PetscInt *order = tree->order, left = begin, right = end - 1;

  while (left < right) {
    const PetscInt pivot = order[left + (right - left) / 2];
    PetscInt       i = left, j = right;

    while (i <= j) {
      while (BoxTreeIsBefore_Private(tree, axis, order[i], pivot)) i++;
      while (BoxTreeIsBefore_Private(tree, axis, pivot, order[j])) j--;
      if (i <= j) { /* also where i = j: both must pass the pivot for the loop to end */
        const PetscInt swap = order[i];

        order[i++] = order[j];
        order[j--] = swap;
      }
    }
    if (middle <= j)
      right = j;
    else if (middle >= i)
      left = i;
    else
      return;
  }
}

/* The direction in which halving separates most. */
static PetscInt BoxTreeWidestAxis_Private(PetscInt dim, const PetscReal bounds[])
{
  PetscInt widest = 0;

  for (PetscInt k = 1; k < dim; k++) {
    if (bounds[dim + k] - bounds[k] > bounds[dim + widest] - bounds[widest]) widest = k;
  }
  return widest;
}

/* Bounds of the node that holds order[begin..end), then its two halves. */
static void BoxTreeBuild_Private(BoxTree tree, PetscInt node, PetscInt begin, PetscInt end)
{
  const PetscInt dim = tree->dim, middle = begin + (end - begin) / 2;
  PetscReal     *bounds = &tree->bounds[2 * node * dim];

  for (PetscInt k = 0; k < dim; k++) {
    bounds[k]       = PETSC_MAX_REAL;
    bounds[dim + k] = PETSC_MIN_REAL;
    for (PetscInt i = begin; i < end; i++) {
      const PetscReal *box = &tree->boxes[2 * tree->order[i] * dim];

      bounds[k]       = PetscMin(bounds[k], box[k]);
      bounds[dim + k] = PetscMax(bounds[dim + k], box[dim + k]);
    }
  }
  if (end - begin <= LEAF_SIZE) return;
  BoxTreeSelect_Private(tree, BoxTreeWidestAxis_Private(dim, bounds), begin, middle, end);
  BoxTreeBuild_Private(tree, 2 * node + 1, begin, middle);
  BoxTreeBuild_Private(tree, 2 * node + 2, middle, end);
}

PetscErrorCode BoxTreeCreate(PetscInt dim, PetscInt n, const PetscReal boxes[], BoxTree *tree)
{
  PetscInt num_nodes = 1;

  PetscFunctionBeginUser;
  PetscCheck(dim >= 1 && dim <= MAX_DIM, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "Boxes of dimension %" PetscInt_FMT,
             dim);
  /* The larger half of n boxes has ceil(n/2) of them; a level of the tree doubles its nodes. */
  for (PetscInt largest = n; largest > LEAF_SIZE; largest = (largest + 1) / 2) num_nodes = 2 * num_nodes + 1;
  PetscCall(PetscNew(tree));
  (*tree)->dim = dim;
  (*tree)->n   = n;
  PetscCall(PetscMalloc4(n, &(*tree)->order, 2 * n * dim, &(*tree)->boxes, 2 * num_nodes * dim, &(*tree)->bounds, n,
                         &(*tree)->hits));
  PetscCall(PetscArraycpy((*tree)->boxes, boxes, 2 * n * dim));
  for (PetscInt i = 0; i < n; i++) (*tree)->order[i] = i;
  BoxTreeBuild_Private(*tree, 0, 0, n);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BoxTreeDestroy(BoxTree *tree)
{
  PetscFunctionBeginUser;
  if (!*tree) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscFree4((*tree)->order, (*tree)->boxes, (*tree)->bounds, (*tree)->hits));
  PetscCall(PetscFree(*tree));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BoxTreeGetCover(BoxTree tree, PetscInt max, PetscInt *num, const PetscReal *cover[])
{
  PetscInt width = 1;

  PetscFunctionBeginUser;
  /* the smallest node of a level holds floor(n / width) boxes, and all are halved if that one is */
  while (2 * width <= max && tree->n / width > LEAF_SIZE) width *= 2;
  *num   = tree->n ? width : 0;
  *cover = &tree->bounds[2 * (width - 1) * tree->dim];
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether two boxes [2][dim] have a point in common; touching counts. */
static PetscBool BoxTreeBoxesMeet_Private(PetscInt dim, const PetscReal a[], const PetscReal b[])
{
  for (PetscInt k = 0; k < dim; k++) {
    if (a[k] > b[dim + k] || b[k] > a[dim + k]) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* The region of a query. */
typedef struct {
  const PetscReal *box;
  PetscInt         num_slabs;
  const BoxSlab   *slabs;
} Region;

/* Whether a box meets the region's box and each of its slabs. */
static PetscBool BoxTreeRegionMeets_Private(PetscInt dim, const Region *region, const PetscReal box[])
{
  if (!BoxTreeBoxesMeet_Private(dim, region->box, box)) return PETSC_FALSE;
  for (PetscInt s = 0; s < region->num_slabs; s++) {
    const BoxSlab *slab = &region->slabs[s];
    PetscReal      low = 0., high = 0.; // of direction . x in the box
    for (PetscInt k = 0; k < dim; k++) {
      const PetscReal d = slab->direction[k];
      low += d * box[d < 0. ? dim + k : k];
      high += d * box[d < 0. ? k : dim + k];
    }
    if (low > slab->upper || high < slab->lower) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Collects the hits below one node, which holds order[begin..end). */
static void BoxTreeQuery_Private(BoxTree tree, const Region *region, PetscInt node, PetscInt begin, PetscInt end,
                                 PetscInt *num_hits)
{
  const PetscInt dim = tree->dim, middle = begin + (end - begin) / 2;

  if (!BoxTreeRegionMeets_Private(dim, region, &tree->bounds[2 * node * dim])) return;
  if (end - begin <= LEAF_SIZE) {
    for (PetscInt i = begin; i < end; i++) {
      if (BoxTreeRegionMeets_Private(dim, region, &tree->boxes[2 * tree->order[i] * dim]))
        tree->hits[(*num_hits)++] = tree->order[i];
    }
    return;
  }
  BoxTreeQuery_Private(tree, region, 2 * node + 1, begin, middle, num_hits);
  BoxTreeQuery_Private(tree, region, 2 * node + 2, middle, end, num_hits);
}

PetscErrorCode BoxTreeQuerySlabs(BoxTree tree, const PetscReal query[], PetscInt num_slabs, const BoxSlab slabs[],
                                 PetscInt *num_hits, const PetscInt *hits[])
{
  const Region region = {query, num_slabs, slabs};

  PetscFunctionBeginUser;
  *num_hits = 0;
  BoxTreeQuery_Private(tree, &region, 0, 0, tree->n, num_hits);
  PetscCall(PetscSortInt(*num_hits, tree->hits)); /* sums over the hits must not depend on the shape of the tree */
  *hits = tree->hits;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode BoxTreeQuery(BoxTree tree, const PetscReal query[], PetscInt *num_hits, const PetscInt *hits[])
{
  PetscFunctionBeginUser;
  PetscCall(BoxTreeQuerySlabs(tree, query, 0, NULL, num_hits, hits));
  PetscFunctionReturn(PETSC_SUCCESS);
}
