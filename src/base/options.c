/* options.c -- one argument list from the command line and the files that it names.

   The first rank reads and checks everything (optionsreader.c). Then two lists are broadcast: the arguments,
   and the files that were read. Meshes are looked for in the folders of these files. */
#include "base/optionsreader.h"
#include "base/compat.h"
#include "base/options.h"
#include "base/usererror.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static TextList arguments; /* the list for PETSc */
static TextList listed;    /* words for OptionsGetGiven() that are not in the arguments */
static TextList files;     /* options files as found, in the order of reading; the first as typed */
static TextList repeated;  /* sentences on options that one file gives two values */

/* Reads PETSc's default files in the order of its own reader, then its environment variable. */
static void OptionsReadDefaults_Private(Reader *reader, int skip_files)
{
  const char *home = getenv("HOME"), *variable = getenv("PETSC_OPTIONS");
  char        paths[3][PETSC_MAX_PATH_LEN] = {"", ".petscrc", "petscrc"};

  if (home) snprintf(paths[0], sizeof(paths[0]), "%s/.petscrc", home);
  for (int i = 0; i < 3 && !skip_files; i++) {
    char *text = OptionsReaderCanRead(paths[i]) ? OptionsReaderSlurp(reader, paths[i]) : NULL;

    if (text) OptionsReaderReadText(reader, paths[i], text);
    free(text);
  }
  if (variable) {
    char *text = TextListAllocate(NULL, strlen(variable) + 1);

    OptionsReaderReadText(reader, "PETSC_OPTIONS", memcpy(text, variable, strlen(variable) + 1));
    free(text);
  }
}

/* Reads the command line: first the files that it names, then its own options. */
static void OptionsReadCommandLine_Private(Reader *reader, int argc, char **argv)
{
  Word    *words = TextListAllocate(NULL, (size_t)argc * sizeof(*words));
  TextList own   = {0, NULL};

  for (int a = 1; a < argc; a++) words[a - 1] = (Word){argv[a], 0};
  reader->target = &own;
  OptionsReaderReadWords(reader, "command line", argc - 1, words);
  for (int i = 0; i < own.num; i++) TextListAppend(&arguments, own.items[i]);
  TextListClear(&own);
  free(words);
}

/* Whether PETSc makes options of this argument and the next that are not in the list. */
static int OptionsIsExpanded_Private(const char word[])
{
  static const char *const names[] = {"-options_file_yaml", "-options_string_yaml", "-prefix_push"};

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(names) && OptionsReaderIsName(word); i++)
    if (OptionsReaderIsWord(word, names[i])) return 1;
  return 0;
}

/* Checks that prefixes end: else the prefix would precede options of the program, too. */
static void OptionsCheckPrefixes_Private(char sentence[], size_t len)
{
  const char *open  = NULL;
  int         depth = 0;

  for (int a = 1; a < arguments.num && !sentence[0]; a++) {
    if (!OptionsReaderIsName(arguments.items[a])) continue;
    if (OptionsReaderIsWord(arguments.items[a], "-prefix_push")) {
      open = a + 1 < arguments.num && !OptionsReaderIsName(arguments.items[a + 1]) ? arguments.items[a + 1] : NULL;
      depth++;
      if (!open) snprintf(sentence, len, "-prefix_push needs a prefix, such as upper_");
    } else if (OptionsReaderIsWord(arguments.items[a], "-prefix_pop") && depth-- == 0) {
      snprintf(sentence, len, "-prefix_pop: no -prefix_push stands before it");
    }
  }
  if (!sentence[0] && depth > 0) snprintf(sentence, len, "-prefix_push %s: no -prefix_pop follows", open);
}

