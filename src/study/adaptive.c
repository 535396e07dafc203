/* adaptive.c -- solve, estimate, mark, refine. */
#include "study/adaptiveimpl.h"
#include "base/compat.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/usererror.h"
#include "base/warning.h"
#include "problem/elasticity.h"
#include "study/marking.h"
#include "study/promotion.h"
#include <stdlib.h>

static const PetscReal PERCENT = 100;

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
  const SolvedMesh *mesh  = AdaptiveGetLast(adaptive);
  const SceneAdapt *plan  = &adaptive->scene->adapt;
  PetscReal         ratio = plan->tolerance > 0 ? SolvedMeshGetError(mesh) / plan->tolerance : 0;

  for (PetscInt g = 0; g < plan->num_goals; g++) {
    const GoalState *goal = &mesh->goals[g];

    if (goal->value != 0 && !PetscIsNanReal(goal->bar))
      ratio = PetscMax(ratio, PetscSqrtReal(goal->bar / PetscAbsReal(goal->value) / plan->goal_tolerance));
  }
  return mesh->unknowns * PetscPowReal(ratio, 1 / adaptive->rate);
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
  const SolvedMesh *mesh     = AdaptiveGetLast(adaptive);
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
  if (!AdaptiveIsMet(adaptive) && expected > mesh->unknowns)
    PetscCall(PetscPrintf(comm, "  %.2g unknowns expected to be enough", (double)expected));
  PetscCall(PetscPrintf(comm, "\n"));
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
    const PetscBool energy = (PetscBool)!AdaptiveEnergyIsMet(adaptive);

    PetscCall(GoalsMark(run, energy, AdaptiveGetLast(adaptive)->goals, adaptive->indicators, &adaptive->marked,
                        &adaptive->growth));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(EstimateGet(run->fields, &estimate));
  PetscCall(MarkingCreate(MeshFinest(adaptive->mesh), estimate->cell, estimate->norm, scene->adapt.marking,
                          AdaptiveIsMet(adaptive), &adaptive->marked, &adaptive->growth));
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

