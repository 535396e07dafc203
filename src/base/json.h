/* json.h -- numbers in JSON that read back as they were. */
#ifndef MORTISE_JSON_H
#define MORTISE_JSON_H

#include <cjson/cJSON.h>
#include <petscsys.h>

/* Adds a number with the fewest digits that read back exactly, as a raw text; null if it is not finite. cJSON
   itself may print a neighbouring number. Not collective. */
void JSONAddReal(cJSON *object, const char name[], PetscReal value);
void JSONAddInt(cJSON *object, const char name[], PetscInt value);
/* Adds an array [n]; null in place of numbers that are not finite. Not collective. */
void JSONAddReals(cJSON *object, const char name[], PetscInt n, const PetscReal values[]);
/* Appends such an array to an array. Not collective. */
void JSONAppendReals(cJSON *array, PetscInt n, const PetscReal values[]);
/* The number of an item that JSONAddReal() or JSONAddInt() has made; NAN for any other item, or NULL.
   Not collective. */
PetscReal JSONReadReal(const cJSON *item);
/* The same for the item of a key of an object, or NULL. Not collective. */
PetscReal JSONGetReal(const cJSON *object, const char key[]);

#endif
