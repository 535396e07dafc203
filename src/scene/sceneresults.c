/* sceneresults.c -- probes, files, progress, and the few options of the solver that can be wrong before it
   exists. */
#include "scene/sceneparts.h"
#include "base/usererror.h"
#include "base/warning.h"
#include <string.h>

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

PetscErrorCode ScenePathRead(Scene scene, ScenePath *path)
{
  Option    from, to, points, body;
  PetscReal longest = 0;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-path_<path>_from", path->name, NULL, &from));
  PetscCall(OptionFind(scene, "-path_<path>_to", path->name, NULL, &to));
  PetscCall(OptionFind(scene, "-path_<path>_points", path->name, NULL, &points));
  PetscCall(OptionFind(scene, "-path_<path>_body", path->name, NULL, &body));
  PetscCall(OptionRequire(&from, "a path needs its two ends"));
  PetscCall(OptionRequire(&to, "a path needs its two ends"));
  PetscCall(OptionGetReals(&from, scene->dim, path->from));
  PetscCall(OptionGetReals(&to, scene->dim, path->to));
  PetscCall(OptionGetInts(&points, 1, 2, &path->points));
  for (PetscInt k = 0; k < 3; k++) longest = PetscMax(longest, PetscAbsReal(path->to[k] - path->from[k]));
  if (longest == 0) PetscCall(OptionRaise(&to, "the path ends where it begins; for one point give -probes"));
  if (scene->num_bodies > 1) PetscCall(OptionRequire(&body, "with several bodies a path needs the name of its body"));
  if (body.set) PetscCall(SceneNamesFindBody(scene, &body, body.text, &path->body));
  for (PetscInt p = 0; p < scene->num_pairs; p++) {
    if (strcmp(scene->pairs[p].name, "paths") == 0) {
      PetscCall(UserErrorRaise(scene->comm, "-pairs: the name paths would give its table the name of that of -paths; "
                                            "choose another name"));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* -output_format is read only where files are written; else it is reported as unused. */
static PetscErrorCode ResultsReadFiles_Private(Scene scene)
{
  Option      output, format, summary, report, paths;
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
  PetscCall(OptionFind(scene, "-paths", NULL, NULL, &paths));
  if (scene->num_paths && !scene->output)
    PetscCall(OptionRaise(&paths, "their table stands beside the other files of -output; give -output as well"));
  if (!scene->output) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionFind(scene, "-output_format", NULL, NULL, &format));
  do {
    PetscCall(OptionNextItem(&format, &cursor, word));
    PetscCall(OptionMatchChoice(&format, word, "", &choice));
    scene->formats |= 1 << choice;
  } while (cursor);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* -check, which solves nothing: a study is its first mesh, load steps are t = 1, and there is nothing for a
   report to tell. */
static PetscErrorCode ResultsReadCheck_Private(Scene scene)
{
  Option only;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-check", NULL, NULL, &only));
  PetscCall(OptionGetBool(&only, &scene->check));
  if (!scene->check) PetscFunctionReturn(PETSC_SUCCESS);
  if (scene->report)
    PetscCall(OptionRaise(&only, "nothing is solved, and there is nothing to report; give one of the two"));
  scene->study.kind  = STUDY_NONE;
  scene->steps.num   = 0;
  scene->cross_check = scene->measure_linear = scene->infsup = PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* -warnings_accept: a list of codes. [out] codes - of WarningSetAccepted() */
static PetscErrorCode ResultsReadAccepted_Private(const Option *option, uint64_t *codes)
{
  PetscInt           num;
  const char *const *known  = WarningCodes(&num), *near;
  const char        *cursor = NULL;
  char               word[OPTION_MAX];

  PetscFunctionBeginUser;
  *codes = 0;
  if (!option->set) PetscFunctionReturn(PETSC_SUCCESS);
  do {
    PetscInt k = 0;

    PetscCall(OptionNextItem(option, &cursor, word));
    while (k < num && strcmp(known[k], word)) k++;
    if (k < num) *codes |= (uint64_t)1 << k;
    if (k < num) continue;
    near = UserErrorNearest(word, num, known);
    PetscCall(OptionRaise(option, "'%s' is no code of a warning%s%s%s", word, near ? "; did you mean " : "",
                          near ? near : "; each line on stderr ends with its code", near ? "?" : ""));
  } while (cursor);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneWarningsRead(Scene scene)
{
  Option   quiet, warnings, accepted;
  PetscInt choice = WARNINGS_TELL;
  uint64_t codes;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-quiet", NULL, NULL, &quiet));
  PetscCall(OptionGetBool(&quiet, &scene->quiet));
  PetscCall(OptionFind(scene, "-warnings", NULL, NULL, &warnings));
  PetscCall(OptionGetChoice(&warnings, &choice));
  scene->warnings_fail = (PetscBool)(choice == WARNINGS_ERROR);
  WarningSetQuiet((PetscBool)(scene->quiet && !scene->warnings_fail)); // what fails a run is said
  PetscCall(OptionFind(scene, "-warnings_accept", NULL, NULL, &accepted));
  PetscCall(ResultsReadAccepted_Private(&accepted, &codes));
  WarningSetAccepted(codes);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneResultsRead(Scene scene)
{
  Option   monitor, view, check, measure, infsup, type;
  PetscInt choice = 0;

  PetscFunctionBeginUser;
  PetscCall(ResultsReadFiles_Private(scene));
  PetscCall(OptionFind(scene, "-monitor", NULL, NULL, &monitor));
  PetscCall(OptionFind(scene, "-scene_view", NULL, NULL, &view));
  PetscCall(OptionFind(scene, "-cross_check", NULL, NULL, &check));
  PetscCall(OptionFind(scene, "-measure_linear", NULL, NULL, &measure));
  PetscCall(OptionGetBool(&measure, &scene->measure_linear));
  PetscCall(OptionFind(scene, "-infsup", NULL, NULL, &infsup));
  PetscCall(OptionGetBool(&infsup, &scene->infsup));
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
  PetscCall(
      OptionFind(scene, "-snes_type", NULL, NULL, &type)); /* for an unknown word SNES would print a stack trace */
  PetscCall(OptionMatchChoice(&type, type.text, " (contact needs a solver that keeps bounds)", &choice));
  PetscFunctionReturn(PETSC_SUCCESS);
}
