/* studyfiles.c -- table and summary of a study, rewritten after every run. */
#include <cjson/cJSON.h>
#include "base/compat.h"
#include "base/interrupt.h"
#include "base/json.h"
#include "base/warning.h"
#include "output/output.h"
#include <stdlib.h>
#include "study/extrapolation.h"
#include "study/studyimpl.h"
#include "study/tablerow.h"

/* --- <output>_study.csv --------------------------------------------------------------------------------- */

static void StudyRowFn(void *ctx, const Column *column)
{
  char text[32] = "nan"; // printf may add a sign to it

  if (column->kind == COLUMN_COUNT && column->count >= 0)
    snprintf(text, sizeof(text), "%" PetscInt_FMT, column->count);
  else if (column->kind == COLUMN_REAL && !PetscIsNanReal(column->real))
    snprintf(text, sizeof(text), "%.17g", (double)column->real);
  TableRowAdd(ctx, column->name, column->kind == COLUMN_WORD ? column->word : text);
}

static void StudyWriteTable_Private(Study study, FILE *out)
{
  for (PetscInt r = -1; r < study->num; r++) {
    TableRow row = {.out = out, .names = (PetscBool)(r < 0)};

    StudyColumnsVisit(study, &study->records[PetscMax(r, 0)], PETSC_TRUE, StudyRowFn, &row);
    if (r < study->num - 1) fputc('\n', out);
  }
}

/* --- the block "study" of the summary ------------------------------------------------------------------- */

static void StudyObjectFn(void *ctx, const Column *column)
{
  cJSON *object = ctx;

  if (column->kind == COLUMN_WORD)
    cJSON_AddStringToObject(object, column->name, column->word);
  else if (column->kind == COLUMN_REAL)
    JSONAddReal(object, column->name, column->real);
  else if (column->count >= 0)
    JSONAddInt(object, column->name, column->count);
  else
    cJSON_AddNullToObject(object, column->name);
}

static void StudyAddExtrapolated_Private(Study study, cJSON *root)
{
  cJSON *quantities = cJSON_AddObjectToObject(root, "richardson");

  for (PetscInt q = 0; q < study->num_quantities; q++) {
    cJSON         *quantity = NULL, *orders = NULL;
    const PetscInt best = ExtrapolationFindBest(study, q);

    for (PetscInt o = 0; o < study->num_orders; o++) {
      const PetscInt order = study->scene->study.orders[o];
      Extrapolation  limit;
      char           key[16];
      cJSON         *object;

      if (!ExtrapolationOfQuantity(study, q, order, &limit)) continue;
      if (!quantity) {
        Extrapolation chosen;
        char          text[RICHARDSON_TEXT];

        (void)ExtrapolationOfQuantity(study, q, best, &chosen);
        quantity = cJSON_AddObjectToObject(quantities, study->quantities[q].name);
        JSONAddReal(quantity, "value", chosen.value);
        JSONAddReal(quantity, "uncertainty", chosen.bar);
        JSONAddInt(quantity, "order", best);
        RichardsonText(&chosen, text, sizeof(text));
        if (!ExtrapolationVanishes(study, q, &chosen)) cJSON_AddStringToObject(quantity, "text", text);
        orders = cJSON_AddObjectToObject(quantity, "orders");
      }
      snprintf(key, sizeof(key), "%d", (int)order);
      object = cJSON_AddObjectToObject(orders, key);
      JSONAddReal(object, "value", limit.value);
      JSONAddReal(object, "uncertainty", limit.bar);
      JSONAddReal(object, "rate", limit.rate);
      cJSON_AddBoolToObject(object, "monotone", limit.monotone);
    }
  }
}

/* The block. Owned by the caller. */
static cJSON *StudyCreateBlock_Private(Study study)
{
  cJSON *root = cJSON_CreateObject(), *runs;
  char   reference[ERROR_TEXT];

  MeshComparisonReferenceText(study, reference);
  cJSON_AddStringToObject(root, "kind", study->scene->study.kind == STUDY_ADAPTIVE ? "adaptive" : "uniform");
  cJSON_AddItemToObject(root, "reference", reference[0] ? cJSON_CreateString(reference) : cJSON_CreateNull());
  runs = cJSON_AddArrayToObject(root, "runs");
  for (PetscInt r = 0; r < study->num; r++) {
    cJSON *run = cJSON_CreateObject();

    StudyColumnsVisit(study, &study->records[r], PETSC_FALSE, StudyObjectFn, run);
    cJSON_AddItemToArray(runs, run);
  }
  StudyAddExtrapolated_Private(study, root);
  return root;
}

