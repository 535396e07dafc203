/* nodalnormals.h -- nodal normals of the nonmortar side (eq. 4.1). */
#ifndef MORTISE_NODALNORMALS_H
#define MORTISE_NODALNORMALS_H

#include "side/sideshape.h"

/* Unit normals of the nonmortar side at its nodes, zero elsewhere (eq. 4.1). Collective.
   [in] shape - of the side;
   [out] normals - ghosted, dim per node, owned by the caller */
PetscErrorCode NodalNormalsCreate(Level *level, const Facets *facets, const SideShape *shape, Vec *normals);

/* Sums the contributions of all ranks to normals, and normalizes; zero stays zero. Collective.
   [in,out] normals - ghosted */
PetscErrorCode NodalNormalsShare(Level *level, Vec normals);

/* Gives hanging nodes the directions of those that they hang on, interpolated and normalized. A node on which
   nodes of the side hang, and which has no facet of the side, gets the mean of theirs. Without hanging nodes
   nothing happens. Collective. [in,out] normals - ghosted */
PetscErrorCode NodalNormalsConform(Level *level, Vec normals);

/* Where facets meet at more than 44 degrees, takes the node's normal from those that face the other side.
   Collective.
   [in] sees - whether each facet does [facets->num]; [in,out] normals - ghosted, as created; [out] changed -
   whether there is such a node */
PetscErrorCode NodalNormalsSharpen(Level *level, const Facets *facets, const PetscBool sees[], Vec normals,
                                   PetscBool *changed);

#endif
