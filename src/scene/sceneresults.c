/* sceneresults.c -- probes, files, progress, and the few options of the solver that can be wrong before it exists. */
#include "scene/sceneparts.h"
#include "base/warning.h"

enum { WARNINGS_TELL, WARNINGS_ERROR };

PetscErrorCode SceneProbeRead(Scene scene, SceneProbe *probe)
{
  Option at, body;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-probe_<probe>_at", probe->name, NULL, &at));
  PetscCall(OptionFind(scene, "-probe_<probe>_body", probe->name, NULL, &body));
  PetscCall(OptionRequire(&at, "a probe needs a place"));
  PetscCall(OptionGetReals(&at, scene->dim, probe->at));
  if (scene->num_bodies > 1) PetscCall(OptionRequire(&body, "with several bodies a probe needs the name of its body"));
  if (body.set) PetscCall(SceneNamesFindBody(scene, &body, body.text, &probe->body));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* FileSet: -output_format is read only where there are files to format, so that it is told otherwise. */
static PetscErrorCode ResultsReadFiles_Private(Scene scene)
{
  Option      output, format, summary, report;
  const char *cursor = NULL;
  char        word[OPTION_MAX];
  PetscInt    choice = 0;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-output", NULL, NULL, &output));
  PetscCall(OptionFind(scene, "-summary", NULL, NULL, &summary));
  PetscCall(OptionGetText(&output, &scene->output));
  PetscCall(OptionGetText(&summary, &scene->summary));
  PetscCall(OptionFind(scene, "-report", NULL, NULL, &report));
  PetscCall(OptionGetBool(&report, &scene->report));
  if (scene->report && !scene->output)
    PetscCall(OptionRaise(&report, "the page stands beside the other files of -output; give -output as well"));
  if (!scene->output) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionFind(scene, "-output_format", NULL, NULL, &format));
  do {
    PetscCall(OptionNextItem(&format, &cursor, word));
    PetscCall(OptionMatchChoice(&format, word, "", &choice));
    scene->formats |= 1 << choice;
  } while (cursor);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* -check, which solves nothing: a study is its first mesh, load steps are t = 1, and there is nothing for a report to tell. */
static PetscErrorCode ResultsReadCheck_Private(Scene scene)
{
  Option only;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-check", NULL, NULL, &only));
  PetscCall(OptionGetBool(&only, &scene->check));
  if (!scene->check) PetscFunctionReturn(PETSC_SUCCESS);
  if (scene->report)
    PetscCall(OptionRaise(&only, "nothing is solved, so that -report has nothing to tell; give one of the two"));
  scene->study.kind  = STUDY_NONE;
  scene->steps.num   = 0;
  scene->cross_check = scene->measure_linear = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneResultsRead(Scene scene)
{
  Option   quiet, monitor, view, check, measure, type, warnings;
  PetscInt choice = 0;

  PetscFunctionBeginUser;
  PetscCall(ResultsReadFiles_Private(scene));
  PetscCall(OptionFind(scene, "-quiet", NULL, NULL, &quiet));
  PetscCall(OptionFind(scene, "-monitor", NULL, NULL, &monitor));
  PetscCall(OptionFind(scene, "-scene_view", NULL, NULL, &view));
  PetscCall(OptionFind(scene, "-cross_check", NULL, NULL, &check));
  PetscCall(OptionFind(scene, "-measure_linear", NULL, NULL, &measure));
  PetscCall(OptionGetBool(&measure, &scene->measure_linear));
  PetscCall(OptionGetBool(&quiet, &scene->quiet));
  PetscCall(OptionFind(scene, "-warnings", NULL, NULL, &warnings));
  PetscCall(OptionGetChoice(&warnings, &choice));
  scene->warnings_fail = (PetscBool)(choice == WARNINGS_ERROR);
  WarningSetQuiet((PetscBool)(scene->quiet && !scene->warnings_fail)); // what fails a run is said
  PetscCall(OptionGetBool(&monitor, &scene->monitor));
  PetscCall(OptionGetBool(&view, &scene->view));
  PetscCall(OptionGetBool(&check, &scene->cross_check));
  if (scene->cross_check && scene->stop == STOP_DISCRETISATION) {
    PetscCall(OptionRaise(
        &check, "-stop discretisation leaves a larger error than two solvers may differ by; give one of the two"));
  }
  PetscCall(ResultsReadCheck_Private(scene));
  if (scene->quiet && scene->monitor)
    PetscCall(OptionRaise(&monitor, "-quiet asks for the opposite; give one of the two"));
  PetscCall(OptionFind(scene, "-snes_type", NULL, NULL,
                       &type)); /* a word that SNES does not know would end in a stack trace */
  PetscCall(OptionMatchChoice(&type, type.text, " (contact needs a solver that keeps bounds)", &choice));
  PetscFunctionReturn(PETSC_SUCCESS);
}
