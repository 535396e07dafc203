/* multiplierstatus.h -- the nodes of the nonmortar sides that carry a multiplier. */
#ifndef MORTISE_MULTIPLIERSTATUS_H
#define MORTISE_MULTIPLIERSTATUS_H

#include "contact/pairassembly.h"

/* Removes fixed directions from the normals of nodes, before rays are sent along them. So rays at a plane of
   symmetry are those of the whole body. Nodes whose normal is nearly fixed keep it. Not collective.
   [in] oblique - nodes that keep it as well, of ObliqueHoldsFind(), or NULL;
   [in,out] normals - ghosted */
PetscErrorCode MultiplierStatusProjectNormals(const Level *level, const Support *support, const PetscBool oblique[],
                                              Vec normals);

/* Chooses the nodes that may keep a multiplier, by coverage and supports; removes fixed directions from their
   normals. Not collective. [in] oblique - nodes that have none, of ObliqueHoldsFind(), or NULL */
PetscErrorCode MultiplierStatusDecide(Level *level, const Support *support, const PetscBool oblique[],
                                      PairAssembly *assembly);

/* Resolves nodes of which several pairs would constrain nearly the same direction. The first of these pairs
   keeps the node, or the one with the nearest partner, if partners lie behind each other at the same facets.
   A tie constrains all directions. Rows then depend on those of earlier pairs only, without cycles. User
   error: a pair without any of its possible nodes. Collective.
   [in,out] assemblies - [num] */
PetscErrorCode MultiplierStatusResolve(const Level *level, PetscInt num, PairAssembly assemblies[]);

#endif
