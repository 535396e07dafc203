/* sidequadrics.h -- normals of sides in space whose nodes lie on quadrics. Private. */
#ifndef MORTISE_SIDEQUADRICS_H
#define MORTISE_SIDEQUADRICS_H

#include "mesh/sideshape.h"
#include "mesh/sidesums.h"

/* Normals of the planes, cylinders, spheres, cones and other quadrics that pass through the nodes around
   each node. They are exact for any triangles, where means over facets are exact on spheres alone.
   Collective.
   [in,out] shape - normals close to these, ridges; sets quadrics of facets; [in] share - of a full turn,
   that the patch fills around a node [num][F]; [out] exact - zero where no quadric is found [num][F][3] */
PetscErrorCode SideQuadricsGetNormals(Level *level, const SideSums *nodes, const SideShape *shape,
                                      const PetscReal share[], PetscReal exact[]);

#endif
