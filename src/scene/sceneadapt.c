/* sceneadapt.c -- adaptive meshes: the error asked for, and the limits of refinement. */
#include "scene/sceneparts.h"
#include <string.h>

enum { MOST_MESHES = 100 }; /* as many levels as a mesh has room for */

/* A number that must lie between two others, ends excluded. */
static PetscErrorCode AdaptReadShare_Private(const Option *option, PetscReal *value)
{
  PetscFunctionBeginUser;
  PetscCall(OptionGetReals(option, 1, value));
  if (!(*value > 0 && *value < 1)) PetscCall(OptionRaise(option, "give a number above 0 and below 1"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Splits "force:joint". [out] kind - index of the word; [out] name - what is behind it, within item */
static PetscErrorCode AdaptSplitGoal_Private(const Option *option, char item[], PetscInt *kind, const char **name)
{
  static const char *const words[GOAL_COUNT] = {
      [GOAL_FORCE] = "force", [GOAL_PROBE] = "probe", [GOAL_PRESSURE] = "pressure"};
  char       *colon = strchr(item, ':');
  const char *near;

  PetscFunctionBeginUser;
  if (!colon)
    PetscCall(OptionRaise(option, "'%s' is not a goal; write force:<pair>, probe:<name> or pressure:<pair>", item));
  *colon = '\0';
  *name  = colon + 1;
  for (*kind = 0; *kind < GOAL_COUNT && strcmp(item, words[*kind]) != 0; (*kind)++) {}
  if (*kind < GOAL_COUNT) PetscFunctionReturn(PETSC_SUCCESS);
  near = UserErrorNearest(item, GOAL_COUNT, words);
  PetscCall(OptionRaise(option, "'%s' is not one of force, probe, pressure%s%s%s", item, near ? "; did you mean " : "",
                        near ? near : "", near ? "?" : ""));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Finds the pair or the probe of a goal. */
static PetscErrorCode AdaptFindOwner_Private(const Option *option, const char name[], SceneGoal *goal)
{
  const Scene     scene = option->scene;
  const PetscBool probe = (PetscBool)(goal->kind == GOAL_PROBE);
  const PetscInt  num   = probe ? scene->num_probes : scene->num_pairs;
  const char    **names, *near;
  char            list[OPTION_MAX];
  size_t          length = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(num, &names));
  goal->owner = -1;
  list[0]     = '\0';
  for (PetscInt i = 0; i < num; i++) {
    names[i] = probe ? scene->probes[i].name : scene->pairs[i].name;
    if (!strcmp(names[i], name)) goal->owner = i;
    if (length < sizeof(list))
      length += (size_t)snprintf(list + length, sizeof(list) - length, "%s%s", i ? ", " : "", names[i]);
  }
  near = UserErrorNearest(name, num, names);
  PetscCall(PetscFree(names));
  if (goal->owner >= 0) PetscFunctionReturn(PETSC_SUCCESS);
  if (!num) PetscCall(OptionRaise(option, "there is no %s '%s'; the scene has none", probe ? "probe" : "pair", name));
  PetscCall(OptionRaise(option, "there is no %s '%s'; the %s %s%s%s%s", probe ? "probe" : "pair", name,
                        probe ? "probes are" : "pairs are", list, near ? "; did you mean " : "", near ? near : "",
                        near ? "?" : ""));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode AdaptReadGoals_Private(const Option *option, SceneAdapt *adapt)
{
  const char *cursor = NULL, *name = NULL;
  char        item[OPTION_MAX];
  PetscInt    kind = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(OptionCountItems(option), &adapt->goals));
  do {
    SceneGoal *goal = &adapt->goals[adapt->num_goals++];

    PetscCall(OptionNextItem(option, &cursor, item));
    PetscCall(PetscStrallocpy(item, &goal->text));
    PetscCall(AdaptSplitGoal_Private(option, item, &kind, &name));
    goal->kind = (GoalKind)kind;
    PetscCall(AdaptFindOwner_Private(option, name, goal));
  } while (cursor);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads -adapt, -adapt_goal and its tolerance. [out] option - the one of the two that is given */
static PetscErrorCode AdaptReadTolerances_Private(Scene scene, Option *option)
{
  SceneAdapt *adapt = &scene->adapt;
  Option      goals, tolerance;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-adapt", NULL, NULL, option));
  PetscCall(OptionFind(scene, "-adapt_goal", NULL, NULL, &goals));
  adapt->on = (PetscBool)(option->set || goals.set);
  if (option->set) PetscCall(AdaptReadShare_Private(option, &adapt->tolerance));
  if (!goals.set) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionFind(scene, "-adapt_goal_tolerance", NULL, NULL, &tolerance));
  PetscCall(AdaptReadShare_Private(&tolerance, &adapt->goal_tolerance));
  PetscCall(AdaptReadGoals_Private(&goals, adapt));
  if (!option->set) *option = goals;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads options of adaptive meshes. Without -adapt they are not read, so that they are reported as unused. */
PetscErrorCode SceneAdaptRead(Scene scene)
{
  SceneAdapt *adapt = &scene->adapt;
  Option      option, marking, unknowns, meshes, study, memory;

  PetscFunctionBeginUser;
  PetscCall(AdaptReadTolerances_Private(scene, &option));
  if (!adapt->on) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionFind(scene, "-study", NULL, NULL, &study));
  if (study.set) PetscCall(OptionRaise(&option, "a study has its own meshes; omit -study or %s", option.name));
  adapt->memory = PETSC_INFINITY;
  PetscCall(OptionFind(scene, "-study_memory", NULL, NULL, &memory));
  PetscCall(OptionGetBytes(&memory, &adapt->memory));
  PetscCall(OptionFind(scene, "-adapt_marking", NULL, NULL, &marking));
  PetscCall(OptionFind(scene, "-adapt_max_unknowns", NULL, NULL, &unknowns));
  PetscCall(OptionFind(scene, "-adapt_max_meshes", NULL, NULL, &meshes));
  PetscCall(AdaptReadShare_Private(&marking, &adapt->marking));
  PetscCall(OptionGetReals(&unknowns, 1, &adapt->max_unknowns));
  if (!(adapt->max_unknowns >= 1)) PetscCall(OptionRaise(&unknowns, "give a number of at least 1"));
  PetscCall(OptionGetInts(&meshes, 1, 1, &adapt->max_meshes));
  if (adapt->max_meshes > MOST_MESHES) PetscCall(OptionRaise(&meshes, "give a number of at most %d", (int)MOST_MESHES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the plane Hooke tensor of some part of a body leaves the stress across the plane, and so von Mises'
   stress, undetermined. */
static PetscBool AdaptLacksMises_Private(Scene scene, PetscInt body)
{
  const SceneBody *b = &scene->bodies[body];

  if (scene->model != MODEL_PLANE_STRAIN) return PETSC_FALSE;
  if (b->material.stiffness) return PETSC_TRUE;
  for (PetscInt r = 0; r < b->num_regions; r++) {
    if (SceneGetMaterial(scene, SceneBodyFirstRegion(scene, body) + r)->stiffness) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* User error: on facets of order 2 with nodes that hang, multipliers are at all nodes. */
static PetscErrorCode AdaptCheckMultipliers_Private(Scene scene)
{
  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < scene->num_pairs && scene->adapt.kept && scene->dim == 3; p++) {
    const ScenePair *pair = &scene->pairs[p];

    if (pair->multipliers != MULTIPLIERS_VERTICES || scene->bodies[pair->nonmortar.body].order < 2) continue;
    PetscCall(
        UserErrorRaise(scene->comm,
                       "-%s_multipliers vertices: with -adapt_cells kept, multipliers of hexahedra of order 2 are at "
                       "all nodes; omit the option",
                       pair->name));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads whether quadrilaterals and hexahedra are kept, of -adapt and of -study adaptive. */
static PetscErrorCode AdaptReadCells_Private(Scene scene)
{
  PetscInt choice = 0;
  Option   cells;

  PetscFunctionBeginUser;
  if (!scene->adapt.on) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionFind(scene, "-adapt_cells", NULL, NULL, &cells));
  PetscCall(OptionGetChoice(&cells, &choice));
  scene->adapt.kept = (PetscBool)(choice > 0);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneAdaptCheck(Scene scene)
{
  const SceneAdapt *adapt = &scene->adapt;

  PetscFunctionBeginUser;
  PetscCall(AdaptReadCells_Private(scene));
  PetscCall(AdaptCheckMultipliers_Private(scene));
  for (PetscInt g = 0; g < adapt->num_goals; g++) {
    const SceneGoal  *goal  = &adapt->goals[g];
    const SceneProbe *probe = goal->kind == GOAL_PROBE ? &scene->probes[goal->owner] : NULL;

    if (!probe || !AdaptLacksMises_Private(scene, probe->body)) continue;
    PetscCall(UserErrorRaise(scene->comm,
                             "-adapt_goal %s: von Mises' stress is not known in body %s, whose plane stiffness leaves "
                             "the stress across the plane open; give -model plane_stress, or another goal",
                             goal->text, scene->bodies[probe->body].name));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneAdaptDestroy(SceneAdapt *adapt)
{
  PetscFunctionBeginUser;
  for (PetscInt g = 0; g < adapt->num_goals; g++) PetscCall(PetscFree(adapt->goals[g].text));
  PetscCall(PetscFree(adapt->goals));
  PetscFunctionReturn(PETSC_SUCCESS);
}
