/* expression.c -- a comma list of numbers and formulas.

   Formulas are compiled once by muParser [1] to its byte code. A formula without variables is evaluated at
   once and is a plain number from then on.

   References: [1] muParser, a fast math parser library, https://beltoforion.de/en/muparser */
#include "base/compat.h"
#include "base/expression.h"
#include "base/switching.h"
#include "base/usererror.h"
#include <ctype.h>
#include <muParserDLL.h>
#include <string.h>
#include <strings.h>

/* One of the components. */
typedef struct {
  muParserHandle_t parser; // NULL for a plain number
  PetscReal        number;
  PetscBool        free; // the word `free`: whatever the datum prescribes, it is not prescribed here
} Component;

struct _n_Expression {
  char      *option, *text;
  PetscInt   num_components;
  Component *components;
  PetscBool  constant;
  PetscBool  meridian; // z is the second coordinate
  PetscReal  factor;   // of all values
  PetscReal  x[3];     // values of the variables x, y, z
  PetscBool  failed;   // an evaluation was not finite: the first one is described by the rest
  PetscInt   failed_component, failed_dim;
  PetscReal  failed_x[3], failed_t;
};

/* Variables of formulas, in the order of x[]; r is the first coordinate as well. */
static const char *const variable_names[] = {"x", "y", "z", "r"};
static const char *const known_names[]    = {"x",     "y",    "z",    "r",     "t",    "pi",    "sin",  "cos",   "tan",
                                             "asin",  "acos", "atan", "atan2", "sinh", "cosh",  "tanh", "asinh", "acosh",
                                             "atanh", "exp",  "ln",   "log",   "log2", "log10", "sqrt", "abs",   "sign",
                                             "rint",  "min",  "max",  "sum",   "avg",  "free"};

static PetscReal time_value = 1; // value of t in all formulas

enum { TEXT_SHOWN = 200 }; // characters of the text in a sentence

/* The text as sentences quote it. [out] shown - [TEXT_SHOWN] */
static const char *ExpressionShortenText_Private(const char text[], char shown[])
{
  snprintf(shown, TEXT_SHOWN, "%.*s%s", TEXT_SHOWN - 4, text, strlen(text) > TEXT_SHOWN - 4 ? "..." : "");
  return shown;
}

/* --- reading -------------------------------------------------------------------------------------------- */

/* Whether text is a decimal number and nothing else: strtod() alone would also take nan, inf and hexadecimal
   digits. */
static PetscBool ExpressionReadNumber_Private(const char text[], PetscReal *number)
{
  char *end;

  if (!text[0] || text[strspn(text, "+-.0123456789eE")]) return PETSC_FALSE;
  *number = strtod(text, &end);
  return !*end ? PETSC_TRUE : PETSC_FALSE;
}

/* Describes the error in a formula that is too long for muParser's own message. */
static void ExpressionDescribeLong_Private(muParserHandle_t parser, const char formula[], char words[], size_t len)
{
  enum { TOO_LONG = 37, SHOWN = 40 }; // ecEXPRESSION_TOO_LONG of muParser's C++ header
  const size_t length = strlen(formula);
  const int    place  = mupGetErrorPos(parser);

  if (mupGetErrorCode(parser) == TOO_LONG)
    snprintf(words, len, "a formula of %zu letters is longer than muParser takes, 20000", length);
  else if (place < 0 || (size_t)place >= length)
    snprintf(words, len, "something is missing at its end");
  else
    snprintf(words, len, "it cannot be read from letter %d on, '%.*s...'", place + 1, SHOWN, formula + place);
}

/* The correct form of a construct of another language, as the end of a sentence; "" if there is none.
   [in] place - of the error */
static const char *ExpressionAdvise_Private(const char formula[], size_t place)
{
  static const char *const other[][2] = {{"**", "; a power is x^2"},
                                         {"if(", "; a choice is x>0 ? 1 : 0"},
                                         {" and ", "; 'and' is &&"},
                                         {" or ", "; 'or' is ||"}};
  const size_t             length     = strlen(formula);

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(other); i++)
    if (strstr(formula, other[i][0])) return other[i][1];
  if (place == 0 || place >= length) return "";
  if (isdigit((unsigned char)formula[place]) && isspace((unsigned char)formula[place - 1]))
    return "; a number has no blanks";
  if (isalpha((unsigned char)formula[place]) &&
      (isdigit((unsigned char)formula[place - 1]) || formula[place - 1] == ')'))
    return "; a product needs a '*', and a number no unit";
  return "";
}

