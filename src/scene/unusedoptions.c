/* unusedoptions.c -- options that nothing reads: misspelt, left over, or PETSc's.

   PETSc marks an option as used when it is looked up, and reads many of its own late. So the table decides on
   misspelt options at once. An option is unknown if it fits no row and lies outside the name spaces of PETSc.
   Unread options in those name spaces are reported after the solution. The first rank judges for all: it
   reads what any rank does. */
#include "scene/sceneparts.h"
#include "base/warning.h"
#include <string.h>
#include <strings.h>

/* An option that nothing has read yet. */
typedef struct {
  char               name[OPTION_MAX]; /* with its dash */
  const char        *value;            /* "" for a bare option */
  const char        *owner;            /* body, pair or probe whose name it begins with, or NULL */
  const OptionEntry *entry;            /* row of the table that it fits, or NULL */
} Leftover;

/* Options of PETSc's start and end, many of which are read when the program is over; with a final underscore:
   beginnings. */
// clang-format off
static const char *const environment[] = {
    "checkstack", "citations", "debugger_", "device_", "display", "fp_trap", "get_total_flops", "help",
    "info", "info_", "log_", "malloc", "malloc_", "memory_view", "mpi_", "mpidump", "no_signal_handler",
    "nox", "objects_dump", "on_error_", "options_file_yaml", "options_string_yaml", "options_left",
    "options_monitor", "options_monitor_cancel", "options_view", "petsc_", "python", "saws_", "shared_tmp_",
    "skip_petscrc", "start_in_debugger", "stop_for_debugger", "tmp", "use_gpu_aware_mpi", "version", "viewer_"};
// clang-format on

/* Name spaces of PETSc's objects. */
static const char *const objects[] = {"ksp_",        "pc_",      "snes_",   "mat_",        "vec_",
                                      "dm_",         "dmplex_",  "mg_",     "tao_",        "ts_",
                                      "is_",         "sf_",      "da_",     "fieldsplit_", "petscpartitioner_",
                                      "petscspace_", "petscfe_", "petscds_"};

/* Name spaces within PETSc's that are this program's, and one of PETSc's in them again, that of readers of
   mesh files. */
static const char *const ours[]    = {"snes_pdas_", "dm_"};
static const char *const readers[] = {"dm_plex_"};

/* Words that are PETSc's behind any prefix, as in -sub_pc_type. */
static const char *const nested[] = {"_snes_", "_ksp_", "_pc_", "_mat_"};

