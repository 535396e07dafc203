/* leverarm.h -- constraint rows across a gap: the lever arm of a tie (eq. 5.4), the line of action of a
   contact row (eq. 4.6). */
#ifndef MORTISE_LEVERARM_H
#define MORTISE_LEVERARM_H

#include "contact/overlappoints.h"

/* The arm v = x - pi(x) of a tied point moves with the tangent plane of the mortar facet: x moves as pi(x),
     and by (v . grad) u - (v . n) grad (u . n) = sum_b block_b u_b,
   with grad and n of the facet. For a rigid motion that is its rotation of v. Returns whether there is an
     arm; else blocks are
   not set. Not collective.
     [in] size - of the nonmortar facet; [out] blocks - of the nodes of the mortar facet
   [num_nodes][dim][dim] */
PetscBool LeverArmAtPoint(PetscInt dim, const ClipFacet *facet, const ClipFacet *mortar, const ClipPoint *point,
                          PetscReal size, PetscReal blocks[]);

/* Whether the contact directions at the facet's nodes differ. If not, all are the direction of the rays.
   Not collective. */
PetscBool LeverArmDirectionsDiffer(PetscInt dim, const ClipFacet *facet);

/* The term beside phi^m_j(pi(x)) in the row of node i, which moves its line of action from the ray to the
   direction n_i: beside_i . grad phi^m_j. The vector beside_i lies in the tangent plane at pi(x), and ends
   where x + t n_i meets that plane. Returns whether there is a tangent plane; else extra is not set.
   Not collective.
   [in] rows - directions n_i of the rows [num_rows][dim];
   [out] extra - [num_rows][nodes of the mortar facet] */
PetscBool LeverArmAlongRows(PetscInt dim, PetscInt num_rows, const PetscReal rows[], const ClipFacet *facet,
                            const ClipFacet *mortar, const ClipPoint *point, PetscReal extra[]);

#endif
