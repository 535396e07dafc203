/* steps.c -- the loop over load steps, and what is written after each. */
#include "base/compat.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/usererror.h"
#include "base/warning.h"
#include "output/output.h"
#include "output/restartfile.h"
#include "study/adaptive.h"
#include "study/steps.h"
#include "study/stepscolumns.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Times nearer than this part of the larger one, or of 1, are the same. */
static const PetscReal SAME_TIME = 1e-9;

enum { PAIRS_SHOWN = 2, TEXT_LENGTH = PETSC_MAX_PATH_LEN + 256, TIME_TEXT = 32 };

/* The loop. */
typedef struct {
  Scene        scene;    /* borrowed */
  cJSON       *rows;     /* of all steps so far, on all ranks */
  PetscBool    quiet;    /* nothing is printed on stdout */
  PetscBool    repeated; /* all steps are solved on each of the adaptive meshes */
  PetscBool    coarse;   /* all steps are solved, but errors are larger than what was asked for */
  PetscBool    any;      /* whether a step is solved: */
  char         now[TIME_TEXT], last[TIME_TEXT]; /* times of the present step, and of the last solved one */
  OutputSeries series;
  Adaptive     adaptive; /* NULL on one mesh */
  Vec          begin;    /* displacement that -restart begins with, at begin_t; NULL without it */
  PetscReal    begin_t;
} Steps;

/* Faults on a pair whose table would have the name of the steps'. */
static PetscErrorCode StepsCheckNames_Private(Scene scene)
{
  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < scene->num_pairs && scene->output; p++) {
    if (strcmp(scene->pairs[p].name, "steps")) continue;
    PetscCall(UserErrorRaise(scene->comm,
                             "-pairs steps: %s_steps.csv is the table of the load steps; give the pair another name",
                             scene->output));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What is said if a signal comes now. */
static void StepsSetInterruptSentence_Private(const Steps *steps)
{
  const int done = cJSON_GetArraySize(steps->rows);
  char      text[TEXT_LENGTH];

  if (steps->scene->output && done) {
    snprintf(text, sizeof(text), "mortise: interrupted; %s_steps.csv and the other files hold %d finished step%s\n",
             steps->scene->output, done, done == 1 ? "" : "s");
  } else {
    snprintf(text, sizeof(text), "mortise: interrupted; %s\n",
             done ? "nothing is kept without -output" : "no step was finished");
  }
  InterruptSetSentence(text);
}

/* A number of a row, NAN where it has none: numbers are kept as text, with all their digits. */
static double StepsGetNumber_Private(const cJSON *object, const char key[])
{
  const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, key);

  return cJSON_IsRaw(item) ? strtod(item->valuestring, NULL) : NAN;
}

