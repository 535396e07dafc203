/* gaperrors.h -- errors of gaps in contact: how far bodies follow them, and what forces change by that. */
#ifndef MORTISE_GAPERRORS_H
#define MORTISE_GAPERRORS_H

#include "checks/contactpatches.h"
#include "result/largest.h"

/* Of all pairs so far, of this rank. */
typedef struct {
  PetscReal *error; /* of open rows apart from patches the error; of rows in contact the part that bodies can
                       follow; else 0 [vi->num_rows] */
  PetscReal *scale; /* what errors of a pair are compared with [vi->num_pairs] */
  Largest    rest;  /* the other part over its scale, in the mean square of a patch by force; errors of ties */
} GapErrors;

/* Not collective. [out] errors - owned by the caller, GapErrorsDestroy() */
PetscErrorCode GapErrorsCreate(Fields fields, GapErrors *errors);
PetscErrorCode GapErrorsDestroy(GapErrors *errors);
/* Adds those of pair p. Collective.
   [in] error - of the gap of each node, NAN where it does not count [pair->num]; [in] scale - of these */
PetscErrorCode GapErrorsAdd(Fields fields, PetscInt p, const ContactPatches *patches, const PetscReal error[],
                            PetscReal scale, GapErrors *errors);
/* The largest of what is left of the errors if bodies follow them (eq. 11.7a): rests, overlaps of open nodes
   over the scale, changes of the forces of patches over these. Collective.
   [out] left - of all ranks; its value is NAN where friction, or a failure, leaves it unknown */
PetscErrorCode GapErrorsFollow(Fields fields, const GapErrors *errors, Largest *left);

#endif
