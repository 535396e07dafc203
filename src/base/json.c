/* json.c -- see the header. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "base/json.h"

enum { DIGITS_MIN = 15, DIGITS_MAX = 17 }; /* 17 significant digits identify any double, 15 most of them */

static cJSON *JSONCreateReal_Private(PetscReal value)
{
  char text[40];

  // PETSC_INFINITY is a finite number: the initial value of a minimum, as of the gaps of no node
  if (PetscIsInfOrNanReal(value) || PetscAbsReal(value) == PETSC_INFINITY) return cJSON_CreateNull();
  for (int digits = DIGITS_MIN; digits <= DIGITS_MAX; digits++) {
    snprintf(text, sizeof(text), "%.*g", digits, (double)value);
    if (strtod(text, NULL) == (double)value) break;
  }
  return cJSON_CreateRaw(text);
}

void JSONAddReal(cJSON *object, const char name[], PetscReal value)
{
  cJSON_AddItemToObject(object, name, JSONCreateReal_Private(value));
}

void JSONAddInt(cJSON *object, const char name[], PetscInt value)
{
  char text[40];

  snprintf(text, sizeof(text), "%" PetscInt_FMT, value);
  cJSON_AddItemToObject(object, name, cJSON_CreateRaw(text));
}

PetscReal JSONReadReal(const cJSON *item)
{
  return cJSON_IsRaw(item) ? (PetscReal)strtod(item->valuestring, NULL) : (PetscReal)NAN;
}

PetscReal JSONGetReal(const cJSON *object, const char key[])
{
  return JSONReadReal(cJSON_GetObjectItemCaseSensitive(object, key));
}

void JSONAddReals(cJSON *object, const char name[], PetscInt n, const PetscReal values[])
{
  cJSON *array = cJSON_AddArrayToObject(object, name);

  for (PetscInt i = 0; i < n; i++) cJSON_AddItemToArray(array, JSONCreateReal_Private(values[i]));
}

void JSONAppendReals(cJSON *array, PetscInt n, const PetscReal values[])
{
  cJSON *inner = cJSON_CreateArray();

  for (PetscInt i = 0; i < n; i++) cJSON_AddItemToArray(inner, JSONCreateReal_Private(values[i]));
  cJSON_AddItemToArray(array, inner);
}
