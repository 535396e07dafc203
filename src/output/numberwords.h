/* numberwords.h -- numbers in sentences. */
#ifndef MORTISE_NUMBERWORDS_H
#define MORTISE_NUMBERWORDS_H

#include <petscsys.h>

/* "(1.5, -2)". Not collective. */
PetscErrorCode NumberWordsVector(PetscInt dim, const PetscReal v[], char text[], size_t len);

#endif
