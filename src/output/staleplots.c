/* staleplots.c -- removal of plots of an earlier run.

   Programs write their name near the beginning of a file: a file of the same name by another program is
   kept. */
#include <string.h>
#include "base/compat.h"
#include "output/staleplots.h"

enum { BEGINNING = 4096 }; /* bytes, more than precede the name */

/* Whether the word stands in the first bytes of a file, which may hold any bytes. */
static PetscBool StalePlotsFileContains_Private(const char path[], const char word[])
{
  char         bytes[BEGINNING];
  const size_t len  = strlen(word);
  FILE        *file = fopen(path, "rb");
  size_t       num;
  PetscBool    found = PETSC_FALSE;

  if (!file) return PETSC_FALSE;
  num = fread(bytes, 1, sizeof(bytes), file);
  fclose(file);
  for (size_t i = 0; i + len <= num && !found; i++) found = memcmp(&bytes[i], word, len) ? PETSC_FALSE : PETSC_TRUE;
  return found;
}

PetscErrorCode StalePlotsRemove(FileSet *files, const char output[])
{
  static const char *const drawn[][2] = {{".png", "mortise-plot"},
                                         {"_study.svg", "mortise-plot"},
                                         {"_paths.png", "mortise-plot"},
                                         {"_steps.png", "mortise-plot"},
                                         {".html", "mortise-report"}};
  char                     path[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(drawn); i++) {
    PetscCall(PetscSNPrintf(path, sizeof(path), "%s%s", output, drawn[i][0]));
    if (StalePlotsFileContains_Private(path, drawn[i][1])) PetscCall(FileSetRemove(files, path));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
