/* overlap.h -- the operations that differ between overlaps of lines and of facets in space. */
#ifndef MORTISE_OVERLAP_H
#define MORTISE_OVERLAP_H

#include "contact/overlappoints.h"

typedef struct {
  PetscInt max_points; /* of one mortar facet */
  /* Points of the overlap with one mortar facet; returns their number. [out] points - [max_points] */
  PetscInt (*points)(const FacetPartner *partner, const ClipFacet *facet, const ClipFacet *mortar, ClipPoint points[]);
  /* Keeps, wherever two layers of the mortar side lie over a part of the facet, the one of smallest |gap|. */
  PetscErrorCode (*keep_nearest)(const FacetPartner *partner, const ClipFacet *facet, OverlapPoints *list);
} Overlap;

extern const Overlap OVERLAP_LINES, OVERLAP_POLYGONS;

#endif
