/* adaptiveend.c -- limits of adaptive refinement, its verdict, and what is kept of the last solved mesh. */
#include "study/adaptiveimpl.h"
#include "base/compat.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/usererror.h"
#include "base/warning.h"
#include <stdlib.h>

enum {
  TIME_TEXT    = 40,
  LEAST_MESHES = 2, /* least number that a bar needs, unless there is nothing to refine */
  DOUBT_MESHES = 3, /* the same where errors are large, or a largest pressure may have no limit */
  RATE_MESHES  = 5  /* least number that shows no progress: on coarse ones estimates may rise and fall */
};

/* Smallest ratio of errors that is no progress, with so many times the unknowns. With friction no energy
   tells whether a rise is one of coarse meshes. */
static const PetscReal STALLED = 0.9, STALLED_GROWTH = 2, STALLED_GROWTH_FRICTION = 4;
static const PetscReal KEEP_SECONDS = 5; /* of work that an interruption may lose */
static const PetscReal PERCENT      = 100;
/* Relative error above which the places of the largest errors may still change. */
static const PetscReal DOUBTFUL_ERROR = 0.1;
/* Part of a largest pressure that it grows by from one mesh to the next where it may have no limit. */
static const PetscReal DOUBTFUL_GROWTH = 0.03;

const SolvedMesh *AdaptiveGetLast(const struct _n_Adaptive *adaptive)
{
  return &adaptive->history->mesh[adaptive->history->num - 1];
}

PetscBool AdaptiveEnergyIsMet(const struct _n_Adaptive *adaptive)
{
  const PetscReal tolerance = adaptive->scene->adapt.tolerance;

  return (PetscBool)(tolerance == 0 || SolvedMeshGetError(AdaptiveGetLast(adaptive)) <= tolerance);
}

PetscBool AdaptiveIsMet(const struct _n_Adaptive *adaptive)
{
  return (PetscBool)(AdaptiveEnergyIsMet(adaptive) && GoalsAreMet(adaptive->scene, AdaptiveGetLast(adaptive)->goals));
}

