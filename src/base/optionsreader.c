/* optionsreader.c -- see the header. */
#include "base/optionsreader.h"
#include "base/compat.h"
#include <petscsys.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum {
  MAX_SIZE  = 1 << 22, /* bytes of a file: no longer text written by hand */
  MAX_NOTED = 1 << 12  /* options of a file that are compared with each other */
};

/* Tells the first mistake; later ones are its consequences. */
static void OptionsReaderRefuse_Private(Reader *reader, const char format[], ...)
{
  va_list values;

  if (reader->sentence[0]) return;
  va_start(values, format);
  vsnprintf(reader->sentence, reader->len, format, values);
  va_end(values);
}

int OptionsReaderIsName(const char word[])
{
  PetscBool valid = PETSC_FALSE;

  (void)PetscOptionsValidKey(word, &valid);
  return valid;
}

int OptionsReaderIsWord(const char word[], const char name[])
{
  return !strcasecmp(word[1] == '-' ? word + 1 : word, name); // PETSc ignores case, and takes --name for -name
}

/* --- files ---------------------------------------------------------------------------------------------- */

int OptionsReaderCanRead(const char path[])
{
  struct stat status;
  FILE       *file;

  if (stat(path, &status) || S_ISDIR(status.st_mode)) return 0;
  file = S_ISREG(status.st_mode) ? fopen(path, "r") : NULL; // opening a pipe would consume its content
  if (file) fclose(file);
  return file || !S_ISREG(status.st_mode);
}

int OptionsReaderFindFile(const TextList *files, const char name[], char found[], size_t len)
{
  snprintf(found, len, "%s", name);
  if (OptionsReaderCanRead(name)) return 1;
  for (int i = 0; name[0] != '/' && i < files->num; i++) {
    const char *slash = strrchr(files->items[i], '/');

    if (!slash) continue; // in the working directory
    snprintf(found, len, "%.*s/%s", (int)(slash - files->items[i]), files->items[i], name);
    if (OptionsReaderCanRead(found)) return 1;
  }
  snprintf(found, len, "%s", name);
  return 0;
}

char *OptionsReaderSlurp(Reader *reader, const char path[])
{
  char  *text = TextListAllocate(NULL, MAX_SIZE + 1);
  FILE  *file = fopen(path, "r");
  size_t size;

  if (!file) {
    OptionsReaderRefuse_Private(reader, "-options_file %s: the file cannot be read: %s", path, strerror(errno));
    free(text);
    return NULL;
  }
  size       = fread(text, 1, MAX_SIZE, file);
  text[size] = '\0';
  if (ferror(file))
    OptionsReaderRefuse_Private(reader, "-options_file %s: the file cannot be read: %s", path, strerror(errno));
  else if (strlen(text) < size)
    OptionsReaderRefuse_Private(reader, "-options_file %s: this is not a text file, it has a zero byte", path);
  else if (size == MAX_SIZE)
    OptionsReaderRefuse_Private(reader, "-options_file %s: the file is longer than %d bytes; is it an options file?",
                                path, MAX_SIZE);
  fclose(file);
  if (!reader->sentence[0]) return text;
  free(text);
  return NULL;
}

/* --- words ---------------------------------------------------------------------------------------------- */

static void OptionsReaderReadFile_Private(Reader *reader, const char where[], const char name[]);

/* Whether a word that PETSc takes for an option's name is something else: a formula, or a text with
   spaces. */
static int OptionsReaderIsFormula_Private(const Word *word)
{
  return OptionsReaderIsName(word->text) && (word->quoted || strpbrk(word->text, "()*/^, "));
}

/* Appends a file that PETSc reads by itself; its folder is one of those where meshes are looked for. */
static void OptionsReaderAddYAML_Private(Reader *reader, const char where[], const char name[], const char value[])
{
  char found[PETSC_MAX_PATH_LEN];

  if (!OptionsReaderFindFile(reader->files, value, found, sizeof(found))) {
    OptionsReaderRefuse_Private(reader, "%s: %s %s: there is no such file", where, name, value);
    return;
  }
  TextListAppend(reader->target, name);
  TextListAppend(reader->target, found);
  TextListAppend(reader->files, found);
}

