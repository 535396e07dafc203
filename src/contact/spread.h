/* spread.h -- the removed-node rule (private to the room; numerics.md 4.3). */
#ifndef MORTISE_SPREAD_H
#define MORTISE_SPREAD_H

#include <mortise/mesh.h>

/* What becomes of a node of the nonmortar side. */
typedef enum { NODE_UNCOVERED, NODE_REMOVED, NODE_KEPT } NodeFate;

/* Spreads the rows of removed nodes c over their kept neighbours a on covered facets, w_ac = 1 / (their number):
     M_a += w_ac M_c,  G_a += w_ac G_c,  chain_ac = w_ac D_c.
   Where a removed node has removed neighbours only, their weights are averaged; one that is cut off from every kept node is
   dropped. Collective.
   [in]     fate    - NodeFate of every local node [num_nodes]
   [in]     covered - of this rank's facets: whether the facet is covered at all [facets->num]
   [in]     D       - ghosted, one per node
   [in,out] G       - ghosted, one per node; [in,out] M - node x node or NULL, replaced; [out] chain - node x node, or NULL */
PetscErrorCode SpreadRemovedRows(Level *level, const Facets *facets, const NodeFate fate[], const PetscBool covered[],
                                 Vec D, Vec G, Mat *M, Mat *chain);

#endif
