/* idle.c -- loaded before all libraries where there are more ranks than processors. A rank that waits for a
   message calls sched_yield() again and again. With two processors this is a quarter of the time of a test on
   three ranks. Here it yields some times and then sleeps, longer and longer, until it has something to do:
   the time between two calls tells. */
#define _GNU_SOURCE
#include <sched.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

enum {
  YIELDS   = 30,
  WORKED   = 5000,
  SHORTEST = 20000,
  LONGEST  = 200000,
  SECOND   = 1000000000
}; /* nanoseconds, but for YIELDS */

static _Thread_local int             calls;
static _Thread_local long            nap;
static _Thread_local struct timespec last;

int sched_yield(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  if ((now.tv_sec - last.tv_sec) * SECOND + now.tv_nsec - last.tv_nsec > WORKED) {
    calls = 0;
    nap   = SHORTEST;
  }
  if (calls++ < YIELDS) {
    (void)syscall(SYS_sched_yield);
  } else {
    (void)nanosleep(&(struct timespec){.tv_nsec = nap}, NULL);
    nap   = nap + nap / 2 < LONGEST ? nap + nap / 2 : LONGEST;
    calls = YIELDS;
  }
  (void)clock_gettime(CLOCK_MONOTONIC, &last);
  return 0;
}
