/* words.h -- numbers in sentences (floor 7, private to this room). */
#ifndef MORTISE_RESULT_WORDS_H
#define MORTISE_RESULT_WORDS_H

#include <petscsys.h>

/* "(1.5, -2)". Not collective. */
PetscErrorCode WordsVector(PetscInt dim, const PetscReal v[], char text[], size_t len);

#endif
