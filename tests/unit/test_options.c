/* test_options.c -- the argument list that PETSc gets, and the sentence where there is none. FileSet are written to and read
   from the working directory. */
#include "base/compat.h"
#include "base/options.h"
#include <string.h>
#include <sys/stat.h>
#include <test.h>
#include <unistd.h>

enum { MAX_WORDS = 32 };

static char sentence[4096];

/* Writes a file of the first rank. */
static void Write(const char path[], const char text[])
{
  int rank;

  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (!rank) {
    FILE *file = fopen(path, "w");

    CHECK(file && fputs(text, file) >= 0 && !fclose(file));
  }
  MPI_Barrier(MPI_COMM_WORLD);
}

/* The list that a command line expands to, joined by '|', without the program and the final -skip_petscrc. */
static const char *Expand(const char *const words[])
{
  static char joined[4096];
  char       *argv[MAX_WORDS] = {(char *)"program"}, **list;
  int         argc            = 1, num;

  for (; words[argc - 1]; ++argc) argv[argc] = (char *)words[argc - 1];
  OptionsExpand(argc, argv, &num, &list, sentence, sizeof(sentence));
  joined[0] = '\0';
  CHECK(num >= 2 && !strcmp(list[0], "program") && !strcmp(list[num - 1], "-skip_petscrc") && !list[num]);
  for (int i = 1; i < num - 1; ++i) {
    strcat(joined, i > 1 ? "|" : "");
    strcat(joined, list[i]);
  }
  return joined;
}

/* Expands words given one by one; the test fails unless the list is the expected one and nothing is wrong. */
#define EXPECT(expected, ...)                                                                                          \
  do {                                                                                                                 \
    const char *words_[] = {__VA_ARGS__, NULL};                                                                        \
    const char *joined_  = Expand(words_);                                                                             \
    if (sentence[0] || strcmp(joined_, expected)) fprintf(stderr, "got '%s', sentence '%s'\n", joined_, sentence);     \
    CHECK(!sentence[0] && !strcmp(joined_, expected));                                                                 \
  } while (0)

/* The same for a mistake: the sentence has both parts. */
#define EXPECT_FAULT(part, other, ...)                                                                                 \
  do {                                                                                                                 \
    const char *words_[] = {__VA_ARGS__, NULL};                                                                        \
    Expand(words_);                                                                                                    \
    if (!strstr(sentence, part) || !strstr(sentence, other)) fprintf(stderr, "got '%s'\n", sentence);                  \
    CHECK(strstr(sentence, part) && strstr(sentence, other));                                                          \
  } while (0)

static void TestCommandLine(void)
{
  EXPECT("-a|1|-b|-c|-5|--d|-.5e3", "-a", "1", "-b", "-c", "-5", "--d", "-.5e3");
  EXPECT("-a|x y|-b|0-sin(x)", "-a", "x y", "-b", "0-sin(x)");
  EXPECT("-a||-b|-", "-a", "", "-b", "-");
  EXPECT_FAULT("'plates.opts'", "-options_file", "plates.opts");
  EXPECT_FAULT("'plates'", "-title", "-title", "two", "plates");
  EXPECT_FAULT("-load -sin(x)", "write 0-sin(x)", "-load", "-sin(x)");
  EXPECT_FAULT("'-sin(x)'", "not an option's name", "-sin(x)");
  EXPECT_FAULT("-dm_refine=3", "'='", "-dm_refine=3");
  EXPECT_FAULT("-options_file", "needs the name of a file", "-options_file");
  EXPECT_FAULT("-options_file", "needs the name of a file", "-options_file", "-quiet");
  EXPECT_FAULT("'.petscrc' is a file", "-options_file .petscrc", "-quiet", "1", ".petscrc");
  EXPECT_FAULT("nowhere.opts", "no such file", "-options_file", "nowhere.opts");
  EXPECT_FAULT(".", "not a file", "-options_file", ".");
  EXPECT_FAULT("nowhere.yaml", "no such file", "-options_file_yaml", "nowhere.yaml");
}

/* FileSet come first, wherever the command line names them, and in their order. */
static void TestOrder(void)
{
  Write("first.opts", "-a 1\n-b 2\n");
  Write("second.opts", "-b 3\n");
  EXPECT("-a|1|-b|2|-b|3|-a|4|-c", "-a", "4", "-options_file", "first.opts", "-c", "-options_file", "second.opts");
  CHECK(!strcmp(OptionsFileName(), "first.opts"));
  EXPECT("-a|1|-b|2", "--options_file", "first.opts");
  EXPECT_FAULT("'stray'", "too many", "-quiet", "-options_file", "first.opts", "stray");
  EXPECT("-c", "-c");
  CHECK(!OptionsFileName());
}

static void TestSyntax(void)
{
  Write("syntax.opts",
        "\xEF\xBB\xBF# a comment\n\n  \t\n-a 1 # behind a value\n-b   \"two words # no comment\"#comment\n"
        "\t-c\r\n-d 1,-2 -e -f -3\r\n-g#h\n-i \"\"\n-last 7");
  EXPECT("-a|1|-b|two words # no comment|-c|-d|1,-2|-e|-f|-3|-g|-i||-last|7", "-options_file", "syntax.opts");
}

static void CheckText(const char text[], const char line[], const char culprit[])
{
  Write("wrong.opts", text);
  EXPECT_FAULT(line, culprit, "-options_file", "wrong.opts");
}

