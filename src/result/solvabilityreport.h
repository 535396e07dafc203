/* solvabilityreport.h -- what is said about bodies that only contact can hold. */
#ifndef MORTISE_SOLVABILITYREPORT_H
#define MORTISE_SOLVABILITYREPORT_H

#include <cjson/cJSON.h>
#include "problem/solvability.h"

/* "solvability": verdict, motion, work, and the motions that are free. Not collective. */
void VerdictAdd(VI vi, cJSON *root);
/* Lines for the terminal: motions that are free. Collective. */
PetscErrorCode VerdictPrint(VI vi);
/* On stderr: why there is no solution. Collective. */
PetscErrorCode VerdictRefuse(VI vi);
/* Warns of what is marginal. Collective. */
PetscErrorCode VerdictWarn(VI vi);
/* A line of -scene_view. Collective. */
PetscErrorCode VerdictView(VI vi);

#endif
