/* smoothgap.h -- gaps between smooth sides (eq. 4.5). */
#ifndef MORTISE_SMOOTHGAP_H
#define MORTISE_SMOOTHGAP_H

#include "contact/overlappoints.h"

/* How far the side's curve is above its facets (rise.h), also at vertices that hang on an edge.
   Collective.
   [in] shape - of the facets
   [out] rises - owned by the caller [num][RISE_TERMS][dim]; zero where a formula is
   taken on the facet; NULL where no rank has one, or the side is polygonal
   [out] left - largest error of gaps that remains */
PetscErrorCode SmoothGapCreate(Level *level, const ScenePair *spec, const Facets *facets, const SideShape *shape,
                               PetscBool polygonal, PetscReal **rises, PetscReal *left);

/* Changes the gaps of a facet's points to those between the curves, or by the formula. Not collective.
   [in] rise - of the facet, or NULL; [out] most - the largest change */
PetscErrorCode SmoothGapApply(const FacetPartner *partner, const ClipFacet *facet, const PetscReal rise[],
                              OverlapPoints *list, PetscReal *most);

#endif
