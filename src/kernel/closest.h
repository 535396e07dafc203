/* closest.h -- the point of a facet that is nearest to a given one. */
#ifndef MORTISE_CLOSEST_H
#define MORTISE_CLOSEST_H

#include "kernel/element.h"

/* Nearest point of a facet, straight or curved, its edges included. Returns its squared distance.
   [in] X - nodes [num_nodes][dim]; [in] x - [dim]; [out] eta - on the reference cell [ElementDim] */
PetscReal ClosestPointOnFacet(PetscInt dim, ElementType type, const PetscReal X[], const PetscReal x[],
                              PetscReal eta[]);

#endif
