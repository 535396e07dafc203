/* optionsreader.h -- options in words, lines and files, until the first mistake.

   Nothing here may call PETSc, which has not begun yet, except PetscOptionsValidKey(), which decides like
   PETSc's own parser whether a word is an option. First rank only; not collective. */
#ifndef BASE_READER_H
#define BASE_READER_H

#include "base/textlist.h"

enum { READER_MAX_DEPTH = 16 }; /* of files within files: a chain this long is a mistake */

/* A word of a line or of the command line. */
typedef struct {
  char *text; // borrowed
  int   quoted;
} Word;

/* State of reading: the first mistake, the lists that are written, and the open files, outermost first. */
typedef struct {
  char     *sentence;
  size_t    len;
  TextList *target;
  TextList *arguments; // options of files
  TextList *files;     // as found, in the order of reading; the first as typed
  TextList *repeated;  // optional, may be NULL: for each option that one file gives two values, where, as a sentence
  TextList *here;     // name, value and line of each option of the file that is being read, in turn; NULL outside files
  int       prefixes; // that are open: names are then not whole
  int       depth;
  char     *open[READER_MAX_DEPTH];
} Reader;

/* Whether a word is the name of an option, and of this one, with one dash or two. */
int OptionsReaderIsName(const char word[]);
int OptionsReaderIsWord(const char word[], const char name[]);

int OptionsReaderCanRead(const char path[]);
/* found = name, or name within the folder of one of the files; whether it can be read there. */
int OptionsReaderFindFile(const TextList *files, const char name[], char found[], size_t len);

/* Reads the words of one line. [in] where - names the line in a complaint */
void OptionsReaderReadWords(Reader *reader, const char where[], int num_words, const Word words[]);
/* Reads the lines of a text in place. [in] source - names the text in a complaint */
void OptionsReaderReadText(Reader *reader, const char source[], char text[]);
/* The file's text, to be freed, or NULL after a complaint. */
char *OptionsReaderSlurp(Reader *reader, const char path[]);

#endif