/* " +- 2.1", or nothing. [in] bars - of a pair, or NULL */
static PetscErrorCode StepsPrintBar_Private(const Steps *steps, const cJSON *bars, const char key[])
{
  const double bar = StepsGetNumber_Private(bars, key);

  PetscFunctionBeginUser;
  if (!isnan(bar)) PetscCall(PetscPrintf(steps->scene->comm, " +- %.2g", bar));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "step 3 of 20, t = 0.15: solved, 4 iterations, 0.12 s; joint: force 1.2e3, area 0.31" */
static PetscErrorCode StepsPrint_Private(const Steps *steps, PetscInt i, const cJSON *row)
{
  const MPI_Comm  comm       = steps->scene->comm;
  const char     *status     = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(row, "status"));
  const PetscBool refused    = (PetscBool)(strcmp(status, "no_solution") == 0);
  const int       iterations = (int)StepsGetNumber_Private(row, "iterations");
  const cJSON *bars  = cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(row, "bars"), "pairs"), *pair;
  PetscInt     shown = 0;

  PetscFunctionBeginUser;
  if (steps->quiet) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscPrintf(comm, "step %" PetscInt_FMT " of %" PetscInt_FMT ", t = %.9g: %s", i + 1,
                        steps->scene->steps.num, StepsGetNumber_Private(row, "t"),
                        refused                         ? "no solution"
                        : strcmp(status, "solved") == 0 ? "solved"
                                                        : "NOT SOLVED"));
  if (!refused)
    PetscCall(PetscPrintf(comm, ", %d iteration%s, %.2g s", iterations, iterations == 1 ? "" : "s",
                          StepsGetNumber_Private(row, "seconds")));
  cJSON_ArrayForEach(pair, cJSON_GetObjectItemCaseSensitive(row, "pairs"))
  {
    const cJSON *own = cJSON_GetObjectItemCaseSensitive(bars, pair->string);

    if (refused || shown++ == PAIRS_SHOWN) break;
    PetscCall(PetscPrintf(comm, "%s %s: force %.5g", shown == 1 ? ";" : ",", pair->string,
                          StepsGetNumber_Private(pair, "normal_force")));
    PetscCall(StepsPrintBar_Private(steps, own, "normal_force"));
    PetscCall(PetscPrintf(comm, ", area %.4g", StepsGetNumber_Private(pair, "area")));
    PetscCall(StepsPrintBar_Private(steps, own, "area"));
  }
  PetscCall(PetscPrintf(comm, "\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The summary as a file or on stdout. [in] text - of the first rank */
static PetscErrorCode StepsAddSummary_Private(const Steps *steps, Output output, const char text[])
{
  const Scene scene = steps->scene;
  char        path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  if (scene->summary && strcmp(scene->summary, "-")) PetscCall(OutputAddText(output, scene->summary, text));
  if (!scene->output) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s.json", scene->output));
  PetscCall(OutputAddText(output, path, text)); // the last: where it is, the result is complete
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Completes all files. [in] fields - whether those of a new step are among them; [out] text - the summary, of the first rank, owned by the
   caller (free()) */
static PetscErrorCode StepsWrite_Private(Steps *steps, Run run, PetscBool fields, char **text)
{
  const Scene  scene = steps->scene;
  SummaryInput input = RunSummary(run);
  Output       output;

  PetscFunctionBeginUser;
  PetscCall(OutputCreate(scene->comm, &output));
  if (scene->output) {
    PetscCall(LogStageBegin(STAGE_OUTPUT));
    if (fields && !run->refused)
      PetscCall(OutputAddStep(output, steps->series, run->fields, run->solved));
    else if (fields && !steps->any)
      PetscCall(OutputAddMotion(output, run->vi, &run->solvability->motion));
    PetscCall(StepsAddTable(output, scene, steps->rows));
    PetscCall(LogStageEnd(STAGE_OUTPUT));
  }
  input.steps = steps->rows;
  PetscCall(SummaryCreate(&input, text));
  PetscCall(StepsAddSummary_Private(steps, output, *text));
  InterruptHold();
  PetscCall(OutputFinish(&output));
  StepsSetInterruptSentence_Private(steps);
  InterruptRelease();
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves at one time, and tells of it. [in] guess - for the first, or NULL; [out] text - as of StepsWrite_Private() */
static PetscErrorCode StepsSolve_Private(Steps *steps, PetscInt i, Mesh mesh, Vec guess, Run *run, char **text)
{
  const Scene  scene = steps->scene;
  char         label[TEXT_LENGTH];
  SummaryInput input;
  cJSON       *row;

  PetscFunctionBeginUser;
  if (i) PetscCall(LogReset(LogWallClock()));
  PetscCall(SceneSetTime(scene, scene->steps.t[i]));
  (void)snprintf(steps->now, sizeof(steps->now), "%.9g", (double)scene->time);
  PetscCall(PetscSNPrintf(label, sizeof(label), "t = %s", steps->now));
  WarningSetLabel(label);
  if (steps->adaptive && !steps->repeated)
    PetscCall(AdaptiveSolve(steps->adaptive, guess, run));
  else if (steps->begin && !*run)
    PetscCall(RunCreateAfter(scene, mesh, steps->begin, steps->begin_t, run));
  else
    PetscCall(*run ? RunAdvance(guess, run) : RunCreate(scene, mesh, guess, run));
  scene->view = PETSC_FALSE; // of the first step only
  if (steps->repeated) {
    WarningRetain();
    if ((*run)->solved) PetscCall(AdaptiveAddStep(steps->adaptive, i, *run));
  }
  input = RunSummary(*run);
  PetscCall(SummaryCreateStep(&input, &row));
  cJSON_AddItemToArray(steps->rows, row);
  if (!steps->repeated) PetscCall(StepsPrint_Private(steps, i, row));
  PetscCall(StepsWrite_Private(steps, *run, PETSC_TRUE, text));
  if ((*run)->solved) {
    steps->any = PETSC_TRUE;
    PetscCall(PetscStrncpy(steps->last, steps->now, sizeof(steps->last)));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* What is said in the end: the last step, as of a scene without steps, and where they end. */
static PetscErrorCode StepsPrintEnd_Private(const Steps *steps, Run run, const char text[])
{
  const Scene    scene = steps->scene;
  const PetscInt done  = cJSON_GetArraySize(steps->rows);
  SummaryInput   input = RunSummary(run);

  PetscFunctionBeginUser;
  if (scene->summary && !strcmp(scene->summary, "-") && text) puts(text);
  PetscCall(SummaryPrintEnd(&input, steps->quiet));
  if (!steps->quiet && scene->output)
    PetscCall(PetscPrintf(scene->comm, "  wrote %s_steps.csv: %" PetscInt_FMT " step%s\n", scene->output, done,
                          done == 1 ? "" : "s"));
  if (run->solved || steps->coarse) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscFPrintf(scene->comm, PETSC_STDERR, "mortise: %s at t = %s; ",
                         run->refused ? "there is no solution" : "not solved", steps->now));
  if (steps->any)
    PetscCall(PetscFPrintf(scene->comm, PETSC_STDERR, "the last solution is that of t = %s\n", steps->last));
  else
    PetscCall(PetscFPrintf(scene->comm, PETSC_STDERR, "this is the first load step\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Omits the steps that the file of -restart has behind it. */
static PetscErrorCode StepsOmit_Private(Scene scene, PetscReal t)
{
  SceneSteps     *plan = &scene->steps;
  const PetscReal near = SAME_TIME * PetscMax(PetscAbsReal(t), 1);
  PetscInt        omit = 0, times = 0;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < plan->num; i++) {
    const PetscBool same = (PetscBool)(PetscAbsReal(plan->t[i] - t) <= near);

    if (same) times++;
    if (same || (plan->counted && plan->t[i] < t)) omit = i + 1;
  }
  if (times > 1)
    PetscCall(UserErrorRaise(scene->comm,
                             "-restart %s: it ends at t = %.9g, which occurs %" PetscInt_FMT
                             " times in -load_steps; give those that are to follow",
                             plan->restart, (double)t, times));
  if (omit == plan->num)
    PetscCall(UserErrorRaise(scene->comm, "-restart %s: it ends at t = %.9g, and -load_steps has no step behind that",
                             plan->restart, (double)t));
  plan->num -= omit;
  PetscCall(PetscArraymove(plan->t, plan->t + omit, plan->num));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes up the run of -restart. */
static PetscErrorCode StepsRestart_Private(Steps *steps, Mesh mesh, Run *run)
{
  const Scene scene = steps->scene;

  PetscFunctionBeginUser;
  if (!scene->steps.restart) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(RunDestroy(run));
  PetscCall(RestartFileRead(MeshFinest(mesh), scene->steps.restart, &steps->begin, &steps->begin_t));
  PetscCall(StepsOmit_Private(scene, steps->begin_t));
  if (!steps->quiet)
    PetscCall(PetscPrintf(scene->comm, "goes on from t = %.9g of %s\n", (double)steps->begin_t, scene->steps.restart));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All steps, until one is not solved. [in] guess - for the first, or NULL; [in,out] text - as of StepsWrite_Private() */
static PetscErrorCode StepsSolveAll_Private(Steps *steps, Mesh mesh, Vec guess, Run *run, char **text)
{
  const SceneSteps *plan = &steps->scene->steps;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < plan->num && (!i || (*run)->solved); i++) {
    free(*text);
    *text = NULL;
    PetscCall(StepsSolve_Private(steps, i, mesh, i ? NULL : guess, run, text));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Behind the last mesh: prints the steps, and says which of them have larger errors than what was asked for. [in] met - whether none has;
   [in,out] text - as of StepsWrite_Private() */
static PetscErrorCode StepsJudge_Private(Steps *steps, PetscBool met, Run run, char **text)
{
  cJSON   *row;
  PetscInt i = 0;

  PetscFunctionBeginUser;
  cJSON_ArrayForEach(row, steps->rows)
  {
    if (!met && !AdaptiveStepIsMet(steps->adaptive, i))
      cJSON_ReplaceItemInObjectCaseSensitive(row, "status", cJSON_CreateString("not_converged"));
    PetscCall(StepsPrint_Private(steps, i++, row));
  }
  if (met) PetscFunctionReturn(PETSC_SUCCESS);
  free(*text);
  PetscCall(StepsWrite_Private(steps, run, PETSC_FALSE, text));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All steps on one mesh after the other. Files have the steps of the latest mesh. [in] first - guess for the first, or NULL; [in,out] text -
   as of StepsWrite_Private() */
static PetscErrorCode StepsRepeat_Private(Steps *steps, Mesh mesh, Vec first, Run *run, char **text)
{
  Vec       guess = NULL;
  PetscBool all; // steps are solved

  PetscFunctionBeginUser;
  WarningHold();
  while (PETSC_TRUE) {
    PetscCall(StepsSolveAll_Private(steps, mesh, guess ? guess : first, run, text));
    PetscCall(VecDestroy(&guess));
    all = (*run)->solved;
    if (all) PetscCall(AdaptiveRefineSteps(steps->adaptive, run, &guess));
    if (!guess) break;
    WarningForgetRetained();
    cJSON_Delete(steps->rows);
    steps->rows = cJSON_CreateArray();
    steps->any  = PETSC_FALSE;
    PetscCall(OutputSeriesDestroy(&steps->series));
    PetscCall(OutputSeriesCreate(steps->scene, &steps->series));
  }
  steps->coarse = (PetscBool)(all && !(*run)->solved);
  PetscCall(StepsJudge_Private(steps, (PetscBool)!steps->coarse, *run, text));
  WarningRelease();
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StepsRun(Scene scene, Mesh mesh, Vec guess, Run *run)
{
  Steps steps = {.scene = scene, .rows = cJSON_CreateArray()};
  char *text  = NULL;

  PetscFunctionBeginUser;
  PetscCall(StepsCheckNames_Private(scene));
  steps.repeated = SceneRepeatsSteps(scene);
  steps.quiet    = (PetscBool)(scene->quiet || (scene->summary && !strcmp(scene->summary, "-")));
  PetscCall(StepsRestart_Private(&steps, mesh, run));
  PetscCall(InterruptBegin());
  StepsSetInterruptSentence_Private(&steps);
  PetscCall(OutputSeriesCreate(scene, &steps.series));
  if (scene->adapt.on) {
    PetscCall(RunDestroy(run)); // the meshes that its bars were made of are gone
    PetscCall(AdaptiveCreate(scene, mesh, &steps.adaptive));
  }
  PetscCall(steps.repeated ? StepsRepeat_Private(&steps, mesh, guess, run, &text)
                           : StepsSolveAll_Private(&steps, mesh, guess, run, &text));
  WarningSetLabel("");
  PetscCall(StepsPrintEnd_Private(&steps, *run, text));
  free(text);
  cJSON_Delete(steps.rows);
  PetscCall(OutputSeriesDestroy(&steps.series));
  PetscCall(VecDestroy(&steps.begin));
  if (steps.adaptive) PetscCall(AdaptiveDestroy(&steps.adaptive));
  InterruptSetSentence("");
  PetscCall(InterruptEnd());
  PetscFunctionReturn(PETSC_SUCCESS);
}