/* An unknown name. [in] text - the rest of the formula that begins with it */
static void ExpressionDescribeName_Private(const char text[], const char advice[], char words[], size_t len)
{
  static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
  char              name[64];
  const char       *nearest;
  size_t            length = strspn(text, letters);

  if (length == 0) // a character of UTF-8 whole: a first byte and those that continue it
    for (length = 1; text[0] && ((unsigned char)text[length] & 0xC0) == 0x80;) length++;
  snprintf(name, sizeof(name), "%.*s", (int)length, text);
  nearest = UserErrorNearest(name, PETSC_STATIC_ARRAY_LENGTH(known_names), known_names);
  if (nearest && !strcmp(nearest, name))
    snprintf(words, len, "'%s' needs its argument in parentheses", name);
  else if (!strcasecmp(name, "nan") || !strcasecmp(name, "inf"))
    snprintf(words, len, "'%s' is not a finite number", name);
  else
    snprintf(words, len, "'%s' is not known here%s%s%s%s", name, nearest ? ", nearest is '" : "",
             nearest ? nearest : "", nearest ? "'" : "", advice);
}

/* muParser's error as a part of our sentence. Its getters share one buffer, so each result is used before the
   next call. They write quotations into this buffer without a check of its length. */
static void ExpressionDescribeError_Private(muParserHandle_t parser, const char formula[], char words[], size_t len)
{
  enum { UNKNOWN_NAME = 1, SAFE = 1024 }; // ecUNASSIGNABLE_TOKEN of muParser's C++ header; half of its buffer
  const char *text, *advice;
  int         length;

  if (strlen(formula) > SAFE) {
    ExpressionDescribeLong_Private(parser, formula, words, len);
    return;
  }
  advice = ExpressionAdvise_Private(formula, (size_t)PetscMax(0, mupGetErrorPos(parser)));
  if (mupGetErrorCode(parser) == UNKNOWN_NAME) {
    ExpressionDescribeName_Private(mupGetErrorToken(parser), advice, words, len);
  } else {
    text   = mupGetErrorMsg(parser);
    length = (int)strlen(text);
    while (length > 1 && (text[length - 1] == '.' || isspace((unsigned char)text[length - 1]))) length--;
    snprintf(words, len, "%c%.*s%s", tolower((unsigned char)text[0]), length - 1, text + 1, advice);
  }
}

