/* solversummary.h -- the block "solver" of the summary. */
#ifndef MORTISE_SOLVERSUMMARY_H
#define MORTISE_SOLVERSUMMARY_H

#include <cjson/cJSON.h>
#include "output/summary.h"

/* Adds "solver". Not collective. */
void SolverSummaryAdd(const SummaryInput *in, cJSON *root);

#endif
