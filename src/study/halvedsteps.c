/* halvedsteps.c -- numbers of load steps extrapolated to steps of length 0 (eq. 15.2, with the length of
   steps for h).

   Rows of the summary are trees of numbers. The rows of three solutions have the same keys; so have the trees
   of limits and of bars. */
#include "study/halvedsteps.h"
#include "base/json.h"
#include <math.h>
#include <string.h>

typedef const cJSON *Samples[RICHARDSON_LEVELS]; /* the same item of three rows, coarse first */

/* Adds a number of an earlier part to that of the same key. */
static void HalvedStepsAddNumber_Private(cJSON *object, const cJSON *before, const char key[], PetscBool integer)
{
  const PetscReal sum = JSONGetReal(object, key) + JSONGetReal(before, key);

  if (!cJSON_GetObjectItemCaseSensitive(object, key)) return;
  cJSON_DeleteItemFromObjectCaseSensitive(object, key);
  if (integer)
    JSONAddInt(object, key, (PetscInt)sum);
  else
    JSONAddReal(object, key, sum);
}

void HalvedStepsAddParts(cJSON *row, const cJSON *before)
{
  static const char *const counts[] = {"iterations", "linear_iterations"};
  static const char *const works[]  = {"work", "stored", "dissipation", "defect"};
  const cJSON             *old      = cJSON_GetObjectItemCaseSensitive(before, "pairs"),
              *energy               = cJSON_GetObjectItemCaseSensitive(before, "energy");
  cJSON *pair, *balance = cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(row, "energy"), "balance");

  if (!before) return;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(counts); i++)
    HalvedStepsAddNumber_Private(row, before, counts[i], PETSC_TRUE);
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(works) && balance; i++)
    HalvedStepsAddNumber_Private(balance, cJSON_GetObjectItemCaseSensitive(energy, "balance"), works[i], PETSC_FALSE);
  cJSON_ArrayForEach(pair, cJSON_GetObjectItemCaseSensitive(row, "pairs")) HalvedStepsAddNumber_Private(
      pair, cJSON_GetObjectItemCaseSensitive(old, pair->string), "dissipation", PETSC_FALSE);
}

/* Three numbers become a value and a bar; null where one of them is missing. [in] key - NULL in an array */
static void HalvedStepsAddLimit_Private(const Samples samples, const char key[], cJSON *values, cJSON *bars)
{
  PetscReal     Q[RICHARDSON_LEVELS];
  Extrapolation limit   = {.value = NAN, .bar = NAN};
  cJSON        *scratch = cJSON_CreateObject();
  PetscBool     known   = PETSC_TRUE;

  for (int i = 0; i < RICHARDSON_LEVELS; i++) {
    Q[i]  = JSONReadReal(samples[i]);
    known = (PetscBool)(known && isfinite((double)Q[i]));
  }
  if (known) limit = RichardsonExtrapolateSteps(Q);
  JSONAddReal(scratch, "value", limit.value);
  JSONAddReal(scratch, "bar", limit.bar);
  if (key) {
    cJSON_AddItemToObject(values, key, cJSON_DetachItemFromObjectCaseSensitive(scratch, "value"));
    cJSON_AddItemToObject(bars, key, cJSON_DetachItemFromObjectCaseSensitive(scratch, "bar"));
  } else {
    cJSON_AddItemToArray(values, cJSON_DetachItemFromObjectCaseSensitive(scratch, "value"));
    cJSON_AddItemToArray(bars, cJSON_DetachItemFromObjectCaseSensitive(scratch, "bar"));
  }
  cJSON_Delete(scratch);
}

/* One number, or all components of one. */
static void HalvedStepsAddNumbers_Private(const Samples samples, const char key[], cJSON *values, cJSON *bars)
{
  const int size = cJSON_IsArray(samples[0]) ? cJSON_GetArraySize(samples[0]) : 0;

  if (!size) {
    HalvedStepsAddLimit_Private(samples, key, values, bars);
    return;
  }
  values = cJSON_AddArrayToObject(values, key);
  bars   = cJSON_AddArrayToObject(bars, key);
  for (int k = 0; k < size; k++) {
    Samples component;

    for (int i = 0; i < RICHARDSON_LEVELS; i++) component[i] = cJSON_GetArrayItem(samples[i], k);
    HalvedStepsAddLimit_Private(component, NULL, values, bars);
  }
}

/* Numbers of these keys, or of all keys; samples may lack them.
   [in] keys - ends with NULL; or NULL for all */
