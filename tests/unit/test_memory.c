/* test_memory.c -- the peak sees what was held and given back, on every rank, and begins anew where the system can;
   the limit. */
#include "base/compat.h"
#include "base/memory.h"
#include <malloc.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <test.h>
#include <unistd.h>

static const PetscReal MOST = 1e18;             /* more than there is */
static const size_t    HELD = (size_t)64 << 20; /* bytes */

/* Takes memory from the system, touches it and gives it back: no allocator may keep it. */
static void Hold(void)
{
  char *block = mmap(NULL, HELD, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);

  CHECK(block != MAP_FAILED);
  memset(block, 1, HELD);
  CHECK(!munmap(block, HELD));
}

/* Addresses of this process, in bytes. */
static size_t Addresses(void)
{
  FILE         *file  = fopen("/proc/self/statm", "r");
  unsigned long pages = 0;

  CHECK(file && fscanf(file, "%lu", &pages) == 1 && !fclose(file));
  return pages * (size_t)sysconf(_SC_PAGESIZE);
}

/* The limit where no more addresses can be had than the process has. */
static PetscReal LimitHere(void)
{
  struct rlimit old, now;
  PetscReal     limit;

  CHECK(!getrlimit(RLIMIT_AS, &old));
  now = (struct rlimit){.rlim_cur = Addresses(), .rlim_max = old.rlim_max};
  CHECK(!setrlimit(RLIMIT_AS, &now));
  CHECK(!MemoryLimit(PETSC_COMM_WORLD, &limit));
  CHECK(!setrlimit(RLIMIT_AS, &old));
  return limit;
}

/* Freed memory at the top of the heap that was never touched counts as left. */
static void CheckHeap(PetscMPIInt size)
{
  PetscReal before;
  void *volatile block;

  if (!mallopt(M_MMAP_MAX, 0) || !mallopt(M_TRIM_THRESHOLD, (int)(2 * HELD)) || access("/proc/self/statm", R_OK))
    return;
  before = LimitHere();
  block  = malloc(HELD);
  CHECK(block);
  free(block);
  CHECK(LimitHere() > before + 0.9 * (PetscReal)HELD * size);
}

int main(int argc, char **argv)
{
  PetscReal   before, held, anew, most, one, limit;
  PetscMPIInt size, rank;
  PetscBool   done, suffices;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(MemoryPeakReset(PETSC_COMM_WORLD, &done));
  PetscCall(MemoryPeak(PETSC_COMM_WORLD, &before, NULL));
  CHECK(before > 0);
  Hold();
  PetscCall(MemoryPeak(PETSC_COMM_WORLD, &held, NULL));
  CHECK(held > before + 0.9 * (PetscReal)HELD * size); // some of it may have been free below the peak before
  PetscCall(MemoryPeakReset(PETSC_COMM_WORLD, &done));
  PetscCall(MemoryPeak(PETSC_COMM_WORLD, &anew, &most));
  if (done)
    CHECK(anew < held - 0.9 * (PetscReal)HELD * size);
  else
    CHECK(anew >= held);
  CHECK(most * size >= anew && (most < anew || size == 1));
  if (rank == size - 1) Hold();
  PetscCall(MemoryPeak(PETSC_COMM_WORLD, &held, &one));
  if (done && size > 1) CHECK(one > held / size + 0.5 * (PetscReal)HELD * (size - 1) / size); // one rank alone has it
  PetscCall(MemorySuffices(PETSC_COMM_WORLD, 1, &suffices));
  CHECK(suffices);
  PetscCall(MemorySuffices(PETSC_COMM_WORLD, rank == size - 1 ? MOST : 0, &suffices));
  if (access("/proc/meminfo", R_OK) == 0) CHECK(!suffices); // wherever one rank alone wants it
  PetscCall(MemoryLimit(PETSC_COMM_WORLD, &limit));
  CHECK(limit > anew - (PetscReal)HELD * size); // what is resident is a part of it
  CheckHeap(size);
  PetscCall(PetscFinalize());
  return 0;
}
