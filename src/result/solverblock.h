/* solverblock.h -- the block "solver" of the summary (floor 7, private to this room). */
#ifndef MORTISE_RESULT_SOLVERBLOCK_H
#define MORTISE_RESULT_SOLVERBLOCK_H

#include <cjson/cJSON.h>
#include <mortise/summary.h>

/* Adds "solver". Not collective. */
void SolverBlockAdd(const SummaryInput *in, cJSON *root);

#endif
