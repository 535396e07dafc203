/* refinementimpl.h -- declarations that the files of this module share. Collective unless they say
   otherwise. */
#ifndef MORTISE_REFINEMENTIMPL_H
#define MORTISE_REFINEMENTIMPL_H

#include "level/leveltables.h"
#include "level/plexpoints.h"
#include "refinement/arcsides.h"
#include "refinement/levelrefine.h"
#include "refinement/refinement.h"

/* Finds the bodies with smooth sides that are curved: of files of first order; of second order, if some
   facets are on arcs. Collective. [out] any - whether there are such bodies */
PetscErrorCode LevelFindArcs(Level *level, PetscBool *any);
PetscErrorCode LevelFindFileArcs(Level *level);
/* As ArcSidesCreate(), of bodies of order 2 from files of second order in space. Collective. */
PetscErrorCode FileSidesCreate(Level *level, ArcSides *sides);
/* Moves vertices of a refined level to the curves over coarse edges. Positions are those before maps, which
   both levels have. Collective. */
PetscErrorCode LevelArcVertices(Level *coarse, const ArcSides *sides, const Refinement *refinement, Level *fine);
/* Moves new nodes of files of second order in space, where these are not on arcs, to the surface of (4.5a).
   Collective. [in,out] fine - with positions on the parabolas of the coarse level */
PetscErrorCode LevelRiseParabolas(Level *coarse, const Refinement *refinement, Level *fine);
/* The points of the edges of a facet. Not collective.
   [in] point - of each node; [out] edges - in the order of ElementEdgeNodes() */
PetscErrorCode FacetGetEdges(const Level *level, const PetscInt point[], const Facets *facets, PetscInt f,
                             PetscInt edges[]);
/* Moves nodes that are on the axis of an axisymmetric scene up to roundoff exactly there. User errors: a node
   with a negative radius. Collective. */
PetscErrorCode LevelSetAxis(Level *level);
/* As LevelSetCoords(), for a refined level that has its prolongation. Collective.
   [in] sides - smooth sides of bodies of order 1 */
PetscErrorCode LevelFollowCoords(Level *coarse, const ArcSides *sides, const Refinement *refinement, Level *fine);
/* fine->prolongation, by the origin of each fine node. Collective. [in] refinement - from coarse to fine */
PetscErrorCode LevelCreateProlongation(const Level *coarse, const Refinement *refinement, Level *fine);

#endif
