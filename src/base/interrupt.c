/* interrupt.c -- see the header. A handler may call few functions: the sentence is prepared, and printed by
   write(). */
#include "base/compat.h"
#include "base/interrupt.h"
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

enum { SENTENCE_LENGTH = 2048 };

static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGPIPE};
enum { NUM_SIGNALS = sizeof(signals) / sizeof(signals[0]) };

static struct {
  volatile sig_atomic_t held, waiting; /* nested InterruptHold() calls; the waiting signal */
  volatile sig_atomic_t length;        /* of the sentence */
  int                   depth;         /* of InterruptBegin() */
  pthread_t             thread;        /* that called it: the one that computes */
  char                  sentence[SENTENCE_LENGTH];
  void (*volatile clean)(void);
  struct sigaction before[NUM_SIGNALS];
} state;

void InterruptCleanUp(void)
{
  if (state.clean) (*state.clean)();
}

/* Cleans up, prints the sentence and ends by the signal. */
static void InterruptEndProcess_Private(int number)
{
  ssize_t done = 0;

  InterruptCleanUp();
  if (number != SIGPIPE) done = write(STDERR_FILENO, state.sentence, (size_t)state.length);
  (void)done; // a closed stderr is no error
  (void)signal(number, SIG_DFL);
  (void)raise(number);
}

/* MPI has threads of its own. A signal may arrive in any of them while the main thread writes: it is passed
   on to that one. */
static void InterruptSignalFn(int number)
{
  if (!pthread_equal(pthread_self(), state.thread))
    (void)pthread_kill(state.thread, number);
  else if (state.held)
    state.waiting = number;
  else
    InterruptEndProcess_Private(number);
}

PetscErrorCode InterruptBegin(void)
{
  struct sigaction action;

  PetscFunctionBeginUser;
  if (state.depth++) PetscFunctionReturn(PETSC_SUCCESS);
  state.held = state.waiting = state.length = 0;
  state.thread                              = pthread_self();
  (void)memset(&action, 0, sizeof(action));
  action.sa_handler = InterruptSignalFn;
  action.sa_flags   = SA_NODEFER | SA_RESTART; // the signal is raised again by its own handler
  (void)sigemptyset(&action.sa_mask);
  for (int s = 0; s < NUM_SIGNALS; s++) {
    (void)sigaction(signals[s], NULL, &state.before[s]);
    if (state.before[s].sa_handler != SIG_IGN)
      (void)sigaction(signals[s], &action, NULL); // ignored signals stay ignored, as by nohup
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode InterruptEnd(void)
{
  PetscFunctionBeginUser;
  if (--state.depth) PetscFunctionReturn(PETSC_SUCCESS);
  for (int s = 0; s < NUM_SIGNALS; s++) (void)sigaction(signals[s], &state.before[s], NULL);
  PetscFunctionReturn(PETSC_SUCCESS);
}

void InterruptHold(void)
{
  state.held++;
}

void InterruptRelease(void)
{
  state.held--;
  if (!state.held && state.waiting) InterruptEndProcess_Private(state.waiting);
}

void InterruptSetSentence(const char sentence[])
{
  InterruptHold(); // a sentence is not printed while it changes
  state.length = 0;
  (void)strncpy(state.sentence, sentence, SENTENCE_LENGTH - 1);
  state.length = (sig_atomic_t)strlen(state.sentence);
  InterruptRelease();
}

void InterruptSetCleanUp(void (*clean)(void))
{
  state.clean = clean;
}
