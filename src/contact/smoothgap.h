/* smoothgap.h -- gaps between smooth sides (eq. 4.5). */
#ifndef MORTISE_SMOOTHGAP_H
#define MORTISE_SMOOTHGAP_H

#include "contact/overlappoints.h"

/* What the curves over the edges of a side's facets add to their points, as ArcBulge() has it; of facets of second order nothing.
   Collective. [in] shape - of the facets; [out] bulges - NULL where there is none on any rank, or the side remains polygonal, or gaps are
   given; owned by the caller [num][ELEMENT_MAX_FACET_NODES][dim]; [out] left - what gaps may still be off by */
PetscErrorCode SmoothGapCreate(Level *level, const ScenePair *spec, const Facets *facets, const SideShape *shape,
                               PetscBool polygonal, PetscReal **bulges, PetscReal *left);
/* The same of the mortar facets that have come to this rank. Not collective. */
PetscErrorCode SmoothGapCreateMortar(PetscInt dim, MortarSurface *mortar);

/* Measures the gaps of a facet's points between the curves; returns by how much that changes one of them at most. Not collective.
   [in] bulges - of the facet, or NULL */
PetscReal SmoothGapApply(const FacetPartner *partner, const ClipFacet *facet, const PetscReal bulges[],
                         OverlapPoints *list);

#endif
