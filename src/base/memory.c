/* memory.c -- peak of the resident memory, by /proc where it exists, else by getrusage(); lack of memory in
   libraries.

   Linux keeps the peak as VmHWM in /proc/self/status. Writing a 5 to /proc/self/clear_refs sets it back to
   the present value (man 5 proc). getrusage() knows the peak since the process began, and cannot be set
   back. */
#include <cjson/cJSON.h>
#include <math.h>
#include "base/compat.h"
#include "base/usererror.h"
#include "base/memory.h"
#include <petscblaslapack.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#if __GLIBC_PREREQ(2, 33)
#define MEMORY_KNOWS_HEAP 1 /* by mallinfo2() */
#endif
#endif

/* Bytes of a unit: KILOBYTE in /proc and getrusage() of Linux, BYTE in getrusage() of macOS. */
enum { KILOBYTE = 1024, BYTE = 1 };

/* Bytes of addresses that must be free before the first call of BLAS. OpenBLAS takes 128 MB of addresses, few
   of them in memory, and repeats the request without end until it gets them. */
static const size_t BLAS_BUFFER = (size_t)160 << 20;

static void *MemoryAllocateFn(size_t size)
{
  void *new = malloc(size);

  if (!new &&size) UserErrorEndMemory();
  return new;
}

/* The smallest call that makes BLAS take its buffer: 1 / 1. */
static void MemoryPrepareBLAS_Private(void)
{
  void              *probe = malloc(BLAS_BUFFER);
  const PetscBLASInt n     = 1;
  const PetscScalar  one   = 1;
  PetscScalar        b     = 1;

  if (!probe) UserErrorEndMemory();
  free(probe);
  BLAStrsm_("L", "L", "N", "N", &n, &n, &one, &one, &n, &b, &n);
}

void MemoryPrepare(void)
{
  cJSON_InitHooks(&(cJSON_Hooks){.malloc_fn = MemoryAllocateFn, .free_fn = free});
  MemoryPrepareBLAS_Private();
}

/* A number of a file that Linux makes, in bytes; NAN on other systems. [in] key - of its line, "VmHWM:" */
static PetscReal MemoryGetFromProc_Private(const char path[], const char key[])
{
  FILE         *file = fopen(path, "r");
  char          line[256];
  unsigned long size = 0;

  while (file && !size && fgets(line, sizeof(line), file))
    if (!strncmp(line, key, strlen(key))) (void)sscanf(line + strlen(key), "%lu kB", &size);
  if (file) fclose(file);
  return size ? (PetscReal)size * KILOBYTE : NAN;
}

/* What Linux can give without swapping. */
static PetscReal MemoryGetAvailable_Private(void)
{
  return MemoryGetFromProc_Private("/proc/meminfo", "MemAvailable:");
}

/* Bytes at the top of the heap that are free and not in memory: the next allocations take them first. Open
   MPI makes malloc() keep what is freed, so the buffer that MemoryPrepare() frees is among them. 0 on other
   systems. */
static PetscReal MemoryGetHeapTop_Private(void)
{
  PetscReal bytes = 0;
#if MEMORY_KNOWS_HEAP
  const size_t   page = (size_t)sysconf(_SC_PAGESIZE), num = mallinfo2().keepcost / page;
  unsigned char *in_memory = calloc(num + 1, 1);
  char          *end       = sbrk(0);

  if (in_memory && !mincore(end - num * page, num * page, in_memory))
    for (size_t i = 0; i < num; i++) bytes += in_memory[i] & 1 ? 0 : (PetscReal)page;
  free(in_memory);
#endif
  return bytes;
}

/* Addresses that a limit of this process leaves it; infinite without a limit. */
static PetscReal MemoryGetAddresses_Private(void)
{
  const PetscReal taken = MemoryGetFromProc_Private("/proc/self/status", "VmSize:");
  struct rlimit   limit;

  if (getrlimit(RLIMIT_AS, &limit) || limit.rlim_cur == RLIM_INFINITY) return PETSC_INFINITY;
  return (PetscReal)limit.rlim_cur - (PetscIsNanReal(taken) ? 0 : taken) + MemoryGetHeapTop_Private();
}

static PetscReal MemoryGetPeakFromUsage_Private(void)
{
#ifdef __APPLE__
  const PetscReal unit = BYTE;
#else
  const PetscReal unit = KILOBYTE;
#endif
  struct rusage usage;

  return getrusage(RUSAGE_SELF, &usage) == 0 ? (PetscReal)usage.ru_maxrss * unit : NAN;
}

PetscErrorCode MemoryPeak(MPI_Comm comm, PetscReal *bytes, PetscReal *largest)
{
  PetscFunctionBeginUser;
  *bytes = MemoryGetFromProc_Private("/proc/self/status", "VmHWM:");
  if (PetscIsNanReal(*bytes)) *bytes = MemoryGetPeakFromUsage_Private();
  if (largest) PetscCallMPI(MPI_Allreduce(bytes, largest, 1, MPIU_REAL, MPI_MAX, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bytes, 1, MPIU_REAL, MPI_SUM, comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MemoryPeakReset(MPI_Comm comm, PetscBool *done)
{
  static const char reset[] = "5"; /* of the peak, see above */
  FILE             *file;
  int               ok = 0;

  PetscFunctionBeginUser;
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  file = PetscIsNanReal(MemoryGetFromProc_Private("/proc/self/status", "VmHWM:")) ? NULL
                                                                                  : fopen("/proc/self/clear_refs", "w");
  if (file) {
    ok = fputs(reset, file) >= 0;
    ok = !fclose(file) && ok; // a failed write is noticed at the latest when the file is closed
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &ok, 1, MPI_INT, MPI_MIN, comm));
  *done = ok ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MemorySuffices(MPI_Comm comm, PetscReal bytes, PetscBool *suffices)
{
  const PetscReal available = MemoryGetAvailable_Private();
  PetscReal       together;
  MPI_Comm        machine;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine));
  PetscCallMPI(MPI_Allreduce(&bytes, &together, 1, MPIU_REAL, MPI_SUM, machine));
  PetscCallMPI(MPI_Comm_free(&machine));
  *suffices = (PetscBool) !(together > available); // true also for NAN, where nothing is known
  if (bytes > MemoryGetAddresses_Private()) *suffices = PETSC_FALSE;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, suffices, 1, MPIU_BOOL, MPI_LAND, comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MemoryLimit(MPI_Comm comm, PetscReal *bytes)
{
  const PetscReal available = MemoryGetAvailable_Private();
  PetscReal       room      = MemoryGetAddresses_Private();
  PetscMPIInt     size, sharing;
  MPI_Comm        machine;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCallMPI(MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine));
  PetscCallMPI(MPI_Comm_size(machine, &sharing));
  PetscCallMPI(MPI_Comm_free(&machine));
  if (available / sharing < room) room = available / sharing; // false for NAN, where nothing is known
  *bytes = MemoryGetFromProc_Private("/proc/self/status", "VmRSS:");
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bytes, 1, MPIU_REAL, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &room, 1, MPIU_REAL, MPIU_MIN, comm));
  *bytes = PetscIsNanReal(*bytes) ? PETSC_INFINITY : *bytes + size * room;
  PetscFunctionReturn(PETSC_SUCCESS);
}
