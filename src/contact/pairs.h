/* pairs.h -- all contact pairs, from sides to multipliers. */
#ifndef MORTISE_PAIRS_H
#define MORTISE_PAIRS_H

#include "contact/pair.h"

/* Searches and integrates all pairs of the scene, and decides which nodes have multipliers. A node has none
   where its normal direction is fixed, or where an earlier pair constrains nearly the same direction; these
   rows are redistributed. User errors: an initial overlap outside a given reach; a pair without a node
   because earlier pairs have all of them. Collective.
   [out] pairs - [scene->num_pairs], each owned by the caller */
PetscErrorCode PairsCreate(Scene scene, Level *level, const Support *support, Pair pairs[]);
/* Integrates gaps anew after a change of formulas or offsets, with the same reach. Collective.
   [in,out] pairs - their gaps;
   [out] same - false where other nodes would have multipliers: then pairs are unchanged */
PetscErrorCode PairsUpdateGaps(Scene scene, Level *level, const Support *support, Pair pairs[], PetscBool *same);
#endif
