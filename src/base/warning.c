/* warning.c -- one list of warnings, kept as the JSON that the summary will have. */
#include "base/compat.h"
#include "base/json.h"
#include "base/warning.h"
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { TEXT_LENGTH = 2048, LABEL_LENGTH = 64 };

static const char GRAVE[] = "grave", LABEL[] = "label"; /* keys of a warning within this file alone */
static const char ACCEPTED[] = "accepted";

/* All codes, as the table of options/GUIDE.md has them. */
static const char *const CODES[] = {
    "coarse_contact",    "coarse_curve",    "coarse_file",        "coarse_mesh",     "decimal_comma",
    "edge_pressure",     "far_motion",      "free_motion",        "gap_jump",        "held_friction",
    "hidden_contact",    "hinged_parts",    "idle_gap",           "inf_sup_unknown", "large_friction",
    "loaded_contact",    "lost_traction",   "marginal",           "mixed_units",     "model_limit",
    "no_load",           "no_partner",      "not_confirmed",      "not_monotone",    "not_unique",
    "nothing_to_decide", "open_contact",    "overlapping_bodies", "repeated_option", "rough_load",
    "skipped_run",       "slow_solver",     "solver_replaced",    "tied_gap",        "unbalanced_loads",
    "uneven_pressure",   "unjoined_pieces", "unused_option",
};

/* On the first rank only, except for the flags. */
static struct {
  cJSON    *common, *run, *told; /* of all runs, of this one, all lines that were printed; NULL while empty */
  cJSON    *retained;            /* of runs before this one, while lines wait, each with its label */
  char      label[LABEL_LENGTH];
  PetscBool within, quiet; /* within a run */
  PetscBool held;          /* lines wait for the last run */
  int       before;        /* `ended` when they began to */
  int       muted, ended;  /* how often; warnings of runs that have ended */
  int       marked;        /* warnings of the run that are of all its solutions */
  uint64_t  accepted;      /* bit k: CODES[k] was expected by the user */
} book;

_Static_assert(sizeof(CODES) / sizeof(*CODES) <= 64, "one bit for each code");

const char *const *WarningCodes(PetscInt *num)
{
  *num = (PetscInt)(sizeof(CODES) / sizeof(*CODES));
  return CODES;
}

static PetscBool WarningIsAccepted_Private(const char code[])
{
  for (size_t k = 0; k < sizeof(CODES) / sizeof(*CODES); k++)
    if (!strcmp(CODES[k], code)) return (PetscBool)(book.accepted >> k & 1);
  return PETSC_FALSE;
}

/* How many warnings of a list are not accepted. */
static int WarningCount_Private(const cJSON *list)
{
  const cJSON *item;
  int          num = 0;

  cJSON_ArrayForEach(item, list) num += !cJSON_HasObjectItem(item, ACCEPTED);
  return num;
}

static void WarningReset_Private(cJSON **list)
{
  cJSON_Delete(*list);
  *list = NULL;
}

