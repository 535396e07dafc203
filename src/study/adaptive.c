/* adaptive.c -- solve, estimate, mark, refine. */
#include "study/adaptive.h"
#include "base/compat.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/warning.h"
#include "problem/elasticity.h"
#include "study/costforecast.h"
#include "study/envelope.h"
#include "study/marking.h"
#include "study/promotion.h"
#include <stdlib.h>

enum {
  TEXT_LENGTH  = 320,
  TIME_TEXT    = 40,
  FIRST_MESHES = 3, /* least number that a bar needs, unless there is nothing to refine */
  RATE_MESHES  = 5, /* least number that shows no progress: on coarse ones estimates may rise and fall */
  KEPT_RUNS    = 4  /* meshes of a load step beside the latest one: bars compare five */
};

/* Smallest ratio of errors that is no progress, with so many times the unknowns. With friction no energy
   tells whether a rise is one of coarse meshes. */
static const PetscReal STALLED = 0.9, STALLED_GROWTH = 2, STALLED_GROWTH_FRICTION = 4;
static const PetscReal KEEP_SECONDS =
    5; /* between files: of work that an interruption loses, besides the present mesh */
static const PetscReal PERCENT = 100;

/* A run on an earlier mesh. */
typedef struct {
  Run      run;
  PetscInt num_levels; /* of its mesh */
} OlderRun;

struct _n_Adaptive {
  Scene        scene; /* borrowed */
  Mesh         mesh;  /* borrowed */
  MeshHistory  own;
  Envelope     envelope; /* with load steps that are all solved on each mesh, else empty */
  MeshHistory *history;  /* own, or that of the envelope's worst step */
  PetscInt     first;    /* meshes before those of the history */
  PetscInt     num_older;
  OlderRun     older[KEPT_RUNS]; /* with load steps, coarse first */
  CostPoint    cost[2];          /* of the latest two meshes, the latest first */
  PetscReal    rate;             /* of errors in the number of unknowns */
  PetscBool    quiet;
  PetscReal    end;        /* time at which the last step of the envelope ended, or all work before */
  PetscReal    kept;       /* time at which files were written last */
  PetscReal   *indicators; /* of goals on the latest mesh, GoalsSolve() */
  PetscBool    dual;       /* whether their dual problems are solved */
  PetscInt    *marked;     /* cells of the latest mesh that the next one refines */
  PetscReal    growth;     /* expected with them, of the number of cells */
};

static const SolvedMesh *AdaptiveGetLast_Private(const struct _n_Adaptive *adaptive)
{
  return &adaptive->history->mesh[adaptive->history->num - 1];
}

/* Whether the error in the energy norm is as small as asked for. */
static PetscBool AdaptiveEnergyIsMet_Private(const struct _n_Adaptive *adaptive)
{
  const PetscReal tolerance = adaptive->scene->adapt.tolerance;

  return (PetscBool)(tolerance == 0 || SolvedMeshGetError(AdaptiveGetLast_Private(adaptive)) <= tolerance);
}

/* Whether all errors are as small as asked for. */
static PetscBool AdaptiveIsMet_Private(const struct _n_Adaptive *adaptive)
{
  return (PetscBool)(AdaptiveEnergyIsMet_Private(adaptive) &&
                     GoalsAreMet(adaptive->scene, AdaptiveGetLast_Private(adaptive)->goals));
}

/* The order of convergence in the number of unknowns: p / dim for the lowest order of the bodies.
   Collective. */
static PetscErrorCode AdaptiveSetRate_Private(Adaptive adaptive)
{
  const Scene scene = adaptive->scene;
  PetscInt   *order;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(scene->num_bodies, &order));
  PetscCall(ElasticityGetOrders(scene, MeshFinest(adaptive->mesh), order));
  for (PetscInt b = 1; b < scene->num_bodies; b++) order[0] = PetscMin(order[0], order[b]);
  adaptive->rate = (PetscReal)order[0] / scene->dim;
  PetscCall(PetscFree(order));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Expected unknowns of a mesh with the errors asked for. Bars of goals fall like the square of the error in
   the energy norm. */
