/* studycolumns.c -- everything that files tell of a run, in one list: the table and the summary take the same columns. */
#include "study/studyimpl.h"

/* Where the columns go. */
typedef struct {
  ColumnFn take;
  void    *ctx;
} Sink;

static void Count_Private(const Sink *sink, const char name[], PetscInt value)
{
  Column column = {.kind = COLUMN_COUNT, .count = value};

  snprintf(column.name, sizeof(column.name), "%s", name);
  (*sink->take)(sink->ctx, &column);
}

static void Real_Private(const Sink *sink, const char name[], const char suffix[], PetscReal value)
{
  Column column = {.kind = COLUMN_REAL, .real = value};

  snprintf(column.name, sizeof(column.name), "%s%s", name, suffix);
  (*sink->take)(sink->ctx, &column);
}

static void Word_Private(const Sink *sink, const char name[], const char value[])
{
  Column column = {.kind = COLUMN_WORD, .word = value};

  snprintf(column.name, sizeof(column.name), "%s", name);
  (*sink->take)(sink->ctx, &column);
}

static void Errors_Private(Study study, const Record *record, PetscBool named, const Sink *sink)
{
  const char *const against = named && !study->exact ? "_to_finest" : "";

  for (PetscInt e = 0; e < study->num_errors; e++) {
    char name[NAME_LENGTH + 16];

    snprintf(name, sizeof(name), "%s%s", study->errors[e].name, against);
    Real_Private(sink, name, "", record->errors[e].absolute);
    Real_Private(sink, name, "_relative", record->errors[e].relative);
    Real_Private(sink, name, "_rate", record->errors[e].rate);
  }
}

static void Cost_Private(const Record *record, const Sink *sink)
{
  static const char *const stages[STAGE_COUNT] = {"seconds_setup",    "seconds_mortar", "seconds_assembly",
                                                  "seconds_condense", "seconds_solve",  "seconds_output"};

  for (int s = 0; s < STAGE_COUNT; s++) Real_Private(sink, stages[s], "", record->seconds[s]);
  Real_Private(sink, "seconds_total", "", record->total);
  Real_Private(sink, "seconds_with_coarser", "", record->with_coarser);
  Real_Private(sink, "seconds_times_ranks", "", record->rank_seconds);
  Real_Private(sink, "seconds_processor", "", record->processor);
  Real_Private(sink, "peak_bytes", "", record->memory);
  Real_Private(sink, "peak_bytes_forecast", "", record->forecast);
}

void StudyColumnsVisit(Study study, const Record *record, PetscBool errors_named, ColumnFn take, void *ctx)
{
  static const char *const states[] = {"solved", "not_solved", "skipped"};
  const Sink               sink     = {.take = take, .ctx = ctx};

  Count_Private(&sink, "order", record->order);
  Count_Private(&sink, "level", record->level);
  Word_Private(&sink, "status", states[record->state]);
  Word_Private(&sink, "reason", record->reason);
  Count_Private(&sink, "cells", record->cells);
  Count_Private(&sink, "unknowns", record->unknowns);
  Real_Private(&sink, "h", "", record->h);
  Errors_Private(study, record, errors_named, &sink);
  for (PetscInt q = 0; q < study->num_quantities; q++)
    Real_Private(&sink, study->quantities[q].name, "", record->values[q]);
  Count_Private(&sink, "iterations", record->iterations);
  Count_Private(&sink, "linear_iterations", record->linear_iterations);
  Count_Private(&sink, "active", record->active);
  Cost_Private(record, &sink);
}