/* Whether a list has it already. */
static PetscBool WarningIsListed_Private(const cJSON *list, const cJSON *one)
{
  const cJSON *item;

  cJSON_ArrayForEach(item, list)
  {
    if (cJSON_Compare(item, one, cJSON_True)) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

static void WarningAppend_Private(cJSON **list, cJSON *one)
{
  if (!*list) *list = cJSON_CreateArray();
  cJSON_AddItemToArray(*list, one);
}

/* Prints a line, once in the life of the program; of several runs, the first with this warning of a body or
   pair prints it. */
static void WarningPrint_Private(const Warning *about, const char text[])
{
  const PetscBool several = (PetscBool)(book.within && book.label[0]);
  const char     *who     = about->body ? about->body : about->pair ? about->pair : "";
  char            key[TEXT_LENGTH + 256];
  cJSON          *line;

  if (book.quiet || book.held || WarningIsAccepted_Private(about->code)) return;
  (void)snprintf(key, sizeof(key), "%s %s %d %s", about->code, who, about->grave, several ? "" : text);
  line = cJSON_CreateString(key);
  if (WarningIsListed_Private(book.told, line)) {
    cJSON_Delete(line);
    return;
  }
  WarningAppend_Private(&book.told, line);
  (void)fflush(stdout); // what was printed before stands before it
  fprintf(stderr, "mortise: warning: %s%s%s%s%s [%s]\n", several ? book.label : "", several ? ": " : "", text,
          about->advice ? "; " : "", about->advice ? about->advice : "", about->code);
}

static cJSON *WarningCreate_Private(const Warning *about, const char text[])
{
  cJSON *one = cJSON_CreateObject();

  cJSON_AddStringToObject(one, "code", about->code);
  cJSON_AddStringToObject(one, "text", text);
  if (about->body) cJSON_AddStringToObject(one, "body", about->body);
  if (about->pair) cJSON_AddStringToObject(one, "pair", about->pair);
  if (about->dim)
    JSONAddReals(one, "at", about->dim, about->at);
  else
    cJSON_AddNullToObject(one, "at");
  cJSON_AddItemToObject(one, "advice", about->advice ? cJSON_CreateString(about->advice) : cJSON_CreateNull());
  if (WarningIsAccepted_Private(about->code)) cJSON_AddTrueToObject(one, ACCEPTED);
  if (about->grave) cJSON_AddTrueToObject(one, GRAVE);
  return one;
}

/* A copy for the summary, without private keys. */
static cJSON *WarningDuplicate_Private(const cJSON *item)
{
  cJSON *one = cJSON_Duplicate(item, cJSON_True);

  cJSON_DeleteItemFromObject(one, GRAVE);
  return one;
}

PetscErrorCode WarningAdd(const Warning *about, const char format[], ...)
{
  char        text[TEXT_LENGTH];
  cJSON      *one;
  va_list     arguments;
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(MPI_COMM_WORLD, &rank));
  if (rank || book.muted) PetscFunctionReturn(PETSC_SUCCESS);
  va_start(arguments, format);
  (void)vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  one = WarningCreate_Private(about, text);
  if (WarningIsListed_Private(book.common, one) || WarningIsListed_Private(book.run, one)) {
    cJSON_Delete(one);
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  WarningAppend_Private(book.within ? &book.run : &book.common, one);
  WarningPrint_Private(about, text);
  PetscFunctionReturn(PETSC_SUCCESS);
}

void WarningBeginRun(void)
{
  WarningReset_Private(&book.run);
  book.within = PETSC_TRUE;
  book.muted  = 0;
  book.marked = 0;
}

void WarningMark(void)
{
  book.marked = cJSON_GetArraySize(book.run);
}

void WarningBeginAgain(void)
{
  while (cJSON_GetArraySize(book.run) > book.marked)
    cJSON_DeleteItemFromArray(book.run, cJSON_GetArraySize(book.run) - 1);
  book.within = PETSC_TRUE;
  book.muted  = 0;
}

void WarningEndRun(void)
{
  if (book.within) book.ended += WarningCount_Private(book.run); // those of a mark once more each time
  book.within = PETSC_FALSE;
}

void WarningSetLabel(const char label[])
{
  (void)snprintf(book.label, sizeof(book.label), "%s", label);
}

void WarningMute(void)
{
  book.muted++;
}

void WarningUnmute(void)
{
  book.muted--;
}

void WarningHold(void)
{
  book.held   = PETSC_TRUE;
  book.before = book.ended;
}

void WarningRetain(void)
{
  const cJSON *item;

  cJSON_ArrayForEach(item, book.run)
  {
    cJSON *one = cJSON_Duplicate(item, cJSON_True);

    cJSON_AddStringToObject(one, LABEL, book.label);
    WarningAppend_Private(&book.retained, one);
  }
}

void WarningForgetRetained(void)
{
  WarningReset_Private(&book.retained);
}

/* Prints the lines of a list that were not printed before. */
static void WarningPrintList_Private(const cJSON *list)
{
  const cJSON *item;

  cJSON_ArrayForEach(item, list)
  {
    const char   *label = cJSON_GetStringValue(cJSON_GetObjectItem(item, LABEL));
    const Warning about = {.code   = cJSON_GetStringValue(cJSON_GetObjectItem(item, "code")),
                           .body   = cJSON_GetStringValue(cJSON_GetObjectItem(item, "body")),
                           .pair   = cJSON_GetStringValue(cJSON_GetObjectItem(item, "pair")),
                           .advice = cJSON_GetStringValue(cJSON_GetObjectItem(item, "advice")),
                           .grave  = (PetscBool)cJSON_HasObjectItem(item, GRAVE)};

    if (label) WarningSetLabel(label);
    WarningPrint_Private(&about, cJSON_GetStringValue(cJSON_GetObjectItem(item, "text")));
  }
}

void WarningRelease(void)
{
  book.held  = PETSC_FALSE;
  book.ended = book.before + WarningCount_Private(book.retained ? book.retained : book.run);
  WarningPrintList_Private(book.common);
  book.within = PETSC_TRUE; // its lines have its label
  if (book.retained)
    WarningPrintList_Private(book.retained);
  else
    WarningPrintList_Private(book.run);
  WarningForgetRetained();
  book.within = PETSC_FALSE;
}

void WarningSetQuiet(PetscBool quiet)
{
  book.quiet = quiet;
}

void WarningSetAccepted(uint64_t codes)
{
  book.accepted = codes;
}

PetscErrorCode WarningNum(MPI_Comm comm, PetscInt *num)
{
  int count = WarningCount_Private(book.common) + book.ended + (book.within ? WarningCount_Private(book.run) : 0);

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_INT, MPI_MAX, comm));
  *num = count;
  PetscFunctionReturn(PETSC_SUCCESS);
}

cJSON *WarningList(void)
{
  cJSON       *all = cJSON_CreateArray();
  const cJSON *item;

  cJSON_ArrayForEach(item, book.common) cJSON_AddItemToArray(all, WarningDuplicate_Private(item));
  cJSON_ArrayForEach(item, book.run) cJSON_AddItemToArray(all, WarningDuplicate_Private(item));
  return all;
}

void WarningListUpdate(cJSON *list)
{
  const cJSON *item;

  cJSON_ArrayForEach(item, book.common)
  {
    cJSON *one = WarningDuplicate_Private(item);

    if (WarningIsListed_Private(list, one))
      cJSON_Delete(one);
    else
      cJSON_AddItemToArray(list, one);
  }
}

void WarningExchange(WarningLists *lists)
{
  const WarningLists mine = {book.common, book.run, book.ended, book.marked, book.quiet, book.accepted};

  book.common   = lists->common;
  book.run      = lists->run;
  book.ended    = lists->ended;
  book.marked   = lists->marked;
  book.quiet    = lists->quiet;
  book.accepted = lists->accepted;
  *lists        = mine;
}

void WarningBreakRun(void)
{
  WarningEndRun();
  WarningForgetRetained();
  book.muted = 0;
  book.held  = PETSC_FALSE;
}

void WarningClear(void)
{
  WarningReset_Private(&book.common);
  WarningReset_Private(&book.run);
  WarningReset_Private(&book.told);
  WarningReset_Private(&book.retained);
  memset(&book, 0, sizeof(book));
}
