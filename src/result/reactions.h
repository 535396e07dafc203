/* reactions.h -- what supports exert, side by side. */
#ifndef MORTISE_REACTIONS_H
#define MORTISE_REACTIONS_H

#include "result/fields.h"

/* Sums of reactions by boundary. Where two boundaries fix the same direction of a node, each takes int phi_a
   s* n over its own facets. What is left is shared equally. All of a body's boundaries follow each other,
   loads among them with zero. Collective.
   [in] fields - NULL where nothing is known: NAN;
   [in] nodal - of CertificateCompute(); [out] sums - [boundaries of all bodies][dim], owned by the caller,
   PetscFree(); rests - sums of the sizes of what was shared equally, likewise; optional, may be NULL */
PetscErrorCode ReactionsCreate(Scene scene, Fields fields, Vec nodal, PetscReal **sums, PetscReal **rests);

#endif
