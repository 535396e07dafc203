/* usererror.c -- one sentence for a user's mistake, without other messages.

   PETSc reports an error by calling the topmost handler once where it arises (PETSC_ERROR_INITIAL) and once
   more in each caller up to main() (PETSC_ERROR_REPEAT). The handler returns the code for the callers. So a
   handler can both be silent and change one code into another: PETSc's errors about options become user
   errors. */
#include "base/compat.h"
#include "base/usererror.h"
#include "base/interrupt.h"
#include <ctype.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum { VALUE_LENGTH = 256 }; /* what is shown of a value */
enum { MPI_SECONDS = 5 };    /* limit for MPI to end the other ranks: this process may be damaged */

static char      last_sentence[USER_ERROR_LENGTH];
static PetscBool quiet, installed; /* whether stderr is left alone; whether the handler is below all others */
static PetscBool muted, waiting;   /* UserErrorMute(); whether this rank has a sentence that is not printed */

const char *UserErrorSentence(void)
{
  return last_sentence;
}

static void UserErrorPrint_Private(void)
{
  fflush(stdout); // what was printed before the mistake stands before it
  fprintf(stderr, "mortise: %s\n", last_sentence);
  fflush(stderr);
}

/* Keeps the sentence. The first rank of comm prints it, in one write so that ranks' lines do not mix. Calls
   of the library may come before MPI has begun, or after its end. */
static void UserErrorTell_Private(MPI_Comm comm, const char sentence[])
{
  int rank = 0, begun, ended;

  snprintf(last_sentence, sizeof(last_sentence), "%s", sentence);
  MPI_Initialized(&begun);
  MPI_Finalized(&ended);
  if (begun && !ended) MPI_Comm_rank(comm, &rank);
  if (rank || quiet) return;
  if (muted)
    waiting = PETSC_TRUE;
  else
    UserErrorPrint_Private();
}

/* Whether an error of PETSc is about the user's input. These are errors while it reads options, and unknown
   names of a type, of a file, or of a solver for this kind of matrix. All such names come from options. */
static PetscBool UserErrorIsOption_Private(const char function[], PetscErrorCode code)
{
  if (code == PETSC_ERR_ARG_UNKNOWN_TYPE || code == PETSC_ERR_FILE_OPEN || code == PETSC_ERR_MISSING_FACTOR)
    return PETSC_TRUE;
  if (!function || code == PETSC_ERR_MEM) return PETSC_FALSE;
  return strstr(function, "PetscOptions") == function || strstr(function, "SetFromOptions") ? PETSC_TRUE : PETSC_FALSE;
}

