/* handle.c -- the life of a handle: options, scene, mesh, solution. */
#include "api/apiimpl.h"
#include <stdlib.h>
#include "api/process.h"
#include "base/compat.h"
#include "base/log.h"
#include "base/options.h"
#include "base/warning.h"
#include "output/htmlreport.h"
#include "result/probes.h"
#include "study/adaptive.h"
#include "study/steps.h"
#include "study/study.h"

PetscErrorCode ApiNeedScene(Mortise m, const char function[])
{
  PetscFunctionBeginUser;
  if (m->scene) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(UserErrorRaise(m->comm, "%s(): there is no scene yet; call MortiseSetFromOptions() before", function));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ApiNeedRun(Mortise m, const char function[])
{
  PetscFunctionBeginUser;
  if (m->run) PetscFunctionReturn(PETSC_SUCCESS);
  if (m->solved_once) PetscCall(UserErrorRaise(m->comm, "%s(): -study has solved several meshes; omit it", function));
  PetscCall(UserErrorRaise(m->comm, "%s(): there is no solution yet; call MortiseSolve() before", function));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseCreate(MPI_Comm comm, Mortise *m)
{
  const PetscErrorCode error = ApiNeedLibrary("MortiseCreate");
  int                  ranks, all;

  PetscFunctionBeginUser;
  *m = NULL;
  if (error) PetscFunctionReturn(error); // PETSc need not run
  PetscCallMPI(MPI_Comm_size(comm, &ranks));
  PetscCallMPI(MPI_Comm_size(MPI_COMM_WORLD, &all));
  if (ranks != all)
    PetscCall(UserErrorRaise(comm, "MortiseCreate(): the communicator has %d ranks, all %d are needed", ranks, all));
  PetscCall(PetscNew(m));
  (*m)->comm = comm;
  (*m)->time = 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Destroys what was made of the solution for getters. Collective. */
static PetscErrorCode HandleDropResults_Private(Mortise m)
{
  PetscFunctionBeginUser;
  for (PetscInt p = 0; m->pairs && p < m->scene->num_pairs; ++p) {
    PetscCall(VecDestroy(&m->pairs[p].pressure));
    PetscCall(VecDestroy(&m->pairs[p].gap));
    if (m->pairs[p].known) PetscCall(PairFieldsDestroy(&m->pairs[p].nodal));
  }
  PetscCall(PetscFree(m->pairs));
  free(m->summary);
  m->summary = NULL;
  cJSON_Delete(m->numbers);
  m->numbers = NULL;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Destroys the results, the mesh and the scene. */
static PetscErrorCode HandleClear_Private(Mortise m)
{
  PetscFunctionBeginUser;
  PetscCall(HandleDropResults_Private(m));
  PetscCall(VecDestroy(&m->guess));
  PetscCall(VecDestroy(&m->coordinates));
  PetscCall(RunDestroy(&m->run));
  if (m->mesh) PetscCall(MeshDestroy(&m->mesh));
  PetscCall(SceneDestroy(&m->scene));
  WarningClear();
  m->guess_given = m->solved_once = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseDestroy(Mortise *m)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  if (!*m) PetscFunctionReturn(PETSC_SUCCESS);
  API_VALID(*m);
  PetscCall(ApiBegin(*m));
  error = HandleClear_Private(*m);
  PetscCall(ApiEnd(*m, error));
  if ((*m)->options) PetscCall(PetscOptionsDestroy(&(*m)->options));
  PetscCall(PetscFree((*m)->prefix));
  PetscCall(PetscFree(*m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseSetOptionsPrefix(Mortise m, const char prefix[])
{
  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(PetscFree(m->prefix));
  if (m->options) PetscCall(PetscOptionsDestroy(&m->options));
  if (!prefix || !prefix[0]) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscStrallocpy(prefix, &m->prefix));
  PetscCall(PetscOptionsCreate(&m->options));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseInsertFile(Mortise m, const char file[])
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = ApiNeedName(m, "MortiseInsertFile", file, "file");
  if (!error) error = OptionsInsertFile(file);
  PetscCall(ApiEnd(m, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads the scene. After an error it is kept as it is: its state is unknown. */
static PetscErrorCode HandleReadScene_Private(Mortise m)
{
  Scene scene;

  PetscFunctionBeginUser;
  PetscCall(LogStageBegin(STAGE_SETUP));
  PetscCall(SceneCreate(m->comm, &scene));
  PetscCall(SceneSetTime(scene, m->time));
  PetscCall(SceneSetFromOptions(scene));
  PetscCall(SceneCheckUnused(scene, PETSC_TRUE));
  PetscCall(OutputCheck(scene));
  if (scene->report && !ProcessIsOwn())
    PetscCall(UserErrorRaise(m->comm, "-report: the page is made by the program mortise; write files with -output, and "
                                      "call mortise-report for them"));
  if (ProcessIsOwn() && scene->steps.scale_set && !scene->steps.num)
    PetscCall(UserErrorRaise(m->comm, "-load_steps_scale: without load steps t is 1, and multiplies nothing; give "
                                      "-load_steps, too, or omit it"));
  PetscCall(HTMLReportCheck(scene));
  PetscCall(LogStageEnd(STAGE_SETUP));
  if (!ProcessIsOwn() && !scene->monitor) scene->quiet = PETSC_TRUE; // a library prints on request only
  m->scene = scene;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseSetFromOptions(Mortise m)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  if (m->options) PetscCall(OptionsCopyPrefixed(m->prefix, m->options));
  PetscCall(ApiBegin(m));
  error = HandleClear_Private(m);
  if (!error) error = HandleReadScene_Private(m);
  PetscCall(ApiEnd(m, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Creates the mesh. After an error it is kept as it is, like the scene. */
static PetscErrorCode HandleSetUp_Private(Mortise m)
{
  Mesh mesh;

  PetscFunctionBeginUser;
  PetscCall(ApiNeedScene(m, "MortiseSetUp"));
  if (m->mesh || m->scene->study.kind != STUDY_NONE) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(SceneSetTime(m->scene, m->time));
  PetscCall(LogStageBegin(STAGE_SETUP));
  PetscCall(MeshCreate(m->scene, &mesh));
  PetscCall(MeshSetUp(mesh));
  PetscCall(ProbesCheck(m->scene, mesh));
  PetscCall(LogStageEnd(STAGE_SETUP));
  m->mesh = mesh;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseSetUp(Mortise m)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = HandleSetUp_Private(m);
  PetscCall(ApiEnd(m, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode HandleSetTime_Private(Mortise m, PetscReal t)
{
  PetscFunctionBeginUser;
  if (PetscIsInfOrNanReal(t)) PetscCall(UserErrorRaise(m->comm, "MortiseSetTime(): t is not a finite number"));
  m->time    = t;
  m->several = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseSetTime(Mortise m, PetscReal t)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = HandleSetTime_Private(m, t);
  PetscCall(ApiEnd(m, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode HandleSetDatum_Private(Mortise m, const char option[], PetscInt num, const PetscReal values[])
{
  PetscFunctionBeginUser;
  PetscCall(ApiNeedScene(m, "MortiseSetDatum"));
  PetscCall(ApiNeedName(m, "MortiseSetDatum", option, "option"));
  PetscCall(SceneSetDatum(m->scene, option, num, values));
  m->several = PETSC_TRUE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseSetDatum(Mortise m, const char option[], PetscInt num, const PetscReal values[])
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = HandleSetDatum_Private(m, option, num, values);
  PetscCall(ApiEnd(m, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* User error: a guess has another layout than displacements. Collective. */
static PetscErrorCode HandleCheckGuess_Private(Mortise m, Vec u)
{
  const Level   *level     = MeshFinest(m->mesh);
  const PetscInt wanted    = level->dim * level->num_owned;
  char           text[128] = "";
  PetscInt       size;

  PetscFunctionBeginUser;
  PetscCall(VecGetLocalSize(u, &size));
  if (size != wanted)
    PetscCall(PetscSNPrintf(text, sizeof(text),
                            "MortiseSetInitialGuess(): u has %" PetscInt_FMT " numbers on a rank, %" PetscInt_FMT
                            " are wanted",
                            size, wanted));
  PetscCall(UserErrorCheck(m->comm, text));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode HandleSetGuess_Private(Mortise m, Vec u)
{
  PetscFunctionBeginUser;
  PetscCall(ApiNeedScene(m, "MortiseSetInitialGuess"));
  PetscCall(HandleSetUp_Private(m));
  if (u && m->mesh) PetscCall(HandleCheckGuess_Private(m, u));
  PetscCall(VecDestroy(&m->guess));
  m->guess_given = PETSC_TRUE;
  if (!u || !m->mesh) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelCreateVec(MeshFinest(m->mesh), m->scene->dim, &m->guess));
  PetscCall(VecCopy(u, m->guess));
  PetscCall(LevelShareVec(m->guess, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseSetInitialGuess(Mortise m, Vec u)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = HandleSetGuess_Private(m, u);
  PetscCall(ApiEnd(m, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* With -warnings error, warnings make the run fail; files and numbers are complete all the same. */
static PetscErrorCode HandleCountWarnings_Private(Mortise m)
{
  PetscInt num;

  PetscFunctionBeginUser;
  if (!m->scene->warnings_fail) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(WarningNum(m->comm, &num));
  if (!num || m->verdict != MORTISE_SOLVED) PetscFunctionReturn(PETSC_SUCCESS);
  m->verdict = MORTISE_NOT_CONVERGED;
  if (ProcessIsOwn()) {
    PetscCall(PetscFPrintf(m->comm, PETSC_STDERR,
                           "mortise: -warnings error: %" PetscInt_FMT " warning%s; the results are complete\n", num,
                           num == 1 ? "" : "s"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Takes the initial displacement and the last run from the handle.
   [out] guess - owned by the caller, or NULL: that of the last solutions; [out] run - owned by the caller, or
   NULL: everything is computed anew */
static PetscErrorCode HandleTakeLast_Private(Mortise m, Vec *guess, Run *run)
{
  PetscFunctionBeginUser;
  if (m->guess_given && !m->guess) PetscCall(RunDestroy(&m->run)); // it would begin with its own solution
  *guess         = m->guess;
  *run           = m->run;
  m->guess       = NULL;
  m->run         = NULL; // after an error its state is unknown
  m->guess_given = PETSC_FALSE;
  PetscCall(HandleDropResults_Private(m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode HandleSolve_Private(Mortise m)
{
  Vec guess;
  Run run;

  PetscFunctionBeginUser;
  PetscCall(ApiNeedScene(m, "MortiseSolve"));
  if (m->solved_once) PetscCall(LogReset(LogWallClock()));
  PetscCall(SceneSetTime(m->scene, m->time));
  PetscCall(HandleSetUp_Private(m));
  PetscCall(HandleTakeLast_Private(m, &guess, &run));
  if (run && m->scene->check) PetscCall(RunDestroy(&run));
  m->solved_once = PETSC_FALSE;
  m->scene->keep = (PetscBool)(m->several || m->scene->steps.num);
  if (m->mesh) {
    if (m->scene->steps.num)
      PetscCall(StepsRun(m->scene, m->mesh, guess, &run));
    else if (m->scene->adapt.on)
      PetscCall(AdaptiveRun(m->scene, m->mesh, guess, &run));
    else
      PetscCall(run ? RunAdvance(guess, &run) : RunCreate(m->scene, m->mesh, guess, &run));
    PetscCall(VecDestroy(&guess));
    m->run     = run;
    m->verdict = run->solved || run->checked ? MORTISE_SOLVED
                 : run->refused              ? MORTISE_NO_SOLUTION
                                             : MORTISE_NOT_CONVERGED;
    PetscCall(PetscCalloc1(m->scene->num_pairs, &m->pairs));
  } else {
    PetscCall(StudyRun(m->scene, &m->verdict));
  }
  m->scene->view = PETSC_FALSE; // of the first solve only
  m->solved_once = PETSC_TRUE;
  PetscCall(HandleCountWarnings_Private(m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortiseSolve(Mortise m)
{
  PetscErrorCode error;

  PetscFunctionBeginUser;
  API_VALID(m);
  PetscCall(ApiBegin(m));
  error = HandleSolve_Private(m);
  PetscCall(ApiEnd(m, error));
  PetscFunctionReturn(PETSC_SUCCESS);
}
