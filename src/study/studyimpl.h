/* studyimpl.h -- declarations that the files of this module share.

   A study is a list of records, one per run. All ranks hold the same records; files and texts are the first rank's. */
#ifndef MORTISE_STUDYIMPL_H
#define MORTISE_STUDYIMPL_H

#include <cjson/cJSON.h>
#include <stdio.h>
#include "base/log.h"
#include "output/output.h"
#include "study/meshhistory.h"
#include "study/study.h"

enum { NAME_LENGTH = 128, REASON_LENGTH = 256, ERROR_TEXT = 64 };

typedef enum { RECORD_SOLVED, RECORD_NOT_SOLVED, RECORD_SKIPPED } RecordState;

/* A norm of the error, and the order in which it falls from the coarser level to this one; NAN where unknown. */
typedef struct {
  PetscReal absolute, relative, rate;
} RecordError;

/* One run. Of a skipped one only order, level, unknowns (as predicted), state and reason are known. */
typedef struct {
  PetscInt     order, level; /* order STUDY_OWN_ORDERS: each body its own; level 0 is the scene's own mesh */
  RecordState  state;
  char         reason[REASON_LENGTH]; /* why not solved, or skipped; else "" */
  PetscInt     cells, unknowns;
  PetscReal    h;        /* largest distance of two nodes of a cell */
  PetscReal    estimate; /* of the error in the energy norm, by the standard calibration of one mesh */
  PetscInt     iterations, linear_iterations, active;
  PetscReal   *values;               /* [study->num_quantities] */
  RecordError *errors;               /* [study->num_errors] */
  PetscReal    seconds[STAGE_COUNT]; /* of the slowest rank */
  PetscReal    total;        /* sum over the stages: of the mesh, the solution and its judgement, not of files */
  PetscReal    with_coarser; /* the same with the coarser runs of this order, from which this one began */
  PetscReal    rank_seconds; /* total times ranks */
  PetscReal    processor;    /* seconds that the processors worked, of all ranks */
  PetscReal    forecast;     /* peak of all ranks in bytes, as expected before the run */
  PetscReal    memory;       /* and as it was */
  PetscReal    own_memory;   /* the part of it that was not there when the run began */
  Vec          u;            /* displacement, as long as it is needed, or NULL */
} Record;

/* A number that every run has, and that may be extrapolated. */
typedef struct {
  char     name[NAME_LENGTH];  /* key in the files */
  char     label[NAME_LENGTH]; /* in words */
  PetscInt size; /* first of the quantities that tell how large this one is: components of a vector may vanish */
} Quantity;

typedef struct {
  char name[NAME_LENGTH];
} ErrorName; /* key in the files */

struct _n_Study {
  Scene       scene; /* borrowed */
  PetscInt    num_orders;
  PetscInt   *own_orders; /* of the bodies, as the user gave them [scene->num_bodies] */
  Mesh        mesh[STUDY_MAX_ORDERS];
  MeshHistory history[STUDY_MAX_ORDERS]; /* solved meshes of each order */
  PetscBool   exact;                     /* errors against exact solutions, else against the reference */
  PetscInt   *marked
      [STUDY_MAX_ORDERS]; /* of MarkingCreate() on the latest mesh, for the next one of an adaptive study, or NULL */
  PetscInt   num_quantities, num_errors;
  Quantity  *quantities;
  ErrorName *errors;
  PetscInt   num, capacity;
  Record    *records;   /* in the order of the runs */
  PetscInt   reference; /* position of the record that others are compared with, -1 for none */
  PetscInt   best;      /* position of the record whose fields are written out, -1 for none */
  PetscBool
         shown;   /* fields and summary are there: of that record, or, while there is none, of one without a solution */
  cJSON *summary; /* of that record, without the study, or NULL */
  Output output;  /* fields of that record which are not under their names yet, NULL if they are */
  PetscBool quiet;    /* nothing is printed on stdout */
  PetscBool terminal; /* where a line may be overwritten */
};
typedef struct _n_Study *Study;

/* --- records.c: what a run is remembered by --- */

/* Names of all quantities and errors of a scene; no records yet. Collective. */
PetscErrorCode StudyCreate(Scene scene, Study *study);
PetscErrorCode StudyDestroy(Study *study);
/* Appends an empty record. Not collective. */
PetscErrorCode StudyAddRecord(Study study, PetscInt order, PetscInt level, Record **record);
/* The latest solved record of an order on a level coarser than this, or NULL. Not collective. */
Record *StudyFindCoarser(Study study, PetscInt order, PetscInt level);
/* Cells, unknowns, h of the mesh to be solved on. Collective. */
PetscErrorCode RecordMesh(Record *record, Level *level);
/* Everything else that a run tells. Collective. */
PetscErrorCode RecordRun(Study study, Run run, Record *record);
/* Orders of convergence of all records, from the nearest coarser level with an error. Not collective. */
void StudyComputeRates(Study study);
/* "order 2", or "own orders" where bodies keep theirs. Not collective. [out] text - [ERROR_TEXT] */
void RecordOrderText(const Record *record, char text[]);

/* --- compare.c: solutions on different meshes --- */

/* Chooses the reference and computes all differences from it, where there are no exact solutions. Collective. */
PetscErrorCode MeshComparisonRun(Study study);
/* "exact", "order 2, level 4", or "" where errors are not known. Not collective. [out] text - [ERROR_TEXT] */
void MeshComparisonReferenceText(Study study, char text[]);

/* --- columns.c: the one list of what files tell of a run --- */

typedef enum { COLUMN_COUNT, COLUMN_REAL, COLUMN_WORD } ColumnKind;

typedef struct {
  char        name[2 * NAME_LENGTH];
  ColumnKind  kind;
  PetscInt    count; /* negative where unknown */
  PetscReal   real;
  const char *word;
} Column;

/* Takes one column at a time. */
typedef void (*ColumnFn)(void *ctx, const Column *column);
/* All columns of a record in their order. Not collective. [in] errors_named - whether the names of errors tell that they are
   differences from the finest run, where they are */
void StudyColumnsVisit(Study study, const Record *record, PetscBool errors_named, ColumnFn take, void *ctx);

/* --- table.c: the terminal --- */

/* Collective, all four: its head, the run that begins, one that has ended; */
PetscErrorCode StudyTableBegin(Study study);
PetscErrorCode StudyTableAnnounce(Study study, const Record *record);
PetscErrorCode StudyTableAdd(Study study, const Record *record);
/* and what is known at the end: differences from the reference, extrapolated values, files. */
PetscErrorCode StudyTableEnd(Study study);

/* --- forecast.c: memory of runs that were not made yet --- */

/* Bytes that a run will need beside what is held now, from the runs of that order; NAN where nothing can be said. Not collective. */
PetscReal CostForecastMemory(Study study, PetscInt order, PetscInt unknowns);
/* Unknowns of a level that is not there yet. Not collective. [in] record - of the next coarser level of that order */
PetscInt CostForecastUnknowns(Study study, const Record *record);

/* --- files.c: everything that is rewritten after every run --- */

/* The summary of the best run with the block "study" in it. Not collective. [out] text - of the first rank, owned by the caller
   (free()); NULL elsewhere, and where no run is solved */
PetscErrorCode StudySummary(Study study, char **text);

/* Completes the files of all runs so far. Collective. */
PetscErrorCode StudyWriteFiles(Study study);
/* Fields, or the motion that shows that there is no solution, and summary of a run that is the finest of the highest order so
   far; they appear with StudyWriteFiles(). Collective. */
PetscErrorCode StudyWriteBest(Study study, Run run);

#endif
