/* gapdiscontinuity.h -- nodes whose mean gap is less than every gap around them. */
#ifndef MORTISE_GAPDISCONTINUITY_H
#define MORTISE_GAPDISCONTINUITY_H

#include <cjson/cJSON.h>
#include "result/fields.h"

/* The largest distance of the mean gap of a node in contact of pair p below all gaps around it; 0 if it is
   rounding of coordinates. Also whether it matters relative to the displacements. Collective. [out] at
   - the first place where it is, if it shows [dim] */
PetscErrorCode GapDiscontinuityFind(Fields fields, PetscInt p, PetscBool *shows, PetscReal *overlap, PetscReal at[]);

/* "false_overlap" of a pair in the summary, and where it shows "false_overlap_at". Collective. [in] fields -
   NULL if there is no solution */
PetscErrorCode GapDiscontinuityAdd(Fields fields, PetscInt p, PetscInt dim, cJSON *object);

#endif
