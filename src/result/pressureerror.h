/* pressureerror.h -- error of a contact pressure (floor 7, private to this room). */
#ifndef MORTISE_RESULT_PRESSUREERROR_H
#define MORTISE_RESULT_PRESSUREERROR_H

#include <mortise/errors.h>

/* Norms of the error of pair p, whose exact pressure is known. Faults where that is not finite. Collective. */
PetscErrorCode PressureErrorCompute(Fields fields, PetscInt p, PressureError *error);

#endif