/* Whether the message quotes the first length letters of text, in either case, as a word of its own. */
static PetscBool UserErrorQuotesText_Private(const char message[], const char text[], size_t length)
{
  static const char inside[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_+-.";

  for (const char *m = message; length && *m; m++) {
    if (strncasecmp(m, text, length) || (m > message && strchr(inside, m[-1]))) continue;
    if (!m[length] || !strchr(inside, m[length]) || !m[length + 1] || m[length + 1] == ' ')
      return PETSC_TRUE; // or a full stop
  }
  return PETSC_FALSE;
}

/* As above for any item of a list: PETSc reads it item by item. */
static PetscBool UserErrorQuotesItem_Private(const char message[], const char list[])
{
  for (size_t length = strcspn(list, ",:");; list += length + 1, length = strcspn(list, ",:")) {
    if (UserErrorQuotesText_Private(message, list, length)) return PETSC_TRUE;
    if (!list[length]) return PETSC_FALSE;
  }
}

/* Whether the message is of PETSc's reader of YAML, and the option gives it something to read. */
static PetscBool UserErrorIsYAML_Private(const char message[], const char option[])
{
  return (PetscBool)(strstr(message, "YAML") &&
                     (!strcasecmp(option, "-options_file_yaml") || !strcasecmp(option, "-options_string_yaml")));
}

/* The place in the argument list of the one option whose name or value the message quotes; 0 if none, or not
   one alone. */
static int UserErrorFindOption_Private(const char message[], int num, char *const arguments[])
{
  int found = 0;

  for (int a = 1; a < num; a++) {
    PetscBool name = PETSC_FALSE, next_name = PETSC_TRUE;

    (void)PetscOptionsValidKey(arguments[a], &name);
    if (a + 1 < num) (void)PetscOptionsValidKey(arguments[a + 1], &next_name);
    if (!name) continue;
    if (!UserErrorIsYAML_Private(message, arguments[a]) &&
        !UserErrorQuotesText_Private(message, arguments[a], strlen(arguments[a])) &&
        (next_name || !UserErrorQuotesItem_Private(message, arguments[a + 1])))
      continue;
    if (found) return 0;
    found = a;
  }
  return found;
}

/* PETSc's complaint with the option that it is about, which PETSc itself does not always name. */
static PetscErrorCode UserErrorFromPETSc_Private(const char message[])
{
  char   sentence[USER_ERROR_LENGTH], value[VALUE_LENGTH] = "";
  char **arguments;
  int    num, option, length = (int)strcspn(message, "\n"); // the rest is advice on installing packages

  while (length && (isspace((unsigned char)message[length - 1]) || message[length - 1] == '.')) length--;
  option = PetscGetArgs(&num, &arguments) ? 0 : UserErrorFindOption_Private(message, num, arguments);
  if (option && UserErrorIsYAML_Private(message, arguments[option]) && option + 1 < num)
    snprintf(value, sizeof(value), " \"%.200s\"", arguments[option + 1]);
  if (option)
    snprintf(sentence, sizeof(sentence), "%s%s: PETSc says: %.*s", arguments[option], value, length, message);
  else
    snprintf(sentence, sizeof(sentence), "an option has a value that PETSc cannot use: %.*s", length, message);
  UserErrorTell_Private(MPI_COMM_WORLD, sentence); // options are the same on all ranks
  return MORTISE_ERR_USER;
}

/* Whether PETSc's table of options is full, which it reports as a lack of memory. */
static PetscBool UserErrorIsTable_Private(const char function[], PetscErrorCode code, PetscErrorType type)
{
  return code == PETSC_ERR_MEM && type == PETSC_ERROR_INITIAL && function &&
                 strstr(function, "PetscOptionsSetValue") == function
             ? PETSC_TRUE
             : PETSC_FALSE;
}

/* Whether memory ran out; PETSc 3.18 raises this without its code, and with the wrong text. */
static PetscBool UserErrorIsMemory_Private(const char function[], PetscErrorCode code, PetscErrorType type)
{
  if (code == PETSC_ERR_MEM) return PETSC_TRUE;
  return type == PETSC_ERROR_INITIAL && function &&
                 (!strcmp(function, "PetscMallocAlign") || !strcmp(function, "PetscReallocAlign"))
             ? PETSC_TRUE
             : PETSC_FALSE;
}

/* Says that memory ran out: on this rank, since another one may have enough, unless all of comm say it. */
static void UserErrorTellMemory_Private(MPI_Comm comm)
{
  char place[32] = "";
  int  rank, size = 1;

  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  snprintf(place, sizeof(place), " on rank %d", rank);
  if (comm != MPI_COMM_NULL && comm != MPI_COMM_SELF) MPI_Comm_size(comm, &size);
  if (size > 1) {
    MPI_Comm_rank(comm, &rank);
    if (rank) return;
    place[0] = '\0';
  }
  fflush(stdout);
  fprintf(stderr,
          "mortise: out of memory%s; a coarser mesh, more ranks or an iterative solver (-pc_type truncatedmg) "
          "need less\n",
          place);
}

static PetscErrorCode UserErrorHandlerFn(MPI_Comm comm, int line, const char *function, const char *file,
                                         PetscErrorCode code, PetscErrorType type, const char *message, void *context)
{
  if (code == MORTISE_ERR_USER) return code;
  if (type == PETSC_ERROR_INITIAL && message && UserErrorIsOption_Private(function, code))
    return UserErrorFromPETSc_Private(message);
  if (UserErrorIsTable_Private(function, code, type)) {
    UserErrorTell_Private(MPI_COMM_WORLD, "PETSc takes some 500 options, and there are more; join sides that have the "
                                          "same data with '+', and omit defaults");
    return MORTISE_ERR_USER;
  }
  if (UserErrorIsMemory_Private(function, code, type)) {
    if (type == PETSC_ERROR_INITIAL) UserErrorTellMemory_Private(comm);
    return PETSC_ERR_MEM;
  }
  if (code == PETSC_ERR_FILE_WRITE) {
    if (type == PETSC_ERROR_INITIAL && message) UserErrorTell_Private(comm, message);
    return code;
  }
  return PetscTraceBackErrorHandler(comm, line, function, file, code, type, message, context);
}

static void UserErrorAlarmFn(int number)
{
  (void)number;
  _exit(MORTISE_FAILED);
}

/* Ends all ranks at once, whatever state this one is in: MPI may wait for a lock that is never given back. */
static void UserErrorEnd_Private(void)
{
  int size;

  (void)signal(SIGALRM, UserErrorAlarmFn);
  (void)alarm(MPI_SECONDS);
  InterruptCleanUp();
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (size > 1) MPI_Abort(MPI_COMM_WORLD, MORTISE_FAILED);
  _exit(MORTISE_FAILED);
}

/* A signal is a failure of the program: other ranks cannot be notified, so all are ended. */
static PetscErrorCode UserErrorSignalFn(int number, void *context)
{
  int rank;

  (void)context;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  fprintf(stderr, "mortise: the program failed on rank %d: %s\n", rank, strsignal(number));
  UserErrorEnd_Private();
  return 0;
}

/* abort() by a library; PETSc does not handle this signal. */
static void UserErrorAbortFn(int number)
{
  (void)UserErrorSignalFn(number, NULL);
}

/* Signals of InterruptBegin() that PETSc would take, too. A caller may ignore them, as nohup does. */
static const int shared[] = {SIGPIPE, SIGHUP, SIGQUIT};
enum { NUM_SHARED = sizeof(shared) / sizeof(shared[0]) };
static struct sigaction before[NUM_SHARED];

/* Installs or removes PETSc's handler, and leaves these signals as they were before it. They wait while PETSc
   has them. */
static PetscErrorCode UserErrorSetHandler_Private(PetscBool on)
{
  sigset_t blocked, mask;

  PetscFunctionBeginUser;
  (void)sigemptyset(&blocked);
  for (int s = 0; s < NUM_SHARED; s++) {
    (void)sigaddset(&blocked, shared[s]);
    if (on) (void)sigaction(shared[s], NULL, &before[s]);
  }
  (void)sigprocmask(SIG_BLOCK, &blocked, &mask);
  PetscCall(on ? PetscPushSignalHandler(UserErrorSignalFn, NULL) : PetscPopSignalHandler());
  for (int s = 0; s < NUM_SHARED; s++) (void)sigaction(shared[s], &before[s], NULL);
  (void)sigprocmask(SIG_SETMASK, &mask, NULL);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode UserErrorCatchSignals(void)
{
  PetscFunctionBeginUser;
  PetscCall(UserErrorSetHandler_Private(PETSC_TRUE));
  (void)signal(SIGABRT, UserErrorAbortFn);
  (void)signal(SIGXFSZ, SIG_IGN); // writing beyond a limit then fails like writing to a full disk
  PetscCall(InterruptBegin());
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode UserErrorReleaseSignals(void)
{
  PetscFunctionBeginUser;
  PetscCall(UserErrorSetHandler_Private(PETSC_FALSE));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void UserErrorEndMemory(void)
{
  UserErrorTellMemory_Private(MPI_COMM_SELF);
  UserErrorEnd_Private();
}

PetscErrorCode UserErrorInitialize(void)
{
  PetscBool begun;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialized(&begun));
  PetscCall(PetscPushErrorHandler(UserErrorHandlerFn, NULL));
  installed = PETSC_TRUE;
  if (begun)
    PetscCall(
        PetscRegisterFinalize(PetscPopErrorHandler)); // before PetscInitialize() it is not in PETSc's list of memory
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode UserErrorEnter(void)
{
  PetscFunctionBeginUser;
  PetscCall(PetscPushErrorHandler(UserErrorHandlerFn, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode UserErrorLeave(void)
{
  PetscFunctionBeginUser;
  PetscCall(PetscPopErrorHandler());
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Only PETSc knows the handler before this one: it is called while this one is removed. */
static PetscErrorCode SilentHandlerFn(MPI_Comm comm, int line, const char *function, const char *file,
                                      PetscErrorCode code, PetscErrorType type, const char *message, void *context)
{
  PetscErrorCode answer;

  if (code == MORTISE_ERR_USER) return code;
  if (installed) return PetscTraceBackErrorHandler(comm, line, function, file, code, type, message, context);
  (void)PetscPopErrorHandler();
  answer = PetscError(comm, line, function, file, code, type, "%s", message ? message : "");
  (void)PetscPushErrorHandler(SilentHandlerFn, NULL);
  return answer;
}

PetscErrorCode UserErrorSilence(void)
{
  PetscFunctionBeginUser;
  PetscCall(PetscPushErrorHandler(SilentHandlerFn, NULL));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode UserErrorUnsilence(void)
{
  PetscFunctionBeginUser;
  PetscCall(PetscPopErrorHandler());
  PetscFunctionReturn(PETSC_SUCCESS);
}

void UserErrorSetQuiet(PetscBool on)
{
  quiet = on;
}

void UserErrorMute(void)
{
  muted   = PETSC_TRUE;
  waiting = PETSC_FALSE;
}

void UserErrorUnmute(PetscBool print)
{
  muted = PETSC_FALSE;
  if (print && waiting) UserErrorPrint_Private();
}

PetscErrorCode UserErrorRaise(MPI_Comm comm, const char format[], ...)
{
  char    sentence[USER_ERROR_LENGTH];
  va_list arguments;

  va_start(arguments, format);
  vsnprintf(sentence, sizeof(sentence), format, arguments);
  va_end(arguments);
  UserErrorTell_Private(comm, sentence);
  return MORTISE_ERR_USER;
}

PetscErrorCode UserErrorCheck(MPI_Comm comm, const char sentence[])
{
  char text[USER_ERROR_LENGTH] = "";
  int  rank, size, speaker;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  speaker = sentence && sentence[0] ? rank : size;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &speaker, 1, MPI_INT, MPI_MIN, comm));
  if (speaker == size) PetscFunctionReturn(PETSC_SUCCESS);
  if (rank == speaker) snprintf(text, sizeof(text), "%s", sentence);
  PetscCallMPI(MPI_Bcast(text, USER_ERROR_LENGTH, MPI_CHAR, speaker, comm));
  PetscCall(UserErrorRaise(comm, "%s", text));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Levenshtein's distance, the least number of letters inserted, deleted or exchanged, ignoring case. One row
   of the table at a time: distance[j] belongs to the first i letters of a and the first j of b.
   [in] distance - workspace [length of b + 1] */
static size_t UserErrorEditDistance_Private(const char a[], const char b[], size_t distance[])
{
  const size_t length_a = strlen(a), length_b = strlen(b);

  for (size_t j = 0; j <= length_b; j++) distance[j] = j;
  for (size_t i = 1; i <= length_a; i++) {
    size_t diagonal = distance[0];

    distance[0] = i;
    for (size_t j = 1; j <= length_b; j++) {
      const size_t above    = distance[j];
      const size_t exchange = diagonal + (tolower((unsigned char)a[i - 1]) != tolower((unsigned char)b[j - 1]));

      distance[j] = PetscMin(exchange, 1 + PetscMin(above, distance[j - 1]));
      diagonal    = above;
    }
  }
  return distance[length_b];
}

const char *UserErrorNearest(const char misspelt[], PetscInt num_names, const char *const names[])
{
  const char *nearest = NULL;
  size_t      longest = 0, least, *workspace;

  for (PetscInt n = 0; n < num_names; n++) longest = PetscMax(longest, strlen(names[n]));
  workspace = malloc((longest + 1) * sizeof(*workspace));
  if (!workspace) return NULL;
  least = PetscMin((strlen(misspelt) + 2) / 3 + 1,
                   strlen(misspelt)); // with more than a third of the letters wrong it is another word
  for (PetscInt n = 0; n < num_names; n++) {
    const size_t distance = UserErrorEditDistance_Private(misspelt, names[n], workspace);

    if (distance >= least) continue;
    least   = distance;
    nearest = names[n];
  }
  free(workspace);
  return nearest;
}