/* Expected unknowns of the next mesh. */
static PetscReal AdaptiveNext_Private(const struct _n_Adaptive *adaptive)
{
  return adaptive->growth * AdaptiveGetLast(adaptive)->unknowns;
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
  const SolvedMesh *mesh   = AdaptiveGetLast(adaptive), *before;
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

/* Memory of all processes with the next mesh. [in] next - its unknowns */
static PetscReal AdaptiveGetForecastBytes_Private(const struct _n_Adaptive *adaptive, PetscReal next)
{
  return CostForecastNext(adaptive->scene, &adaptive->cost[0], adaptive->cost[1].unknowns ? &adaptive->cost[1] : NULL,
                          next);
}

/* [out] why - [ADAPTIVE_TEXT] */
static void AdaptiveTellMemory_Private(const struct _n_Adaptive *adaptive, PetscReal next, char why[])
{
  char needed[BYTES_TEXT], limit[BYTES_TEXT];

  CostForecastPrintBytes(AdaptiveGetForecastBytes_Private(adaptive, next), needed);
  CostForecastPrintBytes(adaptive->memory, limit);
  (void)snprintf(why, ADAPTIVE_TEXT, "the next mesh would need about %s, %s %s", needed,
                 adaptive->memory < adaptive->scene->adapt.memory ? "and there are only" : "-study_memory allows",
                 limit);
}

/* Whether there are enough meshes for bars. Two are if the first one was good enough, unless a third one must
   show whether pressures have a limit, or what friction does. */
static PetscBool AdaptiveHasBars_Private(const struct _n_Adaptive *adaptive)
{
  const SolvedMesh *mesh = AdaptiveGetLast(adaptive);

  if (adaptive->history->num != LEAST_MESHES || SceneHasFriction(adaptive->scene))
    return (PetscBool)(adaptive->history->num >= DOUBT_MESHES);
  for (PetscInt p = 0; p < adaptive->scene->num_pairs; p++) {
    const PetscReal before = mesh[-1].peak[p].pressure;

    if (mesh->peak[p].pressure - before > DOUBTFUL_GROWTH * before) return PETSC_FALSE;
  }
  return (PetscBool)(SolvedMeshGetError(&mesh[-1]) <= adaptive->scene->adapt.tolerance &&
                     SolvedMeshGetError(mesh) <= DOUBTFUL_ERROR);
}

PetscBool AdaptiveIsOver(const struct _n_Adaptive *adaptive, char why[])
{
  const SceneAdapt *plan = &adaptive->scene->adapt;
  const PetscReal   next = AdaptiveNext_Private(adaptive);

  (void)snprintf(why, ADAPTIVE_TEXT, "%s", adaptive->failure);
  if (why[0]) return PETSC_TRUE;
  if (SolvedMeshIsExact(AdaptiveGetLast(adaptive))) return PETSC_TRUE;
  if (AdaptiveIsMet(adaptive) && AdaptiveHasBars_Private(adaptive)) return PETSC_TRUE;
  if (!adaptive->dual)
    (void)snprintf(why, ADAPTIVE_TEXT, "a dual problem was not solved");
  else if (!MeshCanAdapt(adaptive->mesh))
    (void)snprintf(why, ADAPTIVE_TEXT, "a finer mesh has failed before, and the mesh is not refined again");
  else if (adaptive->first + adaptive->history->num >= plan->max_meshes)
    (void)snprintf(why, ADAPTIVE_TEXT, "-adapt_max_meshes %" PetscInt_FMT " ends the refinement", plan->max_meshes);
  else if (next > plan->max_unknowns)
    (void)snprintf(why, ADAPTIVE_TEXT, "the next mesh would have about %.2g unknowns, -adapt_max_unknowns allows %.3g",
                   (double)next, (double)plan->max_unknowns);
  else if (AdaptiveGetForecastBytes_Private(adaptive, next) > adaptive->memory)
    AdaptiveTellMemory_Private(adaptive, next, why);
  else if (AdaptiveIsStalled_Private(adaptive))
    (void)snprintf(why, ADAPTIVE_TEXT, "%s the unknowns have hardly lowered it",
                   SceneHasFriction(adaptive->scene) ? "four times" : "twice");
  if (why[0] && AdaptiveIsMet(adaptive))
    why[0] = '\0'; // few meshes, but what was asked for
  else if (!why[0])
    return PETSC_FALSE;
  return PETSC_TRUE;
}

PetscErrorCode AdaptiveSetVerdict(const struct _n_Adaptive *adaptive, Run run, const char why[])
{
  const Scene       scene           = adaptive->scene;
  const SolvedMesh *mesh            = AdaptiveGetLast(adaptive);
  const size_t      room            = sizeof(run->report.reason);
  const Envelope   *envelope        = &adaptive->envelope;
  char              when[TIME_TEXT] = "";
  PetscInt          g               = 0;

  PetscFunctionBeginUser;
  if (!why[0]) PetscFunctionReturn(PETSC_SUCCESS);
  run->solved           = PETSC_FALSE;
  run->report.converged = PETSC_FALSE;
  if (envelope->num > 1) (void)snprintf(when, sizeof(when), "at t = %.9g ", (double)scene->steps.t[envelope->worst]);
  if (!AdaptiveEnergyIsMet(adaptive)) {
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

void AdaptiveSetInterruptSentence(const struct _n_Adaptive *adaptive, PetscBool kept)
{
  const Scene scene = adaptive->scene;
  char        text[PETSC_MAX_PATH_LEN + ADAPTIVE_TEXT];

  if (kept) {
    (void)snprintf(text, sizeof(text), "mortise: interrupted; %s.json and the other files hold mesh %d, error %.3g%%\n",
                   scene->output, (int)adaptive->history->num,
                   (double)(PERCENT * SolvedMeshGetError(AdaptiveGetLast(adaptive))));
  } else {
    (void)snprintf(text, sizeof(text), "mortise: interrupted; nothing was written yet\n");
  }
  InterruptSetSentence(text);
}

PetscErrorCode AdaptiveKeep(Adaptive adaptive, Run run)
{
  const Scene        scene  = adaptive->scene;
  const SolverReport report = run->report;
  const PetscReal    next   = adaptive->growth * AdaptiveGetLast(adaptive)->seconds; // expected for the next mesh
  PetscBool          wanted = (PetscBool)(scene->output && LogWallClock() - adaptive->kept + next >= KEEP_SECONDS);
  SummaryInput       input;
  Output             output;
  char               path[PETSC_MAX_PATH_LEN], *text;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Bcast(&wanted, 1, MPIU_BOOL, 0, scene->comm));
  if (!wanted) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MeshHistoryDescribe(adaptive->history, run));
  PetscCall(AdaptiveSetVerdict(adaptive, run, "interrupted"));
  input = RunSummary(run);
  PetscCall(OutputCreate(scene->comm, &output));
  PetscCall(OutputAddFields(output, run->fields));
  PetscCall(SummaryCreate(&input, &text));
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s.json", scene->output));
  PetscCall(OutputAddText(output, path, text)); // the last file: if it is there, the result is complete
  free(text);
  InterruptHold();
  PetscCall(OutputFinish(&output));
  AdaptiveSetInterruptSentence(adaptive, PETSC_TRUE);
  InterruptRelease();
  RunForgetBlocks(run);
  run->solved    = PETSC_TRUE;
  run->report    = report;
  adaptive->kept = LogWallClock();
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode AdaptiveForgive(PetscErrorCode error, PetscBool *failed)
{
  PetscFunctionBeginUser;
  UserErrorUnmute((PetscBool)(error != MORTISE_ERR_USER));
  *failed = (PetscBool)(error == MORTISE_ERR_USER);
  if (!*failed) PetscCall(error);
  if (!*failed) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LogUnwind());
  WarningBreakRun();
  WarningHold();
  PetscFunctionReturn(PETSC_SUCCESS);
}

void AdaptiveSetFailure(Adaptive adaptive, PetscInt number, Run run)
{
  char when[TIME_TEXT] = "";

  if (adaptive->scene->steps.num) (void)snprintf(when, sizeof(when), " at t = %.9g", (double)adaptive->scene->time);
  (void)snprintf(adaptive->failure, ADAPTIVE_TEXT,
                 "these are results of mesh %" PetscInt_FMT ", mesh %" PetscInt_FMT " failed%s: %.400s", number - 1,
                 number, when, run ? RunGetFailure(run) : UserErrorSentence());
}

PetscErrorCode AdaptiveReturn(Adaptive adaptive, Vec last, PetscInt levels, Run *run)
{
  const Mesh mesh = adaptive->mesh;

  PetscFunctionBeginUser;
  if (*run && (*run)->vi->level != &mesh->levels[levels - 1]) PetscCall(RunDestroy(run));
  PetscCall(MeshReturn(mesh, levels));
  if (!*run && adaptive->num_older && adaptive->older[adaptive->num_older - 1].num_levels == levels)
    *run = adaptive->older[--adaptive->num_older].run;
  if (!*run) PetscCall(RunCreate(adaptive->scene, mesh, last, run));
  if (!(*run)->solved) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MeshHistoryDescribe(adaptive->history, *run));
  PetscCall(AdaptiveSetVerdict(adaptive, *run, adaptive->failure));
  PetscFunctionReturn(PETSC_SUCCESS);
}
