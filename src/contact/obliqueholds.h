/* obliqueholds.h -- nodes that a support holds along a part of their direction of contact. */
#ifndef MORTISE_OBLIQUEHOLDS_H
#define MORTISE_OBLIQUEHOLDS_H

#include "contact/pairassembly.h"

/* Finds the nodes that a support holds along a part of their direction of contact, where it is no plane of
   symmetry: supports do not hold the mortar side there, or the obstacle is oblique to it, or the side does
   not bend towards it. Only nodes with a neighbour that can take their row count. Collective.
   [in] assembly - with status and directions;
   [out] oblique - whether each local node is one, owned by the caller, or NULL without any [num_nodes] */
PetscErrorCode ObliqueHoldsFind(Level *level, const Support *support, const FacetPartner *partner,
                                const PairAssembly *assembly, PetscBool **oblique);

#endif
