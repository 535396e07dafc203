/* pressureerror.h -- error of a contact pressure. */
#ifndef MORTISE_PRESSUREERROR_H
#define MORTISE_PRESSUREERROR_H

#include "result/errors.h"

/* Norms of the error of pair p, whose exact pressure is known. User error: that is not finite. Collective. */
PetscErrorCode PressureErrorCompute(Fields fields, PetscInt p, PressureError *error);

#endif
