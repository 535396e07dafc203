/* studyimpl.h -- declarations that the files of this module share.

   A study is a list of records, one for each run. All ranks have the same records; texts of files are on the
   first rank. */
#ifndef MORTISE_STUDYIMPL_H
#define MORTISE_STUDYIMPL_H

#include <cjson/cJSON.h>
#include "base/log.h"
#include "output/output.h"
#include "study/meshhistory.h"

enum { NAME_LENGTH = 128, REASON_LENGTH = 256, ERROR_TEXT = 64 };

typedef enum { RECORD_SOLVED, RECORD_NOT_SOLVED, RECORD_SKIPPED } RecordState;

/* A norm of the error, and its order of convergence from the coarser level to this one; NAN where unknown. */
typedef struct {
  PetscReal absolute, relative, rate;
} RecordError;

/* One run. A skipped one has only order, level, predicted unknowns, state and reason. */
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
  PetscReal    total;                /* sum over the stages: mesh, solution and certificate, without files */
  PetscReal    with_coarser; /* the same with the coarser runs of this order, whose solutions are its initial guesses */
  PetscReal    rank_seconds; /* total times ranks */
  PetscReal    processor;    /* processor time of all ranks, in seconds */
  PetscReal    forecast;     /* expected peak of memory of all ranks, in bytes */
  PetscReal    memory;       /* measured peak of memory of all ranks, in bytes */
  PetscReal    own_memory;   /* memory less the bytes in use when the run began */
  Vec          u;            /* displacement, as long as it is needed, or NULL */
} Record;

/* A number of every run that may be extrapolated. */
typedef struct {
  char     name[NAME_LENGTH];  /* key in the files */
  char     label[NAME_LENGTH]; /* in words */
  PetscInt size; /* first of the quantities whose largest value is the size of this one: components may vanish */
} Quantity;

typedef struct {
  char name[NAME_LENGTH]; /* key in the files */
} ErrorName;

struct _n_Study {
  Scene       scene; /* borrowed */
  PetscInt    num_orders;
  PetscInt   *own_orders; /* of the bodies, as the user gave them [scene->num_bodies] */
  Mesh        mesh[STUDY_MAX_ORDERS];
  MeshHistory history[STUDY_MAX_ORDERS]; /* solved meshes of each order */
  PetscBool   exact;                     /* errors against exact solutions, else against the reference */
  PetscInt   *marked[STUDY_MAX_ORDERS];  /* in an adaptive study, of MarkingCreate() on the latest mesh; else NULL */
  PetscInt    num_quantities, num_errors;
  Quantity   *quantities;
  ErrorName  *errors;
  PetscInt    num, capacity;
  Record     *records;   /* in the order of the runs */
  PetscInt    reference; /* position of the record that others are compared with, -1 for none */
  PetscInt    best;      /* position of the record whose fields are written, -1 for none */
  PetscBool   shown;     /* whether there are fields and summary: of the best record, or of one without a solution */
  cJSON      *summary;   /* of that record, without the block "study", or NULL */
  Output      output;    /* fields of that record until StudyWriteFiles(), else NULL */
  PetscBool   quiet;     /* nothing is printed on stdout */
  PetscBool   terminal;  /* where a line may be overwritten */
};
typedef struct _n_Study *Study;

/* --- studyrecords.c: results of the runs --- */

/* Names of all quantities and errors of a scene; no records yet. Collective. */
PetscErrorCode StudyCreate(Scene scene, Study *study);
PetscErrorCode StudyDestroy(Study *study);
/* Appends an empty record. Not collective. */
PetscErrorCode StudyAddRecord(Study study, PetscInt order, PetscInt level, Record **record);
/* The latest solved record of an order on a level coarser than this, or NULL. Not collective. */
Record *StudyFindCoarser(Study study, PetscInt order, PetscInt level);
/* Cells, unknowns, h of the mesh to be solved on. Collective. */
PetscErrorCode RecordMesh(Record *record, Level *level);
/* All other results of a run. Collective. */
PetscErrorCode RecordRun(Study study, Run run, Record *record);
/* Orders of convergence of all records, from the nearest coarser level with an error. Not collective. */
void StudyComputeRates(Study study);
/* "order 2", or "own orders" where bodies keep theirs. Not collective. [out] text - [ERROR_TEXT] */
void RecordOrderText(const Record *record, char text[]);

/* --- meshcomparison.c: solutions on different meshes --- */

/* Without exact solutions: chooses the reference, and computes all differences from it. Collective. */
PetscErrorCode MeshComparisonRun(Study study);
/* "exact", "order 2, level 4", or "" where errors are not known. Not collective. [out] text - [ERROR_TEXT] */
void MeshComparisonReferenceText(Study study, char text[]);

/* --- studycolumns.c: the numbers of a run in the files --- */

typedef enum { COLUMN_COUNT, COLUMN_REAL, COLUMN_WORD } ColumnKind;

typedef struct {
  char        name[2 * NAME_LENGTH];
  ColumnKind  kind;
  PetscInt    count; /* negative where unknown */
  PetscReal   real;
  const char *word;
} Column;

/* Takes one column. */
typedef void (*ColumnFn)(void *ctx, const Column *column);
/* Calls take for all columns of a record, in their order. Not collective.
   [in] errors_named - whether the names of differences from the finest run end with "_to_finest" */
void StudyColumnsVisit(Study study, const Record *record, PetscBool errors_named, ColumnFn take, void *ctx);

/* --- studytable.c: the terminal --- */

/* Prints the head of the table. Collective. */
PetscErrorCode StudyTableBegin(Study study);
/* Prints that a run begins. Collective. */
PetscErrorCode StudyTableAnnounce(Study study, const Record *record);
/* Prints the line of a run. Collective. */
PetscErrorCode StudyTableAdd(Study study, const Record *record);
/* Prints differences from the reference, extrapolated values and names of files. Collective. */
PetscErrorCode StudyTableEnd(Study study);

/* --- costforecast.c: memory of the next run --- */

/* Expected bytes of a run besides those in use, from the runs of that order. Not collective. */
PetscReal CostForecastMemory(Study study, PetscInt order, PetscInt unknowns);
/* Largest unknowns of the next level. Not collective.
   [in] record - of the next coarser level of that order */
PetscInt CostForecastUnknowns(Study study, const Record *record);

/* --- studyfiles.c: files, rewritten after every run --- */

/* The summary of the best run, with the block "study". Not collective.
   [out] text - on the first rank, owned by the caller (free()); NULL on others, and without fields */
PetscErrorCode StudySummary(Study study, char **text);

/* Completes the files of all runs so far. Collective. */
PetscErrorCode StudyWriteFiles(Study study);
/* Takes fields and summary of the finest run of the highest order so far; without a solution, the motion that
   shows that. StudyWriteFiles() completes their files. Collective. */
PetscErrorCode StudyWriteBest(Study study, Run run);

#endif
