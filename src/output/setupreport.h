/* setupreport.h -- a scene before it is solved, on the terminal and in the summary (-check). */
#ifndef MORTISE_SETUPREPORT_H
#define MORTISE_SETUPREPORT_H

#include <cjson/cJSON.h>
#include "checks/setupcheck.h"

/* Adds the object "check" of the summary. Collective. */
PetscErrorCode SetupReportAdd(VI vi, const SetupCheck *check, cJSON *root);
/* Prints tables of bodies, sides, pairs and loads, and whether contact can balance the loads. Collective. */
PetscErrorCode SetupReportPrint(VI vi, Solvability solvability, const SetupCheck *check);

#endif
