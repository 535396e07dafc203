/* halvedsteps.h -- the error of load steps, by extrapolation from whole, halved and quartered steps. */
#ifndef MORTISE_HALVEDSTEPS_H
#define MORTISE_HALVEDSTEPS_H

#include <cjson/cJSON.h>
#include "study/richardson.h"

/* Adds the numbers of earlier parts of a step to those of the last one: iterations, work, dissipation.
   Not collective.
   [in,out] row - of the summary's `steps`, for the last part;
   [in] before - of the parts before it, or NULL for none */
void HalvedStepsAddParts(cJSON *row, const cJSON *before);
/* Adds the block `limit` to the rows of the finest steps. It has limits of numbers as the length of steps
   tends to 0, and half widths of their intervals, by the keys of the numbers. Steps without coarser rows get
   none. Not collective.
   [in] coarser - rows of whole steps, and of halves; [in,out] rows - of quarters */
void HalvedStepsExtrapolate(cJSON *const coarser[RICHARDSON_LEVELS - 1], cJSON *rows);

#endif