/* Reads the text of -options_string, as the lines of a file, in its place. [in] text - or NULL */
static void OptionsReaderReadString_Private(Reader *reader, const char where[], const char text[])
{
  char *own;

  if (!text) {
    OptionsReaderRefuse_Private(reader, "%s: -options_string needs a text, such as \"-order 2 -quiet\"", where);
    return;
  }
  own = TextListAllocate(NULL, strlen(text) + 1);
  OptionsReaderReadText(reader, "-options_string", strcpy(own, text));
  free(own);
}

/* Notes an option of a file, and tells where the same file gives it another value. Behind -prefix_push a name
   is not whole. */
static void OptionsReaderNote_Private(Reader *reader, const char where[], const char name[], const char value[])
{
  TextList *const here = reader->here;
  char            sentence[PETSC_MAX_PATH_LEN + 512];
  int             last = -1;

  reader->prefixes += OptionsReaderIsWord(name, "-prefix_push") - OptionsReaderIsWord(name, "-prefix_pop");
  if (!here || !reader->repeated || reader->prefixes || here->num >= 3 * MAX_NOTED) return;
  for (int i = 0; i < here->num; i += 3)
    if (OptionsReaderIsWord(name, here->items[i])) last = i;
  if (last >= 0 && strcmp(value, here->items[last + 1])) {
    const char *line = strrchr(here->items[last + 2], ','); // where: "<file>, line <number>"

    snprintf(sentence, sizeof(sentence), "%s: %s %s replaces %s of%s", where, name, value, here->items[last + 1],
             line + 1);
    TextListAppend(reader->repeated, sentence);
  }
  TextListAppend(here, name);
  TextListAppend(here, value);
  TextListAppend(here, where);
}

/* Reads the option that stands at words[0], with its value if it has one. Returns the number of words
   taken. */
static int OptionsReaderReadOption_Private(Reader *reader, const char where[], int num_words, const Word words[])
{
  const char *name = words[0].text, *next = num_words > 1 ? words[1].text : NULL;
  const char *value   = next && !OptionsReaderIsName(next) ? next : NULL;
  const int   is_file = OptionsReaderIsWord(name, "-options_file"),
            is_yaml   = OptionsReaderIsWord(name, "-options_file_yaml");

  if (OptionsReaderIsWord(name, "-options_string")) { // its text may well begin with a minus
    OptionsReaderReadString_Private(reader, where, next);
    return next ? 2 : 1;
  }
  if (next && OptionsReaderIsFormula_Private(&words[1]))
    OptionsReaderRefuse_Private(
        reader, "%s: %s %s: PETSc takes a value that begins with a minus and a letter for an option; write 0%s", where,
        name, next, next);
  else if (OptionsReaderIsFormula_Private(&words[0]))
    OptionsReaderRefuse_Private(reader, "%s: '%s' is not an option's name", where, name);
  else if (strchr(name, '='))
    OptionsReaderRefuse_Private(reader, "%s: %s: a value follows after a space, not after '='", where, name);
  else if ((is_file || is_yaml) && !value)
    OptionsReaderRefuse_Private(reader, "%s: %s needs the name of a file", where, name);
  else if (OptionsReaderIsWord(name, "-options_string_yaml") && !value)
    OptionsReaderRefuse_Private(reader, "%s: %s needs a text", where, name);
  else if (is_yaml)
    OptionsReaderAddYAML_Private(reader, where, name, value);
  else if (is_file)
    OptionsReaderReadFile_Private(reader, where, value);
  else {
    TextListAppend(reader->target, name);
    if (value) TextListAppend(reader->target, value);
    OptionsReaderNote_Private(reader, where, name, value ? value : "");
  }
  return value ? 2 : 1;
}

/* Complains about a word that is neither an option nor a value.
   [in] previous - the option before it, or NULL */
static void OptionsReaderRefuseWord_Private(Reader *reader, const char where[], const char word[],
                                            const char previous[])
{
  if (OptionsReaderCanRead(word))
    OptionsReaderRefuse_Private(reader,
                                "%s: '%s' is a file, but not an option; an options file is named by -options_file %s",
                                where, word, word);
  else if (previous)
    OptionsReaderRefuse_Private(reader,
                                "%s: '%s' is one word too many after %s; a value with spaces stands in double quotes",
                                where, word, previous);
  else
    OptionsReaderRefuse_Private(
        reader,
        "%s: '%s' is not an option, which begins with a minus and a letter; an options file is named by -options_file",
        where, word);
}

