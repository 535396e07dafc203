/* study.c -- the runs of a study. */
#include "base/compat.h"
#include "base/usererror.h"
#include "base/interrupt.h"
#include "base/memory.h"
#include "study/costforecast.h"
#include "output/output.h"
#include "output/htmlreport.h"
#include "result/probes.h"
#include "base/terminal.h"
#include "base/warning.h"
#include <stdlib.h>
#include <string.h>
#include "study/extrapolation.h"
#include "study/marking.h"
#include "study/promotion.h"
#include "study/study.h"
#include "study/studyimpl.h"
#include "study/tablerow.h"

enum { BAR_LEVELS = 3 }; /* least number of solved meshes that error bars need */

/* Sets the order of all bodies of the scene. */
static void StudySetOrder_Private(Study study, PetscInt order)
{
  for (PetscInt b = 0; b < study->scene->num_bodies; b++)
    study->scene->bodies[b].order = order == STUDY_OWN_ORDERS ? study->own_orders[b] : order;
}

/* Whether a run fits into the memory that is allowed; if not, the record has the reason.
   [in] held - bytes in use; [out] fits */
static PetscErrorCode StudyFitsMemory_Private(Study study, Record *record, PetscReal held, PetscBool *fits)
{
  const PetscReal allowed = study->scene->study.memory;

  PetscFunctionBeginUser;
  record->forecast = held + CostForecastMemory(study, record->order, record->unknowns);
  *fits            = (PetscBool) !(record->forecast > allowed);
  if (!*fits) {
    char needed[BYTES_TEXT], limit[BYTES_TEXT];

    CostForecastPrintBytes(record->forecast, needed);
    CostForecastPrintBytes(allowed, limit);
    PetscCall(PetscSNPrintf(record->reason, sizeof(record->reason), "would need about %s (-study_memory allows %s)",
                            needed, limit));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Makes the mesh of an order, or refines it, if that fits into memory.
   [in] held - bytes in use; [out] made - whether it did */
static PetscErrorCode StudyMakeMesh_Private(Study study, PetscInt o, Record *record, PetscReal held, PetscBool *made)
{
  const Scene scene = study->scene;

  PetscFunctionBeginUser;
  *made = PETSC_TRUE;
  if (record->level) { // the size of a mesh is known after its refinement only
    const Record *before = &record[-study->num_orders];

    record->unknowns = CostForecastUnknowns(study, before);
    PetscCall(StudyFitsMemory_Private(study, record, held, made));
    if (before->state == RECORD_SKIPPED) *made = PETSC_FALSE;
    if (!*made) PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(LogStageBegin(STAGE_SETUP));
  if (record->level) {
    PetscCall(study->marked[o] ? MeshAdapt(study->mesh[o], study->marked[o]) : MeshRefine(study->mesh[o]));
  } else {
    PetscCall(MeshCreate(scene, &study->mesh[o]));
    PetscCall(MeshSetUp(study->mesh[o]));
    PetscCall(ProbesCheck(scene, study->mesh[o]));
  }
  PetscCall(LogStageEnd(STAGE_SETUP));
  PetscCall(RecordMesh(record, MeshFinest(study->mesh[o])));
  PetscCall(StudyFitsMemory_Private(study, record, held, made));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Interpolates the solution of the next coarser run to the mesh of this run.
   [out] guess - owned by the caller; NULL without such a run */
static PetscErrorCode StudyGetGuess_Private(Study study, PetscInt o, const Record *record, Vec *guess)
{
  const PetscInt first   = study->mesh[o]->own;
  const Record  *coarser = StudyFindCoarser(study, record->order, record->level);

  PetscFunctionBeginUser;
  *guess = NULL;
  if (coarser)
    PetscCall(PromotionApply(study->mesh[o], first + coarser->level, first + record->level, coarser->u, guess));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks the cells that the next mesh of an adaptive study refines: all cells, if there are no fields. */
static PetscErrorCode StudyMark_Private(Study study, PetscInt o, Run run)
{
  const Level *level = MeshFinest(study->mesh[o]);
  Estimate     estimate;

  PetscFunctionBeginUser;
  PetscCall(PetscFree(study->marked[o]));
  if (run->fields) {
    PetscCall(EstimateGet(run->fields, &estimate));
    PetscCall(MarkingCreate(level, estimate->cell, estimate->norm, study->scene->adapt.marking, PETSC_FALSE,
                            &study->marked[o], NULL));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscMalloc1(level->num_cells, &study->marked[o]));
  for (PetscInt c = 0; c < level->num_cells; c++) study->marked[o][c] = 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves on the finest mesh of an order, and fills the record.
   [out] refused - whether there is no solution */
static PetscErrorCode StudySolve_Private(Study study, PetscInt o, Record *record, PetscBool *refused)
{
  Run     run;
  Vec     guess;
  char    order[ERROR_TEXT], label[ERROR_TEXT + 32];
  Record *coarser = StudyFindCoarser(study, record->order, record->level);

  PetscFunctionBeginUser;
  PetscCall(StudyTableAnnounce(study, record));
  PetscCall(LogStageBegin(STAGE_SOLVE));
  PetscCall(StudyGetGuess_Private(study, o, record, &guess));
  PetscCall(LogStageEnd(STAGE_SOLVE));
  RecordOrderText(record, order);
  PetscCall(PetscSNPrintf(label, sizeof(label), "%s, level %" PetscInt_FMT, order, record->level));
  WarningSetLabel(label);
  PetscCall(RunCreate(study->scene, study->mesh[o], guess, &run));
  study->scene->view = PETSC_FALSE; // of the first run only
  PetscCall(VecDestroy(&guess));
  PetscCall(RecordRun(study, run, record));
  *refused = run->refused;
  if (study->scene->study.kind == STUDY_ADAPTIVE) PetscCall(StudyMark_Private(study, o, run));
  if (run->refused && study->best < 0) PetscCall(StudyWriteBest(study, run));
  if (run->solved) {
    if (study->exact && coarser) PetscCall(VecDestroy(&coarser->u)); // else finer runs are compared with it
    PetscCall(PetscObjectReference((PetscObject)run->fields->u));
    record->u = run->fields->u;
    PetscCall(MeshHistoryAdd(&study->history[o], run, record->total));
    if (study->best < 0 || record->order >= study->records[study->best].order) {
      study->best = (PetscInt)(record - study->records);
      if (study->history[o].num >= BAR_LEVELS) PetscCall(MeshHistoryDescribe(&study->history[o], run));
      PetscCall(StudyWriteBest(study, run));
    }
  }
  PetscCall(RunDestroy(&run));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Makes the mesh, solves and writes files.
   [out] solved - whether the run is solved or skipped; [out] refused - whether there is no solution */
static PetscErrorCode StudyRunOne_Private(Study study, PetscInt o, PetscInt level, PetscBool *solved,
                                          PetscBool *refused)
{
  const MPI_Comm comm = study->scene->comm;
  Record        *record;
  PetscReal      held;
  PetscBool      done;

  PetscFunctionBeginUser;
  *solved  = PETSC_TRUE;
  *refused = PETSC_FALSE;
  StudySetOrder_Private(study, study->scene->study.orders[o]);
  PetscCall(StudyAddRecord(study, study->scene->study.orders[o], level, &record));
  PetscCall(LogReset(LogWallClock()));
  PetscCall(MemoryPeakReset(comm, &done));
  PetscCall(MemoryPeak(comm, &held, NULL));
  PetscCall(StudyMakeMesh_Private(study, o, record, held, &done));
  if (done) {
    PetscCall(StudySolve_Private(study, o, record, refused));
    record->own_memory = record->memory - held;
    *solved            = (PetscBool)(record->state == RECORD_SOLVED);
  }
  PetscCall(MeshComparisonRun(study));
  StudyComputeRates(study);
  PetscCall(StudyTableAdd(study, record));
  PetscCall(StudyWriteFiles(study));
  if (record->state == RECORD_NOT_SOLVED) {
    char order[ERROR_TEXT];

    RecordOrderText(record, order);
    PetscCall(PetscFPrintf(comm, PETSC_STDERR, "mortise: %s, level %" PetscInt_FMT " is not solved: %s\n", order, level,
                           record->reason));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Writes the summary to the file of -summary, or prints it. */
static PetscErrorCode StudyWriteSummary_Private(Study study)
{
  const Scene scene = study->scene;
  char       *text;

  PetscFunctionBeginUser;
  if (!scene->summary || !study->shown) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(StudySummary(study, &text));
  if (strcmp(scene->summary, "-"))
    PetscCall(OutputWriteText(scene->comm, scene->summary, text));
  else if (text)
    puts(text);
  free(text);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of skipped runs. */
static PetscErrorCode StudyWarnSkipped_Private(Study study)
{
  const Record *first = NULL;
  PetscInt      num   = 0;
  char          order[ERROR_TEXT];

  PetscFunctionBeginUser;
  for (PetscInt r = 0; r < study->num; r++)
    if (study->records[r].state == RECORD_SKIPPED && !num++) first = &study->records[r];
  if (!num) PetscFunctionReturn(PETSC_SUCCESS);
  RecordOrderText(first, order);
  PetscCall(WarningAdd(&(Warning){.code = "skipped_run", .advice = "raise -study_memory, or ask for fewer levels"},
                       "%" PetscInt_FMT " of %" PetscInt_FMT
                       " runs of the study were skipped; the first, %s, level %" PetscInt_FMT ", %s",
                       num, study->num, order, first->level, first->reason));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Warns of results of the study as a whole, after all runs. Collective. */
static PetscErrorCode StudyWarn_Private(Study study)
{
  PetscFunctionBeginUser;
  if (study->best < 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(StudyWarnSkipped_Private(study));
  PetscCall(ExtrapolationWarn(study));
  PetscCall(StudyWriteFiles(study));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StudyRun(Scene scene, MortiseExit *verdict)
{
  const SceneStudy *plan = &scene->study;
  PetscBool         all = PETSC_TRUE, none = PETSC_FALSE, solved, refused;
  Study             study;

  PetscFunctionBeginUser;
  PetscCall(TableCheckName(scene, "study", "the study itself"));
  PetscCall(StudyCreate(scene, &study));
  PetscCall(TerminalIsPresent(scene->comm, &study->terminal));
  study->quiet = (PetscBool)(scene->quiet || (scene->summary && !strcmp(scene->summary, "-")));
  PetscCall(InterruptBegin());
  PetscCall(StudyWriteFiles(study));
  PetscCall(StudyTableBegin(study));
  for (PetscInt level = 0; level < plan->levels; level++) {
    for (PetscInt o = 0; o < plan->num_orders; o++) {
      PetscCall(StudyRunOne_Private(study, o, level, &solved, &refused));
      none = (PetscBool)(none || refused);
      all  = (PetscBool)(all && solved);
    }
  }
  PetscCall(StudyWarn_Private(study));
  PetscCall(StudyWriteSummary_Private(study));
  PetscCall(StudyTableEnd(study));
  if (study->best < 0 && all)
    PetscCall(PetscFPrintf(scene->comm, PETSC_STDERR, "mortise: no run fits into -study_memory\n"));
  if (!study->shown) HTMLReportGiveUp("no run is solved");
  *verdict = all && study->best >= 0   ? MORTISE_SOLVED
             : none && study->best < 0 ? MORTISE_NO_SOLUTION
                                       : MORTISE_NOT_CONVERGED;
  StudySetOrder_Private(study, STUDY_OWN_ORDERS);
  InterruptSetSentence("");
  PetscCall(InterruptEnd());
  PetscCall(StudyDestroy(&study));
  PetscFunctionReturn(PETSC_SUCCESS);
}
