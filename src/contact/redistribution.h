/* redistribution.h -- the removed-node rule (eq. 5.1). */
#ifndef MORTISE_REDISTRIBUTION_H
#define MORTISE_REDISTRIBUTION_H

#include "contact/mortarintegrals.h"

/* What becomes of a node of the nonmortar side. */
typedef enum { NODE_UNCOVERED, NODE_REMOVED, NODE_KEPT } NodeFate;

/* Spreads the rows of removed nodes c over their kept neighbours a on covered facets, w_ac = 1 / (their number):
     M_a += w_ac M_c (and the arm),  G_a += w_ac G_c,  chain_ac = w_ac D_c + what the sums' own chain has in rows a and c.
   Neighbours follow each other along the lattice of a facet's nodes: the ends of a quadratic facet are neighbours of its
   middle, not of each other.
   Where a removed node has removed neighbours only, their weights are averaged; one that is cut off from every kept node is
   dropped. Collective.
   [in,out] fate  - NodeFate of every local node; nodes whose rows would be eaten up by what they take over are removed as well
                    [num_nodes]
   [in,out] sums  - G, M, arm and chain are replaced
   [out]    chain - node x node, rows of kept nodes; NULL where no row was spread and all nodes may have multipliers */
PetscErrorCode SpreadRemovedRows(Level *level, const Facets *facets, NodeFate fate[], Integrals *sums, Mat *chain);

#endif
