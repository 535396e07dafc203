/* test_process.c -- threads of a BLAS: one, unless the environment or a large computation asks for more. The first rank asks, the other does not. */
#define _GNU_SOURCE // RTLD_DEFAULT
#include <dlfcn.h>
#include <string.h>
#include "api/process.h"
#include "base/threads.h"
#include <test.h>

enum { THREADS = 2 };

/* The environment of this rank, as its user would have set it: OMPI_COMM_WORLD_RANK or PMI_RANK is known before MPI starts. */
static PetscBool SetEnvironment(void)
{
  const char *rank = getenv("OMPI_COMM_WORLD_RANK");

  unsetenv("OMP_NUM_THREADS");
  unsetenv("OPENBLAS_NUM_THREADS");
  if (!rank) rank = getenv("PMI_RANK");
  if (!rank || strcmp(rank, "0")) return PETSC_FALSE;
  setenv("OPENBLAS_NUM_THREADS", "2", 1);
  return PETSC_TRUE;
}

int main(int argc, char **argv)
{
  const PetscBool asked = SetEnvironment();
  union {
    void *address;
    void (*set)(int);
    int (*get)(void);
  } setter = {.address = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")},
    getter = {.address = dlsym(RTLD_DEFAULT, "openblas_get_num_threads")};

  if (setter.address) setter.set(THREADS);
  ProcessBegin(&argc, &argv, PETSC_TRUE);
  if (getter.address) { // another BLAS has no such function
    CHECK(getter.get() == (asked ? THREADS : 1));
    ThreadsAllow(PETSC_TRUE);
    CHECK(getter.get() == THREADS);
    ThreadsAllow(PETSC_FALSE);
    CHECK(getter.get() == (asked ? THREADS : 1));
  }
  return ProcessEnd(MORTISE_SOLVED);
}
