/* json.h -- numbers in JSON that read back as they were. */
#ifndef MORTISE_JSON_H
#define MORTISE_JSON_H

#include <cjson/cJSON.h>
#include <petscsys.h>

/* Adds a number with as few digits as give it back exactly; null if it is not finite. cJSON's own printing is content with a
   neighbouring number. Not collective. */
void JSONAddReal(cJSON *object, const char name[], PetscReal value);
void JSONAddInt(cJSON *object, const char name[], PetscInt value);
/* Adds an array; null in place of numbers that are not finite. */
void JSONAddReals(cJSON *object, const char name[], PetscInt n, const PetscReal values[]);
/* Appends such an array to an array. */
void JSONAppendReals(cJSON *array, PetscInt n, const PetscReal values[]);

#endif
