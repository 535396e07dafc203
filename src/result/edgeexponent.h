/* edgeexponent.h -- the exponent of an unbounded pressure at the edge of a body. */
#ifndef MORTISE_EDGEEXPONENT_H
#define MORTISE_EDGEEXPONENT_H

#include "result/fields.h"
#include "result/pairsum.h"

/* The exponent e of the pressure r^-e at the edge where the largest pressure of a pair is (kernel/wedge.h).
   The edge is an end of one side, and the partner goes on beyond it. 0 where that is not certain: in space;
   with friction; with a gap by a formula; with anisotropic bodies or regions; where edge or partner are
   loaded, held, or sides of another pair. Collective.
   [in] sum - of the pair; [in] size - of the facets at the largest pressure; [out] exponent */
PetscErrorCode EdgeExponentGet(Fields fields, PetscInt p, const PairSum *sum, PetscReal size, PetscReal *exponent);

#endif
