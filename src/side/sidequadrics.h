/* sidequadrics.h -- normals of sides in space whose nodes lie on quadrics. Private. */
#ifndef MORTISE_SIDEQUADRICS_H
#define MORTISE_SIDEQUADRICS_H

#include "side/sidepatch.h"

/* Normals of the planes, cylinders, spheres, cones and other quadrics that pass through the nodes around
   each node. They are exact for any triangles, where means over facets are exact on spheres alone.
   Collective.
   [in] side - whose planes are not known yet; [out] of_facet - zero where there is none [num]; [out] exact -
   zero where no quadric is found [num][F][3]; [out] about - coefficients of quadrics about the node of each
   corner, with a gradient of one there; zero where there is none [num][F][QUADRIC_MONOMIALS] */
PetscErrorCode SideQuadricsGetNormals(const SmoothSide *side, Quadric of_facet[], PetscReal exact[], PetscReal about[]);

#endif
