/* bodyoverlap.h -- bodies that overlap in space by more than their contact explains. */
#ifndef MORTISE_BODYOVERLAP_H
#define MORTISE_BODYOVERLAP_H

#include "level/level.h"

/* Warns of bodies that overlap away from the sides of a pair between them; tied bodies may overlap.
   Collective. */
PetscErrorCode BodyOverlapWarn(Level *level);

#endif