/* Whether text has a lone '=', which muParser would take for an assignment to a variable. */
static PetscBool ExpressionHasAssignment_Private(const char text[])
{
  for (const char *t = strchr(text, '='); t; t = strchr(t + 1, '=')) {
    if (t[1] == '=')
      t++;
    else if (t == text || !strchr("<>!", t[-1]))
      return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Compiles a formula. [out] complaint - why it cannot be read, or "" (array of shape [len]) */
static void ExpressionCompileFormula_Private(Expression e, const char text[], Component *component, char complaint[],
                                             size_t len)
{
  muParserHandle_t parser = mupCreate(muBASETYPE_FLOAT);
  PetscBool        failed;

  component->parser = parser;
  mupDefineConst(parser, "pi", PETSC_PI);
  for (size_t v = 0; v < PETSC_STATIC_ARRAY_LENGTH(variable_names); v++)
    mupDefineVar(parser, variable_names[v], &e->x[v % 3]);
  mupDefineVar(parser, "t", &time_value);
  mupSetExpr(parser, text);
  failed = mupError(parser) ? PETSC_TRUE : PETSC_FALSE; // the call resets the error
  if (!failed) {
    component->number = mupEval(parser); // the byte code is made at the first evaluation
    failed            = mupError(parser) ? PETSC_TRUE : PETSC_FALSE;
  }
  if (failed)
    ExpressionDescribeError_Private(parser, text, complaint, len);
  else if (ExpressionHasAssignment_Private(text))
    snprintf(complaint, len, "'=' cannot be used, equality is '=='");
  else if (!mupGetExprVarNum(parser)) {
    mupRelease(parser);
    component->parser = NULL;
  }
}

/* Reads one component. [out] complaint - as above */
static void ExpressionReadComponent_Private(Expression e, const char text[], PetscBool allow_free, Component *component,
                                            char complaint[], size_t len)
{
  if (!text[0])
    snprintf(complaint, len, "there is nothing between the commas");
  else if (!strcmp(text, "free")) {
    component->free = PETSC_TRUE;
    if (!allow_free) snprintf(complaint, len, "'free' is for given displacements only");
  } else if (!ExpressionReadNumber_Private(text, &component->number))
    ExpressionCompileFormula_Private(e, text, component, complaint, len);
  if (!complaint[0] && !component->parser && PetscIsInfOrNanReal(component->number))
    snprintf(complaint, len, "this is not a finite number");
}

/* Length of the component at the front of text: up to a comma outside parentheses, or the end. */
static size_t ExpressionComponentLength_Private(const char text[])
{
  PetscInt depth = 0;
  size_t   n;

  for (n = 0; text[n] && (depth > 0 || text[n] != ','); n++) depth += (text[n] == '(') - (text[n] == ')');
  return n;
}

/* Whether a parenthesis is not closed: the commas behind it separate nothing. */
static PetscBool ExpressionIsOpen_Private(const char text[])
{
  PetscInt depth = 0;

  for (; *text; text++) depth += (*text == '(') - (*text == ')');
  return (PetscBool)(depth > 0);
}

static PetscInt ExpressionCountComponents_Private(const char text[])
{
  PetscInt count = 1;

  for (text += ExpressionComponentLength_Private(text); *text; text += ExpressionComponentLength_Private(text)) {
    text++;
    count++;
  }
  return count;
}

/* A copy of the first length letters without blanks around them; the caller frees it. */
static PetscErrorCode ExpressionCopyTrimmed_Private(const char text[], size_t length, char **copy)
{
  PetscFunctionBeginUser;
  for (; length && isspace((unsigned char)text[0]); length--) text++;
  while (length && isspace((unsigned char)text[length - 1])) length--;
  PetscCall(PetscMalloc1(length + 1, copy));
  PetscCall(PetscArraycpy(*copy, text, length));
  (*copy)[length] = '\0';
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a comma stands between digits that can be one number: not behind an exponent. */
static PetscBool ExpressionIsDecimalComma_Private(const char text[], const char *comma)
{
  const char *c = comma;

  if (comma == text || !isdigit((unsigned char)comma[-1]) || !isdigit((unsigned char)comma[1])) return PETSC_FALSE;
  while (c > text && isdigit((unsigned char)c[-1])) c--;
  if (c > text && (c[-1] == '-' || c[-1] == '+')) c--;
  return (PetscBool)(c - 1 <= text || tolower((unsigned char)c[-1]) != 'e' || !isdigit((unsigned char)c[-2]));
}

void ExpressionSuggestPoint(const char text[], PetscInt wanted, char words[], size_t len)
{
  const PetscInt count = ExpressionCountComponents_Private(text);
  const char    *comma = strchr(text, ',');

  words[0] = '\0';
  if (count <= wanted || count > 2 * wanted) return;
  while (comma && !ExpressionIsDecimalComma_Private(text, comma)) comma = strchr(comma + 1, ',');
  if (!comma) return;
  snprintf(words, len, "; the decimal mark is a point, not a comma");
  if (wanted == 1 && strlen(text) < len / 2 && !strchr(text, '.') && !text[strspn(text, "+-,0123456789eE")])
    snprintf(words, len, "; the decimal mark is a point, not a comma: did you mean %.*s.%s?", (int)(comma - text), text,
             comma + 1);
}

static PetscErrorCode ExpressionAllocate_Private(const char option[], const char text[], PetscInt num_components,
                                                 Expression *e)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(e));
  PetscCall(PetscStrallocpy(option, &(*e)->option));
  PetscCall(PetscStrallocpy(text, &(*e)->text));
  PetscCall(PetscCalloc1(num_components, &(*e)->components));
  (*e)->num_components = num_components;
  (*e)->constant       = PETSC_TRUE;
  (*e)->factor         = 1;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Reads all components of the text. [out] complaint - as above */
static PetscErrorCode ExpressionRead_Private(Expression e, PetscBool allow_free, char complaint[], size_t len)
{
  const char *text = e->text;
  char       *part;

  PetscFunctionBeginUser;
  for (PetscInt c = 0; c < e->num_components && !complaint[0]; c++) {
    const size_t length = ExpressionComponentLength_Private(text);

    PetscCall(ExpressionCopyTrimmed_Private(text, length, &part));
    PetscCall(PetscFPTrapPush(PETSC_FP_TRAP_OFF)); // muParser evaluates constant parts of a formula
    ExpressionReadComponent_Private(e, part, allow_free, &e->components[c], complaint, len);
    PetscCall(PetscFPTrapPop());
    PetscCall(PetscFree(part));
    if (e->components[c].parser) e->constant = PETSC_FALSE;
    text += length + 1;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExpressionCreate(MPI_Comm comm, const char option[], const char text[], PetscInt num_components,
                                PetscBool allow_free, Expression *e)
{
  const PetscInt count          = ExpressionCountComponents_Private(text);
  char           complaint[512] = "", shown[TEXT_SHOWN], point[128];

  PetscFunctionBeginUser;
  *e = NULL;
  if (num_components && count != num_components) {
    ExpressionSuggestPoint(text, num_components, point, sizeof(point));
    if (ExpressionIsOpen_Private(text)) snprintf(point, sizeof(point), "; a parenthesis is not closed");
    PetscCall(UserErrorRaise(comm, "%s \"%s\": %" PetscInt_FMT " component%s given, %" PetscInt_FMT " wanted%s%s",
                             option, ExpressionShortenText_Private(text, shown), count, count == 1 ? "" : "s",
                             num_components, num_components == 1 ? "" : ", separated by commas", point));
  }
  PetscCall(ExpressionAllocate_Private(option, text, count, e));
  PetscCall(ExpressionRead_Private(*e, allow_free, complaint, sizeof(complaint)));
  if (complaint[0]) {
    char sentence[USER_ERROR_LENGTH];

    snprintf(sentence, sizeof(sentence), "%s \"%s\": %s; accepted are numbers and formulas in x, y, z, t%s",
             (*e)->option, ExpressionShortenText_Private((*e)->text, shown), complaint,
             allow_free ? ", and 'free'" : "");
    PetscCall(ExpressionDestroy(e));
    PetscCall(UserErrorRaise(comm, "%s", sentence));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExpressionCreateSwitches(Expression e, Expression *switches)
{
  char  complaint[512] = "";
  char *list;

  PetscFunctionBeginUser;
  *switches = NULL;
  PetscCall(SwitchingFunctions(e->text, &list));
  if (!list) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ExpressionAllocate_Private(e->option, list, ExpressionCountComponents_Private(list), switches));
  PetscCall(PetscFree(list));
  (*switches)->meridian = e->meridian;
  PetscCall(ExpressionRead_Private(*switches, PETSC_FALSE, complaint, sizeof(complaint)));
  if (complaint[0] || (*switches)->constant) PetscCall(ExpressionDestroy(switches)); // never zero, or not readable
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExpressionDestroy(Expression *e)
{
  PetscFunctionBeginUser;
  if (!*e) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt c = 0; c < (*e)->num_components; c++)
    if ((*e)->components[c].parser) mupRelease((*e)->components[c].parser);
  PetscCall(PetscFree((*e)->components));
  PetscCall(PetscFree((*e)->option));
  PetscCall(PetscFree((*e)->text));
  PetscCall(PetscFree(*e));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void ExpressionNameMeridian(Expression e)
{
  e->meridian = PETSC_TRUE;
}

void ExpressionSetTime(PetscReal t)
{
  time_value = t;
}

void ExpressionSetFactor(Expression e, PetscReal factor)
{
  e->factor = factor;
}

PetscBool ExpressionNames(Expression e, const char name[])
{
  for (PetscInt c = 0; c < e->num_components; c++) {
    const muParserHandle_t parser = e->components[c].parser;
    const int              num    = parser ? mupGetExprVarNum(parser) : 0;

    for (int v = 0; v < num; v++) {
      const muChar_t *used;
      muFloat_t      *bound;

      mupGetExprVar(parser, (unsigned)v, &used, &bound);
      if (!strcmp(used, name)) return PETSC_TRUE;
    }
  }
  return PETSC_FALSE;
}

/* --- asking --------------------------------------------------------------------------------------------- */

PetscInt ExpressionSize(Expression e)
{
  return e->num_components;
}

PetscBool ExpressionIsConstant(Expression e)
{
  return e->constant;
}

PetscBool ExpressionIsFree(Expression e, PetscInt c)
{
  return e->components[c].free;
}

const char *ExpressionOption(Expression e)
{
  return e->option;
}

const char *ExpressionText(Expression e)
{
  return e->text;
}

/* --- evaluating ----------------------------------------------------------------------------------------- */

PetscErrorCode ExpressionEvaluate(Expression e, PetscInt dim, const PetscReal x[], PetscReal values[])
{
  PetscFunctionBeginUser;
  if (!e->constant)
    for (PetscInt d = 0; d < 3; d++) e->x[d] = d < dim ? x[d] : 0;
  if (e->meridian) e->x[2] = e->x[1];
  if (!e->constant)
    PetscCall(PetscFPTrapPush(PETSC_FP_TRAP_OFF)); // a formula may divide by zero: the caller checks the value
  for (PetscInt c = 0; c < e->num_components; c++) {
    Component *component = &e->components[c];

    values[c] = e->factor * (component->parser ? mupEval(component->parser) : component->number);
    if (!component->parser || !PetscIsInfOrNanReal(values[c]) || e->failed) continue;
    e->failed           = PETSC_TRUE;
    e->failed_component = c;
    e->failed_dim       = dim;
    e->failed_t         = time_value;
    PetscCall(PetscArraycpy(e->failed_x, e->x, 3));
  }
  if (!e->constant) PetscCall(PetscFPTrapPop());
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExpressionComponent(Expression e, PetscInt c, PetscInt dim, const PetscReal x[], PetscReal *value)
{
  PetscFunctionBeginUser;
  for (PetscInt d = 0; d < 3; d++) e->x[d] = d < dim ? x[d] : 0;
  if (e->meridian) e->x[2] = e->x[1];
  PetscCall(PetscFPTrapPush(PETSC_FP_TRAP_OFF));
  *value = e->components[c].parser ? mupEval(e->components[c].parser) : e->components[c].number;
  PetscCall(PetscFPTrapPop());
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExpressionTry(Expression e, PetscInt dim, const PetscReal x[], PetscReal values[], PetscBool *finite)
{
  const PetscBool failed = e->failed;

  PetscFunctionBeginUser;
  PetscCall(ExpressionEvaluate(e, dim, x, values));
  *finite = PETSC_TRUE;
  for (PetscInt c = 0; c < e->num_components; c++) *finite = (PetscBool)(*finite && !PetscIsInfOrNanReal(values[c]));
  e->failed = failed;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExpressionCheck(MPI_Comm comm, Expression e)
{
  char sentence[USER_ERROR_LENGTH] = "", point[128], moment[64] = "", shown[TEXT_SHOWN];

  PetscFunctionBeginUser;
  if (!e || e->constant) PetscFunctionReturn(PETSC_SUCCESS);
  if (e->failed) {
    const PetscReal *x = e->failed_x;

    if (e->failed_dim == 1)
      snprintf(point, sizeof(point), "%g", (double)x[0]);
    else if (e->failed_dim == 2)
      snprintf(point, sizeof(point), "(%g, %g)", (double)x[0], (double)x[1]);
    else
      snprintf(point, sizeof(point), "(%g, %g, %g)", (double)x[0], (double)x[1], (double)x[2]);
    if (ExpressionNames(e, "t")) snprintf(moment, sizeof(moment), ", t = %g", (double)e->failed_t);
    snprintf(sentence, sizeof(sentence), "%s \"%s\": component %" PetscInt_FMT " is not a finite number at %s%s",
             e->option, ExpressionShortenText_Private(e->text, shown), e->failed_component + 1, point, moment);
  }
  e->failed = PETSC_FALSE;
  PetscCall(UserErrorCheck(comm, sentence));
  PetscFunctionReturn(PETSC_SUCCESS);
}
