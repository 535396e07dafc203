/* heldrows.h -- rows of a tie in directions that supports hold at its nodes (eq. 5.5). */
#ifndef MORTISE_HELDROWS_H
#define MORTISE_HELDROWS_H

#include "contact/pair.h"
#include "contact/redistribution.h"

/* Passes the rows of a tie in held directions to the kept nodes a of its side that no support holds,
     arm_a += w_ac Pi_c ( (M_c + arm_c) - (D_c + D_other_c) S^-1 ),  Pi_c u = sum_j d_j (d_j . u),
   with the weights of eq. (5.1). A row without a path to such a node is dropped: all nodes around are held.
   Collective.
   [in] status - of every local node [num_nodes]; [in,out] sums - after RedistributionApply(): its arm is
   replaced or created; [in,out] pair - with D_other and from_nodal; passed is set where a row is passed on */
PetscErrorCode HeldRowsPass(Level *level, const Support *support, const Facets *facets, const MultiplierStatus status[],
                            MortarIntegrals *sums, Pair pair);

#endif
