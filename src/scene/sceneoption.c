/* sceneoption.c -- one option: found through the table, read from text, with one sentence for a mistake (see
   sceneoption.h). */
#include "scene/sceneoption.h"
#include "scene/sceneparts.h"
#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Characters of a name and of its value that a sentence shows: expressions may be thousands long. */
enum { NAME_SHOWN = 400, VALUE_SHOWN = 60 };

PetscErrorCode OptionExpand(const char pattern[], const char owner[], const char side[], char name[OPTION_MAX])
{
  const char *open = strchr(pattern, '<');
  size_t      n    = 0;

  PetscFunctionBeginUser;
  name[0] = '\0';
  for (; open; open = strchr(pattern, '<')) {
    const PetscBool is_side = (PetscBool)!strncmp(open, "<side>", 6);
    const char     *word    = is_side ? side : owner;
    char           *begin   = name + n + (open - pattern);

    n += (size_t)snprintf(name + n, OPTION_MAX - n, "%.*s%s", (int)(open - pattern), pattern, word ? word : "");
    PetscCheck(n < OPTION_MAX, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Name of option %s too long", pattern);
    for (char *c = begin; is_side && *c; c++) {
      if (isspace((unsigned char)*c)) *c = '_'; /* a blank would end the option */
    }
    pattern = OptionPlaceholderEnd(open);
  }
  n += (size_t)snprintf(name + n, OPTION_MAX - n, "%s", pattern);
  PetscCheck(n < OPTION_MAX, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Name of option %s too long", pattern);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionFind(Scene scene, const char pattern[], const char owner[], const char side[], Option *option)
{
  PetscInt           num;
  const OptionEntry *table = OptionTable(&num);
  const char        *value = NULL;

  PetscFunctionBeginUser;
  option->scene = scene;
  option->comm  = scene->comm;
  option->owner = owner;
  option->entry = NULL;
  for (PetscInt i = 0; i < num && !option->entry; i++) {
    if (!strcmp(table[i].name, pattern)) option->entry = &table[i];
  }
  PetscCheck(option->entry, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Option %s is read but not in the table", pattern);
  PetscCall(OptionExpand(pattern, owner, side, option->name));
  PetscCall(PetscOptionsFindPair(NULL, NULL, option->name, &value, &option->set));
  if (option->set)
    option->text = value ? value : "";
  else
    option->text = option->entry->standard[0] == '(' ? NULL : option->entry->standard;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionShow(const char name[], const char value[], char shown[OPTION_MAX])
{
  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(shown, OPTION_MAX, "%.*s%s%.*s%s", NAME_SHOWN, name, value[0] ? " " : "", VALUE_SHOWN, value,
                          strlen(value) > VALUE_SHOWN ? "..." : ""));
  for (char *c = shown; *c; c++) {
    if (iscntrl((unsigned char)*c)) *c = ' '; /* a sentence is one line */
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionRaise(const Option *option, const char format[], ...)
{
  char    sentence[OPTION_SENTENCE], shown[OPTION_MAX];
  va_list args;

  PetscFunctionBeginUser;
  va_start(args, format);
  vsnprintf(sentence, sizeof(sentence), format, args);
  va_end(args);
  PetscCall(OptionShow(option->name, option->set ? option->text : "", shown));
  PetscCall(UserErrorRaise(option->comm, "%s: %s", shown, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionRequire(const Option *option, const char why[])
{
  char near[OPTION_MAX], reason[OPTION_MAX];

  PetscFunctionBeginUser;
  if (option->set) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(UnusedOptionsNearest(option, near));
  if (near[0])
    PetscCall(UserErrorRaise(option->comm, "%s: there is no such option; did you mean %s, which is missing?", near,
                             option->name));
  PetscCall(OptionExpand(why, option->owner, NULL, reason));
  PetscCall(UserErrorRaise(option->comm, "%s is missing: %s", option->name, reason));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A bare option where a value belongs is a mistake. */
static PetscErrorCode OptionCheckValue_Private(const Option *option)
{
  PetscFunctionBeginUser;
  if (option->set && !option->text[0])
    PetscCall(OptionRaise(option, "has no value; write %s %s", option->name, option->entry->argument));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionGetText(const Option *option, char **text)
{
  PetscFunctionBeginUser;
  PetscCall(OptionCheckValue_Private(option));
  if (option->text) PetscCall(PetscStrallocpy(option->text, text));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionGetBool(const Option *option, PetscBool *value)
{
  static const char *const words[2][5] = {{"0", "no", "false", "off", "n"}, {"1", "yes", "true", "on", "y"}};
  PetscBool                same;

  PetscFunctionBeginUser;
  if (!option->text) PetscFunctionReturn(PETSC_SUCCESS);
  if (!option->text[0]) {
    *value = PETSC_TRUE;
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  for (PetscInt truth = 0; truth < 2; truth++) {
    for (PetscInt i = 0; i < 5; i++) {
      PetscCall(PetscStrcasecmp(option->text, words[truth][i], &same));
      if (!same) continue;
      *value = (PetscBool)truth;
      PetscFunctionReturn(PETSC_SUCCESS);
    }
  }
  PetscCall(OptionRaise(option, "is neither yes nor no; it takes 1, yes, true, on (or nothing), or 0, no, false, off"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionNextItem(const Option *option, const char **cursor, char item[OPTION_MAX])
{
  const char *begin = *cursor ? *cursor : option->text, *end = begin + strcspn(begin, ",");

  PetscFunctionBeginUser;
  PetscCall(OptionCheckValue_Private(option));
  *cursor = *end ? end + 1 : NULL;
  while (begin < end && isspace((unsigned char)*begin)) begin++;
  while (begin < end && isspace((unsigned char)end[-1])) end--;
  if (begin == end)
    PetscCall(OptionRaise(option, "has an empty item in its list; write %s %s", option->name, option->entry->argument));
  if (end - begin >= OPTION_MAX)
    PetscCall(OptionRaise(option, "has an item longer than %d characters", OPTION_MAX - 1));
  PetscCall(PetscArraycpy(item, begin, end - begin));
  item[end - begin] = '\0';
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscInt OptionCountItems(const Option *option)
{
  PetscInt n = 1;

  if (!option->text) return 0;
  for (const char *c = option->text; *c; c++) n += *c == ',';
  return n;
}

/* Raises a user error unless the list has n items. */
static PetscErrorCode OptionCheckCount_Private(const Option *option, PetscInt n)
{
  const PetscInt given = OptionCountItems(option);

  PetscFunctionBeginUser;
  PetscCall(OptionCheckValue_Private(option));
  if (given != n) {
    PetscCall(OptionRaise(option, "%" PetscInt_FMT " number%s given, %" PetscInt_FMT " wanted, separated by commas",
                          given, given == 1 ? "" : "s", n));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionGetInts(const Option *option, PetscInt n, PetscInt smallest, PetscInt values[])
{
  const char *cursor = NULL;
  char        item[OPTION_MAX], *end;

  PetscFunctionBeginUser;
  if (!option->text) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionCheckCount_Private(option, n));
  for (PetscInt i = 0; i < n; i++) {
    PetscCall(OptionNextItem(option, &cursor, item));
    errno                 = 0;
    const long long value = strtoll(item, &end, 10);

    if (*end || errno) PetscCall(OptionRaise(option, "'%s' is not a whole number", item));
    if (value < smallest || value > PETSC_MAX_INT) {
      PetscCall(OptionRaise(option,
                            "%s is out of range; the smallest value is %" PetscInt_FMT ", the largest %" PetscInt_FMT,
                            item, smallest, PETSC_MAX_INT));
    }
    values[i] = (PetscInt)value;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Numbers that do not vary in space may still be formulas, such as pi/2. */
PetscErrorCode OptionGetReals(const Option *option, PetscInt n, PetscReal values[])
{
  const PetscReal origin[3] = {0, 0, 0};
  Expression      e         = NULL;
  PetscBool       constant;

  PetscFunctionBeginUser;
  if (!option->text) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionGetExpression(option, n, PETSC_FALSE, &e));
  constant = ExpressionIsConstant(e);
  if (constant) PetscCall(ExpressionEvaluate(e, 3, origin, values));
  PetscCall(ExpressionDestroy(&e));
  if (!constant)
    PetscCall(OptionRaise(option, "the value cannot vary in space; give a number, or a formula without x, y, z, t"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionGetBytes(const Option *option, PetscReal *bytes)
{
  static const char letters[] = "KMGT";
  const PetscReal   unit      = 1024;
  const char       *letter;
  char             *end;
  PetscReal         value;

  PetscFunctionBeginUser;
  if (!option->text) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionCheckValue_Private(option));
  value  = strtod(option->text, &end);
  letter = *end ? strchr(letters, toupper((unsigned char)*end)) : NULL;
  if (end == option->text || (*end && (!letter || end[1])) || PetscIsInfOrNanReal(value))
    PetscCall(OptionRaise(option,
                          "'%s' is not an amount of memory; write a number of bytes, or one with K, M, G or T "
                          "behind it, as in 4G",
                          option->text));
  if (!(value > 0)) PetscCall(OptionRaise(option, "an amount of memory must be above 0"));
  *bytes = letter ? value * PetscPowRealInt(unit, (int)(letter - letters) + 1) : value;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionMatchChoice(const Option *option, const char word[], const char why[], PetscInt *index)
{
  char        buffer[OPTION_MAX], list[OPTION_MAX];
  const char *choices[OPTION_CHOICES], *near;
  PetscInt    num    = 0;
  size_t      length = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscStrncpy(buffer, option->entry->argument, sizeof(buffer)));
  for (char *c = buffer, *next; c; c = next) {
    next = strchr(c, '|');
    if (next) *next++ = '\0';
    if (!strcmp(c, word)) {
      *index = num;
      PetscFunctionReturn(PETSC_SUCCESS);
    }
    PetscCheck(num < OPTION_CHOICES, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Option %s has too many choices",
               option->entry->name);
    choices[num++] = c;
    length += (size_t)snprintf(list + length, sizeof(list) - length, "%s%s", length ? ", " : "", c);
  }
  near = UserErrorNearest(word, num, choices);
  PetscCall(OptionRaise(option, "'%s' is not one of %s%s%s%s%s", word, list, why, near ? "; did you mean " : "",
                        near ? near : "", near ? "?" : ""));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionGetChoice(const Option *option, PetscInt *index)
{
  PetscFunctionBeginUser;
  if (!option->text) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionCheckValue_Private(option));
  PetscCall(OptionMatchChoice(option, option->text, "", index));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Formulas name coordinates that the scene has: r and z are those of a meridian plane. */
static PetscErrorCode OptionCheckNames_Private(const Option *option, Expression e)
{
  const PetscBool solid = (PetscBool)(option->scene->dim == 3);

  PetscFunctionBeginUser;
  if (option->scene->model == MODEL_AXISYMMETRIC) {
    ExpressionNameMeridian(e);
  } else if (ExpressionNames(e, "r")) {
    PetscCall(OptionRaise(option, "'r' is the radius of -model axisymmetric; the coordinates of this scene are %s",
                          solid ? "x, y, z" : "x, y"));
  } else if (!solid && ExpressionNames(e, "z")) {
    PetscCall(OptionRaise(option, "'z' is known in solids and with -model axisymmetric; the coordinates of this scene "
                                  "are x, y"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Raises the user error for data of solids where the mesh file should have shown that the scene is solid: the
   data are not wrong. */
static PetscErrorCode OptionCheckSolid_Private(const Option *option, PetscBool allow_free)
{
  Expression e;
  PetscInt   given;

  PetscFunctionBeginUser;
  PetscCall(ExpressionCreate(option->comm, option->name, option->text, 0, allow_free, &e));
  given = ExpressionSize(e);
  PetscCall(ExpressionDestroy(&e));
  if (given == 3) {
    PetscCall(OptionRaise(option, "a datum of 3 components is of a solid, in the plane there are 2; %s",
                          option->scene->unread));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode OptionGetExpression(const Option *option, PetscInt num_components, PetscBool allow_free, Expression *e)
{
  PetscFunctionBeginUser;
  if (!option->text) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionCheckValue_Private(option));
  if (option->scene->unread && num_components == 2) PetscCall(OptionCheckSolid_Private(option, allow_free));
  PetscCall(ExpressionCreate(option->comm, option->name, option->text, num_components, allow_free, e));
  PetscCall(OptionCheckNames_Private(option, *e));
  PetscFunctionReturn(PETSC_SUCCESS);
}
