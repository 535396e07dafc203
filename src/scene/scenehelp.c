/* scenehelp.c -- -help: the table as a manual, chapter by chapter. */
#include "scene/sceneoption.h"
#include <stdio.h>
#include <string.h>

/* Columns of a page: the option with its argument, the unit, what holds without it; the sentence stands
   below, indented. */
enum { PAGE_WIDTH = 110, OPTION_WIDTH = 56, UNIT_WIDTH = 13, INDENT = 6 };

static const char intro[] =
    "Mortise finds displacements and contact pressures of elastic bodies that touch.\n"
    "\n"
    "  mortise -options_file scene.opts [-option value ...]\n"
    "\n"
    "Beside each option stand its unit, if it has one, and the value that it has when it is not given, or in "
    "parentheses\n"
    "what happens then; its purpose stands below.\n"
    "\n"
    "Values: n is a whole number, x a number, e a number or a formula of x, y, in solids z, and the time t, such as\n"
    "3e6*(1-y^2), written without blanks or in quotes; components and lists are separated by commas. 0|1 also takes\n"
    "no, yes, and nothing at all for yes. A formula that begins with a minus and a letter is written 0-sin(x).\n"
    "Any consistent set of units will do.\n"
    "<body>, <pair>, <probe> and <path> are names that -bodies, -pairs, -probes and -paths list; <side> is a side of "
    "the body,\n"
    "<region> a region that -<body>_regions lists.\n";

/* Prints a sentence in lines that end before the page does. */
static void HelpPrintWrapped_Private(FILE *file, const char text[])
{
  while (*text) {
    size_t length = strlen(text);

    if (length > PAGE_WIDTH - INDENT) {
      length = PAGE_WIDTH - INDENT;
      while (length > 1 && text[length] != ' ') length--;
    }
    fprintf(file, "%*s%.*s\n", INDENT, "", (int)length, text);
    text += length;
    while (*text == ' ') text++;
  }
}

/* Prints one row; an option too long for its column has a line of its own. */
static void HelpPrintEntry_Private(FILE *file, const OptionEntry *entry)
{
  char left[OPTION_MAX];

  (void)snprintf(left, sizeof(left), "%s %s", entry->name, entry->argument);
  if (strlen(left) > OPTION_WIDTH) {
    fprintf(file, "  %s\n", left);
    left[0] = '\0';
  }
  if (entry->standard[0])
    fprintf(file, "  %-*s %-*s %s\n", OPTION_WIDTH, left, UNIT_WIDTH, entry->unit, entry->standard);
  else
    fprintf(file, "  %s\n", left);
  HelpPrintWrapped_Private(file, entry->help);
}

void SceneHelp(FILE *file)
{
  static const char  line[] = "--------------------------------------------------"; /* longer than any title */
  PetscInt           num;
  const OptionEntry *table = OptionTable(&num);

  fputs(intro, file);
  for (PetscInt i = 0; i < num; i++) {
    const char *title = OptionGroupTitle(table[i].group);

    if (i == 0 || table[i].group != table[i - 1].group) fprintf(file, "\n%s\n%.*s\n", title, (int)strlen(title), line);
    HelpPrintEntry_Private(file, &table[i]);
  }
}
