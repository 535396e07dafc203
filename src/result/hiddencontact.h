/* hiddencontact.h -- a rigid obstacle that enters a facet between its points. */
#ifndef MORTISE_HIDDENCONTACT_H
#define MORTISE_HIDDENCONTACT_H

#include "contact/pairpoints.h"

/* A facet before an obstacle; at its nodes. */
typedef struct {
  const ScenePair *spec;
  PetscInt         dim;
  ElementType      type;
  const PetscReal *rise; /* of its curve (rise.h), or NULL */
  PetscReal        X[3 * ELEMENT_MAX_FACET_NODES], u[3 * ELEMENT_MAX_FACET_NODES], normal[3 * ELEMENT_MAX_FACET_NODES];
} ObstacleFacet;

/* The deepest place of the obstacle within the facet: of a lattice of points, and from there downhill. Not
   collective.
   [out] x - [dim]; [out] depth - there, <= 0 if all is open; [out] squared - int d^2 over what is penetrated,
   nearly; [out] width - of that */
PetscErrorCode HiddenContactFind(const ObstacleFacet *facet, PetscReal x[], PetscReal *depth, PetscReal *squared,
                                 PetscReal *width);

#endif
