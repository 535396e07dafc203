/* switching.c -- finds the conditions by which a formula may jump or bend.

   A formula is a smooth function between zeros of its switching functions. Conditions and arguments are parts
   of the text, so that these functions are formulas as well. Operators that bind less than comparisons end an
   operand: ? : && || and commas. */
#include "base/compat.h"
#include "base/switching.h"
#include <ctype.h>
#include <string.h>

enum { MAX_ARGUMENTS = 16, MAX_SWITCHES = 16, MAX_NESTING = 64 /* of parentheses */ };

/* A part of the text. */
typedef struct {
  const char *begin, *end;
} Part;

typedef struct {
  char     *item[MAX_SWITCHES];
  PetscInt  num, nesting;
  PetscBool full; /* there are more, or they are not all known */
} Switches;

static PetscErrorCode SwitchesScan_Private(Switches *switches, Part part);

static Part PartTrim_Private(Part part)
{
  while (part.begin < part.end && isspace((unsigned char)part.begin[0])) part.begin++;
  while (part.begin < part.end && isspace((unsigned char)part.end[-1])) part.end--;
  return part;
}

/* Adds head, the first part, with a second one `)-(` and that, and tail, unless it is there already. */
static PetscErrorCode SwitchesAdd_Private(Switches *switches, const char head[], Part given, const Part *second,
                                          const char tail[])
{
  const Part   first = PartTrim_Private(given), last = second ? PartTrim_Private(*second) : (Part){NULL, NULL};
  const size_t length = (size_t)(first.end - first.begin) + (size_t)(last.end - last.begin) + 32;
  char        *text;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(length, &text));
  snprintf(text, length, "%s%.*s%s%.*s%s", head, (int)(first.end - first.begin), first.begin, second ? ")-(" : "",
           (int)(last.end - last.begin), second ? last.begin : "", tail);
  for (PetscInt i = 0; i < switches->num && text; i++)
    if (!strcmp(switches->item[i], text)) PetscCall(PetscFree(text));
  if (text && switches->num == MAX_SWITCHES) switches->full = PETSC_TRUE;
  if (text && !switches->full)
    switches->item[switches->num++] = text;
  else
    PetscCall(PetscFree(text));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The first character outside parentheses that is one of stops, or the end. */
static const char *PartFind_Private(Part part, const char stops[])
{
  PetscInt depth = 0;

  for (const char *t = part.begin; t < part.end; t++) {
    if (!depth && strchr(stops, *t)) return t;
    depth += (*t == '(') - (*t == ')');
  }
  return part.end;
}

/* Adds those of a call, and of its arguments. [in] name - empty for parentheses that are no call */
static PetscErrorCode SwitchesScanCall_Private(Switches *switches, Part name, Part inside)
{
  static const char *const bends[] = {"abs", "sign", "atan2"};
  Part                     argument[MAX_ARGUMENTS];
  PetscInt                 num = 0;
  char                     word[8];

  PetscFunctionBeginUser;
  for (const char *begin = inside.begin; begin <= inside.end && !switches->full; num++) {
    if (num == MAX_ARGUMENTS) {
      switches->full = PETSC_TRUE;
      PetscFunctionReturn(PETSC_SUCCESS);
    }
    argument[num].begin = begin;
    argument[num].end   = PartFind_Private((Part){begin, inside.end}, ",");
    begin               = argument[num].end + 1;
    PetscCall(SwitchesScan_Private(switches, argument[num]));
  }
  snprintf(word, sizeof(word), "%.*s", (int)(name.end - name.begin), name.begin);
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(bends); i++)
    if (!strcmp(word, bends[i])) PetscCall(SwitchesAdd_Private(switches, "(", argument[0], NULL, ")"));
  if (!strcmp(word, "rint")) PetscCall(SwitchesAdd_Private(switches, "cos(pi*(", argument[0], NULL, "))"));
  if (strcmp(word, "max") != 0 && strcmp(word, "min") != 0) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt i = 0; i < num; i++)
    for (PetscInt j = 0; j < i; j++) PetscCall(SwitchesAdd_Private(switches, "(", argument[j], &argument[i], ")"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds those of the parentheses in an operand. */
static PetscErrorCode SwitchesScanOperand_Private(Switches *switches, Part part)
{
  PetscFunctionBeginUser;
  while (part.begin < part.end) {
    const char *open = PartFind_Private(part, "("), *name = open;
    Part        inside = {open + 1, open + 1};

    if (open == part.end) break;
    while (name > part.begin && (isalnum((unsigned char)name[-1]) || name[-1] == '_')) name--;
    inside.end = PartFind_Private((Part){open + 1, part.end}, ")");
    PetscCall(SwitchesScanCall_Private(switches, (Part){name, open}, inside));
    part.begin = inside.end + 1;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds a - b for every a < b, a <= b, a > b, a >= b. Comparisons associate to the left: a is the whole part
   before. Equality has no area, and is ignored. */
static PetscErrorCode SwitchesScanComparisons_Private(Switches *switches, Part part)
{
  Part operand = part;

  PetscFunctionBeginUser;
  while (operand.begin <= part.end) {
    const char *stop = PartFind_Private((Part){operand.begin, part.end}, "<>=!");
    const Part  left = {part.begin, stop};

    operand.end = stop;
    PetscCall(SwitchesScanOperand_Private(switches, operand));
    if (stop == part.end) break;
    operand.begin = stop + (stop + 1 < part.end && stop[1] == '=' ? 2 : 1);
    operand.end   = PartFind_Private((Part){operand.begin, part.end}, "<>=!");
    if (*stop == '<' || *stop == '>') PetscCall(SwitchesAdd_Private(switches, "(", left, &operand, ")"));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode SwitchesScan_Private(Switches *switches, Part part)
{
  PetscFunctionBeginUser;
  if (++switches->nesting > MAX_NESTING) switches->full = PETSC_TRUE;
  while (part.begin <= part.end && !switches->full) {
    const Part operand = {part.begin, PartFind_Private(part, "?:&|,")};

    PetscCall(SwitchesScanComparisons_Private(switches, operand));
    part.begin = operand.end + 1;
  }
  switches->nesting--;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SwitchingFunctions(const char text[], char **list)
{
  Switches switches = {.num = 0};
  size_t   length   = 1;

  PetscFunctionBeginUser;
  *list = NULL;
  PetscCall(SwitchesScan_Private(&switches, (Part){text, text + strlen(text)}));
  for (PetscInt i = 0; i < switches.num; i++) length += strlen(switches.item[i]) + 1;
  if (switches.num && !switches.full) PetscCall(PetscMalloc1(length, list));
  for (PetscInt i = 0, end = 0; i < switches.num; i++) {
    if (*list) end += snprintf(*list + end, length - (size_t)end, "%s%s", i ? "," : "", switches.item[i]);
    PetscCall(PetscFree(switches.item[i]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
