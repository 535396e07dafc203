/* rigid.h -- whether supports alone hold a body (floor 5; numerics.md 7.1). */
#ifndef MORTISE_RIGID_H
#define MORTISE_RIGID_H

#include <mortise/support.h>

/* Collective. [out] floating - whether the held directions leave a rigid motion [num_bodies], the same on all ranks */
PetscErrorCode BodiesFloating(const Level *level, const Support *support, PetscInt num_bodies, PetscBool floating[]);

#endif
