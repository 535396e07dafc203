/* optionsuggestion.c -- the documented option that a misspelt one was meant for: the table written out for
   the names of the scene. */
#include "scene/sceneparts.h"
#include <string.h>

/* Adds an option to the candidates, or only counts it where there is no room yet. */
static PetscErrorCode SuggestAdd_Private(const char pattern[], const char owner[], const char side[], PetscInt *num,
                                         char **names)
{
  char option[OPTION_MAX];

  PetscFunctionBeginUser;
  if (names) {
    PetscCall(OptionExpand(pattern, owner, side, option));
    PetscCall(PetscStrallocpy(option, &names[*num]));
  }
  ++*num;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds what one row makes with one owner. A side can be anything: what stands behind any underscore of the
   misspelt option is tried for it. */
static PetscErrorCode SuggestAddSides_Private(const char misspelt[], const char pattern[], const char owner[],
                                              PetscInt *num, char **names)
{
  PetscFunctionBeginUser;
  if (!strstr(pattern, "<side>"))
    PetscCall(SuggestAdd_Private(pattern, owner, NULL, num, names));
  else {
    for (const char *c = strchr(misspelt, '_'); c; c = strchr(c + 1, '_')) {
      PetscCall(SuggestAdd_Private(pattern, owner, c + 1, num, names));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Lists, or counts, all candidates. */
static PetscErrorCode SuggestList_Private(Scene scene, const char misspelt[], PetscInt *num, char **names)
{
  PetscInt           num_entries;
  const OptionEntry *table = OptionTable(&num_entries);
  const char        *owner;
  OptionScope        scope;

  PetscFunctionBeginUser;
  *num = 0;
  for (const OptionEntry *entry = table; entry < table + num_entries; entry++) {
    if (strchr(entry->name, '*')) continue;
    if (OptionEntryScope(entry) == SCOPE_PROGRAM) PetscCall(SuggestAdd_Private(entry->name, NULL, NULL, num, names));
    for (PetscInt i = 0; (owner = SceneNamesGet(scene, i, &scope)); i++) {
      if (scope == OptionEntryScope(entry))
        PetscCall(SuggestAddSides_Private(misspelt, entry->name, owner, num, names));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionSuggestionFind(Scene scene, const char misspelt[], char near[OPTION_MAX])
{
  PetscInt    num;
  char      **names;
  const char *nearest;

  PetscFunctionBeginUser;
  PetscCall(SuggestList_Private(scene, misspelt, &num, NULL));
  PetscCall(PetscMalloc1(num, &names));
  PetscCall(SuggestList_Private(scene, misspelt, &num, names));
  nearest = UserErrorNearest(misspelt, num, (const char *const *)names);
  PetscCall(PetscStrncpy(near, nearest ? nearest : "", OPTION_MAX));
  for (PetscInt i = 0; i < num; i++) PetscCall(PetscFree(names[i]));
  PetscCall(PetscFree(names));
  PetscFunctionReturn(PETSC_SUCCESS);
}