/* Measures the peak of memory so far, and what there may be. Collective. */
static PetscErrorCode AdaptiveMeasureMemory_Private(Adaptive adaptive)
{
  CostPoint latest = {.unknowns = AdaptiveGetLast(adaptive)->unknowns};

  PetscFunctionBeginUser;
  PetscCall(MemoryLimit(adaptive->scene->comm, &adaptive->memory));
  adaptive->memory = PetscMin(adaptive->memory, adaptive->scene->adapt.memory);
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

/* Makes the next mesh and solves on it. Collective.
   [in] tighten, [in,out] run - of AdaptiveExtend_Private() */
static PetscErrorCode AdaptiveTryNext_Private(Adaptive adaptive, PetscBool tighten, Run *run)
{
  Vec guess;

  PetscFunctionBeginUser;
  PetscCall(AdaptiveRefine_Private(adaptive, adaptive->mesh, *run, &guess));
  PetscCall(AdaptiveExtend_Private(adaptive, guess, tighten, run));
  PetscCall(VecDestroy(&guess));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Goes on to the next mesh, or ends on the present one if that fails. Collective. [in] tighten,
   [in,out] run - of AdaptiveExtend_Private() */
static PetscErrorCode AdaptiveGoOn_Private(Adaptive adaptive, PetscBool tighten, Run *run)
{
  const PetscInt levels = adaptive->mesh->num_levels;
  Vec            last   = (*run)->fields->u;
  PetscBool      failed;

  PetscFunctionBeginUser;
  PetscCall(PetscObjectReference((PetscObject)last));
  UserErrorMute();
  PetscCall(AdaptiveForgive(AdaptiveTryNext_Private(adaptive, tighten, run), &failed));
  if (failed || !(*run)->solved) {
    AdaptiveSetFailure(adaptive, adaptive->first + adaptive->history->num + 1, failed ? NULL : *run);
    PetscCall(AdaptiveReturn(adaptive, last, levels, run));
  }
  PetscCall(VecDestroy(&last));
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
  char            why[ADAPTIVE_TEXT];

  PetscFunctionBeginUser;
  PetscCall(MeshHistoryDestroy(&adaptive->own));
  adaptive->failure[0] = '\0';
  WarningHold();
  PetscCall(*run ? AdaptiveAdvance_Private(adaptive, guess, run)
                 : RunCreate(adaptive->scene, adaptive->mesh, guess, run));
  if (!(*run)->solved && adaptive->own.num) { // meshes that were kept have solutions at this time
    AdaptiveSetFailure(adaptive, adaptive->first + adaptive->own.num + 1, *run);
    PetscCall(AdaptiveReturn(adaptive, NULL, adaptive->older[adaptive->num_older - 1].num_levels, run));
  }
  while (PETSC_TRUE) {
    adaptive->scene->view = PETSC_FALSE; // of the first mesh alone
    if (!(*run)->solved) break;
    PetscCall(AdaptiveAdd_Private(adaptive, *run, begin));
    PetscCall(AdaptivePrint_Private(adaptive));
    begin = LogWallClock();
    PetscCall(AdaptiveMark_Private(adaptive, *run));
    if (AdaptiveIsOver(adaptive, why)) {
      PetscCall(MeshHistoryDescribe(adaptive->history, *run));
      PetscCall(AdaptiveSetVerdict(adaptive, *run, why));
      break;
    }
    if (!adaptive->scene->steps.num) PetscCall(AdaptiveKeep(adaptive, *run));
    PetscCall(AdaptiveGoOn_Private(adaptive, tighten, run));
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

/* Makes the next mesh for all steps, and interpolates their displacements to it. Collective.
   [out] guess - owned by the caller [steps] */
static PetscErrorCode AdaptiveRefineAll_Private(Adaptive adaptive, Vec **guess)
{
  const Envelope *envelope = &adaptive->envelope;
  const Mesh      mesh     = adaptive->mesh;
  const PetscInt  level    = mesh->num_levels - 1;

  PetscFunctionBeginUser;
  PetscCall(LogReset(LogWallClock()));
  PetscCall(LogStageBegin(STAGE_SETUP));
  PetscCall(MeshAdapt(mesh, adaptive->marked));
  PetscCall(PetscMalloc1(envelope->num, guess));
  for (PetscInt i = 0; i < envelope->num; i++)
    PetscCall(PromotionApply(mesh, level, level + 1, envelope->u[i], &(*guess)[i]));
  PetscCall(LogStageEnd(STAGE_SETUP));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AdaptiveReturnSteps(Adaptive adaptive, Run *run, PetscBool *again)
{
  PetscInt meshes;

  PetscFunctionBeginUser;
  *again = PETSC_FALSE;
  if (adaptive->failure[0]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(EnvelopeReturn(&adaptive->envelope, &meshes));
  *again = (PetscBool)(meshes > 0);
  if (!*again) PetscFunctionReturn(PETSC_SUCCESS);
  AdaptiveSetFailure(adaptive, meshes + 1, *run);
  PetscCall(RunDestroy(run));
  PetscCall(MeshReturn(adaptive->mesh, adaptive->levels));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AdaptiveRefineSteps(Adaptive adaptive, Run *run, Vec **guess, PetscBool *again)
{
  Envelope *envelope = &adaptive->envelope;
  char      why[ADAPTIVE_TEXT];
  PetscBool failed;

  PetscFunctionBeginUser;
  *guess            = NULL;
  *again            = PETSC_FALSE;
  adaptive->levels  = adaptive->mesh->num_levels;
  adaptive->history = &envelope->step[envelope->worst];
  if (!adaptive->failure[0]) {
    PetscCall(AdaptiveMeasureMemory_Private(adaptive));
    PetscCall(AdaptivePrint_Private(adaptive));
    PetscCall(PetscFree(adaptive->marked));
    PetscCall(EnvelopeMark(envelope, MeshFinest(adaptive->mesh), adaptive->scene->adapt.marking, &adaptive->marked,
                           &adaptive->growth));
  }
  if (AdaptiveIsOver(adaptive, why)) {
    PetscCall(AdaptiveSetVerdict(adaptive, *run, why));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(RunDestroy(run));
  UserErrorMute();
  PetscCall(AdaptiveForgive(AdaptiveRefineAll_Private(adaptive, guess), &failed));
  *again = PETSC_TRUE;
  if (!failed) PetscFunctionReturn(PETSC_SUCCESS);
  *guess = NULL;
  PetscCall(AdaptiveReturnSteps(adaptive, run, again));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AdaptiveRun(Scene scene, Mesh mesh, Vec guess, Run *run)
{
  Adaptive adaptive;

  PetscFunctionBeginUser;
  PetscCall(RunDestroy(run));
  PetscCall(InterruptBegin());
  PetscCall(AdaptiveCreate(scene, mesh, &adaptive));
  AdaptiveSetInterruptSentence(adaptive, PETSC_FALSE);
  PetscCall(AdaptiveSolve(adaptive, guess, run));
  InterruptSetSentence("");
  PetscCall(InterruptEnd());
  PetscCall(AdaptiveDestroy(&adaptive));
  PetscFunctionReturn(PETSC_SUCCESS);
}
