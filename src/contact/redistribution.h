/* redistribution.h -- redistribution of removed constraints (eq. 5.1). */
#ifndef MORTISE_REDISTRIBUTION_H
#define MORTISE_REDISTRIBUTION_H

#include "contact/mortarintegrals.h"

/* Status of a node of the nonmortar side. */
typedef enum { NODE_UNCOVERED, NODE_REMOVED, NODE_KEPT } MultiplierStatus;

/* Redistributes the rows of removed nodes c to their kept neighbours a on covered facets, w_ac = 1 / (their number):
     M_a += w_ac M_c (and the arm),  G_a += w_ac G_c,  D_other_ac = w_ac D_c + what the sums' own D_other has in rows a and c.
   Neighbours follow each other along the lattice of a facet's nodes: the ends of a quadratic facet are neighbours of its
   middle, not of each other.
   Where a removed node has removed neighbours only, their weights are averaged; one that is cut off from every kept node is
   dropped. Collective.
   [in,out] status  - MultiplierStatus of every local node; nodes whose rows would vanish beside those that they take over are removed as well
                    [num_nodes]
   [in,out] sums  - G, M, arm and D_other are replaced
   [out]    D_other - node x node, rows of kept nodes; NULL where no row was redistributed and all nodes may have multipliers */
PetscErrorCode RedistributionApply(Level *level, const Facets *facets, MultiplierStatus status[], MortarIntegrals *sums,
                                   Mat *D_other);

#endif
