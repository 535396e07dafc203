/* circles.h -- roles that run in a circle (private to the room). */
#ifndef MORTISE_CIRCLES_H
#define MORTISE_CIRCLES_H

#include <mortise/vi.h>

/* Faults with the names of the pairs if, from mortar side to mortar side, a pair comes back to itself: its
   nodes would follow nodes that follow them. Pairs exist. Collective. */
PetscErrorCode CirclesCheck(VI vi);

#endif
