/* sidecurves.h -- normals of sides in the plane, of fourth order. Private. */
#ifndef MORTISE_SIDECURVES_H
#define MORTISE_SIDECURVES_H

#include "mesh/sideshape.h"
#include "mesh/sideplanes.h"

/* Normals of the curve through the nodes, from four facets around each node (eq. 4.1b): of fourth order,
   where means over two facets are of second. Both are exact on circles; these also where a line ends in one.
   Collective.
   [in] shape - normals (4.1), ridges; [in] share - of a full turn, that the patch fills around a node
   [num][F]; [out] exact - zero where there are too few facets [num][F][2] */
PetscErrorCode SideCurvesGetNormals(Level *level, const SideSums *nodes, const SidePlanes *planes,
                                    const SideShape *shape, const PetscReal share[], PetscReal exact[]);

#endif