static PetscReal AdaptiveForecast_Private(const struct _n_Adaptive *adaptive)
{
  const SolvedMesh *mesh  = AdaptiveGetLast_Private(adaptive);
  const SceneAdapt *plan  = &adaptive->scene->adapt;
  PetscReal         ratio = plan->tolerance > 0 ? SolvedMeshGetError(mesh) / plan->tolerance : 0;

  for (PetscInt g = 0; g < plan->num_goals; g++) {
    const GoalState *goal = &mesh->goals[g];

    if (goal->value != 0 && !PetscIsNanReal(goal->bar))
      ratio = PetscMax(ratio, PetscSqrtReal(goal->bar / PetscAbsReal(goal->value) / plan->goal_tolerance));
  }
  return mesh->unknowns * PetscPowReal(ratio, 1 / adaptive->rate);
}

/* Expected unknowns of the next mesh. */
static PetscReal AdaptiveNext_Private(const struct _n_Adaptive *adaptive)
{
  return adaptive->growth * AdaptiveGetLast_Private(adaptive)->unknowns;
}

/* Prints a line for each body whose cells were cut. In the plane it says where that costs most.
   Collective. */
static PetscErrorCode AdaptivePrintCut_Private(Scene scene, Mesh mesh)
{
  const PetscBool  plane = (PetscBool)(scene->dim == 2);
  DilatationCount *counts;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(scene->num_bodies, &counts));
  PetscCall(ElasticityDilatationCount(scene, MeshFinest(mesh), counts));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    if (!MeshIsCut(mesh, b)) continue;
    PetscCall(PetscPrintf(scene->comm, "  %s: its %s were cut into %s%s\n", scene->bodies[b].name,
                          plane ? "quadrilaterals" : "hexahedra", plane ? "triangles" : "tetrahedra",
                          plane && counts[b].poisson > 0 && !scene->adapt.kept
                              ? "; it is nearly incompressible, and -adapt_cells kept takes far fewer unknowns"
                              : ""));
  }
  PetscCall(PetscFree(counts));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Prints what was cut, and the head of the table. Collective. */
