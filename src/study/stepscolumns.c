/* stepscolumns.c -- <output>_steps.csv, from the rows of the summary. */
#include "base/compat.h"
#include "study/stepscolumns.h"
#include "study/tablerow.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_LENGTH = 512 };

static const char *const axes[]     = {"_x", "_y", "_z"};
static const char *const stresses[] = {"_xx", "_yy", "_zz", "_yz", "_xz", "_xy"};

static void RowAdd_Private(TableRow *row, const char name[], const cJSON *value)
{
  if (cJSON_IsString(value) || cJSON_IsRaw(value)) // numbers are raw texts with all their digits
    TableRowAdd(row, name, value->valuestring);
  else if (cJSON_IsBool(value))
    TableRowAdd(row, name, cJSON_IsTrue(value) ? "1" : "0");
  else
    TableRowAdd(row, name, "nan");
}

/* A number, or one column for each component. */
static void RowAddNumbers_Private(TableRow *row, const char owner[], const char what[], const cJSON *value)
{
  const int size = cJSON_IsArray(value) ? cJSON_GetArraySize(value) : 0;
  char      name[NAME_LENGTH];

  if (!size) {
    snprintf(name, sizeof(name), "%s%s%s", owner, owner[0] ? "." : "", what);
    RowAdd_Private(row, name, value);
  }
  for (int i = 0; i < size; i++) {
    snprintf(name, sizeof(name), "%s.%s%s", owner, what, size > 3 ? stresses[i] : axes[i]);
    RowAdd_Private(row, name, cJSON_GetArrayItem(value, i));
  }
}

/* Adds the columns of friction. */
static void RowAddFriction_Private(TableRow *row, const cJSON *pair)
{
  static const char *const friction[] = {"tangential_force", "slip_share", "max_slip", "dissipation"};

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(friction); i++)
    RowAddNumbers_Private(row, pair->string, friction[i], cJSON_GetObjectItemCaseSensitive(pair, friction[i]));
}

/* Adds, with adaptive meshes, the estimated error and the bars of each pair, without those of positions. */
static void RowAddBars_Private(TableRow *row, const cJSON *step)
{
  static const char *const numbers[] = {"normal_force", "area",     "max_pressure", "max_pressure_covered", "min_gap",
                                        "force",        "max_slip", "dissipation",  "tangential_force"};
  const cJSON             *estimate  = cJSON_GetObjectItemCaseSensitive(step, "estimate"), *pair;
  char                     name[NAME_LENGTH];

  if (!estimate) return;
  RowAddNumbers_Private(row, "", "error", cJSON_GetObjectItemCaseSensitive(estimate, "energy_norm_relative"));
  cJSON_ArrayForEach(pair, cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(step, "bars"), "pairs"))
  {
    for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(numbers); i++) {
      const cJSON *bar = cJSON_GetObjectItemCaseSensitive(pair, numbers[i]);

      (void)snprintf(name, sizeof(name), "bar.%s", pair->string);
      if (bar) RowAddNumbers_Private(row, name, numbers[i], bar);
    }
  }
}

/* Adds, with halved steps, the limits of each pair's numbers and their bars. */
static void RowAddLimits_Private(TableRow *row, const cJSON *step)
{
  static const char *const blocks[] = {"values", "bars"}, *const prefixes[] = {"limit", "limit_bar"};
  const cJSON *limit = cJSON_GetObjectItemCaseSensitive(step, "limit"), *pair, *number;
  char         name[NAME_LENGTH];

  for (size_t i = 0; limit && i < PETSC_STATIC_ARRAY_LENGTH(blocks); i++) {
    cJSON_ArrayForEach(pair,
                       cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(limit, blocks[i]), "pairs"))
    {
      (void)snprintf(name, sizeof(name), "%s.%s", prefixes[i], pair->string);
      cJSON_ArrayForEach(number, pair) RowAddNumbers_Private(row, name, number->string, number);
    }
  }
}

/* Writes the row of a step. */
static void RowWrite_Private(TableRow *row, Scene scene, const cJSON *step)
{
  static const char *const own[]    = {"t", "status", "certificate", "iterations", "linear_iterations", "seconds"};
  static const char *const pairs[]  = {"normal_force", "area",         "max_pressure",       "min_gap",
                                       "active_nodes", "force",        "max_pressure_at",    "max_pressure_covered",
                                       "extent_lower", "extent_upper", "centre_of_pressure", "moment_imbalance"};
  static const char *const probes[] = {"displacement", "stress", "von_mises"};
  const cJSON             *energy   = cJSON_GetObjectItemCaseSensitive(step, "energy"), *item;
  const cJSON             *validity = cJSON_GetObjectItemCaseSensitive(step, "validity");
  PetscInt                 p        = 0;

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(own); i++)
    RowAddNumbers_Private(row, "", own[i], cJSON_GetObjectItemCaseSensitive(step, own[i]));
  cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(step, "pairs"))
  {
    for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(pairs); i++) {
      const cJSON *value = cJSON_GetObjectItemCaseSensitive(item, pairs[i]);

      if (!strncmp(pairs[i], "extent_", strlen("extent_")))
        value = cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(item, "extent"),
                                                 pairs[i] + strlen("extent_"));
      RowAddNumbers_Private(row, item->string, pairs[i], value);
    }
    if (ScenePairHasFriction(&scene->pairs[p++])) RowAddFriction_Private(row, item);
  }
  cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(step, "reactions"))
      RowAddNumbers_Private(row, item->string, "reaction", item);
  cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(step, "probes"))
  {
    for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(probes); i++)
      RowAddNumbers_Private(row, item->string, probes[i], cJSON_GetObjectItemCaseSensitive(item, probes[i]));
  }
  cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(energy, "strain"))
      RowAddNumbers_Private(row, item->string, "strain_energy", item);
  RowAddNumbers_Private(row, "", "potential", cJSON_GetObjectItemCaseSensitive(energy, "potential"));
  cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(energy, "balance"))
      RowAddNumbers_Private(row, "balance", item->string, item);
  cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(validity, "indicators"))
      RowAddNumbers_Private(row, "validity", item->string, cJSON_GetObjectItemCaseSensitive(item, "value"));
  RowAddBars_Private(row, step);
  RowAddLimits_Private(row, step);
}

PetscErrorCode StepsAddTable(Output output, Scene scene, const cJSON *rows)
{
  char         path[PETSC_MAX_PATH_LEN], *text = NULL;
  size_t       size;
  TableRow     row = {.names = PETSC_TRUE};
  const cJSON *step;

  PetscFunctionBeginUser;
  row.out = open_memstream(&text, &size);
  PetscCheck(row.out, PETSC_COMM_SELF, PETSC_ERR_MEM, "No memory for the table of load steps");
  RowWrite_Private(&row, scene, cJSON_GetArrayItem(rows, 0));
  cJSON_ArrayForEach(step, rows)
  {
    row = (TableRow){.out = row.out};
    fputc('\n', row.out);
    RowWrite_Private(&row, scene, step);
  }
  PetscCheck(!fclose(row.out) && text, PETSC_COMM_SELF, PETSC_ERR_MEM, "No memory for the table of load steps");
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s_steps.csv", scene->output));
  PetscCall(OutputAddText(output, path, text));
  free(text);
  PetscFunctionReturn(PETSC_SUCCESS);
}
