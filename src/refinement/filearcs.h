/* filearcs.h -- sides of files of second order: which of their facets are on the curves of their nodal
   normals (eq. 4.5). */
#ifndef MORTISE_FILEARCS_H
#define MORTISE_FILEARCS_H

#include "refinement/arcsides.h"
#include "side/sideshape.h"

/* The point of a facet, by two of its edges; of a line the line itself. Not collective. */
PetscErrorCode FacetGetPoint(const Level *level, const PetscInt edges[], PetscInt *facet);
/* Adds the middle nodes to facets of first order, in bodies of order 2. Not collective. */
PetscErrorCode FacetsRaise(const Level *level, Facets *facets);
/* Whether refinement of a facet of second order may follow arcs: its middle nodes are at most s gamma^2/2
   above or below those of its corners' normals. Arcs over halves of its edges are eight times as near at
   least, and so as near as the parabolas. False for a flat facet. Not collective.
   [in] shape - of the facets; [out] edge - whether each edge may, too: its middle node is as near in all
   directions. Rims of cones are not arcs */
PetscBool FacetIsOnArcs(const Level *level, const Facets *facets, PetscInt f, const SideShape *shape, PetscBool edge[]);

/* Marks edges and facets of the DM that stay parabolas. Refinement marks what they are divided into.
   Collective.
   [in] level - before maps; [in,out] sides - facets of first order, outward; of second order afterwards;
   mapped - the same level after maps, which gets the errors of normals; or NULL; [out] any - whether some
   facets are on arcs, on any rank */
PetscErrorCode LevelMarkParabolas(Level *level, ArcSides *sides, Level *mapped, PetscBool *any);
/* Whether an edge is marked. Not collective. */
PetscErrorCode PointIsParabola(DM dm, PetscInt point, PetscBool *parabola);

#endif
