/* options.c -- one argument list from the command line and the files that it names.

   The first rank reads and checks everything, then two lists are broadcast: the arguments, and the files that were read
   (their folders are where meshes are looked for). Nothing here may call PETSc, which has not begun yet, except
   PetscOptionsValidKey(), which decides like PETSc's own parser whether a word is an option. */
#include <mortise/compat.h>
#include <mortise/fault.h>
#include <mortise/options.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum {
  MAX_DEPTH = 16,     /* of files within files: a chain this long is a mistake */
  MAX_SIZE  = 1 << 22 /* bytes of a file: text that a person would not write */
};

/* Texts in the order they came, ended by NULL, owned. */
typedef struct {
  int    num;
  char **items;
} TextList;

/* A word of a line or of the command line. */
typedef struct {
  char *text; // borrowed
  int   quoted;
} Word;

/* What reading needs to know: where the first mistake is told, the list that options go to, and the files that are open,
   outermost first. */
typedef struct {
  char     *sentence;
  size_t    len;
  TextList *target;
  int       depth;
  char     *open[MAX_DEPTH];
} Reader;

static TextList arguments; /* what PETSc gets */
static TextList files;     /* options files as found, in the order of reading; the first as typed */

/* --- small helpers ------------------------------------------------------------------------------------------------ */

static void *Allocate_Private(void *old, size_t size)
{
  void *new = realloc(old, size);

  if (!new) {
    fprintf(stderr, "mortise: out of memory while reading options\n");
    MPI_Abort(MPI_COMM_WORLD, MORTISE_FAILED);
  }
  return new;
}

static void ListAppend_Private(TextList *list, const char text[])
{
  const size_t size = strlen(text) + 1;

  list->items              = Allocate_Private(list->items, (size_t)(list->num + 2) * sizeof(*list->items));
  list->items[list->num++] = memcpy(Allocate_Private(NULL, size), text, size);
  list->items[list->num]   = NULL;
}

static void ListClear_Private(TextList *list)
{
  for (int i = 0; i < list->num; ++i) free(list->items[i]);
  free(list->items);
  *list = (TextList){0, NULL};
}

/* The first rank's list, everywhere. Collective on MPI_COMM_WORLD. */
static void ListBroadcast_Private(TextList *list)
{
  int rank, num = list->num;

  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Bcast(&num, 1, MPI_INT, 0, MPI_COMM_WORLD);
  for (int i = 0; i < num; ++i) {
    int   size = rank ? 0 : (int)strlen(list->items[i]) + 1;
    char *text;

    MPI_Bcast(&size, 1, MPI_INT, 0, MPI_COMM_WORLD);
    text = rank ? Allocate_Private(NULL, (size_t)size) : list->items[i];
    MPI_Bcast(text, size, MPI_CHAR, 0, MPI_COMM_WORLD);
    if (!rank) continue;
    ListAppend_Private(list, text);
    free(text);
  }
}

/* Tells the first mistake; later ones are its consequences. */
static void Complain_Private(Reader *reader, const char format[], ...)
{
  va_list values;

  if (reader->sentence[0]) return;
  va_start(values, format);
  vsnprintf(reader->sentence, reader->len, format, values);
  va_end(values);
}

static int IsName_Private(const char word[])
{
  PetscBool valid = PETSC_FALSE;

  (void)PetscOptionsValidKey(word, &valid);
  return valid;
}

static int Is_Private(const char word[], const char name[])
{
  return !strcasecmp(word[1] == '-' ? word + 1 : word, name); // PETSc ignores case, and takes --name for -name
}

/* --- files -------------------------------------------------------------------------------------------------------- */

static int CanRead_Private(const char path[])
{
  struct stat status;
  FILE       *file;

  if (stat(path, &status) || S_ISDIR(status.st_mode)) return 0;
  file = S_ISREG(status.st_mode) ? fopen(path, "r") : NULL; // opening a pipe would take its content away
  if (file) fclose(file);
  return file || !S_ISREG(status.st_mode);
}

/* found = name, or name within the folder of an options file; whether it can be read there. */
static int Find_Private(const char name[], char found[], size_t len)
{
  snprintf(found, len, "%s", name);
  if (CanRead_Private(name)) return 1;
  for (int i = 0; name[0] != '/' && i < files.num; ++i) {
    const char *slash = strrchr(files.items[i], '/');

    if (!slash) continue; // in the working directory
    snprintf(found, len, "%.*s/%s", (int)(slash - files.items[i]), files.items[i], name);
    if (CanRead_Private(found)) return 1;
  }
  snprintf(found, len, "%s", name);
  return 0;
}

