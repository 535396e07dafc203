/* validity.h -- whether a solution is one that small displacements allow (floor 7, private to this room). */
#ifndef MORTISE_RESULT_VALIDITY_H
#define MORTISE_RESULT_VALIDITY_H

#include <mortise/fields.h>

/* Warns where a body is strained or turned more than is small. Collective. */
PetscErrorCode ValidityWarn(Fields fields);

#endif
