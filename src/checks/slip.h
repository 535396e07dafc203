/* slip.h -- relative displacements of the two sides of a pair. */
#ifndef MORTISE_SLIP_H
#define MORTISE_SLIP_H

#include "result/fields.h"

/* (D u~ + D_other u~ - M u)_a over the sum of the row of D. It is the mean displacement of the nonmortar side
   around a node less that of the mortar side that faces it (eq. 11.6), u~ as in pair.h. An obstacle does not
   move. Collective. [out] relative - [pair->num][dim] */
PetscErrorCode SlipComputeRelative(Fields fields, PetscInt p, PetscReal relative[]);
/* The part of such displacements perpendicular to the pair's normals. Not collective. [out] tangential -
   [pair->num][dim] */
void SlipTakeTangential(const Pair pair, const PetscReal relative[], PetscReal tangential[]);
/* The shortest edge of the facets around each node of a pair. Collective. [out] size - [pair->num] */
PetscErrorCode SlipFindFacetSizes(Fields fields, PetscInt p, PetscReal size[]);

#endif
