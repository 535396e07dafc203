/* steps.c -- the loop over load steps, and what is written after each. */
#include "base/compat.h"
#include "base/interrupt.h"
#include "base/json.h"
#include "base/log.h"
#include "base/usererror.h"
#include "base/warning.h"
#include "output/output.h"
#include "output/restartfile.h"
#include "study/adaptiveimpl.h"
#include "study/halvedsteps.h"
#include "study/steps.h"
#include "study/stepscolumns.h"
#include "study/tablerow.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Times nearer than this part of the larger one, or of 1, are the same. */
static const PetscReal SAME_TIME = 1e-9;

enum { PAIRS_SHOWN = 2, TEXT_LENGTH = PETSC_MAX_PATH_LEN + 256, TIME_TEXT = 32 };

/* The loop. */
typedef struct {
  Scene        scene;                           /* borrowed */
  cJSON       *rows;                            /* of all steps so far: SummaryCreateStep(), on all ranks */
  PetscBool    quiet;                           /* nothing is printed on stdout */
  PetscBool    repeated;                        /* all steps are solved on each of the adaptive meshes */
  PetscInt     parts;                           /* of each step; 1 without -load_steps_halved */
  PetscBool    coarse;                          /* all steps are solved, but errors are larger than asked for */
  PetscBool    passing;                         /* another step follows the present one, if that is solved */
  PetscBool    any;                             /* whether a step is solved */
  char         now[TIME_TEXT], last[TIME_TEXT]; /* times of the present step, and of the last solved one */
  OutputSeries series;
  Adaptive     adaptive; /* NULL on one mesh */
  Vec          begin;    /* displacement that -restart begins with, at begin_t; NULL without it */
  PetscReal    begin_t;
} Steps;

/* Sets the sentence of an interruption. */
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

