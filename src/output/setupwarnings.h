/* setupwarnings.h -- warnings about a scene that is likely mis-set: mixed units, gaps without effect, bodies
   far apart. */
#ifndef MORTISE_SETUPWARNINGS_H
#define MORTISE_SETUPWARNINGS_H

#include "result/fields.h"
#include "rigid/solvability.h"

/* Adds the warnings that the scene alone shows, and with a solution those that its displacements show.
   Collective.
   [in] solvability - or NULL; [in] fields - or NULL */
PetscErrorCode SetupWarningsAdd(VI vi, Solvability solvability, Fields fields);

#endif
