/* floating.h -- whether supports alone hold a body (floor 7, private to this room). */
#ifndef MORTISE_FLOATING_H
#define MORTISE_FLOATING_H

#include <mortise/support.h>

/* Collective. [out] floating - [num_bodies], the same on all ranks */
PetscErrorCode BodiesFloating(const Level *level, const Support *support, PetscInt num_bodies, PetscBool floating[]);

#endif
