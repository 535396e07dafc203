/* help.c -- -help: the table as a manual, chapter by chapter. */
#include "option.h"
#include <string.h>

/* Columns of a page: the option with its argument, the unit, the default; the sentence stands below, indented. */
enum { PAGE_WIDTH = 100, OPTION_WIDTH = 52, UNIT_WIDTH = 14, INDENT = 6 };

static const char intro[] =
    "Mortise finds displacements and contact pressures of elastic bodies that touch.\n"
    "\n"
    "  mortise -options_file scene.opts [-option value ...]\n"
    "\n"
    "Values: n is a whole number, x a number, e a number or an expression in x and y such as 3e6*(1-y^2), written "
    "without\n"
    "blanks or in quotes; components and lists are separated by commas. 0|1 also takes no, yes, and nothing at all for "
    "yes.\n"
    "An expression that begins with a minus and a letter is written 0-sin(x). Any consistent set of units will do.\n"
    "<body>, <pair> and <probe> are names that -bodies, -pairs and -probes list; <side> is a side of the body.\n";

/* Prints a sentence in lines that end before the page does. */
static PetscErrorCode HelpPrintWrapped_Private(MPI_Comm comm, const char text[])
{
  PetscFunctionBeginUser;
  while (*text) {
    size_t length = strlen(text);

    if (length > PAGE_WIDTH - INDENT) {
      length = PAGE_WIDTH - INDENT;
      while (length > 1 && text[length] != ' ') length--;
    }
    PetscCall(PetscPrintf(comm, "%*s%.*s\n", INDENT, "", (int)length, text));
    text += length;
    while (*text == ' ') text++;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneHelp(MPI_Comm comm)
{
  PetscInt           num;
  const OptionEntry *table = OptionTable(&num);

  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(comm, "%s", intro));
  for (PetscInt i = 0; i < num; i++) {
    const OptionEntry *entry = &table[i];
    char               left[OPTION_MAX];

    if (i == 0 || entry->group != table[i - 1].group) {
      const char *title = OptionGroupTitle(entry->group);

      PetscCall(PetscPrintf(comm, "\n%s\n%.*s\n", title, (int)strlen(title),
                            "--------------------------------------------------"));
    }
    PetscCall(PetscSNPrintf(left, sizeof(left), "%s %s", entry->name, entry->argument));
    PetscCall(PetscPrintf(comm, "  %-*s %-*s %s\n", OPTION_WIDTH, left, UNIT_WIDTH, entry->unit, entry->standard));
    PetscCall(HelpPrintWrapped_Private(comm, entry->help));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