/* " +- 2.1", or nothing. [in] bars - of a pair, or NULL */
static PetscErrorCode StepsPrintBar_Private(const Steps *steps, const cJSON *bars, const char key[])
{
  const double bar = JSONGetReal(bars, key);

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
  const int       iterations = (int)JSONGetReal(row, "iterations");
  const cJSON    *limit      = cJSON_GetObjectItemCaseSensitive(row, "limit");
  const cJSON    *bars = cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(limit ? limit : row, "bars"),
                                                          "pairs"),
              *pair;
  PetscInt shown = 0;

  PetscFunctionBeginUser;
  if (steps->quiet) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscPrintf(comm, "step %" PetscInt_FMT " of %" PetscInt_FMT ", t = %.9g: %s", i + 1,
                        steps->scene->steps.num, JSONGetReal(row, "t"),
                        refused                         ? "no solution"
                        : strcmp(status, "solved") == 0 ? "solved"
                                                        : "NOT SOLVED"));
  if (!refused)
    PetscCall(PetscPrintf(comm, ", %d iteration%s, %.2g s", iterations, iterations == 1 ? "" : "s",
                          JSONGetReal(row, "seconds")));
  cJSON_ArrayForEach(pair, cJSON_GetObjectItemCaseSensitive(row, "pairs"))
  {
    const cJSON *own = cJSON_GetObjectItemCaseSensitive(bars, pair->string);

    if (refused || shown++ == PAIRS_SHOWN) break;
    PetscCall(PetscPrintf(comm, "%s %s: force %.5g", shown == 1 ? ";" : ",", pair->string,
                          JSONGetReal(pair, "normal_force")));
    PetscCall(StepsPrintBar_Private(steps, own, "normal_force"));
    PetscCall(PetscPrintf(comm, ", area %.4g", JSONGetReal(pair, "area")));
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
  PetscCall(OutputAddText(output, path, text)); // the last file: if it is there, the result is complete
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Completes all files.
   [in] fields - whether those of a new step are among them; [out] text - the summary, of the first rank,
   owned by the caller (free()) */
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
  input.steps   = steps->rows;
  input.passing = (PetscBool)(steps->passing && run->solved);
  PetscCall(SummaryCreate(&input, text));
  PetscCall(StepsAddSummary_Private(steps, output, *text));
  InterruptHold();
  PetscCall(OutputFinish(&output));
  StepsSetInterruptSentence_Private(steps);
  InterruptRelease();
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves at one time. [in] guess - for the first, or NULL */
static PetscErrorCode StepsSolveAt_Private(Steps *steps, PetscReal t, Mesh mesh, Vec guess, Run *run)
{
  const Scene scene = steps->scene;
  char        label[TEXT_LENGTH];

  PetscFunctionBeginUser;
  PetscCall(SceneSetTime(scene, t));
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
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a step is the first one, with pretension, which is applied there at once. */
static PetscBool StepsTightens_Private(const Steps *steps, PetscInt i)
{
  for (PetscInt b = 0; !i && b < steps->scene->num_bodies; b++)
    if (steps->scene->bodies[b].pretension) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* Replaces the row of the parts before by that of these and the present one.
   [in,out] before - NULL for none */
static PetscErrorCode StepsAddPart_Private(Run run, cJSON **before)
{
  SummaryInput input = RunSummary(run);
  cJSON       *row;

  PetscFunctionBeginUser;
  PetscCall(SummaryCreateStep(&input, &row));
  HalvedStepsAddParts(row, *before);
  cJSON_Delete(*before);
  *before = row;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Applies the loads of t = 0 at once, before the parts of the first step. Else the first part would add its
   own changes to them, and the path of both depends on its length. Where these loads have no equilibrium, or
   a body is free, the step begins from nothing.
   [in,out] before - of StepsSolveParts_Private() */
static PetscErrorCode StepsBegin_Private(Steps *steps, Mesh mesh, Run *run, cJSON **before)
{
  PetscFunctionBeginUser;
  if (!steps->scene->steps.halved || steps->begin || steps->scene->steps.t[0] == 0 || StepsTightens_Private(steps, 0))
    PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(StepsSolveAt_Private(steps, 0, mesh, NULL, run));
  if (!(*run)->solved || ((*run)->solvability && (*run)->solvability->status != SOLVABLE))
    PetscCall(RunDestroy(run));
  else
    PetscCall(StepsAddPart_Private(*run, before));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves the parts of a step. The first step begins at t = 0, or at the time of -restart. [in] guess - as of
   StepsSolveAt_Private(); [out] before - row of all parts but the last solved one, NULL for none */
static PetscErrorCode StepsSolveParts_Private(Steps *steps, PetscInt i, Mesh mesh, Vec guess, Run *run, cJSON **before)
{
  const PetscReal to = steps->scene->steps.t[i], from = i ? steps->scene->steps.t[i - 1] : steps->begin_t;
  const PetscInt  parts = from != to && !StepsTightens_Private(steps, i) ? steps->parts : 1;

  PetscFunctionBeginUser;
  *before = NULL;
  if (!i) PetscCall(StepsBegin_Private(steps, mesh, run, before));
  for (PetscInt part = 1; part < parts; part++) {
    PetscCall(StepsSolveAt_Private(steps, from + (to - from) * (PetscReal)part / (PetscReal)parts, mesh,
                                   part > 1 ? NULL : guess, run));
    if (!(*run)->solved) PetscFunctionReturn(PETSC_SUCCESS);
    PetscCall(StepsAddPart_Private(*run, before));
  }
  PetscCall(StepsSolveAt_Private(steps, to, mesh, parts > 1 ? NULL : guess, run));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves a step, prints its line and writes files. [in] guess - for the first, or NULL; [out] text - as of
   StepsWrite_Private() */
static PetscErrorCode StepsSolve_Private(Steps *steps, PetscInt i, Mesh mesh, Vec guess, Run *run, char **text)
{
  const PetscBool later = (PetscBool)(steps->repeated || steps->scene->steps.halved); // lines follow after all steps
  SummaryInput    input;
  cJSON          *row, *before;

  PetscFunctionBeginUser;
  steps->passing = (PetscBool)(i + 1 < steps->scene->steps.num);
  if (i) PetscCall(LogReset(LogWallClock()));
  PetscCall(StepsSolveParts_Private(steps, i, mesh, guess, run, &before));
  if (later) WarningRetain();
  if (steps->repeated && (*run)->solved) PetscCall(AdaptiveAddStep(steps->adaptive, i, *run));
  input = RunSummary(*run);
  PetscCall(SummaryCreateStep(&input, &row));
  HalvedStepsAddParts(row, before);
  cJSON_Delete(before);
  cJSON_AddItemToArray(steps->rows, row);
  if (!later) PetscCall(StepsPrint_Private(steps, i, row));
  PetscCall(StepsWrite_Private(steps, *run, PETSC_TRUE, text));
  if ((*run)->solved) {
    steps->any = PETSC_TRUE;
    PetscCall(PetscStrncpy(steps->last, steps->now, sizeof(steps->last)));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Prints the results of the last step, as of a scene without steps, and on stderr the step that was not
   solved. */
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

/* Whether two times are the same. */
static PetscBool StepsAreSame_Private(PetscReal t, PetscReal other)
{
  return (PetscBool)(PetscAbsReal(t - other) <= SAME_TIME * PetscMax(PetscAbsReal(other), 1));
}

/* The number of first steps that the file of -restart has: where a number of steps was given, those up to its
   last time; of a list, as many as the file has if these are the first ones, else 0. */
static PetscInt StepsCountPast_Private(const SceneSteps *plan)
{
  const PetscReal last = plan->past[plan->num_past - 1];
  PetscInt        i    = 0;

  if (plan->counted) {
    while (i < plan->num && (plan->t[i] < last || StepsAreSame_Private(plan->t[i], last))) i++;
    return i;
  }
  while (i < plan->num && i < plan->num_past && StepsAreSame_Private(plan->t[i], plan->past[i])) i++;
  return i == plan->num_past ? i : 0;
}

/* Omits the steps that the file of -restart has. */
static PetscErrorCode StepsOmit_Private(Scene scene)
{
  SceneSteps    *plan = &scene->steps;
  const PetscInt omit = StepsCountPast_Private(plan);

  PetscFunctionBeginUser;
  if (omit == plan->num)
    PetscCall(UserErrorRaise(scene->comm,
                             "-restart %s: it ends at t = %.9g, and has all steps of -load_steps; give those that are "
                             "to follow, behind them or alone",
                             plan->restart, (double)plan->past[plan->num_past - 1]));
  plan->num -= omit;
  PetscCall(PetscArraymove(plan->t, plan->t + omit, plan->num));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads the file of -restart. */
static PetscErrorCode StepsRestart_Private(Steps *steps, Mesh mesh, Run *run)
{
  const Scene    scene = steps->scene;
  const PetscInt num   = scene->steps.num;
  char           omitted[64];

  PetscFunctionBeginUser;
  if (!scene->steps.restart) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(RunDestroy(run));
  PetscCall(RestartFileRead(MeshFinest(mesh), scene->steps.restart, &steps->begin, &scene->steps.num_past,
                            &scene->steps.past));
  steps->begin_t = scene->steps.past[scene->steps.num_past - 1];
  PetscCall(StepsOmit_Private(scene));
  if (num > scene->steps.num)
    PetscCall(PetscSNPrintf(omitted, sizeof(omitted), ", without the first %" PetscInt_FMT " of -load_steps",
                            num - scene->steps.num));
  else
    PetscCall(PetscSNPrintf(omitted, sizeof(omitted), ", with all of -load_steps"));
  if (!steps->quiet)
    PetscCall(PetscPrintf(scene->comm, "goes on from t = %.9g of %s%s\n", (double)steps->begin_t, scene->steps.restart,
                          omitted));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The initial guess of a step: its displacement on the coarser mesh, plus the difference of the meshes in the
   step before.
   [in] coarse - displacements of all steps on the coarser mesh, interpolated to this one;
   [in] run - of the step before;
   [out] guess - ghosted, owned by the caller */
static PetscErrorCode StepsCorrectGuess_Private(const Vec coarse[], PetscInt i, Run run, Vec *guess)
{
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(coarse[i], guess));
  PetscCall(VecCopy(coarse[i], *guess));
  if (i) PetscCall(VecAXPBYPCZ(*guess, 1, -1, 1, run->fields->u, coarse[i - 1]));
  PetscCall(LevelShareVec(*guess, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves all steps, until one is not solved. [in] first - guess for the first, or NULL; [in] coarse - of
   StepsCorrectGuess_Private(), or NULL; [in,out] text - as of StepsWrite_Private() */
static PetscErrorCode StepsSolveAll_Private(Steps *steps, Mesh mesh, Vec first, const Vec coarse[], Run *run,
                                            char **text)
{
  const SceneSteps *plan = &steps->scene->steps;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < plan->num && (!i || (*run)->solved); i++) {
    Vec guess = NULL;

    free(*text);
    *text = NULL;
    if (coarse) PetscCall(StepsCorrectGuess_Private(coarse, i, *run, &guess));
    PetscCall(StepsSolve_Private(steps, i, mesh, i || coarse ? guess : first, run, text));
    PetscCall(VecDestroy(&guess));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* After the last mesh: prints the steps, and changes the status of those with errors larger than asked for.
   [in] met - whether there are none; [in,out] text - as of StepsWrite_Private() */
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

/* Forgets the results of all steps, since the same steps follow on another mesh or in more parts. */
static PetscErrorCode StepsBeginAgain_Private(Steps *steps)
{
  PetscFunctionBeginUser;
  WarningForgetRetained();
  cJSON_Delete(steps->rows);
  steps->rows = cJSON_CreateArray();
  steps->any  = PETSC_FALSE;
  PetscCall(OutputSeriesDestroy(&steps->series));
  PetscCall(OutputSeriesCreate(steps->scene, &steps->series));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves all steps whole, in halves and in quarters. Files have the latest steps; in the end those of
   quarters, with their limits.
   [in] first - guess for the first, or NULL; [in,out] text - as of StepsWrite_Private() */
static PetscErrorCode StepsHalve_Private(Steps *steps, Mesh mesh, Vec first, Run *run, char **text)
{
  const MPI_Comm comm = steps->scene->comm;
  cJSON         *coarser[RICHARDSON_LEVELS - 1], *row;
  PetscInt       i = 0;

  PetscFunctionBeginUser;
  WarningHold();
  for (PetscInt level = 0; level < RICHARDSON_LEVELS; level++) {
    const double start = LogWallClock();

    if (level) {
      coarser[level - 1] = steps->rows;
      steps->rows        = NULL;
      steps->parts *= 2;
      PetscCall(StepsBeginAgain_Private(steps));
    }
    PetscCall(RunDestroy(run)); // history begins anew
    PetscCall(StepsSolveAll_Private(steps, mesh, first, NULL, run, text));
    if (!steps->quiet)
      PetscCall(PetscPrintf(comm, "steps in %" PetscInt_FMT " part%s: %s, %.2g s\n", steps->parts, level ? "s" : "",
                            (*run)->solved ? "solved" : "NOT SOLVED", LogWallClock() - start));
  }
  HalvedStepsExtrapolate(coarser, steps->rows);
  for (PetscInt level = 0; level < RICHARDSON_LEVELS - 1; level++) cJSON_Delete(coarser[level]);
  cJSON_ArrayForEach(row, steps->rows) PetscCall(StepsPrint_Private(steps, i++, row));
  free(*text);
  PetscCall(StepsWrite_Private(steps, *run, PETSC_FALSE, text));
  WarningRelease();
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves all steps on a mesh. A user error ends that, too, if it is not the first mesh: there are results.
   [in] first - guess for the first step, or NULL; [in] coarse - of StepsCorrectGuess_Private(), or NULL on
   the first mesh;
   [in,out] text - as of StepsWrite_Private(); [out] solved - whether all steps are */
static PetscErrorCode StepsTryAll_Private(Steps *steps, Mesh mesh, Vec first, const Vec coarse[], Run *run, char **text,
                                          PetscBool *solved)
{
  PetscBool failed;

  PetscFunctionBeginUser;
  if (!coarse) {
    PetscCall(StepsSolveAll_Private(steps, mesh, first, NULL, run, text));
    *solved = (*run)->solved;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  UserErrorMute();
  PetscCall(AdaptiveForgive(StepsSolveAll_Private(steps, mesh, NULL, coarse, run, text), &failed));
  if (failed) PetscCall(RunDestroy(run));
  *solved = (PetscBool)(!failed && (*run)->solved);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves all steps on each adaptive mesh. Files have the steps of the latest mesh, or of the one before if
   that failed.
   [in] first - guess for the first, or NULL;
   [in,out] text - as of StepsWrite_Private() */
static PetscErrorCode StepsRepeat_Private(Steps *steps, Mesh mesh, Vec first, Run *run, char **text)
{
  Vec      *guess = NULL;
  PetscBool all = PETSC_FALSE, again = PETSC_TRUE; // steps are solved; they are to be solved once more

  PetscFunctionBeginUser;
  WarningHold();
  while (PETSC_TRUE) {
    PetscCall(StepsTryAll_Private(steps, mesh, first, guess, run, text, &all));
    first = NULL; // of the first mesh
    for (PetscInt i = 0; guess && i < steps->scene->steps.num; i++) PetscCall(VecDestroy(&guess[i]));
    PetscCall(PetscFree(guess));
    if (all)
      PetscCall(AdaptiveRefineSteps(steps->adaptive, run, &guess, &again));
    else
      PetscCall(AdaptiveReturnSteps(steps->adaptive, run, &again));
    if (!again) break;
    PetscCall(StepsBeginAgain_Private(steps));
  }
  steps->coarse = (PetscBool)(all && !(*run)->solved);
  PetscCall(StepsJudge_Private(steps, (PetscBool)!steps->coarse, *run, text));
  WarningRelease();
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode StepsRun(Scene scene, Mesh mesh, Vec guess, Run *run)
{
  Steps steps = {.scene = scene, .rows = cJSON_CreateArray(), .parts = 1};
  char *text  = NULL;

  PetscFunctionBeginUser;
  PetscCall(TableCheckName(scene, "steps", "the load steps"));
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
  if (steps.repeated)
    PetscCall(StepsRepeat_Private(&steps, mesh, guess, run, &text));
  else
    PetscCall(scene->steps.halved ? StepsHalve_Private(&steps, mesh, guess, run, &text)
                                  : StepsSolveAll_Private(&steps, mesh, guess, NULL, run, &text));
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
