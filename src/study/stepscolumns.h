/* stepscolumns.h -- the table of load steps. */
#ifndef MORTISE_STEPSCOLUMNS_H
#define MORTISE_STEPSCOLUMNS_H

#include <cjson/cJSON.h>
#include "output/output.h"

/* Adds <output>_steps.csv: a row for each step, with the columns of options/GUIDE.md. Collective.
   [in] rows - array of SummaryCreateStep() */
PetscErrorCode StepsAddTable(Output output, Scene scene, const cJSON *rows);

#endif
