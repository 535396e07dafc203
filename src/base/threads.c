/* threads.c -- see the header.

   CHOLMOD takes four threads for blocks of a few rows, whatever OMP_NUM_THREADS says, and OpenBLAS one on each processor. They wait for one another
   most of the time. A user that asks for more than one thread has them. */
#define _GNU_SOURCE // RTLD_DEFAULT
#include "base/threads.h"
#include <dlfcn.h>
#include <stdlib.h>

static int number; /* threads that OpenBLAS had before they were taken away, or 0 */

/* A function of a library, or NULL where there is no such library. */
typedef union {
  void *address;
  void (*set)(int);
  int (*get)(void);
} Function;

static Function FindFunction_Private(const char *name)
{
  return (Function){.address = dlsym(RTLD_DEFAULT, name)};
}

/* Whether the environment asks for a number of threads. */
static PetscBool NumberIsAsked_Private(void)
{
  static const char *const names[] = {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS"};

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(names); i++)
    if (getenv(names[i])) return PETSC_TRUE;
  return PETSC_FALSE;
}

void ThreadsLimit(void)
{
  const char    *threads = getenv("OMP_NUM_THREADS");
  const Function levels  = FindFunction_Private("omp_set_max_active_levels");
  const Function get     = FindFunction_Private("openblas_get_num_threads"),
                 set     = FindFunction_Private("openblas_set_num_threads");

  if (levels.address && (!threads || atoi(threads) <= 1)) levels.set(0);
  if (!get.address || !set.address || NumberIsAsked_Private()) return;
  number = get.get();
  set.set(1);
}

void ThreadsAllow(PetscBool allow)
{
  if (number > 1) FindFunction_Private("openblas_set_num_threads").set(allow ? number : 1);
}
