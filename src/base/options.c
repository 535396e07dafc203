/* options.c -- one argument list from the command line and the files that it names.

   The first rank reads and checks everything (reader.c), then two lists are broadcast: the arguments, and the files that
   were read (their folders are where meshes are looked for). */
#include "base/optionsreader.h"
#include "base/compat.h"
#include "base/options.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static TextList arguments; /* what PETSc gets */
static TextList files;     /* options files as found, in the order of reading; the first as typed */

/* What PETSc would read of itself: its files in the order of its own reader, then its variable. */
static void OptionsReadDefaults_Private(Reader *reader, int skip_files)
{
  const char *home = getenv("HOME"), *variable = getenv("PETSC_OPTIONS");
  char        paths[3][PETSC_MAX_PATH_LEN] = {"", ".petscrc", "petscrc"};

  if (home) snprintf(paths[0], sizeof(paths[0]), "%s/.petscrc", home);
  for (int i = 0; i < 3 && !skip_files; ++i) {
    char *text = FileCanRead(paths[i]) ? ReaderSlurp(reader, paths[i]) : NULL;

    if (text) ReaderReadText(reader, paths[i], text);
    free(text);
  }
  if (variable) {
    char *text = TextAllocate(NULL, strlen(variable) + 1);

    ReaderReadText(reader, "PETSC_OPTIONS", memcpy(text, variable, strlen(variable) + 1));
    free(text);
  }
}

/* The command line, whose own options wait until the files that it names are read. */
static void OptionsReadCommandLine_Private(Reader *reader, int argc, char **argv)
{
  Word    *words = TextAllocate(NULL, (size_t)argc * sizeof(*words));
  TextList own   = {0, NULL};

  for (int a = 1; a < argc; ++a) words[a - 1] = (Word){argv[a], 0};
  reader->target = &own;
  ReaderReadWords(reader, "command line", argc - 1, words);
  for (int i = 0; i < own.num; ++i) TextListAppend(&arguments, own.items[i]);
  TextListClear(&own);
  free(words);
}

void OptionsExpand(int argc, char **argv, int *argc_out, char ***argv_out, char sentence[], size_t len)
{
  Reader reader = {.sentence = sentence, .len = len, .target = &arguments, .arguments = &arguments, .files = &files};
  int    rank, skip_files = 0;

  sentence[0] = '\0';
  TextListClear(&arguments);
  TextListClear(&files);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (!rank) {
    for (int a = 1; a < argc; ++a) skip_files |= WordIsName(argv[a]) && WordIs(argv[a], "-skip_petscrc");
    TextListAppend(&arguments, argc ? argv[0] : "mortise");
    OptionsReadDefaults_Private(&reader, skip_files);
    OptionsReadCommandLine_Private(&reader, argc, argv);
    TextListAppend(&arguments, "-skip_petscrc"); // PETSc need not read again what is in the list
  }
  unsetenv("PETSC_OPTIONS");
  MPI_Bcast(sentence, (int)len, MPI_CHAR, 0, MPI_COMM_WORLD);
  TextListBroadcast(&arguments);
  TextListBroadcast(&files);
  *argc_out = arguments.num;
  *argv_out = arguments.items;
}

const char *OptionsFileName(void)
{
  return files.num ? files.items[0] : NULL;
}

static int OptionsCompareGiven_Private(const void *a, const void *b)
{
  return strcasecmp(((const OptionGiven *)a)->name, ((const OptionGiven *)b)->name);
}

/* Puts an option into a list, over one of the same name: PETSc does not tell capitals from small letters. */
static void OptionsPutGiven_Private(OptionGiven given[], PetscInt *num, OptionGiven option)
{
  PetscInt i = 0;

  while (i < *num && OptionsCompareGiven_Private(&given[i], &option)) ++i;
  given[i] = option;
  if (i == *num) ++*num;
}

PetscErrorCode OptionsGetGiven(PetscInt *num, OptionGiven **given)
{
  const int last = arguments.num - 1; // which is this module's own

  PetscFunctionBeginUser;
  *num = 0;
  PetscCall(PetscMalloc1(PetscMax(arguments.num, 1), given));
  for (int a = 1; a < last; ++a) {
    const char     *name  = arguments.items[a];
    const PetscBool value = a + 1 < last && !WordIsName(arguments.items[a + 1]) ? PETSC_TRUE : PETSC_FALSE;

    name += strspn(name, "-");
    if (value) ++a;
    OptionsPutGiven_Private(*given, num, (OptionGiven){name, value ? arguments.items[a] : ""});
  }
  qsort(*given, (size_t)*num, sizeof(**given), OptionsCompareGiven_Private);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionsFindFile(MPI_Comm comm, const char name[], char found[], size_t len, PetscBool *exists)
{
  int rank, readable = 0;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (!rank) readable = FileFind(&files, name, found, len);
  PetscCallMPI(MPI_Bcast(&readable, 1, MPI_INT, 0, comm));
  PetscCallMPI(MPI_Bcast(found, (int)len, MPI_CHAR, 0, comm));
  *exists = readable ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}
