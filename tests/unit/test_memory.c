/* test_memory.c -- the peak sees what was held and given back, on every rank, and begins anew where the system can. */
#include "base/compat.h"
#include "base/memory.h"
#include <string.h>
#include <sys/mman.h>
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
  PetscCall(PetscFinalize());
  return 0;
}
