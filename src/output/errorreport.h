/* errorreport.h -- the estimated error and the error bars, in the summary and on the terminal. */
#ifndef MORTISE_ERRORREPORT_H
#define MORTISE_ERRORREPORT_H

#include "output/summary.h"

/* The blocks "estimate" and "bars" of the summary; of one mesh alone the estimate has its standard scale, and
   bars are null. Collective. */
PetscErrorCode ErrorReportAdd(const SummaryInput *input, cJSON *root);
/* One line. Collective. */
PetscErrorCode ErrorReportPrint(const SummaryInput *input);
/* " +- 2.3" where a number has a bar, else "". Not collective. [in] key - of a number of the pair; [out] text
   - [len] */
void ErrorReportPairBar(const SummaryInput *input, const char pair[], const char key[], char text[], size_t len);

#endif