void OptionsExpand(int argc, char **argv, int *argc_out, char ***argv_out, char sentence[], size_t len)
{
  Reader reader = {.sentence  = sentence,
                   .len       = len,
                   .target    = &arguments,
                   .arguments = &arguments,
                   .files     = &files,
                   .repeated  = &repeated};
  int    rank, skip_files = 0;

  sentence[0] = '\0';
  TextListClear(&arguments);
  TextListClear(&files);
  TextListClear(&repeated);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (!rank) {
    for (int a = 1; a < argc; a++)
      skip_files |= OptionsReaderIsName(argv[a]) && OptionsReaderIsWord(argv[a], "-skip_petscrc");
    TextListAppend(&arguments, argc ? argv[0] : "mortise");
    OptionsReadDefaults_Private(&reader, skip_files);
    OptionsReadCommandLine_Private(&reader, argc, argv);
    OptionsCheckPrefixes_Private(sentence, len);
    TextListAppend(&arguments, "-skip_petscrc"); // its contents are in the list already
  }
  unsetenv("PETSC_OPTIONS");
  (void)MPI_Bcast(sentence, (int)len, MPI_CHAR, 0, MPI_COMM_WORLD);
  TextListBroadcast(&arguments);
  TextListBroadcast(&files);
  TextListBroadcast(&repeated);
  *argc_out = arguments.num;
  *argv_out = arguments.items;
}