static PetscBool UnusedBegins_Private(const char option[], size_t num, const char *const words[])
{
  for (size_t i = 0; i < num; i++) {
    const size_t length = strlen(words[i]);
    const int    differ =
        words[i][length - 1] == '_' ? strncasecmp(option + 1, words[i], length) : strcasecmp(option + 1, words[i]);

    if (!differ) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

static PetscBool UnusedIsEnvironment_Private(const char option[])
{
  return UnusedBegins_Private(option, PETSC_STATIC_ARRAY_LENGTH(environment), environment);
}

PetscBool UnusedOptionsBeginsLikePETSc(const char option[])
{
  return (PetscBool)(UnusedIsEnvironment_Private(option) ||
                     UnusedBegins_Private(option, PETSC_STATIC_ARRAY_LENGTH(objects), objects));
}

/* Finds owner and row of an option. Where several names begin it, the one counts with which it is a row of
   the table. */
static PetscErrorCode UnusedJudge_Private(Scene scene, const char name[], const char value[], Leftover *left)
{
  const char *owner;
  OptionScope scope;

  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(left->name, sizeof(left->name), "-%s", name));
  left->value = value ? value : "";
  left->owner = NULL;
  left->entry = OptionTableMatch(SCOPE_PROGRAM, "", left->name);
  for (PetscInt i = 0; !left->entry && (owner = SceneNamesGet(scene, i, &scope)); i++) {
    const char  *prefix = scope == SCOPE_PROBE ? "probe_" : scope == SCOPE_PATH ? "path_" : "";
    const size_t before = strlen(prefix), length = strlen(owner);
    const char  *begin = left->name + 1 + before;

    if (strncasecmp(left->name + 1, prefix, before) != 0) continue;
    if (strncasecmp(begin, owner, length) != 0 || begin[length] != '_') continue;
    left->owner = owner;
    left->entry = OptionTableMatch(scope, owner, left->name);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the table has the option in a row of its own, not only among a whole name space of PETSc's. */
static PetscBool UnusedIsDocumented_Private(const Leftover *left)
{
  return (PetscBool)(left->entry && !strchr(left->entry->name, '*'));
}

/* Whether PETSc, or the solver, may still read the option. */
static PetscBool UnusedMayBeRead_Private(const Leftover *left)
{
  if (UnusedIsDocumented_Private(left)) {
    return (PetscBool)(left->entry->group == GROUP_PETSC || left->entry->group == GROUP_SOLVER);
  }
  if (UnusedBegins_Private(left->name, PETSC_STATIC_ARRAY_LENGTH(readers), readers)) return PETSC_TRUE;
  if (UnusedBegins_Private(left->name, PETSC_STATIC_ARRAY_LENGTH(ours), ours)) return PETSC_FALSE;
  if (left->entry) return PETSC_TRUE;
  if (left->owner) return PETSC_FALSE;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(nested); i++) {
    if (strstr(left->name, nested[i])) return PETSC_TRUE;
  }
  return UnusedOptionsBeginsLikePETSc(left->name);
}

PetscErrorCode UnusedOptionsNearest(const Option *option, char near[OPTION_MAX])
{
  const char *const wanted = option->name;
  PetscInt          num;
  char            **names, **values;
  Leftover          left;

  PetscFunctionBeginUser;
  near[0] = '\0';
  PetscCall(PetscOptionsLeftGet(NULL, &num, &names, &values));
  for (PetscInt i = 0; i < num && !near[0]; i++) {
    PetscCall(UnusedJudge_Private(option->scene, names[i], values[i], &left));
    if (UnusedIsDocumented_Private(&left)) { /* merely not read yet, unless it is the same for another side */
      if (left.entry != option->entry || !strstr(left.entry->name, "<side>")) continue;
      if (strcasecmp(left.owner, option->owner) != 0) continue;
    }
    if (!UserErrorNearest(left.name, 1, &wanted)) continue;
    PetscCall(PetscStrncpy(near, left.name, OPTION_MAX));
  }
  PetscCall(PetscOptionsLeftRestore(NULL, &num, &names, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a suggestion stays in the option's name space: what is meant by -ksp_x is not -snes_x. */
static PetscBool UnusedIsOfSameSpace_Private(const char option[], const char near[])
{
  return (PetscBool)(!UnusedOptionsBeginsLikePETSc(option) || !strncasecmp(option, near, strcspn(option, "_") + 1));
}

/* What stands between a body and a key of regions, as "soft" in -plate_soft_young.
   [out] body - NULL if it is no such option; [out] key - with its underscore; [out] region - [OPTION_MAX] */
static void UnusedSplitRegion_Private(Scene scene, const char option[], const SceneBody **body, const char **key,
                                      char region[])
{
  PetscInt           num;
  const OptionEntry *table = OptionTable(&num);

  *body = NULL;
  for (PetscInt b = 0; b < scene->num_bodies && !*body; b++) {
    const char  *name = scene->bodies[b].name, *rest = option + 1 + strlen(name) + 1;
    const size_t length = strlen(option);

    if (strncasecmp(option + 1, name, strlen(name)) != 0 || option[1 + strlen(name)] != '_') continue;
    for (PetscInt i = 0; i < num && !*body; i++) {
      if (OptionEntryScope(&table[i]) != SCOPE_REGION) continue;
      *key = OptionPlaceholderEnd(strchr(table[i].name, '<'));
      if (strlen(rest) <= strlen(*key) || strcasecmp(option + length - strlen(*key), *key) != 0) continue;
      *body = &scene->bodies[b];
      (void)snprintf(region, OPTION_MAX, "%.*s", (int)(strlen(rest) - strlen(*key)), rest);
    }
  }
}

/* The sentence about a datum of a region that -<body>_regions does not list; untouched if the option is
   none. */
static PetscErrorCode UnusedExplainRegion_Private(Scene scene, const Leftover *left, const char shown[],
                                                  char sentence[OPTION_SENTENCE])
{
  const SceneBody *body;
  const char      *key, **names, *near;
  char             region[OPTION_MAX], list[OPTION_MAX] = "";
  size_t           used = 0;

  PetscFunctionBeginUser;
  UnusedSplitRegion_Private(scene, left->name, &body, &key, region);
  if (!body) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(body->num_regions, &names));
  for (PetscInt r = 0; r < body->num_regions; r++) {
    names[r] = scene->regions[body->first_region + r].prefix + strlen(body->name) + 1;
    if (used < sizeof(list))
      used += (size_t)snprintf(list + used, sizeof(list) - used, "%s%s", r ? "," : " ", names[r]);
  }
  near = UserErrorNearest(region, body->num_regions, names);
  PetscCall(PetscFree(names));
  (void)snprintf(sentence, OPTION_SENTENCE,
                 "%s: body %s has no region %.100s; -%s_regions%.300s lists physical groups of its mesh file that have "
                 "data of their own",
                 shown, body->name, region, body->name, list);
  if (near) {
    used = strlen(sentence);
    (void)snprintf(sentence + used, OPTION_SENTENCE - used, "; did you mean -%s_%s%s?", body->name, near, key);
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The documented option that lacks the name of a body, pair or probe before it, as -young; NULL if it is
   none. */
static const char *UnusedFindNameless_Private(const Leftover *left)
{
  PetscInt           num;
  const OptionEntry *table = OptionTable(&num);

  for (PetscInt i = 0; i < num && !left->owner; i++) {
    const char *open = strchr(table[i].name, '<'), *key = open ? OptionPlaceholderEnd(open) : "";

    if (key[0] == '_' && key[1] && !strcasecmp(key + 1, left->name + 1)) return table[i].name;
  }
  return NULL;
}

/* Whether a name is one that other options left over begin with, too, or unlike all names of the scene: else
   it is a misspelt one. */
static PetscErrorCode UnusedIsName_Private(Scene scene, const char prefix[], const char name[], PetscBool *is)
{
  PetscInt    num, same = 0;
  char      **names, **values;
  const char *owner;
  OptionScope scope;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsLeftGet(NULL, &num, &names, &values));
  for (PetscInt i = 0; i < num; i++) {
    const char *rest = names[i] + strlen(prefix);

    if (strncasecmp(names[i], prefix, strlen(prefix)) != 0 || strncasecmp(rest, name, strlen(name)) != 0) continue;
    same += rest[strlen(name)] == '_';
  }
  PetscCall(PetscOptionsLeftRestore(NULL, &num, &names, &values));
  *is = PETSC_TRUE;
  for (PetscInt i = 0; same < 2 && *is && (owner = SceneNamesGet(scene, i, &scope)); i++)
    *is = (PetscBool)!UserErrorNearest(name, 1, &owner);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The list that lacks the name of an option, which is one but for that: "-bodies"; NULL if it is none.
   [out] name - [OPTION_MAX] */
static PetscErrorCode UnusedFindUnlisted_Private(Scene scene, const Leftover *left, const char **list, char name[])
{
  static const struct {
    OptionScope scope;
    const char *prefix, *list;
  } kinds[]    = {{SCOPE_PROBE, "probe_", "-probes"},
                  {SCOPE_PATH, "path_", "-paths"},
                  {SCOPE_BODY, "", "-bodies"},
                  {SCOPE_PAIR, "", "-pairs"}};
  PetscBool is = PETSC_FALSE;

  PetscFunctionBeginUser;
  *list = NULL;
  if (left->owner || UnusedMayBeRead_Private(left)) PetscFunctionReturn(PETSC_SUCCESS);
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(kinds); k++) {
    const char *begin = left->name + 1 + strlen(kinds[k].prefix);

    if (strncasecmp(left->name + 1, kinds[k].prefix, strlen(kinds[k].prefix)) != 0) continue;
    for (const char *end = strchr(begin, '_'); end; end = strchr(end + 1, '_')) {
      PetscCall(PetscSNPrintf(name, OPTION_MAX, "%.*s", (int)(end - begin), begin));
      if (!OptionTableMatch(kinds[k].scope, name, left->name)) continue;
      PetscCall(UnusedIsName_Private(scene, kinds[k].prefix, name, &is));
      if (is) *list = kinds[k].list;
      PetscFunctionReturn(PETSC_SUCCESS);
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The sentence about one unused option; whether it could suggest another one. */
static PetscErrorCode UnusedExplain_Private(Scene scene, const Leftover *left, char sentence[OPTION_SENTENCE],
                                            PetscBool *suggested)
{
  const char *side       = left->entry ? strstr(left->entry->name, "_<side>") : NULL;
  const char *unmodelled = UnmodelledFind(left->name + 1 + (left->owner ? strlen(left->owner) + 1 : 0));
  const char *nameless   = UnusedFindNameless_Private(left), *list;
  char        near[OPTION_MAX], shown[OPTION_MAX], text[OPTION_MAX];

  PetscFunctionBeginUser;
  *suggested = PETSC_FALSE;
  PetscCall(OptionShow(left->name, left->value, shown));
  PetscCall(UnusedFindUnlisted_Private(scene, left, &list, text));
  if (side) {
    PetscCall(PetscSNPrintf(near, sizeof(near), "%.*s", (int)(side - left->entry->name), left->entry->name));
    PetscCall(OptionExpand(near, left->owner, NULL, text));
    PetscCall(PetscSNPrintf(sentence, OPTION_SENTENCE, "%s: this datum is not read, its side is not listed in %s",
                            shown, text));
  } else if (UnusedIsDocumented_Private(left)) {
    PetscCall(OptionExpand(left->entry->help, left->owner, NULL, text)); /* ends with a full stop */
    PetscCall(PetscSNPrintf(sentence, OPTION_SENTENCE, "%s: nothing in this scene needs this option (%.*s)", shown,
                            (int)strlen(text) - 1, text));
  } else if (unmodelled) {
    *suggested = PETSC_TRUE;
    PetscCall(PetscSNPrintf(sentence, OPTION_SENTENCE, "%s: %s", shown, unmodelled));
  } else if (nameless) {
    *suggested = PETSC_TRUE;
    PetscCall(PetscSNPrintf(sentence, OPTION_SENTENCE, "%s: the option needs a name before it: %s", shown, nameless));
  } else if (list) { // after all misspelt options: of these -bodies may be one
    PetscCall(PetscSNPrintf(sentence, OPTION_SENTENCE, "%s: %s does not list %s", shown, list, text));
  } else {
    sentence[0] = '\0';
    PetscCall(UnusedExplainRegion_Private(scene, left, shown, sentence));
    *suggested = (PetscBool) !!sentence[0];
    if (sentence[0]) PetscFunctionReturn(PETSC_SUCCESS);
    PetscCall(OptionSuggestionFind(scene, left->name, near));
    if (!UnusedIsOfSameSpace_Private(left->name, near)) near[0] = '\0';
    *suggested = (PetscBool) !!near[0];
    if (near[0])
      PetscCall(PetscSNPrintf(sentence, OPTION_SENTENCE, "%s: there is no such option; did you mean %s?", shown, near));
    else if (UnusedOptionsBeginsLikePETSc(left->name) || UnusedMayBeRead_Private(left))
      PetscCall(PetscSNPrintf(sentence, OPTION_SENTENCE,
                              "%s: nothing reads this option here: PETSc has none of this name, or the solvers of this "
                              "run do not ask for it; -help lists those that serve",
                              shown));
    else
      PetscCall(PetscSNPrintf(sentence, OPTION_SENTENCE,
                              "%s: there is no such option, and none like it; -bodies, -pairs and -probes list the "
                              "names that options may begin with, -help all options",
                              shown));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode UnusedOptionsCheckUnknown(Scene scene, PetscBool only_near)
{
  PetscInt  num;
  char    **names, **values, sentence[OPTION_SENTENCE], worst[OPTION_SENTENCE] = "";
  Leftover  left;
  PetscBool suggested = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsLeftGet(NULL, &num, &names, &values));
  for (PetscInt i = 0; i < num && !suggested; i++) { /* the first that has a neighbour, else the first */
    PetscCall(UnusedJudge_Private(scene, names[i], values[i], &left));
    if (UnusedIsDocumented_Private(&left) || UnusedMayBeRead_Private(&left)) continue;
    PetscCall(UnusedExplain_Private(scene, &left, sentence, &suggested));
    if (suggested || (!worst[0] && !only_near)) PetscCall(PetscStrncpy(worst, sentence, sizeof(worst)));
  }
  PetscCall(PetscOptionsLeftRestore(NULL, &num, &names, &values));
  PetscCall(UserErrorCheck(scene->comm, worst));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneCheckUnused(Scene scene, PetscBool before_solve)
{
  PetscInt    num;
  PetscMPIInt rank;
  char      **names, **values, sentence[OPTION_SENTENCE] = "";
  Leftover    left;
  PetscBool   suggested;

  PetscFunctionBeginUser;
  if (before_solve && scene->allow_unused)
    PetscFunctionReturn(PETSC_SUCCESS); /* one warning, when all is read, is enough */
  PetscCallMPI(MPI_Comm_rank(scene->comm, &rank));
  PetscCall(PetscOptionsLeftGet(NULL, &num, &names, &values));
  for (PetscInt i = 0; i < num && rank == 0 && !sentence[0]; i++) {
    PetscCall(UnusedJudge_Private(scene, names[i], values[i], &left));
    if (UnusedIsEnvironment_Private(left.name) || (before_solve && UnusedMayBeRead_Private(&left))) continue;
    PetscCall(UnusedExplain_Private(scene, &left, sentence, &suggested));
    if (!scene->allow_unused) continue;
    PetscCall(WarningAdd(&(Warning){.code = "unused_option"}, "%s", sentence));
    sentence[0] = '\0';
  }
  PetscCall(PetscOptionsLeftRestore(NULL, &num, &names, &values));
  PetscCall(UserErrorCheck(scene->comm, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}