/* The file's text, to be freed, or NULL after a complaint. */
static char *Slurp_Private(Reader *reader, const char path[])
{
  char  *text = Allocate_Private(NULL, MAX_SIZE + 1);
  FILE  *file = fopen(path, "r");
  size_t size;

  if (!file) {
    Complain_Private(reader, "-options_file %s: the file cannot be read: %s", path, strerror(errno));
    free(text);
    return NULL;
  }
  size       = fread(text, 1, MAX_SIZE, file);
  text[size] = '\0';
  if (ferror(file))
    Complain_Private(reader, "-options_file %s: the file cannot be read: %s", path, strerror(errno));
  else if (strlen(text) < size)
    Complain_Private(reader, "-options_file %s: this is not a text file, it has a zero byte", path);
  else if (size == MAX_SIZE)
    Complain_Private(reader, "-options_file %s: longer than %d bytes, hardly an options file", path, MAX_SIZE);
  fclose(file);
  if (!reader->sentence[0]) return text;
  free(text);
  return NULL;
}

/* --- words -------------------------------------------------------------------------------------------------------- */

static void ReadFile_Private(Reader *reader, const char where[], const char name[]);

/* Whether a word that PETSc takes for an option's name is something else: a formula, or a text with spaces. */
static int IsFormula_Private(const Word *word)
{
  return IsName_Private(word->text) && (word->quoted || strpbrk(word->text, "()*/^, "));
}

/* Appends the option that stands at words[0], with its value if it has one. Returns the number of words taken. */
static int ReadOption_Private(Reader *reader, const char where[], int num_words, const Word words[])
{
  const char *name = words[0].text, *next = num_words > 1 ? words[1].text : NULL;
  const char *value   = next && !IsName_Private(next) ? next : NULL;
  const int   is_file = Is_Private(name, "-options_file"), is_yaml = Is_Private(name, "-options_file_yaml");

  if (next && IsFormula_Private(&words[1]))
    Complain_Private(reader,
                     "%s: %s %s: PETSc takes a value that begins with a minus and a letter for an option; write 0%s",
                     where, name, next, next);
  else if (IsFormula_Private(&words[0]))
    Complain_Private(reader, "%s: '%s' is not an option's name", where, name);
  else if (strchr(name, '='))
    Complain_Private(reader, "%s: %s: a value follows after a space, not after '='", where, name);
  else if ((is_file || is_yaml) && !value)
    Complain_Private(reader, "%s: %s needs the name of a file", where, name);
  else if (is_yaml && !CanRead_Private(value))
    Complain_Private(reader, "%s: %s %s: there is no such file", where, name, value);
  else if (is_file)
    ReadFile_Private(reader, where, value);
  else {
    ListAppend_Private(reader->target, name);
    if (value) ListAppend_Private(reader->target, value);
  }
  return value ? 2 : 1;
}

/* Complains about a word that is neither an option nor a value. [in] previous - the option before it, or NULL */
static void ComplainOfWord_Private(Reader *reader, const char where[], const char word[], const char previous[])
{
  if (CanRead_Private(word))
    Complain_Private(reader, "%s: '%s' is a file, but not an option; an options file is named by -options_file %s",
                     where, word, word);
  else if (previous)
    Complain_Private(reader, "%s: '%s' is one word too many after %s; a value with spaces stands in double quotes",
                     where, word, previous);
  else
    Complain_Private(
        reader,
        "%s: '%s' is not an option, which begins with a minus and a letter; an options file is named by -options_file",
        where, word);
}

/* Reads the words of one line. [in] where - names the line in a complaint */
static void ReadWords_Private(Reader *reader, const char where[], int num_words, const Word words[])
{
  const char *previous = NULL;

  for (int w = 0; w < num_words && !reader->sentence[0];) {
    if (IsName_Private(words[w].text)) {
      previous = words[w].text;
      w += ReadOption_Private(reader, where, num_words - w, words + w);
    } else
      ComplainOfWord_Private(reader, where, words[w].text, previous);
  }
}

/* Cuts a line into words in place, and its comment off. [out] words - array of shape [strlen(line)] at least */
static int SplitLine_Private(Reader *reader, const char where[], char line[], Word words[])
{
  static const char blanks[]  = " \t\r\f\v";
  int               num_words = 0;

  for (line += strspn(line, blanks); *line && *line != '#'; line += strspn(line, blanks)) {
    const int   quoted = *line == '"';
    char *const begin = line + quoted, *end = begin + strcspn(begin, quoted ? "\"" : " \t\r\f\v#");
    const char  last = *end, behind = last ? end[1] : '\0';

    words[num_words++] = (Word){begin, quoted};
    if (quoted && !last) Complain_Private(reader, "%s: the quote before '%s' is not closed in this line", where, begin);
    if (quoted && behind && !strchr(blanks, behind) && behind != '#')
      Complain_Private(reader, "%s: a space is missing before '%s'", where, end + 1);
    *end = '\0';
    if (!last || last == '#') break;
    line = end + 1;
  }
  return num_words;
}

