/* facets.h -- lists of facets. Functions are not collective. */
#ifndef MORTISE_FACETS_H
#define MORTISE_FACETS_H

#include "level/level.h"

/* Allocates facets. [out] facets - owned by the caller, FacetsDestroy() */
PetscErrorCode FacetsAllocate(PetscInt num, Facets *facets);
/* Appends facets. [in,out] more - destroyed; facets - owned by the caller */
PetscErrorCode FacetsAppend(Facets *more, Facets *facets);
/* Orders the nodes of facets of first order for outward normals, for any orientation of their cells. */
void FacetsTurnOut(const Level *level, Facets *facets);
/* Length of a facet, or area, as its vertices span it: exact where it is flat. [out] normal - outward unit
   normal in its middle [dim], may be NULL */
PetscReal FacetGetMeasure(const Level *level, const Facets *facets, PetscInt f, PetscReal normal[]);
/* The number of the facet of a cell that has exactly these vertices, or -1.
   [in] cell, facet - node numbers */
PetscInt CellFindFacet(ElementType type, const PetscInt cell[], const PetscInt facet[]);

#endif
