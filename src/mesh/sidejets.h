/* sidejets.h -- normals of sides in space, of fourth order. Private. */
#ifndef MORTISE_SIDEJETS_H
#define MORTISE_SIDEJETS_H

#include "mesh/sideshape.h"
#include "mesh/sideplanes.h"

/* Normals of polynomials of degree 4 through the nodes of a patch (eq. 4.1c), where none is known yet. Means
   over facets are of first order on triangles in no order. Collective.
   [in] shape - normals close to these, ridges; [in] share - of a full turn, that the patch fills around a
   node [num][F]; [in,out] exact - normals, zero where none is known [num][F][3] */
PetscErrorCode SideJetsGetNormals(Level *level, const SideSums *nodes, const SidePlanes *planes, const SideShape *shape,
                                  const PetscReal share[], PetscReal exact[]);

#endif
