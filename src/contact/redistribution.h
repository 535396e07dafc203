/* redistribution.h -- redistribution of removed constraints (eq. 5.1). */
#ifndef MORTISE_REDISTRIBUTION_H
#define MORTISE_REDISTRIBUTION_H

#include "contact/mortarintegrals.h"

/* Status of a node of the nonmortar side. */
typedef enum { NODE_UNCOVERED, NODE_REMOVED, NODE_KEPT } MultiplierStatus;

/* Weights w_ac with which kept nodes a take over the rows of removed nodes c. Collective.
   [out] W - node x node, owned by the caller; NULL where no row is to be redistributed */
PetscErrorCode RedistributionWeights(Level *level, const Facets *facets, const MultiplierStatus status[],
                                     const MortarIntegrals *sums, Mat *W);

/* Redistributes the rows of removed nodes c to their kept neighbours a on covered facets, w_ac = 1 / (their
     number): M_a += w_ac M_c (and the arm),  G_a += w_ac G_c,  D_other_ac = w_ac D_c + rows a and c of the
     sums' D_other.
   Neighbours are those on the lattice of a facet's nodes: the ends of a quadratic facet are neighbours of its
     middle, not of each other.
   Where a removed node has removed neighbours only, their weights are averaged; one without a path to a kept
     node is dropped. Collective.
   [in,out] status  - MultiplierStatus of every local node; nodes are removed as well if their weight becomes
   too small [num_nodes]
   [in,out] sums  - G, M, arm and D_other are replaced
   [out]    D_other - node x node, rows of kept nodes; NULL if no row moved and all nodes may have them */
PetscErrorCode RedistributionApply(Level *level, const Facets *facets, MultiplierStatus status[], MortarIntegrals *sums,
                                   Mat *D_other);

#endif
