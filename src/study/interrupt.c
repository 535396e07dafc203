/* interrupt.c -- see the header. A handler may do next to nothing: the sentence is made beforehand, and said by write(). */
#include "interrupt.h"
#include <mortise/compat.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

enum { SENTENCE_LENGTH = 2048 };

static const int signals[] = {SIGINT, SIGTERM};
enum { NUM_SIGNALS = sizeof(signals) / sizeof(signals[0]) };

static struct {
  volatile sig_atomic_t held, waiting; /* whether signals wait; the one that does */
  volatile sig_atomic_t length;        /* of the sentence */
  int                   rank;
  char                  sentence[SENTENCE_LENGTH];
  struct sigaction      before[NUM_SIGNALS];
} state;

/* Says the sentence and dies of the signal. */
static void Die_Private(int number)
{
  ssize_t done = 0;

  if (!state.rank) done = write(STDERR_FILENO, state.sentence, (size_t)state.length);
  (void)done; // where stderr is closed there is nobody to tell
  (void)signal(number, SIG_DFL);
  (void)raise(number);
}

static void SignalFn(int number)
{
  if (state.held)
    state.waiting = number;
  else
    Die_Private(number);
}

PetscErrorCode InterruptBegin(MPI_Comm comm)
{
  struct sigaction action;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &state.rank));
  state.held = state.waiting = 0;
  (void)memset(&action, 0, sizeof(action));
  action.sa_handler = SignalFn;
  action.sa_flags   = SA_NODEFER; // the signal is raised again by its own handler
  (void)sigemptyset(&action.sa_mask);
  for (int s = 0; s < NUM_SIGNALS; ++s) (void)sigaction(signals[s], &action, &state.before[s]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode InterruptEnd(void)
{
  PetscFunctionBeginUser;
  for (int s = 0; s < NUM_SIGNALS; ++s) (void)sigaction(signals[s], &state.before[s], NULL);
  PetscFunctionReturn(PETSC_SUCCESS);
}

void InterruptHold(void)
{
  state.held = 1;
}

void InterruptRelease(void)
{
  state.held = 0;
  if (state.waiting) Die_Private(state.waiting);
}

void InterruptSetSentence(const char sentence[])
{
  const int held = state.held;

  state.held   = 1; // a sentence is not said while it changes
  state.length = 0;
  (void)strncpy(state.sentence, sentence, SENTENCE_LENGTH - 1);
  state.length = (sig_atomic_t)strlen(state.sentence);
  state.held   = held;
  if (!held && state.waiting) Die_Private(state.waiting);
}
