/* cyclicroles.h -- cyclic dependencies of roles. */
#ifndef MORTISE_CYCLICROLES_H
#define MORTISE_CYCLICROLES_H

#include "problem/vi.h"

/* User error, with the names of the pairs: pairs depend on each other in a cycle, from mortar side to mortar
   side. Call it after PairsCreate(). Collective. */
PetscErrorCode CyclicRolesCheck(VI vi);

#endif
