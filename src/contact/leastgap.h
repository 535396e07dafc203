/* leastgap.h -- the least gap of a facet at an edge of its pair. */
#ifndef MORTISE_LEASTGAP_H
#define MORTISE_LEASTGAP_H

#include "contact/overlappoints.h"

/* The least gap on a facet where an edge makes a step or a bend of it. It is PETSC_MIN_REAL where there is no
   edge, and where the points are too few to tell. Not collective.
   [in] list - points of the facet, with gaps */
PetscErrorCode LeastGapAtEdge(const FacetPartner *partner, const ClipFacet *facet, const OverlapPoints *list,
                              PetscReal *least);
/* A bound on the least gap at the vertices of a facet, from above: points of quadrature lie within. It is the
   least gap where gaps are linear, and far above it where they are not. Not collective.
   [in] list - points of a facet that is covered wholly, with gaps */
PetscReal LeastGapAtVertices(const ClipFacet *facet, const OverlapPoints *list);

#endif