PetscErrorCode StudySummary(Study study, char **text)
{
  cJSON      *root;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  *text = NULL;
  PetscCallMPI(MPI_Comm_rank(study->scene->comm, &rank));
  if (!study->summary || rank) PetscFunctionReturn(PETSC_SUCCESS);
  root = cJSON_Duplicate(study->summary, cJSON_True);
  WarningListUpdate(cJSON_GetObjectItemCaseSensitive(root, "warnings"));
  cJSON_AddItemToObject(root, "study", StudyCreateBlock_Private(study));
  *text = cJSON_Print(root);
  cJSON_Delete(root);
  PetscCheck(*text, PETSC_COMM_SELF, PETSC_ERR_MEM, "No memory for the summary");
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* --- all of them ---------------------------------------------------------------------------------------- */

/* Writes a file, whose text a callback makes on the first rank. Collective. */
static PetscErrorCode StudyWriteFile_Private(Study study, const char suffix[], void (*write)(Study, FILE *))
{
  char        path[PETSC_MAX_PATH_LEN], *text = NULL;
  size_t      size;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(study->scene->comm, &rank));
  if (!rank) {
    FILE *out = open_memstream(&text, &size);

    PetscCheck(out, PETSC_COMM_SELF, PETSC_ERR_MEM, "No memory for %s", suffix);
    (*write)(study, out);
    PetscCheck(!fclose(out) && text, PETSC_COMM_SELF, PETSC_ERR_MEM, "No memory for %s", suffix);
  }
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s%s", study->scene->output, suffix));
  PetscCall(OutputAddText(study->output, path, text));
  free(text);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the sentence of an interruption. */
static void StudySetInterruptSentence_Private(Study study)
{
  const Scene       scene = study->scene;
  const char *const line  = study->terminal ? "\n" : ""; // below that of StudyTableAnnounce()
  char              text[PETSC_MAX_PATH_LEN + 256];
  PetscInt          done = 0;

  for (PetscInt r = 0; r < study->num; r++) done += study->records[r].state != RECORD_SKIPPED;
  if (scene->output && done) {
    snprintf(text, sizeof(text),
             "%smortise: interrupted; %s_study.csv and the other files hold the %" PetscInt_FMT " finished run%s\n",
             line, scene->output, done, done == 1 ? "" : "s");
  } else {
    snprintf(text, sizeof(text), "%smortise: interrupted; %s\n", line,
             done ? "nothing is kept without -output" : "no run was finished");
  }
  InterruptSetSentence(text);
}

PetscErrorCode StudyWriteFiles(Study study)
{
  char path[PETSC_MAX_PATH_LEN], *text;

  PetscFunctionBeginUser;
  if (study->scene->output && study->num) {
    if (!study->output) PetscCall(OutputCreate(study->scene->comm, &study->output));
    PetscCall(StudyWriteFile_Private(study, "_study.csv", StudyWriteTable_Private));
    if (study->shown) {
      PetscCall(StudySummary(study, &text));
      PetscCall(PetscSNPrintf(path, sizeof(path), "%s.json", study->scene->output));
      PetscCall(OutputAddText(study->output, path, text)); // the last file: if it is there, the result is complete
      free(text);
    }
    InterruptHold();
    PetscCall(OutputFinish(&study->output));
    StudySetInterruptSentence_Private(study);
    InterruptRelease();
  } else {
    StudySetInterruptSentence_Private(study);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StudyWriteBest(Study study, Run run)
{
  const SummaryInput input = RunSummary(run);

  PetscFunctionBeginUser;
  cJSON_Delete(study->summary);
  PetscCall(SummaryCreateTree(&input, &study->summary));
  if (study->scene->output) {
    PetscCall(OutputCreate(study->scene->comm, &study->output));
    PetscCall(run->refused ? OutputAddMotion(study->output, run->vi, &run->solvability->motion)
                           : OutputAddFields(study->output, run->fields));
  }
  study->shown = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}