/* Reads the lines of a text in place. [in] source - names the text in a complaint */
static void ReadText_Private(Reader *reader, const char source[], char text[])
{
  char *next;
  int   number = 0;

  if (!strncmp(text, "\xEF\xBB\xBF", 3)) text += 3; // the mark that some editors put before UTF-8
  for (char *line = text; line && !reader->sentence[0]; line = next) {
    Word *words;
    char  where[PETSC_MAX_PATH_LEN + 32];
    int   num_words;

    next = strchr(line, '\n');
    if (next) *next++ = '\0';
    snprintf(where, sizeof(where), "%s, line %d", source, ++number);
    words     = Allocate_Private(NULL, (strlen(line) + 1) * sizeof(*words));
    num_words = SplitLine_Private(reader, where, line, words);
    ReadWords_Private(reader, where, num_words, words);
    free(words);
  }
}

/* Reads an options file that is named at `where`; its options go before those of the command line. */
static void ReadFile_Private(Reader *reader, const char where[], const char name[])
{
  TextList *const target = reader->target;
  char            found[PETSC_MAX_PATH_LEN], *text, *path = NULL;
  struct stat     status;

  if (!Find_Private(name, found, sizeof(found)))
    Complain_Private(reader, "%s: -options_file %s: %s", where, name,
                     stat(name, &status) ? "there is no such file" : "this is not a file that can be read");
  else if (reader->depth == MAX_DEPTH)
    Complain_Private(reader, "%s: -options_file %s: more than %d files within files", where, name, MAX_DEPTH);
  else
    path = realpath(found, NULL);
  for (int i = 0; path && i < reader->depth; ++i)
    if (!strcmp(path, reader->open[i]))
      Complain_Private(reader, "%s: -options_file %s: this file is being read already, it names itself", where, name);
  text = path && !reader->sentence[0] ? Slurp_Private(reader, found) : NULL;
  if (text) {
    reader->open[reader->depth++] = path;
    reader->target                = &arguments;
    ListAppend_Private(&files, found);
    ReadText_Private(reader, found, text);
    reader->target = target;
    --reader->depth;
  }
  free(text);
  free(path);
}

/* --- the argument list -------------------------------------------------------------------------------------------- */

/* What PETSc would read of itself: its files in the order of its own reader, then its variable. */
static void ReadDefaults_Private(Reader *reader, int skip_files)
{
  const char *home = getenv("HOME"), *variable = getenv("PETSC_OPTIONS");
  char        paths[3][PETSC_MAX_PATH_LEN] = {"", ".petscrc", "petscrc"};

  if (home) snprintf(paths[0], sizeof(paths[0]), "%s/.petscrc", home);
  for (int i = 0; i < 3 && !skip_files; ++i) {
    char *text = CanRead_Private(paths[i]) ? Slurp_Private(reader, paths[i]) : NULL;

    if (text) ReadText_Private(reader, paths[i], text);
    free(text);
  }
  if (variable) {
    char *text = Allocate_Private(NULL, strlen(variable) + 1);

    ReadText_Private(reader, "PETSC_OPTIONS", memcpy(text, variable, strlen(variable) + 1));
    free(text);
  }
}

/* The command line, whose own options wait until the files that it names are read. */
static void ReadCommandLine_Private(Reader *reader, int argc, char **argv)
{
  Word    *words = Allocate_Private(NULL, (size_t)argc * sizeof(*words));
  TextList own   = {0, NULL};

  for (int a = 1; a < argc; ++a) words[a - 1] = (Word){argv[a], 0};
  reader->target = &own;
  ReadWords_Private(reader, "command line", argc - 1, words);
  for (int i = 0; i < own.num; ++i) ListAppend_Private(&arguments, own.items[i]);
  ListClear_Private(&own);
  free(words);
}

void OptionsExpand(int argc, char **argv, int *argc_out, char ***argv_out, char sentence[], size_t len)
{
  Reader reader = {.sentence = sentence, .len = len, .target = &arguments};
  int    rank, skip_files = 0;

  sentence[0] = '\0';
  ListClear_Private(&arguments);
  ListClear_Private(&files);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (!rank) {
    for (int a = 1; a < argc; ++a) skip_files |= IsName_Private(argv[a]) && Is_Private(argv[a], "-skip_petscrc");
    ListAppend_Private(&arguments, argc ? argv[0] : "mortise");
    ReadDefaults_Private(&reader, skip_files);
    ReadCommandLine_Private(&reader, argc, argv);
    ListAppend_Private(&arguments, "-skip_petscrc"); // PETSc need not read again what is in the list
  }
  unsetenv("PETSC_OPTIONS");
  MPI_Bcast(sentence, (int)len, MPI_CHAR, 0, MPI_COMM_WORLD);
  ListBroadcast_Private(&arguments);
  ListBroadcast_Private(&files);
  *argc_out = arguments.num;
  *argv_out = arguments.items;
}

const char *OptionsFileName(void)
{
  return files.num ? files.items[0] : NULL;
}

PetscErrorCode OptionsFindFile(MPI_Comm comm, const char name[], char found[], size_t len, PetscBool *exists)
{
  int rank, readable = 0;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  if (!rank) readable = Find_Private(name, found, len);
  PetscCallMPI(MPI_Bcast(&readable, 1, MPI_INT, 0, comm));
  PetscCallMPI(MPI_Bcast(found, (int)len, MPI_CHAR, 0, comm));
  *exists = readable ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}
