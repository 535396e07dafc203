/* slidingnodes.h -- nodes that a support holds along a partner which moves otherwise (sections 5, 16). */
#ifndef MORTISE_SLIDINGNODES_H
#define MORTISE_SLIDINGNODES_H

#include "contact/pair.h"
#include "contact/redistribution.h"

/* Nodes of a nonmortar side that a support holds along its partner, and that slide. Either the mortar side is
   free there, or supports move the two sides along each other. On a plane of symmetry both are held, with the
   same value, and nothing slides. Collective.
   [in] M - of the pair, or NULL for an obstacle; [in] nodes, D - of this rank, weights D_aa [num];
   [out] slides - [num] */
PetscErrorCode SlidingNodesFind(Level *level, const Support *support, Mat M, PetscInt num, const PetscInt nodes[],
                                const PetscReal D[], PetscBool slides[]);

/* The same, at the present time or at any load step. Then nodes with multipliers are those of all steps.
   Collective. */
PetscErrorCode SlidingNodesFindEver(Level *level, const Support *support, Mat M, PetscInt num, const PetscInt nodes[],
                                    const PetscReal D[], PetscBool slides[]);

/* Removes these nodes from a pair with friction. Their neighbours take over the friction and the pressure of
   their part of the side (eq. 5.1). A node without a path to a kept node stays. Collective.
   [in] sums - before RedistributionApply(); [in,out] status - of every local node [num_nodes] */
PetscErrorCode SlidingNodesRemove(Level *level, const Support *support, const Facets *facets,
                                  const MortarIntegrals *sums, MultiplierStatus status[]);

/* SlidingNodesFind() of a pair. Friction has no unknown there. Collective. [out] slides - [pair->num] */
PetscErrorCode SlidingNodesOfPair(const Pair pair, const Support *support, PetscBool slides[]);
/* Whether supports now move nodes along their partners that they did not when the pairs were created: other
   nodes would have multipliers then. Collective. */
PetscErrorCode SlidingNodesElsewhere(Level *level, const Support *support, PetscInt num, const Pair pairs[],
                                     PetscBool *elsewhere);

#endif
