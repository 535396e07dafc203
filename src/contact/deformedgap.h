/* deformedgap.h -- nodal gaps where a displacement has taken the sides of a pair (eq. 11.7). */
#ifndef MORTISE_DEFORMEDGAP_H
#define MORTISE_DEFORMEDGAP_H

#include "contact/pair.h"

/* G_a / D_aa of a pair's nodes in the deformed configuration, along new normals and by new projections: what PairsCreate() does, at other
   positions. Multipliers stay where they are. A gap or an offset that is given adds what it differs by from the geometry.
   Collective. [in] u - ghosted, dim per node; [out] gap - NAN where nothing within reach faces the node any more [pair->num]; [out] turn - angle
   between the side's own nodal normals before and afterwards, radians, or NULL [pair->num] */
PetscErrorCode DeformedGapMeasure(Scene scene, const Support *support, Pair pair, Vec u, PetscReal gap[],
                                  PetscReal turn[]);

#endif
