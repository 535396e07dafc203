/* patchsummary.h -- the connected patches of a contact in the summary and on the terminal. */
#ifndef MORTISE_PATCHSUMMARY_H
#define MORTISE_PATCHSUMMARY_H

#include <cjson/cJSON.h>
#include "result/fields.h"

/* The array "patches" of a pair in the summary. Collective. [in] fields - NULL if there is no solution */
PetscErrorCode PatchSummaryAdd(Fields fields, PetscInt p, cJSON *object);
/* The lines of a pair on the terminal, where there are several patches. Collective. */
PetscErrorCode PatchSummaryPrint(Fields fields, PetscInt p);

#endif
