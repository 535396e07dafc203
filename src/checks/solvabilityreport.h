/* solvabilityreport.h -- the report on bodies that only contact can hold. */
#ifndef MORTISE_SOLVABILITYREPORT_H
#define MORTISE_SOLVABILITYREPORT_H

#include <cjson/cJSON.h>
#include "rigid/solvability.h"

/* solvability is NULL where supports hold all bodies.
   "solvability": verdict, motion, work, and the motions that are free. Not collective. */
void SolvabilityReportAdd(VI vi, Solvability solvability, cJSON *root);
/* Lines for the terminal: motions that are free. Collective. */
PetscErrorCode SolvabilityReportPrint(VI vi, Solvability solvability);
/* On stderr: why there is no solution. Collective. */
PetscErrorCode SolvabilityReportRefuse(VI vi, Solvability solvability);
/* Warns of what is marginal. Collective. */
PetscErrorCode SolvabilityReportWarn(VI vi, Solvability solvability);
/* A line of -scene_view. Collective. */
PetscErrorCode SolvabilityReportView(VI vi, Solvability solvability);

#endif
