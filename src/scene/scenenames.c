/* scenenames.c -- names of bodies, regions, pairs and probes: they become prefixes of options, so no two may
   make one option.

   PETSc finds an option by its whole name. One option has two meanings in three cases, which are refused. A
   name begins as a key of another one: body `a` with `-a_bc_traction_<side>`, and a body `a_bc_traction`. A
   name is a prefix of PETSc (`ksp`). PETSc reads `-a_young` where `-a_1_young` is not given. */
#include "scene/sceneparts.h"
#include <ctype.h>
#include <string.h>
#include <strings.h>

/* Longest name: together with a key it stays far below the length of an option. */
enum { NAME_MAX_LENGTH = 64 };

const char *SceneNamesGet(Scene scene, PetscInt i, OptionScope *scope)
{
  *scope = SCOPE_BODY;
  if (i < scene->num_bodies) return scene->bodies[i].name;
  i -= scene->num_bodies;
  *scope = SCOPE_PAIR;
  if (i < scene->num_pairs) return scene->pairs[i].name;
  i -= scene->num_pairs;
  *scope = SCOPE_PROBE;
  if (i < scene->num_probes) return scene->probes[i].name;
  i -= scene->num_probes;
  *scope = SCOPE_PATH;
  if (i < scene->num_paths) return scene->paths[i].name;
  i -= scene->num_paths;
  *scope = SCOPE_REGION;
  if (i < scene->num_regions) return scene->regions[i].prefix;
  return NULL;
}

/* Options of probes and paths begin with a word of their own, so that their names are free. */
static OptionScope NamesClass_Private(OptionScope scope)
{
  return scope == SCOPE_PROBE || scope == SCOPE_PATH ? scope : SCOPE_BODY;
}