static void TestMistakes(void)
{
  CheckText("-a 1\nbodies upper,lower\n", "wrong.opts, line 2", "'bodies'");
  CheckText("-title two plates\n", "wrong.opts, line 1", "'plates'");
  CheckText("\n\n-title \"two plates\n-b\n", "wrong.opts, line 3", "not closed");
  CheckText("-title \"two\"plates\n", "wrong.opts, line 1", "'plates'");
  CheckText("-load \"-sin(x)\"\n", "wrong.opts, line 1", "write 0-sin(x)");
  CheckText("-load -exp(x),0\n", "wrong.opts, line 1", "write 0-exp(x),0");
  CheckText("-5\n", "wrong.opts, line 1", "'-5'");
  CheckText("-a=5\n", "wrong.opts, line 1", "'='");
  CheckText("-options_file\n", "wrong.opts, line 1", "needs the name");
  CheckText("-a 1\n-options_file nowhere.opts\n", "wrong.opts, line 2", "nowhere.opts");
  CheckText("-options_file wrong.opts\n", "wrong.opts, line 1", "names itself");
}

static void TestBinary(void)
{
  int rank;

  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (!rank) {
    FILE *file = fopen("binary.opts", "w");

    CHECK(file && fwrite("-a 1\n\0-b", 1, 8, file) == 8 && !fclose(file));
  }
  EXPECT_FAULT("binary.opts", "not a text file", "-options_file", "binary.opts");
}

/* A file may name others, found beside the one that names them as well. */
static void TestNesting(void)
{
  PetscBool exists;
  char      found[PETSC_MAX_PATH_LEN];

  mkdir("folder", 0777);
  Write("folder/outer.opts", "-a 1\n-options_file inner.opts\n-c 3\n");
  Write("folder/inner.opts", "-b 2\n");
  EXPECT("-a|1|-b|2|-c|3|-d|4", "-options_file", "folder/outer.opts", "-d", "4");
  CHECK(!strcmp(OptionsFileName(), "folder/outer.opts"));
  CHECK(!OptionsFindFile(MPI_COMM_WORLD, "inner.opts", found, sizeof(found), &exists));
  CHECK(exists && !strcmp(found, "folder/inner.opts"));
  CHECK(!OptionsFindFile(MPI_COMM_WORLD, "first.opts", found, sizeof(found), &exists));
  CHECK(exists && !strcmp(found, "first.opts"));
  CHECK(!OptionsFindFile(MPI_COMM_WORLD, "nowhere.msh", found, sizeof(found), &exists));
  CHECK(!exists && !strcmp(found, "nowhere.msh"));
  CHECK(!OptionsFindFile(MPI_COMM_WORLD, "folder", found, sizeof(found), &exists));
  CHECK(!exists);
  Write("folder/inner.opts", "-b 2\n-options_file outer.opts\n");
  EXPECT_FAULT("folder/inner.opts, line 2", "names itself", "-options_file", "folder/outer.opts");
}

/* What PETSc reads unasked comes before everything else, the variable after the files. */
static void TestDefaults(void)
{
  setenv("HOME", "folder", 1);
  setenv("PETSC_OPTIONS", "-v 3", 1);
  Write("folder/.petscrc", "-h 1\n");
  Write(".petscrc", "-w 2\n");
  EXPECT("-h|1|-w|2|-v|3|-a|1|-b|2|-c", "-options_file", "first.opts", "-c");
  CHECK(!getenv("PETSC_OPTIONS"));
  EXPECT("-skip_petscrc|-c", "-skip_petscrc", "-c");
  Write(".petscrc", "");
  Write("folder/.petscrc", "wrong\n");
  EXPECT_FAULT("folder/.petscrc, line 1", "'wrong'", "-c");
}

/* What is in effect: sorted, of one name the last. */
static void TestGiven(void)
{
  static const char *const expected[][2] = {{"a", "1"}, {"B", "4"}, {"c", ""}, {"d", "x y"}};
  const char              *words[] = {"--d", "x y", "-B", "3", "-options_file", "first.opts", "-c", "-B", "4", NULL};
  OptionGiven             *given;
  PetscInt                 num;

  Expand(words);
  CHECK(!OptionsGetGiven(&num, &given));
  CHECK(num == 4);
  for (PetscInt i = 0; i < num; ++i)
    CHECK(!strcmp(given[i].name, expected[i][0]) && !strcmp(given[i].value, expected[i][1]));
  CHECK(!PetscFree(given));
}

/* Makes and enters a folder of this run's own, so that runs on several numbers of ranks do not meet. */
static void EnterFolder(const char program[])
{
  int  size;
  char name[PETSC_MAX_PATH_LEN];

  MPI_Comm_size(MPI_COMM_WORLD, &size);
  snprintf(name, sizeof(name), "%s.np%d", program, size);
  mkdir(name, 0777);
  CHECK(!chdir(name));
  MPI_Barrier(MPI_COMM_WORLD);
}

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  unsetenv("HOME");
  unsetenv("PETSC_OPTIONS");
  EnterFolder(argv[0]);
  Write(".petscrc", "");
  TestCommandLine();
  TestOrder();
  TestSyntax();
  TestMistakes();
  TestBinary();
  TestNesting();
  TestGiven();
  TestDefaults();
  MPI_Finalize();
  return 0;
}