PetscErrorCode OptionsJoin(void)
{
  int    num;
  char **given;

  PetscFunctionBeginUser;
  PetscCall(PetscGetArgs(&num, &given));
  for (int a = 1; a + 1 < num; a++)
    if (OptionsReaderIsName(given[a]) && OptionsReaderIsWord(given[a], "-options_file"))
      TextListAppend(&files, given[a + 1]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The words of the present database: -name value -name ... [out] words - to be cleared by the caller */
static PetscErrorCode OptionsReadDatabase_Private(TextList *words)
{
  char *all, *end;

  PetscFunctionBeginUser;
  *words = (TextList){0, NULL};
  PetscCall(PetscOptionsGetAll(NULL, &all));
  for (char *name = strchr(all, '-'); name; name = end) {
    char *value = name + strcspn(name, " ");

    end = strstr(name, " -");
    while (end && !OptionsReaderIsName(end + 1)) end = strstr(end + 1, " -");
    if (end) *end++ = '\0';
    if (*value) *value++ = '\0';
    for (size_t n = strlen(value); n && value[n - 1] == ' '; n--) value[n - 1] = '\0';
    TextListAppend(words, name);
    TextListAppend(words, value);
  }
  PetscCall(PetscFree(all));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a list of names and values has a name among its first num items. */
static int TextListHasName_Private(const TextList *words, int num, const char name[])
{
  for (int i = 0; i < num; i += 2)
    if (!strcasecmp(words->items[i], name)) return 1;
  return 0;
}

PetscErrorCode OptionsInsertFile(const char name[])
{
  char       sentence[USER_ERROR_LENGTH] = "", option[] = "-options_file";
  char      *copy    = TextListAllocate(NULL, strlen(name) + 1);
  const Word words[] = {{option, 0}, {strcpy(copy, name), 0}};
  TextList   read = {0, NULL}, found = {0, NULL}, present;
  Reader reader = {.sentence = sentence, .len = sizeof(sentence), .target = &read, .arguments = &read, .files = &found};
  int    rank, num;
  PetscErrorCode error;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(MPI_COMM_WORLD, &rank));
  for (int i = 0; i < files.num; i++) TextListAppend(&found, files.items[i]);
  if (!rank) OptionsReaderReadWords(&reader, "options of the program", 2, words);
  free(copy);
  if (!rank) {
    TextListClear(&files);
    files = found;
  } else {
    TextListClear(&found);
    TextListClear(&files);
  }
  TextListBroadcast(&files);
  TextListBroadcast(&read);
  error = UserErrorCheck(MPI_COMM_WORLD, sentence);
  if (error) TextListClear(&read);
  PetscCall(error);
  PetscCall(OptionsReadDatabase_Private(&present));
  num = present.num;
  for (int i = 0; i < read.num; i++) {
    const int value = i + 1 < read.num && !OptionsReaderIsName(read.items[i + 1]);

    if (!TextListHasName_Private(&present, num, read.items[i]))
      PetscCall(PetscOptionsSetValue(NULL, read.items[i], value ? read.items[i + 1] : NULL));
    i += value;
  }
  TextListClear(&present);
  TextListClear(&read);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionsCopyPrefixed(const char prefix[], PetscOptions target)
{
  const size_t length = strlen(prefix);
  TextList     words;

  PetscFunctionBeginUser;
  PetscCall(OptionsReadDatabase_Private(&words));
  for (int i = 0; i < words.num; i += 2) {
    const char *value = NULL;
    char        name[PETSC_MAX_OPTION_NAME];
    PetscBool   set;

    if (strncasecmp(words.items[i] + 1, prefix, length)) continue;
    PetscCall(PetscOptionsFindPair(NULL, NULL, words.items[i], &value, &set)); // a word in a text is no option
    PetscCall(PetscSNPrintf(name, sizeof(name), "-%s", words.items[i] + 1 + length));
    if (set) PetscCall(PetscOptionsSetValue(target, name, value));
  }
  TextListClear(&words);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionsListDatabase(void)
{
  TextList words;

  PetscFunctionBeginUser;
  PetscCall(OptionsReadDatabase_Private(&words));
  TextListClear(&listed);
  TextListAppend(&listed, "mortise");
  for (int i = 0; i < words.num; i++)
    if (!(i % 2) || words.items[i][0]) TextListAppend(&listed, words.items[i]);
  TextListAppend(&listed, "-skip_petscrc"); // the last is this module's own
  TextListClear(&words);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionsListExpanded(void)
{
  PetscBool expanded = PETSC_FALSE;

  PetscFunctionBeginUser;
  for (int a = 1; a < arguments.num && !expanded; a++)
    if (OptionsIsExpanded_Private(arguments.items[a])) expanded = PETSC_TRUE;
  if (expanded) PetscCall(OptionsListDatabase());
  PetscFunctionReturn(PETSC_SUCCESS);
}

void OptionsClear(void)
{
  TextListClear(&arguments);
  TextListClear(&listed);
  TextListClear(&files);
  TextListClear(&repeated);
}

int OptionsGetRepeated(const char *const **sentences)
{
  *sentences = (const char *const *)repeated.items;
  return repeated.num;
}

const char *OptionsFileName(void)
{
  return files.num ? files.items[0] : NULL;
}

static int OptionsCompareGiven_Private(const void *a, const void *b)
{
  return strcasecmp(((const OptionGiven *)a)->name, ((const OptionGiven *)b)->name);
}

/* Puts an option into a list, in place of one of the same name; PETSc ignores case. */
static void OptionsPutGiven_Private(OptionGiven given[], PetscInt *num, OptionGiven option)
{
  PetscInt i = 0;

  while (i < *num && OptionsCompareGiven_Private(&given[i], &option)) i++;
  given[i] = option;
  if (i == *num) ++*num;
}

PetscErrorCode OptionsGetGiven(PetscInt *num, OptionGiven **given)
{
  const TextList *told = listed.num ? &listed : &arguments;
  const int       last = told->num - 1; // which is this module's own

  PetscFunctionBeginUser;
  *num = 0;
  PetscCall(PetscMalloc1(PetscMax(told->num, 1), given));
  for (int a = 1; a < last; a++) {
    const char     *name  = told->items[a];
    const PetscBool value = a + 1 < last && !OptionsReaderIsName(told->items[a + 1]) ? PETSC_TRUE : PETSC_FALSE;

    name += strspn(name, "-");
    if (value) a++;
    OptionsPutGiven_Private(*given, num, (OptionGiven){name, value ? told->items[a] : ""});
  }
  qsort(*given, (size_t)*num, sizeof(**given), OptionsCompareGiven_Private);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionsFindFile(MPI_Comm comm, const char name[], char found[], size_t len, PetscBool *exists)
{
  int rank, readable = 0;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (!rank) readable = OptionsReaderFindFile(&files, name, found, len);
  PetscCallMPI(MPI_Bcast(&readable, 1, MPI_INT, 0, comm));
  PetscCallMPI(MPI_Bcast(found, (int)len, MPI_CHAR, 0, comm));
  *exists = readable ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}
