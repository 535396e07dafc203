/* validityimpl.h -- what the indicators of the small-displacement model are measured from. Private. */
#ifndef MORTISE_VALIDITYIMPL_H
#define MORTISE_VALIDITYIMPL_H

#include "checks/gaperrors.h"
#include "checks/validity.h"

/* Errors of gaps below this part of their scale, and of strains, are green. */
static const PetscReal VALIDITY_GREEN_GAP = 0.01, VALIDITY_GREEN_STRAIN = 0.01;

/* Measures strains and rotations: VALIDITY_STRAIN and VALIDITY_ROTATION, of all ranks. Collective.
   [in,out] largest - by kind; [out] strain - Frobenius norm, exceeded on a small share of the energy */
PetscErrorCode ValidityCellsMeasure(Fields fields, Largest largest[VALIDITY_COUNT], PetscReal *strain);

/* Measures gaps, slips and normals of pair p. Collective.
   [in] strain - of ValidityCellsMeasure(); [in,out] largest - by kind: of all pairs so far, of this rank;
   [in,out] sliding - sum of p W |slip| where the pair has no friction, a work, of this rank;
   [in,out] errors - of gaps, of all pairs so far */
PetscErrorCode ValidityPairMeasure(Fields fields, PetscInt p, PetscReal strain, Largest largest[VALIDITY_COUNT],
                                   PetscReal *sliding, GapErrors *errors);

#endif
