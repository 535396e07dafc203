/* smoothgap.h -- gaps between smooth sides (eq. 4.5). */
#ifndef MORTISE_SMOOTHGAP_H
#define MORTISE_SMOOTHGAP_H

#include "contact/overlappoints.h"

/* Bulges of the curves over the edges of a side's facets (ArcBulge()), and at vertices that hang on an edge;
   none for facets of second order.
   Collective.
   [in] shape - of the facets
   [out] bulges - owned by the caller [num][ELEMENT_MAX_FACET_NODES][dim]; zero where a formula is
   taken on the facet; NULL where no rank has one, or the side is polygonal
   [out] left - largest error of gaps that remains */
PetscErrorCode SmoothGapCreate(Level *level, const ScenePair *spec, const Facets *facets, const SideShape *shape,
                               PetscBool polygonal, PetscReal **bulges, PetscReal *left);

/* Changes the gaps of a facet's points to those between the curves, or by the formula. Not collective.
   [in] bulges - of the facet, or NULL; [out] most - the largest change */
PetscErrorCode SmoothGapApply(const FacetPartner *partner, const ClipFacet *facet, const PetscReal bulges[],
                              OverlapPoints *list, PetscReal *most);

#endif
