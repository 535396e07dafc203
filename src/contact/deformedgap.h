/* deformedgap.h -- nodal gaps of a pair in the deformed configuration (eq. 11.7). */
#ifndef MORTISE_DEFORMEDGAP_H
#define MORTISE_DEFORMEDGAP_H

#include "contact/pair.h"

/* G_a / D_aa of a pair's nodes in the deformed configuration, with its normals and projections, as of
   PairsCreate(). The nodes with multipliers stay the same. A given gap or offset adds its difference from the
   undeformed geometry. Collective.
   [in] u - ghosted, dim per node
   [out] gap - NAN where nothing within reach faces the node [pair->num]
   [out] turn - angle between the nodal normals of the side before and after, in radians; optional, may be
   NULL [pair->num] */
PetscErrorCode DeformedGapMeasure(Scene scene, const Support *support, Pair pair, Vec u, PetscReal gap[],
                                  PetscReal turn[]);

#endif