static PetscErrorCode AdaptivePrintHead_Private(const struct _n_Adaptive *adaptive, Mesh mesh)
{
  const Scene scene = adaptive->scene;

  PetscFunctionBeginUser;
  if (adaptive->quiet) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(AdaptivePrintCut_Private(scene, mesh));
  PetscCall(
      PetscPrintf(scene->comm, "  mesh     cells  unknowns  sets  active  error in energy  potential energy  seconds"));
  for (PetscInt g = 0; g < scene->adapt.num_goals; g++)
    PetscCall(PetscPrintf(scene->comm, "  %24s", scene->adapt.goals[g].text));
  PetscCall(PetscPrintf(scene->comm, "\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Prints the line of the latest mesh. */
static PetscErrorCode AdaptivePrint_Private(const struct _n_Adaptive *adaptive)
{
  const Envelope   *envelope = &adaptive->envelope;
  const MPI_Comm    comm     = adaptive->scene->comm;
  const SolvedMesh *mesh     = AdaptiveGetLast_Private(adaptive);
  const PetscReal   expected = AdaptiveForecast_Private(adaptive);

  PetscFunctionBeginUser;
  if (adaptive->quiet) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscPrintf(comm,
                        "  %4" PetscInt_FMT " %9" PetscInt_FMT " %9" PetscInt_FMT " %5" PetscInt_FMT "  %6" PetscInt_FMT
                        "  %14.3g%%  %16.10g  %7.2f",
                        adaptive->first + adaptive->history->num, mesh->cells, mesh->unknowns, mesh->iterations,
                        mesh->active, (double)(PERCENT * SolvedMeshGetError(mesh)), (double)mesh->potential,
                        (double)(envelope->num ? EnvelopeGetSeconds(envelope) : mesh->seconds)));
  for (PetscInt g = 0; g < adaptive->scene->adapt.num_goals; g++) {
    const PetscReal part = mesh->goals[g].bar / PetscAbsReal(mesh->goals[g].value);

    PetscCall(PetscPrintf(comm, "  %12.6g", (double)mesh->goals[g].value));
    if (PetscIsInfOrNanReal(part))
      PetscCall(PetscPrintf(comm, "%12s", ""));
    else
      PetscCall(PetscPrintf(comm, " +- %7.2g%%", (double)(PERCENT * part)));
  }
  if (envelope->num > 1)
    PetscCall(PetscPrintf(comm, "  largest error at t = %.9g", (double)adaptive->scene->steps.t[envelope->worst]));
  if (!AdaptiveIsMet_Private(adaptive) && expected > mesh->unknowns)
    PetscCall(PetscPrintf(comm, "  %.2g unknowns expected to be enough", (double)expected));
  PetscCall(PetscPrintf(comm, "\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscReal AdaptiveGetStalledGrowth_Private(const Scene scene)
{
  return SceneHasFriction(scene) ? STALLED_GROWTH_FRICTION : STALLED_GROWTH;
}

/* Whether estimates have hardly fallen since there were a half, or a quarter, of the unknowns. They are not
   calibrated here: calibrations of coarse meshes may jump. Where coarse meshes are too stiff estimates may
   even rise; then the energy falls, and by more than they tell. Or they rise where refined curves meet coarse
   ones, and fall from mesh to mesh afterwards. */
static PetscBool AdaptiveIsStalled_Private(const struct _n_Adaptive *adaptive)
{
  const PetscReal   growth = AdaptiveGetStalledGrowth_Private(adaptive->scene);
  const SolvedMesh *mesh   = AdaptiveGetLast_Private(adaptive), *before;
  PetscInt          k      = adaptive->history->num - 1;

  if (adaptive->first + adaptive->history->num < RATE_MESHES) return PETSC_FALSE;
  while (k > 0 && growth * adaptive->history->mesh[k].unknowns > mesh->unknowns) k--;
  before = &adaptive->history->mesh[k];
  if (SolvedMeshGetError(before) >= 1) return PETSC_FALSE; // the mesh hardly resolves the contact
  if (growth * before->unknowns > mesh->unknowns || mesh->eta <= STALLED * before->eta) return PETSC_FALSE;
  if (mesh->eta <= STALLED * mesh[-1].eta) return PETSC_FALSE;
  if (!SceneHasFriction(adaptive->scene) &&
      SolvedMeshGetEnergy(before) - SolvedMeshGetEnergy(mesh) > (1 - PetscSqr(STALLED)) * PetscSqr(before->eta))
    return PETSC_FALSE;
  for (PetscInt g = 0; g < adaptive->scene->adapt.num_goals; g++) {
    if (mesh->goals[g].product <= STALLED * before->goals[g].product) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Memory of all processes with the next mesh; 0 without a limit. [in] next - its unknowns */
static PetscReal AdaptiveGetForecastBytes_Private(const struct _n_Adaptive *adaptive, PetscReal next)
{
  if (!(adaptive->scene->adapt.memory < PETSC_INFINITY)) return 0;
  return CostForecastNext(adaptive->scene, &adaptive->cost[0], adaptive->cost[1].unknowns ? &adaptive->cost[1] : NULL,
                          next);
}

/* [out] why - [TEXT_LENGTH] */
static void AdaptiveTellMemory_Private(const struct _n_Adaptive *adaptive, PetscReal next, char why[])
{
  char needed[BYTES_TEXT], limit[BYTES_TEXT];

  CostForecastPrintBytes(AdaptiveGetForecastBytes_Private(adaptive, next), needed);
  CostForecastPrintBytes(adaptive->scene->adapt.memory, limit);
  (void)snprintf(why, TEXT_LENGTH, "the next mesh would need about %s, -study_memory allows %s", needed, limit);
}

/* Whether this mesh is the last one. [out] why - "" where the error is small enough [TEXT_LENGTH] */
static PetscBool AdaptiveIsOver_Private(const struct _n_Adaptive *adaptive, char why[])
{
  const SceneAdapt *plan = &adaptive->scene->adapt;
  const PetscReal   next = AdaptiveNext_Private(adaptive);

  why[0] = '\0';
  if (SolvedMeshIsExact(AdaptiveGetLast_Private(adaptive))) return PETSC_TRUE;
  if (AdaptiveIsMet_Private(adaptive) && adaptive->history->num >= FIRST_MESHES) return PETSC_TRUE;
  if (!adaptive->dual)
    (void)snprintf(why, TEXT_LENGTH, "a dual problem was not solved");
  else if (adaptive->first + adaptive->history->num >= plan->max_meshes)
    (void)snprintf(why, TEXT_LENGTH, "-adapt_max_meshes %" PetscInt_FMT " ends the refinement", plan->max_meshes);
  else if (next > plan->max_unknowns)
    (void)snprintf(why, TEXT_LENGTH, "the next mesh would have about %.2g unknowns, -adapt_max_unknowns allows %.3g",
                   (double)next, (double)plan->max_unknowns);
  else if (AdaptiveGetForecastBytes_Private(adaptive, next) > plan->memory)
    AdaptiveTellMemory_Private(adaptive, next, why);
  else if (AdaptiveIsStalled_Private(adaptive))
    (void)snprintf(why, TEXT_LENGTH, "%s the unknowns have hardly lowered it",
                   SceneHasFriction(adaptive->scene) ? "four times" : "twice");
  if (why[0] && AdaptiveIsMet_Private(adaptive))
    why[0] = '\0'; // few meshes, but what was asked for
  else if (!why[0])
    return PETSC_FALSE;
  return PETSC_TRUE;
}

/* Writes the reason why errors are larger than asked for to the report. [in] why - "" where they are not */
static PetscErrorCode AdaptiveSetVerdict_Private(const struct _n_Adaptive *adaptive, Run run, const char why[])
{
  const Scene       scene           = adaptive->scene;
  const SolvedMesh *mesh            = AdaptiveGetLast_Private(adaptive);
  const size_t      room            = sizeof(run->report.reason);
  const Envelope   *envelope        = &adaptive->envelope;
  char              when[TIME_TEXT] = "";
  PetscInt          g               = 0;

  PetscFunctionBeginUser;
  if (!why[0]) PetscFunctionReturn(PETSC_SUCCESS);
  run->solved           = PETSC_FALSE;
  run->report.converged = PETSC_FALSE;
  if (envelope->num > 1) (void)snprintf(when, sizeof(when), "at t = %.9g ", (double)scene->steps.t[envelope->worst]);
  if (!AdaptiveEnergyIsMet_Private(adaptive)) {
    PetscCall(PetscSNPrintf(run->report.reason, room,
                            "%sthe error is about %.2g of the solution in the energy norm, -adapt asks for %g: %s",
                            when, (double)SolvedMeshGetError(mesh), (double)scene->adapt.tolerance, why));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  while (g < scene->adapt.num_goals && GoalIsMet(scene, &mesh->goals[g])) g++;
  if (g == scene->adapt.num_goals) {
    PetscCall(PetscSNPrintf(run->report.reason, room, "%s", why));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (PetscIsNanReal(mesh->goals[g].bar))
    PetscCall(PetscSNPrintf(run->report.reason, room, "%s has no error bar%s: %s", scene->adapt.goals[g].text,
                            scene->adapt.goals[g].kind == GOAL_PRESSURE ? ", it may grow without limit" : "", why));
  else
    PetscCall(PetscSNPrintf(
        run->report.reason, room, "%s = %.6g is known to about %.2g of itself, -adapt_goal_tolerance asks for %g: %s",
        scene->adapt.goals[g].text, (double)mesh->goals[g].value,
        (double)(mesh->goals[g].bar / PetscAbsReal(mesh->goals[g].value)), (double)scene->adapt.goal_tolerance, why));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Sets the sentence of an interruption. [in] kept - whether files have the latest mesh */
static void AdaptiveSetInterruptSentence_Private(const struct _n_Adaptive *adaptive, PetscBool kept)
{
  const Scene scene = adaptive->scene;
  char        text[PETSC_MAX_PATH_LEN + TEXT_LENGTH];

  if (kept) {
    (void)snprintf(text, sizeof(text), "mortise: interrupted; %s.json and the other files hold mesh %d, error %.3g%%\n",
                   scene->output, (int)adaptive->history->num,
                   (double)(PERCENT * SolvedMeshGetError(AdaptiveGetLast_Private(adaptive))));
  } else {
    (void)snprintf(text, sizeof(text), "mortise: interrupted; nothing was written yet\n");
  }
  InterruptSetSentence(text);
}

/* Writes the files of a mesh that is not the last one, unless that was done a few seconds ago. Collective. */
static PetscErrorCode AdaptiveKeep_Private(Adaptive adaptive, Run run)
{
  const Scene        scene  = adaptive->scene;
  const SolverReport report = run->report;
  PetscBool          wanted = (PetscBool)(scene->output && LogWallClock() - adaptive->kept >= KEEP_SECONDS);
  SummaryInput       input;
  Output             output;
  char               path[PETSC_MAX_PATH_LEN], *text;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Bcast(&wanted, 1, MPIU_BOOL, 0, scene->comm));
  if (!wanted) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MeshHistoryDescribe(adaptive->history, run));
  PetscCall(AdaptiveSetVerdict_Private(adaptive, run, "interrupted"));
  input = RunSummary(run);
  PetscCall(OutputCreate(scene->comm, &output));
  PetscCall(OutputAddFields(output, run->fields));
  PetscCall(SummaryCreate(&input, &text));
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s.json", scene->output));
  PetscCall(OutputAddText(output, path, text)); // the last file: if it is there, the result is complete
  free(text);
  InterruptHold();
  PetscCall(OutputFinish(&output));
  AdaptiveSetInterruptSentence_Private(adaptive, PETSC_TRUE);
  InterruptRelease();
  RunForgetBlocks(run);
  run->solved    = PETSC_TRUE;
  run->report    = report;
  adaptive->kept = LogWallClock();
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Marks the cells that the next mesh refines. Collective. */
static PetscErrorCode AdaptiveMark_Private(Adaptive adaptive, Run run)
{
  const Scene scene = adaptive->scene;
  Estimate    estimate;

  PetscFunctionBeginUser;
  PetscCall(PetscFree(adaptive->marked));
  if (scene->adapt.num_goals) {
    const PetscBool energy = (PetscBool)!AdaptiveEnergyIsMet_Private(adaptive);

    PetscCall(GoalsMark(run, energy, AdaptiveGetLast_Private(adaptive)->goals, adaptive->indicators, &adaptive->marked,
                        &adaptive->growth));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(EstimateGet(run->fields, &estimate));
  PetscCall(
      MarkingCreate(MeshFinest(adaptive->mesh), estimate, scene->adapt.marking, &adaptive->marked, &adaptive->growth));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Makes the next mesh, and interpolates the displacement to it. Collective.
   [out] guess - owned by the caller */
static PetscErrorCode AdaptiveRefine_Private(const struct _n_Adaptive *adaptive, Mesh mesh, Run run, Vec *guess)
{
  const PetscInt level = mesh->num_levels - 1;

  PetscFunctionBeginUser;
  PetscCall(LogStageBegin(STAGE_SETUP));
  PetscCall(MeshAdapt(mesh, adaptive->marked));
  PetscCall(PromotionApply(mesh, level, level + 1, run->fields->u, guess));
  PetscCall(LogStageEnd(STAGE_SETUP));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Measures the peak of memory so far, if that is limited. Collective. */
static PetscErrorCode AdaptiveMeasureMemory_Private(Adaptive adaptive)
{
  CostPoint latest = {.unknowns = AdaptiveGetLast_Private(adaptive)->unknowns};

  PetscFunctionBeginUser;
  if (!(adaptive->scene->adapt.memory < PETSC_INFINITY)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MemoryPeak(adaptive->scene->comm, &latest.bytes, NULL));
  if (latest.unknowns < adaptive->cost[0].unknowns) PetscFunctionReturn(PETSC_SUCCESS);
  if (latest.unknowns > adaptive->cost[0].unknowns) adaptive->cost[1] = adaptive->cost[0];
  adaptive->cost[0] = latest;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds a run to the history. Collective. [in] begin - time at which the work on its mesh began */
static PetscErrorCode AdaptiveAdd_Private(Adaptive adaptive, Run run, PetscReal begin)
{
  SolvedMesh *mesh;

  PetscFunctionBeginUser;
  PetscCall(MeshHistoryAdd(adaptive->history, run, LogWallClock() - begin));
  PetscCall(AdaptiveMeasureMemory_Private(adaptive));
  if (!adaptive->scene->adapt.num_goals) PetscFunctionReturn(PETSC_SUCCESS);
  mesh = &adaptive->history->mesh[adaptive->history->num - 1];
  PetscCall(PetscFree(adaptive->indicators));
  PetscCall(PetscMalloc1(adaptive->scene->adapt.num_goals, &mesh->goals));
  PetscCall(GoalsSolve(run, mesh->goals, &adaptive->indicators, &adaptive->dual));
  PetscCall(MeshHistoryDescribe(adaptive->history, run)); // bars of goals decide about the next mesh
  mesh->seconds = LogWallClock() - begin;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves at the scene's new time on the kept meshes. Collective. [in,out] run - of the latest mesh */
static PetscErrorCode AdaptiveAdvance_Private(Adaptive adaptive, Vec guess, Run *run)
{
  const Scene    scene   = adaptive->scene;
  const Mesh     mesh    = adaptive->mesh;
  const int      changed = scene->changed;
  const PetscInt all     = mesh->num_levels;
  PetscInt       kept    = 0;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < adaptive->num_older; i++) {
    const PetscReal begin = LogWallClock();
    OlderRun       *older = &adaptive->older[i];

    scene->changed   = changed;
    mesh->num_levels = older->num_levels; // the run's own mesh is the finest
    PetscCall(RunAdvance(NULL, &older->run));
    mesh->num_levels = all;
    if (older->run->solved) {
      PetscCall(AdaptiveAdd_Private(adaptive, older->run, begin));
      adaptive->older[kept++] = *older;
    } else {
      PetscCall(RunDestroy(&older->run)); // not an error: the latest mesh decides
    }
  }
  adaptive->num_older = kept;
  adaptive->first     = all - 1 - kept;
  scene->changed      = changed;
  PetscCall(RunAdvance(guess, run));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Solves on a new mesh; with load steps the run of the mesh before is kept. Collective.
   [in] tighten - whether pretensions are applied at this time */
static PetscErrorCode AdaptiveExtend_Private(Adaptive adaptive, Vec guess, PetscBool tighten, Run *run)
{
  PetscFunctionBeginUser;
  if (!adaptive->scene->steps.num) {
    PetscCall(RunExtend(guess, run));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (adaptive->num_older == KEPT_RUNS) {
    PetscCall(RunDestroy(&adaptive->older[0].run));
    PetscCall(PetscArraymove(&adaptive->older[0], &adaptive->older[1], KEPT_RUNS - 1));
    adaptive->num_older--;
  }
  adaptive->older[adaptive->num_older++] = (OlderRun){.run = *run, .num_levels = adaptive->mesh->num_levels - 1};
  *run                                   = NULL;
  PetscCall(tighten ? RunCreate(adaptive->scene, adaptive->mesh, guess, run)
                    : RunCreateTightened(adaptive->scene, adaptive->mesh, guess, run));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AdaptiveCreate(Scene scene, Mesh mesh, Adaptive *adaptive)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(adaptive));
  (*adaptive)->scene   = scene;
  (*adaptive)->mesh    = mesh;
  (*adaptive)->kept    = LogWallClock();
  (*adaptive)->end     = (*adaptive)->kept;
  (*adaptive)->dual    = PETSC_TRUE;
  (*adaptive)->history = &(*adaptive)->own;
  if (SceneRepeatsSteps(scene)) PetscCall(EnvelopeCreate(scene->steps.num, &(*adaptive)->envelope));
  (*adaptive)->quiet = (PetscBool)(scene->quiet || (scene->summary && !strcmp(scene->summary, "-")));
  PetscCall(AdaptiveSetRate_Private(*adaptive));
  PetscCall(AdaptivePrintHead_Private(*adaptive, mesh));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AdaptiveDestroy(Adaptive *adaptive)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < (*adaptive)->num_older; i++) PetscCall(RunDestroy(&(*adaptive)->older[i].run));
  PetscCall(PetscFree((*adaptive)->indicators));
  PetscCall(PetscFree((*adaptive)->marked));
  PetscCall(MeshHistoryDestroy(&(*adaptive)->own));
  PetscCall(EnvelopeDestroy(&(*adaptive)->envelope));
  PetscCall(PetscFree(*adaptive));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AdaptiveSolve(Adaptive adaptive, Vec guess, Run *run)
{
  const PetscBool tighten = (PetscBool) !*run;
  PetscReal       begin   = LogWallClock();
  char            why[TEXT_LENGTH];
  Vec             own = NULL;

  PetscFunctionBeginUser;
  PetscCall(MeshHistoryDestroy(&adaptive->own));
  WarningHold();
  PetscCall(*run ? AdaptiveAdvance_Private(adaptive, guess, run)
                 : RunCreate(adaptive->scene, adaptive->mesh, guess, run));
  while (PETSC_TRUE) {
    adaptive->scene->view = PETSC_FALSE; // of the first mesh alone
    PetscCall(VecDestroy(&own));
    if (!(*run)->solved) break;
    PetscCall(AdaptiveAdd_Private(adaptive, *run, begin));
    PetscCall(AdaptivePrint_Private(adaptive));
    begin = LogWallClock();
    PetscCall(AdaptiveMark_Private(adaptive, *run));
    if (AdaptiveIsOver_Private(adaptive, why)) {
      PetscCall(MeshHistoryDescribe(adaptive->history, *run));
      PetscCall(AdaptiveSetVerdict_Private(adaptive, *run, why));
      break;
    }
    if (!adaptive->scene->steps.num) PetscCall(AdaptiveKeep_Private(adaptive, *run));
    PetscCall(AdaptiveRefine_Private(adaptive, adaptive->mesh, *run, &own));
    PetscCall(AdaptiveExtend_Private(adaptive, own, tighten, run));
  }
  WarningRelease();
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AdaptiveAddStep(Adaptive adaptive, PetscInt i, Run run)
{
  PetscFunctionBeginUser;
  PetscCall(EnvelopeAdd(&adaptive->envelope, i, run, LogWallClock() - adaptive->end));
  adaptive->end = LogWallClock();
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool AdaptiveStepIsMet(Adaptive adaptive, PetscInt i)
{
  return (PetscBool)(EnvelopeGetError(&adaptive->envelope, i) <= adaptive->scene->adapt.tolerance);
}

PetscErrorCode AdaptiveRefineSteps(Adaptive adaptive, Run *run, Vec **guess)
{
  const Mesh     mesh     = adaptive->mesh;
  const PetscInt level    = mesh->num_levels - 1;
  Envelope      *envelope = &adaptive->envelope;
  char           why[TEXT_LENGTH];

  PetscFunctionBeginUser;
  *guess            = NULL;
  adaptive->history = &envelope->step[envelope->worst];
  PetscCall(AdaptiveMeasureMemory_Private(adaptive));
  PetscCall(AdaptivePrint_Private(adaptive));
  PetscCall(PetscFree(adaptive->marked));
  PetscCall(EnvelopeMark(envelope, &mesh->levels[level], adaptive->scene->adapt.marking, &adaptive->marked,
                         &adaptive->growth));
  if (AdaptiveIsOver_Private(adaptive, why)) {
    PetscCall(AdaptiveSetVerdict_Private(adaptive, *run, why));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(RunDestroy(run));
  PetscCall(LogReset(LogWallClock()));
  PetscCall(LogStageBegin(STAGE_SETUP));
  PetscCall(MeshAdapt(mesh, adaptive->marked));
  PetscCall(PetscMalloc1(envelope->num, guess));
  for (PetscInt i = 0; i < envelope->num; i++)
    PetscCall(PromotionApply(mesh, level, level + 1, envelope->u[i], &(*guess)[i]));
  PetscCall(LogStageEnd(STAGE_SETUP));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AdaptiveRun(Scene scene, Mesh mesh, Vec guess, Run *run)
{
  Adaptive adaptive;

  PetscFunctionBeginUser;
  PetscCall(RunDestroy(run));
  PetscCall(InterruptBegin());
  PetscCall(AdaptiveCreate(scene, mesh, &adaptive));
  AdaptiveSetInterruptSentence_Private(adaptive, PETSC_FALSE);
  PetscCall(AdaptiveSolve(adaptive, guess, run));
  InterruptSetSentence("");
  PetscCall(InterruptEnd());
  PetscCall(AdaptiveDestroy(&adaptive));
  PetscFunctionReturn(PETSC_SUCCESS);
}
