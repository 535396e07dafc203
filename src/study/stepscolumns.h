/* stepscolumns.h -- the table of load steps. */
#ifndef MORTISE_STEPSCOLUMNS_H
#define MORTISE_STEPSCOLUMNS_H

#include <cjson/cJSON.h>
#include "output/output.h"

/* Adds <output>_steps.csv: a row for each step, columns as the guide has them. Collective. [in] rows - array of SummaryCreateStep(), of the
   first rank */
PetscErrorCode StepsAddTable(Output output, Scene scene, const cJSON *rows);

#endif
