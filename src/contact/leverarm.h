/* leverarm.h -- lever arms of a tie across a gap (eq. 5.4). */
#ifndef MORTISE_LEVERARM_H
#define MORTISE_LEVERARM_H

#include "contact/overlappoints.h"

/* The arm v = x - pi(x) of a tied point is carried by the tangent plane of the mortar facet: x moves as pi(x) does, and by
     (v . grad) u - (v . n) grad (u . n) = sum_b block_b u_b,
   grad and n being those of the facet. Of a rigid motion that is its turn times v. Returns whether there is an arm at all; blocks are
   not set if not. [in] size - of the nonmortar facet; [out] blocks - of the mortar facet's nodes [num_nodes][dim][dim] */
PetscBool LeverArmAtPoint(PetscInt dim, const ClipFacet *facet, const ClipFacet *mortar, const ClipPoint *point,
                          PetscReal size, PetscReal blocks[]);

#endif
