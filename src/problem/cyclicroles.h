/* cyclicroles.h -- cyclic dependencies of roles. */
#ifndef MORTISE_CYCLICROLES_H
#define MORTISE_CYCLICROLES_H

#include "problem/vi.h"

/* Faults with the names of the pairs if, from mortar side to mortar side, a pair comes back to itself: its
   nodes would follow nodes that follow them. Pairs exist. Collective. */
PetscErrorCode CyclicRolesCheck(VI vi);

#endif
