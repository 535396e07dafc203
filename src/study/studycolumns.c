/* studycolumns.c -- the columns of a study, for table and summary. */
#include "study/studyimpl.h"

/* The callback of StudyColumnsVisit() and its context. */
typedef struct {
  ColumnFn take;
  void    *ctx;
} ColumnVisitor;

static void StudyColumnsAddCount_Private(const ColumnVisitor *visitor, const char name[], PetscInt value)
{
  Column column = {.kind = COLUMN_COUNT, .count = value};

  snprintf(column.name, sizeof(column.name), "%s", name);
  (*visitor->take)(visitor->ctx, &column);
}

static void StudyColumnsAddReal_Private(const ColumnVisitor *visitor, const char name[], const char suffix[],
                                        PetscReal value)
{
  Column column = {.kind = COLUMN_REAL, .real = value};

  snprintf(column.name, sizeof(column.name), "%s%s", name, suffix);
  (*visitor->take)(visitor->ctx, &column);
}

static void StudyColumnsAddWord_Private(const ColumnVisitor *visitor, const char name[], const char value[])
{
  Column column = {.kind = COLUMN_WORD, .word = value};

  snprintf(column.name, sizeof(column.name), "%s", name);
  (*visitor->take)(visitor->ctx, &column);
}

static void StudyColumnsAddErrors_Private(Study study, const Record *record, PetscBool named,
                                          const ColumnVisitor *visitor)
{
  const char *const against = named && !study->exact ? "_to_finest" : "";

  for (PetscInt e = 0; e < study->num_errors; e++) {
    char name[NAME_LENGTH + 16];

    snprintf(name, sizeof(name), "%s%s", study->errors[e].name, against);
    StudyColumnsAddReal_Private(visitor, name, "", record->errors[e].absolute);
    StudyColumnsAddReal_Private(visitor, name, "_relative", record->errors[e].relative);
    StudyColumnsAddReal_Private(visitor, name, "_rate", record->errors[e].rate);
  }
}

static void StudyColumnsAddCost_Private(const Record *record, const ColumnVisitor *visitor)
{
  static const char *const stages[STAGE_COUNT] = {"seconds_setup",    "seconds_mortar", "seconds_assembly",
                                                  "seconds_condense", "seconds_solve",  "seconds_output"};

  for (int s = 0; s < STAGE_COUNT; s++) StudyColumnsAddReal_Private(visitor, stages[s], "", record->seconds[s]);
  StudyColumnsAddReal_Private(visitor, "seconds_total", "", record->total);
  StudyColumnsAddReal_Private(visitor, "seconds_with_coarser", "", record->with_coarser);
  StudyColumnsAddReal_Private(visitor, "seconds_times_ranks", "", record->rank_seconds);
  StudyColumnsAddReal_Private(visitor, "seconds_processor", "", record->processor);
  StudyColumnsAddReal_Private(visitor, "peak_bytes", "", record->memory);
  StudyColumnsAddReal_Private(visitor, "peak_bytes_forecast", "", record->forecast);
}

void StudyColumnsVisit(Study study, const Record *record, PetscBool errors_named, ColumnFn take, void *ctx)
{
  static const char *const states[] = {"solved", "not_solved", "skipped"};
  const ColumnVisitor      visitor  = {.take = take, .ctx = ctx};

  StudyColumnsAddCount_Private(&visitor, "order", record->order);
  StudyColumnsAddCount_Private(&visitor, "level", record->level);
  StudyColumnsAddWord_Private(&visitor, "status", states[record->state]);
  StudyColumnsAddWord_Private(&visitor, "reason", record->reason);
  StudyColumnsAddCount_Private(&visitor, "cells", record->cells);
  StudyColumnsAddCount_Private(&visitor, "unknowns", record->unknowns);
  StudyColumnsAddReal_Private(&visitor, "h", "", record->h);
  StudyColumnsAddReal_Private(&visitor, "error_estimate", "", record->estimate);
  StudyColumnsAddErrors_Private(study, record, errors_named, &visitor);
  for (PetscInt q = 0; q < study->num_quantities; q++)
    StudyColumnsAddReal_Private(&visitor, study->quantities[q].name, "", record->values[q]);
  StudyColumnsAddCount_Private(&visitor, "iterations", record->iterations);
  StudyColumnsAddCount_Private(&visitor, "linear_iterations", record->linear_iterations);
  StudyColumnsAddCount_Private(&visitor, "active", record->active);
  StudyColumnsAddCost_Private(record, &visitor);
}
