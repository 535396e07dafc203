/* nonmanifold.h -- vertices that alone connect parts of a body. Nothing is collective. */
#ifndef MORTISE_NONMANIFOLD_H
#define MORTISE_NONMANIFOLD_H

#include "bodies/bodylist.h"
#include "bodies/fileextract.h"

/* list->num_nonmanifold and list->nonmanifold. */
PetscErrorCode NonManifoldFind(const Extract *x, BodyList *list);

#endif