/* Reads the next name of a list and checks its letters. */
static PetscErrorCode NamesNext_Private(const Option *option, const char **cursor, char **name)
{
  char      item[OPTION_MAX];
  PetscBool legal;

  PetscFunctionBeginUser;
  PetscCall(OptionNextItem(option, cursor, item));
  legal = (PetscBool)(isalpha((unsigned char)item[0]) && strlen(item) <= NAME_MAX_LENGTH);
  for (const char *c = item; *c; c++) legal = (PetscBool)(legal && (isalnum((unsigned char)*c) || *c == '_'));
  if (!legal) {
    PetscCall(OptionRaise(
        option, "'%.80s' is not a name; names begin with a letter and hold at most %d letters, digits and underscores",
        item, NAME_MAX_LENGTH));
  }
  PetscCall(PetscStrallocpy(item, name));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error if the i-th name is one of the earlier ones, or one of PETSc's. A probe may be called
   like a body. */
static PetscErrorCode NamesCheckOne_Private(Scene scene, PetscInt i)
{
  static const char *const kinds[] = {[SCOPE_BODY]   = "-bodies",
                                      [SCOPE_PAIR]   = "-pairs",
                                      [SCOPE_PROBE]  = "-probes",
                                      [SCOPE_PATH]   = "-paths",
                                      [SCOPE_REGION] = "-<body>_regions"};
  OptionScope              scope, other_scope;
  const char              *name = SceneNamesGet(scene, i, &scope), *other, *kind;
  char                     option[OPTION_MAX];

  PetscFunctionBeginUser;
  kind = kinds[scope];
  for (PetscInt j = 0; j < i; j++) {
    other = SceneNamesGet(scene, j, &other_scope);
    if (strcasecmp(name, other) != 0 || NamesClass_Private(scope) != NamesClass_Private(other_scope)) continue;
    PetscCall(UserErrorRaise(
        scene->comm, "%s: the name %s is given twice%s; every body and every pair needs a name of its own", kind, name,
        scope == SCOPE_REGION  ? " (to a region, of whose name that of its body is a part)"
        : scope != other_scope ? " (to a body and to a pair)"
                               : ""));
  }
  PetscCall(PetscSNPrintf(option, sizeof(option), "-%s_", name));
  if (NamesClass_Private(scope) == SCOPE_BODY && UnusedOptionsBeginsLikePETSc(option)) {
    PetscCall(UserErrorRaise(
        scene->comm, "%s: the name %s is reserved, options that begin with %s belong to PETSc; choose another name",
        kind, name, option));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error if an option of the i-th name can be read as one of the j-th, by which it then
   begins. */
static PetscErrorCode NamesCheckClash_Private(Scene scene, PetscInt i, PetscInt j)
{
  PetscInt           num;
  const OptionEntry *table = OptionTable(&num);
  OptionScope        scope, other_scope;
  const char        *name = SceneNamesGet(scene, i, &scope), *other = SceneNamesGet(scene, j, &other_scope);
  const size_t       length = strlen(other);
  char               option[OPTION_MAX];

  PetscFunctionBeginUser;
  if (strncasecmp(name, other, length) != 0 || name[length] != '_') PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt k = 0; k < num; k++) {
    if (OptionEntryScope(&table[k]) != scope || strchr(table[k].name, '*')) continue;
    PetscCall(OptionExpand(table[k].name, name, "side", option));
    if (!OptionTableMatch(other_scope, other, option)) continue;
    PetscCall(UserErrorRaise(
        scene->comm, "the names %s and %s cannot be used together: %s would be an option of both; rename one of them",
        other, name, option));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error if a name without one of its numbers is another name: what the first lacks, PETSc would
   take from the second. */
static PetscErrorCode NamesCheckNumbers_Private(Scene scene, PetscInt i)
{
  OptionScope scope, other_scope;
  const char *name = SceneNamesGet(scene, i, &scope), *other;
  char        shorter[NAME_MAX_LENGTH + 1];

  PetscFunctionBeginUser;
  for (const char *c = strchr(name, '_'); c; c = strchr(c + 1, '_')) {
    const size_t digits = strspn(c + 1, "0123456789");

    if (!digits || (c[1 + digits] != '_' && c[1 + digits] != '\0')) continue;
    PetscCall(PetscSNPrintf(shorter, sizeof(shorter), "%.*s%s", (int)(c - name), name, c + 1 + digits));
    for (PetscInt j = 0; (other = SceneNamesGet(scene, j, &other_scope)); j++) {
      if (scope != other_scope || strcasecmp(shorter, other) != 0) continue;
      PetscCall(UserErrorRaise(
          scene->comm,
          "the names %s and %s cannot be used together: PETSc takes options missing for %s from %s; rename one of them",
          other, name, name, other));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "steel" of body plate: its options begin with plate_steel. */
static PetscErrorCode RegionNext_Private(const Option *option, PetscInt body, const char **cursor, SceneRegion *region)
{
  char item[OPTION_MAX], prefix[OPTION_MAX];

  PetscFunctionBeginUser;
  PetscCall(OptionNextItem(option, cursor, item));
  PetscCall(OptionExpand("<body>_<side>", option->owner, item, prefix));
  region->body = body;
  PetscCall(PetscStrallocpy(item, &region->group));
  PetscCall(PetscStrallocpy(prefix, &region->prefix));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises a user error if a region of a list is one of those before it. */
static PetscErrorCode RegionCheckTwice_Private(const Option *option, const SceneRegion *first,
                                               const SceneRegion *region)
{
  PetscFunctionBeginUser;
  for (const SceneRegion *other = first; other < region; other++) {
    if (!strcasecmp(other->prefix, region->prefix))
      PetscCall(OptionRaise(option, "the region %s is named twice", region->group));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The regions of all bodies, whose names are known. */
static PetscErrorCode RegionsRead_Private(Scene scene)
{
  PetscInt num = 0;

  PetscFunctionBeginUser;
  for (PetscInt pass = 0; pass < 2; pass++) {
    for (PetscInt b = 0; b < scene->num_bodies; b++) {
      SceneBody  *body   = &scene->bodies[b];
      const char *cursor = NULL;
      Option      option;

      PetscCall(OptionFind(scene, "-<body>_regions", body->name, NULL, &option));
      body->first_region = scene->num_regions;
      body->num_regions  = OptionCountItems(&option);
      if (!pass) num += body->num_regions;
      for (PetscInt r = 0; pass && r < body->num_regions; r++) {
        SceneRegion *region = &scene->regions[scene->num_regions++];

        PetscCall(RegionNext_Private(&option, b, &cursor, region));
        PetscCall(RegionCheckTwice_Private(&option, &scene->regions[body->first_region], region));
      }
    }
    if (!pass) PetscCall(PetscCalloc1(num, &scene->regions));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* All checks of all names; quadratic in their number, but only in comparisons of short words. */
static PetscErrorCode NamesCheck_Private(Scene scene)
{
  OptionScope scope;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; SceneNamesGet(scene, i, &scope); i++) {
    PetscCall(NamesCheckOne_Private(scene, i));
    PetscCall(NamesCheckNumbers_Private(scene, i));
    for (PetscInt j = 0; SceneNamesGet(scene, j, &scope); j++) {
      if (i != j && NamesClass_Private(scope) == SCOPE_BODY) PetscCall(NamesCheckClash_Private(scene, i, j));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneNamesRead(Scene scene)
{
  Option      bodies, pairs, probes, paths;
  const char *cursor = NULL;
  PetscInt    num;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-bodies", NULL, NULL, &bodies));
  PetscCall(OptionFind(scene, "-pairs", NULL, NULL, &pairs));
  PetscCall(OptionFind(scene, "-probes", NULL, NULL, &probes));
  PetscCall(OptionFind(scene, "-paths", NULL, NULL, &paths));
  if (!bodies.set && !scene->allow_unused) PetscCall(UnusedOptionsCheckUnknown(scene, PETSC_TRUE));
  PetscCall(OptionRequire(&bodies, "a scene needs at least one body"));
  num = OptionCountItems(&bodies);
  PetscCall(PetscCalloc1(num, &scene->bodies));
  scene->num_bodies = num;
  for (PetscInt i = 0; i < num; i++) PetscCall(NamesNext_Private(&bodies, &cursor, &scene->bodies[i].name));
  PetscCall(RegionsRead_Private(scene));
  num = OptionCountItems(&pairs);
  PetscCall(PetscCalloc1(num, &scene->pairs));
  scene->num_pairs = num;
  for (PetscInt i = 0; i < num; i++) PetscCall(NamesNext_Private(&pairs, &cursor, &scene->pairs[i].name));
  num = OptionCountItems(&probes);
  PetscCall(PetscCalloc1(num, &scene->probes));
  scene->num_probes = num;
  for (PetscInt i = 0; i < num; i++) PetscCall(NamesNext_Private(&probes, &cursor, &scene->probes[i].name));
  num = OptionCountItems(&paths);
  PetscCall(PetscCalloc1(num, &scene->paths));
  scene->num_paths = num;
  for (PetscInt i = 0; i < num; i++) PetscCall(NamesNext_Private(&paths, &cursor, &scene->paths[i].name));
  PetscCall(NamesCheck_Private(scene));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneNamesFindBody(Scene scene, const Option *option, const char name[], PetscInt *body)
{
  const char **names, *near;
  char         list[OPTION_MAX];
  size_t       length = 0;

  PetscFunctionBeginUser;
  for (*body = 0; *body < scene->num_bodies; (*body)++) {
    if (!strcmp(scene->bodies[*body].name, name)) PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(PetscMalloc1(scene->num_bodies, &names));
  for (PetscInt i = 0; i < scene->num_bodies; i++) {
    names[i] = scene->bodies[i].name;
    if (length < sizeof(list))
      length += (size_t)snprintf(list + length, sizeof(list) - length, "%s%s", i ? ", " : "", names[i]);
  }
  near = UserErrorNearest(name, scene->num_bodies, names);
  PetscCall(PetscFree(names));
  PetscCall(OptionRaise(option, "there is no body '%s'; the bodies are %s%s%s%s", name, list,
                        near ? "; did you mean " : "", near ? near : "", near ? "?" : ""));
  PetscFunctionReturn(PETSC_SUCCESS);
}
