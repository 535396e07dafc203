/* numberwords.h -- numbers in sentences. */
#ifndef MORTISE_NUMBERWORDS_H
#define MORTISE_NUMBERWORDS_H

#include <petscsys.h>

/* "(1.5, -2)"; rounding relative to the size is 0. Not collective. */
PetscErrorCode NumberWordsVectorBeside(PetscInt dim, const PetscReal v[], PetscReal size, char text[], size_t len);
/* The same beside the largest component. Not collective. */
PetscErrorCode NumberWordsVector(PetscInt dim, const PetscReal v[], char text[], size_t len);

#endif
