/* everywhere.h -- factors of a small matrix, on every rank; internal (floor 6). */
#ifndef MORTISE_EVERYWHERE_H
#define MORTISE_EVERYWHERE_H

#include <petscksp.h>

/* Makes pc, whose matrix is SPD, a factorisation that every rank has by itself; its controls are PETSc's, behind the prefix of pc. Collective. */
PetscErrorCode EverywhereSetPC(PC pc);

#endif
