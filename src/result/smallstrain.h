/* smallstrain.h -- test of the assumption of small displacements. */
#ifndef MORTISE_SMALLSTRAIN_H
#define MORTISE_SMALLSTRAIN_H

#include "result/fields.h"

/* Warns where a body is strained or turned more than is small. Collective. */
PetscErrorCode SmallStrainWarn(Fields fields);

#endif
