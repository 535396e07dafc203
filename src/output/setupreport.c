/* setupreport.c -- see the header. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "base/compat.h"
#include "base/json.h"
#include "output/bodycounts.h"
#include "output/numberwords.h"
#include "output/setupreport.h"
#include "checks/solvabilityreport.h"

enum { COLUMNS = 8, CELL = 160 };

/* What sides are named for. */
static const struct {
  int         role;
  const char *word;
} words[] = {{ROLE_DISPLACEMENT, "displacement"}, {ROLE_NORMAL, "normal"}, {ROLE_TRACTION, "traction"},
             {ROLE_PRESSURE, "pressure"},         {ROLE_FORCE, "force"},   {ROLE_MOMENT, "moment"},
             {ROLE_NONMORTAR, "nonmortar"},       {ROLE_MORTAR, "mortar"}};

/* A table of words, one row of which is its head. */
typedef struct {
  PetscInt num_rows, num_columns;
  char (*cell)[COLUMNS][CELL]; /* [num_rows] */
} WordTable;

static PetscErrorCode WordTableCreate_Private(PetscInt num_rows, PetscInt num_columns, const char *const head[],
                                              WordTable *table)
{
  PetscFunctionBeginUser;
  *table = (WordTable){num_rows + 1, num_columns, NULL};
  PetscCall(PetscCalloc1(num_rows + 1, &table->cell));
  for (PetscInt c = 0; c < num_columns; c++) PetscCall(PetscStrncpy(table->cell[0][c], head[c], CELL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Prints the table with columns as wide as their words, and frees it. Collective. */
static PetscErrorCode WordTablePrint_Private(MPI_Comm comm, WordTable *table)
{
  PetscFunctionBeginUser;
  for (PetscInt r = 0; r < table->num_rows; r++) {
    char   line[COLUMNS * (CELL + 2) + 1];
    size_t used = 0;

    for (PetscInt c = 0; c < table->num_columns; c++) {
      size_t width = 0;

      for (PetscInt i = 0; i < table->num_rows; i++) width = PetscMax(width, strlen(table->cell[i][c]));
      used += (size_t)snprintf(line + used, sizeof(line) - used, "%s%-*s", c ? "  " : "",
                               c + 1 < table->num_columns ? (int)width : 0, table->cell[r][c]);
    }
    PetscCall(PetscPrintf(comm, "  %s\n", line));
  }
  PetscCall(PetscFree(table->cell));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "0.866 at (1, 2)"; "-" where there is none. */
static PetscErrorCode SetupReportExtreme_Private(PetscInt dim, const Largest *extreme, char text[CELL])
{
  char at[CELL];

  PetscFunctionBeginUser;
  if (extreme->value != extreme->value) { // NAN
    PetscCall(PetscStrncpy(text, "-", CELL));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(NumberWordsVector(dim, extreme->at, at, sizeof(at)));
  (void)snprintf(text, CELL, "%.4g at %.120s", (double)extreme->value, at);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest extent of a body. */
static PetscReal SetupReportExtent_Private(PetscInt dim, const SetupBody *body)
{
  PetscReal extent = 0;

  for (PetscInt k = 0; k < dim; k++) extent = PetscMax(extent, body->upper[k] - body->lower[k]);
  return extent;
}

static PetscErrorCode SetupReportPrintBodies_Private(VI vi, const SetupCheck *check)
{
  static const char *const head[] = {"body",   "cells", "unknowns",    "pieces",
                                     "volume", "box",   "worst shape", "largest aspect ratio"};
  const PetscInt           dim    = vi->level->dim;
  WordTable                table;

  PetscFunctionBeginUser;
  PetscCall(WordTableCreate_Private(vi->scene->num_bodies, 8, head, &table));
  for (PetscInt b = 0; b < vi->scene->num_bodies; b++) {
    const SetupBody *body   = &check->bodies[b];
    const PetscReal  extent = SetupReportExtent_Private(dim, body);
    char(*cell)[CELL]       = table.cell[b + 1], lower[64], upper[64];

    (void)snprintf(cell[0], CELL, "%s", vi->scene->bodies[b].name);
    (void)snprintf(cell[1], CELL, "%d", (int)body->cells);
    (void)snprintf(cell[2], CELL, "%d", (int)(body->nodes * dim));
    (void)snprintf(cell[3], CELL, "%d", (int)body->pieces);
    (void)snprintf(cell[4], CELL, "%.6g", (double)body->volume);
    PetscCall(NumberWordsVectorBeside(dim, body->lower, extent, lower, sizeof(lower)));
    PetscCall(NumberWordsVectorBeside(dim, body->upper, extent, upper, sizeof(upper)));
    (void)snprintf(cell[5], CELL, "%s to %s", lower, upper);
    PetscCall(SetupReportExtreme_Private(dim, &body->shape, cell[6]));
    PetscCall(SetupReportExtreme_Private(dim, &body->aspect, cell[7]));
  }
  PetscCall(WordTablePrint_Private(vi->scene->comm, &table));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Regions, where bodies have some. */
static PetscErrorCode SetupReportPrintRegions_Private(VI vi)
{
  static const char *const head[] = {"region", "cells", "volume", "Young's modulus", "Poisson's ratio"};
  PetscInt                 num;
  RegionCount             *counts;
  WordTable                table;

  PetscFunctionBeginUser;
  PetscCall(RegionCountsCompute(vi->scene, vi->level, &num, &counts));
  if (!num) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(WordTableCreate_Private(num, 5, head, &table));
  for (PetscInt r = 0; r < num; r++) {
    const SceneMaterial *m = counts[r].material;
    char(*cell)[CELL]      = table.cell[r + 1];

    (void)snprintf(cell[0], CELL, "%.70s:%.80s", vi->scene->bodies[counts[r].body].name,
                   counts[r].name ? counts[r].name : "(no region)");
    (void)snprintf(cell[1], CELL, "%d", (int)counts[r].cells);
    (void)snprintf(cell[2], CELL, "%.6g", (double)counts[r].volume);
    (void)snprintf(cell[3], CELL, "%.80s", m->young ? ExpressionText(m->young) : "Hooke matrix");
    (void)snprintf(cell[4], CELL, "%.80s", m->poisson ? ExpressionText(m->poisson) : "-");
  }
  PetscCall(PetscPrintf(vi->scene->comm, "\n"));
  PetscCall(WordTablePrint_Private(vi->scene->comm, &table));
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What a side is for: words of its roles with a separator between. */
static void SetupReportRoles_Private(int roles, char text[CELL])
{
  size_t used = 0;

  text[0] = '\0';
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(words); i++) {
    if (!(roles & words[i].role)) continue;
    used += (size_t)snprintf(text + used, CELL - used, "%s%s", used ? ", " : "", words[i].word);
  }
}

static PetscErrorCode SetupReportPrintSides_Private(VI vi, const SetupCheck *check)
{
  static const char *const head[] = {"side", "facets", "area", "mean normal", "middle", "role"};
  const PetscInt           dim    = vi->level->dim;
  WordTable                table;

  PetscFunctionBeginUser;
  PetscCall(WordTableCreate_Private(check->num_sides, 6, head, &table));
  for (PetscInt s = 0; s < check->num_sides; s++) {
    const SetupSide *side   = &check->sides[s];
    const PetscReal  extent = SetupReportExtent_Private(dim, &check->bodies[side->body]);
    char(*cell)[CELL]       = table.cell[s + 1];

    (void)snprintf(cell[0], CELL, "%.70s:%.80s", vi->scene->bodies[side->body].name, side->side);
    (void)snprintf(cell[1], CELL, "%d", (int)side->facets);
    (void)snprintf(cell[2], CELL, "%.6g", (double)side->area);
    PetscCall(NumberWordsVectorBeside(dim, side->normal, 1, cell[3], CELL));
    PetscCall(NumberWordsVectorBeside(dim, side->centre, extent, cell[4], CELL));
    SetupReportRoles_Private(side->roles, cell[5]);
  }
  PetscCall(WordTablePrint_Private(vi->scene->comm, &table));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SetupReportPrintPairs_Private(VI vi, const SetupCheck *check)
{
  static const char *const head[] = {"pair", "nodes", "facing", "multipliers", "least gap", "largest gap", "reach"};
  const PetscInt           dim    = vi->level->dim;
  WordTable                table;

  PetscFunctionBeginUser;
  PetscCall(WordTableCreate_Private(vi->num_pairs, 7, head, &table));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const SetupPair *pair = &check->pairs[p];
    char(*cell)[CELL]     = table.cell[p + 1];

    (void)snprintf(cell[0], CELL, "%s", vi->pairs[p]->spec->name);
    (void)snprintf(cell[1], CELL, "%d", (int)pair->nodes);
    (void)snprintf(cell[2], CELL, "%d", (int)pair->facing);
    (void)snprintf(cell[3], CELL, "%d", (int)pair->multipliers);
    PetscCall(SetupReportExtreme_Private(dim, &pair->least, cell[4]));
    PetscCall(SetupReportExtreme_Private(dim, &pair->largest, cell[5]));
    (void)snprintf(cell[6], CELL, "%.6g", (double)pair->reach);
  }
  PetscCall(WordTablePrint_Private(vi->scene->comm, &table));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SetupReportPrintLoads_Private(VI vi, const SetupCheck *check)
{
  static const char *const head[] = {"load on", "force", "moment about the origin",
                                     "rigid motions that supports leave"};
  const PetscInt           dim = vi->level->dim, num = vi->scene->num_bodies;
  const PetscBool          ring = (PetscBool)(vi->scene->model == MODEL_AXISYMMETRIC);
  PetscReal                size = 0, arm = 0;
  WordTable                table;

  PetscFunctionBeginUser;
  for (PetscInt b = 0; b < num; b++) {
    for (PetscInt k = 0; k < dim; k++) {
      size = PetscMax(size, PetscAbsReal(check->bodies[b].force[k]));
      arm  = PetscMax(arm, PetscMax(PetscAbsReal(check->bodies[b].lower[k]), PetscAbsReal(check->bodies[b].upper[k])));
    }
  }
  PetscCall(WordTableCreate_Private(num, 4, head, &table));
  for (PetscInt b = 0; b < num; b++) {
    const SetupBody *body = &check->bodies[b];
    char(*cell)[CELL]     = table.cell[b + 1];

    (void)snprintf(cell[0], CELL, "%s", vi->scene->bodies[b].name);
    PetscCall(NumberWordsVectorBeside(dim, body->force, size, cell[1], CELL));
    if (ring)
      PetscCall(PetscStrncpy(cell[2], "-", CELL));
    else if (dim == 2)
      (void)snprintf(cell[2], CELL, "%.6g",
                     PetscAbsReal(body->moment[2]) > 1e-12 * size * arm ? (double)body->moment[2] : 0.);
    else
      PetscCall(NumberWordsVectorBeside(dim, body->moment, size * arm, cell[2], CELL));
    (void)snprintf(cell[3], CELL, "%d", (int)body->motions);
  }
  PetscCall(WordTablePrint_Private(vi->scene->comm, &table));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SetupReportPrint(VI vi, Solvability solvability, const SetupCheck *check)
{
  const MPI_Comm comm = vi->scene->comm;

  PetscFunctionBeginUser;
  if (vi->scene->title[0]) PetscCall(PetscPrintf(comm, "%s\n", vi->scene->title));
  PetscCall(PetscPrintf(comm, "  checked, nothing was solved: %" PetscInt_FMT " nodes, %" PetscInt_FMT " unknowns\n\n",
                        vi->level->num_global, vi->level->num_global * vi->level->dim));
  PetscCall(SetupReportPrintBodies_Private(vi, check));
  PetscCall(SetupReportPrintRegions_Private(vi));
  if (check->num_sides) PetscCall(PetscPrintf(comm, "\n"));
  if (check->num_sides) PetscCall(SetupReportPrintSides_Private(vi, check));
  if (vi->num_pairs) PetscCall(PetscPrintf(comm, "\n"));
  if (vi->num_pairs) PetscCall(SetupReportPrintPairs_Private(vi, check));
  PetscCall(PetscPrintf(comm, "\n"));
  PetscCall(SetupReportPrintLoads_Private(vi, check));
  PetscCall(PetscPrintf(comm, "\n"));
  if (solvability)
    PetscCall(SolvabilityReportView(vi, solvability));
  else
    PetscCall(PetscPrintf(comm, "  supports leave no rigid motion\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- the summary ---------------------------------------------------------------------------------------- */

static void SetupReportAddExtreme_Private(cJSON *object, const char key[], PetscInt dim, const Largest *extreme)
{
  cJSON *one = cJSON_AddObjectToObject(object, key);

  JSONAddReal(one, "value", extreme->value);
  if (extreme->value == extreme->value)
    JSONAddReals(one, "at", dim, extreme->at);
  else
    cJSON_AddNullToObject(one, "at");
}

static void SetupReportAddBodies_Private(VI vi, const SetupCheck *check, cJSON *root)
{
  cJSON         *bodies = cJSON_AddObjectToObject(root, "bodies");
  const PetscInt dim    = vi->level->dim;

  for (PetscInt b = 0; b < vi->scene->num_bodies; b++) {
    const SetupBody *body = &check->bodies[b];
    cJSON           *one  = cJSON_AddObjectToObject(bodies, vi->scene->bodies[b].name), *load;

    JSONAddInt(one, "cells", body->cells);
    JSONAddInt(one, "nodes", body->nodes);
    JSONAddInt(one, "pieces", body->pieces);
    JSONAddInt(one, "rigid_motions", body->motions);
    JSONAddReal(one, "volume", body->volume);
    JSONAddReals(one, "lower", dim, body->lower);
    JSONAddReals(one, "upper", dim, body->upper);
    SetupReportAddExtreme_Private(one, "worst_shape", dim, &body->shape);
    SetupReportAddExtreme_Private(one, "largest_aspect_ratio", dim, &body->aspect);
    load = cJSON_AddObjectToObject(one, "load");
    JSONAddReals(load, "force", dim, body->force);
    if (dim == 2)
      JSONAddReal(load, "moment", body->moment[2]);
    else
      JSONAddReals(load, "moment", dim, body->moment);
  }
}

static void SetupReportAddSides_Private(VI vi, const SetupCheck *check, cJSON *root)
{
  cJSON         *sides = cJSON_AddObjectToObject(root, "sides");
  const PetscInt dim   = vi->level->dim;

  for (PetscInt s = 0; s < check->num_sides; s++) {
    const SetupSide *side = &check->sides[s];
    char             key[PETSC_MAX_PATH_LEN];
    cJSON           *one, *roles;

    (void)snprintf(key, sizeof(key), "%s:%s", vi->scene->bodies[side->body].name, side->side);
    one   = cJSON_AddObjectToObject(sides, key);
    roles = cJSON_AddArrayToObject(one, "roles");
    for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(words); i++)
      if (side->roles & words[i].role) cJSON_AddItemToArray(roles, cJSON_CreateString(words[i].word));
    JSONAddInt(one, "facets", side->facets);
    JSONAddReal(one, "area", side->area);
    JSONAddReals(one, "normal", dim, side->normal);
    JSONAddReals(one, "centre", dim, side->centre);
  }
}

PetscErrorCode SetupReportAdd(VI vi, const SetupCheck *check, cJSON *root)
{
  cJSON         *object = cJSON_AddObjectToObject(root, "check"), *pairs;
  const PetscInt dim    = vi->level->dim;

  PetscFunctionBeginUser;
  SetupReportAddBodies_Private(vi, check, object);
  SetupReportAddSides_Private(vi, check, object);
  pairs = cJSON_AddObjectToObject(object, "pairs");
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const SetupPair *pair = &check->pairs[p];
    cJSON           *one  = cJSON_AddObjectToObject(pairs, vi->pairs[p]->spec->name);

    JSONAddInt(one, "nodes", pair->nodes);
    JSONAddInt(one, "facing", pair->facing);
    JSONAddInt(one, "multipliers", pair->multipliers);
    SetupReportAddExtreme_Private(one, "least_gap", dim, &pair->least);
    SetupReportAddExtreme_Private(one, "largest_gap", dim, &pair->largest);
    JSONAddReal(one, "initial_overlap", pair->multipliers ? PetscMax(0, -pair->least.value) : NAN);
    JSONAddReal(one, "reach", pair->reach);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
