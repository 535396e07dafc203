/* sidecurves.h -- normals of sides in the plane, of fourth order. Private. */
#ifndef MORTISE_SIDECURVES_H
#define MORTISE_SIDECURVES_H

#include "side/sidepatch.h"

/* Normals of the curve through the nodes, from four facets around each node (eq. 4.1b): of fourth order,
   where means over two facets are of second. Both are exact on circles; these also where a line ends in one.
   Collective. [out] exact - zero where there are too few facets [num][F][2]; error - of exact, in radians,
   estimated by (4.1d); 0 where it is that of a circle [num][F] */
PetscErrorCode SideCurvesGetNormals(const SmoothSide *side, PetscReal exact[], PetscReal error[]);

#endif