static void HalvedStepsAddKeys_Private(const Samples samples, const char *const keys[], const char name[],
                                       cJSON *values, cJSON *bars)
{
  const cJSON *item;

  if (!samples[RICHARDSON_LEVELS - 1]) return;
  values = cJSON_AddObjectToObject(values, name);
  bars   = cJSON_AddObjectToObject(bars, name);
  cJSON_ArrayForEach(item, samples[RICHARDSON_LEVELS - 1])
  {
    PetscBool wanted = (PetscBool)!keys;
    Samples   same;

    for (int k = 0; keys && keys[k]; k++) wanted = (PetscBool)(wanted || !strcmp(keys[k], item->string));
    if (!wanted || cJSON_IsObject(item)) continue;
    for (int i = 0; i < RICHARDSON_LEVELS; i++) same[i] = cJSON_GetObjectItemCaseSensitive(samples[i], item->string);
    HalvedStepsAddNumbers_Private(same, item->string, values, bars);
  }
}

/* The item of a key in three objects. */
static void HalvedStepsEnter_Private(const Samples samples, const char key[], Samples inner)
{
  for (int i = 0; i < RICHARDSON_LEVELS; i++) inner[i] = cJSON_GetObjectItemCaseSensitive(samples[i], key);
}

/* A list of objects with the same keys, as pairs and probes. */
static void HalvedStepsAddList_Private(const Samples row, const char name[], const char *const keys[], cJSON *values,
                                       cJSON *bars)
{
  Samples      list, one;
  const cJSON *item;

  HalvedStepsEnter_Private(row, name, list);
  values = cJSON_AddObjectToObject(values, name);
  bars   = cJSON_AddObjectToObject(bars, name);
  cJSON_ArrayForEach(item, list[RICHARDSON_LEVELS - 1])
  {
    HalvedStepsEnter_Private(list, item->string, one);
    HalvedStepsAddKeys_Private(one, keys, item->string, values, bars);
  }
}

/* Adds the block to one row. */
static void HalvedStepsExtrapolateRow_Private(const Samples row, cJSON *last)
{
  /* Not the slip, which is that of the last part of a step, and not positions, which jump from node to
     node. */
  static const char *const pairs[] = {
      "normal_force", "force",       "area", "max_pressure", "max_pressure_covered", "min_gap", "tangential_force",
      "slip_share",   "dissipation", NULL};
  static const char *const probes[] = {"displacement", "stress", "von_mises", NULL};
  static const char *const energy[] = {"potential", NULL};
  cJSON                   *limit = cJSON_CreateObject(), *values = cJSON_AddObjectToObject(limit, "values"),
        *bars = cJSON_AddObjectToObject(limit, "bars");
  Samples inner, part;

  HalvedStepsEnter_Private(row, "energy", inner);
  HalvedStepsAddKeys_Private(inner, energy, "energy", values, bars);
  HalvedStepsEnter_Private(inner, "strain", part);
  HalvedStepsAddKeys_Private(part, NULL, "strain", cJSON_GetObjectItemCaseSensitive(values, "energy"),
                             cJSON_GetObjectItemCaseSensitive(bars, "energy"));
  HalvedStepsEnter_Private(inner, "balance", part);
  HalvedStepsAddKeys_Private(part, NULL, "balance", cJSON_GetObjectItemCaseSensitive(values, "energy"),
                             cJSON_GetObjectItemCaseSensitive(bars, "energy"));
  HalvedStepsAddList_Private(row, "pairs", pairs, values, bars);
  HalvedStepsEnter_Private(row, "reactions", inner);
  HalvedStepsAddKeys_Private(inner, NULL, "reactions", values, bars);
  HalvedStepsAddList_Private(row, "probes", probes, values, bars);
  cJSON_AddItemToObject(last, "limit", limit);
}

void HalvedStepsExtrapolate(cJSON *const coarser[RICHARDSON_LEVELS - 1], cJSON *rows)
{
  int num = cJSON_GetArraySize(rows);

  for (int i = 0; i < RICHARDSON_LEVELS - 1; i++) num = PetscMin(num, cJSON_GetArraySize(coarser[i]));
  for (int step = 0; step < num; step++) {
    cJSON    *last = cJSON_GetArrayItem(rows, step);
    Samples   row  = {cJSON_GetArrayItem(coarser[0], step), cJSON_GetArrayItem(coarser[1], step), last};
    PetscBool same = PETSC_TRUE; // all three are solved

    for (int i = 0; i < RICHARDSON_LEVELS; i++)
      same = (PetscBool)(same &&
                         !strcmp(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(row[i], "status")), "solved"));
    if (same) HalvedStepsExtrapolateRow_Private(row, last);
  }
}
