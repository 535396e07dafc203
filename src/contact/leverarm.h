/* leverarm.h -- constraint rows across a gap: the lever arm of a tie (eq. 5.4), the line of action of a contact row (eq. 4.6). */
#ifndef MORTISE_LEVERARM_H
#define MORTISE_LEVERARM_H

#include "contact/overlappoints.h"

/* The arm v = x - pi(x) of a tied point is carried by the tangent plane of the mortar facet: x moves as pi(x) does, and by
     (v . grad) u - (v . n) grad (u . n) = sum_b block_b u_b,
   grad and n being those of the facet. Of a rigid motion that is its turn times v. Returns whether there is an arm at all; blocks are
   not set if not. [in] size - of the nonmortar facet; [out] blocks - of the mortar facet's nodes [num_nodes][dim][dim] */
PetscBool LeverArmAtPoint(PetscInt dim, const ClipFacet *facet, const ClipFacet *mortar, const ClipPoint *point,
                          PetscReal size, PetscReal blocks[]);

/* Whether the contact directions at the facet's nodes differ. If not, all of them are the direction of the rays. */
PetscBool LeverArmDirectionsDiffer(PetscInt dim, const ClipFacet *facet);

/* The term that joins phi^m_j(pi(x)) in the row of node i, which then meets the mortar facet along its own direction n_i instead of along the
   ray: beside_i . grad phi^m_j. The vector beside_i lies in the tangent plane at pi(x) and ends where x + t n_i meets that plane.
   Not collective. [in] num_rows - the first nodes of the facet; [out] extra - not set if there is no tangent plane
   [num_rows][nodes of the mortar facet] */
PetscBool LeverArmAlongRows(PetscInt dim, PetscInt num_rows, const ClipFacet *facet, const ClipFacet *mortar,
                            const ClipPoint *point, PetscReal extra[]);

#endif
