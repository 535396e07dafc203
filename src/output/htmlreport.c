/* htmlreport.c -- start of mortise-report, and its messages. */
#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include "output/htmlreport.h"
#include "base/usererror.h"
#include "base/compat.h"
#include "output/fileset.h"

static const char COMPANION[] = "mortise-report";

enum { SAID_LENGTH = 1024 }; /* length of the companion's message: a sentence */

extern char **environ;

/* The task for complete results; first rank only. */
static char      page_prefix[PETSC_MAX_PATH_LEN];
static PetscBool page_quiet;

/* The companion beside this program, else its name alone, which is then looked for in PATH. */
static void HTMLReportFindCompanion_Private(char path[], size_t len)
{
  const ssize_t length = readlink("/proc/self/exe", path, len);
  char         *slash;

  if (length > 0 && (size_t)length + sizeof(COMPANION) < len) {
    path[length] = '\0';
    slash        = strrchr(path, '/');
    if (slash) {
      strcpy(slash + 1, COMPANION);
      if (access(path, X_OK) == 0) return;
    }
  }
  snprintf(path, len, "%s", COMPANION);
}

/* Reads a pipe to its end and keeps the last part, where a trace has its reason, without final blanks. */
static void HTMLReportReadPipe_Private(int pipe_end, char said[], size_t len)
{
  char    rest[SAID_LENGTH];
  size_t  kept = 0;
  ssize_t got;

  while ((got = read(pipe_end, rest, sizeof(rest))) != 0) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) break;
    for (ssize_t i = 0; i < got; i++) {
      if (kept + 1 == len) memmove(said, said + 1, --kept);
      said[kept++] = rest[i];
    }
  }
  while (kept && strchr(" \r\n", said[kept - 1])) --kept;
  said[kept] = '\0';
}

/* Runs the companion to its end on one argument. Returns 0 or errno of its start;
   [out] said - what it printed,
   [out] status - as of waitpid() */
static int HTMLReportRunCompanion_Private(char argument[], char said[], size_t len, int *status)
{
  char                       program[PETSC_MAX_PATH_LEN];
  char                      *arguments[] = {program, argument, NULL};
  int                        ends[2], error;
  pid_t                      child;
  posix_spawn_file_actions_t actions;

  said[0] = '\0';
  HTMLReportFindCompanion_Private(program, sizeof(program));
  if (pipe(ends)) return errno;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  error = posix_spawnp(&child, program, &actions, NULL, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (!error) {
    HTMLReportReadPipe_Private(ends[0], said, len);
    while (waitpid(child, status, 0) < 0) {
      if (errno == EINTR) continue;
      error = errno;
      break;
    }
  }
  close(ends[0]);
  return error;
}

/* Runs the companion; [out] why - one sentence without a full stop if it fails, else "". */
static void HTMLReportCallCompanion_Private(char argument[], char why[], size_t len)
{
  char        said[SAID_LENGTH];
  const char *last;
  int         status = 0, error = HTMLReportRunCompanion_Private(argument, said, sizeof(said), &status);

  why[0] = '\0';
  if (error) {
    snprintf(why, len, "%s cannot be started (%s); put it beside this program or in PATH, and install python3",
             COMPANION, strerror(error));
  } else if (WIFSIGNALED(status)) {
    snprintf(why, len, "%s was ended by a signal (%s)", COMPANION, strsignal(WTERMSIG(status)));
  } else if (WEXITSTATUS(status)) {
    last = strrchr(said, '\n'); // the last line of a trace is its reason
    last = last ? last + 1 : said;
    if (!strncmp(last, COMPANION, strlen(COMPANION))) {
      snprintf(why, len, "%s", last);
    } else {
      snprintf(why, len, "%s failed: %s", COMPANION, last[0] ? last : "it gave no reason");
    }
  }
}

PetscErrorCode HTMLReportCheck(Scene scene)
{
  char check[]                     = "--check", why[SAID_LENGTH + PETSC_MAX_PATH_LEN], path[PETSC_MAX_PATH_LEN],
       sentence[USER_ERROR_LENGTH] = "";
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  page_prefix[0] = '\0';
  if (!scene->report) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCallMPI(MPI_Comm_rank(scene->comm, &rank));
  if (rank == 0) {
    HTMLReportCallCompanion_Private(check, why, sizeof(why));
    if (why[0]) PetscCall(PetscSNPrintf(sentence, sizeof(sentence), "-report: %s", why));
    PetscCall(PetscSNPrintf(page_prefix, sizeof(page_prefix), "%s", scene->output));
    page_quiet = (PetscBool)(scene->quiet || (scene->summary && !strcmp(scene->summary, "-")));
  }
  PetscCall(UserErrorCheck(scene->comm, sentence));
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s.html", scene->output));
  PetscCall(FileSetCheck(scene->comm, "-report", path));
  PetscFunctionReturn(PETSC_SUCCESS);
}

void HTMLReportGiveUp(const char why[])
{
  if (page_prefix[0]) fprintf(stderr, "mortise: -report: no report was written: %s\n", why);
  page_prefix[0] = '\0';
}

PetscBool HTMLReportWrite(void)
{
  char why[SAID_LENGTH + PETSC_MAX_PATH_LEN];

  if (!page_prefix[0]) return PETSC_TRUE;
  HTMLReportCallCompanion_Private(page_prefix, why, sizeof(why));
  if (why[0]) {
    fprintf(stderr, "mortise: -report: %s; all other results are complete\n", why);
    return PETSC_FALSE;
  }
  if (!page_quiet) printf("  wrote %s.html\n", page_prefix);
  return PETSC_TRUE;
}
