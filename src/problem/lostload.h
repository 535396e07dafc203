/* lostload.h -- loads along directions that supports fix. */
#ifndef MORTISE_LOSTLOAD_H
#define MORTISE_LOSTLOAD_H

#include "level/level.h"

/* Warns of each load on a side whose displacement is given in the direction of the load. This part goes into
   the support and moves nothing. The warning has side, direction and lost force. No work where no side is
   both fixed and loaded. Collective. */
PetscErrorCode LostLoadsWarn(Scene scene, Level *level);

#endif
