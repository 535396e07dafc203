/* contactnormal.h -- the direction of contact at nodes of the nonmortar side (eq. 4.3). */
#ifndef MORTISE_CONTACTNORMAL_H
#define MORTISE_CONTACTNORMAL_H

#include "contact/overlappoints.h"

/* Directions of contact at the nodes of the nonmortar side, between its own normals and the partner's, by the
   curvatures of both (eq. 4.3). A node that faces no partner within reach takes the direction of its facets'
   other nodes, or keeps its own normal. At a convex edge of the nonmortar side it is the normal of a smooth
   partner. Collective. [in] shape - of the side; [in,out] normals - ghosted */
PetscErrorCode ContactNormalSet(Level *level, const FacetPartner *partner, const Facets *facets, const SideShape *shape,
                                Vec normals);
/* Whether a side has a convex edge on any rank. Collective. [in] shape - of the side */
PetscErrorCode ContactNormalHasEdge(const Level *level, const SideShape *shape, PetscBool *edge);

#endif
