/* studytable.c -- the table of a study on the terminal. */
#include "base/compat.h"
#include "study/extrapolation.h"
#include "study/studyimpl.h"

enum { CELL = 24, LINE = 100 }; /* longest text of a number, of a line that is overwritten */

static const PetscReal MEGABYTE = 1048576;

/* A number that may be unknown. */
static const char *StudyTableCell_Private(const char format[], PetscReal value, char text[CELL])
{
  if (PetscIsNanReal(value))
    snprintf(text, CELL, "-");
  else
    snprintf(text, CELL, format, (double)value);
  return text;
}

/* The order of a run in one letter or two. */
static const char *StudyTableOrder_Private(const Record *record, char text[CELL])
{
  if (record->order == STUDY_OWN_ORDERS)
    snprintf(text, CELL, "own");
  else
    snprintf(text, CELL, "%" PetscInt_FMT, record->order);
  return text;
}

PetscErrorCode StudyTableBegin(Study study)
{
  const MPI_Comm comm = study->scene->comm;

  PetscFunctionBeginUser;
  if (study->quiet) PetscFunctionReturn(PETSC_SUCCESS);
  if (study->scene->title[0]) PetscCall(PetscPrintf(comm, "%s\n", study->scene->title));
  PetscCall(PetscPrintf(comm, "  order level  unknowns         h  steps  active  %s  seconds    memory\n",
                        study->exact ? "rel. error   rate" : "  potential energy"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StudyTableAnnounce(Study study, const Record *record)
{
  char order[ERROR_TEXT];

  PetscFunctionBeginUser;
  if (study->quiet || !study->terminal) PetscFunctionReturn(PETSC_SUCCESS);
  RecordOrderText(record, order);
  PetscCall(PetscPrintf(study->scene->comm, "  solving %s, level %" PetscInt_FMT ": %" PetscInt_FMT " unknowns ...%s",
                        order, record->level, record->unknowns, study->scene->monitor ? "\n" : ""));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StudyTableAdd(Study study, const Record *record)
{
  const MPI_Comm comm = study->scene->comm;
  char           texts[8][CELL], error[2 * CELL + 8];

  PetscFunctionBeginUser;
  if (study->quiet) PetscFunctionReturn(PETSC_SUCCESS);
  if (study->terminal && !study->scene->monitor) PetscCall(PetscPrintf(comm, "\r%*s\r", LINE, ""));
  PetscCall(PetscPrintf(comm, "  %5s %5" PetscInt_FMT " %9" PetscInt_FMT, StudyTableOrder_Private(record, texts[0]),
                        record->level, record->unknowns));
  if (record->state == RECORD_SKIPPED) {
    PetscCall(PetscPrintf(comm, "  skipped: %s\n", record->reason));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (study->exact)
    snprintf(error, sizeof(error), "%10s %6s", StudyTableCell_Private("%.3e", record->errors[0].relative, texts[1]),
             StudyTableCell_Private("%.2f", record->errors[0].rate, texts[2]));
  else
    snprintf(error, sizeof(error), "%18s", StudyTableCell_Private("%.10g", record->values[0], texts[1]));
  PetscCall(PetscPrintf(comm, " %9.3e  %5" PetscInt_FMT "  %6" PetscInt_FMT "  %s %8s %9s%s\n", (double)record->h,
                        record->iterations, record->active, error,
                        StudyTableCell_Private("%.2f", record->total, texts[3]),
                        StudyTableCell_Private("%.0f MB", record->memory / MEGABYTE, texts[4]),
                        record->state == RECORD_SOLVED ? "" : "  NOT SOLVED"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Prints differences from the finest run, which are known at the end only. */
static PetscErrorCode StudyTablePrintDifferences_Private(Study study)
{
  const MPI_Comm comm = study->scene->comm;
  char           reference[ERROR_TEXT], texts[5][CELL];

  PetscFunctionBeginUser;
  MeshComparisonReferenceText(study, reference);
  PetscCall(PetscPrintf(comm,
                        "differences from %s, which stands for the exact solution\n"
                        "  order level  unknowns   energy norm   rate            L2   rate   seconds\n",
                        reference));
  for (PetscInt r = 0; r < study->num; r++) {
    const Record *record = &study->records[r];

    if (PetscIsNanReal(record->errors[0].absolute)) continue;
    PetscCall(PetscPrintf(comm, "  %5s %5" PetscInt_FMT " %9" PetscInt_FMT "  %12s %6s  %12s %6s  %8.2f\n",
                          StudyTableOrder_Private(record, texts[0]), record->level, record->unknowns,
                          StudyTableCell_Private("%.3e", record->errors[0].relative, texts[1]),
                          StudyTableCell_Private("%.2f", record->errors[0].rate, texts[2]),
                          StudyTableCell_Private("%.3e", record->errors[1].relative, texts[3]),
                          StudyTableCell_Private("%.2f", record->errors[1].rate, texts[4]),
                          (double)record->with_coarser));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether some run can be compared with a finer one. */
static PetscBool StudyTableHasDifferences_Private(Study study)
{
  for (PetscInt r = 0; study->num_errors && r < study->num; r++)
    if (!PetscIsNanReal(study->records[r].errors[0].absolute)) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* Prints the names of the files. */
static PetscErrorCode StudyTablePrintFiles_Private(Study study)
{
  const MPI_Comm comm  = study->scene->comm;
  const Scene    scene = study->scene;

  PetscFunctionBeginUser;
  if (scene->output) {
    PetscCall(PetscPrintf(comm, "wrote %s_study.csv", scene->output));
    if (study->shown) {
      PetscCall(PetscPrintf(comm, ", .json"));
      PetscCall(OutputPrintNames(scene, (PetscBool)(study->best >= 0)));
    }
    PetscCall(PetscPrintf(comm, "\n"));
  }
  if (scene->summary) PetscCall(PetscPrintf(comm, "wrote %s\n", scene->summary));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StudyTableEnd(Study study)
{
  PetscFunctionBeginUser;
  if (study->quiet) PetscFunctionReturn(PETSC_SUCCESS);
  if (!study->exact && StudyTableHasDifferences_Private(study)) PetscCall(StudyTablePrintDifferences_Private(study));
  PetscCall(ExtrapolationPrint(study));
  PetscCall(StudyTablePrintFiles_Private(study));
  PetscFunctionReturn(PETSC_SUCCESS);
}
