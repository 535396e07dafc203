/* halvedsteps.h -- the error of load steps: all of them solved again, each in parts, and extrapolated. */
#ifndef MORTISE_HALVEDSTEPS_H
#define MORTISE_HALVEDSTEPS_H

#include <cjson/cJSON.h>
#include "study/richardson.h"

/* Adds up what belongs to a part of a step alone: iterations, work, dissipation. Not collective.
   [in,out] row - of the summary's `steps`, for the last part; [in] before - of the parts before it, or NULL for none */
void HalvedStepsAddParts(cJSON *row, const cJSON *before);
/* Adds the block `limit` to the rows of the finest steps: values for ever smaller steps, and half widths of their intervals, by the
   keys of the numbers. Steps that coarser rows do not have get none. Not collective.
   [in] coarser - rows of whole steps, and of halves; [in,out] rows - of quarters */
void HalvedStepsExtrapolate(cJSON *const coarser[RICHARDSON_LEVELS - 1], cJSON *rows);

#endif
