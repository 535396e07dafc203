/* threads.c -- see the header.

   CHOLMOD takes four threads for blocks of a few rows, whatever OMP_NUM_THREADS is, and OpenBLAS one on each
   processor. These threads mostly wait for one another. A number of threads that the user sets is kept. */
#define _GNU_SOURCE // RTLD_DEFAULT
#include "base/threads.h"
#include <dlfcn.h>
#include <stdlib.h>

static int number; /* threads of OpenBLAS before ThreadsLimit(), or 0 */

/* A function of a library, or NULL where there is no such library. */
typedef union {
  void *address;
  void (*set)(int);
  int (*get)(void);
} Function;

static Function ThreadsFindFunction_Private(const char *name)
{
  return (Function){.address = dlsym(RTLD_DEFAULT, name)};
}

/* Whether the environment asks for a number of threads. */
static PetscBool ThreadsAreRequested_Private(void)
{
  static const char *const names[] = {"OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS"};

  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(names); i++)
    if (getenv(names[i])) return PETSC_TRUE;
  return PETSC_FALSE;
}

void ThreadsLimit(void)
{
  const char    *threads = getenv("OMP_NUM_THREADS");
  const Function levels  = ThreadsFindFunction_Private("omp_set_max_active_levels");
  const Function get     = ThreadsFindFunction_Private("openblas_get_num_threads"),
                 set     = ThreadsFindFunction_Private("openblas_set_num_threads");

  if (levels.address && (!threads || atoi(threads) <= 1)) levels.set(0);
  if (!get.address || !set.address || ThreadsAreRequested_Private()) return;
  number = get.get();
  set.set(1);
}

void ThreadsAllow(PetscBool allow)
{
  if (number > 1) ThreadsFindFunction_Private("openblas_set_num_threads").set(allow ? number : 1);
}
