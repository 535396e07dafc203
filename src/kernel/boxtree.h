/* boxtree.h -- axis-aligned bounding boxes in a median-split tree. */
#ifndef MORTISE_BOXTREE_H
#define MORTISE_BOXTREE_H

#include <petscsys.h>

typedef struct _n_BoxTree *BoxTree;

/* Builds a tree over n boxes in O(n log n). Not collective.
   [in] boxes - [n][2][dim], finite, lower then upper, copied; [out] tree - owned by the caller */
PetscErrorCode BoxTreeCreate(PetscInt dim, PetscInt n, const PetscReal boxes[], BoxTree *tree);
PetscErrorCode BoxTreeDestroy(BoxTree *tree);

/* Bounds of the parts on one level of the tree: at most max (>= 1) boxes of about equally many boxes each,
   which together hold all. An empty tree has none. Not collective.
   [out] cover - borrowed from the tree [num][2][dim] */
PetscErrorCode BoxTreeGetCover(BoxTree tree, PetscInt max, PetscInt *num, const PetscReal *cover[]);

/* The boxes that meet the query box (touching counts), in ascending order of index. Not collective.
   [in] query - [2][dim]; [out] hits - borrowed until the next query, [num_hits] */
PetscErrorCode BoxTreeQuery(BoxTree tree, const PetscReal query[], PetscInt *num_hits, const PetscInt *hits[]);

/* The points x with lower <= direction . x <= upper. */
typedef struct {
  PetscReal direction[3], lower, upper;
} BoxSlab;

/* The boxes that meet the query box and each slab: for long regions that are not along an axis.
   Not collective.
   [in] slabs - [num_slabs]; the rest as BoxTreeQuery() */
PetscErrorCode BoxTreeQuerySlabs(BoxTree tree, const PetscReal query[], PetscInt num_slabs, const BoxSlab slabs[],
                                 PetscInt *num_hits, const PetscInt *hits[]);

#endif