void OptionsReaderReadWords(Reader *reader, const char where[], int num_words, const Word words[])
{
  const char *previous = NULL;

  for (int w = 0; w < num_words && !reader->sentence[0];) {
    if (OptionsReaderIsName(words[w].text)) {
      previous = words[w].text;
      w += OptionsReaderReadOption_Private(reader, where, num_words - w, words + w);
    } else
      OptionsReaderRefuseWord_Private(reader, where, words[w].text, previous);
  }
}

/* Cuts a line into words in place, and its comment off.
   [out] words - array of shape [strlen(line)] at least */
static int OptionsReaderSplitLine_Private(Reader *reader, const char where[], char line[], Word words[])
{
  static const char blanks[]  = " \t\r\f\v";
  int               num_words = 0;

  for (line += strspn(line, blanks); *line && *line != '#'; line += strspn(line, blanks)) {
    const int   quoted = *line == '"';
    char *const begin = line + quoted, *end = begin + strcspn(begin, quoted ? "\"" : " \t\r\f\v#");
    const char  last = *end, behind = last ? end[1] : '\0';

    words[num_words++] = (Word){begin, quoted};
    if (quoted && !last)
      OptionsReaderRefuse_Private(reader, "%s: the quote before '%s' is not closed in this line", where, begin);
    if (quoted && behind && !strchr(blanks, behind) && behind != '#')
      OptionsReaderRefuse_Private(
          reader, "%s: '%s' follows right after a quote; quotes stand around a value as a whole", where, end + 1);
    *end = '\0';
    if (!last || last == '#') break;
    line = end + 1;
  }
  return num_words;
}

void OptionsReaderReadText(Reader *reader, const char source[], char text[])
{
  TextList *const outer = reader->here;
  TextList        here  = {0, NULL};
  char           *next;
  int             number = 0;

  reader->here = &here;
  if (!strncmp(text, "\xEF\xBB\xBF", 3)) text += 3; // the mark that some editors put before UTF-8
  for (char *line = text; line && !reader->sentence[0]; line = next) {
    Word *words;
    char  where[PETSC_MAX_PATH_LEN + 32];
    int   num_words;

    next = strchr(line, '\n');
    if (next) *next++ = '\0';
    snprintf(where, sizeof(where), "%s, line %d", source, ++number);
    words     = TextListAllocate(NULL, (strlen(line) + 1) * sizeof(*words));
    num_words = OptionsReaderSplitLine_Private(reader, where, line, words);
    OptionsReaderReadWords(reader, where, num_words, words);
    free(words);
  }
  TextListClear(&here);
  reader->here = outer;
}

/* Reads an options file that is named at `where`; its options go before those of the command line. */
static void OptionsReaderReadFile_Private(Reader *reader, const char where[], const char name[])
{
  TextList *const target = reader->target;
  char            found[PETSC_MAX_PATH_LEN], *text, *path = NULL;
  struct stat     status;

  if (!OptionsReaderFindFile(reader->files, name, found, sizeof(found)))
    OptionsReaderRefuse_Private(reader, "%s: -options_file %s: %s", where, name,
                                stat(name, &status) ? "there is no such file" : "this is not a file that can be read");
  else if (reader->depth == READER_MAX_DEPTH)
    OptionsReaderRefuse_Private(reader, "%s: -options_file %s: more than %d files within files", where, name,
                                READER_MAX_DEPTH);
  else
    path = realpath(found, NULL);
  for (int i = 0; path && i < reader->depth; i++)
    if (!strcmp(path, reader->open[i]))
      OptionsReaderRefuse_Private(reader, "%s: -options_file %s: the file names itself", where, name);
  text = path && !reader->sentence[0] ? OptionsReaderSlurp(reader, found) : NULL;
  if (text) {
    reader->open[reader->depth++] = path;
    reader->target                = reader->arguments;
    TextListAppend(reader->files, found);
    OptionsReaderReadText(reader, found, text);
    reader->target = target;
    reader->depth--;
  }
  free(text);
  free(path);
}
